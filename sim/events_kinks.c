#include "sim/events_kinks.h"

#include "sim/tableau.h"

bool bead_kinks_known(const struct bead_tableau *tableau)
{
    bool known = true;
    for (size_t i = BEAD_KINK_STAGES; i < tableau->stages; i++)
        known = known && tableau->b[i] == 0 && tableau->bp[i] == 0;
    return known;
}
