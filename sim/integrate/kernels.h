/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kernels: inner loops along the chain, compiled once for each instruction set from kernels_body.h and chosen at run time.
 *
 * All arithmetic is element-wise, without contraction, so every set gives the same bits. Arrays have one readable element after the
 * n used (the wall's displacement, 0), and f has one before (the force on the striker). */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

struct bead_event_flags;
struct bead_event_limits;
struct bead_event_speeds;
struct bead_kink_method;
struct bead_kinks;
struct bead_law_spec;
struct bead_patch;
struct bead_patch_piece;
struct bead_patch_rule;
struct bead_patch_source;

/* Constants of contacts 0..n-1 for the force kernels. */
struct bead_contact_table {
    const double *stiffness;          /* A_k; 0 where there is no contact */
    const double *static_compression; /* d0_k */
    const double *static_force;       /* f0_k = A_k d0_k^p, subtracted */
    const struct bead_law_spec *law;
    double damping, damping_exponent, damping_compression;
    const unsigned char *closed; /* with damping: contacts that are closed, whatever their compression */
};

/* f_k at displacements u (and velocities v with damping), without the static force. */
typedef void (*bead_force_kernel)(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);

/* gamma sgn(D) |D|^a d^c, of a contact compressed by d at the rate D. */
static inline double bead_damping_force(const struct bead_contact_table *table, double d, double rate)
{
    const double a = table->damping_exponent, c = table->damping_compression,
                 size = table->damping * (a == 1 ? fabs(rate) : pow(fabs(rate), a)); /* powers take most of the time */
    return copysign(c > 0 ? size * (c == 0.5 ? sqrt(fmax(d, 0)) : pow(fmax(d, 0), c)) : size, rate);
}

struct bead_step_ends {
    const double *u0, *v0, *a0, *u1, *v1, *a1;
    double h;
};

/* a_j of contact forces f and inverse masses (or masses: bead_accelerations_printed). */
typedef void (*bead_acceleration_kernel)(size_t n, const double *f, const double *inverse_mass, double *a);

/* Springs k between beads, and two sums along the way: stretch_sum_j += weight by_stretch_j (r_j - r_{j+1}) and bead_sum_j +=
 * weight by_bead_j r_j; a weight of 0 skips them. */
struct bead_springs {
    const double *k, *inverse_mass, *by_stretch, *by_bead;
    double weight, *stretch_sum, *bead_sum;
};

struct bead_kernels {
    const char *name, *description;
    bead_force_kernel hertz; /* A d^{3/2} */
    /* Forces without static part and accelerations in one loop; reads f[-1], and rounds n up to whole vectors. */
    void (*hertz_move)(size_t n, const struct bead_contact_table *table, const double *u, const double *inverse_mass, double *f,
                       double *a);
    /* As above, with the stiffnesses 3/2 A d^{1/2}. */
    void (*hertz_all)(size_t n, const struct bead_contact_table *table, const double *u, const double *inverse_mass, double *f,
                      double *stiffness, double *a);
    /* dA d^{3/2}/dd = 3/2 A d^{1/2} at the present compressions, or at those that the velocities lead to within `ahead` seconds. */
    void (*hertz_stiffness)(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double ahead,
                            double *stiffness);
    /* The largest of k_j (w_j + w_{j+1}) + k_{j-1} w_j + k_{j+1} w_{j+1} for j < n, and 0. */
    double (*circles)(size_t n, const double *k, const double *w);
    /* a_j = (f_{j-1} - f_j) / m_j */
    bead_acceleration_kernel accelerations;
    /* y = base + (h k_0 + 2 h k_1 + 2 h k_2 + h k_3) / 6, in the order the thesis's program adds them. */
    void (*rk4_sum)(size_t n, double *y, const double *base, double h, const double *const k[4]);
    /* y = base + scale * v + sum_i coefficient_i * term_i, in this order; v may be NULL. */
    void (*combine)(size_t n, double *y, const double *base, double scale, const double *v, size_t count, const double *coefficient,
                    const double *const *term);
    double (*largest)(size_t n, const double *f); /* max of f_0..f_{n-1} and 0 */
    /* f_j = k_j (r_j - r_{j+1}): forces of springs. */
    void (*springs)(size_t n, const double *k, const double *r, double *f);
    /* sum_j += scale k_j (r_j - r_{j+1}) */
    void (*add_springs)(size_t n, double scale, const double *k, const double *r, double *sum);
    /* a_j = scale w_j (k_{j-1} (r_{j-1} - r_j) - k_j (r_j - r_{j+1})), without a force before bead 0; and the sums. Reads and
     * writes whole vectors. */
    void (*move_springs)(size_t n, double scale, const double *r, const struct bead_springs *springs, double *a);
    /* mark[k] = 1 if the compression u_k - u_{k+1} may have a maximum above least_k within the step: its rate is > 0 at the start
     * and <= 0 at the end, or has one sign at both ends and may have the other in between. With `high`, maxima of any height are
     * marked, and high[k] = 1 if one may exceed least_k. Returns true if any is marked; with `high`, if any is high. Reads and
     * writes whole vectors. */
    bool (*turns)(size_t n, const struct bead_step_ends *ends, const double *least, unsigned char *mark, unsigned char *high);
    /* Contact events, see events_patch.h: finds contacts of 0..n-1 with one that matters, and its effect. n is a multiple of 8
     * unless beads n, n + 1, ... are at rest. Reads and writes whole vectors. Returns their number. */
    size_t (*flag_events)(size_t n, const struct bead_patch_source *source, const struct bead_event_limits *limits,
                          struct bead_event_flags *flags);
    /* Updates the fastest rates of contacts 0..n-1 with velocities v, and their weights. Reads and writes whole vectors. Returns
     * true if a weight has changed. */
    bool (*weigh_speeds)(size_t n, const double *v, const struct bead_event_speeds *speeds);
    /* Contact 0 of the patch is contact `at` of the chain: -1 is the constant force on the striker. */
    void (*load_patch)(const struct bead_patch_source *source, ptrdiff_t at, struct bead_patch *patch);
    /* Kinks of the first `count` (> 0) flags, see events_kinks.h; ignores terms that change no velocity by half of `tolerance`.
     * Reads and writes whole vectors. */
    void (*correct_kinks)(const struct bead_patch_source *source, const struct bead_kink_method *method, size_t count,
                          struct bead_event_flags *flags, double tolerance, struct bead_kinks *kinks);
    /* At most `sweeps` Picard steps. */
    void (*integrate_piece)(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, size_t sweeps,
                            struct bead_patch *patch);
};

/* correct_kinks and integrate_piece of the set "avx2", which "avx512" uses too. */
void bead_correct_few_kinks(const struct bead_patch_source *source, const struct bead_kink_method *method, size_t count,
                            struct bead_event_flags *flags, double tolerance, struct bead_kinks *kinks);
void bead_integrate_few(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, size_t sweeps,
                        struct bead_patch *patch);

/* The set called `name`, or the best of this machine for NULL. Returns NULL if it is unknown or not available here. */
const struct bead_kernels *bead_kernels_find(const char *name);

/* For laws without a vector kernel, and for damping. */
void bead_force_general(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);
void bead_force_damped(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);
/* The arithmetic of the thesis's Appendix 4, operation by operation: d^(3/2) by pow, each force divided by the mass. Required to
 * reproduce the thesis with a chain that amplifies rounding errors by 1e9. */
void bead_force_printed(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);
void bead_accelerations_printed(size_t n, const double *f, const double *mass, double *a);
