/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of the chains of a sweep over keys: each runs like a single chain for its table of measures. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/measure/measure.h"
#include "sim/run/method_choice.h"
#include "sim/run/uncertainty.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

enum { MOST_MEASURES = 128 };

struct work {
    const char *name;
    double *values, *finer; /* [configurations], the same of check runs: NaN if there is none */
    size_t every;           /* one chain in so many has a check run */
};

/* The measures of a chain, and of its check run (NULL: none). */
struct measured {
    struct bead_measures *run, *check;
    size_t each; /* samples for each of the run's measures */
};

static enum bead_error take(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    const struct measured *of = consumer->context;
    if (of->check && sample->check)
        BEAD_TRY(bead_measures_feed(of->check, sample->check, msg));
    return sample->index % of->each == 0 ? bead_measures_feed(of->run, sample, msg) : BEAD_OK;
}

static double value_of(const struct work *work, struct bead_measures *measures, const struct bead_outcome *outcome)
{
    struct bead_measure found[MOST_MEASURES];
    const size_t count = measures && outcome ? bead_measures_read(measures, outcome, found, MOST_MEASURES) : 0;
    for (size_t i = 0; i < count && i < MOST_MEASURES; i++) {
        if (strcmp(found[i].name, work->name) == 0)
            return found[i].value;
    }
    return NAN;
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

static enum bead_error run(const struct work *work, size_t index, const struct bead_play *asked, struct measured *of,
                           struct bead_message *msg)
{
    const struct bead_chain *chain = asked->chains[0];
    struct bead_play play = *asked;
    struct bead_pace pace;
    struct bead_played played;
    BEAD_TRY(bead_run_kind_of(chain)->pace(chain, play.simulate, 1, &pace, msg));
    BEAD_TRY(find_end(&play, msg));
    of->each = of->check ? bead_measures_each(&chain, 1) : 1;
    const double every = play.end / ceil(play.end / (BEAD_MEASURE_SPACING * pace.resolution)) / (double)of->each;
    struct bead_consumer consumer = {.needs = {.fields = BEAD_MEASURE_FIELDS,
                                               .beads = {0, SIZE_MAX},
                                               .grid = {.every = every, .end = play.end},
                                               .states = true,
                                               .checked = of->check != NULL,
                                               .each = of->each},
                                     .take = take,
                                     .context = of};
    play.consumers = &consumer;
    play.consumer_count = 1;
    enum bead_error err = bead_play(&play, &played, msg);
    if (!err) {
        work->values[index] = value_of(work, of->run, &played.outcomes[0]);
        work->finer[index] = value_of(work, of->check, played.outcomes[0].check);
    }
    bead_played_free(&played);
    return err;
}

static enum bead_error play_measured(void *context, size_t index, const struct bead_play *asked, struct bead_message *msg)
{
    const struct work *work = context;
    const struct bead_chain *chain = asked->chains[0];
    struct measured of = {NULL, NULL, 1};
    work->values[index] = work->finer[index] = NAN;
    enum bead_error err = bead_measures_create(chain, false, &of.run, msg);
    if (!err && (index % work->every == 0 || bead_is_long(chain)))
        err = bead_measures_create(chain, true, &of.check, msg);
    if (!err)
        err = run(work, index, asked, &of, msg);
    bead_measures_destroy(of.run);
    bead_measures_destroy(of.check);
    return err;
}

static void find_uncertainties(const struct work *work, size_t count, double *uncertainty)
{
    double worst = NAN;
    for (size_t i = 0; i < count; i++) {
        uncertainty[i] = bead_uncertainty_measured(0, work->values[i], work->finer[i]);
        if (work->values[i] != 0)
            worst = fmax(worst, uncertainty[i] / fabs(work->values[i]));
    }
    for (size_t i = 0; i < count; i++)
        uncertainty[i] = isnan(uncertainty[i]) ? worst * fabs(work->values[i]) : uncertainty[i];
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
                                    struct bead_sweep_values *values, const char **unit, struct bead_message *msg)
{
    const size_t count = bead_sweep_panel(sweep, 0)->configurations;
    struct bead_sweep_settings own;
    BEAD_FREED double *finer = NULL;
    *values = (struct bead_sweep_values){NULL, NULL};
    BEAD_TRY(bead_sweep_measure_unit(name, unit, msg));
    BEAD_TRY(bead_sweep_settings_take(&own, settings, msg));
    BEAD_TRY(bead_new(&values->value, count, msg, "measures of %zu chains", count));
    BEAD_TRY(bead_new(&values->uncertainty, count, msg, "measures of %zu chains", count));
    BEAD_TRY(bead_new(&finer, count, msg, "measures of %zu chains", count));
    struct work work = {name, values->value, finer, bead_sample_every(count)};
    struct sweep_generator generator = {
        .sweep = sweep, .settings = &own, .what = "measuring", .count = count, .play = play_measured, .context = &work};
    BEAD_TRY(bead_sweep_play(&generator, msg));
    find_uncertainties(&work, count, values->uncertainty);
    return BEAD_OK;
}

void bead_sweep_values_free(struct bead_sweep_values *values)
{
    free(values->value);
    free(values->uncertainty);
}
