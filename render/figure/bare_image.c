/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bare pixels, `axes: false`: as in Octave's imagesc, with bead 0 in the top row and time to the right, unless the scene changes it
 * (`orientation`). Several chains are below each other, or side by side if time runs down. The picture has exactly the requested
 * size, and its palette is the colour map. */
#include "render/figure/still.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/view.h"
#include "render/colour/colour_range.h"
#include "render/draw/picture_times.h"
#include "render/draw/raster.h"
#include "render/figure/figure.h"
#include "render/view/area.h"
#include "render/view/orientation.h"
#include "render/view/tale.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/output_kinds.h"
#include "sim/kinds/view_kinds.h"

struct bead_still {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    struct bead_colormap map;
    struct bead_area **areas; /* [chains] */
    struct bead_tale *tale;
    int columns, across; /* px along time, and across it, of all chains */
    int *tops;           /* [chains + 1], px: where chains begin across time */
    struct bead_grid grid;
    struct bead_span beads;
    char why[96];
};

static bool bare_wanted(const struct bead_output *output)
{
    return !output->views.axes && output->views.count == 1 && bead_views_any(&output->views, BEAD_SHOWS_IMAGE);
}

static void bare_destroy(struct bead_still *b)
{
    for (size_t c = 0; b->areas && c < b->context.chain_count; c++)
        bead_area_destroy(b->areas[c]);
    bead_tale_destroy(b->tale);
    free(b->areas);
    free(b->tops);
}

static bool time_down(const struct bead_still *b)
{
    return bead_orientation_of(b->output) == BEAD_TIME_DOWN;
}

static enum bead_error make_areas(struct bead_still *b, const double time[2], struct bead_message *msg)
{
    size_t chains = b->context.chain_count;
    BEAD_TRY(bead_new(&b->areas, chains, msg, "an image"));
    BEAD_TRY(bead_new(&b->tops, chains + 1, msg, "an image"));
    b->columns = time_down(b) ? b->page.height : b->page.width;
    b->across = time_down(b) ? b->page.width : b->page.height;
    if ((size_t)b->across < chains)
        return bead_output_wrong(b->output, msg, "size: fewer rows (or columns) of pixels than chains");
    b->beads = (struct bead_span){b->output->shown.beads.first, 0};
    for (size_t c = 0; c < chains; c++) {
        struct bead_area_setup setup = {.time = {time[0], time[1]}, .columns = b->columns, .sampling = b->output->image.sampling};
        BEAD_TRY(bead_figure_span(b->output, b->context.chains[c], &setup.beads, msg));
        b->beads.last = setup.beads.last > b->beads.last ? setup.beads.last : b->beads.last;
        b->tops[c + 1] = (int)((long long)b->across * (long long)(c + 1) / (long long)chains);
        setup.places = b->tops[c + 1] - b->tops[c];
        BEAD_TRY(bead_area_create(&setup, &b->areas[c], msg));
    }
    return BEAD_OK;
}

static enum bead_error bare_create(const struct bead_output *output, const struct bead_run_context *context, struct bead_still *b,
                                   struct bead_message *msg)
{
    b->output = output;
    b->context = *context;
    double time[2];
    BEAD_TRY(bead_page_find(output, &b->page, msg));
    BEAD_TRY(bead_picture_times(output, &b->context, time, msg));
    BEAD_TRY(bead_colour_range_check(output, msg));
    BEAD_TRY(bead_colour_range_map(output, b->context.chains[0], output->paper.theme == BEAD_THEME_DARK, false, &b->map, msg));
    BEAD_TRY(make_areas(b, time, msg));
    BEAD_TRY(bead_tale_create(b->context.chains, b->context.chain_count, output->shown.field, b->beads, &b->tale, msg));
    b->grid = bead_picture_grid(&b->context, &output->shown, time, b->columns);
    snprintf(b->why, sizeof b->why, "%d x %d bare pixels", b->page.width, b->page.height);
    return BEAD_OK;
}

/* Nothing is left out: no bar marks values beyond. */
static struct bead_colour_range bare_find_range(const struct bead_still *b)
{
    struct bead_shown_values all = BEAD_NOTHING_SHOWN;
    all.rest = bead_colour_range_rest(b->context.chains, b->context.chain_count, b->output->shown.field);
    for (size_t c = 0; c < b->context.chain_count; c++)
        bead_area_widen(b->areas[c], &all);
    all.typical = INFINITY;
    all.usually_away = all.away;
    return bead_colour_range_find(&b->output->colours, bead_colour_range_signed(b->output, b->context.chains[0]), &all);
}

/* The place of a chain's pixels. */
static struct bead_area_image image_of(const struct bead_still *b, size_t chain, uint8_t *indices)
{
    const ptrdiff_t width = b->page.width, begin = b->tops[chain] * (time_down(b) ? 1 : width);
    return bead_orientation_image(bead_orientation_of(b->output), b->tops[chain + 1] - b->tops[chain], indices + begin, width);
}

static enum bead_error fill_indices(struct bead_still *b, uint8_t *indices, struct bead_message *msg)
{
    const struct bead_colour_range range = bare_find_range(b);
    const struct bead_colours colours = bead_colour_range_colours(b->output, &range, &b->map);
    struct bead_colour_table table;
    BEAD_TRY(bead_colour_range_map(b->output, b->context.chains[0], b->output->paper.theme == BEAD_THEME_DARK, range.rest > 0,
                                   &b->map, msg));
    bead_colour_table_make(&colours, &table);
    for (size_t c = 0; c < b->context.chain_count; c++) {
        const struct bead_area_image image = image_of(b, c, indices);
        for (int x = 0, done; x < b->columns; x = done + 1) /* skips a column that no sample has touched */
            BEAD_TRY(bead_area_colour(b->areas[c], &table, x, b->columns, &image, &done, msg));
    }
    return BEAD_OK;
}

/* The pixels that draw_pixels puts on a page. */
struct pixels {
    struct bead_rect rect;
    const uint8_t *indices;
    const struct bead_colormap *map;
};

static enum bead_error draw_pixels(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct pixels *p = context;
    return bead_raster_indices(cr, p->rect, p->indices, p->map, msg);
}

/* Writes a PNG file with the colour map as its palette. */
static enum bead_error write_png(const struct bead_still *b, const uint8_t *indices, const char *tale, const char *path,
                                 uint64_t *bytes, struct bead_message *msg)
{
    struct bead_picture_notes notes;
    char description[BEAD_DESCRIPTION];
    bead_page_notes(&b->page, b->output, b->context.scene, tale, description, &notes);
    return bead_png_write_indexed(path, b->page.width, b->page.height, indices, b->map.rgb, &notes, bytes, msg);
}

static enum bead_error bare_write(struct bead_still *b, const struct bead_outcome *, const char *path, uint64_t *bytes,
                                  struct bead_message *msg)
{
    char tale[BEAD_TALE_WORDS];
    const size_t count = (size_t)b->page.width * (size_t)b->page.height;
    BEAD_FREED uint8_t *indices = bead_large_take(count);
    if (!indices)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for an image", path);
    memset(indices, 0, count);
    bead_tale_words(b->tale, tale, sizeof tale);
    BEAD_TRY(fill_indices(b, indices, msg));
    if (bead_output_ends_like(".png", path))
        return write_png(b, indices, tale, path, bytes, msg);
    struct pixels pixels = {{0, 0, b->page.width, b->page.height}, indices, &b->map};
    const struct bead_drawing drawing = {draw_pixels, NULL, &pixels, tale};
    return bead_page_write(&b->page, b->output, b->context.scene, &drawing, path, bytes, msg);
}

static void bare_needs(const struct bead_still *b, struct bead_needs *needs)
{
    *needs = (struct bead_needs){
        .fields = BEAD_FIELD_BIT(b->output->shown.field), .beads = b->beads, .grid = b->grid, .until = b->grid.end, .why = b->why};
}

static enum bead_error bare_feed(struct bead_still *b, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *values = sample->field[b->output->shown.field];
    if (!values)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s", bead_field_info(b->output->shown.field)->title);
    bead_area_feed(b->areas[sample->chain], sample->time, values, sample->active);
    bead_tale_feed(b->tale, sample);
    return BEAD_OK;
}

const struct bead_still_kind bead_bare_image = {
    .size = sizeof(struct bead_still),
    .wanted = bare_wanted,
    .create = bare_create,
    .needs = bare_needs,
    .feed = bare_feed,
    .write = bare_write,
    .destroy = bare_destroy,
};
