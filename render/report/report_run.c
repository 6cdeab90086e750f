/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a report: keeps as many samples as fit into a page of a few megabytes, and writes them at the end. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/axis.h"
#include "render/draw/picture_times.h"
#include "render/report/report_private.h"
#include "render/stage/magnify.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/measure/sink_grid.h"

/* Bytes of samples: wanted, and at most. Base64 makes four of three. */
static const double wanted_bytes = 1.2e6, most_bytes = 12e6;
/* Samples: one for each frame of a film of 20 s; fewer than the least do not look like motion. */
static const double most_samples = 1201, fewest_samples = 201;
/* Pixels along time of the image that finds the range of colours. */
enum { IMAGE_TIMES = 400 };

static void report_destroy(struct bead_sink *s)
{
    if (!s)
        return;
    for (size_t c = 0; s->chains && c < s->chain_count; c++) {
        free(s->chains[c].field);
        free(s->chains[c].displacement);
        bead_held_destroy(s->chains[c].held);
        bead_area_destroy(s->chains[c].area);
        bead_measures_destroy(s->chains[c].measures);
        bead_measures_destroy(s->chains[c].check);
    }
    bead_tale_destroy(s->tale);
    free(s->chains);
    free(s->path);
    free(s);
}

static void find_spans(const struct bead_sink *s, struct report_chain *c)
{
    const struct bead_span asked = s->output->shown.beads;
    size_t beads = bead_chain_beads(c->chain),
           values = bead_field_info(s->output->shown.field)->of_contacts ? bead_chain_contacts(c->chain) : beads;
    c->beads = bead_chain_spec(c->chain)->system->has_contacts;
    c->beads_shown = bead_span_rows(&asked, beads);
    c->values = bead_span_rows(&asked, values);
    c->bead = (struct bead_span){asked.first, asked.first + c->beads_shown - 1};
    c->value = (struct bead_span){asked.first, asked.first + c->values - 1};
}

static enum bead_error list_chains(struct bead_sink *s, struct bead_message *msg)
{
    s->chain_count = s->context.chain_count;
    BEAD_TRY(bead_new(&s->chains, s->chain_count, msg, "a report"));
    s->peaks = !s->context.replayed;
    for (size_t i = 0; i < s->chain_count; i++) {
        struct report_chain *c = &s->chains[i];
        c->chain = s->context.chains[i];
        find_spans(s, c);
        s->peaks = s->peaks && c->beads;
        if (c->values == 0) /* a chain has no more contacts than beads */
            return bead_output_wrong(s->output, msg, "beads: some chains have fewer beads");
    }
    return BEAD_OK;
}

static double bytes_a_sample(const struct bead_sink *s)
{
    double numbers = 0;
    for (size_t i = 0; i < s->chain_count; i++)
        numbers += (double)s->chains[i].values + (s->chains[i].beads ? (double)s->chains[i].beads_shown : 0);
    return 2 * numbers;
}

/* A grid of times, at multiples of a trajectory's step if one is replayed. */
static struct bead_grid grid_of(const struct bead_grid *native, const double time[2], double every)
{
    if (!(native->every > 0))
        return (struct bead_grid){.start = time[0], .every = every, .end = time[1]};
    double first = fmax(0, ceil((time[0] - native->start) / native->every - 1e-6));
    return (struct bead_grid){.start = native->start + first * native->every,
                              .every = native->every * fmax(1, ceil(every / native->every - 1e-6)),
                              .end = fmin(time[1], native->end)};
}

/* Chooses the samples that the scene asks for, else as many as fit, but at least a few. */
static enum bead_error choose_times(struct bead_sink *s, struct bead_message *msg)
{
    const double bytes = bytes_a_sample(s), count = fmin(most_samples, fmax(fewest_samples, floor(wanted_bytes / bytes)));
    double time[2], every = s->output->shown.every;
    BEAD_TRY(bead_picture_times(s->output, &s->context, time, msg));
    s->grid = grid_of(&s->context.native, time, every > 0 ? every : (time[1] - time[0]) / (count - 1));
    if (((s->grid.end - s->grid.start) / s->grid.every + 1) * bytes > most_bytes)
        return bead_output_wrong(
            s->output, msg,
            "beads: a page with so many beads and samples would be too large for browsers; show fewer beads, such as "
            "`beads: [0, 200]`, or fewer samples (`every`)");
    s->samples = bead_grid_count(&s->grid);
    return s->samples > 1 ? BEAD_OK : bead_output_wrong(s->output, msg, "every: a report needs two samples or more");
}

/* Measures of the whole run need samples dense enough for its pulses; so do kept samples that are too far apart for these, as for
 * short impacts in a long run. */
static void choose_stride(struct bead_sink *s)
{
    const struct bead_shown *shown = &s->output->shown;
    const double native = s->context.native.every, most = BEAD_MEASURE_SPACING * s->context.resolution;
    const double every = native > 0 ? native : most;
    s->measured = s->peaks && isnan(shown->time[0]) && isnan(shown->time[1]) && every <= most * (1 + 1e-9) && isfinite(every);
    s->held = every < s->grid.every &&
              bead_held_is_needed(s->context.chains[0], BEAD_FIELD_BIT(shown->field), s->grid.every, s->context.resolution);
    s->each = s->measured && !s->context.replayed ? bead_measures_each(s->context.chains, s->context.chain_count) : 1;
    s->stride = s->each * (s->measured || s->held ? (size_t)fmax(1, ceil(s->grid.every / every - 1e-6)) : 1);
}

static enum bead_error load_maps(struct bead_sink *s, struct bead_message *msg)
{
    for (int dark = 0; dark < 2; dark++)
        BEAD_TRY(bead_colour_range_map(s->output, s->context.chains[0], dark, s->range.rest > 0, &s->maps[dark], msg));
    return BEAD_OK;
}

static void report_describe(struct bead_sink *s)
{
    char every[48];
    bead_quantity(s->grid.every, bead_chain_time_unit(s->context.chains[0]), 3, every, sizeof every);
    snprintf(s->why, sizeof s->why, "a page with %zu samples, every %s%s", s->samples, every, s->peaks ? ", and peaks" : "");
}

static enum bead_error report_create(const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_sink **sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(sink, 1, msg, "a report"));
    struct bead_sink *s = *sink;
    s->output = output;
    s->context = *context;
    BEAD_TRY(bead_file_join(context->directory, output->path, &s->path, msg));
    BEAD_TRY(list_chains(s, msg));
    BEAD_TRY(choose_times(s, msg));
    BEAD_TRY(bead_colour_range_check(s->output, msg));
    BEAD_TRY(load_maps(s, msg));
    BEAD_TRY(bead_tale_create(context->chains, context->chain_count, output->shown.field, output->shown.beads, &s->tale, msg));
    choose_stride(s);
    report_describe(s);
    return BEAD_OK;
}

/* The fields of a chain to keep. */
static unsigned report_fields(const struct bead_sink *s, const struct report_chain *c)
{
    return BEAD_FIELD_BIT(s->output->shown.field) | (c->beads ? BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) : 0);
}

/* Of beads, from samples; of an equation, in its outcome. */
static bool has_measures(const struct bead_sink *s, const struct report_chain *c)
{
    return s->measured || (!c->beads && !s->context.replayed);
}

static void report_needs(const struct bead_sink *s, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = 0,
                                 .beads = s->output->shown.beads,
                                 .grid = {.start = s->grid.start, .every = s->grid.every / (double)s->stride, .end = s->grid.end},
                                 .contact_peaks = s->peaks,
                                 .uncertainty = s->peaks,
                                 .until = s->peaks ? INFINITY : s->grid.end,
                                 .why = s->why};
    for (size_t i = 0; i < s->chain_count; i++) {
        needs->fields |= report_fields(s, &s->chains[i]);
        needs->checked |= has_measures(s, &s->chains[i]);
    }
    if (!s->measured)
        return;
    needs->fields |= BEAD_MEASURE_FIELDS;
    needs->beads = (struct bead_span){0, SIZE_MAX};
    needs->states = true;
    needs->each = s->each;
}

static enum bead_error take_room(struct bead_sink *s, struct report_chain *c, struct bead_message *msg)
{
    const struct bead_area_setup setup = {c->value,
                                          {s->grid.start, s->grid.end},
                                          c->values < IMAGE_TIMES ? (int)c->values : IMAGE_TIMES,
                                          IMAGE_TIMES,
                                          BEAD_SAMPLING_AREA};
    c->field = calloc(s->samples * c->values, sizeof *c->field);
    c->displacement = c->beads ? calloc(s->samples * c->beads_shown, sizeof *c->displacement) : NULL;
    if (!c->field || (c->beads && !c->displacement))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a report");
    BEAD_TRY(bead_area_create(&setup, &c->area, msg));
    if (s->held)
        BEAD_TRY(bead_held_create(c->chain, report_fields(s, c), s->output->shown.beads, &c->held, msg));
    if (!s->measured)
        return BEAD_OK;
    BEAD_TRY(bead_measures_create(c->chain, false, &c->measures, msg));
    return bead_measures_create(c->chain, true, &c->check, msg);
}

static enum bead_error report_begin(struct bead_sink *s, struct bead_range, struct bead_message *msg)
{
    s->magnify = s->output->views.magnify > 0 ? s->output->views.magnify : bead_magnify_auto(s->context.chains, s->chain_count);
    for (size_t i = 0; i < s->chain_count; i++)
        BEAD_TRY(take_room(s, &s->chains[i], msg));
    return BEAD_OK;
}

static void keep(const double *values, struct bead_span span, size_t sample, float *kept)
{
    size_t count = span.last - span.first + 1;
    for (size_t i = 0; i < count; i++)
        kept[sample * count + i] = (float)values[span.first + i];
}

static enum bead_error report_sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    struct report_chain *c = &s->chains[sample->chain];
    const size_t index = c->fed++;
    enum bead_error err = c->check && sample->check ? bead_measures_feed(c->check, sample->check, msg) : BEAD_OK;
    c->unknown = c->unknown || !sample->check;
    if (err || index % s->each > 0)
        return err;
    if (c->measures)
        BEAD_TRY(bead_measures_feed(c->measures, sample, msg));
    if (c->held)
        bead_held_feed(c->held, sample);
    if (index % s->stride > 0)
        return BEAD_OK;
    if (sample->index != index || c->kept == s->samples)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: sample %zu of chain %zu arrived out of order", s->path, sample->index,
                         sample->chain);
    const struct bead_sample *shown = c->held ? bead_held_take(c->held) : sample;
    const double *values = shown->field[s->output->shown.field];
    keep(values, c->value, c->kept, c->field);
    if (c->beads)
        keep(shown->field[BEAD_FIELD_DISPLACEMENT], c->bead, c->kept, c->displacement);
    bead_area_feed(c->area, shown->time, values, shown->active);
    bead_tale_feed(s->tale, shown);
    c->kept++;
    return BEAD_OK;
}

/* Finds one range of colours for all chains, without the strike, as in stills. */
static void find_range(struct bead_sink *s)
{
    struct bead_shown_values shown = BEAD_NOTHING_SHOWN;
    shown.rest = bead_colour_range_rest(s->context.chains, s->chain_count, s->output->shown.field);
    for (size_t i = 0; i < s->chain_count; i++) {
        const struct report_chain *c = &s->chains[i];
        for (size_t k = 0; k < c->kept * c->values; k++) {
            shown.least = fmin(shown.least, c->field[k]);
            shown.largest = fmax(shown.largest, c->field[k]);
        }
        bead_area_widen(c->area, &shown);
    }
    s->range = bead_colour_range_find(&s->output->colours, bead_chain_signed(s->context.chains[0], s->output->shown.field), &shown);
}

static enum bead_error report_end(struct bead_sink *s, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    s->outcomes = outcomes;
    find_range(s);
    BEAD_TRY(load_maps(s, msg));
    return report_write_page(&report_run_page, s->context.scene, s, s->path, &s->bytes, msg);
}

static void report_result(const struct bead_sink *s, uint64_t *bytes, uint64_t *items)
{
    *bytes = s->bytes;
    *items = s->samples;
}

/* Runs after the other outputs, so that it can show their pictures. */
const struct bead_sink_type bead_report_sink = {
    .name = "report",
    .help = "a page for browsers that plays the run, with its peaks, pictures and scene",
    .kind = BEAD_OUTPUT_REPORT,
    .background = true,
    .create = report_create,
    .needs = report_needs,
    .begin = report_begin,
    .sample = report_sample,
    .end = report_end,
    .destroy = report_destroy,
    .result = report_result,
};
