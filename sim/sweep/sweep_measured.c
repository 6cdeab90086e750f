/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of the chains of a sweep over keys: each runs as a single chain does for its table of measures. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/measure/measure.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

enum { MOST_MEASURES = 128 };

struct work {
    const char *name;
    double *values; /* [configurations] */
};

static enum bead_error take(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_measures_feed(consumer->context, sample, msg);
}

/* Without `until`, a run finds when the pulse has passed. */
static enum bead_error find_end(struct bead_play *play, struct bead_message *msg)
{
    struct bead_played played;
    if (isfinite(play->end))
        return BEAD_OK;
    play->passage = BEAD_PASSAGE_OF_PULSE;
    enum bead_error err = bead_play(play, &played, msg);
    if (!err)
        play->end = played.outcomes[0].end;
    bead_played_free(&played);
    return err;
}

static enum bead_error run(const struct work *work, const struct bead_play *asked, struct bead_measures *measures, double *value,
                           struct bead_message *msg)
{
    const struct bead_chain *chain = asked->chains[0];
    struct bead_play play = *asked;
    struct bead_measure found[MOST_MEASURES];
    struct bead_pace pace;
    struct bead_played played;
    BEAD_TRY(bead_run_kind_of(chain)->pace(chain, play.simulate, 1, &pace, msg));
    BEAD_TRY(find_end(&play, msg));
    const double every = play.end / ceil(play.end / (BEAD_MEASURE_SPACING * pace.resolution));
    struct bead_consumer consumer = {
        .needs = {.fields = BEAD_MEASURE_FIELDS, .beads = {0, SIZE_MAX}, .grid = {0, every, play.end, false}, .states = true},
        .take = take,
        .context = measures};
    play.consumers = &consumer;
    play.consumer_count = 1;
    enum bead_error err = bead_play(&play, &played, msg);
    const size_t count = err ? 0 : bead_measures_read(measures, &played.outcomes[0], found, MOST_MEASURES);
    for (size_t i = 0; i < count && i < MOST_MEASURES; i++)
        *value = strcmp(found[i].name, work->name) == 0 ? found[i].value : *value;
    bead_played_free(&played);
    return err;
}

static enum bead_error play_measured(void *context, size_t index, const struct bead_play *asked, struct bead_message *msg)
{
    const struct work *work = context;
    struct bead_measures *measures;
    work->values[index] = NAN;
    BEAD_TRY(bead_measures_create(asked->chains[0], &measures, msg));
    enum bead_error err = run(work, asked, measures, &work->values[index], msg);
    bead_measures_destroy(measures);
    return err;
}

static void find(void *, size_t index, size_t *panel, size_t *configuration)
{
    *panel = 0;
    *configuration = index;
}

enum bead_error bead_sweep_measure_unit(const char *name, const char **unit, struct bead_message *msg)
{
    const struct bead_measure_info *info;
    struct bead_suggest search;
    char near[96];
    bead_suggest_begin(&search, name);
    for (size_t i = 0; (info = bead_measure_info(i)); i++) {
        bead_suggest_try(&search, info->name);
        if (strcmp(info->name, name) == 0) {
            *unit = info->unit;
            return BEAD_OK;
        }
    }
    return bead_fail(msg, BEAD_ERROR_USAGE, "measure: there is no `%s`%s; see --list measures", name,
                     bead_suggest_text(&search, near, sizeof near));
}

enum bead_error bead_sweep_measured(const struct bead_sweep *sweep, const char *name, const struct bead_sweep_settings *settings,
                                    double **values, const char **unit, struct bead_message *msg)
{
    const size_t count = bead_sweep_panel(sweep, 0)->configurations;
    struct bead_sweep_settings own;
    BEAD_TRY(bead_sweep_measure_unit(name, unit, msg));
    BEAD_TRY(bead_sweep_settings_take(&own, settings, msg));
    BEAD_TRY(bead_new(values, count, msg, "measures of %zu chains", count));
    struct work work = {name, *values};
    struct sweep_generator generator = {.sweep = sweep,
                                        .settings = &own,
                                        .what = "measuring",
                                        .count = count,
                                        .find = find,
                                        .play = play_measured,
                                        .context = &work};
    return bead_sweep_play(&generator, msg);
}
