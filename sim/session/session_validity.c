/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warns, once, if a run has left the model: see validity.h. */

#include "sim/chain/chain_internal.h"
#include "sim/chain/validity.h"
#include "sim/session/session_data.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

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
