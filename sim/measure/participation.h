/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order of a wave: how clean it still is when its front reaches the end of the chain.
 *
 *   err = bead_participation_clean(chain, 1, &clean, &msg);       runs the clean wave
 *   p = bead_chain_participation(chain, u, v);             of the state at the front's arrival
 *   index = bead_clean_index(bead_chain_beads(chain), p, clean);
 *
 * The participation of energies P = (sum e)^2 / sum e^2 is the number of beads that share the energy. The index is the step from
 * equal shares to the clean wave on the scale of 1/P, the part of the energy that an average unit of energy has in its bead:
 *
 *   C = (1/P - 1/n) / (1/P_clean - 1/n)     n beads; 1: as narrow as the clean wave; 0: all beads have the same
 *
 * and is cut to 0..1. P_clean belongs to the clean wave, in a chain of CELLS cells of the same beads, all turned the same way, with
 * the same striker, law, static forces, damping and wall. Its cell is the one that repeats up to the end of the chain, if over at
 * least half of it, else the one that most beads of the scene belong to, turned as most of these are. Ratios of energies: units,
 * speed of the striker and stiffness drop out for Hertz's law without static forces and damping.
 *
 * Means and standard deviations over 100 configurations of N random dimers of steel and aluminium, followed by 15 more:
 *
 *     N    M = 1    0.9              0.5              0
 *     32   1.00     0.43  +- 0.06    0.15  +- 0.03    0.12  +- 0.02
 *     64   1.00     0.29  +- 0.05    0.055 +- 0.012   0.053 +- 0.010
 *     128  1.00     0.11  +- 0.03    0.036 +- 0.009   0.037 +- 0.009
 *     256  1.00     0.026 +- 0.008   0.032 +- 0.009   0.033 +- 0.009
 *
 * M = 0.9 and 0.5 are 5.8, 6.8 and 3.5 standard deviations apart for N = 32, 64 and 128; with the leading pulse's part of the
 * energy, 4.7, 5.2 and 3.3. Where the chain is so long that the leading pulse is used up (N = 256), one magnetism is as delocalised
 * as the other. */
#pragma once

#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "sim/base/internal.h"

enum { BEAD_ORDER_BEADS = 512 };

/* Participation of the clean wave of the chain's cells; NaN if there is none (the front does not get through, or does not end). It
 * is run to the accuracy that the scene asks for, at least 1e-6, times `tolerance_factor`. Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_participation_clean(const struct bead_chain *chain, double tolerance_factor,
                                                                  double *clean, struct bead_message *msg);
/* Participation from displacements, m, and velocities, m/s, [beads]; NaN if there is no energy. */
BEAD_INTERNAL double bead_chain_participation(const struct bead_chain *chain, const double *displacement, const double *velocity);
/* The index of n beads; NaN if `clean` or `participation` is, or n <= clean. */
BEAD_INTERNAL double bead_clean_index(size_t beads, double participation, double clean);
