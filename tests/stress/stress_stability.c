/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest stable step of every method in units of 1/omega: by bisection on growing energy. For a uniform chain under
 * compression, whose vibrations are linear and reach omega, and for struck chains of random dimers, where omega is a bound. */
#include "sim/chain/chain_internal.h"
#include "tests/stress/stress.h"

/* Beads at rest are computed too; the striker of the linear chain hardly moves the beads. */
#define LINEAR                                                                                                                  \
    "chain: {striker: {bead: large-steel, velocity: 1e-6 m/s}, precompression: 10 N, wall: brass, beads: [{bead: large-steel, " \
    "count: 40}]}\n"

static const struct {
    const char *name, *chain;
    double times; /* length of the run in units of 1/omega */
} cases[] = {{"linear", LINEAR, 4000}, {"P4", P4_CHAIN, 4000}, {"P3", P3_CHAIN, 1500}};
enum { CASES = sizeof cases / sizeof *cases };

static bool is_stable(const struct bead_chain *chain, const struct bead_method *method, double omega, double theta, double times)
{
    struct bead_stepper *s;
    struct bead_message msg = {""};
    const double doubled = 2, check_every = 16;
    if (bead_stepper_create(chain, method, bead_kernels_find(NULL), true, &s, &msg))
        GIVE_UP("%s", msg.text);
    double h = theta / omega, start = bead_stepper_energy(s, &s->end), energy = start;
    for (double i = 1; i * theta <= times && energy <= doubled * start; i++) {
        bead_stepper_advance_by(s, h, i * h);
        if (fmod(i, check_every) == 0)
            energy = bead_stepper_energy(s, &s->end);
    }
    bool stable = energy <= doubled * start; /* false if it is not a number */
    bead_stepper_destroy(s);
    return stable;
}

static double largest_theta(const char *text, const struct bead_method *method, double times, int halvings)
{
    struct built built = build(text, "method: rk4");
    double omega = bead_chain_omega(built.chain, bead_chain_energy(built.chain)), low = 0.25, high = 16;
    if (!is_stable(built.chain, method, omega, low, times))
        high = low = 0;
    for (int i = 0; i < halvings && high > low; i++) {
        double middle = 0.5 * (low + high);
        *(is_stable(built.chain, method, omega, middle, times) ? &low : &high) = middle;
    }
    release(&built);
    return low;
}

int main(void)
{
    struct stress stress = stress_start();
    const struct bead_method_info *info;
    printf("Largest stable step in units of 1/omega, beside that of the method's table:\n");
    for (size_t i = 0; (info = bead_method_info(i)); i++) {
        double theta[CASES];
        for (size_t c = 0; c < CASES; c++)
            theta[c] = largest_theta(cases[c].chain, bead_method_row(info->name), cases[c].times / (stress.quick ? 4 : 1),
                                     stress.quick ? 9 : 11);
        /* A struck chain keeps omega only for moments, so it may allow more; never less. */
        bool ok = theta[0] >= 0.97 * info->theta_max && theta[1] >= 0.97 * info->theta_max && theta[2] >= 0.97 * info->theta_max;
        stress_row(&stress, ok, info->name, "%s %.2f, %s %.2f, %s %.2f; table %.2f", cases[0].name, theta[0], cases[1].name,
                   theta[1], cases[2].name, theta[2], info->theta_max);
    }
    return stress_end(&stress);
}
