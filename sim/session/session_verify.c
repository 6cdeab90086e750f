/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Verifies the accuracy before the run (`simulate: {verify: true}`), and warns of steps that are too long. */

#include "sim/chain/chain_internal.h"
#include "sim/session/session_data.h"
#include "sim/session/session_internal.h"

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
