/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public player: plays one chain into one consumer with the loop of play.c, as far as the caller wants. */
#include "beadreel/play.h"

#include <math.h>
#include <stdlib.h>

#include "beadreel/chain.h"
#include "sim/base/memory.h"
#include "sim/base/settings.h"
#include "sim/chain/chain_internal.h"
#include "sim/run/play.h"

struct bead_player {
    struct bead_player_settings settings;
    struct bead_simulate simulate;
    struct bead_consumer consumer;
    struct bead_play play;
    struct bead_played played;
    bool finished;
    enum bead_error failed;      /* error that ended it; */
    struct bead_message failure; /* all later calls fail with it */
};

static enum bead_error take(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    const struct bead_player_settings *s = consumer->context;
    return s->take(s->context, sample, msg);
}

static enum bead_error check(const struct bead_player_settings *s, struct bead_message *msg)
{
    if (!s->chain)
        return bead_fail(msg, BEAD_ERROR_USAGE, "bead_player_settings: no chain given");
    if (!(s->until >= 0 && s->every >= 0 && isfinite(s->every) && s->step >= 0 && isfinite(s->step)))
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "bead_player_settings: until %g, every %g, step %g; must be 0 s (automatic) or more, and finite", s->until,
                         s->every, s->step);
    if (!(s->accuracy == 0 || (s->accuracy >= 1e-14 && s->accuracy <= 0.1)))
        return bead_fail(msg, BEAD_ERROR_USAGE, "bead_player_settings: accuracy %g; must be 0 (automatic) or from 1e-14 to 0.1",
                         s->accuracy);
    if (s->take ? !(s->fields && s->every > 0) : s->fields || s->every > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "bead_player_settings: samples need all of take, fields and every (s); give all of them or none");
    if (s->fields & ~bead_chain_fields(s->chain))
        return bead_fail(msg, BEAD_ERROR_USAGE, "bead_player_settings: fields 0x%x; this chain has 0x%x", s->fields,
                         bead_chain_fields(s->chain));
    return BEAD_OK;
}

/* The scene's settings, unless the player's override them. */
static struct bead_simulate simulate_of(const struct bead_player_settings *s)
{
    struct bead_simulate asked = bead_chain_scene(s->chain)->simulate;
    asked.until = s->until > 0 ? s->until : asked.until;
    asked.accuracy = s->accuracy > 0 ? s->accuracy : asked.accuracy;
    asked.method = s->method ? (char *)s->method : asked.method; /* not changed */
    asked.step = s->step > 0 ? s->step : asked.step;
    return asked;
}

static void prepare(struct bead_player *player)
{
    const struct bead_player_settings *s = &player->settings;
    player->simulate = simulate_of(s);
    const bool passage = !isfinite(player->simulate.until);
    const double end = passage ? INFINITY : player->simulate.until;
    player->consumer = (struct bead_consumer){.needs = {.fields = s->fields,
                                                        .beads = {0, SIZE_MAX},
                                                        .grid = {.every = s->every, .end = end},
                                                        .contact_peaks = s->contact_peaks,
                                                        .bead_peaks = s->bead_peaks,
                                                        .uncertainty = s->uncertainty},
                                              .take = take,
                                              .context = &player->settings};
    player->play = (struct bead_play){.chains = &s->chain,
                                      .chain_count = 1,
                                      .simulate = &player->simulate,
                                      .kernels = bead_kernels_find(s->instructions),
                                      .consumers = &player->consumer,
                                      .consumer_count = 1,
                                      .end = end,
                                      .needed = INFINITY,
                                      .passage = passage ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE,
                                      .threads = 1,
                                      .refinement = 1,
                                      .tolerance_factor = bead_run_tolerance_factor(&s->chain, 1, &player->simulate),
                                      .what = "simulating",
                                      .stop = s->stop,
                                      .progress = s->progress,
                                      .progress_context = s->progress_context};
}

static enum bead_error begin(struct bead_player *player, struct bead_message *msg)
{
    BEAD_TRY(check(&player->settings, msg));
    prepare(player);
    if (!player->play.kernels)
        return bead_fail(msg, BEAD_ERROR_USAGE, "bead_player_settings: this machine has no kernels `%s`",
                         player->settings.instructions);
    if (isinf(player->play.end) && !bead_chain_contacts(player->settings.chain))
        return bead_fail(msg, BEAD_ERROR_USAGE, "bead_player_settings: until: an equation has no end of its own: give one");
    return bead_play_begin(&player->play, &player->played, msg);
}

enum bead_error bead_player_create(const struct bead_player_settings *settings, struct bead_player **player,
                                   struct bead_message *msg)
{
    *player = NULL;
    struct bead_player *made;
    BEAD_TRY(bead_new(&made, 1, msg, "a player"));
    enum bead_error err =
        bead_settings_take(&made->settings, sizeof made->settings, BEAD_SETTINGS_UP_TO(struct bead_player_settings, instructions),
                           settings, "bead_player_settings", msg);
    if (!err)
        err = begin(made, msg);
    if (err)
        bead_player_destroy(made);
    else
        *player = made;
    return err;
}

/* Fails unless the player can continue. */
static enum bead_error check_state(const struct bead_player *player, struct bead_message *msg)
{
    if (player->failed)
        return bead_fail(msg, player->failed, "%s", player->failure.text);
    return player->finished ? bead_fail(msg, BEAD_ERROR_USAGE, "the player has been finished: create another") : BEAD_OK;
}

/* Keeps an error, except a stop. */
static enum bead_error note(struct bead_player *player, enum bead_error err, const struct bead_message *failure,
                            struct bead_message *msg)
{
    if (err && err != BEAD_ERROR_STOPPED) {
        player->failed = err;
        player->failure = *failure;
    }
    return err ? bead_fail(msg, err, "%s", failure->text) : BEAD_OK;
}

enum bead_error bead_player_until(struct bead_player *player, double time, struct bead_message *msg)
{
    struct bead_message failure = {""};
    enum bead_error err = check_state(player, msg);
    if (!err && isnan(time))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "play until NaN: must be a time, s");
    if (err)
        return err;
    err = bead_play_advance(&player->play, &player->played, time, &failure);
    return note(player, err, &failure, msg);
}

enum bead_error bead_player_step(struct bead_player *player, struct bead_message *msg)
{
    const double before = bead_player_time(player);
    enum bead_error err = check_state(player, msg);
    if (!err && bead_player_is_over(player))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "the run is over at %.6g s: no step follows", before);
    if (!err)
        err = bead_player_until(player, nextafter(before, INFINITY), msg);
    return err ? err : bead_player_until(player, bead_player_time(player), msg); /* delivers the samples within the step */
}

double bead_player_time(const struct bead_player *player)
{
    const struct bead_runner *runner = &player->played.runs[0];
    return fmin(runner->kind->time(runner->run), player->play.end);
}

bool bead_player_is_over(const struct bead_player *player)
{
    const struct bead_runner *runner = &player->played.runs[0];
    const bool passed = player->play.passage && !isnan(runner->kind->over(runner->run));
    return player->finished || passed || runner->kind->time(runner->run) >= player->play.end;
}

enum bead_error bead_player_sample(struct bead_player *player, unsigned fields, struct bead_sample *sample,
                                   struct bead_message *msg)
{
    const struct bead_runner *runner = &player->played.runs[0];
    enum bead_error err = check_state(player, msg);
    *sample = (struct bead_sample){.chain = 0};
    if (!err && fields & ~bead_chain_fields(player->settings.chain))
        err =
            bead_fail(msg, BEAD_ERROR_USAGE, "fields 0x%x; this chain has 0x%x", fields, bead_chain_fields(player->settings.chain));
    if (err)
        return err;
    struct bead_message failure = {""};
    err = runner->kind->sample(runner->run, bead_player_time(player), fields, (struct bead_span){0, SIZE_MAX}, sample, &failure);
    return note(player, err, &failure, msg);
}

enum bead_error bead_player_finish(struct bead_player *player, const struct bead_outcome **outcome, struct bead_message *msg)
{
    struct bead_message failure = {""};
    *outcome = NULL;
    BEAD_TRY(check_state(player, msg));
    enum bead_error err = bead_play_finish(&player->play, &player->played, &failure);
    player->finished = err != BEAD_ERROR_STOPPED;
    if (!err)
        *outcome = player->played.outcomes;
    return note(player, err, &failure, msg);
}

void bead_player_destroy(struct bead_player *player)
{
    if (!player)
        return;
    bead_played_free(&player->played);
    free(player);
}
