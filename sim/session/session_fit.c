/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `fit`: before anything else, finds the values of keys for which the first chain moves as measured. Each try is a scene with other
 * values, and a run of its first chain. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/measure/places.h"
#include "sim/measure/recorded.h"
#include "sim/scene/scene_internal.h"
#include "sim/session/session_data.h"
#include "sim/statistics/least_squares.h"

/* Samples in the time that shows every oscillation: a cubic through four of them is then accurate to about 1e-5 of a peak. */
static const double finer = 4;

struct fit {
    const struct bead_session *session;
    size_t output, count; /* the one with measured curves; how many of them the chain has */
    double from, to;      /* s: of the points that count */
    double end, every;    /* s: of runs and samples */
};

static enum bead_error change(const struct bead_session *s, const double *x, struct bead_scene **scene, struct bead_message *msg)
{
    struct bead_override all[BEAD_FIT_KEYS];
    char value[BEAD_FIT_KEYS][80];
    const struct bead_fit *fit = &s->scene->fit;
    for (size_t k = 0; k < fit->count; k++) {
        snprintf(value[k], sizeof value[k], "%.17g%s%s", x[k], *fit->keys[k].unit ? " " : "", fit->keys[k].unit);
        all[k] = (struct bead_override){.origin = "fit", .path = fit->keys[k].path, .place = {1, 1}, .value = value[k]};
    }
    return bead_scene_change(s->scene, &(struct bead_overrides){.all = all, .count = fit->count}, scene, msg);
}

/* ---- a run ---- */

struct record {
    const struct bead_output *output;
    const struct bead_chain *chain;
    struct bead_recorded curves;
    double *values; /* [curves] */
};

static enum bead_error keep(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    struct record *record = consumer->context;
    for (size_t k = 0; k < record->curves.curves; k++) {
        const struct bead_place_shown place = bead_place_shown(record->output, record->chain, k);
        record->values[k] = sample->field[place.field][place.index];
    }
    return bead_recorded_add(&record->curves, sample->time, record->values, msg);
}

static enum bead_error play(const struct fit *f, const struct bead_scene *scene, struct record *record, struct bead_message *msg)
{
    const struct bead_session *s = f->session;
    struct bead_consumer consumer = {.needs = {.beads = {SIZE_MAX, 0}, .grid = {.every = f->every, .end = f->end}, .until = f->end},
                                     .take = keep,
                                     .context = record};
    const struct bead_play run = {.chains = &record->chain,
                                  .chain_count = 1,
                                  .simulate = &scene->simulate,
                                  .kernels = s->kernels,
                                  .consumers = &consumer,
                                  .consumer_count = 1,
                                  .end = f->end,
                                  .needed = f->end,
                                  .threads = 1,
                                  .stop = s->job.stop};
    bead_places_need(record->output, record->chain, &consumer.needs);
    BEAD_LEFT_TO(bead_played_free) struct bead_played played;
    return bead_play(&run, &played, msg);
}

static bool counts(const struct fit *f, const struct bead_wave_point *point)
{
    return point->time >= f->from && point->time <= f->to;
}

/* Residuals: computed less measured. The first scene decides which points count: this one's may begin at another time. */
static enum bead_error compare(const struct fit *f, const struct bead_scene *scene, double *r, struct bead_message *msg)
{
    struct bead_chain *chain = NULL;
    struct record record = {.output = &scene->outputs[f->output], .curves = {.curves = f->count}};
    enum bead_error err = bead_chain_create(scene, 0, &chain, msg);
    record.chain = chain;
    if (!err)
        err = bead_new(&record.values, f->count, msg, "a fit");
    if (!err)
        err = play(f, scene, &record, msg);
    for (size_t k = 0; !err && k < f->count; k++) {
        const struct bead_measured *m = &record.output->curves.measured[k],
                                   *first = &f->session->scene->outputs[f->output].curves.measured[k];
        for (size_t i = 0; i < m->count; i++) {
            if (counts(f, &first->points[i]))
                *r++ = bead_recorded_at(&record.curves, k, m->points[i].time) - m->points[i].value;
        }
    }
    bead_recorded_free(&record.curves);
    free(record.values);
    bead_chain_destroy(chain);
    return err;
}

static enum bead_error residuals(const void *context, const double *x, double *r, struct bead_message *msg)
{
    const struct fit *f = context;
    BEAD_LEFT_TO(bead_scene_left) struct bead_scene *scene = NULL;
    BEAD_TRY(change(f->session, x, &scene, msg));
    return compare(f, scene, r, msg);
}

/* ---- the search ---- */

/* Counts the measured points; returns the last time. */
static double survey(const struct fit *f, const struct bead_output *output, struct bead_least_squares *search)
{
    double last = 0;
    for (size_t k = 0; k < f->count; k++) {
        const struct bead_measured *m = &output->curves.measured[k];
        for (size_t i = 0; i < m->count; i++) {
            if (!counts(f, &m->points[i]))
                continue;
            search->points++;
            search->size += m->points[i].value * m->points[i].value;
            last = fmax(last, m->points[i].time);
        }
    }
    search->size = sqrt(search->size);
    return last;
}

/* Runs go a little further than the points, which may move. */
static enum bead_error prepare(struct fit *f, struct bead_least_squares *search, struct bead_message *msg)
{
    const struct bead_scene *scene = f->session->scene;
    struct bead_chain *chain = NULL;
    struct bead_pace pace = {0};
    while (scene->outputs[f->output].curves.measured_count == 0)
        f->output++;
    const struct bead_output *output = &scene->outputs[f->output];
    BEAD_TRY(bead_chain_create(scene, 0, &chain, msg));
    const size_t places = bead_places_count(output, chain), given = output->curves.measured_count;
    f->count = given < places ? given : places;
    f->from = isnan(output->shown.time[0]) ? 0 : output->shown.time[0];
    f->to = isnan(output->shown.time[1]) ? INFINITY : output->shown.time[1];
    enum bead_error err = bead_run_kind_of(chain)->pace(chain, &scene->simulate, 1, &pace, msg);
    f->every = pace.resolution / finer;
    f->end = 1.1 * survey(f, output, search) + 10 * f->every;
    bead_chain_destroy(chain);
    return err || search->size > 0 ? err : bead_output_wrong(output, msg, "measured: has only zeros within these times");
}

enum bead_error bead_session_fit(struct bead_session *s, struct bead_message *msg)
{
    const struct bead_fit *fit = &s->scene->fit;
    struct fit f = {.session = s};
    const char *names[BEAD_FIT_KEYS];
    double x[BEAD_FIT_KEYS], error[BEAD_FIT_KEYS];
    struct bead_scene *scene = NULL;
    for (size_t k = 0; k < fit->count; k++) {
        names[k] = fit->keys[k].path;
        x[k] = fit->keys[k].first;
    }
    struct bead_least_squares search = {.parameters = fit->count,
                                        .residuals = residuals,
                                        .context = &f,
                                        .names = names,
                                        .threads = s->threads,
                                        .x = x,
                                        .error = error};
    BEAD_TRY(prepare(&f, &search, msg));
    BEAD_TRY(bead_least_squares(&search, msg));
    BEAD_TRY(change(s, x, &scene, msg));
    for (size_t k = 0; k < fit->count; k++) {
        scene->fit.keys[k].first = fit->keys[k].first;
        scene->fit.keys[k].error = error[k];
    }
    scene->fit.points = search.points;
    scene->fit.rms = search.rms;
    bead_scene_free(s->scene);
    s->scene = scene;
    return BEAD_OK;
}
