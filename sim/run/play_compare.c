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
        settings.contact_peaks |= needs->uncertainty && needs->contact_peaks;
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

/* Notes the peak with the largest relative uncertainty. Forces still rising at the end of the run are not peaks. */
static void note_worst(const struct bead_uncertain_peaks kinds[2], struct bead_outcome *outcome)
{
    double *const which[2] = {&outcome->worst_contact, &outcome->worst_bead};
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < kinds[kind].count; i++) {
            const double force = kinds[kind].peaks[i].value, u = kinds[kind].uncertainty[i];
            if (!(u > 0) || kinds[kind].peaks[i].open || u * outcome->worst_force <= clearly * outcome->worst_uncertainty * force)
                continue;
            *which[0] = *which[1] = NAN;
            *which[kind] = (double)i;
            outcome->worst_force = force;
            outcome->worst_uncertainty = u;
        }
    }
}

/* The peaks of a chain's runs, side by side. */
struct compared {
    struct bead_uncertainty_of of;
    struct bead_uncertain_peaks kinds[2];
};

/* Adds the peaks of another run, which reached the end of the chain's run or ended before. */
static void add_run(const struct bead_runner *other, bool is_fine, struct bead_outcome *outcome, struct compared *compared)
{
    struct bead_outcome found;
    const double over = other->kind->over(other->run);
    other->kind->finish(other->run, outcome->end, &found);
    const struct bead_peak *peaks[2] = {found.contact_peaks, found.bead_peaks};
    for (size_t kind = 0; kind < 2; kind++) {
        struct bead_uncertain_peaks *k = &compared->kinds[kind];
        *(is_fine ? &k->fine : &k->coarse) = (struct bead_maxima){peaks[kind], bead_run_second_peaks(other->run, kind > 0)};
    }
    if (!is_fine && outcome->energy_error > 0)
        compared->of.factor = fmax(fmin(compared->of.factor, found.energy_error / outcome->energy_error), least_factor);
    if (!isnan(over))
        compared->of.end = compared->of.end > 0 ? fmin(compared->of.end, over) : fmin(outcome->end, over);
}

/* Runs a chain again, as far as its run went, and looks for peaks. */
static enum bead_error run_again(const struct bead_play *p, const struct bead_runner *run, double tolerance_factor, double apart,
                                 struct bead_runner *again, struct bead_message *msg)
{
    struct bead_run_settings settings = settings_of(p, tolerance_factor);
    const bool is_over = !isnan(run->kind->over(run->run));
    const struct bead_way way = bead_play_way(p, is_over ? INFINITY : run->kind->time(run->run));
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

/* The heights of another run after the horizon and the peaks, [contacts], then [beads]. */
static void look_late(const struct bead_run *run, double from, size_t r, double *heights, struct compared *compared)
{
    for (size_t kind = 0; kind < 2; kind++) {
        struct bead_uncertain_peaks *k = &compared->kinds[kind];
        for (size_t i = 0; i < k->count; i++)
            heights[i] = bead_heights_after(bead_run_heights(run), kind > 0, i, bead_uncertainty_after(&compared->of, k, i, from),
                                            k->peaks[i].time + compared->of.apart);
        k->late[r] = heights;
        heights += k->count;
    }
}

/* Stores the uncertainties of the peaks, and marks the unpredictable ones. */
static enum bead_error keep(const struct compared *compared, double from, struct bead_played *played, size_t chain,
                            struct bead_message *msg)
{
    struct bead_outcome *outcome = &played->outcomes[chain];
    const struct bead_peak **const peaks[2] = {&outcome->contact_peaks, &outcome->bead_peaks};
    const double **const uncertainty[2] = {&outcome->contact_uncertainty, &outcome->bead_uncertainty},
                         **const time[2] = {&outcome->contact_time_uncertainty, &outcome->bead_time_uncertainty};
    const double reach = bead_uncertainty_reach(compared->kinds);
    outcome->predictable_until = from;
    note_worst(compared->kinds, outcome);
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_uncertain_peaks *k = &compared->kinds[kind];
        struct bead_peak **judged = &played->judged[2 * chain + kind];
        if (k->count == 0)
            continue;
        BEAD_TRY(bead_new(judged, k->count, msg, "the peaks of %zu beads", k->count));
        memcpy(*judged, k->peaks, k->count * sizeof **judged);
        for (size_t i = 0; i < k->count; i++)
            (*judged)[i].unpredictable = bead_uncertainty_is_lost(&compared->of, k, i, from, reach);
        *peaks[kind] = *judged;
        *uncertainty[kind] = k->uncertainty;
        *time[kind] = k->time_uncertainty;
    }
    return BEAD_OK;
}

struct comparing {
    const struct bead_play *play;
    struct bead_played *played;
    double factor; /* of the comparison runs */
};

/* Finds the uncertainties of a chain's peaks. */
static enum bead_error compare_peaks(void *context, size_t chain, bool, struct bead_message *msg)
{
    const struct comparing *c = context;
    const struct bead_play *p = c->play;
    struct bead_outcome *outcome = &c->played->outcomes[chain];
    const size_t count[2] = {bead_chain_contacts(p->chains[chain]), bead_chain_beads(p->chains[chain])};
    double **u = c->played->uncertainty + 2 * chain;
    const struct bead_runner *run = &c->played->runs[chain];
    for (size_t kind = 0; kind < 2; kind++)
        BEAD_TRY(bead_new(&u[kind], 2 * count[kind], msg, "the peaks of %zu beads", count[1]));
    const double refinement = p->refinement > 0 ? p->refinement : 1;
    struct compared compared = {.of = {.accuracy = p->simulate->step > 0 ? 0 : p->simulate->accuracy * refinement,
                                       .factor = bead_run_effective_factor(p->chains[chain], p->simulate, c->factor) / refinement,
                                       .apart = bead_compare_apart(p, chain)},
                                .kinds = {{.peaks = outcome->contact_peaks,
                                           .second = bead_run_second_peaks(run->run, false),
                                           .uncertainty = u[0],
                                           .time_uncertainty = u[0] + count[0]},
                                          {.peaks = outcome->bead_peaks,
                                           .second = bead_run_second_peaks(run->run, true),
                                           .uncertainty = u[1],
                                           .time_uncertainty = u[1] + count[1]}}};
    const bool is_fine = compared.of.accuracy > 0 && compared.of.factor < 1;
    add_run(&c->played->comparison_runs[chain], is_fine, outcome, &compared);
    for (size_t kind = 0; kind < 2; kind++)
        compared.kinds[kind].count =
            (is_fine ? &compared.kinds[kind].fine : &compared.kinds[kind].coarse)->highest ? count[kind] : 0;
    BEAD_LEFT_TO(bead_runner_destroy) struct bead_runner other = {NULL, NULL, NULL};
    BEAD_FREED double *late = NULL;
    if (!is_fine && bead_uncertainty_wants_fine(&compared.of, compared.kinds)) {
        BEAD_TRY(run_again(p, run, BEAD_UNCERTAINTY_FINER * refinement, compared.of.apart, &other, msg));
        add_run(&other, true, outcome, &compared);
    }
    const double from = bead_uncertainty_find(&compared.of, compared.kinds);
    if (from < outcome->end) {
        if (!other.run)
            BEAD_TRY(run_again(p, run, c->factor / 2, compared.of.apart, &other, msg));
        BEAD_TRY(bead_new(&late, 4 * count[1], msg, "the peaks of %zu beads", count[1]));
        look_late(c->played->comparison_runs[chain].run, from, 0, late, &compared);
        look_late(other.run, from, 1, late + 2 * count[1], &compared);
    }
    return keep(&compared, from, c->played, chain, msg);
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
