/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparison runs: makes another run of each chain, at another tolerance, and estimates the errors of the peaks. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/run/play.h"
#include "sim/run/uncertainty.h"

/* Comparison runs for peaks only may be coarser by this factor, and cheaper: they only show how sensitive peaks are. */
static const double coarser = 3;

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

double bead_play_comparison_factor(const struct bead_play *p, bool samples)
{
    const bool free = !samples && !(p->simulate->step > 0) && p->tolerance_factor > p->refinement;
    return free ? coarser * p->tolerance_factor : p->tolerance_factor;
}

enum bead_error bead_compare_create(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    if (!compares_samples(p) && !bead_compare_peaks(p))
        return BEAD_OK;
    BEAD_TRY(bead_new(&played->comparison_runs, p->chain_count, msg, "%zu chains", p->chain_count));
    struct bead_run_settings settings = {.simulate = p->simulate,
                                         .kernels = p->kernels,
                                         .end = p->end,
                                         .passage = p->passage,
                                         .full_window = p->full_window,
                                         .tolerance_factor = bead_play_comparison_factor(p, compares_samples(p))};
    for (size_t i = 0; i < p->consumer_count; i++) {
        const struct bead_needs *needs = &p->consumers[i].needs;
        settings.contact_peaks |= needs->uncertainty && needs->contact_peaks;
        settings.bead_peaks |= needs->uncertainty && needs->bead_peaks;
    }
    for (size_t i = 0; i < p->chain_count; i++) {
        settings.chain = p->chains[i];
        BEAD_TRY(bead_runner_create(&settings, &played->comparison_runs[i], msg));
    }
    return BEAD_OK;
}

/* A contact and a bead beside it may have equal uncertainties except for rounding: then the contact counts. */
static const double clearly = 1 + 1e-9;

/* Notes the peak with the largest relative uncertainty. */
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

/* Finds the uncertainties of a chain's peaks from its run and its comparison run. */
static enum bead_error compare_peaks(const struct bead_play *p, struct bead_played *played, size_t chain, struct bead_message *msg)
{
    const size_t contacts = bead_chain_contacts(p->chains[chain]), beads = bead_chain_beads(p->chains[chain]);
    const struct bead_runner *comparison = &played->comparison_runs[chain];
    struct bead_outcome *outcome = &played->outcomes[chain], other;
    double **u = played->uncertainty + 2 * chain;
    u[0] = calloc(contacts, sizeof **u);
    u[1] = calloc(beads, sizeof **u);
    if (!u[0] || !u[1])
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the peaks of %zu beads", beads);
    comparison->kind->finish(comparison->run, outcome->end, &other);
    const double refinement = p->refinement > 0 ? p->refinement : 1, over = comparison->kind->over(comparison->run);
    const double asked_factor = bead_play_comparison_factor(p, compares_samples(p));
    const double factor = bead_run_effective_factor(p->chains[chain], p->simulate, asked_factor);
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

enum bead_error bead_compare_finish(const struct bead_play *p, struct bead_played *played, struct bead_message *msg)
{
    if (!bead_compare_peaks(p))
        return BEAD_OK;
    BEAD_TRY(bead_new(&played->uncertainty, 2 * p->chain_count, msg, "the peaks of %zu chains", p->chain_count));
    for (size_t i = 0; i < p->chain_count; i++)
        BEAD_TRY(compare_peaks(p, played, i, msg));
    return BEAD_OK;
}
