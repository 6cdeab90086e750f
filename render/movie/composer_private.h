/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of a composer: composer.c, movie_measure.c (and cameras), movie_shown.c (fields,
 * beads, interest), movie_names.c (names of chains), movie_inset.c (cells), movie_overlay.c (the parts over and around the views).
 */
#pragma once

#include <cairo.h>

#include "render/movie/composer.h"
#include "render/movie/movie_layout.h"
#include "render/movie/movie_words.h"
#include "render/paint/canvas.h"
#include "render/view/held.h"

struct bead_composer {
    struct bead_composer_setup setup;
    struct bead_look look;
    struct bead_colormap map;
    struct bead_colours colours;
    struct bead_clock clock;
    double magnify;
    struct bead_movie_wants wants;
    struct bead_movie_layout layout;
    bool name_left;               /* see bead_view_setup */
    struct bead_camera **cameras; /* of the chains; NULL: none follows */
    struct bead_view **views;     /* chain c's begin at c * wants.view_count; NULL: there is no room for it */
    struct bead_facts facts;
    struct bead_canvas *canvas;
    char painter[64]; /* of the canvas; "": nothing is painted on one */
    struct bead_frame frame, background;
    cairo_surface_t *surface; /* of the frame */
    cairo_t *cr;
    char time_text[256], badge_text[256]; /* as currently shown */
    int passed;                           /* px of the line of progress */
    bool carded, started;                 /* the card has been drawn; the static layer has been */
    bool trust_said;
    struct bead_note_boxes notes;
    size_t caption;          /* currently shown; SIZE_MAX: none */
    struct bead_held **held; /* of the chains: samples since the last frame; NULL: views are fed each sample */
    double *fed;             /* [chain][fed_room]: values as of the last samples, for bead_composer_interest; NULL: no poster */
    size_t fed_room;
    struct bead_film_clock even; /* of setups without one */
};

/* The beads shown, even if the field belongs to contacts. */
struct bead_span bead_composer_beads(const struct bead_composer *composer, size_t chain);
/* The values shown. */
struct bead_span bead_composer_span(const struct bead_composer *composer, size_t chain);
/* Chooses the look, with type of this part of its usual size. */
void bead_composer_dress(struct bead_composer *composer, double type);
/* Finds the layout, and the look if type becomes smaller. Errors: SCENE, UNSUPPORTED (views). */
BEAD_CHECK enum bead_error bead_composer_arrange(struct bead_composer *composer, struct bead_message *msg);
/* px: room of the key of a chain's stage; 0: there is none. */
double bead_composer_key(const struct bead_composer *composer, size_t chain);
/* Are the curves of several chains on one axis, told apart by colours? */
bool bead_composer_shares_curves(const struct bead_composer *composer);
/* Draws the heading of a chain, and its name above its image. */
void bead_composer_draw_names(const struct bead_composer *composer, size_t chain, cairo_t *cr);
/* Draws the key of all stages of a grid. */
void bead_composer_draw_key(const struct bead_composer *composer, cairo_t *cr);
/* The least width of a picture in the picture, px; 0: none. */
double bead_inset_width(const struct bead_composer *composer);
/* Is there a cell to draw, and room for it? Errors: SCENE. */
BEAD_CHECK enum bead_error bead_inset_check(const struct bead_composer *composer, struct bead_message *msg);
/* Draws it into the static layer. Errors: SCENE (no room), MEMORY. */
BEAD_CHECK enum bead_error bead_inset_draw(const struct bead_composer *composer, cairo_t *cr, struct bead_message *msg);
/* Markup such as "force (N)". */
void bead_composer_bar_title(const struct bead_composer *composer, char *out, size_t size);
/* Creates a camera for each chain; plots that follow the front become narrower if their rows of beads would be too high. Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error bead_composer_cameras(struct bead_composer *composer, struct bead_message *msg);
/* Makes room for samples between frames. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_composer_hold(struct bead_composer *composer, struct bead_message *msg);
/* Keeps values for the poster. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_interest_open(struct bead_composer *composer, struct bead_message *msg);
/* Takes the values of a sample for it. */
void bead_interest_keep(struct bead_composer *composer, const struct bead_sample *sample);
/* Draws the colour bar into the static layer. */
void bead_overlay_draw_bar(struct bead_composer *composer, cairo_t *cr);
/* Bring the parts of the frame around the views to `time`; each adds its changes. */
void bead_overlay_time(struct bead_composer *composer, double time, struct bead_changes *changes);
void bead_overlay_trust(struct bead_composer *composer, double time, struct bead_changes *changes);
void bead_overlay_progress(struct bead_composer *composer, double time, struct bead_changes *changes);
/* Call it after the views. */
void bead_overlay_notes(struct bead_composer *composer, double time, struct bead_changes *changes);
void bead_overlay_caption(struct bead_composer *composer, double time, struct bead_changes *changes);
