/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs single configurations of a sweep for pictures: delivers samples as they come, and measures of each run. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "beadreel/participation.h"
#include "sim/base/thread_pool.h"
#include "sim/chain/chain_data.h"
#include "sim/run/run.h"
#include "sim/sweep/sweep_data.h"

struct work {
    const struct bead_sweep *sweep;
    const struct bead_sweep_settings *settings;
    const struct bead_kernels *kernels;
    struct bead_sweep_watch *watches;
    size_t count;
    double *clean; /* [panels]: participation of the wave with all random cells up */
};

/* One run: until the front arrives if no end is given, and from sample to sample if somebody takes them. */
struct watched {
    const struct work *work;
    struct bead_sweep_watch *watch;
    const struct bead_chain *chain;
    struct bead_run *run;
    double end;     /* s; INFINITY: until the front arrives */
    size_t samples; /* given away */
    bool measured;
};

static enum bead_error give_samples(struct watched *w, struct bead_message *msg)
{
    const struct bead_sweep_watch *watch = w->watch;
    const struct bead_span all = {0, w->chain->beads - 1};
    for (;; w->samples++) {
        double t = (double)w->samples * watch->every;
        if (t > bead_run_time(w->run) || t > w->end * (1 + 1e-9))
            return BEAD_OK;
        struct bead_sample sample = {.index = w->samples};
        enum bead_error err = bead_run_sample(w->run, fmin(t, w->end), watch->fields, all, &sample, msg);
        if (!err)
            err = watch->take(watch->context, &sample, msg);
        if (err)
            return err;
    }
}

/* At the front's arrival, which lies in the step just made. */
static enum bead_error watched_measure(struct watched *w, struct bead_message *msg)
{
    const unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    struct bead_sweep_watch *watch = w->watch;
    struct bead_sample sample = {0};
    w->measured = true;
    watch->arrival = bead_run_arrival(w->run);
    enum bead_error err = bead_run_sample(w->run, watch->arrival, fields, (struct bead_span){0, w->chain->beads - 1}, &sample, msg);
    if (!err)
        watch->participation =
            bead_chain_participation(w->chain, sample.field[BEAD_FIELD_DISPLACEMENT], sample.field[BEAD_FIELD_VELOCITY]);
    return err;
}

static enum bead_error play(struct watched *w, struct bead_message *msg)
{
    const double give_up = bead_sweep_give_up(w->chain, w->end);
    for (uint64_t step = 0;; step++) {
        enum bead_error err = w->watch->take ? give_samples(w, msg) : BEAD_OK;
        if (!err && !w->measured && !isnan(bead_run_arrival(w->run)))
            err = watched_measure(w, msg);
        double now = bead_run_time(w->run);
        if (err || now >= w->end || (isinf(w->end) && w->measured))
            return err;
        err = bead_sweep_step(w->work->sweep, w->run, step, give_up, w->work->settings->stop, msg);
        if (err)
            return err;
    }
}

/* If most cells are reversed, the clean wave is that of the reversed cell. */
static enum bead_error compare(struct watched *w, struct bead_message *msg)
{
    double clean = w->work->clean[w->watch->panel];
    size_t up = 0, down = 0;
    for (const char *spin = bead_chain_spins(w->chain); *spin; spin++) {
        up += *spin == '1';
        down += *spin == '0';
    }
    enum bead_error err = down > up ? bead_participation_clean(w->chain, &clean, msg) : BEAD_OK;
    w->watch->order = bead_clean_index(w->chain->beads, w->watch->participation, clean);
    return err;
}

static enum bead_error run_one(struct watched *w, struct bead_message *msg)
{
    const struct bead_sweep *sweep = w->work->sweep;
    struct bead_span span = bead_sweep_place_span(&sweep->panels[w->watch->panel], w->chain, 0);
    span.last = span.last < w->chain->beads ? span.last : w->chain->beads - 1;
    span.first = span.first < span.last ? span.first : span.last;
    const struct bead_run_settings settings = {.chain = w->chain,
                                               .simulate = &sweep->scene->simulate,
                                               .kernels = w->work->kernels,
                                               .end = w->end,
                                               .passage =
                                                   isnan(sweep->scene->simulate.until) ? BEAD_PASSAGE_OF_FRONT : BEAD_PASSAGE_NONE,
                                               .bead_peaks = true,
                                               .peak_span = &span};
    enum bead_error err = bead_run_create(&settings, &w->run, msg);
    if (!err)
        err = play(w, msg);
    if (!err) {
        struct bead_outcome outcome;
        bead_run_finish(w->run, isinf(w->end) ? w->watch->arrival : w->end, &outcome);
        w->watch->force = 0;
        for (size_t j = span.first; j <= span.last; j++)
            w->watch->force = fmax(w->watch->force, outcome.bead_peaks[j].value);
        err = compare(w, msg);
    }
    bead_run_destroy(w->run);
    return err;
}

static enum bead_error work_on(void *context, size_t index, bool calling, struct bead_message *msg)
{
    struct work *work = context;
    struct bead_sweep_watch *watch = &work->watches[index];
    struct bead_sweep_chain *chain = NULL;
    struct watched w = {.work = work, .watch = watch};
    if (calling && work->settings->progress) {
        struct bead_progress progress = {
            .what = "watching", .done = (double)index / (double)work->count, .time = NAN, .items = (double)index, .item = "chains"};
        work->settings->progress(work->settings->progress_context, &progress);
    }
    watch->arrival = watch->participation = watch->order = NAN;
    w.end = watch->end > 0 ? watch->end : INFINITY;
    enum bead_error err = bead_sweep_chain_create(work->sweep, watch->panel, watch->index, &chain, msg);
    if (err)
        return err;
    w.chain = bead_sweep_chain_of(chain);
    err = run_one(&w, msg);
    bead_sweep_chain_destroy(chain);
    return err;
}

static enum bead_error find_clean(struct work *work, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    work->clean = calloc(work->sweep->panel_count, sizeof *work->clean);
    if (!work->clean)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the clean waves of a sweep");
    for (size_t p = 0; p < work->sweep->panel_count && !err; p++) {
        struct bead_sweep_chain *chain = NULL;
        err = bead_sweep_chain_create(work->sweep, p, BEAD_SWEEP_CLEAN, &chain, msg);
        if (!err)
            err = bead_participation_clean(bead_sweep_chain_of(chain), &work->clean[p], msg);
        bead_sweep_chain_destroy(chain);
    }
    return err;
}

enum bead_error bead_sweep_watch(const struct bead_sweep *sweep, struct bead_sweep_watch *watches, size_t count,
                                 const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    struct bead_sweep_settings own;
    enum bead_error err = bead_sweep_settings_take(&own, settings, msg);
    if (err)
        return err;
    settings = &own;
    struct work work = {
        .sweep = sweep, .settings = settings, .kernels = bead_kernels_find(settings->instructions), .watches = watches};
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    work.count = count;
    if (!work.kernels)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--instructions %s: this machine has no such kernels", settings->instructions);
    err = find_clean(&work, msg);
    if (!err)
        err = bead_thread_pool_run(count,
                                   settings->threads > 0 ? settings->threads
                                   : cores > 1           ? (int)cores
                                                         : 1,
                                   work_on, &work, msg);
    free(work.clean);
    return err;
}
