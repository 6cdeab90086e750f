/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports of sweeps: force against magnetism, with the space-time image of each configuration behind its point. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/sweep.h"
#include "render/colour/colour_range.h"
#include "render/colour/colour_table.h"
#include "render/report/report_write.h"
#include "render/view/area.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/sweep/sweep_internal.h"

/* Pixels of all images together (the wave does not reach about half of them, which cost nothing); of one image along the chain, and
 * along time as a part of that. With more than MOST_IMAGES configurations, every second, third and so on is shown. */
static const double wanted_pixels = 3.6e6, least_places = 24, most_places = 200, tall = 0.75;
enum { MOST_IMAGES = 4000, SAMPLES_A_ROW = 4 };

/* The image of a configuration. */
struct sweep_image {
    size_t panel, index; /* or BEAD_SWEEP_CLEAN */
    struct bead_area *area;
    size_t values;
    enum bead_field field;
};

struct sweep_report {
    const struct bead_output *output;
    const struct bead_sweep *sweep;
    struct bead_sweep_chain *clean; /* of the first panel: gives units and signs */
    struct sweep_image *images;
    struct bead_sweep_watch *watches;
    size_t count;
    double end;        /* s: of all images */
    int places, times; /* pixels */
    struct bead_colormap maps[2];
    struct bead_colour_range range;
    struct bead_field_info field;
};

static void sweep_clear(struct sweep_report *r)
{
    for (size_t i = 0; r->images && i < r->count; i++)
        bead_area_destroy(r->images[i].area);
    bead_sweep_chain_destroy(r->clean);
    free(r->images);
    free(r->watches);
}

/* ---- choice of images and their pixels ---- */

static void add_image(struct sweep_report *r, size_t panel, size_t index)
{
    r->images[r->count++] = (struct sweep_image){.panel = panel, .index = index, .field = r->output->shown.field};
}

/* Lists the clean chain and the known configurations of each panel. */
static enum bead_error list_images(struct sweep_report *r, struct bead_message *msg)
{
    struct bead_sweep_configuration found;
    size_t panels = bead_sweep_panels(r->sweep), all = panels;
    for (size_t p = 0; p < panels; p++)
        all += bead_sweep_panel(r->sweep, p)->configurations;
    const size_t stride = (all + MOST_IMAGES - 1) / MOST_IMAGES;
    BEAD_TRY(bead_new(&r->images, all, msg, "a report of a sweep"));
    BEAD_TRY(bead_new(&r->watches, all, msg, "a report of a sweep"));
    for (size_t p = 0; p < panels; p++) {
        add_image(r, p, BEAD_SWEEP_CLEAN);
        for (size_t i = 0; i < bead_sweep_panel(r->sweep, p)->configurations; i += stride) {
            if (bead_sweep_configuration(r->sweep, p, i, &found))
                add_image(r, p, i);
        }
    }
    double places = floor(sqrt(wanted_pixels / (double)r->count / tall));
    r->places = (int)fmax(least_places, fmin(most_places, places));
    r->times = (int)round(tall * r->places);
    return BEAD_OK;
}

static enum bead_error load_maps(struct sweep_report *r, struct bead_message *msg)
{
    for (int dark = 0; dark < 2; dark++)
        BEAD_TRY(bead_colour_range_map(r->output, bead_sweep_chain_of(r->clean), dark, r->range.rest > 0, &r->maps[dark], msg));
    return BEAD_OK;
}

static enum bead_error prepare_colours(struct sweep_report *r, struct bead_message *msg)
{
    BEAD_TRY(bead_colour_range_check(r->output, msg));
    BEAD_TRY(bead_sweep_chain_create(r->sweep, 0, BEAD_SWEEP_CLEAN, &r->clean, msg));
    return load_maps(r, msg);
}

static enum bead_error make_area(struct sweep_report *r, struct sweep_image *image, struct bead_message *msg)
{
    const size_t beads = bead_sweep_panel(r->sweep, image->panel)->beads;
    struct bead_sweep_chain *made = NULL;
    image->values = beads;
    if (bead_field_info(image->field)->of_contacts) {
        BEAD_TRY(bead_sweep_chain_create(r->sweep, image->panel, image->index, &made, msg));
        image->values = bead_chain_contacts(bead_sweep_chain_of(made));
        bead_sweep_chain_destroy(made);
    }
    const struct bead_area_setup setup = {{0, image->values - 1},
                                          {0, r->end},
                                          image->values < (size_t)r->places ? (int)image->values : r->places,
                                          r->times,
                                          BEAD_SAMPLING_AREA};
    return bead_area_create(&setup, &image->area, msg);
}

/* ---- running them ---- */

static enum bead_error take_sample(void *context, const struct bead_sample *sample, struct bead_message *)
{
    const struct sweep_image *image = context;
    bead_area_feed(image->area, sample->time, sample->field[image->field], sample->active);
    return BEAD_OK;
}

/* All images end when the last front arrives, or at the scene's `until`. */
static enum bead_error run_images(struct sweep_report *r, const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    for (size_t i = 0; i < r->count; i++)
        r->watches[i] = (struct bead_sweep_watch){.panel = r->images[i].panel, .index = r->images[i].index};
    BEAD_TRY(bead_sweep_end(r->sweep, r->watches, r->count, settings, &r->end, msg));
    for (size_t i = 0; i < r->count; i++) {
        BEAD_TRY(make_area(r, &r->images[i], msg));
        r->watches[i] = (struct bead_sweep_watch){.panel = r->images[i].panel,
                                                  .index = r->images[i].index,
                                                  .end = r->end,
                                                  .fields = BEAD_FIELD_BIT(r->output->shown.field),
                                                  .every = r->end / (SAMPLES_A_ROW * (double)r->times),
                                                  .take = take_sample,
                                                  .context = &r->images[i]};
    }
    return bead_sweep_watch(r->sweep, r->watches, r->count, settings, msg);
}

static enum bead_error find_range(struct sweep_report *r, struct bead_message *msg)
{
    struct bead_shown_values shown = BEAD_NOTHING_SHOWN;
    const struct bead_chain *chain = bead_sweep_chain_of(r->clean);
    shown.rest = bead_colour_range_rest(&chain, 1, r->output->shown.field);
    for (size_t i = 0; i < r->count; i++)
        bead_area_widen(r->images[i].area, &shown);
    r->field = *bead_chain_field(chain, r->output->shown.field);
    r->range = bead_colour_range_find(&r->output->colours, bead_chain_signed(chain, r->output->shown.field), &shown);
    return load_maps(r, msg);
}

/* ---- writing ---- */

/* Writes indices of colours, a row for each time: the number of places up to the last that differs from the colour at rest (two
 * bytes), then their indices. */
static enum bead_error write_image(const struct sweep_report *r, const struct sweep_image *image, struct bead_json *json,
                                   struct bead_message *msg)
{
    const struct bead_colours colours = bead_colour_range_colours(r->output, &r->range, &r->maps[0]);
    const size_t places = bead_area_places(image->area), room = (places + 2) * (size_t)r->times;
    const uint8_t rest = bead_colours_index(&colours, colours.rest);
    BEAD_FREED double *means = malloc(places * sizeof *means);
    BEAD_FREED unsigned char *bytes = malloc(room);
    size_t used = 0;
    if (!means || !bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report of a sweep");
    for (int t = 0; t < r->times; t++) {
        size_t reached = bead_area_column(image->area, t, means) ? places : 0;
        while (reached > 0 && bead_colours_index(&colours, means[reached - 1]) == rest)
            reached--;
        bytes[used++] = (unsigned char)(reached & 255);
        bytes[used++] = (unsigned char)(reached >> 8);
        for (size_t i = 0; i < reached; i++)
            bytes[used++] = bead_colours_index(&colours, means[i]);
    }
    report_bytes(json, "data", bytes, used);
    return BEAD_OK;
}

static void write_spins(const char *spins, size_t cells, struct bead_json *json)
{
    FILE *file = bead_json_key(json, "spins");
    fputc('"', file);
    for (size_t i = 0; i < cells; i++)
        fputc(spins[i] == '1' ? '1' : '0', file);
    fputc('"', file);
}

static enum bead_error write_configurations(const struct sweep_report *r, size_t panel, struct bead_json *json,
                                            struct bead_message *msg)
{
    bead_json_open(json, "images", '[');
    for (size_t i = 0; i < r->count; i++) {
        const struct sweep_image *image = &r->images[i];
        struct bead_sweep_configuration found;
        if (image->panel != panel)
            continue;
        (void)bead_sweep_configuration(r->sweep, panel, image->index, &found);
        bead_json_open(json, NULL, '{');
        bead_json_number(json, "index", image->index == BEAD_SWEEP_CLEAN ? NAN : (double)image->index);
        bead_json_number(json, "magnetism", found.magnetism);
        write_spins(found.spins, bead_sweep_panel(r->sweep, panel)->spec->cells, json);
        bead_json_number(json, "places", (double)bead_area_places(image->area));
        bead_json_number(json, "values", (double)image->values);
        BEAD_TRY(write_image(r, image, json, msg));
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
    return BEAD_OK;
}

static void write_rows(const struct bead_sweep_statistics *s, struct bead_json *json)
{
    size_t count = 0;
    bead_json_open(json, "rows", '[');
    for (size_t i = 0; i < s->row_count; i++) {
        const struct bead_sweep_row *row = &s->rows[i];
        const double numbers[] = {row->magnetism, (double)row->count, row->summary.mean, row->summary.standard_error,
                                  row->summary.median};
        bead_json_numbers(json, NULL, numbers, sizeof numbers / sizeof *numbers);
        count = row->first + row->count;
    }
    bead_json_close(json, "]");
    bead_json_numbers(json, "values", s->values, count);
    bead_json_open(json, "indices", '[');
    for (size_t i = 0; i < count; i++)
        bead_json_number(json, NULL, (double)s->indices[i]);
    bead_json_close(json, "]");
}

static enum bead_error write_place(const struct sweep_report *r, size_t panel, size_t place, struct bead_json *json,
                                   struct bead_message *msg)
{
    struct bead_sweep_statistics s = {0};
    BEAD_TRY(bead_sweep_statistics(r->sweep, panel, place, r->output->sweep_curves.threshold, &s, msg));
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "name", bead_sweep_place(r->sweep, panel, place));
    bead_json_number(json, "clean", s.clean);
    if (s.has_threshold) {
        const double numbers[] = {s.threshold.plateau, s.threshold.plateau_error, s.threshold.critical, s.threshold.critical_error};
        bead_json_numbers(json, "threshold", numbers, sizeof numbers / sizeof *numbers);
    }
    write_rows(&s, json);
    bead_json_close(json, "}");
    bead_sweep_statistics_free(&s);
    return BEAD_OK;
}

static enum bead_error write_panel(const struct sweep_report *r, size_t index, struct bead_json *json, struct bead_message *msg)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(r->sweep, index);
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "name", panel->spec->title && *panel->spec->title ? panel->spec->title : panel->name);
    bead_json_number(json, "configurations", (double)panel->configurations);
    bead_json_number(json, "cells", (double)panel->spec->cells);
    bead_json_open(json, "places", '[');
    for (size_t p = 0; p < panel->places; p++)
        BEAD_TRY(write_place(r, index, p, json, msg));
    bead_json_close(json, "]");
    BEAD_TRY(write_configurations(r, index, json, msg));
    bead_json_close(json, "}");
    return BEAD_OK;
}

static enum bead_error sweep_data(const void *context, FILE *file, struct bead_message *msg)
{
    const struct sweep_report *r = context;
    struct bead_json json = REPORT_JSON(file);
    report_open(&json, bead_sweep_scene(r->sweep));
    bead_json_number(&json, "end", r->end);
    bead_json_number(&json, "times", r->times);
    report_field(&json, &r->field, bead_field_info(r->output->shown.field)->name);
    report_range(&json, &r->range, bead_colour_range_colours(r->output, &r->range, NULL).scale);
    report_maps(&json, r->maps);
    bead_json_open(&json, "panels", '[');
    for (size_t p = 0; p < bead_sweep_panels(r->sweep); p++)
        BEAD_TRY(write_panel(r, p, &json, msg));
    bead_json_close(&json, "]}");
    return BEAD_OK;
}

static enum bead_error write_report(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                    uint64_t *bytes, struct bead_message *msg)
{
    static const char *const scripts[] = {"data.js", "axes.js", "chart.js", "page.js", "save.js", "sweep.js", NULL};
    static const struct report_part parts[] = {{"data", sweep_data}, {NULL, NULL}};
    static const struct report_page page = {NULL, "sweep.html", scripts, parts};
    BEAD_LEFT_TO(sweep_clear) struct sweep_report r = {.output = output, .sweep = context->sweep};
    BEAD_TRY(prepare_colours(&r, msg));
    BEAD_TRY(list_images(&r, msg));
    BEAD_TRY(run_images(&r, context->sweep_settings, msg));
    BEAD_TRY(find_range(&r, msg));
    return report_write_page(&page, bead_sweep_scene(r.sweep), &r, path, bytes, msg);
}

static enum bead_error check_report(const struct bead_output *output, const struct bead_run_context *, struct bead_message *msg)
{
    return bead_colour_range_check(output, msg);
}

static const char *sweep_why(const struct bead_output *)
{
    return "a page with force against magnetism and an image behind each point: runs those chains again";
}

const struct bead_sink_type bead_report_sweep_sink = {.name = "report",
                                                      .help = "a sweep as one HTML file",
                                                      .kind = BEAD_OUTPUT_REPORT,
                                                      .check = check_report,
                                                      .why = sweep_why,
                                                      .write = write_report,
                                                      .runs_chains = true};
