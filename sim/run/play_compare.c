/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparison runs: makes another run of each chain, at another tolerance, and a finer one of each chain whose peaks respond
 * strongly, and finds the errors of the peaks from them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/thread_pool.h"
#include "sim/chain/chain_data.h"
#include "sim/run/heights.h"
#include "sim/run/play.h"
#include "sim/run/uncertainty.h"

/* Comparison runs for peaks alone may be coarser by this factor, and cheaper: they only show how strongly peaks respond. Not if
 * forces jump as contacts close: errors of contacts that hardly touch fall more slowly than the tolerance, and the response to a
 * much larger one shows too little. */
static const double coarser = 30;
/* If a run's energy is no more accurate than the coarser run's, errors are as large as the whole difference. */
static const double least_factor = 2;
/* Check runs of equations, which are not chaotic, and the step of check runs where it is given. */
static const double tenth = 0.1, half = 0.5;
static const double pi = 3.14159265358979;

static bool compares_samples(const struct bead_play *p)
{
    bool any = false;
    for (size_t i = 0; i < p->consumer_count; i++)
        any = any || p->consumers[i].needs.comparison;
    return any;
}

bool bead_compare_contacts(const struct bead_play *p, const struct bead_needs *needs)
{
    return needs->uncertainty && (needs->contact_peaks || needs->bead_peaks) && p->chains[0]->spec->system->has_contacts;
}

bool bead_compare_peaks(const struct bead_play *p)
{
    bool any = false;
    for (size_t i = 0; i < p->consumer_count; i++)
        any = any || (p->consumers[i].needs.uncertainty && p->chains[0]->spec->system->has_contacts);
    return any;
}

double bead_compare_apart(const struct bead_play *p, size_t chain)
{
    const struct bead_chain *c = p->chains[chain];
    return bead_compare_peaks(p) ? pi / bead_chain_omega(c, bead_chain_energy(c)) : 0;
}

/* Does a consumer want peaks of contacts, and with uncertainties? */
static bool wants_contacts(const struct bead_play *p, bool uncertainty)
{
    bool any = false;
    for (size_t i = 0; i < p->consumer_count; i++) {
        const struct bead_needs *needs = &p->consumers[i].needs;
        any = any || (needs->contact_peaks && (needs->uncertainty || !uncertainty));
    }
    return any;
}

static bool forces_jump(const struct bead_play *p)
{
    bool any = false;
    for (size_t i = 0; i < p->chain_count; i++)
        any = any || p->chains[i]->spec->damping_coefficient > 0;
    return any;
}

double bead_play_comparison_factor(const struct bead_play *p, bool samples)
{
    const bool free = !samples && !forces_jump(p) && !(p->simulate->step > 0) && p->tolerance_factor > p->refinement;
    return free ? coarser * p->tolerance_factor : p->tolerance_factor;
}

/* Settings of the runs to compare with a chain's run; the chain is added later. */
static struct bead_run_settings settings_of(const struct bead_play *p, double tolerance_factor)
{
    struct bead_run_settings settings = {.simulate = p->simulate,
                                         .kernels = p->kernels,
                                         .end = p->end,
                                         .passage = p->passage,
                                         .full_window = p->full_window,
                                         .widening = p->widening,
                                         .target = p->target,
                                         .tolerance_factor = tolerance_factor};
    for (size_t i = 0; i < p->consumer_count; i++) {
        const struct bead_needs *needs = &p->consumers[i].needs;
        settings.contact_peaks |= bead_compare_contacts(p, needs);
        settings.bead_peaks |= needs->uncertainty && needs->bead_peaks;
    }
    return settings;
}

/* Creates a run of each chain. */
static enum bead_error create_runs(const struct bead_play *p, struct bead_run_settings *settings, struct bead_runner **runs,
                                   struct bead_message *msg)
{
    BEAD_TRY(bead_new(runs, p->chain_count, msg, "%zu chains", p->chain_count));
    for (size_t i = 0; i < p->chain_count; i++) {
        settings->chain = p->chains[i];
        settings->peaks_apart = bead_compare_apart(p, i);
        BEAD_TRY(bead_runner_create(settings, &(*runs)[i], msg));
    }
    return BEAD_OK;
}

double bead_play_check_factor(const struct bead_play *p)
{
    const double finer = p->chains[0]->spec->system->has_contacts ? BEAD_UNCERTAINTY_FINER : tenth;
    return (p->simulate->step > 0 ? half : finer) * (p->refinement > 0 ? p->refinement : 1);
}

static enum bead_error create_checks(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    struct bead_run_settings settings = settings_of(p, bead_play_check_factor(p));
    bool any = false;
    settings.contact_peaks = settings.bead_peaks = false;
    settings.other_grid = true;
    for (size_t i = 0; i < p->consumer_count; i++) {
        const struct bead_needs *needs = &p->consumers[i].needs;
        any |= needs->checked;
        settings.contact_peaks |= needs->checked && needs->contact_peaks;
        settings.budget |= needs->checked && needs->budget;
        settings.states |= needs->checked && needs->states;
    }
    if (!any)
        return BEAD_OK;
    BEAD_TRY(bead_new(&played->checks, p->chain_count, msg, "%zu chains", p->chain_count));
    return create_runs(p, &settings, &played->check_runs, msg);
}

enum bead_error bead_compare_create(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    struct bead_run_settings settings = settings_of(p, bead_play_comparison_factor(p, compares_samples(p)));
    settings.heights = bead_compare_peaks(p);
    if (compares_samples(p) || bead_compare_peaks(p))
        BEAD_TRY(create_runs(p, &settings, &played->comparison_runs, msg));
    return create_checks(p, played, msg);
}

/* If a contact and a bead beside it have equal uncertainties, except for rounding, the contact counts. */
static const double clearly = 1 + 1e-9;

/* The peaks of a chain's contacts, or beads, in its runs, side by side. */
struct compared {
    struct bead_uncertainty_of of;
    struct bead_uncertain_peaks peaks;
    bool of_beads;
};

/* Notes the peak with the largest relative uncertainty. Forces still rising at the end of the run are not peaks. */
static void note_worst(const struct compared *compared, struct bead_outcome *outcome)
{
    const struct bead_uncertain_peaks *p = &compared->peaks;
    for (size_t i = 0; i < p->count; i++) {
        const double force = p->peaks[i].value, u = p->uncertainty[i];
        if (!(u > 0) || p->peaks[i].open || u * outcome->worst_force <= clearly * outcome->worst_uncertainty * force)
            continue;
        outcome->worst_contact = compared->of_beads ? NAN : (double)i;
        outcome->worst_bead = compared->of_beads ? (double)i : NAN;
        outcome->worst_force = force;
        outcome->worst_uncertainty = u;
    }
}

/* Adds the peaks of another run, which reached the end of the chain's run or ended before. */
static void add_run(const struct bead_runner *other, bool is_fine, const struct bead_outcome *outcome, struct compared *compared)
{
    struct bead_outcome found;
    const double over = other->kind->over(other->run);
    other->kind->finish(other->run, outcome->end, &found);
    *(is_fine ? &compared->peaks.fine : &compared->peaks.coarse) = (struct bead_maxima){
        compared->of_beads ? found.bead_peaks : found.contact_peaks, bead_run_second_peaks(other->run, compared->of_beads)};
    if (!is_fine && outcome->energy_error > 0)
        compared->of.factor = fmax(fmin(compared->of.factor, found.energy_error / outcome->energy_error), least_factor);
    if (!isnan(over))
        compared->of.end = compared->of.end > 0 ? fmin(compared->of.end, over) : fmin(outcome->end, over);
}

/* Runs a chain again, if it has not been, as far as its run went, and looks for peaks. */
static enum bead_error run_again(const struct bead_play *p, const struct bead_runner *run, double tolerance_factor, double apart,
                                 struct bead_runner *again, struct bead_message *msg)
{
    struct bead_run_settings settings = settings_of(p, tolerance_factor);
    const bool is_over = !isnan(run->kind->over(run->run));
    const struct bead_way way = bead_play_way(p, is_over ? INFINITY : run->kind->time(run->run));
    if (again->run)
        return BEAD_OK;
    settings.chain = run->chain;
    settings.peaks_apart = apart;
    settings.heights = true;
    BEAD_TRY(bead_runner_create(&settings, again, msg));
    BEAD_TRY(bead_play_run(again, &way, msg));
    if (p->counts) {
        const struct bead_run_work work = again->kind->work(again->run);
        __atomic_fetch_add(&p->counts->comparison_steps, work.steps, __ATOMIC_RELAXED);
        __atomic_fetch_add(&p->counts->comparison_evaluations, work.evaluations, __ATOMIC_RELAXED);
    }
    return BEAD_OK;
}

/* The heights of another run after the horizon and the peaks. */
static void look_late(const struct bead_run *run, double from, const struct compared *compared, double *heights)
{
    const struct bead_uncertain_peaks *p = &compared->peaks;
    for (size_t i = 0; i < p->count; i++)
        heights[i] = bead_heights_after(bead_run_heights(run), compared->of_beads, i,
                                        bead_uncertainty_after(&compared->of, p, i, from), p->peaks[i].time + compared->of.apart);
}

/* Stores the uncertainties of the peaks, and marks the unpredictable ones. */
static enum bead_error keep(const struct compared *compared, double from, struct bead_peak **judged, struct bead_outcome *outcome,
                            struct bead_message *msg)
{
    const struct bead_uncertain_peaks *p = &compared->peaks;
    const double reach = bead_uncertainty_reach(p);
    outcome->predictable_until = outcome->predictable_until > 0 ? fmin(outcome->predictable_until, from) : from;
    note_worst(compared, outcome);
    BEAD_TRY(bead_new(judged, p->count, msg, "%zu peaks", p->count));
    memcpy(*judged, p->peaks, p->count * sizeof **judged);
    for (size_t i = 0; i < p->count; i++)
        (*judged)[i].unpredictable = bead_uncertainty_is_lost(&compared->of, p, i, from, reach);
    *(compared->of_beads ? &outcome->bead_peaks : &outcome->contact_peaks) = *judged;
    *(compared->of_beads ? &outcome->bead_uncertainty : &outcome->contact_uncertainty) = p->uncertainty;
    *(compared->of_beads ? &outcome->bead_time_uncertainty : &outcome->contact_time_uncertainty) = p->time_uncertainty;
    return BEAD_OK;
}

struct comparing {
    const struct bead_play *play;
    struct bead_played *played;
    double factor; /* of the comparison runs */
};

/* The other runs of a chain that some peaks need: a finer one, and a coarse one that shows what comes after the horizon. */
struct others {
    struct bead_runner fine, late;
};

static double refinement_of(const struct bead_play *p)
{
    return p->refinement > 0 ? p->refinement : 1;
}

/* The peaks of a chain's contacts, or beads, in its run. */
static struct compared compared_of(const struct comparing *c, size_t chain, bool of_beads)
{
    const struct bead_play *p = c->play;
    const struct bead_chain *of = p->chains[chain];
    const struct bead_outcome *outcome = &c->played->outcomes[chain];
    return (struct compared){
        .of = {.accuracy = p->simulate->step > 0 ? 0 : p->simulate->accuracy * refinement_of(p),
               .factor = bead_run_effective_factor(of, p->simulate, c->factor) / refinement_of(p),
               .apart = bead_compare_apart(p, chain)},
        .peaks = {.peaks = of_beads ? outcome->bead_peaks : outcome->contact_peaks,
                  .second = bead_run_second_peaks(c->played->runs[chain].run, of_beads),
                  .count = of_beads ? bead_chain_beads(of) : bead_chain_contacts(of)},
        .of_beads = of_beads,
    };
}

/* Finds the heights of both other runs after the horizon, [2][peaks]: those of a coarse one, if no finer one was needed. */
static enum bead_error find_heights(const struct comparing *c, size_t chain, double from, struct compared *compared,
                                    struct others *others, double **heights, struct bead_message *msg)
{
    struct bead_uncertain_peaks *peaks = &compared->peaks;
    const bool is_fine = peaks->coarse.highest && peaks->fine.highest;
    struct bead_runner *other = is_fine ? &others->fine : &others->late;
    if (!is_fine)
        BEAD_TRY(run_again(c->play, &c->played->runs[chain], c->factor / 2, compared->of.apart, other, msg));
    BEAD_TRY(bead_new(heights, 2 * peaks->count, msg, "%zu peaks", peaks->count));
    const struct bead_runner *runs[BEAD_UNCERTAINTY_LATE] = {&c->played->comparison_runs[chain], other};
    for (size_t r = 0; r < BEAD_UNCERTAINTY_LATE; r++) {
        double *late = *heights + r * peaks->count;
        look_late(runs[r]->run, from, compared, late);
        peaks->late[r] = late;
    }
    return BEAD_OK;
}

/* Finds the uncertainties of the peaks of a chain's contacts, or beads, if they were asked for, and the horizon if it comes before
 * `from`. */
static enum bead_error compare_kind(const struct comparing *c, size_t chain, bool of_beads, struct others *others, double *from,
                                    struct bead_message *msg)
{
    struct compared compared = compared_of(c, chain, of_beads);
    struct bead_uncertain_peaks *peaks = &compared.peaks;
    struct bead_outcome *outcome = &c->played->outcomes[chain];
    const bool is_fine = compared.of.accuracy > 0 && compared.of.factor < 1;
    const size_t own = 2 * chain + of_beads;
    BEAD_FREED double *heights = NULL;
    add_run(&c->played->comparison_runs[chain], is_fine, outcome, &compared);
    if (!(is_fine ? &peaks->fine : &peaks->coarse)->highest)
        return BEAD_OK;
    BEAD_TRY(bead_new(&c->played->uncertainty[own], 2 * peaks->count, msg, "%zu peaks", peaks->count));
    peaks->uncertainty = c->played->uncertainty[own];
    peaks->time_uncertainty = peaks->uncertainty + peaks->count;
    if (!is_fine && (others->fine.run || bead_uncertainty_wants_fine(&compared.of, peaks))) {
        BEAD_TRY(run_again(c->play, &c->played->runs[chain], BEAD_UNCERTAINTY_FINER * refinement_of(c->play), compared.of.apart,
                           &others->fine, msg));
        add_run(&others->fine, true, outcome, &compared);
    }
    *from = fmin(*from, bead_uncertainty_find(&compared.of, peaks));
    if (!of_beads && !wants_contacts(c->play, true)) {
        outcome->contact_peaks = wants_contacts(c->play, false) ? outcome->contact_peaks : NULL;
        return BEAD_OK;
    }
    if (*from < outcome->end)
        BEAD_TRY(find_heights(c, chain, *from, &compared, others, &heights, msg));
    return keep(&compared, *from, &c->played->judged[own], outcome, msg);
}

/* Finds the uncertainties of a chain's peaks: of contacts as if those of beads had not been asked for; of beads with the horizon of
 * contacts, whether or not these were asked for. So no output depends on another one. */
static enum bead_error compare_peaks(void *context, size_t chain, bool, struct bead_message *msg)
{
    const struct comparing *c = context;
    struct others others = {{NULL, NULL, NULL}, {NULL, NULL, NULL}};
    double from = INFINITY;
    enum bead_error err = BEAD_OK;
    for (int of_beads = 0; of_beads < 2 && !err; of_beads++)
        err = compare_kind(c, chain, of_beads, &others, &from, msg);
    bead_runner_destroy(&others.fine);
    bead_runner_destroy(&others.late);
    return err;
}

enum bead_error bead_compare_finish(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    if (!bead_compare_peaks(p))
        return BEAD_OK;
    struct comparing comparing = {p, played, bead_play_comparison_factor(p, compares_samples(p))};
    bead_compare_free(played);
    BEAD_TRY(bead_new(&played->uncertainty, 2 * p->chain_count, msg, "the peaks of %zu chains", p->chain_count));
    BEAD_TRY(bead_new(&played->judged, 2 * p->chain_count, msg, "the peaks of %zu chains", p->chain_count));
    return bead_thread_pool_run(p->chain_count, p->threads, compare_peaks, &comparing, msg);
}

void bead_compare_free(struct bead_played *played)
{
    for (size_t i = 0; i < 2 * played->count; i++) {
        if (played->uncertainty)
            free(played->uncertainty[i]);
        if (played->judged)
            free(played->judged[i]);
    }
    free(played->uncertainty);
    free(played->judged);
    played->uncertainty = NULL;
    played->judged = NULL;
}
