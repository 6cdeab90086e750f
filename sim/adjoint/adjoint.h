/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adjoint: the derivatives of a contact force by all parameters of a chain, from one sweep backwards in time.
 *
 * The force at time T depends on the coefficients A_k and static forces F_k of the contacts, on the masses m_j and on the
 * velocities at the start. With f_k = A_k d_k^p - F_k and m_j u_j'' = f_{j-1} - f_j, K_k = df_k/dd_k, small changes r obey
 *
 *   m_j r_j'' = K_j (r_{j+1} - r_j) - K_{j-1} (r_j - r_{j-1}),     forwards and, as these forces conserve energy, backwards.
 *
 * Backwards from r = 0, -r'_k = K_k/m_k and -r'_{k+1} = -K_k/m_{k+1} at T, the force of contact k, J, has the derivatives (e_i =
 * r_{i+1} - r_i; its direct dependence on its own A_k and F_k is added)
 *
 *   dJ/dA_i = int e_i df_i/dA_i dt,  dJ/dF_i = int e_i df_i/dF_i dt,  dJ/dm_j = - int r_j u_j'' dt,  dJ/du_0'(0) = m_0 r_0(0).
 *
 * At a maximum dJ/dT = 0, so a peak has these derivatives too. The force of a contact that opens or closes has a continuous first
 * derivative, so Hertz's law needs only an accurate integration: sqrt(d) has a branch point. Over a step with one, K_k and f_k are
 * replaced by polynomials with equal moments, those of K_k corrected for second-order effects (adjoint_nodes.c).
 *
 * Several forces share a sweep: states and stiffnesses at the nodes of each step are found once. */
#pragma once

#include <stdbool.h>

#include "sim/adjoint/record.h"

/* The sum of the forces of one or two contacts at one time, times a weight, and its derivatives. */
struct bead_adjoint {
    size_t contact[2], contacts; /* contacts: 1 or 2 */
    double weight, time;         /* time: s, within the record */
    bool at_maximum;             /* the time is near that of a maximum: take that */
    /* Out: */
    double force;         /* N */
    double *stiffness;    /* [contacts] dJ/dA_k, N / (N/m^p), at constant F_k */
    double *static_force; /* [contacts] dJ/dF_k */
    double *mass;         /* [beads] dJ/dm_j, N/kg, at constant forces */
    double velocity;      /* dJ/du_0'(0), N s/m: by the striker's velocity */
    double striker_force; /* derivative by the constant force on the striker */
};

/* Limits of the approximations. */
struct bead_adjoint_care {
    double negligible; /* r below this part of the largest one is ignored */
    double heavy;      /* h^2 K/m of a contact from which its opening or closing takes a separate part of the step */
};

/* The derivatives of `count` forces. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_adjoint_sweep(const struct bead_chain *chain, const struct bead_record *record,
                                              const struct bead_kernels *kernels, const struct bead_adjoint_care *care,
                                              struct bead_adjoint *adjoints, size_t count, struct bead_message *msg);
