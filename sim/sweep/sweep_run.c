/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a sweep: measures each chain, and adds its results to the journal. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/run/behind.h"
#include "sim/run/method_choice.h"
#include "sim/run/uncertainty.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

/* A clean pulse in a chain of dimers has all but 1e-4 of its energy within three beads of its peak; four allow for a pulse widened
 * by disorder. */
enum { REACH = 4 };
/* One chain in so many is also played whole; the next one, and every long one, also finer. */
enum { ALSO_WHOLE = 64 };

/* The measurements of one chain. */
struct measure {
    struct sweep_panel *panel;
    size_t row;
    const struct bead_chain *chain;
    struct bead_span span; /* beads whose peak forces are measured */
    bool lost;             /* without results: the front never arrives, or the numbers cannot be trusted */
    double *profiles;      /* [PROFILES_OF_RUN][beads] of its run; NULL: not measured */
    double *seen;          /* [beads] s: times of the peaks whose energy is known */
};

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
    return m->profiles + which * m->panel->shown.beads;
}

/* Measures the energy around each bead whose force has reached a new peak in the last step. */
static enum bead_error watch_energies(const struct bead_consumer *consumer, size_t, struct bead_run *run, struct bead_message *msg)
{
    const struct measure *m = consumer->context;
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

/* Called before the run, to measure its profiles. */
static enum bead_error watch_profiles(struct measure *m, double *profiles, struct bead_consumer *consumer, struct bead_message *msg)
{
    m->profiles = profiles;
    consumer->step = watch_energies;
    return bead_new(&m->seen, m->panel->shown.beads, msg, "the energies of %zu beads", m->panel->shown.beads);
}

/* Called after the run: keeps the peaks, and forces and energies of the beads up to the front at its end. */
static enum bead_error keep_profiles(const struct measure *m, const struct bead_played *played, struct bead_message *msg)
{
    static const unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_ENERGY);
    const struct bead_outcome *outcome = &played->outcomes[0];
    const size_t beads = m->panel->shown.beads;
    struct bead_sample sample = {.chain = 0};
    BEAD_TRY(bead_run_sample(played->runs[0].run, outcome->end, fields, (struct bead_span){0, beads - 1}, &sample, msg));
    for (size_t j = 0; j < beads; j++)
        profile_of(m, PROFILE_FORCE)[j] = outcome->bead_peaks[j].value;
    for (size_t j = 0; j < beads && j < sample.active; j++) {
        profile_of(m, PROFILE_LAST_FORCE)[j] = sample.field[BEAD_FIELD_FORCE][j];
        profile_of(m, PROFILE_LAST_ENERGY)[j] = sample.field[BEAD_FIELD_ENERGY][j];
    }
    return BEAD_OK;
}

/* The largest peak of a place. */
static struct bead_sweep_peak peak_of(const struct measure *m, const struct bead_peak *found, size_t place)
{
    const struct bead_span span = bead_sweep_place_span(m->panel, m->chain, place);
    size_t most = span.first;
    bool open = false;
    for (size_t j = span.first; j <= span.last; j++) {
        most = found[j].value > found[most].value ? j : most;
        open |= found[j].open;
    }
    return (struct bead_sweep_peak){
        .force = found[most].value, .time = found[most].time, .bead = (uint32_t)most, .open = (uint32_t)open};
}

static void collect(const struct measure *m, const struct bead_peak *found)
{
    const struct bead_sweep_panel *shown = &m->panel->shown;
    for (size_t i = 0; i < shown->places; i++)
        m->panel->peaks[m->row * shown->places + i] = peak_of(m, found, i);
}

/* Plays it whole, too, and compares the peaks. */
static enum bead_error check_whole(const struct measure *m, const struct bead_play *asked, const struct bead_peak *found,
                                   struct bead_message *msg)
{
    struct bead_play play = *asked;
    struct bead_played whole = {.count = 0};
    play.widening = 0;
    play.target = 0;
    enum bead_error err = bead_play(&play, &whole, msg);
    for (size_t j = m->span.first; !err && j <= m->span.last; j++) {
        const double force = whole.outcomes[0].bead_peaks[j].value;
        if (fabs(found[j].value - force) > play.simulate->accuracy * force)
            err = bead_fail(msg, BEAD_ERROR_NUMBERS,
                            "sweep: chain %zu of `%s`: the peak of bead %zu is %.9g N without the beads far behind the front, and "
                            "%.9g N with them: give `whole: true`",
                            m->row, m->panel->shown.name, j, found[j].value, force);
    }
    bead_played_free(&whole);
    return err;
}

/* Are the errors of this configuration measured? Chains over keys differ, and the decay of each magnetism is a separate mean, so
 * more are measured if there are few; also if the step is given, as then there is no accuracy that all chains keep. */
static bool is_sampled(const struct sweep_panel *panel, bool has_step, size_t index)
{
    const struct bead_sweep_spec *spec = panel->shown.spec;
    size_t g = 0;
    if (bead_sweep_is_over(panel))
        return index % bead_sample_every(panel->shown.configurations) == 0;
    if (!panel->profiles && !has_step)
        return index % ALSO_WHOLE == 0;
    for (; index >= spec->groups[g].configurations; g++)
        index -= spec->groups[g].configurations;
    return index % bead_sample_every(spec->groups[g].configurations) == 0;
}

/* Errors of long chains differ. The decay of all chains is divided by the clean one's. */
static bool is_measured(const struct measure *m, bool has_step)
{
    const struct sweep_panel *panel = m->panel;
    if (!panel->profiles && panel->shown.places == 0)
        return false;
    return bead_is_long(m->chain) || (m->row > 0 ? is_sampled(panel, has_step, m->row - 1) : panel->profiles || has_step);
}

/* Plays it again with a smaller tolerance, and finds the uncertainty of its peaks. */
static enum bead_error measure_errors(const struct measure *m, const struct bead_play *asked, size_t try, struct bead_message *msg)
{
    struct measure again = *m;
    struct bead_consumer consumer = {.needs = {.bead_peaks = true}, .context = &again};
    struct bead_play play = *asked;
    struct bead_played finer = {.count = 0};
    play.consumers = &consumer;
    play.refinement = bead_play_check_factor(&play);
    if (m->profiles)
        BEAD_TRY(watch_profiles(&again, m->profiles + PROFILES_OF_RUN * m->panel->shown.beads, &consumer, msg));
    enum bead_error err = bead_play_cut(&play, &try, &finer, msg);
    if (!err && m->profiles)
        err = keep_profiles(&again, &finer, msg);
    for (size_t i = 0; !err && i < m->panel->shown.places; i++) {
        const double accuracy = play.simulate->step > 0 ? 0 : play.simulate->accuracy;
        struct bead_sweep_peak *peak = &m->panel->peaks[m->row * m->panel->shown.places + i],
                               other = peak_of(m, finer.outcomes[0].bead_peaks, i);
        peak->uncertainty = bead_uncertainty_measured(accuracy, peak->force, other.force);
        peak->time_uncertainty = bead_uncertainty_measured(accuracy, peak->time, other.time);
    }
    if (m->profiles)
        free(again.seen);
    bead_played_free(&finer);
    return err;
}

const char *bead_sweep_refusal(const struct sweep_panel *panel, const struct bead_chain *chain)
{
    if (panel->shown.spec->whole)
        return "as asked";
    if (bead_sweep_is_over(panel))
        return "the chains may be any";
    if (panel->profiles)
        return "the decay is measured on all of them";
    return isnan(bead_chain_scene(chain)->simulate.until) ? bead_behind_refusal(chain) : "the runs end at a given time";
}

/* Plays the chain of a job and stores its results; *try: the first to make, then that of the results. */
static enum bead_error sweep_measure(struct measure *m, const struct bead_play *asked, size_t *try, struct bead_message *msg)
{
    struct bead_consumer consumer = {.needs = {.bead_peaks = true}, .context = m};
    struct bead_played played = {.count = 0};
    struct bead_play play = *asked;
    struct bead_simulate simulate = *asked->simulate;
    if (m->panel->accuracy > 0)
        simulate.accuracy = m->panel->accuracy;
    play.simulate = &simulate;
    find_span(m);
    BEAD_TRY(bead_sweep_check_places(m->panel, m->chain, m->row - 1, msg));
    play.peak_span = &m->span;
    play.consumers = &consumer;
    play.consumer_count = 1;
    const bool whole = bead_sweep_refusal(m->panel, m->chain) != NULL;
    if (m->panel->profiles)
        BEAD_TRY(watch_profiles(m, m->panel->profiles + PROFILES * m->row * m->panel->shown.beads, &consumer, msg));
    play.target = whole ? 0 : m->span.first;
    enum bead_error err = bead_play_cut(&play, try, &played, msg);
    m->lost = err == BEAD_ERROR_NUMBERS;
    if (!err && !whole && m->row % ALSO_WHOLE == 0)
        err = check_whole(m, &play, played.outcomes[0].bead_peaks, msg);
    if (!err)
        collect(m, played.outcomes[0].bead_peaks);
    if (!err && m->profiles)
        err = keep_profiles(m, &played, msg);
    if (!err && is_measured(m, play.simulate->step > 0)) {
        err = measure_errors(m, &play, *try, msg);
        m->lost = err == BEAD_ERROR_NUMBERS;
    }
    free(m->seen);
    bead_played_free(&played);
    return err;
}

/* ---- all chains ---- */

struct work {
    struct bead_sweep *sweep;
    struct bead_sweep_journal *journal;
    pthread_mutex_t lock; /* of the journal and the list of lost chains */
    size_t *jobs;         /* not known yet */
};

static void find_job(void *context, size_t index, size_t *panel, size_t *configuration)
{
    const struct work *w = context;
    size_t row;
    *panel = (size_t)(bead_sweep_panel_of(w->sweep, w->jobs[index], &row) - w->sweep->panels);
    *configuration = row - 1;
}

/* A chain without a result does not stop the others. */
static void keep_lost(struct work *w, size_t job, const struct bead_message *why)
{
    struct bead_sweep *s = w->sweep;
    pthread_mutex_lock(&w->lock);
    if (s->lost++ == 0 || job < s->first_lost) {
        s->first_lost = job;
        s->why = *why;
    }
    pthread_mutex_unlock(&w->lock);
}

static enum bead_error play_job(void *context, size_t index, const struct bead_play *play, struct bead_message *msg)
{
    struct work *w = context;
    const size_t job = w->jobs[index];
    struct measure m = {.chain = play->chains[0]};
    m.panel = bead_sweep_panel_of(w->sweep, job, &m.row);
    size_t behind = m.panel->first_try;
    enum bead_error err = sweep_measure(&m, play, &behind, msg);
    if (m.lost) {
        keep_lost(w, job, msg);
        return BEAD_OK;
    }
    if (!err && w->journal) {
        pthread_mutex_lock(&w->lock);
        err = bead_sweep_journal_add(w->journal, w->sweep, job, msg);
        pthread_mutex_unlock(&w->lock);
    }
    if (!err)
        w->sweep->known[job] = 1;
    return err;
}

/* Lists the jobs of the sweep's part that are not known yet. */
static enum bead_error list_jobs(struct work *w, struct sweep_generator *generator, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&w->jobs, w->sweep->jobs, msg, "a sweep"));
    for (size_t job = 0; job < w->sweep->jobs; job++) {
        if (!bead_sweep_mine(w->sweep, job))
            continue;
        if (w->sweep->known[job])
            generator->done_before++;
        else
            w->jobs[generator->count++] = job;
    }
    return BEAD_OK;
}

static void find_pilot(void *, size_t index, size_t *panel, size_t *configuration)
{
    *panel = index;
    *configuration = 0;
}

/* If one chain of the panel needs more beads, as with hard and soft materials, the others do not try fewer. */
static enum bead_error play_pilot(void *context, size_t index, const struct bead_play *play, struct bead_message *msg)
{
    const struct work *w = context;
    struct measure m = {.panel = &w->sweep->panels[index], .row = 1, .chain = play->chains[0]};
    size_t try = BEAD_PLAY_USUAL;
    if (m.panel->shown.configurations < ALSO_WHOLE)
        return BEAD_OK;
    const enum bead_error err = sweep_measure(&m, play, &try, msg);
    m.panel->first_try = try;
    return m.lost ? BEAD_OK : err;
}

/* ---- the accuracy that means need ---- */

enum { TRIED = 16 }; /* chains */
static const double part_of_error = 0.01, coarsest = 1e-4, finest = 1e-12;

struct trial {
    struct bead_sweep *sweep;
    size_t panel, first; /* configurations first, first + 1, ... */
    double force[TRIED];
};

static enum bead_error play_tried(void *context, size_t index, const struct bead_play *play, struct bead_message *msg)
{
    struct trial *t = context;
    struct measure m = {.panel = &t->sweep->panels[t->panel], .row = 1 + t->first + index, .chain = play->chains[0]};
    size_t behind = m.panel->first_try;
    const enum bead_error err = sweep_measure(&m, play, &behind, msg);
    t->force[index] = err ? NAN : m.panel->peaks[m.row * m.panel->shown.places].force;
    return m.lost ? BEAD_OK : err;
}

/* Is the standard error of the mean of `members` such forces a hundred times their errors? */
static bool means_allow(const struct trial *coarse, const struct trial *fine, size_t count, size_t members)
{
    double mean = 0, squares = 0, off = 0;
    for (size_t i = 0; i < count; i++)
        mean += fine->force[i] / (double)count;
    for (size_t i = 0; i < count; i++) {
        squares += (fine->force[i] - mean) * (fine->force[i] - mean);
        off += (fine->force[i] - coarse->force[i]) * (fine->force[i] - coarse->force[i]);
    }
    return sqrt(off / (double)count) <= part_of_error * sqrt(squares / (double)(count - 1) / (double)members);
}

/* The largest power of ten at which errors of chains in the largest group of a magnetism are at most a hundredth of the standard
 * error of its mean, found by runs with a tenth of it. */
static enum bead_error find_accuracy(struct bead_sweep *sweep, size_t index, const struct bead_sweep_settings *settings,
                                     struct bead_message *msg)
{
    struct sweep_panel *panel = &sweep->panels[index];
    const struct bead_sweep_spec *spec = panel->shown.spec;
    struct trial coarse = {.sweep = sweep, .panel = index}, fine;
    size_t members = 0;
    for (size_t g = 0, at = 0; g < spec->group_count; at += spec->groups[g++].configurations) {
        if (spec->groups[g].configurations > members) {
            members = spec->groups[g].configurations;
            coarse.first = at;
        }
    }
    struct sweep_generator generator = {.sweep = sweep,
                                        .settings = settings,
                                        .panel = index,
                                        .first = coarse.first,
                                        .play = play_tried,
                                        .count = members < TRIED ? members : TRIED};
    bool good = members < 2 || panel->shown.places == 0;
    for (double accuracy = coarsest; !good && accuracy > finest; accuracy *= 0.1) {
        fine = coarse;
        panel->accuracy = accuracy;
        generator.context = &coarse;
        BEAD_TRY(bead_sweep_play(&generator, msg));
        panel->accuracy = 0.1 * accuracy;
        generator.context = &fine;
        BEAD_TRY(bead_sweep_play(&generator, msg));
        panel->accuracy = accuracy;
        good = means_allow(&coarse, &fine, generator.count, members);
    }
    panel->accuracy = good ? panel->accuracy : 0;
    return BEAD_OK;
}

double bead_sweep_accuracy(const struct bead_sweep *sweep)
{
    double least = INFINITY;
    for (size_t i = 0; i < sweep->panel_count; i++)
        least = sweep->panels[i].accuracy > 0 ? fmin(least, sweep->panels[i].accuracy) : least;
    return isfinite(least) ? least : 0;
}

enum bead_error bead_sweep_run(struct bead_sweep *sweep, const struct bead_sweep_settings *settings, uint64_t *computed,
                               struct bead_message *msg)
{
    struct bead_sweep_settings own;
    BEAD_TRY(bead_sweep_settings_take(&own, settings, msg));
    struct work w = {.sweep = sweep};
    struct sweep_generator generator = {
        .sweep = sweep, .settings = &own, .what = "sweeping", .find = find_job, .play = play_job, .context = &w};
    if (own.parts > 0) {
        sweep->part = own.part;
        sweep->parts = own.parts;
    }
    enum bead_error err = own.journal ? bead_sweep_journal_open(sweep, own.journal, &w.journal, msg) : BEAD_OK;
    if (!err)
        err = list_jobs(&w, &generator, msg);
    if (!err && pthread_mutex_init(&w.lock, NULL) != 0)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "cannot create a lock for a sweep");
    if (!err) {
        struct bead_sweep_settings quiet = own;
        quiet.progress = NULL;
        struct sweep_generator pilot = {
            .sweep = sweep, .settings = &quiet, .find = find_pilot, .play = play_pilot, .context = &w, .count = sweep->panel_count};
        if (generator.count > 0)
            err = bead_sweep_play(&pilot, msg);
        for (size_t i = 0; !err && generator.count > 0 && sweep->scene->simulate.statistical && i < sweep->panel_count; i++)
            err = find_accuracy(sweep, i, &quiet, msg);
        if (!err)
            err = bead_sweep_play(&generator, msg);
        if (!err && sweep->lost > 0 && sweep->lost == generator.count)
            err = bead_fail(msg, BEAD_ERROR_NUMBERS, "%s", sweep->why.text);
        pthread_mutex_destroy(&w.lock);
    }
    if (computed)
        *computed = generator.played;
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
