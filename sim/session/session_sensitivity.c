/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensitivities and standard deviations of peaks, after the run: each chain once more, its states kept, and back (sensitivity.h).
 */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/thread_pool.h"
#include "sim/run/sensitivity.h"
#include "sim/run/uncertainty.h"
#include "sim/session/session_data.h"

struct bead_sensitivities {
    size_t count;
    struct bead_sensitivity *found;  /* [count], rising */
    struct bead_sensitivity *checks; /* of the check run; NULL: there is none */
    double *deviation[2];            /* [contacts], [beads]; NULL: not asked */
    bool *rivalled[2];               /* for the same peaks */
};

void bead_session_free_sensitivities(struct bead_session *s)
{
    for (size_t c = 0; s->sensitivities && c < s->chain_count; c++) {
        struct bead_sensitivities *own = &s->sensitivities[c];
        for (size_t i = 0; i < own->count; i++) {
            bead_sensitivity_free(&own->found[i]);
            if (own->checks)
                bead_sensitivity_free(&own->checks[i]);
        }
        free(own->found);
        free(own->checks);
        free(own->deviation[0]);
        free(own->deviation[1]);
        free(own->rivalled[0]);
        free(own->rivalled[1]);
    }
    free(s->sensitivities);
    s->sensitivities = NULL;
}

static struct bead_sensitivity_run run_of(const struct bead_session *s, size_t chain)
{
    return (struct bead_sensitivity_run){.chain = s->chains[chain],
                                         .kernels = s->kernels,
                                         .stop = s->job.stop,
                                         .accuracy = s->source->simulate.accuracy,
                                         .passage = s->passage};
}

/* Marks the contacts that outputs ask for: bit 0, and bit 1 if it is one of the defaults of outputs that name none. */
static enum bead_error mark_contacts(const struct bead_session *s, size_t chain, unsigned char *mark, struct bead_message *msg)
{
    const struct bead_chain *c = s->chains[chain];
    size_t sensors = 0;
    bead_chain_sensors(c, &sensors);
    BEAD_FREED size_t *list;
    BEAD_TRY(bead_new(&list, 2 * sensors + 1, msg, "a session"));
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_needs *n = &s->made[i].needs;
        if (!s->made[i].sink || !n->sensitivities)
            continue;
        for (size_t k = 0; k < n->contact_count; k++) {
            if (n->contacts[k] < bead_chain_contacts(c)) /* chains may have fewer contacts than others */
                mark[n->contacts[k]] |= 1;
        }
        const size_t meant = n->contacts ? 0 : bead_sensitive_contacts(c, s->played.outcomes[chain].contact_peaks, list);
        for (size_t k = 0; k < meant; k++)
            mark[list[k]] |= 3;
    }
    return BEAD_OK;
}

/* Lists the peaks of the marked contacts, of all contacts, or of all beads. Returns how many. */
static size_t list_peaks(const struct bead_peak *peaks, size_t count, bool of_beads, const unsigned char *mark,
                         struct bead_sensitive *list)
{
    size_t listed = 0;
    for (size_t i = 0; i < count; i++) {
        if (!mark || mark[i])
            list[listed++] = (struct bead_sensitive){.of_bead = of_beads, .index = i, .peak = &peaks[i]};
    }
    return listed;
}

/* Finds the sensitivities of the check run, at its own peaks. */
static enum bead_error check_sensitivities(struct bead_session *s, size_t chain, struct bead_sensitive *list,
                                           const unsigned char *mark, struct bead_message *msg)
{
    struct bead_sensitivities *own = &s->sensitivities[chain];
    struct bead_outcome *check = &s->played.checks[chain];
    struct bead_sensitivity_run run = run_of(s, chain);
    run.refinement = BEAD_UNCERTAINTY_FINER;
    list_peaks(check->contact_peaks, bead_chain_contacts(s->chains[chain]), false, mark, list);
    BEAD_TRY(bead_new(&own->checks, own->count, msg, "a session"));
    BEAD_TRY(bead_sensitivities_find(&run, list, own->count, own->checks, msg));
    check->sensitivities = own->checks;
    check->sensitivity_count = own->count;
    return BEAD_OK;
}

static enum bead_error find_sensitivities(struct bead_session *s, size_t chain, struct bead_sensitive *list, unsigned char *mark,
                                          struct bead_message *msg)
{
    struct bead_sensitivities *own = &s->sensitivities[chain];
    struct bead_outcome *o = &s->played.outcomes[chain];
    const struct bead_sensitivity_run run = run_of(s, chain);
    BEAD_TRY(mark_contacts(s, chain, mark, msg));
    const size_t count = list_peaks(o->contact_peaks, bead_chain_contacts(s->chains[chain]), false, mark, list);
    BEAD_TRY(bead_new(&own->found, count, msg, "a session"));
    own->count = count;
    enum bead_error err = bead_sensitivities_find(&run, list, count, own->found, msg);
    for (size_t i = 0; i < count; i++)
        own->found[i].of_default = mark[own->found[i].index] & 2;
    o->sensitivities = own->found;
    o->sensitivity_count = err ? 0 : count;
    return !err && o->check && o->check->contact_peaks ? check_sensitivities(s, chain, list, mark, msg) : err;
}

static enum bead_error find_deviations(struct bead_session *s, size_t chain, bool of_beads, struct bead_sensitive *list,
                                       struct bead_message *msg)
{
    const struct bead_chain *c = s->chains[chain];
    struct bead_outcome *o = &s->played.outcomes[chain];
    const struct bead_sensitivity_run run = run_of(s, chain);
    const size_t count = list_peaks(of_beads ? o->bead_peaks : o->contact_peaks,
                                    of_beads ? bead_chain_beads(c) : bead_chain_contacts(c), of_beads, NULL, list);
    const struct bead_peak *rivals = bead_run_rivals(s->played.runs[chain].run, of_beads);
    for (size_t i = 0; rivals && i < count; i++)
        list[i].rival = &rivals[i];
    double *deviation;
    BEAD_TRY(bead_new(&deviation, count, msg, "a session"));
    s->sensitivities[chain].deviation[of_beads] = deviation;
    *(of_beads ? &o->bead_deviation : &o->contact_deviation) = deviation;
    bool *rivalled;
    BEAD_TRY(bead_new(&rivalled, count, msg, "a session"));
    s->sensitivities[chain].rivalled[of_beads] = rivalled;
    *(of_beads ? &o->bead_rivalled : &o->contact_rivalled) = rivalled;
    return bead_deviations_find(&run, list, count, deviation, rivalled, msg);
}

/* The requests of all outputs. */
struct wanted {
    struct bead_session *session;
    bool sensitivities, deviation[2];
};

static enum bead_error find_of_chain(void *context, size_t chain, bool, struct bead_message *msg)
{
    const struct wanted *wanted = context;
    const size_t beads = bead_chain_beads(wanted->session->chains[chain]);
    BEAD_FREED struct bead_sensitive *list = NULL;
    BEAD_FREED unsigned char *mark = NULL;
    BEAD_TRY(bead_new(&list, beads, msg, "sensitivities"));
    BEAD_TRY(bead_new(&mark, beads, msg, "sensitivities"));
    if (wanted->sensitivities)
        BEAD_TRY(find_sensitivities(wanted->session, chain, list, mark, msg));
    for (int of_beads = 0; of_beads < 2; of_beads++) {
        if (wanted->deviation[of_beads])
            BEAD_TRY(find_deviations(wanted->session, chain, of_beads, list, msg));
    }
    return BEAD_OK;
}

enum bead_error bead_session_find_sensitivities(struct bead_session *s, struct bead_message *msg)
{
    struct wanted wanted = {.session = s};
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_needs *n = &s->made[i].needs;
        if (!s->made[i].sink)
            continue;
        wanted.sensitivities |= n->sensitivities;
        wanted.deviation[0] |= n->deviation && n->contact_peaks;
        wanted.deviation[1] |= n->deviation && n->bead_peaks;
    }
    if (!wanted.sensitivities && !wanted.deviation[0] && !wanted.deviation[1])
        return BEAD_OK;
    BEAD_TRY(bead_new(&s->sensitivities, s->chain_count, msg, "a session"));
    return bead_thread_pool_run(s->chain_count, s->threads, find_of_chain, &wanted, msg);
}
