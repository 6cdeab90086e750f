/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images of sweeps: mean, median or standard deviation of a field over all configurations, in space and time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/render.h"
#include "render/figure/still.h"
#include "sim/base/memory.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_internal.h"

/* Samples along time; linear in between. */
enum { TIMES = 600 };

/* One configuration's samples. */
struct film {
    double *values; /* [TIMES + 1][places] */
    size_t places, taken;
    enum bead_field field;
};

struct ensemble {
    const struct bead_sweep *sweep;
    const struct bead_output *output;
    struct film *films;
    struct bead_sweep_watch *watches;
    size_t count, places;
    double end;
};

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *)
{
    struct film *film = context;
    for (size_t j = 0; j < film->places && j < sample->active && film->taken <= TIMES; j++)
        film->values[film->taken * film->places + j] = sample->field[film->field][j];
    film->taken++;
    return BEAD_OK;
}

static enum bead_error make_film(struct ensemble *e, size_t i, struct bead_message *msg)
{
    struct film *film = &e->films[i];
    BEAD_LEFT_TO(bead_sweep_chain_left) struct bead_sweep_chain *made = NULL;
    BEAD_TRY(bead_sweep_chain_create(e->sweep, 0, i, &made, msg));
    const struct bead_chain *chain = bead_sweep_chain_of(made);
    *film = (struct film){.places = bead_chain_beads(chain), .field = e->output->shown.field};
    e->places = i == 0 ? film->places : e->places;
    if (film->places != e->places)
        return bead_output_wrong(e->output, msg, "image: chains have %zu and %zu beads; a mean needs chains of equal length",
                                 e->places, film->places);
    return bead_new(&film->values, (TIMES + 1) * film->places, msg, "the samples of %zu chains", e->count);
}

static enum bead_error run(struct ensemble *e, const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    for (size_t i = 0; i < e->count; i++) {
        BEAD_TRY(make_film(e, i, msg));
        e->watches[i] = (struct bead_sweep_watch){.index = i,
                                                  .end = e->end,
                                                  .fields = BEAD_FIELD_BIT(e->output->shown.field),
                                                  .every = e->end / TIMES,
                                                  .take = take,
                                                  .context = &e->films[i]};
    }
    return bead_sweep_watch(e->sweep, e->watches, e->count, settings, msg);
}

static const struct {
    const char *name;
    size_t offset; /* in struct bead_summary */
} statistics[] = {[BEAD_SWEEP_MEDIAN] = {"median", offsetof(struct bead_summary, median)},
                  [BEAD_SWEEP_MEAN] = {"mean", offsetof(struct bead_summary, mean)},
                  [BEAD_SWEEP_DEVIATION] = {"standard deviation", offsetof(struct bead_summary, deviation)},
                  [BEAD_SWEEP_LOWER_QUARTILE] = {"lower quartile", offsetof(struct bead_summary, quartile[0])},
                  [BEAD_SWEEP_UPPER_QUARTILE] = {"upper quartile", offsetof(struct bead_summary, quartile[1])}};

/* Over the configurations, in their order, for the same bits with any number of threads. */
static double statistic(const struct ensemble *e, size_t at, double *values)
{
    struct bead_summary summary;
    for (size_t i = 0; i < e->count; i++)
        values[i] = e->films[i].values[at];
    bead_summary_of(values, e->count, &summary);
    return *(const double *)(const void *)((const char *)&summary + statistics[e->output->sweep_curves.show].offset);
}

static enum bead_error reduce(struct ensemble *e, double *result, struct bead_message *msg)
{
    BEAD_FREED double *values = NULL;
    BEAD_TRY(bead_new(&values, e->count, msg, "an image of a sweep"));
    for (size_t at = 0; at < (TIMES + 1) * e->places; at++) {
        const double value = statistic(e, at, values);
        result[at] = isnan(value) ? 0 : value; /* deviation of one chain */
    }
    return BEAD_OK;
}

/* An image of one chain's run, fed with the ensemble's numbers. */
struct drawing {
    struct bead_output output;
    struct bead_run_context context;
    char title[80];
    struct bead_sweep_chain *made;
    const struct bead_chain *chain;
    struct bead_sink *sink;
};

static enum bead_error open_drawing(const struct ensemble *e, const struct bead_run_context *context, const char *path,
                                    struct drawing *d, struct bead_message *msg)
{
    *d = (struct drawing){.output = *e->output, .context = *context};
    d->output.path = (char *)(uintptr_t)path; /* read only */
    d->output.views.kinds[0] = BEAD_VIEW_SPACETIME;
    d->output.views.count = 1;
    snprintf(d->title, sizeof d->title, "%s of %zu chains", statistics[e->output->sweep_curves.show].name, e->count);
    d->output.panel.title = d->title;
    BEAD_TRY(bead_sweep_chain_create(e->sweep, 0, 0, &d->made, msg));
    d->chain = bead_sweep_chain_of(d->made);
    d->context.chains = &d->chain;
    d->context.chain_count = 1;
    d->context.end = e->end;
    d->context.native = (struct bead_grid){.every = e->end / TIMES, .end = e->end};
    d->context.resolution = e->end / TIMES;
    d->context.directory = ".";
    d->context.sweep = NULL;
    d->context.replayed = true;
    return bead_image_sink.create(&d->output, &d->context, &d->sink, msg);
}

static void close_drawing(struct drawing *d)
{
    bead_image_sink.destroy(d->sink);
    bead_sweep_chain_destroy(d->made);
}

static enum bead_error draw(struct ensemble *e, const struct bead_run_context *context, const char *path, const double *result,
                            struct bead_message *msg)
{
    BEAD_LEFT_TO(close_drawing) struct drawing d;
    BEAD_TRY(open_drawing(e, context, path, &d, msg));
    BEAD_TRY(bead_image_sink.begin(d.sink, (struct bead_range){0, 0}, msg));
    for (size_t i = 0; i <= TIMES; i++) {
        struct bead_sample sample = {.time = fmin((double)i * d.context.native.every, e->end), .index = i, .active = e->places};
        sample.field[d.output.shown.field] = result + i * e->places;
        BEAD_TRY(bead_image_sink.sample(d.sink, &sample, msg));
    }
    return bead_image_sink.end(d.sink, NULL, msg);
}

/* Does the image fit its page? Without `until`, nobody knows yet when it ends, and which times it may show. */
static enum bead_error check_image(const struct bead_output *output, const struct bead_run_context *context,
                                   struct bead_message *msg)
{
    const double until = bead_sweep_scene(context->sweep)->simulate.until;
    struct bead_output shown = *output;
    if (isnan(until))
        shown.shown.time[0] = shown.shown.time[1] = NAN;
    const struct ensemble e = {.sweep = context->sweep,
                               .output = &shown,
                               .count = bead_sweep_panel(context->sweep, 0)->configurations,
                               .end = isnan(until) ? 1 : until};
    BEAD_LEFT_TO(close_drawing) struct drawing d;
    return open_drawing(&e, context, output->path, &d, msg);
}

static enum bead_error make(struct ensemble *e, const struct bead_run_context *context, const char *path, struct bead_message *msg)
{
    BEAD_FREED double *result = NULL;
    BEAD_TRY(bead_new(&e->films, e->count, msg, "an image of a sweep"));
    BEAD_TRY(bead_new(&e->watches, e->count, msg, "an image of a sweep"));
    for (size_t i = 0; i < e->count; i++)
        e->watches[i].index = i;
    BEAD_TRY(bead_sweep_end(e->sweep, e->watches, e->count, context->sweep_settings, &e->end, msg));
    BEAD_TRY(run(e, context->sweep_settings, msg));
    BEAD_TRY(bead_new(&result, (TIMES + 1) * e->places, msg, "an image of a sweep"));
    BEAD_TRY(reduce(e, result, msg));
    return draw(e, context, path, result, msg);
}

static enum bead_error write_image(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                   uint64_t *, struct bead_message *msg)
{
    struct ensemble e = {.sweep = context->sweep, .output = output, .count = bead_sweep_panel(context->sweep, 0)->configurations};
    enum bead_error err = make(&e, context, path, msg);
    for (size_t i = 0; e.films && i < e.count; i++)
        free(e.films[i].values);
    free(e.films);
    free(e.watches);
    return err;
}

static const char *image_why(const struct bead_output *output)
{
    return output->sweep_curves.show == BEAD_SWEEP_DEVIATION
               ? "standard deviation of a field over all chains, in space and time"
               : "mean, median or quartile of a field over all chains, in space and time";
}

const struct bead_sink_type bead_sweep_image_sink = {.name = "image",
                                                     .help = "mean of a field over the chains of a sweep",
                                                     .kind = BEAD_OUTPUT_IMAGE,
                                                     .check = check_image,
                                                     .why = image_why,
                                                     .write = write_image,
                                                     .runs_chains = true,
                                                     .without_results = true};
