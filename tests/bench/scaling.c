/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cost and memory of long chains, and of many: cost of a bead in a step, and its memory, from 1e2 to 1e6 beads; an ensemble of
 * random chains on all cores; memory of the picture of a million beads.
 *
 *   scaling BUILD      writes BUILD/bench/scaling.csv, .png and .pdf
 *
 * BENCH_QUICK=1: up to 1e4 beads and few chains. */
#include <malloc.h>
#include <stdint.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/base/thread_pool.h"
#include "sim/run/run.h"
#include "tests/bench/scaling_plot.h"

/* Random numbers of a bead: nothing depends on who asks first. */
static double noise(uint64_t i)
{
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9u + 0x9e3779b97f4a7c15u;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebu;
    return (double)(i >> 11) * 0x1p-53 - 0.5;
}

static size_t memory_now(void)
{
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/* CPU seconds for each bead and step, all beads in disorderly motion: contacts open and close everywhere. */
static double cost_of(const struct bead_chain *chain, const char *method)
{
    const double bead_steps = quick() ? 1e6 : 3e7, h = 3e-6;
    const int warm = 30, steps = (int)fmax(20, bead_steps / (double)chain->beads);
    struct bead_message msg = {""};
    struct bead_stepper *s;
    if (bead_stepper_create(chain, bead_method_row(method), bead_kernels_find(NULL), true, &s, &msg))
        GIVE_UP("%s", msg.text);
    for (size_t j = 0; j < chain->beads; j++)
        s->end.v[j] = 0.1 * noise(j + 1);
    s->event_tolerance = 0.25e-6 * chain->spec->striker_velocity;
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    double start = 0;
    for (int i = 0; i < warm + steps; i++) {
        start = i == warm ? cpu_seconds() : start;
        bead_stepper_advance_by(s, h, s->t1 + h);
    }
    double cost = (cpu_seconds() - start) / steps / (double)chain->beads;
    bead_stepper_destroy(s);
    return cost;
}

static struct scaling_row measure(size_t beads)
{
    char text[256];
    size_t before = memory_now();
    snprintf(text, sizeof text,
             "chain: {beads: [{cell: [large-steel, aluminium], count: %zu, spins: random, magnetism: 0, seed: 5}]}\n", beads / 2);
    struct built built = build(text, "accuracy: 1e-6, until: 1 ms");
    struct bead_run_settings settings = {.chain = built.chain,
                                         .simulate = &built.scene->simulate,
                                         .kernels = bead_kernels_find(NULL),
                                         .end = 1e-3,
                                         .contact_peaks = true};
    struct bead_run *run;
    struct bead_message msg = {""};
    if (bead_run_create(&settings, &run, &msg))
        GIVE_UP("%s", msg.text);
    double memory = (double)(memory_now() - before) / (double)built.chain->beads;
    bead_run_destroy(run);
    struct scaling_row row = {beads, 1e9 * cost_of(built.chain, "rkn8"), 1e9 * cost_of(built.chain, "rkn8-plain"), memory};
    release(&built);
    return row;
}

/* ---- an ensemble ---- */

static enum bead_error one_chain(void *context, size_t index, bool calling, struct bead_message *msg)
{
    const size_t *cells = context;
    char text[256];
    struct built built;
    struct bead_run *run = NULL;
    (void)calling;
    snprintf(text, sizeof text,
             "chain: {beads: [{cell: [large-steel, aluminium], count: %zu, spins: random, magnetism: 0, seed: %zu}]}\n", *cells,
             index + 1);
    enum bead_error err = try_build(text, "accuracy: 1e-6", &built, msg);
    struct bead_run_settings settings = {.chain = built.chain,
                                         .simulate = &built.scene->simulate,
                                         .kernels = bead_kernels_find(NULL),
                                         .end = INFINITY,
                                         .passage = true,
                                         .contact_peaks = true};
    if (!err)
        err = bead_run_create(&settings, &run, msg);
    while (!err && isnan(bead_run_arrival(run)))
        err = bead_run_step(run, msg);
    bead_run_destroy(run);
    release(&built);
    return err;
}

static double wall_seconds(void)
{
    struct timespec now;
    if (clock_gettime(CLOCK_MONOTONIC, &now))
        GIVE_UP("no clock");
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void ensemble(size_t chains, size_t cells)
{
    struct bead_message msg = {""};
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int threads = cores > 0 ? (int)cores : 1;
    double cpu = cpu_seconds(), wall = wall_seconds();
    if (bead_thread_pool_run(chains, threads, one_chain, &cells, &msg))
        GIVE_UP("%s", msg.text);
    cpu = cpu_seconds() - cpu;
    wall = wall_seconds() - wall;
    printf("ensemble: %zu random chains of %zu beads until the pulse has passed, 1e-6: %.2f s CPU, %.2f s wall on %d threads, "
           "%.2f ms a chain\n",
           chains, 2 * cells, cpu, wall, threads, 1e3 * cpu / (double)chains);
}

/* ---- the picture of a long chain ---- */

static void run_program(const char *build, const char *scene, const char *out)
{
    char program[512];
    snprintf(program, sizeof program, "%s/beadreel", build);
    if (!freopen("/dev/null", "w", stdout))
        _exit(1);
    execl(program, program, scene, "-o", out, (char *)NULL);
    _exit(127);
}

static void picture(const char *build, size_t beads)
{
    char scene[] = "/tmp/beadreel-scaling-XXXXXX", out[64];
    int fd = mkstemp(scene), status = 0;
    FILE *file = fd < 0 ? NULL : fdopen(fd, "w");
    if (!file)
        GIVE_UP("no scratch file");
    snprintf(out, sizeof out, "%s.out", scene);
    fprintf(file,
            "chain: {beads: [{bead: large-steel, count: %zu}]}\nsimulate: {until: 0.2 ms}\n"
            "outputs: [{image: force.png, field: force, time: [0, 0.2 ms], every: 1 us}]\n",
            beads);
    fclose(file);
    double wall = wall_seconds();
    fflush(stdout); /* the child must not write it again */
    pid_t child = fork();
    if (child == 0)
        run_program(build, scene, out);
    struct rusage usage = {.ru_maxrss = 0};
    if (child < 0 || wait4(child, &status, 0, &usage) != child)
        GIVE_UP("beadreel cannot be started");
    printf("picture: of a chain of %zu beads, 0.2 ms: %s, %.2f s, %.0f MB\n", beads, status == 0 ? "done" : "FAILED",
           wall_seconds() - wall, (double)usage.ru_maxrss / 1024);
    unlink(scene);
    char path[96];
    snprintf(path, sizeof path, "%s/force.png", out);
    unlink(path);
    rmdir(out);
}

int main(int count, char **word)
{
    enum { MOST = 16 };
    struct scaling_row rows[MOST];
    size_t n = 0, last = quick() ? 10000 : 1000000;
    const char *folder = count > 1 ? word[1] : "build";
    printf("beads,ns_per_bead_step,ns_per_bead_step_plain,bytes_per_bead\n");
    for (double beads = 100; beads < 1.1 * (double)last && n < MOST; beads *= sqrt(10)) {
        rows[n] = measure((size_t)lround(beads / 2) * 2);
        printf("%zu,%.2f,%.2f,%.0f\n", rows[n].beads, rows[n].cost, rows[n].plain, rows[n].memory);
        fflush(stdout);
        n++;
    }
    scaling_write(folder, rows, n);
    ensemble(quick() ? 20 : 2000, 256);
    picture(folder, last);
    return 0;
}
