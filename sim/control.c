#include "sim/control.h"

#include <math.h>

/* Stiffness to be expected of contact k: at the larger of the compressions now and `ahead`. */
static double expected(const struct bead_stepper *s, size_t k, double ahead)
{
    const struct bead_state *now = &s->end;
    double rate = now->v[k] - now->v[k + 1], d = s->table.static_compression[k] + (now->u[k] - now->u[k + 1]);
    d += rate > 0 ? ahead * rate : 0;
    if (!s->chain->law->one_sided)
        return fmax(s->chain->law->stiffness(s->table.stiffness[k], s->table.law, d),
                    s->chain->law->stiffness(s->table.stiffness[k], s->table.law, -d));
    if (s->table.law->kind == BEAD_LAW_HERTZ)
        return d > 0 ? 1.5 * s->table.stiffness[k] * sqrt(d) : 0;
    return s->chain->law->stiffness(s->table.stiffness[k], s->table.law, d);
}

double bead_control_omega(const struct bead_stepper *s, double ahead)
{
    const double *w = s->chain->inverse_mass;
    size_t n = s->active < s->chain->contacts ? s->active : s->chain->contacts;
    double worst = 0, before = 0, here = expected(s, 0, ahead);
    for (size_t k = 0; k < n; k++) {
        double after = k + 1 < s->chain->contacts ? expected(s, k + 1, ahead) : 0, right = k + 1 < s->beads ? w[k + 1] : 0;
        double row = here * (w[k] + right) + before * w[k] + after * right;
        worst = row > worst ? row : worst;
        before = here;
        here = after;
    }
    return sqrt(worst);
}
