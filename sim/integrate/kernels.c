/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the kernels of the best instruction set, and has the scalar ones: for laws without a vector kernel, damping, Appendix 4.
 */
#include "sim/integrate/kernels.h"

#include "beadreel/law.h"
#include "sim/base/elementary.h"
#include "sim/base/instruction_set.h"

extern const struct bead_kernels bead_kernels_portable;
#ifdef __x86_64__
extern const struct bead_kernels bead_kernels_sse2, bead_kernels_avx2, bead_kernels_avx512;
#endif

/* best first */
static const struct bead_kernels *const sets[] = {
#ifdef __x86_64__
    &bead_kernels_avx512,
    &bead_kernels_avx2,
    &bead_kernels_sse2,
#endif
    &bead_kernels_portable,
};

const struct bead_kernels *bead_kernels_find(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        if ((!name || strcmp(name, sets[i]->name) == 0) && bead_instruction_set_here(sets[i]->name))
            return sets[i];
    }
    return NULL;
}

void bead_force_general(size_t n, const struct bead_contact_table *table, const double *u, const double *, double *f)
{
    const struct bead_law *law = table->law->row;
    for (size_t k = 0; k < n; k++) {
        double d = table->static_compression[k] + (u[k] - u[k + 1]);
        f[k] = law->force(table->stiffness[k], table->law, d) - table->static_force[k];
    }
}

/* gamma sgn(D) |D|^a, times a power of the compression if asked for, in a closed contact, with D the relative velocity: pairwise,
 * so momentum is conserved. Beads do not stick: if damping would pull, the contact has no force. */
void bead_force_damped(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double *f)
{
    const struct bead_law *law = table->law->row;
    for (size_t k = 0; k < n; k++) {
        double d = table->static_compression[k] + (u[k] - u[k + 1]);
        double a = table->stiffness[k], force = law->force(a, table->law, d), rate = v[k] - v[k + 1];
        bool closed = a > 0 && (!law->one_sided || table->closed[k]);
        if (!closed && law->one_sided)
            force = 0;
        if (closed && rate != 0)
            force += bead_damping_force(table, d, rate);
        if (law->one_sided && force < 0)
            force = 0;
        f[k] = force - table->static_force[k];
    }
}

void bead_force_printed(size_t n, const struct bead_contact_table *table, const double *u, const double *, double *f)
{
    for (size_t k = 0; k < n; k++) {
        double d = table->static_compression[k] + (u[k] - u[k + 1]);
        f[k] = (d > 0 ? table->stiffness[k] * bead_three_halves(d) : 0) - table->static_force[k];
    }
}

void bead_accelerations_printed(size_t n, const double *f, const double *mass, double *a)
{
    for (size_t j = 0; j < n; j++)
        a[j] = f[(ptrdiff_t)j - 1] / mass[j] - f[j] / mass[j];
}
