/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of outputs: the type of each says what it is called, which keys it has, how they are checked, and what sets the kind apart.
 * Parser, help, messages, --set, --info and sessions ask the types. */
#ifndef BEADREEL_SIM_SCENE_OUTPUT_KINDS_H
#define BEADREEL_SIM_SCENE_OUTPUT_KINDS_H

#include "sim/scene/options.h"

enum { BEAD_OUTPUT_CHECKS = 8 };

/* What the keys of one output must fit together in, and with its scene. */
#define BEAD_OUTPUT_CHECK(name) \
    enum bead_error name(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)

struct bead_output_type {
    /* Their first row is the kind's own key, which has the file as its value. */
    const struct bead_options *options;               /* in scenes that are run once; NULL: the kind needs a sweep */
    const struct bead_options *sweep_options;         /* in scenes with sweeps; NULL: it shows a single run */
    BEAD_OUTPUT_CHECK((*checks[BEAD_OUTPUT_CHECKS])); /* in scenes that are run once, in this order; NULL behind the last */
    BEAD_OUTPUT_CHECK((*check_sweep));                /* in scenes with sweeps; NULL: nothing to check */
    bool shows;                                       /* has `show`: bead_output_show */
    bool stores_samples;                              /* of a run: pictures can be drawn from its file */
    bool stores_sweep;                                /* all results of a sweep */
    bool draws;
};

/* The type of a kind, and its key: "image". */
const struct bead_output_type *bead_output_type(enum bead_output_kind kind);
const char *bead_output_key(enum bead_output_kind kind);
/* How files of a kind end: ".png, .pdf or .svg". */
const char *bead_output_endings(enum bead_output_kind kind);
/* The file that an output makes besides its own, as its path, and the key that asks for it; "": none. */
const char *bead_output_second(const struct bead_output *output, const char **key);
/* Does a file end like one of these? */
bool bead_output_ends_like(const char *endings, const char *path);

/* Output number `index` of the scene alone, as the text of a list of outputs: `[{image: x.png, ...}]`; to be freed. Errors: MEMORY.
 */
BEAD_CHECK enum bead_error bead_scene_single_output(const struct bead_scene *scene, size_t index, char **outputs,
                                                    struct bead_message *msg);

/* What plots and tables can show: one row a value of `show`. */
struct bead_show_type {
    const char *const *keys;      /* that it takes besides those of all plots and tables */
    const char *why_not;          /* it takes no others */
    const char *not_of_equations; /* why it is of beads only; NULL: of equations, too */
    unsigned ends;                /* bits of the kinds that need to know the end of the run before it starts */
    bool drawing;                 /* of the scene, with keys of its own; nothing is computed */
    bool modes;                   /* energies of modes */
    bool of_field;                /* the output's `field` */
    bool own_times;               /* no samples but its own are close enough */
};
/* What the output shows; NULL: its kind has no `show`. */
const struct bead_show_type *bead_output_show(const struct bead_output *output);

/* Panels have the keys of images or plots but for those of files. */
extern const struct bead_option_family bead_output_family;
extern const struct bead_options bead_image_panel_options, bead_plot_panel_options, bead_panel_options;

#endif
