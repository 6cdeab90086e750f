/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small vibrations of a chain about its rest: the bands of its cells, as if each went on for ever, and the modes of the chain as it
 * is. Contacts are springs of the stiffness that the precompression gives them. */
#pragma once

#include "beadreel/chain.h"
#include "sim/base/internal.h"
#include "sim/frequency/jacobi.h"

/* A cell that a chain repeats. */
struct bead_medium {
    size_t first, last; /* beads of the chain that are made of it */
    struct bead_jacobi cell;
};

/* The first of each kind of cell that a chain repeats, reversed or not, left to right, under the precompression alone; cells that
 * differ from each other have no bands. The array is the caller's, to be freed by bead_media_free, also after errors. Errors:
 * MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_media_find(const struct bead_chain *chain, struct bead_medium **media, size_t *count,
                                                         struct bead_message *msg);
BEAD_INTERNAL void bead_media_free(struct bead_medium *media, size_t count);
/* Ends of band `index` (from 0), Hz: at cell phases 0 and pi. Between these the frequency is monotonic. */
BEAD_INTERNAL void bead_band(const struct bead_medium *medium, size_t index, double ends[2]);
/* Is there nothing between band `index` and the next, apart from rounding? */
BEAD_INTERNAL bool bead_gap(const struct bead_medium *medium, size_t index, double ends[2]);

/* One mode of a chain. */
struct bead_mode {
    double frequency;     /* Hz */
    double participation; /* (sum e)^2 / sum e^2 of the kinetic energies e of the beads: N of N equal ones */
    double length; /* of localisation, in beads: amplitudes fall as exp(-n / length); see D. J. Thouless, J. Phys. C 5, 77 (1972).
                    * From the ends of the mode in a chain of N beads: a mode that extends over all of it has about N / ln(N / 2),
                    * and less near the edges of bands, as its ends have less than their part of it */
    double centre; /* bead: mean number, weighted by e */
};
/* All modes, rising; [beads of the chain], the caller's. A wall is one; ends without are free. Errors: SCENE (too many beads),
 * MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_modes_find(const struct bead_chain *chain, struct bead_mode **modes,
                                                         struct bead_message *msg);
