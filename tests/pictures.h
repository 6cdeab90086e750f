/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of pictures: a small chain, made-up samples of it, a directory, PNG read back. */
#ifndef BEADREEL_TESTS_PICTURES_H
#define BEADREEL_TESTS_PICTURES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/chain.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"

/* Ten beads (0 to 9) between a striker and a brass wall, 1 ms. */
struct built {
    struct bead_scene *scene;
    struct bead_chain *chain;
};
/* `output`: inside of the braces; "" for a table. */
struct built build_chain(const char *output);
void release_chain(struct built *built);
/* Known before a run, with samples every 1 us at least. */
struct bead_run_context make_stage(const struct built *built);

/* A made-up sample of all fields, moving from bead to bead. */
struct bead_sample *make_sample(const struct built *built, double time);
void free_sample(struct bead_sample *sample);

/* A field's values over the chain at a time. */
typedef double (*made_up)(size_t bead, double time);
/* 10 N at bead j from 0.1 j ms to 0.1 (j + 1) ms, except for 5 us of rise and fall. */
double pulse_down_the_chain(size_t bead, double time);
/* The first output of the scene from such values. */
void draw_output(const struct built *built, made_up values);

int make_directory(void **state);
int remove_directory(void **state);
void in_directory(const char *name, char *path, size_t size);
void assert_no_part_files(void);
char *read_all(const char *path, size_t *length);

struct png_file {
    int width, height, colour_type;
    unsigned per_metre;
    bool srgb;
    char title[128], source[128];
    uint8_t *rgb; /* to be freed */
};
struct png_file read_png(const char *path);
/* Nothing is drawn on the outermost pixels of `what`. */
void assert_border_white(const struct png_file *png, const char *what);

#endif
