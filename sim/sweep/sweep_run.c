/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes a sweep, one chain per thread, and puts the results into their places. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/base/stop.h"
#include "sim/base/thread_pool.h"
#include "sim/chain/chain_data.h"
#include "sim/run/run.h"
#include "sim/sweep/sweep_data.h"

/* Steps between checks of whether the user wants to stop. */
enum { LOOK_EVERY = 64 };
/* A front that takes this many times longer than a wave needs for the chain will never arrive. */
static const double patience = 200;
/* A clean pulse in a chain of dimers has all but 1e-4 of its energy within three beads of its peak; four leave room for a pulse
 * that disorder has widened. */
enum { REACH = 4 };

/* What is measured of one chain. */
struct measure {
    struct bead_sweep *sweep;
    struct sweep_panel *panel;
    size_t row;
    const struct bead_chain *chain;
    struct bead_span span; /* beads whose peak forces are wanted */
    double *seen;          /* [beads] s: times of the peaks whose energy is known; NULL: not wanted */
};

/* The bead range of a place. */
struct bead_span bead_sweep_place_span(const struct sweep_panel *panel, const struct bead_chain *chain, size_t place)
{
    const struct bead_sweep_spec *spec = panel->shown.spec;
    const struct bead_sweep_measures *measures = &spec->measures;
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    for (size_t i = 0; measures->sensor_count && i < count; i++) {
        if (strcmp(sensors[i].name, measures->sensors[place]) == 0)
            return (struct bead_span){sensors[i].bead, sensors[i].bead};
    }
    return (struct bead_span){spec->last + measures->beads[0], spec->last + measures->beads[1]};
}

static void find_span(struct measure *m)
{
    m->span = (struct bead_span){SIZE_MAX, 0};
    for (size_t i = 0; i < m->panel->shown.places; i++) {
        struct bead_span place = bead_sweep_place_span(m->panel, m->chain, i);
        m->span.first = place.first < m->span.first ? place.first : m->span.first;
        m->span.last = place.last > m->span.last ? place.last : m->span.last;
    }
    if (m->panel->profiles)
        m->span = (struct bead_span){0, m->panel->shown.beads - 1};
}

static double *profile_of(const struct measure *m, enum sweep_profile which)
{
    return m->panel->profiles + (PROFILES * m->row + which) * m->panel->shown.beads;
}

/* Energy about the beads whose force has come to a new peak in the step just made. */
static enum bead_error watch_energies(struct measure *m, struct bead_run *run, struct bead_message *msg)
{
    const struct bead_peak *found = bead_run_bead_peaks(run);
    double *front = profile_of(m, PROFILE_ENERGY);
    for (size_t j = 0; j < m->panel->shown.beads; j++) {
        if (isnan(found[j].time) || found[j].time == m->seen[j])
            continue;
        struct bead_span about = {j > REACH ? j - REACH : 0, j + REACH};
        struct bead_sample sample = {.chain = 0};
        enum bead_error err = bead_run_sample(run, found[j].time, BEAD_FIELD_BIT(BEAD_FIELD_ENERGY), about, &sample, msg);
        if (err)
            return err;
        m->seen[j] = found[j].time;
        front[j] = 0;
        for (size_t i = about.first; i <= about.last && i < sample.active; i++)
            front[j] += sample.field[BEAD_FIELD_ENERGY][i];
    }
    return BEAD_OK;
}

/* The chain at the end of the run, up to the front. */
static enum bead_error keep_last(const struct measure *m, struct bead_run *run, double end, struct bead_message *msg)
{
    static const unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_ENERGY);
    const size_t beads = m->panel->shown.beads;
    struct bead_sample sample = {.chain = 0};
    enum bead_error err = bead_run_sample(run, end, fields, (struct bead_span){0, beads - 1}, &sample, msg);
    for (size_t j = 0; !err && j < beads && j < sample.active; j++) {
        profile_of(m, PROFILE_LAST_FORCE)[j] = sample.field[BEAD_FIELD_FORCE][j];
        profile_of(m, PROFILE_LAST_ENERGY)[j] = sample.field[BEAD_FIELD_ENERGY][j];
    }
    return err;
}

double bead_sweep_give_up(const struct bead_chain *chain, double end)
{
    return isfinite(end) ? INFINITY : patience * bead_chain_passage(chain, bead_chain_energy(chain));
}

enum bead_error bead_sweep_step(const struct bead_sweep *sweep, struct bead_run *run, uint64_t step, double give_up,
                                const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    const double now = bead_run_time(run);
    if (step % LOOK_EVERY == 0 && bead_stop_is_asked(stop))
        return bead_fail(msg, BEAD_ERROR_STOPPED, "stopped");
    if (now > give_up)
        return bead_fail(msg, BEAD_ERROR_NUMBERS,
                         "%s: a configuration's front has not reached the end after %.4g s: give simulate.until",
                         sweep->scene->file, now);
    return bead_run_step(run, msg);
}

static enum bead_error play(struct measure *m, struct bead_run *run, double end, const volatile sig_atomic_t *stop,
                            struct bead_message *msg)
{
    const double give_up = bead_sweep_give_up(m->chain, end);
    for (uint64_t step = 0;; step++) {
        double from = bead_run_time(run);
        if (isfinite(end) ? from >= end : !isnan(bead_run_arrival(run)))
            return BEAD_OK;
        enum bead_error err = bead_sweep_step(m->sweep, run, step, give_up, stop, msg);
        if (!err && m->seen)
            err = watch_energies(m, run, msg);
        if (err)
            return err;
    }
}

static void collect(const struct measure *m, const struct bead_peak *found)
{
    const struct bead_sweep_panel *shown = &m->panel->shown;
    for (size_t i = 0; i < shown->places; i++) {
        struct bead_span span = bead_sweep_place_span(m->panel, m->chain, i);
        struct bead_sweep_peak *peak = &m->panel->peaks[m->row * shown->places + i];
        *peak = (struct bead_sweep_peak){found[span.first].value, found[span.first].time, (uint32_t)span.first, 0};
        for (size_t j = span.first + 1; j <= span.last; j++) {
            if (found[j].value > peak->force)
                *peak = (struct bead_sweep_peak){found[j].value, found[j].time, (uint32_t)j, 0};
        }
        for (size_t j = span.first; j <= span.last; j++)
            peak->open |= found[j].open;
    }
    if (!m->panel->profiles)
        return;
    for (size_t j = 0; j < shown->beads; j++)
        profile_of(m, PROFILE_FORCE)[j] = found[j].value;
}

static enum bead_error sweep_measure(struct measure *m, const struct bead_kernels *kernels, const volatile sig_atomic_t *stop,
                                     struct bead_message *msg)
{
    const double until = m->sweep->scene->simulate.until;
    find_span(m);
    struct bead_run_settings settings = {.chain = m->chain,
                                         .simulate = &m->sweep->scene->simulate,
                                         .kernels = kernels,
                                         .end = isnan(until) ? INFINITY : until,
                                         .passage = isnan(until) ? BEAD_PASSAGE_OF_FRONT : BEAD_PASSAGE_NONE,
                                         .bead_peaks = true,
                                         .peak_span = &m->span};
    struct bead_run *run = NULL;
    enum bead_error err = bead_run_create(&settings, &run, msg);
    if (!err && m->panel->profiles && !(m->seen = calloc(m->panel->shown.beads, sizeof *m->seen)))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the energies of %zu beads", m->panel->shown.beads);
    if (!err)
        err = play(m, run, settings.end, stop, msg);
    if (!err) {
        struct bead_outcome outcome;
        double end = isfinite(settings.end) ? settings.end : bead_run_arrival(run);
        bead_run_finish(run, end, &outcome);
        collect(m, outcome.bead_peaks);
        if (m->seen)
            err = keep_last(m, run, end, msg);
    }
    free(m->seen);
    bead_run_destroy(run);
    return err;
}

/* Compute one job's results into its place. Errors: MEMORY, NUMBERS, SCENE, STOPPED. */
static enum bead_error compute(struct bead_sweep *sweep, size_t job, const struct bead_kernels *kernels,
                               const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    struct bead_sweep_chain *chain = NULL;
    struct measure m = {.sweep = sweep};
    m.panel = bead_sweep_panel_of(sweep, job, &m.row);
    enum bead_error err = bead_sweep_chain_create(sweep, (size_t)(m.panel - sweep->panels), m.row - 1, &chain, msg);
    if (err)
        return err;
    m.chain = bead_sweep_chain_of(chain);
    err = sweep_measure(&m, kernels, stop, msg);
    bead_sweep_chain_destroy(chain);
    return err;
}

/* ---- all of them ---- */

struct work {
    struct bead_sweep *sweep;
    const struct bead_sweep_settings *settings;
    const struct bead_kernels *kernels;
    struct bead_sweep_journal *journal;
    pthread_mutex_t lock; /* of the journal */
    size_t *jobs;         /* [count]: to do */
    size_t count, done_before, all;
    atomic_size_t done;
};

static void tell(const struct work *w, size_t done)
{
    if (!w->settings->progress)
        return;
    struct bead_progress progress = {.what = "sweeping",
                                     .done = (double)(w->done_before + done) / (double)w->all,
                                     .time = NAN,
                                     .items = (double)(w->done_before + done),
                                     .item = "chains"};
    w->settings->progress(w->settings->progress_context, &progress);
}

static enum bead_error work_on(void *context, size_t index, bool calling, struct bead_message *msg)
{
    struct work *w = context;
    size_t job = w->jobs[index];
    if (calling)
        tell(w, atomic_load(&w->done));
    enum bead_error err = compute(w->sweep, job, w->kernels, w->settings->stop, msg);
    if (!err && w->journal) {
        pthread_mutex_lock(&w->lock);
        err = bead_sweep_journal_add(w->journal, w->sweep, job, msg);
        pthread_mutex_unlock(&w->lock);
    }
    if (!err) {
        w->sweep->known[job] = 1;
        atomic_fetch_add(&w->done, 1);
    }
    return err;
}

static enum bead_error list_jobs(struct work *w, struct bead_message *msg)
{
    w->jobs = calloc(w->sweep->jobs, sizeof *w->jobs);
    if (!w->jobs)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a sweep");
    for (size_t job = 0; job < w->sweep->jobs; job++) {
        if (!bead_sweep_mine(w->sweep, job))
            continue;
        w->all++;
        if (!w->sweep->known[job])
            w->jobs[w->count++] = job;
    }
    w->done_before = w->all - w->count;
    return BEAD_OK;
}

enum bead_error bead_sweep_run(struct bead_sweep *sweep, const struct bead_sweep_settings *settings, uint64_t *computed,
                               struct bead_message *msg)
{
    struct bead_sweep_settings own;
    enum bead_error err = bead_sweep_settings_take(&own, settings, msg);
    if (err)
        return err;
    settings = &own;
    struct work w = {.sweep = sweep, .settings = settings, .kernels = bead_kernels_find(settings->instructions)};
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int threads = settings->threads > 0 ? settings->threads : cores > 1 ? (int)cores : 1;
    if (!w.kernels)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--instructions %s: this machine has no such kernels", settings->instructions);
    if (settings->parts > 0) {
        sweep->part = settings->part;
        sweep->parts = settings->parts;
    }
    err = settings->journal ? bead_sweep_journal_open(sweep, settings->journal, &w.journal, msg) : BEAD_OK;
    if (!err)
        err = list_jobs(&w, msg);
    if (!err && pthread_mutex_init(&w.lock, NULL) != 0)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "no lock for a sweep");
    if (!err) {
        tell(&w, 0);
        err = bead_thread_pool_run(w.count, threads, work_on, &w, msg);
        pthread_mutex_destroy(&w.lock);
    }
    if (computed)
        *computed = atomic_load(&w.done);
    bead_sweep_journal_close(w.journal);
    free(w.jobs);
    return err;
}

enum bead_error bead_sweep_part_path(const char *path, size_t part, size_t parts, char **name, struct bead_message *msg)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    size_t stem = dot ? (size_t)(dot - path) : strlen(path);
    *name = NULL;
    if (asprintf(name, "%.*s.%zuof%zu%s", (int)stem, path, part, parts, path + stem) >= 0)
        return BEAD_OK;
    *name = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a name");
}
