/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure with a page of its own: the last kind of still, for images that no other kind wants. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/canvas.h"
#include "render/draw/raster.h"
#include "render/figure/figure_private.h"
#include "render/figure/still.h"

struct bead_still {
    struct bead_figure *figure;
    char painter[64]; /* "": none was needed */
};

static bool figure_wanted(const struct bead_output *output)
{
    return output->views.count > 0;
}

static void figure_destroy(struct bead_still *still)
{
    bead_figure_destroy(still->figure);
    free(still);
}

/* On the whole page. */
static enum bead_error make_figure(const struct bead_output *output, const struct bead_run_context *context,
                                   struct bead_figure **figure, struct bead_message *msg)
{
    struct bead_page page;
    struct bead_look look;
    struct bead_insets none = {0}, insets;
    enum bead_error err = bead_page_find(output, context->scene->file, &page, msg);
    if (err)
        return err;
    bead_page_look(&page, &output->paper, &look);
    err = bead_figure_create(output, context, &page, &look, NULL, figure, msg);
    if (!err)
        err = bead_figure_put(*figure, (struct bead_rect){0, 0, page.width, page.height}, &none, &insets, msg);
    return err ? err : bead_figure_start(*figure, msg);
}

static enum bead_error figure_create(const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_still **still, struct bead_message *msg)
{
    struct bead_still *s = *still = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a figure");
    enum bead_error err = make_figure(output, context, &s->figure, msg);
    if (err) {
        figure_destroy(s);
        *still = NULL;
    }
    return err;
}

static void figure_needs(const struct bead_still *still, struct bead_needs *needs)
{
    bead_figure_needs(still->figure, needs);
}

static enum bead_error figure_feed(struct bead_still *still, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_figure_feed(still->figure, sample, msg);
}

static enum bead_error figure_decorate(void *context, cairo_t *cr, struct bead_message *msg)
{
    return bead_figure_decorate(context, cr, msg);
}

static enum bead_error figure_raster(void *context, struct bead_frame *frame, struct bead_message *msg)
{
    struct bead_figure *f = context;
    struct bead_frame background = {0};
    enum bead_error err = bead_raster_draw(frame, figure_decorate, f, msg);
    if (!err && f->stills) { /* only views of one moment draw over the background */
        err = bead_frame_create(frame->width, frame->height, &background, msg);
        if (!err)
            bead_frame_copy(&background, frame, (struct bead_rect){0, 0, frame->width, frame->height});
        background.alpha = frame->alpha;
    }
    if (!err)
        err = bead_figure_draw(f, frame, f->stills ? &background : frame, msg);
    bead_frame_free(&background);
    return err;
}

static enum bead_error figure_vector(void *context, cairo_t *cr, struct bead_message *msg)
{
    enum bead_error err = bead_figure_decorate(context, cr, msg);
    return err ? err : bead_figure_vector(context, cr, msg);
}

static enum bead_error figure_write(struct bead_still *still, const struct bead_outcome *outcomes, const char *path,
                                    uint64_t *bytes, struct bead_message *msg)
{
    (void)outcomes;
    struct bead_figure *f = still->figure;
    struct bead_canvas *canvas = NULL;
    const struct bead_drawing drawing = {figure_vector, figure_raster, f};
    struct bead_shown_values colours = BEAD_NOTHING_SHOWN, sensors = BEAD_NOTHING_SHOWN;
    bead_figure_extremes(f, &colours, &sensors);
    bead_figure_set_range(f, &colours, &sensors);
    enum bead_error err =
        bead_figure_needs_canvas(f) ? bead_canvas_create(f->context.canvas, f->page.width, f->page.height, &canvas, msg) : BEAD_OK;
    if (canvas)
        snprintf(still->painter, sizeof still->painter, "%s", bead_canvas_painter(canvas));
    if (!err)
        err = bead_figure_finish(f, canvas, msg);
    if (!err)
        err = bead_page_write(&f->page, f->output, f->context.scene, &drawing, path, bytes, msg);
    bead_figure_release_canvas(f);
    bead_canvas_destroy(canvas);
    return err;
}

static const char *figure_painter(const struct bead_still *still)
{
    return still->painter;
}

const struct bead_still_kind bead_figure_still = {
    .wanted = figure_wanted,
    .create = figure_create,
    .looks_at_beads = bead_figure_looks_at_beads,
    .needs = figure_needs,
    .feed = figure_feed,
    .write = figure_write,
    .painter = figure_painter,
    .destroy = figure_destroy,
};
