/* Inner loops along the chain, compiled once for each instruction set from kernels_body.h and chosen at run time.
 *
 * All arithmetic is element-wise, without contraction, so every set gives the same bits. Arrays have one
 * readable element behind the n used (the wall's displacement, 0) and f one before (the force on the striker). */
#ifndef BEADREEL_SIM_KERNELS_H
#define BEADREEL_SIM_KERNELS_H

#include <stdbool.h>
#include <stddef.h>

struct bead_law_spec;

/* Constants of the contacts 0..n-1 as the force kernels want them. */
struct bead_contact_table {
    const double *stiffness;          /* A_k; 0 where there is no contact */
    const double *static_compression; /* d0_k */
    const double *static_force;       /* f0_k = A_k d0_k^p, subtracted */
    const struct bead_law_spec *law;
    double damping, damping_exponent;
};

/* f_k of displacements u (and velocities v where damped), minus the static force. */
typedef void (*bead_force_kernel)(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);

enum { BEAD_COMBINE_MAX = 18 };

struct bead_kernels {
    const char *name, *description;
    bead_force_kernel hertz;        /* A d^{3/2} without static part */
    bead_force_kernel hertz_static; /* with */
    /* a_j = (f_{j-1} - f_j) / m_j */
    void (*accelerations)(size_t n, const double *f, const double *inverse_mass, double *a);
    /* y = base + scale * v + sum_i coefficient_i * term_i, in this order; count <= BEAD_COMBINE_MAX; v may be NULL. */
    void (*combine)(size_t n, double *y, const double *base, double scale, const double *v, size_t count, const double *coefficient,
                    const double *const *term);
    double (*largest)(size_t n, const double *f); /* max of f_0..f_{n-1} and 0 */
    /* mark[k] = 1 where the relative velocity v_k - v_{k+1} was > 0 in `before` and is <= 0 in `after`; returns whether any. */
    bool (*turns)(size_t n, const double *before, const double *after, unsigned char *mark);
};

/* NULL: the best this machine has. Otherwise by name; NULL is returned for one that is unknown or not to be had. */
const struct bead_kernels *bead_kernels_find(const char *name);

/* For laws without a vector kernel, and for damping. */
void bead_force_general(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);
void bead_force_damped(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f);

#endif
