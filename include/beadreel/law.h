/* Pair forces: one const row each. Compression d > 0 pushes the beads apart with force f(d). */
#ifndef BEADREEL_LAW_H
#define BEADREEL_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/api.h"
#include "beadreel/scene.h"

struct bead_law {
    const char *name;                                                            /* as in scenes */
    const char *description;                                                     /* with the source of the formula */
    bool one_sided;                                                              /* no force at d <= 0: contacts open and close */
    double (*energy)(double a, const struct bead_law_spec *spec, double d);      /* J */
    double (*force)(double a, const struct bead_law_spec *spec, double d);       /* N */
    double (*stiffness)(double a, const struct bead_law_spec *spec, double d);   /* N/m, df/dd */
    double (*compression)(double a, const struct bead_law_spec *spec, double f); /* m, inverse of force */
    double (*energy_compression)(double a, const struct bead_law_spec *spec, double e); /* m, inverse of energy */
};

BEAD_API const struct bead_law *bead_law_find(enum bead_law_kind kind);
/* Row `index`, NULL behind the last. */
BEAD_API const struct bead_law *bead_law_info(size_t index);

/* Stiffness A of a contact of two spheres (thesis Eq. 13):
 * A = 4 E1 E2 sqrt(R1 R2 / (R1 + R2)) / (3 [E2 (1 - nu1^2) + E1 (1 - nu2^2)]), N/m^{3/2}. */
BEAD_API double bead_hertz_spheres(const struct bead_material *a, const struct bead_material *b);
/* The same for a sphere and a flat wall, sqrt(R) instead; wall NULL: rigid. */
BEAD_API double bead_hertz_wall(const struct bead_material *bead, const struct bead_material *wall);
/* Both as the program of the thesis's Appendix 4 has them, operation by operation; between spheres it takes
 * sqrt(R1 R2) / (R1 + R2) for the square root of R1 R2 / (R1 + R2), N/m^{3/2}. `wall` is not NULL. */
BEAD_API double bead_printed_spheres(const struct bead_material *a, const struct bead_material *b);
BEAD_API double bead_printed_wall(const struct bead_material *bead, const struct bead_material *wall);

#endif
