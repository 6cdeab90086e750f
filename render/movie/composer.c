/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Composes the frames of a movie: lays out, creates the views and draws the static layer once; then views and overlay update each
 * frame. */
#include "render/movie/composer_private.h"

#include <math.h>
#include <stdlib.h>

#include "render/colour/colour_range.h"
#include "render/draw/looks.h"
#include "render/draw/raster.h"
#include "render/draw/words.h"
#include "render/movie/film.h"
#include "render/stage/camera.h"
#include "render/stage/magnify.h"
#include "render/stage/stage_key.h"
#include "sim/base/memory.h"
#include "sim/chain/system.h"
#include "sim/kinds/view_kinds.h"

/* Views are numbered chain by chain. */
static size_t view_count(const struct bead_composer *c)
{
    return c->wants.chain_count * c->wants.view_count;
}

static const struct bead_view_type *type_of(const struct bead_composer *c, size_t index)
{
    return c->wants.views[index % c->wants.view_count];
}

static struct bead_rect plot_of(const struct bead_composer *c, size_t index)
{
    return c->layout.chains[index / c->wants.view_count].plot[index % c->wants.view_count];
}

/* Is the view an image that knows all samples before the first frame? */
static bool previewed(const struct bead_composer *c, size_t index)
{
    return c->setup.preview && bead_view_has(type_of(c, index), BEAD_SHOWS_IMAGE);
}

/* Is this plot directly above or below one of beads? */
static bool over_beads(const struct bead_composer *c, const struct bead_movie_chain *place, size_t view)
{
    bool over = false;
    for (size_t v = 0; v < c->wants.view_count; v++)
        over = over || (bead_view_has(c->wants.views[v], BEAD_SHOWS_BEADS) && place->plot[v].x == place->plot[view].x &&
                        place->plot[v].width == place->plot[view].width);
    return over;
}

static struct bead_view_setup setup_of(const struct bead_composer *c, size_t index)
{
    size_t chain = index / c->wants.view_count, view = index % c->wants.view_count;
    const struct bead_output *output = c->setup.output;
    const struct bead_movie_chain *place = &c->layout.chains[chain];
    enum bead_view_across across = bead_movie_across(&c->wants, view);
    const bool stage = c->layout.layout == BEAD_LAYOUT_STAGE;
    const bool curve = bead_view_has(type_of(c, index), BEAD_OVERLAYS) && view == c->layout.overlay;
    bool time = across == BEAD_ACROSS_TIME, labels = place->labels[view], along = across == BEAD_ACROSS_CHAIN;
    return (struct bead_view_setup){
        .chain = c->setup.chains[chain],
        .chain_index = chain,
        .field = output->shown.field,
        .beads = bead_composer_span(c, chain),
        .time = {c->setup.time[0], c->setup.time[1]},
        .colours = c->colours,
        .look = &c->look,
        .axes = c->layout.axes,
        .ticks_only = !place->values[view],
        .titles = c->layout.titles ? BEAD_TITLES_ABOVE : BEAD_TITLES_NONE,
        .name_left = c->name_left,
        .beyond = {along ? c->layout.beyond[0] : 0, along ? c->layout.beyond[1] : 0},
        .head = c->layout.head,
        .small = c->layout.grid,
        .elsewhere = c->layout.key.width > 0 ? BEAD_KEY_LIGHT | BEAD_KEY_MATERIALS
                                             : bead_stage_key_elsewhere(c->setup.chains, c->setup.chain_count, chain),
        .own_colour = bead_composer_shares_curves(c),
        .bead_labels = labels && !time,
        .orientation = c->wants.orientation,
        .time_shared = time && !labels,
        .against = c->layout.against,
        .fill = true,
        .hold = stage,
        .cells = output->movie.profile == BEAD_PROFILE_CELL,
        .ghost = previewed(c, index),
        .magnify = c->magnify,
        .over_beads = along && over_beads(c, place, view),
        .light = output->views.light,
        .fine = c->setup.fine,
        .camera = c->cameras && !(stage && bead_view_has(type_of(c, index), BEAD_OVERLAYS)) ? c->cameras[chain] : NULL,
        .modes = output->movie.modes,
        .trust = output->shown.trust,
        .theory = output->shown.theory,
        .coloured = curve ? c->layout.colours : 0,
        .sampling = c->held && bead_held_shows(output->shown.field) ? BEAD_SAMPLING_MAX : BEAD_SAMPLING_AREA};
}

/* Does the view of the first chain draw this one? */
static bool overlaid(const struct bead_composer *c, size_t index)
{
    return index >= c->wants.view_count && index % c->wants.view_count == c->layout.overlay;
}

static enum bead_error create_views(struct bead_composer *c, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&c->views, view_count(c) + 1, msg, "views"));
    for (size_t i = 0; i < view_count(c); i++) {
        struct bead_view_setup setup = setup_of(c, i);
        if (plot_of(c, i).width == 0)
            continue;
        BEAD_TRY(type_of(c, i)->create(&setup, &c->views[i], msg));
        if (overlaid(c, i))
            BEAD_TRY(type_of(c, i)->overlay(c->views[i % c->wants.view_count], c->views[i], msg));
    }
    return BEAD_OK;
}

static enum bead_error composer_fill(struct bead_composer *c, struct bead_message *msg)
{
    const struct bead_output *output = c->setup.output;
    bead_composer_dress(c, 1);
    BEAD_TRY(bead_colour_range_map(output, c->setup.chains[0], c->look.dark, c->setup.range.rest > 0, &c->map, msg));
    c->colours = bead_colour_range_colours(output, &c->setup.range, &c->map);
    c->clock = bead_clock_make(c->setup.time[1], c->setup.step, bead_chain_time_unit(c->setup.chains[0]));
    double span = c->setup.time[1] - c->setup.time[0];
    c->even.slowed = span > 0 ? 10 / span : 1;
    c->setup.film = c->setup.film ? c->setup.film : &c->even;
    c->caption = SIZE_MAX;
    c->magnify = output->views.magnify > 0 ? output->views.magnify : bead_magnify_auto(c->setup.chains, c->setup.chain_count);
    c->facts = (struct bead_facts){.film = c->setup.film,
                                   .clock = c->clock,
                                   .magnify = bead_views_any(&output->views, BEAD_SHOWS_BEADS) ? c->magnify : 0,
                                   .chains = c->setup.chains,
                                   .chain_count = c->setup.chain_count,
                                   .held = c->setup.held};
    if (c->setup.interest)
        BEAD_TRY(bead_interest_open(c, msg));
    if (c->setup.held)
        BEAD_TRY(bead_composer_hold(c, msg));
    BEAD_TRY(bead_composer_arrange(c, msg));
    BEAD_TRY(bead_inset_check(c, msg));
    if (c->wants.follow)
        BEAD_TRY(bead_composer_cameras(c, msg));
    BEAD_TRY(create_views(c, msg));
    BEAD_TRY(bead_frame_create(c->setup.width, c->setup.height, &c->frame, msg));
    BEAD_TRY(bead_frame_create(c->setup.width, c->setup.height, &c->background, msg));
    c->frame.alpha = c->background.alpha = c->look.clear;
    return BEAD_OK;
}

enum bead_error bead_composer_create(const struct bead_composer_setup *setup, struct bead_composer **composer,
                                     struct bead_message *msg)
{
    BEAD_TRY(bead_new(composer, 1, msg, "a movie"));
    struct bead_composer *c = *composer;
    c->setup = *setup;
    enum bead_error err = setup->output->views.axes ? bead_text_check(msg) : BEAD_OK;
    if (!err)
        err = composer_fill(c, msg);
    if (err) {
        bead_composer_destroy(c);
        *composer = NULL;
    }
    return err;
}

/* A canvas as large as the largest rectangle painted on it. */
static enum bead_error create_canvas(struct bead_composer *c, struct bead_message *msg)
{
    int width = 0, height = 0;
    for (size_t i = 0; i < view_count(c); i++) {
        struct bead_rect plot = plot_of(c, i);
        int across = plot.width + c->layout.beyond[0] + c->layout.beyond[1];
        if (!bead_view_has(type_of(c, i), BEAD_DRAWS_ON_CANVAS))
            continue;
        width = across > width ? across : width;
        height = plot.height > height ? plot.height : height;
    }
    if (!width)
        return BEAD_OK;
    BEAD_TRY(bead_canvas_create(c->setup.canvas, width, height, &c->canvas, msg));
    snprintf(c->painter, sizeof c->painter, "%s", bead_canvas_painter(c->canvas));
    return BEAD_OK;
}

const char *bead_composer_painter(const struct bead_composer *c)
{
    return c->painter;
}

static enum bead_error decorate_views(struct bead_composer *c, cairo_t *cr, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < view_count(c); i++) {
        const struct bead_view_type *type = type_of(c, i);
        if (overlaid(c, i) || !c->views[i])
            continue;
        err = type->place(c->views[i], plot_of(c, i), bead_view_has(type, BEAD_DRAWS_ON_CANVAS) ? c->canvas : NULL, msg);
        cairo_save(cr);
        if (!err && type->decorate)
            err = type->decorate(c->views[i], cr, msg);
        cairo_restore(cr);
    }
    return err;
}

static void composer_draw_words(struct bead_composer *c, cairo_t *cr)
{
    const struct bead_movie_layout *layout = &c->layout;
    const struct bead_look *look = &c->look;
    if (layout->title.width > 0) {
        struct bead_text_style style = bead_words_style(look, look->label, look->ink, BEAD_ALIGN_MIDDLE);
        style.bold = true;
        style.across = layout->words_left ? BEAD_ALIGN_START : BEAD_ALIGN_END;
        bead_lines_draw(cr, style, c->setup.title, layout->title);
    }
    if (layout->facts.width > 0)
        bead_facts_draw(cr, look, &c->facts, layout->facts, layout->words_left);
    bead_composer_draw_key(c, cr);
    for (size_t i = 0; i < layout->chain_count; i++)
        bead_composer_draw_names(c, i, cr);
}

static enum bead_error watch_texts(const struct bead_composer *c, cairo_surface_t *surface, struct bead_message *msg)
{
    if (!c->setup.watch || bead_text_watch(surface, c->setup.watch))
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a movie");
}

static enum bead_error draw_background(struct bead_composer *c, struct bead_message *msg)
{
    cairo_t *cr = bead_raster_begin(&c->background);
    enum bead_error watched = watch_texts(c, cairo_get_target(cr), msg);
    bead_look_paint(&c->look, cr);
    enum bead_error err = watched ? watched : decorate_views(c, cr, msg);
    err = err ? err : bead_inset_draw(c, cr, msg);
    composer_draw_words(c, cr);
    bead_overlay_draw_bar(c, cr);
    enum bead_error drawn = bead_raster_end(cr, "drawing the background", err ? NULL : msg);
    return err ? err : drawn;
}

enum bead_error bead_composer_open(struct bead_composer *c, struct bead_message *msg)
{
    bead_warnings_watch();
    enum bead_error err = create_canvas(c, msg);
    if (!err)
        err = draw_background(c, msg);
    if (err)
        return err;
    c->surface = bead_raster_surface(&c->frame);
    c->cr = cairo_create(c->surface);
    if (cairo_status(c->cr) != CAIRO_STATUS_SUCCESS)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "drawing: %s", cairo_status_to_string(cairo_status(c->cr)));
    err = watch_texts(c, c->surface, msg);
    for (size_t i = 0; !err && i < view_count(c); i++) {
        if (c->views[i] && previewed(c, i))
            err = bead_preview_feed(c->setup.preview, i / c->wants.view_count, type_of(c, i), c->views[i], msg);
    }
    return err ? err : bead_warnings_check(msg);
}

/* Feeds views of all times, or views of the present. */
static enum bead_error feed_views(struct bead_composer *c, const struct bead_sample *sample, bool all_times,
                                  struct bead_message *msg)
{
    for (size_t v = 0; v < c->wants.view_count; v++) {
        size_t index = sample->chain * c->wants.view_count + v;
        if (c->views[index] && !previewed(c, index) && bead_view_has(c->wants.views[v], BEAD_SHOWS_ALL_TIMES) == all_times)
            BEAD_TRY(c->wants.views[v]->feed(c->views[index], sample, msg));
    }
    return BEAD_OK;
}

static enum bead_error feed_present(struct bead_composer *c, const struct bead_sample *sample, struct bead_message *msg)
{
    if (c->fed)
        bead_interest_keep(c, sample);
    return feed_views(c, sample, false, msg);
}

enum bead_error bead_composer_feed(struct bead_composer *c, const struct bead_sample *sample, struct bead_message *msg)
{
    if (c->cameras)
        BEAD_TRY(bead_camera_feed(c->cameras[sample->chain], sample, msg));
    BEAD_TRY(feed_views(c, sample, true, msg));
    if (!c->held)
        return feed_present(c, sample, msg);
    bead_held_feed(c->held[sample->chain], sample);
    return BEAD_OK;
}

/* A frame begins: feeds the values held since the last one. */
static enum bead_error feed_held(struct bead_composer *c, struct bead_message *msg)
{
    for (size_t i = 0; c->held && i < c->wants.chain_count; i++) {
        const struct bead_sample *sample = bead_held_take(c->held[i]);
        if (sample)
            BEAD_TRY(feed_present(c, sample, msg));
    }
    return BEAD_OK;
}

enum bead_error bead_composer_card(struct bead_composer *c, struct bead_changes *changes, struct bead_message *msg)
{
    if (c->carded)
        return BEAD_OK;
    const struct bead_output *output = c->setup.output;
    const bool beads = bead_chain_spec(c->setup.chains[0])->system->has_masses;
    const struct bead_view_setup stage = {.field = output->shown.field,
                                          .beads = bead_composer_beads(c, 0),
                                          .colours = c->colours,
                                          .look = &c->look,
                                          .fill = true,
                                          .magnify = c->magnify,
                                          .light = output->views.light,
                                          .fine = true};
    BEAD_TRY(bead_card_draw(c->cr, &c->facts, beads ? &stage : NULL, &c->look, c->setup.title, output->movie.card.text,
                            (const int[]){c->frame.width, c->frame.height}, msg));
    cairo_surface_flush(c->surface);
    bead_changes_add(changes, (struct bead_rect){0, 0, c->frame.width, c->frame.height});
    c->carded = true;
    cairo_status_t status = cairo_status(c->cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "drawing the title card: %s", cairo_status_to_string(status))
                  : bead_warnings_check(msg);
}

/* Called for every frame: cameras move step by step. */
static void advance_cameras(struct bead_composer *c, double time)
{
    for (size_t i = 0; c->cameras && i < c->wants.chain_count; i++)
        bead_camera_advance(c->cameras[i], time);
}

enum bead_error bead_composer_pass(struct bead_composer *c, double time, struct bead_message *msg)
{
    BEAD_TRY(feed_held(c, msg));
    advance_cameras(c, time);
    for (size_t i = 0; i < view_count(c); i++) {
        if (type_of(c, i)->pass && c->views[i])
            type_of(c, i)->pass(c->views[i], time);
    }
    return BEAD_OK;
}

enum bead_error bead_composer_draw(struct bead_composer *c, double time, struct bead_changes *changes, struct bead_message *msg)
{
    struct bead_rect all = {0, 0, c->frame.width, c->frame.height};
    if (!c->started) {
        bead_frame_copy(&c->frame, &c->background, all);
        bead_changes_add(changes, all);
        c->started = true;
    }
    enum bead_error err = feed_held(c, msg);
    advance_cameras(c, time);
    for (size_t i = 0; !err && i < view_count(c); i++) {
        if (!overlaid(c, i) && c->views[i])
            err = type_of(c, i)->draw(c->views[i], time, &c->frame, &c->background, changes, msg);
    }
    if (err)
        return err;
    cairo_surface_mark_dirty(c->surface); /* the views wrote its pixels */
    bead_overlay_notes(c, time, changes);
    bead_overlay_time(c, time, changes);
    bead_overlay_trust(c, time, changes);
    bead_overlay_caption(c, time, changes);
    bead_overlay_progress(c, time, changes);
    return bead_warnings_check(msg);
}

const struct bead_frame *bead_composer_frame(const struct bead_composer *c)
{
    return &c->frame;
}

void bead_composer_close(struct bead_composer *c)
{
    for (size_t i = 0; c->views && i < view_count(c); i++) {
        if (c->views[i])
            type_of(c, i)->destroy(c->views[i]);
        c->views[i] = NULL;
    }
    bead_canvas_destroy(c->canvas);
    c->canvas = NULL;
    if (c->cr)
        cairo_destroy(c->cr);
    if (c->surface)
        cairo_surface_destroy(c->surface);
    c->cr = NULL;
    c->surface = NULL;
}

void bead_composer_destroy(struct bead_composer *c)
{
    if (!c)
        return;
    bead_composer_close(c);
    free(c->views);
    for (size_t i = 0; c->cameras && i < c->wants.chain_count; i++)
        bead_camera_destroy(c->cameras[i]);
    free(c->cameras);
    for (size_t i = 0; c->held && i < c->setup.chain_count; i++)
        bead_held_destroy(c->held[i]);
    free(c->held);
    free(c->fed);
    bead_movie_layout_free(&c->layout);
    bead_frame_free(&c->frame);
    bead_frame_free(&c->background);
    free(c);
}
