/* Reports: a run as one HTML file that needs nothing else. report_run.c (life of the sink), report_data.c (what its page is made
 * of), report_write.c (text). The page itself, its style and its program are the files of assets/report. */
#ifndef BEADREEL_RENDER_REPORT_REPORT_H
#define BEADREEL_RENDER_REPORT_REPORT_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_report_sink;

#endif
