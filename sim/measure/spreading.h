/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spreading: how far energy has gone from the bead that was excited, over time, for tables and plots.
 *
 * With e_n the energy of bead n (contacts' energies are shared) and n0 the excited bead: the second moment m2 = sum (n - n0)^2 e_n
 * / sum e_n, the participation P = (sum e_n)^2 / sum e_n^2, and the front, the furthest bead from n0 with more than 1e-6 of the
 * energy. The exponents of m2 ~ t^gamma and 1/P ~ t^-eta are slopes of least squares through the logarithms of the samples from 7 %
 * of the time until the time itself, with standard errors: the window is part of the definition. A. J. Martinez, P. G. Kevrekidis,
 * M. A. Porter, Phys. Rev. E 93, 022902 (2016). */
#pragma once

#include "beadreel/sink.h"
#include "sim/base/internal.h"
#include "sim/statistics/statistics.h"

enum { BEAD_SECOND_MOMENT, BEAD_PARTICIPATION, BEAD_FRONT, BEAD_SPREADING_NUMBERS };
/* The window of the exponents begins at this part of the time. */
#define BEAD_SPREADING_WINDOW 0.07

/* Logarithms of time, second moment and participation, of one chain. */
struct bead_spreading {
    double *log[3];
    size_t count, room, beads;
    size_t origin; /* the excited bead: the middle one of those that do not start at rest, or the striker */
};

/* Room for `times` samples. Errors: MEMORY; to be freed even then. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_spreading_begin(struct bead_spreading *spreading, const struct bead_chain *chain,
                                                              size_t times, struct bead_message *msg);
BEAD_INTERNAL void bead_spreading_free(struct bead_spreading *spreading);
/* A sample with energies of all beads: second moment, participation (beads) and front. */
BEAD_INTERNAL void bead_spreading_feed(struct bead_spreading *spreading, const struct bead_sample *sample,
                                       double numbers[BEAD_SPREADING_NUMBERS]);
/* The law of the second moment or of the participation, its slope the exponent, at the last sample; NaN with fewer than 8 samples
 * in the window. */
BEAD_INTERNAL struct bead_line bead_spreading_exponent(const struct bead_spreading *spreading, int of);
