/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs equations: steps a motion, samples it and reports its outcome. The counterpart of run.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/chain/chain_data.h"
#include "sim/chain/chain_internal.h"
#include "sim/run/run_kinds.h"

enum { MOST_MEASURES = 32 };

struct bead_run {
    struct bead_run_settings settings;
    const struct bead_equation *equation;
    struct bead_motion *motion;
    double *value[BEAD_FIELD_COUNT], *memory;
    double energy_start, energy_error, start; /* start: s, of the last step */
    uint64_t steps, hash;
    struct bead_pace pace;
    struct bead_measure measures[MOST_MEASURES];
};

static const struct bead_equation *equation_of(const struct bead_chain *chain)
{
    return chain->spec->system->equation;
}

/* Points of a run; its samples have the chain's points. On a grid of three quarters as many cells errors are (4/3)^p times as
 * large, p the order: five times the difference (bead_uncertainty_measured) is 1.7 times the error for p = 1, as at shocks, and 7
 * times for p = 3, as in smooth waves. */
static size_t points_of(const struct bead_run_settings *settings)
{
    const size_t points = settings->chain->beads;
    return settings->other_grid && equation_of(settings->chain)->by_grid ? (3 * points + 3) / 4 : points;
}

static struct bead_motion_settings settings_of(const struct bead_chain *chain, size_t points, const struct bead_simulate *asked,
                                               double tolerance_factor)
{
    tolerance_factor = tolerance_factor > 0 ? tolerance_factor : 1;
    const double half = 0.5; /* steps that the accuracy does not bound also differ */
    return (struct bead_motion_settings){.spec = &chain->spec->equation,
                                         .points = points,
                                         .shown = chain->beads,
                                         .method = asked->method,
                                         .accuracy = asked->step > 0 ? asked->accuracy : tolerance_factor * asked->accuracy,
                                         .step = tolerance_factor * asked->step,
                                         .end = asked->until,
                                         .part = tolerance_factor < 1 ? half : 1};
}

/* Error messages name the file and the chain. */
static enum bead_error create_motion(const struct bead_chain *chain, size_t points, const struct bead_simulate *asked,
                                     double tolerance_factor, struct bead_motion **motion, struct bead_message *msg)
{
    struct bead_motion_settings settings = settings_of(chain, points, asked, tolerance_factor);
    struct bead_message inner;
    *motion = NULL;
    enum bead_error err = equation_of(chain)->create(&settings, motion, &inner);
    const char *name = bead_chain_name(chain);
    if (err) {
        equation_of(chain)->destroy(*motion);
        *motion = NULL;
    }
    if (!err || err == BEAD_ERROR_MEMORY)
        return err ? bead_fail(msg, err, "%s", inner.text) : BEAD_OK;
    char at[128];
    const char *const key = strncmp(inner.text, "simulate.", 9) == 0 ? "simulate.step" : "chain";
    return bead_fail(msg, err, "%s%s%s%s%s", bead_chain_place(chain, key, at, sizeof at), *name ? "chain " : "", name,
                     *name ? ": " : "", inner.text);
}

static enum bead_error pace(const struct bead_chain *chain, const struct bead_simulate *asked, double tolerance_factor,
                            struct bead_pace *pace, struct bead_message *msg)
{
    struct bead_motion *motion;
    BEAD_TRY(create_motion(chain, chain->beads, asked, tolerance_factor, &motion, msg));
    equation_of(chain)->pace(motion, pace);
    equation_of(chain)->destroy(motion);
    return BEAD_OK;
}

static void equation_run_destroy(struct bead_run *run)
{
    if (!run)
        return;
    if (run->motion)
        run->equation->destroy(run->motion);
    free(run->memory);
    free(run);
}

static enum bead_error equation_run_create(const struct bead_run_settings *settings, struct bead_run **made,
                                           struct bead_message *msg)
{
    size_t n = settings->chain->beads;
    *made = NULL;
    struct bead_run *run = calloc(1, sizeof *run);
    if (!run || !(run->memory = calloc(n * BEAD_FIELD_COUNT, sizeof(double)))) {
        free(run);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a run of %zu points", n);
    }
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
        run->value[f] = run->memory + f * n;
    run->settings = *settings;
    run->equation = equation_of(settings->chain);
    enum bead_error err =
        create_motion(settings->chain, points_of(settings), settings->simulate, settings->tolerance_factor, &run->motion, msg);
    if (err) {
        equation_run_destroy(run);
        return err;
    }
    run->equation->pace(run->motion, &run->pace);
    run->energy_start = run->equation->energy(run->motion);
    *made = run;
    return BEAD_OK;
}

static double time_of(const struct bead_run *run)
{
    return run->equation->time(run->motion);
}

static double never_over(const struct bead_run *)
{
    return NAN;
}

static bool never_so(const struct bead_run *)
{
    return false;
}

/* Hashes every bit of the state. */
static void hash_state(struct bead_run *run)
{
    size_t count = 0;
    const double *state = run->equation->state(run->motion, &count);
    for (size_t i = 0; i < count; i++) {
        uint64_t word;
        memcpy(&word, &state[i], sizeof word);
        uint64_t h = (word ^ (run->steps * 0x9e3779b97f4a7c15u)) + i * 0xc2b2ae3d27d4eb4fu;
        h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9u;
        run->hash += (h ^ (h >> 29)) * 0x94d049bb133111ebu;
    }
}

static enum bead_error equation_run_step(struct bead_run *run, struct bead_message *msg)
{
    const char *name = bead_chain_name(run->settings.chain);
    struct bead_message inner;
    run->start = time_of(run);
    enum bead_error err = run->equation->step(run->motion, &inner);
    if (err)
        return bead_fail(msg, err, "%s%s%s%s", *name ? "chain " : "", name, *name ? ": " : "", inner.text);
    run->steps++;
    double off = fabs(run->equation->energy(run->motion) - run->energy_start), scale = fabs(run->energy_start);
    run->energy_error = fmax(run->energy_error, scale > 0 ? off / scale : off);
    if (run->settings.hash)
        hash_state(run);
    return BEAD_OK;
}

static enum bead_error equation_run_sample(struct bead_run *run, double t, unsigned fields, struct bead_span span,
                                           struct bead_sample *sample, struct bead_message *msg)
{
    (void)span; /* all points: equations have no front with points at rest ahead of it */
    if (!(t >= run->start && t <= time_of(run)))
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "a sample at %.9g lies outside the step from %.9g to %.9g", t, run->start,
                         time_of(run));
    fields &= bead_chain_fields(run->settings.chain);
    sample->time = t;
    sample->active = run->settings.chain->beads;
    enum bead_error err = run->equation->sample(run->motion, t, fields, run->value, msg);
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
        sample->field[f] = fields & BEAD_FIELD_BIT(f) ? run->value[f] : NULL;
    return err;
}

static struct bead_run_work work(const struct bead_run *run)
{
    const uint64_t evaluations = run->equation->evaluations ? run->equation->evaluations(run->motion) : 0;
    return (struct bead_run_work){run->steps, evaluations, run->hash};
}

static void equation_run_finish(struct bead_run *run, double end, struct bead_outcome *outcome)
{
    const size_t count = run->equation->measures(run->motion, run->measures, MOST_MEASURES);
    *outcome = (struct bead_outcome){.end = end,
                                     .front_arrival = NAN,
                                     .method = run->pace.method,
                                     .step = run->pace.step,
                                     .steps = run->steps,
                                     .evaluations = work(run).evaluations,
                                     .energy_start = run->energy_start,
                                     .energy_end = run->equation->energy(run->motion),
                                     .momentum_start = NAN,
                                     .momentum_end = NAN,
                                     .energy_error = run->energy_error,
                                     .embedded_error = NAN,
                                     .event_error = NAN,
                                     .measures = run->measures,
                                     .measure_count = count < MOST_MEASURES ? count : MOST_MEASURES};
}

const struct bead_run_kind bead_run_of_equation = {
    .create = equation_run_create,
    .destroy = equation_run_destroy,
    .time = time_of,
    .over = never_over,
    .is_lost = never_so,
    .is_cut_short = never_so,
    .step = equation_run_step,
    .sample = equation_run_sample,
    .finish = equation_run_finish,
    .work = work,
    .pace = pace,
};
