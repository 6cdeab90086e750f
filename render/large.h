/* Memory for arrays of megabytes. */
#ifndef BEADREEL_RENDER_LARGE_H
#define BEADREEL_RENDER_LARGE_H

#include <stddef.h>

/* Not cleared, to be freed; NULL: none left. Large ones lie in huge pages where the system has them: a fault each 2 MB. */
void *bead_large_take(size_t bytes);

#endif
