/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plays chains into consumers: advances their runs from sample to sample, then to their ends. */
#include "sim/run/play.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "sim/base/clock.h"
#include "sim/base/memory.h"
#include "sim/base/thread_pool.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/chain_internal.h"

/* ---- all chains ---- */

struct pass {
    const struct bead_play *play;
    struct bead_played *played;
    struct bead_counts *counts;
    unsigned turn;
    bool quiet;         /* in a thread that reports no progress */
    double fraction;    /* reported last; never falls */
    atomic_size_t done; /* finished jobs */
    size_t jobs;        /* 0: chains advance together */
};

/* Reports at most ten times a second. */
static void report_progress(struct pass *pass, double time)
{
    const struct bead_play *p = pass->play;
    if (pass->quiet || !p->progress || bead_clock() - pass->played->told < 0.1)
        return;
    pass->played->told = bead_clock();
    double end = fmin(p->end, p->needed);
    double fraction = isfinite(end) && end > 0 ? fmin(time / end, 1) : 0;
    if (pass->jobs > 0)
        fraction = fmin(((double)atomic_load(&pass->done) + fraction) / (double)pass->jobs, 1);
    pass->fraction = fmax(pass->fraction, fraction);
    struct bead_progress progress = {.what = p->what, .done = pass->fraction, .time = time};
    p->progress(p->progress_context, &progress);
}

static enum bead_error stepped(void *context, const struct bead_runner *runner, struct bead_message *msg)
{
    struct pass *pass = context;
    const struct bead_play *p = pass->play;
    const size_t chain = (size_t)(runner - pass->played->runs);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < p->consumer_count; i++)
        err = p->consumers[i].step ? p->consumers[i].step(&p->consumers[i], chain, runner->run, msg) : BEAD_OK;
    if (pass->turn++ % 64 == 0)
        report_progress(pass, runner->kind->time(runner->run));
    return err;
}

static enum bead_error comparison_stepped(void *context, const struct bead_runner *runner, struct bead_message *)
{
    struct pass *pass = context;
    if (pass->turn++ % 64 == 0)
        report_progress(pass, runner->kind->time(runner->run));
    return BEAD_OK;
}

/* Advances a chain's run, or one that is compared with it. */
static enum bead_error advance(struct pass *pass, struct bead_runner *runner, double time, struct bead_message *msg)
{
    const struct bead_played *played = pass->played;
    struct bead_way way = bead_play_way(pass->play, time);
    way.stepped = runner >= played->runs && runner < played->runs + played->count ? stepped : comparison_stepped;
    way.context = pass;
    if (!runner->kind)
        return BEAD_OK;
    const enum bead_error err = bead_play_run(runner, &way, msg);
    if (err == BEAD_ERROR_NUMBERS && played->check_runs && runner >= played->check_runs &&
        runner < played->check_runs + played->count) {
        bead_runner_destroy(runner); /* its result is unknown */
        return BEAD_OK;
    }
    /* One chain that ends without its front does not stop the others. */
    return err && pass->play->chain_count > 1 && runner->kind->is_lost(runner->run) ? BEAD_OK : err;
}

static enum bead_error create_runs(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&played->runs, p->chain_count, msg, "%zu chains", p->chain_count));
    BEAD_TRY(bead_new(&played->outcomes, p->chain_count, msg, "%zu chains", p->chain_count));
    played->count = p->chain_count;
    struct bead_run_settings settings = {.simulate = p->simulate,
                                         .kernels = p->kernels,
                                         .end = p->end,
                                         .passage = p->passage,
                                         .peak_span = p->peak_span,
                                         .widening = p->widening,
                                         .target = p->target,
                                         .full_window = p->full_window,
                                         .hash = p->hash,
                                         .tolerance_factor = p->refinement};
    for (size_t i = 0; i < p->consumer_count; i++) {
        settings.contact_peaks |= bead_compare_contacts(p, &p->consumers[i].needs) || p->consumers[i].needs.contact_peaks;
        settings.bead_peaks |= p->consumers[i].needs.bead_peaks;
        settings.rivals |= p->consumers[i].needs.deviation;
        settings.budget |= p->consumers[i].needs.budget;
        settings.states |= p->consumers[i].needs.states;
    }
    for (size_t i = 0; i < p->chain_count; i++) {
        settings.chain = p->chains[i];
        settings.peaks_apart = bead_compare_apart(p, i);
        BEAD_TRY(bead_runner_create(&settings, &played->runs[i], msg));
    }
    return BEAD_OK;
}

/* ---- samples ---- */

/* Adds the values of the comparison run to a sample. */
static enum bead_error add_comparison(struct pass *pass, double time, const struct bead_due *due, struct bead_sample *sample,
                                      struct bead_message *msg)
{
    struct bead_runner *comparison = &pass->played->comparison_runs[sample->chain];
    struct bead_sample other = {.chain = sample->chain};
    enum bead_error err = advance(pass, comparison, time, msg);
    if (!err)
        err = comparison->kind->sample(comparison->run, time, due->comparison, due->span, &other, msg);
    if (err)
        return err;
    memcpy(sample->comparison, other.field, sizeof sample->comparison);
    sample->comparison_active = other.active;
    return BEAD_OK;
}

/* Adds the sample of the check run to a sample: into *check. */
static enum bead_error add_check(struct pass *pass, double time, const struct bead_due *due, struct bead_sample *sample,
                                 struct bead_sample *check, struct bead_message *msg)
{
    struct bead_runner *runner = &pass->played->check_runs[sample->chain];
    BEAD_TRY(advance(pass, runner, time, msg));
    if (!runner->kind)
        return BEAD_OK;
    *check = (struct bead_sample){.chain = sample->chain};
    sample->check = check;
    return runner->kind->sample(runner->run, time, due->checked, due->span, check, msg);
}

/* Computes a sample, and that of the check run, unless the run is over before: *over. */
static enum bead_error compute_sample(struct pass *pass, const struct bead_due *due, struct bead_sample *sample,
                                      struct bead_sample *check, bool *over, struct bead_message *msg)
{
    const struct bead_play *p = pass->play;
    struct bead_runner *runner = &pass->played->runs[sample->chain];
    const double time = fmin(due->time, p->end); /* grids end with the run except for rounding */
    enum bead_error err = advance(pass, runner, time, msg);
    *over = !err && isinf(p->end) && time > runner->kind->over(runner->run);
    if (err || *over)
        return err;
    if (due->fields)
        err = runner->kind->sample(runner->run, time, due->fields, due->span, sample, msg);
    if (!err && due->comparison)
        err = add_comparison(pass, time, due, sample, msg);
    if (!err && due->checked)
        err = add_check(pass, time, due, sample, check, msg);
    sample->time = check->time = due->time;
    const size_t beads = bead_chain_beads(p->chains[sample->chain]);
    size_t last = due->span.last < beads ? due->span.last + 1 : beads;
    last = last < sample->active ? last : sample->active;
    pass->counts->sample_values += last > due->span.first ? last - due->span.first : 0;
    return err;
}

/* Delivers a sample of one chain, if its run is not over, and sets *any. */
static enum bead_error give_sample(struct pass *pass, size_t chain, const struct bead_due *due, bool *any, struct bead_message *msg)
{
    const struct bead_stored *stored = pass->play->stored;
    struct bead_sample sample = {.chain = chain}, check;
    bool over = false;
    enum bead_error err = stored ? stored->read(stored, due->time, due->fields, &sample, msg)
                                 : compute_sample(pass, due, &sample, &check, &over, msg);
    if (err || over)
        return err;
    *any = true;
    pass->counts->samples += due->fields != 0;
    return bead_due_deliver(pass->play, due, &sample, msg);
}

/* Delivers all samples up to a time. */
static enum bead_error give_samples(struct pass *pass, double until, struct bead_message *msg)
{
    const struct bead_play *p = pass->play;
    const double last = fmin(p->stored ? p->stored->last : p->end * (1 + 1e-9), until);
    struct bead_due due;
    bool any = true;
    enum bead_error err = BEAD_OK;
    while (!err && any && bead_due_next(p, &due) && due.time <= last) {
        any = false;
        for (size_t i = 0; !err && i < p->chain_count; i++)
            err = give_sample(pass, i, &due, &any, msg);
        bead_due_pass(p, &due);
        report_progress(pass, due.time);
        if (!err)
            err = bead_play_look_for_stop(p->stop, due.time, msg);
    }
    return err;
}

/* ---- after the last sample ---- */

/* Completes one run; jobs after those of the chains are the runs that are compared with them. */
static enum bead_error complete(void *context, size_t job, bool calling, struct bead_message *msg)
{
    struct pass *pass = context, quiet = {.play = pass->play, .played = pass->played, .quiet = true};
    const size_t chains = pass->play->chain_count;
    struct bead_runner *runs[] = {pass->played->runs,
                                  bead_compare_peaks(pass->play) ? pass->played->comparison_runs : pass->played->check_runs,
                                  pass->played->check_runs};
    enum bead_error err = advance(calling ? pass : &quiet, &runs[job / chains][job % chains], pass->play->needed, msg);
    if (!err)
        atomic_fetch_add(&pass->done, 1);
    return err;
}

static enum bead_error complete_all(struct pass *pass, struct bead_message *msg)
{
    pass->jobs = pass->play->chain_count * (1u + bead_compare_peaks(pass->play) + (pass->played->check_runs != NULL));
    return bead_thread_pool_run(pass->jobs, pass->play->threads, complete, pass, msg);
}

/* Counts the work of runs that are compared; NULL: there are none. */
static void count_compared(const struct pass *pass, const struct bead_runner *runs)
{
    for (size_t i = 0; runs && i < pass->played->count; i++) {
        const struct bead_run_work work = runs[i].kind ? runs[i].kind->work(runs[i].run) : (struct bead_run_work){0, 0, 0};
        pass->counts->comparison_steps += work.steps;
        pass->counts->comparison_evaluations += work.evaluations;
    }
}

static void finish_runs(const struct pass *pass)
{
    struct bead_played *played = pass->played;
    const double end = pass->play->end;
    played->end = INFINITY;
    for (size_t i = 0; i < played->count; i++) {
        const struct bead_run_kind *kind = played->runs[i].kind;
        struct bead_run *run = played->runs[i].run;
        double reached = fmin(kind->time(run), end);
        if (!isfinite(end) && !isnan(kind->over(run)))
            reached = kind->over(run);
        kind->finish(run, reached, &played->outcomes[i]);
        played->end = fmin(played->end, reached);
        const struct bead_run_work work = kind->work(run);
        pass->counts->steps += work.steps;
        pass->counts->evaluations += work.evaluations;
        pass->counts->state_hash += work.hash * (2 * i + 1);
    }
    count_compared(pass, played->comparison_runs);
    count_compared(pass, played->check_runs);
    for (size_t i = 0; played->check_runs && i < played->count; i++) {
        const struct bead_runner *check = &played->check_runs[i];
        if (!check->kind)
            continue;
        check->kind->finish(check->run, fmin(check->kind->time(check->run), played->outcomes[i].end), &played->checks[i]);
        played->outcomes[i].check = &played->checks[i];
    }
    pass->counts->passes++;
}

static bool is_cut_short(const struct bead_played *played)
{
    bool cut = false;
    for (size_t i = 0; i < played->count; i++)
        cut = cut || played->runs[i].kind->is_cut_short(played->runs[i].run) ||
              (played->comparison_runs && played->comparison_runs[i].kind->is_cut_short(played->comparison_runs[i].run));
    return cut;
}

/* Runs that were given up. */
static size_t count_lost(const struct bead_played *played)
{
    size_t lost = 0;
    for (size_t i = 0; i < played->count; i++) {
        const struct bead_runner *r = &played->runs[i];
        lost += r->kind->is_lost(r->run) && !isnan(r->kind->over(r->run));
    }
    return lost;
}

enum bead_error bead_play_begin(const struct bead_play *play, struct bead_played *played, struct bead_message *msg)
{
    *played = (struct bead_played){.told = bead_clock()};
    bead_due_start(play);
    if (play->stored)
        return BEAD_OK;
    BEAD_TRY(create_runs(play, played, msg));
    return bead_compare_create(play, played, msg);
}

enum bead_error bead_play_advance(const struct bead_play *play, struct bead_played *played, double time, struct bead_message *msg)
{
    struct bead_counts unused = {0};
    struct pass pass = {.play = play, .played = played, .counts = &unused};
    BEAD_TRY(give_samples(&pass, time, msg));
    for (size_t i = 0; i < play->chain_count; i++)
        BEAD_TRY(advance(&pass, &played->runs[i], time, msg));
    return BEAD_OK;
}

enum bead_error bead_play_finish(const struct bead_play *play, struct bead_played *played, struct bead_message *msg)
{
    struct bead_counts unused = {0};
    struct pass pass = {.play = play, .played = played, .counts = &unused};
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && played->comparison_runs && i < played->count; i++)
        err = advance(&pass, &played->comparison_runs[i], played->runs[i].kind->time(played->runs[i].run), msg);
    finish_runs(&pass);
    return err ? err : bead_compare_finish(play, played, msg);
}

enum bead_error bead_play(const struct bead_play *play, struct bead_played *played, struct bead_message *msg)
{
    struct bead_counts unused = {0};
    struct pass pass = {.play = play, .played = played, .counts = play->counts ? play->counts : &unused};
    BEAD_TRY(bead_play_begin(play, played, msg));
    enum bead_error err = give_samples(&pass, INFINITY, msg);
    if (play->stored)
        return err;
    if (!err)
        err = complete_all(&pass, msg);
    if (!err && played->count > 0 && count_lost(played) == played->count)
        err = bead_play_lost(&played->runs[0], msg);
    finish_runs(&pass);
    return err || is_cut_short(played) ? err : bead_compare_finish(play, played, msg);
}

/* How much faster than the front signals behind it may be, tried in this order; 0: all beads are kept. In chains of dimers with
 * random spins they are 1.26 times as fast, a little more if the front has come far and is weak. In chains of equal cells none is
 * faster; if some are, this shows at once. */
static const double widenings[] = {[BEAD_PLAY_USUAL] = 1.3, 1.8, 0, [BEAD_PLAY_ALIKE] = 1, 1.4, 1.8, 0};

enum bead_error bead_play_cut(struct bead_play *play, size_t *try, struct bead_played *played, struct bead_message *msg)
{
    for (;; ++*try) {
        play->widening = play->target > 0 ? widenings[*try] : 0;
        const enum bead_error err = bead_play(play, played, msg);
        if (err || !is_cut_short(played))
            return err;
        bead_played_free(played);
    }
}

void bead_played_free(struct bead_played *played)
{
    for (size_t i = 0; played->runs && i < played->count; i++)
        bead_runner_destroy(&played->runs[i]);
    for (size_t i = 0; played->comparison_runs && i < played->count; i++)
        bead_runner_destroy(&played->comparison_runs[i]);
    for (size_t i = 0; played->check_runs && i < played->count; i++)
        bead_runner_destroy(&played->check_runs[i]);
    bead_compare_free(played);
    free(played->runs);
    free(played->comparison_runs);
    free(played->check_runs);
    free(played->checks);
    free(played->outcomes);
    *played = (struct bead_played){.count = 0};
}
