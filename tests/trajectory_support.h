/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of trajectories and tables: sinks driven directly with made-up samples. */
#ifndef BEADREEL_TESTS_TRAJECTORY_SUPPORT_H
#define BEADREEL_TESTS_TRAJECTORY_SUPPORT_H

#include "support.h"

#include <dirent.h>
#include <hdf5.h>
#include <unistd.h>

#include "beadreel/sink.h"
#include "beadreel/trajectory.h"

#define ONE_CHAIN                                                                          \
    "chain: {beads: [{bead: large-steel, count: 5}, {bead: small-steel, sensor: first},\n" \
    "  {cell: [large-steel, aluminium], spins: \"101\"}], wall: brass}\n"
#define TWO_CHAINS                                                                                     \
    "chains:\n"                                                                                        \
    "  - {name: \"a, b\", beads: [{bead: large-steel, count: 9}, {bead: large-steel, sensor: end}]}\n" \
    "  - {name: c, precompression: 5 N, wall: brass, beads: [{bead: aluminium, sensor: one}, {bead: aluminium, count: 5}]}\n"

/* A scene, its chains, a sink of its only output, and a directory for files. */
struct stand {
    struct bead_scene *scene;
    struct bead_chain *chains[4];
    struct bead_run_context context;
    const struct bead_sink_type *type;
    struct bead_sink *sink;
    struct bead_needs needs;
    char directory[64], path[128], part[160];
    size_t next; /* sample */
    double *values[4][BEAD_FIELD_COUNT];
};

static inline double made_up(size_t chain, size_t field, size_t index, size_t j)
{
    return 1e-6 * sin(0.37 * (double)index + 1.7 * (double)j + 11.3 * (double)field + 0.9 * (double)chain) +
           1e-7 * (double)(field + 1);
}

static inline void make_directory(char *directory, size_t size)
{
    const char *top = getenv("TMPDIR");
    snprintf(directory, size, "%s/beadreel-XXXXXX", top && strlen(top) < 40 ? top : "/tmp");
    assert_non_null(mkdtemp(directory));
}

/* Number of files in the directory; they are removed if asked. */
static inline int count_files(const char *directory, bool remove_them)
{
    DIR *dir = opendir(directory);
    assert_non_null(dir);
    int count = 0;
    for (struct dirent *entry = readdir(dir); entry; entry = readdir(dir)) {
        if (entry->d_name[0] == '.')
            continue;
        count++;
        char path[512];
        snprintf(path, sizeof path, "%s/%s", directory, entry->d_name);
        if (remove_them)
            unlink(path);
    }
    closedir(dir);
    return count;
}

/* `output` is the one entry of the outputs, `simulate` may be "". The end of the run is `end` seconds. */
static inline enum bead_error try_set_up(struct stand *s, const char *chains, const char *output, double end,
                                         struct bead_message *msg)
{
    *s = (struct stand){.scene = NULL};
    char text[4096];
    snprintf(text, sizeof text, "%soutputs:\n  - {%s}\n", chains, output);
    if (bead_scene_parse("test.yaml", text, strlen(text), NULL, &s->scene, msg))
        fail_msg("%s", msg->text);
    for (size_t c = 0; c < s->scene->chain_count; c++)
        if (bead_chain_create(s->scene, c, &s->chains[c], msg))
            fail_msg("%s", msg->text);
    make_directory(s->directory, sizeof s->directory);
    s->context = (struct bead_run_context){.scene = s->scene,
                                           .chains = (const struct bead_chain *const *)s->chains,
                                           .chain_count = s->scene->chain_count,
                                           .end = end,
                                           .resolution = 2.7e-6,
                                           .threads = 1,
                                           .directory = s->directory};
    snprintf(s->path, sizeof s->path, "%s/%s", s->directory, s->scene->outputs[0].path);
    snprintf(s->part, sizeof s->part, "%s.part", s->path);
    for (const struct bead_sink_type *const *t = bead_data_sinks(); *t; t++)
        if ((*t)->kind == s->scene->outputs[0].kind && (*t)->create)
            s->type = *t;
    assert_non_null(s->type);
    for (size_t c = 0; c < s->scene->chain_count; c++)
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
            s->values[c][f] = calloc(bead_chain_beads(s->chains[c]), sizeof(double));
            assert_non_null(s->values[c][f]);
        }
    enum bead_error error = s->type->create(&s->scene->outputs[0], &s->context, &s->sink, msg);
    if (!error)
        s->type->needs(s->sink, &s->needs);
    return error;
}

static inline void begin(struct stand *s)
{
    struct bead_message msg = {""};
    if (s->type->begin(s->sink, (struct bead_range){0, 0}, &msg))
        fail_msg("%s", msg.text);
}

static inline void set_up(struct stand *s, const char *chains, const char *output, double end)
{
    struct bead_message msg = {""};
    if (try_set_up(s, chains, output, end, &msg))
        fail_msg("%s", msg.text);
    begin(s);
}

static inline enum bead_error deliver_one(struct stand *s, size_t chain, struct bead_message *msg)
{
    struct bead_sample sample = {.chain = chain, .index = s->next, .time = bead_grid_time(&s->needs.grid, s->next)};
    sample.active = bead_chain_beads(s->chains[chain]);
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        size_t count = bead_field_info(f)->of_contacts ? bead_chain_contacts(s->chains[chain]) : sample.active;
        for (size_t j = 0; j < count; j++)
            s->values[chain][f][j] = j < s->needs.beads.first || j > s->needs.beads.last ? NAN : made_up(chain, f, s->next, j);
        sample.field[f] = s->needs.fields & BEAD_FIELD_BIT(f) ? s->values[chain][f] : NULL;
    }
    return s->type->sample(s->sink, &sample, msg);
}

/* The next `count` samples of all chains. */
static inline void deliver(struct stand *s, size_t count)
{
    struct bead_message msg = {""};
    for (size_t i = 0; i < count; i++, s->next++)
        for (size_t c = 0; c < s->scene->chain_count; c++)
            if (deliver_one(s, c, &msg))
                fail_msg("%s", msg.text);
}

static inline struct bead_outcome made_outcome(size_t chain)
{
    double x = (double)(chain + 1);
    return (struct bead_outcome){.end = 0.1 * x,
                                 .front_arrival = 0.07 * x,
                                 .method = "rkn8",
                                 .step = 1e-7 * x,
                                 .steps = 1000 + chain,
                                 .evaluations = 123456 + chain,
                                 .energy_start = 0.3 * x,
                                 .energy_end = 0.29 * x,
                                 .momentum_start = 1.3 * x,
                                 .momentum_end = 1.2 * x,
                                 .energy_error = 1e-12 * x};
}

static inline void finish(struct stand *s)
{
    struct bead_message msg = {""};
    struct bead_outcome outcomes[4];
    for (size_t c = 0; c < 4; c++)
        outcomes[c] = made_outcome(c);
    if (s->type->end(s->sink, outcomes, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(access(s->part, F_OK), -1);
}

/* Checks that only `files` files are left. */
static inline void tear_down(struct stand *s, int files)
{
    if (s->sink)
        s->type->destroy(s->sink);
    for (size_t c = 0; c < 4; c++) {
        for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
            free(s->values[c][f]);
        bead_chain_destroy(s->chains[c]);
    }
    bead_scene_free(s->scene);
    assert_int_equal(count_files(s->directory, true), files);
    rmdir(s->directory);
}

static inline void copy_file(const char *from, const char *to, long bytes)
{
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
    assert_non_null(in);
    assert_non_null(out);
    for (int c = getc(in); c != EOF && bytes-- != 0; c = getc(in))
        putc(c, out);
    fclose(in);
    assert_int_equal(fclose(out), 0);
}

static inline struct bead_trajectory *open_file(const char *path)
{
    struct bead_message msg = {""};
    struct bead_trajectory *t = NULL;
    if (bead_trajectory_open(path, NULL, &t, &msg))
        fail_msg("%s", msg.text);
    return t;
}

#endif
