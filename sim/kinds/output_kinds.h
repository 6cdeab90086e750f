/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of outputs: the type of each has its name, its keys, their checks, and its traits. Parser, help, messages, --set, --info
 * and sessions ask the types. */
#pragma once

#include "sim/base/internal.h"
#include "sim/options/options.h"

enum { BEAD_OUTPUT_CHECKS = 9 };

/* A check of the keys of an output against each other and against its scene. */
#define BEAD_OUTPUT_CHECK(name) \
    enum bead_error name(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)

/* The source of `-o FILE`. */
enum bead_source_kind {
    BEAD_OF_RUN,
    BEAD_OF_CONFIGURATION, /* of a sweep, run again */
    BEAD_OF_TRAJECTORY,
    BEAD_OF_TRAJECTORIES, /* side by side */
    BEAD_OF_DIFFERENCE,   /* of two */
    BEAD_OF_SWEEP,
    BEAD_OF_CONFIGURATIONS, /* many of them: --sheet */
    BEAD_SOURCES
};

struct bead_output_type {
    /* Their first row is the kind's own key, which has the file as its value. */
    const struct bead_options *options;               /* in scenes that are run once; NULL: the kind needs a sweep */
    const struct bead_options *sweep_options;         /* in scenes with sweeps; NULL: it shows a single run */
    BEAD_OUTPUT_CHECK((*checks[BEAD_OUTPUT_CHECKS])); /* in scenes that are run once, in this order; NULL after the last */
    BEAD_OUTPUT_CHECK((*check_sweep));                /* in scenes with sweeps; NULL: nothing to check */
    bool shows;                                       /* has `show`: bead_output_show */
    bool stores_samples;                              /* of a run: pictures can be drawn from its file */
    bool stores_sweep;                                /* all results of a sweep */
    bool draws;
    bool only_in_scenes;                /* of a sweep, or of several trajectories: a file name alone means another kind */
    bool shows_configurations;          /* of a sweep, or of a chain that could be one: --sheet */
    const char *shown_of[BEAD_SOURCES]; /* the `show` that only a file name asks for; NULL: its default */
};

/* The type of a kind, and its key: "image". */
const struct bead_output_type *bead_output_type(enum bead_output_kind kind);
const char *bead_output_key(enum bead_output_kind kind);
/* The key of an output; for outputs of a program's own sinks, the name of the sink. */
const char *bead_output_kind_name(const struct bead_output *output);
/* The program's own sink for files with this ending; NULL: none. */
const struct bead_sink_type *bead_output_own_of(const struct bead_own *own, const char *file);
/* The file endings of a kind: ".png, .pdf, .svg or .eps". */
const char *bead_output_endings(enum bead_output_kind kind);
/* Can outputs of a kind be made from it? */
bool bead_output_made_of(enum bead_output_kind kind, enum bead_source_kind source);
/* For stills made of pixels. */
#define BEAD_PIXEL_ENDINGS ".png, .jpg, .jpeg, .tif, .tiff, .webp or .avif"
/* Does an ending alone mean this kind? */
bool bead_output_ending_means(enum bead_output_kind kind, enum bead_source_kind source);
/* The kind that a file's ending asks for: the first that can be made. BEAD_OUTPUT_KINDS: none. */
enum bead_output_kind bead_output_kind_of(const char *file, enum bead_source_kind source);
/* The path of the second file that an output makes, and the key that asks for it; "": none. */
const char *bead_output_second(const struct bead_output *output, const char **key);
/* Does a file end like one of these? */
BEAD_INTERNAL bool bead_output_ends_like(const char *endings, const char *path);

/* The contents of plots and tables: one row for each value of `show`. */
struct bead_show_type {
    const char *const *keys;      /* that it takes in addition to those of all plots and tables */
    const char *why_not;          /* it takes no others */
    const char *without_contacts; /* why it needs contacts; NULL: it does not */
    unsigned ends;                /* bits of the kinds that need to know the end of the run before it starts */
    bool drawing;                 /* of the scene, with its own keys; nothing is computed */
    bool modes;                   /* energies of modes */
    bool of_field;                /* the output's `field` */
    bool vibrations;              /* of the chain at rest, whose contacts must be closed; nothing is run */
    bool of_places;               /* of the beads and contacts listed, or of sensors */
    bool of_run;                  /* kept by a run: no trajectory has it */
    bool of_motion;               /* its field is velocity by default */
    bool own_times;               /* only its own samples are close enough */
    bool of_powers;               /* it shows powers of time: its times widen */
};
BEAD_INTERNAL const struct bead_show_type *bead_show_type(enum bead_show show);
/* The `show` of a single run that curves of a sweep's chains correspond to; BEAD_SHOW_COUNT: there is none. */
BEAD_INTERNAL enum bead_show bead_sweep_lines(enum bead_sweep_show show);
/* Does an output of a sweep show numbers from chains that run for it, instead of peaks? */
BEAD_INTERNAL bool bead_sweep_runs_own(const struct bead_sweep_curves_asked *asked);
/* Passes on an error of what knows no scene: SCENE with the place in the output that `why` begins with. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_output_tell(const struct bead_output *output, enum bead_error err,
                                                          const struct bead_message *why, struct bead_message *msg);
/* The row of the output's `show`; NULL: its kind has no such key. */
const struct bead_show_type *bead_output_show(const struct bead_output *output);

/* All tables of outputs, those of panels last; NULL after them. */
const struct bead_options *bead_output_options(size_t index);

/* Panels have the keys of images or plots, except those of files. */
extern const struct bead_option_family bead_output_family;
extern const struct bead_options bead_image_panel_options, bead_plot_panel_options, bead_panel_options;
/* Maps within the keys of movies. */
extern const struct bead_options bead_caption_options, bead_note_options, bead_speed_options, bead_card_options;
