/* Sink for `image:` outputs: figures, or bare pixels with `axes: false`.
 *
 * Bare pixels lie as those of imagesc: bead 0 in the top row, beads downwards, time to the right; several chains stand one below
 * the other. The picture has exactly the size asked for, and its palette is the colour map. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/colormap.h"
#include "beadreel/file.h"
#include "render/area.h"
#include "render/colour_range.h"
#include "render/figure.h"
#include "render/page.h"
#include "render/sheet.h"
#include "render/sinks.h"

struct bare {
    struct bead_page page;
    struct bead_colormap map;
    struct bead_area **areas; /* [chains] */
    int *tops;                /* [chains + 1], px */
    struct bead_grid grid;
    struct bead_span beads;
    char why[96];
};

struct bead_sink {
    const struct bead_output *output;
    struct bead_stage stage;
    struct bead_sheet *sheet;   /* or */
    struct bead_figure *figure; /* or */
    struct bare bare;
    char *path;
    uint64_t bytes;
};

static void destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    bead_sheet_destroy(sink->sheet);
    bead_figure_destroy(sink->figure);
    for (size_t c = 0; sink->bare.areas && c < sink->stage.chain_count; c++)
        bead_area_destroy(sink->bare.areas[c]);
    free(sink->bare.areas);
    free(sink->bare.tops);
    free(sink->path);
    free(sink);
}

/* ---- bare pixels ---- */

static enum bead_error scene_error(const struct bead_sink *sink, const char *text, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s", sink->stage.scene->file, sink->output->place.line,
                     sink->output->place.column, text);
}

static size_t count_of(const struct bead_sink *sink, size_t chain)
{
    const struct bead_chain *c = sink->stage.chains[chain];
    return bead_field_info(sink->output->field)->of_contacts ? bead_chain_contacts(c) : bead_chain_beads(c);
}

static enum bead_error make_areas(struct bead_sink *sink, const double time[2], struct bead_message *msg)
{
    struct bare *b = &sink->bare;
    size_t chains = sink->stage.chain_count;
    b->areas = calloc(chains, sizeof(struct bead_area *));
    b->tops = calloc(chains + 1, sizeof *b->tops);
    if (!b->areas || !b->tops)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image");
    if ((size_t)b->page.height < chains)
        return scene_error(sink, "size: fewer rows of pixels than chains", msg);
    enum bead_error err = BEAD_OK;
    b->beads = (struct bead_span){sink->output->beads.first, 0};
    for (size_t c = 0; !err && c < chains; c++) {
        struct bead_area_setup setup = {sink->output->beads, {time[0], time[1]}, 0, b->page.width, sink->output->sampling};
        size_t count = count_of(sink, c);
        setup.beads.last = setup.beads.last < count ? setup.beads.last : count - 1;
        if (setup.beads.first > setup.beads.last)
            return scene_error(sink, "beads: begin behind the end of the chain", msg);
        b->beads.last = setup.beads.last > b->beads.last ? setup.beads.last : b->beads.last;
        b->tops[c + 1] = (int)((long long)b->page.height * (long long)(c + 1) / (long long)chains);
        setup.across = b->tops[c + 1] - b->tops[c];
        err = bead_area_create(&setup, &b->areas[c], msg);
    }
    return err;
}

static enum bead_error create_bare(struct bead_sink *sink, struct bead_message *msg)
{
    struct bare *b = &sink->bare;
    const struct bead_output *output = sink->output;
    double end = sink->stage.end;
    const double time[2] = {isnan(output->time[0]) ? 0 : output->time[0],
                            isnan(output->time[1]) ? end : fmin(output->time[1], end)};
    enum bead_error err = bead_page_find(output, sink->stage.scene->file, &b->page, msg);
    if (!err && (!(time[1] > time[0]) || !isfinite(time[1])))
        err = scene_error(sink, "time: there is nothing to show; the run ends before", msg);
    if (!err)
        err = bead_colour_range_check(output, sink->stage.scene->file, msg);
    if (!err)
        err = bead_colour_range_map(output, sink->stage.chains[0], "viridis", &b->map, msg);
    if (!err)
        err = make_areas(sink, time, msg);
    if (err)
        return err;
    b->grid = bead_figure_grid(&sink->stage, output, time, b->page.width);
    snprintf(b->why, sizeof b->why, "%d x %d bare pixels", b->page.width, b->page.height);
    return BEAD_OK;
}

static struct bead_colour_range find_range(const struct bead_sink *sink)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t c = 0; c < sink->stage.chain_count; c++) {
        double one[2];
        bead_area_extremes(sink->bare.areas[c], &one[0], &one[1]);
        low = fmin(low, one[0]);
        high = fmax(high, one[1]);
    }
    return bead_colour_range_find(sink->output, sink->stage.chains[0], low, high);
}

static enum bead_error fill_indices(const struct bead_sink *sink, uint8_t *indices, struct bead_message *msg)
{
    const struct bare *b = &sink->bare;
    struct bead_colour_range range = find_range(sink);
    struct bead_colours colours = {&b->map, sink->output->scale, range.low, range.high};
    double *means = malloc((size_t)b->page.height * sizeof *means);
    if (!means)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image");
    for (size_t c = 0; c < sink->stage.chain_count; c++) {
        for (int x = 0; x < b->page.width; x++) {
            if (!bead_area_column(b->areas[c], x, means))
                continue;
            for (int y = b->tops[c]; y < b->tops[c + 1]; y++)
                indices[(size_t)y * (size_t)b->page.width + (size_t)x] = bead_colours_index(&colours, means[y - b->tops[c]]);
        }
    }
    free(means);
    return BEAD_OK;
}

/* What draw_pixels puts into a vector file. */
struct pixels {
    const struct bead_page *page;
    const uint8_t *indices;
    const struct bead_colormap *map;
};

static enum bead_error draw_pixels(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct pixels *p = context;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, p->page->width, p->page->height);
    unsigned char *data = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image);
    for (int y = 0; data && y < p->page->height; y++) {
        for (int x = 0; x < p->page->width; x++) {
            const uint8_t *rgb = p->map->rgb[p->indices[(size_t)y * (size_t)p->page->width + (size_t)x]];
            unsigned char *pixel = data + (size_t)y * stride + 4 * (size_t)x;
            pixel[0] = rgb[2];
            pixel[1] = rgb[1];
            pixel[2] = rgb[0];
        }
    }
    cairo_surface_mark_dirty(image);
    cairo_set_source_surface(cr, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
    cairo_paint(cr);
    cairo_surface_destroy(image);
    cairo_status_t status = cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "image: %s", cairo_status_to_string(status)) : BEAD_OK;
}

static enum bead_error write_bare(struct bead_sink *sink, struct bead_message *msg)
{
    const struct bare *b = &sink->bare;
    struct bead_picture_notes notes;
    char description[512];
    uint8_t *indices = calloc((size_t)b->page.width, (size_t)b->page.height);
    if (!indices)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for an image", sink->path);
    bead_page_notes(&b->page, sink->output, sink->stage.scene, description, sizeof description, &notes);
    enum bead_error err = fill_indices(sink, indices, msg);
    struct pixels pixels = {&b->page, indices, &b->map};
    if (!err && b->page.vector)
        err = bead_vector_write(sink->path, b->page.width, b->page.height, draw_pixels, &pixels, &notes, &sink->bytes, msg);
    else if (!err)
        err = bead_png_write_indexed(sink->path, b->page.width, b->page.height, indices, b->map.rgb, &notes, &sink->bytes, msg);
    free(indices);
    return err;
}

/* ---- the sink ---- */

static enum bead_error create(const struct bead_output *output, const struct bead_stage *stage, struct bead_sink **sink,
                              struct bead_message *msg)
{
    struct bead_sink *s = *sink = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image");
    s->output = output;
    s->stage = *stage;
    bool bare = !output->axes && output->view_count == 1 && output->views[0] == BEAD_VIEW_SPACETIME;
    enum bead_error err = bead_file_join(stage->directory, output->path, &s->path, msg);
    if (!err && bead_sheet_wanted(output))
        err = bead_sheet_create(output, stage, &s->sheet, msg);
    else if (!err)
        err = bare ? create_bare(s, msg) : bead_figure_create(output, stage, output->views, output->view_count, &s->figure, msg);
    if (err) {
        destroy(s);
        *sink = NULL;
    }
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    const struct bare *b = &sink->bare;
    if (sink->sheet) {
        bead_sheet_needs(sink->sheet, needs);
        return;
    }
    if (sink->figure) {
        bead_figure_needs(sink->figure, needs);
        return;
    }
    *needs = (struct bead_needs){
        .fields = BEAD_FIELD_BIT(sink->output->field), .beads = b->beads, .grid = b->grid, .until = b->grid.end, .why = b->why};
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    if (sink->sheet)
        return bead_sheet_feed(sink->sheet, sample, msg);
    if (sink->figure)
        return bead_figure_feed(sink->figure, sample, msg);
    const double *values = sample->field[sink->output->field];
    if (!values)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s", bead_field_info(sink->output->field)->title);
    bead_area_feed(sink->bare.areas[sample->chain], sample->time, values, sample->active);
    return BEAD_OK;
}

static enum bead_error end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    if (sink->sheet)
        return bead_sheet_write(sink->sheet, outcomes, sink->path, &sink->bytes, msg);
    return sink->figure ? bead_figure_write(sink->figure, sink->path, &sink->bytes, msg) : write_bare(sink, msg);
}

static void result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

static const char *const extensions[] = {"png", "pdf", "svg", NULL};

const struct bead_sink_type bead_image_sink = {
    .name = "image",
    .help = "space-time image or a still of other views: png, pdf, svg",
    .kind = BEAD_OUTPUT_IMAGE,
    .extensions = extensions,
    .create = create,
    .needs = needs,
    .begin = begin,
    .sample = sample,
    .end = end,
    .destroy = destroy,
    .result = result,
};
