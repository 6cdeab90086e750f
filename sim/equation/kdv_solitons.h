/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solitons of the Korteweg-de Vries equation, followed from the start through their collisions. */
#pragma once

#include "sim/equation/kdv_solver.h"

struct bead_kdv_crest {
    double at, height; /* at: place on the unrolled ring */
};

/* The last sight of each soliton, at time t. */
struct bead_kdv_solitons {
    struct {
        struct bead_kdv_crest crest;
        double t;
    } seen[BEAD_SOLITONS];
    double next; /* time to look again */
};

/* Their places at time 0, by the scene. */
void bead_kdv_solitons_begin(struct bead_kdv_solitons *solitons, const struct bead_equation_spec *spec);
/* Find them at the end of the last step, if it is time to look. */
void bead_kdv_solitons_watch(struct bead_kdv_solitons *solitons, const struct bead_kdv *kdv);
/* Append places, amplitudes and shifts of the solitons that can be recognised now to the `count` measures; returns the new count.
 */
size_t bead_kdv_soliton_measures(const struct bead_kdv_solitons *solitons, const struct bead_kdv *kdv, struct bead_measure *to,
                                 size_t count, size_t room);

/* Is point i of u a crest? */
bool bead_kdv_is_crest(const double *u, size_t points, size_t i);
