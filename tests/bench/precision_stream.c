/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of solutions that programs in other languages write to a pipe.
 *   precision_stream --problem NAME             prints the problem: four columns; rows: beads, striker's velocity, early time, end;
 *                                               scale of displacements, 0, 0, 0; then mass, A, static compression and force of each
 *                                               bead and the contact behind it
 *   precision_stream NAME SOLVER SETTING        reads records of doubles: time, displacements, velocities; the last one has a
 *                                               negative time, then CPU seconds and evaluations; prints the row */
#include "sim/chain/chain_internal.h"
#include "tests/bench/precision_watch.h"

static void print_problem(const struct problem *problem)
{
    struct built built = build(problem->chain, "method: rk4");
    const struct bead_chain *c = built.chain;
    double v = c->spec->striker_velocity;
    printf("%zu %.17g %.17g %.17g\n", c->beads, v, problem->early, problem->end);
    printf("%.17g 0 0 0\n", v / bead_chain_omega(c, bead_chain_energy(c)));
    for (size_t j = 0; j < c->beads; j++)
        printf("%.17g %.17g %.17g %.17g\n", c->mass[j], c->stiffness[j], c->static_compression[j], c->static_force[j]);
    release(&built);
}

static int read_stream(const struct problem *problem, const char *solver, const char *setting)
{
    struct watch watch = watch_create(problem);
    size_t n = watch.built.chain->beads;
    double *record = calloc(2 * n + 1, sizeof *record);
    bool done = false;
    if (!record)
        GIVE_UP("out of memory");
    while (!done && fread(record, sizeof *record, 2 * n + 1, stdin) == 2 * n + 1) {
        done = record[0] < 0;
        if (!done)
            watch_step(&watch, record[0], record + 1, record + 1 + n);
    }
    if (done)
        watch_report(&watch, solver, setting, record[1], record[2]);
    free(record);
    watch_destroy(&watch);
    return done ? 0 : 1;
}

int main(int count, char **word)
{
    if (count == 3 && strcmp(word[1], "--problem") == 0)
        print_problem(find_problem(word[2]));
    else if (count == 4)
        return read_stream(find_problem(word[1]), word[2], word[3]);
    else
        GIVE_UP("precision_stream --problem NAME, or NAME SOLVER SETTING");
    return 0;
}
