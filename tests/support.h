/* What the tests of the computing half share: scenes from text, runs to a time, reference tables. */
#ifndef BEADREEL_TESTS_SUPPORT_H
#define BEADREEL_TESTS_SUPPORT_H

/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "sim/chain_data.h"
#include "sim/run.h"
#include "sim/stepper.h"

#define P3_SPINS "1111011110110001000111111111110001011110000111101110111011011111"
/* The four problems that references exist for; a `simulate:` section is added behind. */
#define P1_CHAIN "chain: {beads: [{bead: large-steel, count: 50}], wall: brass}\n"
#define P2_CHAIN "chain: {beads: [{cell: [large-steel, aluminium], count: 34}], wall: brass}\n"
#define P3_CHAIN "chain: {beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}], wall: brass}\n"
#define P4_CHAIN                                                                                                                          \
    "chain: {striker: {bead: large-steel, velocity: 0.02 m/s}, precompression: 10 N, wall: brass,\n"                                      \
    "  beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}]}\n"

struct built {
    struct bead_scene *scene;
    struct bead_chain *chain;
};

/* A scene with one table output around `text`. */
static inline struct built build(const char *text, const char *simulate)
{
    char all[8192];
    struct bead_message msg = {""};
    struct built built = {NULL, NULL};
    snprintf(all, sizeof all, "%ssimulate: {%s}\noutputs: [{table: peaks.csv, show: peaks}]\n", text, simulate);
    if (bead_scene_parse("test", all, strlen(all), NULL, 0, &built.scene, &msg) || bead_chain_create(built.scene, 0, &built.chain, &msg))
        fail_msg("%s", msg.text);
    return built;
}

static inline void release(struct built *built)
{
    bead_chain_destroy(built->chain);
    bead_scene_free(built->scene);
}

/* A run of `built`'s chain, not stepped yet. */
static inline struct bead_run *start_run(const struct built *built, struct bead_run_settings settings)
{
    struct bead_message msg = {""};
    struct bead_run *run = NULL;
    settings.chain = built->chain;
    settings.kernels = settings.kernels ? settings.kernels : bead_kernels_find(NULL);
    if (bead_run_create(&settings, &run, &msg))
        fail_msg("%s", msg.text);
    return run;
}

static inline void run_until(struct bead_run *run, double time)
{
    struct bead_message msg = {""};
    while (bead_run_time(run) < time) {
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
    }
}

/* Fields of all beads at a time within the last step. */
static inline struct bead_sample sample_at(struct bead_run *run, double time)
{
    struct bead_sample sample = {0};
    struct bead_message msg = {""};
    unsigned all = (1u << BEAD_FIELD_COUNT) - 1;
    if (bead_run_sample(run, time, all, (struct bead_span){0, SIZE_MAX - 1}, &sample, &msg))
        fail_msg("%s", msg.text);
    return sample;
}

/* Rows of numbers of a CSV file below tests/reference, `columns` each; comments and the heading are passed over. */
struct table {
    size_t rows, columns;
    double *value;
};

static inline struct table read_table(const char *name, size_t columns)
{
    char path[256], line[4096];
    snprintf(path, sizeof path, "%s/%s", getenv("BEADREEL_REFERENCE") ? getenv("BEADREEL_REFERENCE") : "tests/reference", name);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("cannot read %s", path);
    struct table t = {0, columns, NULL};
    while (fgets(line, sizeof line, file)) {
        if (!(line[0] == '-' || (line[0] >= '0' && line[0] <= '9')))
            continue;
        t.value = realloc(t.value, (t.rows + 1) * columns * sizeof *t.value);
        char *at = line;
        for (size_t c = 0; c < columns; c++, at += *at == ',')
            t.value[t.rows * columns + c] = strtod(at, &at);
        t.rows++;
    }
    fclose(file);
    assert_true(t.rows > 0);
    return t;
}

/* Largest relative deviation of contact peaks from a reference table (contact, force, time). */
static inline double peak_error(const struct bead_peak *peaks, const struct table *reference)
{
    double worst = 0;
    for (size_t r = 0; r < reference->rows; r++) {
        const double *row = reference->value + r * reference->columns;
        worst = fmax(worst, fabs(peaks[(size_t)row[0]].value / row[1] - 1));
    }
    return worst;
}

#define assert_below(value, limit)                                                                                                        \
    do {                                                                                                                                  \
        double got_ = (value), limit_ = (limit);                                                                                          \
        if (!(got_ < limit_))                                                                                                             \
            fail_msg("%s is %.6g, not below %.6g", #value, got_, limit_);                                                                 \
    } while (0)
#define assert_near(value, wanted, tolerance)                                                                                             \
    do {                                                                                                                                  \
        double got_ = (value), wanted_ = (wanted);                                                                                        \
        if (!(fabs(got_ - wanted_) <= (tolerance)))                                                                                       \
            fail_msg("%s is %.15g, not %.15g to %.3g", #value, got_, wanted_, (double)(tolerance));                                       \
    } while (0)

#endif
