/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pair forces: one const row each. Compression d > 0 pushes the beads apart with force f(d).
 *
 * A row has everything that depends on the law: a name, a description and all functions (`exponent` and `coefficient_rates` may be
 * NULL). A law of your own is such a row: hand it to a chain (bead_chain_settings.law) or to a session (bead_job.own), whose scenes
 * then find it by its name. It must outlive them. Several threads call these functions at once; the same arguments must give the
 * same result.
 *
 * To add a law to the library: a row in sim/chain/law.c and, if it has settings, its keys in sim/scene/scene_chain.c. */
#ifndef BEADREEL_LAW_H
#define BEADREEL_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"

BEAD_BEGIN

/* Derivatives of a contact's coefficient by the radius (/m) and modulus (/Pa) of its left and right bead, or wall, as parts of the
 * coefficient: d ln a. 0 where it does not depend on one. */
struct bead_coefficient_rates {
    double radius[2], modulus[2];
};

struct bead_law {
    const char *name;        /* as in scenes */
    const char *description; /* with the source of the formula */
    const void *context;     /* for its functions, which find it as spec->row->context: the numbers of a law of your own, ... */
    bool one_sided;          /* no force at d <= 0: contacts open and close */
    bool hertz;              /* the force is a d^{3/2}: kernels may take square roots instead of calling `force` */
    bool as_printed;         /* in the order of operations of the thesis's program, where the last bit matters */
    /* p where the force is a d^p at d > 0. NULL: it is no such power; measures that follow from the power are then left out, and
     * the beginning of the force, which contact events need, is found from `force` and `stiffness`. */
    double (*exponent)(const struct bead_law_spec *spec);
    /* The coefficient a of a contact between two beads, or of a bead and a wall; right NULL: a rigid wall. */
    double (*coefficient)(const struct bead_law_spec *spec, const struct bead_material *left, const struct bead_material *right,
                          bool wall);
    /* Its derivatives. NULL: it does not depend on what beads are made of. */
    struct bead_coefficient_rates (*coefficient_rates)(const struct bead_material *left, const struct bead_material *right,
                                                       bool wall);
    double (*coefficient_power)(const struct bead_law_spec *spec);                      /* p of its unit, N/m^p */
    double (*energy)(double a, const struct bead_law_spec *spec, double d);             /* J */
    double (*force)(double a, const struct bead_law_spec *spec, double d);              /* N */
    double (*stiffness)(double a, const struct bead_law_spec *spec, double d);          /* N/m, df/dd */
    double (*compression)(double a, const struct bead_law_spec *spec, double f);        /* m, inverse of force */
    double (*energy_compression)(double a, const struct bead_law_spec *spec, double e); /* m, inverse of energy */
};

/* NULL: there is no such law. */
BEAD_API const struct bead_law *bead_law_find(const char *name);

BEAD_END

#endif
