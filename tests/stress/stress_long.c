/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ten million steps of ten beads that bounce between two walls for ever. Chaos makes the motion itself unpredictable, but energy
 * must be conserved. The wall at the left is the striker, at rest and immovable. */
#include "sim/chain/chain_internal.h"
#include "tests/stress/stress.h"

/* The striker's velocity is that which the first bead gets: energies are judged by it. */
#define BOUNCING                                                                                                                   \
    "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, wall: brass, beads: [{cell: [large-steel, aluminium], count: 5,\n" \
    "  spins: random, magnetism: 0.2, seed: 3}]}\n"

/* Relative drift of energy allowed over the whole run. */
static const struct {
    const char *method;
    double theta, energy;
} cases[] = {
    {"rkn8", 0.25, 1e-8},  {"rkn8", 0.5, 1e-6},  {"rkn8", 1, 1e-3},   {"rkn8-plain", 0.25, 1e-2},
    {"rkn12", 0.25, 1e-2}, {"pefrl", 0.1, 1e-2}, {"rk4", 0.05, 1e-2},
};

static void start(struct bead_stepper *s)
{
    s->end.v[0] = 0;
    s->end.v[1] = s->chain->spec->striker_velocity;
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
}

static void bounce(struct stress *stress, size_t index, double steps)
{
    struct built built = build(BOUNCING, "method: rk4");
    struct bead_stepper *s;
    struct bead_message msg = {""};
    char name[64];
    const struct bead_method *method = bead_method_row(cases[index].method);
    built.chain->inverse_mass[0] = 0;
    if (!method || bead_stepper_create(built.chain, method, bead_kernels_find(NULL), true, &s, &msg))
        GIVE_UP("%s", msg.text);
    start(s);
    double energy = bead_stepper_energy(s, &s->end), worst = 0;
    double h = cases[index].theta / bead_chain_omega(built.chain, energy), began = cpu_seconds();
    const double check_every = 1000;
    bool in_time = true;
    for (double i = 1; i <= steps && in_time; i++) {
        bead_stepper_advance_by(s, h, i * h);
        if (fmod(i, check_every) != 0)
            continue;
        double off = fabs(bead_stepper_energy(s, &s->end) / energy - 1);
        worst = off <= worst ? worst : off; /* stays not a number */
        in_time = cpu_seconds() - began < 2 * most_seconds;
    }
    snprintf(name, sizeof name, "%s, step %g / omega", cases[index].method, cases[index].theta);
    bool ok = in_time && worst <= cases[index].energy;
    stress_row(stress, ok, name, "%.0e steps, %5.2f s of motion, energy %.1e, %.2f us a step%s", steps, steps * h, worst,
               (cpu_seconds() - began) / (double)s->steps * 1e6, in_time ? "" : ", TOO LONG");
    bead_stepper_destroy(s);
    release(&built);
}

int main(void)
{
    struct stress stress = stress_start();
    printf("Ten beads bouncing between walls:\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        bounce(&stress, i, stress.quick ? 1e5 : i == 0 ? 1e7 : 1e6);
    return stress_end(&stress);
}
