/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of a movie, one after the other: layout, static layer, views.
 *
 *   bead_composer_create (any thread) -> bead_composer_open (the drawing thread: canvas, static layer)
 *   -> bead_composer_feed and bead_composer_draw, times rising -> bead_composer_close (the drawing thread) -> bead_composer_destroy
 */
#pragma once

#include "beadreel/chain.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/view.h"
#include "render/colour/colour_range.h"

struct bead_composer;
struct bead_preview; /* film.h */

/* Everything is borrowed and must outlive the composer. */
struct bead_composer_setup {
    const struct bead_output *output; /* a movie */
    const struct bead_chain *const *chains;
    size_t chain_count;
    const char *title;
    int width, height;
    double time[2], step;               /* s: first and last frame, and the least step between frames */
    const struct bead_film_clock *film; /* NULL: time is even */
    struct bead_colour_range range;     /* not empty; over, under: values may lie beyond it */
    const struct bead_scene *scene;
    const char *canvas;                  /* canvas back end; NULL: the first that works */
    double tolerance_factor;             /* of the comparison run of outputs with trust: see bead_run_context */
    const struct bead_text_watch *watch; /* gets all texts; NULL: none */
    bool interest;                       /* will bead_composer_interest be called? */
    bool held;                           /* frames show the largest forces since the one before */
    bool fine;                           /* see bead_view_setup */
    const struct bead_preview *preview;  /* all samples of the field, for images that show their future; NULL: none */
};

/* BEAD_FIELD_BITs that the views of an output need of samples. */
unsigned bead_composer_fields(const struct bead_output *output, const struct bead_chain *chain);
/* The fields that they also need from the comparison run; 0 without trust. */
unsigned bead_composer_comparison(const struct bead_output *output, const struct bead_chain *chain);
/* Does an output need more samples than frames, because a view averages over time or keeps the largest values? */
bool bead_composer_averages(const struct bead_output *output);

/* A note as drawn, px of the frame: its box, and the place of its tip. */
struct bead_note_box {
    double x, y, width, height, tip_x, tip_y;
};
enum { BEAD_NOTES_SHOWN = 32 }; /* at once */
struct bead_note_boxes {
    size_t count;
    struct bead_note_box box[BEAD_NOTES_SHOWN];
};
/* The boxes in the last frame drawn. */
const struct bead_note_boxes *bead_composer_notes(const struct bead_composer *composer);

/* Errors: SCENE (size, colour map), MEMORY, IO. On failure *composer is NULL. */
BEAD_CHECK enum bead_error bead_composer_create(const struct bead_composer_setup *setup, struct bead_composer **composer,
                                                struct bead_message *msg);
/* Errors: GRAPHICS, MEMORY, IO. */
BEAD_CHECK enum bead_error bead_composer_open(struct bead_composer *composer, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_composer_feed(struct bead_composer *composer, const struct bead_sample *sample,
                                              struct bead_message *msg);
/* Draws the title card, before the first draw; adds the changes. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_composer_card(struct bead_composer *composer, struct bead_changes *changes,
                                              struct bead_message *msg);
/* Brings the frame to `time`; adds the changes (the first time: everything). */
BEAD_CHECK enum bead_error bead_composer_draw(struct bead_composer *composer, double time, struct bead_changes *changes,
                                              struct bead_message *msg);
/* Called instead of draw for a frame that is not shown: later frames look as if it had been drawn. */
BEAD_CHECK enum bead_error bead_composer_pass(struct bead_composer *composer, double time, struct bead_message *msg);
/* The interest of the frame at `time`: for several chains, the difference of their values; for one, the mean distance of its values
 * from zero along the colour bar, weighted by how far views of all times have filled. Only if the setup asks for it. */
double bead_composer_interest(const struct bead_composer *composer, double time);
/* The static force of a bead (the mean of its contacts) or of a contact; 0 for other fields. */
double bead_force_at_rest(const struct bead_chain *chain, enum bead_field field, size_t index);
/* Takes a sample for the interest alone; and, before a call of it, brings it to the frame at the last sample. */
void bead_interest_feed(struct bead_composer *composer, const struct bead_sample *sample);
void bead_interest_advance(struct bead_composer *composer);
const struct bead_frame *bead_composer_frame(const struct bead_composer *composer);
/* The painter of the beads, known from bead_composer_open on; "": none is needed. */
const char *bead_composer_painter(const struct bead_composer *composer);
/* Frees the resources of the drawing thread. */
void bead_composer_close(struct bead_composer *composer);
void bead_composer_destroy(struct bead_composer *composer);
