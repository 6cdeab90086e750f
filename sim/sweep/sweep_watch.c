/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs single configurations of a sweep for pictures: delivers samples during each run, and measures afterwards. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/measure/participation.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

struct work {
    const struct bead_sweep *sweep;
    struct bead_sweep_watch *watches;
    double *clean; /* [panels]: participation of the wave with all random cells up */
};

static enum bead_error give_sample(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    const struct bead_sweep_watch *watch = consumer->context;
    struct bead_sample own = *sample;
    own.time = fmin(own.time, consumer->needs.grid.end); /* rounding may take the grid beyond its end */
    return watch->take(watch->context, &own, msg);
}

/* Finds the clean index. If most cells are reversed, the clean wave is that of the reversed cell. */
static enum bead_error compare(const struct work *work, const struct bead_chain *chain, struct bead_sweep_watch *watch,
                               struct bead_message *msg)
{
    if (bead_sweep_is_over(&work->sweep->panels[watch->panel]))
        return BEAD_OK; /* there is no clean wave to compare */
    double clean = work->clean[watch->panel];
    size_t up = 0, down = 0;
    for (const char *spin = bead_chain_spins(chain); *spin; spin++) {
        up += *spin == '1';
        down += *spin == '0';
    }
    enum bead_error err = down > up ? bead_participation_clean(chain, 1, &clean, msg) : BEAD_OK;
    watch->clean_index = bead_clean_index(chain->beads, watch->participation, clean);
    return err;
}

static void find_watched(void *context, size_t index, size_t *panel, size_t *configuration)
{
    const struct work *work = context;
    *panel = work->watches[index].panel;
    *configuration = work->watches[index].index;
}

static struct bead_span span_of(const struct work *work, const struct bead_sweep_watch *watch, const struct bead_chain *chain)
{
    struct bead_span span = bead_sweep_place_span(&work->sweep->panels[watch->panel], chain, 0);
    span.last = span.last < chain->beads ? span.last : chain->beads - 1;
    span.first = span.first < span.last ? span.first : span.last;
    return span;
}

static enum bead_error play_watched(void *context, size_t index, const struct bead_play *asked, struct bead_message *msg)
{
    const struct work *work = context;
    struct bead_sweep_watch *watch = &work->watches[index];
    const struct bead_chain *chain = asked->chains[0];
    const struct bead_span span = span_of(work, watch, chain);
    struct bead_consumer consumer = {.needs = {.bead_peaks = true, .states = true}, .take = give_sample, .context = watch};
    struct bead_play play = *asked;
    struct bead_played played;
    play.end = watch->end > 0 ? watch->end : INFINITY;
    if (isinf(play.end))
        play.passage = BEAD_PASSAGE_OF_FRONT;
    if (watch->take) {
        consumer.needs.fields = watch->fields;
        consumer.needs.beads = (struct bead_span){0, chain->beads - 1};
        consumer.needs.grid = (struct bead_grid){.every = watch->every, .end = play.end, .widens = watch->widens};
    }
    if (watch->finer)
        play.refinement = bead_play_check_factor(&play);
    play.peak_span = &span;
    play.consumers = &consumer;
    play.consumer_count = 1;
    watch->force = 0;
    watch->participation = watch->clean_index = NAN;
    enum bead_error err = bead_play(&play, &played, msg);
    if (!err) {
        const struct bead_outcome *o = &played.outcomes[0];
        watch->arrival = o->front_arrival;
        if (o->arrived.displacement)
            watch->participation = bead_chain_participation(chain, o->arrived.displacement, o->arrived.velocity);
        for (size_t j = span.first; j <= span.last; j++)
            watch->force = fmax(watch->force, o->bead_peaks[j].value);
        err = compare(work, chain, watch, msg);
    }
    bead_played_free(&played);
    return err;
}

static enum bead_error find_clean(struct work *work, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    BEAD_TRY(bead_new(&work->clean, work->sweep->panel_count, msg, "the clean waves of a sweep"));
    for (size_t p = 0; p < work->sweep->panel_count && !err; p++) {
        struct bead_sweep_chain *chain = NULL;
        if (bead_sweep_is_over(&work->sweep->panels[p]))
            continue;
        err = bead_sweep_chain_create(work->sweep, p, BEAD_SWEEP_CLEAN, &chain, msg);
        if (!err)
            err = bead_participation_clean(bead_sweep_chain_of(chain), 1, &work->clean[p], msg);
        bead_sweep_chain_destroy(chain);
    }
    return err;
}

enum bead_error bead_sweep_watch(const struct bead_sweep *sweep, struct bead_sweep_watch *watches, size_t count,
                                 const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    struct bead_sweep_settings own;
    BEAD_TRY(bead_sweep_settings_take(&own, settings, msg));
    struct work work = {.sweep = sweep, .watches = watches};
    struct sweep_generator generator = {.sweep = sweep,
                                        .settings = &own,
                                        .what = "watching",
                                        .count = count,
                                        .find = find_watched,
                                        .play = play_watched,
                                        .context = &work};
    enum bead_error err = find_clean(&work, msg);
    if (!err)
        err = bead_sweep_play(&generator, msg);
    free(work.clean);
    return err;
}

enum bead_error bead_sweep_end(const struct bead_sweep *sweep, struct bead_sweep_watch *watches, size_t count,
                               const struct bead_sweep_settings *settings, double *end, struct bead_message *msg)
{
    *end = bead_sweep_scene(sweep)->simulate.until;
    if (!isnan(*end))
        return BEAD_OK;
    BEAD_TRY(bead_sweep_watch(sweep, watches, count, settings, msg));
    *end = 0;
    for (size_t i = 0; i < count; i++)
        *end = fmax(*end, watches[i].arrival);
    return BEAD_OK;
}
