#include "sim/integrate/events_kinks.h"

#include <string.h>

#include "sim/integrate/tableau.h"

bool bead_kinks_known(const struct bead_tableau *tableau)
{
    bool known = true;
    for (size_t i = BEAD_KINK_STAGES; i < tableau->stages; i++)
        known = known && tableau->b[i] == 0 && tableau->bp[i] == 0;
    return known;
}

struct bead_kink_method bead_kink_method_make(const struct bead_tableau *tableau)
{
    struct bead_kink_method method;
    memset(&method, 0, sizeof method);
    for (size_t i = 0; i < BEAD_KINK_STAGES && i < tableau->stages; i++) {
        method.c[i] = (float)tableau->c[i];
        method.b[i] = (float)tableau->b[i];
        method.bp[i] = (float)tableau->bp[i];
        for (size_t j = 0; j < i; j++)
            method.a[i][j] = (float)tableau->a[i * tableau->stages + j];
    }
    return method;
}
