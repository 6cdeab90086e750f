/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrators: one const row each; coefficients are data. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "sim/base/internal.h"

struct bead_method_info {
    const char *name;        /* as in scenes: "rkn8" */
    const char *description; /* one line with its source */
    int order;               /* for smooth forces */
    int evaluations;         /* of the force, per step */
    bool damping;            /* forces may depend on velocities */
    bool variable;           /* the step follows the state; else it is fixed */
    double theta;            /* step in units of 1/omega for peaks to 1e-6 */
    double theta_order;      /* theta ~ accuracy^(1/theta_order) */
    double theta_cap;        /* never more, whatever the accuracy */
    double theta_max;        /* largest stable step in units of 1/omega */
};

/* Row `index`, NULL behind the last. */
BEAD_INTERNAL const struct bead_method_info *bead_method_info(size_t index);
BEAD_INTERNAL const struct bead_method_info *bead_method_find(const char *name);
