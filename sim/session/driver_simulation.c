/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples from a simulation: all chains advance together, none further than the next sample needs. */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sim/base/stop.h"
#include "sim/base/thread_pool.h"
#include "sim/chain/chain_data.h"
#include "sim/run/run_kinds.h"
#include "sim/run/uncertainty.h"
#include "sim/session/driver.h"

struct pass {
    const struct bead_driver *driver;
    struct bead_counts *counts;
    struct bead_passed *passed;
    double told; /* s: the clock at the last report of progress */
    unsigned turn;
    bool quiet;               /* in a thread that reports no progress */
    double fraction;          /* reported last; never falls */
    atomic_size_t *done;      /* chains; NULL: they advance together */
    size_t jobs;              /* so many are to be done */
    double comparison_factor; /* of the comparison runs' tolerance */
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Called every few steps: stops the run if asked to, and now and then reports progress. */
static enum bead_error look_up(struct pass *pass, double time, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    if (bead_stop_is_asked(p->stop)) {
        return bead_fail(msg, BEAD_ERROR_STOPPED, "stopped at %.4g s", time);
    }
    if (pass->quiet || !p->progress || pass->turn++ % 64 != 0 || now() - pass->told < 0.1)
        return BEAD_OK;
    pass->told = now();
    double end = fmin(p->end, p->needed);
    double fraction = isfinite(end) && end > 0 ? fmin(time / end, 1) : 0;
    if (pass->done)
        fraction = fmin(((double)atomic_load(pass->done) + fraction) / (double)pass->jobs, 1);
    pass->fraction = fmax(pass->fraction, fraction);
    struct bead_progress progress = {.what = p->what, .done = pass->fraction, .time = time};
    p->progress(p->progress_context, &progress);
    return BEAD_OK;
}

static enum bead_error create_runs(struct pass *pass, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    struct bead_passed *passed = pass->passed;
    *passed = (struct bead_passed){.runs = calloc(p->chain_count, sizeof *passed->runs),
                                   .outcomes = calloc(p->chain_count, sizeof *passed->outcomes)};
    if (!passed->runs || !passed->outcomes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %zu chains", p->chain_count);
    passed->count = p->chain_count;
    struct bead_run_settings settings = {.simulate = p->simulate,
                                         .kernels = p->kernels,
                                         .end = p->end,
                                         .passage = p->passage ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE,
                                         .full_window = p->full_window,
                                         .hash = p->hash,
                                         .tolerance_factor = p->refinement};
    for (size_t i = 0; i < p->consumer_count; i++) {
        settings.contact_peaks |= p->consumers[i].needs.contact_peaks;
        settings.bead_peaks |= p->consumers[i].needs.bead_peaks;
        settings.budget |= p->consumers[i].needs.budget;
        settings.states |= p->consumers[i].needs.states;
    }
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < p->chain_count; i++) {
        settings.chain = p->chains[i];
        err = bead_runner_create(&settings, &passed->runs[i], msg);
    }
    return err;
}

static bool wants_samples(const struct bead_driver *p)
{
    bool any = false;
    for (size_t i = 0; i < p->consumer_count; i++)
        any = any || p->consumers[i].needs.comparison;
    return any;
}

/* Runs that are compared for their peaks only may be coarser by this, and cheaper: what counts is how strongly peaks answer. */
static const double coarser = 3;

double bead_driver_comparison_factor(const struct bead_driver *p, bool samples)
{
    const bool free = !samples && !(p->simulate->step > 0) && p->tolerance_factor > p->refinement;
    return free ? coarser * p->tolerance_factor : p->tolerance_factor;
}

static bool wants_uncertainty(const struct bead_driver *p)
{
    bool any = false;
    for (size_t i = 0; i < p->consumer_count; i++)
        any = any || (p->consumers[i].needs.uncertainty && !p->chains[0]->system);
    return any;
}

static enum bead_error create_comparison_run(struct pass *pass, size_t chain, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    struct bead_run_settings settings = {.chain = p->chains[chain],
                                         .simulate = p->simulate,
                                         .kernels = p->kernels,
                                         .end = p->end,
                                         .passage = p->passage ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE,
                                         .full_window = p->full_window,
                                         .tolerance_factor = pass->comparison_factor};
    for (size_t i = 0; i < p->consumer_count; i++) {
        const struct bead_needs *needs = &p->consumers[i].needs;
        settings.contact_peaks |= needs->uncertainty && needs->contact_peaks;
        settings.bead_peaks |= needs->uncertainty && needs->bead_peaks;
    }
    return bead_runner_create(&settings, &pass->passed->comparison_runs[chain], msg);
}

/* Another run of each chain, if a consumer wants its samples, or compares its peaks. */
static enum bead_error create_comparison_runs(struct pass *pass, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    if (!wants_samples(p) && !wants_uncertainty(p))
        return BEAD_OK;
    pass->passed->comparison_runs = calloc(p->chain_count, sizeof *pass->passed->comparison_runs);
    if (!pass->passed->comparison_runs)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %zu chains", p->chain_count);
    pass->comparison_factor = bead_driver_comparison_factor(p, wants_samples(p));
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < p->chain_count; i++)
        err = create_comparison_run(pass, i, msg);
    return err;
}

/* A front that has not arrived after this many times the passage of a wave never will. */
static const double patience = 200;

static enum bead_error lost_front(const struct bead_driver *p, size_t chain, double time, struct bead_message *msg)
{
    const char *name = bead_chain_name(p->chains[chain]);
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: chain%s%s: after %.4g s the front has not reached the end: give simulate.until",
                     bead_chain_scene(p->chains[chain])->file, *name ? " " : "", name, time);
}

static enum bead_error advance(struct pass *pass, const struct bead_runner *runner, double time, struct bead_message *msg)
{
    const struct bead_run_kind *kind = runner->kind;
    enum bead_error err = BEAD_OK;
    while (!err && kind->time(runner->run) < time && kind->time(runner->run) < pass->driver->end) {
        err = kind->step(runner->run, msg);
        if (!err)
            err = look_up(pass, kind->time(runner->run), msg);
    }
    return err;
}

/* Without a known end: until the first pulse has passed. */
static enum bead_error advance_past_pulse(struct pass *pass, const struct bead_runner *runner, size_t chain,
                                          struct bead_message *msg)
{
    struct bead_run *run = runner->run;
    const struct bead_run_kind *kind = runner->kind;
    const struct bead_chain *c = pass->driver->chains[chain];
    double give_up = patience * bead_chain_passage(c, bead_chain_energy(c));
    enum bead_error err = BEAD_OK;
    while (!err && isnan(kind->over(run))) {
        err = kind->step(run, msg);
        if (!err)
            err = look_up(pass, kind->time(run), msg);
        if (!err && kind->time(run) > give_up)
            err = lost_front(pass->driver, chain, kind->time(run), msg);
    }
    return err;
}

/* The comparison run's values join the sample. */
static enum bead_error add_comparison(struct pass *pass, size_t chain, double time, const struct bead_due *due,
                                      struct bead_sample *sample, struct bead_message *msg)
{
    const struct bead_runner *comparison = &pass->passed->comparison_runs[chain];
    struct bead_sample other = {.chain = chain};
    enum bead_error err = advance(pass, comparison, time, msg);
    if (!err)
        err = comparison->kind->sample(comparison->run, time, due->comparison, due->span, &other, msg);
    if (err)
        return err;
    memcpy(sample->comparison, other.field, sizeof sample->comparison);
    sample->comparison_active = other.active;
    return BEAD_OK;
}

static enum bead_error give_samples(struct pass *pass, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    struct bead_due due;
    enum bead_error err = BEAD_OK;
    while (!err && bead_driver_due(p, &due)) {
        if (due.time > p->end * (1 + 1e-9)) /* grids end with the run but for rounding */
            break;
        double time = fmin(due.time, p->end);
        for (size_t i = 0; !err && i < p->chain_count; i++) {
            const struct bead_runner *runner = &pass->passed->runs[i];
            struct bead_sample sample = {.chain = i};
            err = advance(pass, runner, time, msg);
            if (!err)
                err = runner->kind->sample(runner->run, time, due.fields, due.span, &sample, msg);
            if (!err && due.comparison)
                err = add_comparison(pass, i, time, &due, &sample, msg);
            sample.time = due.time;
            if (!err)
                err = bead_driver_deliver(p, &due, &sample, i + 1 == p->chain_count, msg);
            size_t last = due.span.last < bead_chain_beads(p->chains[i]) ? due.span.last + 1 : bead_chain_beads(p->chains[i]);
            last = last < sample.active ? last : sample.active;
            pass->counts->samples++;
            pass->counts->sample_values += last > due.span.first ? last - due.span.first : 0;
        }
        if (!err)
            err = look_up(pass, time, msg);
    }
    return err;
}

/* Runs one chain to its end after the last sample; behind the last chain, the comparison runs. */
static enum bead_error complete(void *context, size_t job, bool calling, struct bead_message *msg)
{
    struct pass *pass = context, quiet = {.driver = pass->driver, .passed = pass->passed, .quiet = true};
    struct pass *mine = calling ? pass : &quiet;
    const size_t chains = pass->driver->chain_count, chain = job % chains;
    const struct bead_runner *runner = job < chains ? &pass->passed->runs[job] : &pass->passed->comparison_runs[job - chains];
    if (!runner->run)
        return BEAD_OK;
    double rest = fmin(pass->driver->end, pass->driver->needed);
    enum bead_error err = isfinite(rest) ? advance(mine, runner, rest, msg) : advance_past_pulse(mine, runner, chain, msg);
    if (!err)
        atomic_fetch_add(pass->done, 1);
    return err;
}

/* A contact and a bead beside it share what they are uncertain by, but for rounding: then the contact is named. */
static const double clearly = 1 + 1e-9;

/* The least certain peak, as a part of itself. */
static void note_worst(const struct bead_uncertain_peaks kinds[2], struct bead_outcome *outcome)
{
    double *const which[2] = {&outcome->worst_contact, &outcome->worst_bead};
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < kinds[kind].count; i++) {
            const double force = kinds[kind].peaks[i].value, u = kinds[kind].uncertainty[i];
            if (!(u > 0) || u * outcome->worst_force <= clearly * outcome->worst_uncertainty * force)
                continue;
            *which[0] = *which[1] = NAN;
            *which[kind] = (double)i;
            outcome->worst_force = force;
            outcome->worst_uncertainty = u;
        }
    }
}

/* How well a chain's peaks are known, from its run and its comparison run. */
static enum bead_error compare_peaks(struct pass *pass, size_t chain, struct bead_message *msg)
{
    const struct bead_driver *p = pass->driver;
    const size_t contacts = bead_chain_contacts(p->chains[chain]), beads = bead_chain_beads(p->chains[chain]);
    const struct bead_runner *comparison = &pass->passed->comparison_runs[chain];
    struct bead_outcome *outcome = &pass->passed->outcomes[chain], other;
    double **u = pass->passed->uncertainty + 2 * chain;
    u[0] = calloc(contacts, sizeof **u);
    u[1] = calloc(beads, sizeof **u);
    if (!u[0] || !u[1])
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the peaks of %zu beads", beads);
    comparison->kind->finish(comparison->run, outcome->end, &other);
    const double refinement = p->refinement > 0 ? p->refinement : 1, over = comparison->kind->over(comparison->run);
    const double factor = bead_run_effective_factor(p->chains[chain], p->simulate, pass->comparison_factor);
    const struct bead_uncertainty_of of = {p->simulate->step > 0 ? 0 : p->simulate->accuracy * refinement, factor / refinement,
                                           bead_chain_spec(p->chains[chain])->damping_coefficient > 0,
                                           isnan(over) ? 0 : fmin(over, outcome->end)};
    const struct bead_uncertain_peaks kinds[2] = {
        {outcome->contact_peaks, other.contact_peaks, other.contact_peaks ? contacts : 0, u[0]},
        {outcome->bead_peaks, other.bead_peaks, other.bead_peaks ? beads : 0, u[1]}};
    bead_uncertainty_find(&of, kinds);
    note_worst(kinds, outcome);
    outcome->contact_uncertainty = kinds[0].count ? u[0] : NULL;
    outcome->bead_uncertainty = kinds[1].count ? u[1] : NULL;
    return BEAD_OK;
}

static enum bead_error compare_all_peaks(struct pass *pass, struct bead_message *msg)
{
    const size_t chains = pass->driver->chain_count;
    pass->passed->uncertainty = calloc(2 * chains, sizeof *pass->passed->uncertainty);
    if (!pass->passed->uncertainty)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the peaks of %zu chains", chains);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < chains; i++)
        err = compare_peaks(pass, i, msg);
    return err;
}

static void pass_finish(struct pass *pass)
{
    struct bead_passed *passed = pass->passed;
    double end = pass->driver->end;
    passed->end = INFINITY;
    for (size_t i = 0; i < passed->count; i++) {
        const struct bead_run_kind *kind = passed->runs[i].kind;
        struct bead_run *run = passed->runs[i].run;
        if (!run)
            continue;
        double reached = fmin(kind->time(run), end);
        if (!isfinite(end) && !isnan(kind->over(run)))
            reached = kind->over(run);
        kind->finish(run, reached, &passed->outcomes[i]);
        passed->end = fmin(passed->end, reached);
        pass->counts->steps += kind->steps(run);
        pass->counts->evaluations += kind->evaluations(run);
        pass->counts->state_hash += kind->hash(run) * (2 * i + 1);
    }
    pass->counts->passes++;
}

static void count_comparisons(struct pass *pass)
{
    const struct bead_passed *passed = pass->passed;
    for (size_t i = 0; passed->comparison_runs && i < passed->count; i++) {
        const struct bead_runner *comparison = &passed->comparison_runs[i];
        if (!comparison->run)
            continue;
        pass->counts->comparison_steps += comparison->kind->steps(comparison->run);
        pass->counts->comparison_evaluations += comparison->kind->evaluations(comparison->run);
    }
}

enum bead_error bead_drive_simulation(const struct bead_driver *driver, struct bead_counts *counts, struct bead_passed *passed,
                                      struct bead_message *msg)
{
    struct pass pass = {.driver = driver, .counts = counts, .passed = passed, .told = now()};
    atomic_size_t done = 0;
    enum bead_error err = create_runs(&pass, msg);
    if (!err)
        err = create_comparison_runs(&pass, msg);
    if (err)
        return err;
    bead_driver_start(driver);
    err = give_samples(&pass, msg);
    pass.done = &done;
    pass.jobs = wants_uncertainty(driver) ? 2 * driver->chain_count : driver->chain_count;
    if (!err)
        err = bead_thread_pool_run(pass.jobs, driver->threads, complete, &pass, msg);
    pass_finish(&pass);
    if (!err && wants_uncertainty(driver))
        err = compare_all_peaks(&pass, msg);
    passed->stopped = err == BEAD_ERROR_STOPPED;
    count_comparisons(&pass);
    return err;
}

void bead_passed_free(struct bead_passed *passed)
{
    for (size_t i = 0; passed->runs && i < passed->count; i++)
        bead_runner_destroy(&passed->runs[i]);
    for (size_t i = 0; passed->comparison_runs && i < passed->count; i++)
        bead_runner_destroy(&passed->comparison_runs[i]);
    for (size_t i = 0; passed->uncertainty && i < 2 * passed->count; i++)
        free(passed->uncertainty[i]);
    free(passed->uncertainty);
    free(passed->runs);
    free(passed->comparison_runs);
    free(passed->outcomes);
    *passed = (struct bead_passed){.count = 0};
}
