/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Verifies the accuracy before the run (`simulate: {verify: true}`), and warns of steps that are too long, and where
 * the model may fail. */

#include "sim/chain/chain_internal.h"
#include "sim/chain/validity.h"
#include "sim/session/session_data.h"
#include "sim/session/session_internal.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

/* Each round takes a tenth of the last accuracy, with the method that suits it; below the least, only rounding differs. */
static const double tenth = 0.1, least = 1e-13;

/* The result of a round: peaks that miss the requested accuracy, and the worst of all. */
struct verdict {
    size_t peaks, poor;
    struct bead_outcome worst;
    size_t chain;
};

/* Forces still rising at the end of the run are not peaks. */
static void judge(const struct bead_peak *peaks, const double *uncertainty, size_t count, double accuracy, struct verdict *verdict)
{
    for (size_t i = 0; i < count; i++) {
        verdict->peaks += peaks[i].value > 0 && !peaks[i].open;
        verdict->poor += uncertainty[i] > accuracy * peaks[i].value && !peaks[i].open;
    }
}

/* Two runs of every chain, for their peaks only. */
static enum bead_error try_round(struct bead_session *s, struct verdict *verdict, struct bead_message *msg)
{
    struct bead_consumer consumer = {.needs = {.contact_peaks = true, .bead_peaks = true, .uncertainty = true, .until = INFINITY}};
    struct bead_play play = bead_session_play(s, "verifying");
    play.consumers = &consumer;
    play.consumer_count = 1;
    play.hash = false;
    play.counts = &s->counts;
    *verdict = (struct verdict){.worst = {.worst_uncertainty = NAN, .worst_force = NAN}};
    BEAD_LEFT_TO(bead_played_free) struct bead_played played;
    BEAD_TRY(bead_play(&play, &played, msg));
    for (size_t c = 0; c < played.count; c++) {
        const struct bead_outcome *o = &played.outcomes[c];
        judge(o->contact_peaks, o->contact_uncertainty, bead_chain_contacts(s->chains[c]), s->source->simulate.accuracy, verdict);
        judge(o->bead_peaks, o->bead_uncertainty, bead_chain_beads(s->chains[c]), s->source->simulate.accuracy, verdict);
        if (!(o->worst_uncertainty * verdict->worst.worst_force <= verdict->worst.worst_uncertainty * o->worst_force)) {
            verdict->worst = *o;
            verdict->chain = c;
        }
    }
    return BEAD_OK;
}

static void tell(struct bead_session *s, const struct verdict *verdict)
{
    const struct bead_outcome *w = &verdict->worst;
    const char *name = bead_chain_name(s->chains[verdict->chain]);
    const bool bead = !isnan(w->worst_bead);
    char at[128];
    s->unverified = true;
    snprintf(s->warning[SESSION_UNVERIFIED], sizeof s->warning[SESSION_UNVERIFIED],
             "%ssimulate.verify: %zu of %zu peaks did not reach the requested accuracy of %.3g; least certain: %s %.0f%s%s, %.6g "
             "N to %.2g of that",
             bead_chain_place(s->chains[verdict->chain], "simulate.verify", at, sizeof at), verdict->poor, verdict->peaks,
             s->source->simulate.accuracy, bead ? "bead" : "contact", bead ? w->worst_bead : w->worst_contact,
             *name ? " of chain " : "", name, w->worst_force, w->worst_uncertainty / w->worst_force);
}

enum bead_error bead_session_verify(struct bead_session *s, struct bead_message *msg)
{
    const struct bead_simulate *asked = &s->source->simulate;
    struct verdict verdict;
    enum bead_error err = BEAD_OK;
    if (!bead_chain_spec(s->chains[0])->system->has_contacts)
        return BEAD_OK;
    for (size_t i = 0; i < s->chain_count && !s->warning[SESSION_LONG_STEP][0]; i++)
        snprintf(s->warning[SESSION_LONG_STEP], sizeof s->warning[SESSION_LONG_STEP], "%s",
                 bead_run_long_step(s->chains[i], asked).text);
    if (!asked->verify)
        return BEAD_OK;
    for (s->verified = *asked; !err; s->verified.accuracy *= tenth) {
        s->tolerance_factor = bead_run_tolerance_factor(s->chains, s->chain_count, &s->verified);
        err = try_round(s, &verdict, msg);
        if (verdict.poor == 0 || tenth * s->verified.accuracy < least)
            break;
    }
    if (!err && verdict.poor > 0)
        tell(s, &verdict);
    return err;
}

const char *bead_session_warning(const struct bead_session *s, size_t index)
{
    for (size_t i = 0; i < SESSION_WARNINGS; i++) {
        const char *text = i == SESSION_DOUBTS && s->scene && s->scene->doubts ? s->scene->doubts : s->warning[i];
        if (*text && index-- == 0)
            return text;
    }
    return NULL;
}

bool bead_session_verified(const struct bead_session *s)
{
    return !s->unverified;
}

/* Warns, once, if a run has left the model: see validity.h. */

void bead_session_doubt(struct bead_session *s)
{
    for (size_t i = 0; i < s->chain_count && !s->trajectory; i++) {
        const struct bead_validity bound = bead_validity_bound(s->chains[i]);
        s->strained = s->strained || bead_validity_fails(&bound);
    }
}

void bead_session_judge(struct bead_session *s, const struct bead_chain *const *chains, const struct bead_outcome *outcomes,
                        size_t count)
{
    char words[400], place[200];
    for (size_t i = 0; i < count && !s->warning[SESSION_INVALID][0]; i++) {
        if (!outcomes[i].contact_peaks)
            continue;
        struct bead_validity found = bead_validity_begin(chains[i]);
        bead_validity_add_peaks(&found, chains[i], outcomes[i].contact_peaks);
        if (bead_validity_fails(&found))
            snprintf(s->warning[SESSION_INVALID], sizeof s->warning[SESSION_INVALID],
                     "%schain%s%s: beyond the model of elastic spheres: %s",
                     bead_chain_place(chains[i], "chain", place, sizeof place), *bead_chain_name(chains[i]) ? " " : "",
                     bead_chain_name(chains[i]), bead_validity_words(&found, words, sizeof words));
    }
}

/* Plays one chain for the peaks of its contacts. */
static enum bead_error judge_chain(struct bead_session *s, const struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_validity bound = bead_validity_bound(chain);
    struct bead_consumer consumer = {.needs = {.contact_peaks = true}};
    struct bead_play play = bead_session_play(s, "sweeping");
    if (!bead_validity_fails(&bound))
        return BEAD_OK;
    play.chains = &chain;
    play.chain_count = play.consumer_count = 1;
    play.consumers = &consumer;
    play.end = isnan(s->source->simulate.until) ? INFINITY : s->source->simulate.until;
    play.needed = INFINITY;
    play.passage = isfinite(play.end) ? BEAD_PASSAGE_NONE : BEAD_PASSAGE_OF_FRONT;
    play.hash = false;
    BEAD_LEFT_TO(bead_played_free) struct bead_played played;
    BEAD_TRY(bead_play(&play, &played, msg));
    bead_session_judge(s, &chain, played.outcomes, 1);
    return BEAD_OK;
}

enum bead_error bead_session_judge_sweep(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < bead_sweep_panels(s->sweep) && !s->warning[SESSION_INVALID][0]; i++) {
        struct bead_sweep_chain *made = NULL;
        err = bead_sweep_chain_create(s->sweep, i, BEAD_SWEEP_CLEAN, &made, msg);
        if (!err)
            err = judge_chain(s, bead_sweep_chain_of(made), msg);
        bead_sweep_chain_destroy(made);
    }
    return err;
}
