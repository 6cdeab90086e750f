/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The problems with references, chains from scene text, reference tables: for tests, benchmark and stress. Before including this,
 * define GIVE_UP(format, ...), which reports a failure and does not return. */
#ifndef BEADREEL_TESTS_PROBLEMS_H
#define BEADREEL_TESTS_PROBLEMS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"
#include "sim/chain/chain_data.h"

#define P3_SPINS "1111011110110001000111111111110001011110000111101110111011011111"
/* P1 to P4; a `simulate:` section is added behind. */
#define P1_CHAIN "chain: {beads: [{bead: large-steel, count: 50}], wall: brass}\n"
#define P2_CHAIN "chain: {beads: [{cell: [large-steel, aluminium], count: 34}], wall: brass}\n"
#define P3_CHAIN "chain: {beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}], wall: brass}\n"
#define P4_CHAIN                                                                                     \
    "chain: {striker: {bead: large-steel, velocity: 0.02 m/s}, precompression: 10 N, wall: brass,\n" \
    "  beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}]}\n"
/* 500 beads in random dimers. */
#define LONG_CHAIN "chain: {beads: [{cell: [large-steel, aluminium], count: 250, spins: random, magnetism: 0, seed: 7}]}\n"

struct built {
    struct bead_scene *scene;
    struct bead_chain *chain;
};

/* A scene with one table output around `text`, and its chain. */
static inline enum bead_error try_build(const char *text, const char *simulate, struct built *built, struct bead_message *msg)
{
    char all[8192];
    *built = (struct built){NULL, NULL};
    snprintf(all, sizeof all, "%ssimulate: {%s}\noutputs: [{table: peaks.csv, show: peaks}]\n", text, simulate);
    enum bead_error err = bead_scene_parse("test", all, strlen(all), NULL, &built->scene, msg);
    return err ? err : bead_chain_create(built->scene, 0, &built->chain, msg);
}

static inline struct built build(const char *text, const char *simulate)
{
    struct bead_message msg = {""};
    struct built built;
    if (try_build(text, simulate, &built, &msg))
        GIVE_UP("%s", msg.text);
    return built;
}

static inline void release(struct built *built)
{
    bead_chain_destroy(built->chain);
    bead_scene_free(built->scene);
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
        GIVE_UP("cannot read %s", path);
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
    if (t.rows == 0)
        GIVE_UP("%s holds no rows", path);
    return t;
}

/* Largest relative deviation of contact peaks from a reference table (contact, force, time) of maxima; a force that still rises at
 * the end of the run is at least as large as its contact's. */
static inline double peak_error(const struct bead_peak *peaks, const struct table *reference)
{
    double worst = 0;
    for (size_t r = 0; r < reference->rows; r++) {
        const double *row = reference->value + r * reference->columns;
        const struct bead_peak *peak = &peaks[(size_t)row[0]];
        worst = fmax(worst, peak->open ? 1 - peak->value / row[1] : fabs(peak->value / row[1] - 1));
    }
    return worst;
}

#endif
