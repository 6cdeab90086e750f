/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collects the profiles of a field at given times, for tables and plots. */
#include "sim/measure/profile_times.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/measure/sink_grid.h"

#include <math.h>
#include <stdlib.h>

struct profile {
    double *values; /* before the moment, then at it */
    double time;    /* s: of the last sample before it */
    bool complete;
};

struct bead_profile_times {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_grid grid;
    struct profile *profiles; /* [chains][moments] */
    double **places;          /* [chains][values] */
    char why[96];
};

size_t bead_profile_times_values(const struct bead_profile_times *m, size_t chain)
{
    const struct bead_chain *c = m->context.chains[chain];
    return bead_chain_field(c, m->output->shown.field)->of_contacts ? bead_chain_contacts(c) : bead_chain_beads(c);
}

const double *bead_profile_times_places(const struct bead_profile_times *m, size_t chain)
{
    return m->places[chain];
}

const double *bead_profile_times_profile(const struct bead_profile_times *m, size_t chain, size_t moment)
{
    return m->profiles[chain * m->output->curves.profile_time_count + moment].values;
}

void bead_profile_times_destroy(struct bead_profile_times *m)
{
    if (!m)
        return;
    for (size_t i = 0; m->profiles && i < m->context.chain_count * m->output->curves.profile_time_count; i++)
        free(m->profiles[i].values);
    for (size_t c = 0; m->places && c < m->context.chain_count; c++)
        free(m->places[c]);
    free(m->profiles);
    free(m->places);
    free(m);
}

static enum bead_error reserve(struct bead_profile_times *m, struct bead_message *msg)
{
    size_t chains = m->context.chain_count, moments = m->output->curves.profile_time_count;
    BEAD_TRY(bead_new(&m->profiles, chains * moments, msg, "profiles"));
    BEAD_TRY(bead_new(&m->places, chains, msg, "profiles"));
    for (size_t c = 0; c < chains; c++) {
        const struct bead_chain *chain = m->context.chains[c];
        const struct bead_chain_axis along = bead_chain_axis(chain, bead_chain_field(chain, m->output->shown.field)->of_contacts);
        size_t count = bead_profile_times_values(m, c);
        BEAD_TRY(bead_new(&m->places[c], count, msg, "profiles"));
        for (size_t i = 0; i < count; i++)
            m->places[c][i] = along.first + (double)i * along.spacing;
        for (size_t i = 0; i < moments; i++)
            BEAD_TRY(bead_new(&m->profiles[c * moments + i].values, count, msg, "profiles"));
    }
    return BEAD_OK;
}

/* Are all times on this grid? */
static bool hits(const struct bead_output *output, const struct bead_grid *grid)
{
    for (size_t i = 0; i < output->curves.profile_time_count; i++) {
        const double place = (output->curves.profile_times[i] - grid->start) / grid->every;
        if (fabs(place - round(place)) > 1e-9)
            return false;
    }
    return true;
}

bool bead_profile_times_are_samples(const struct bead_profile_times *m)
{
    return m->grid.times || hits(m->output, &m->grid);
}

/* The times themselves; of samples that there are already, those around them. */
static struct bead_grid choose_grid(const struct bead_output *output, const struct bead_run_context *context)
{
    const struct bead_grid *native = &context->native;
    const double *times = output->curves.profile_times;
    const size_t count = output->curves.profile_time_count;
    const double from = times[0], to = times[count - 1];
    if (native->every > 0 && (context->replayed || hits(output, native))) {
        double first = fmax(0, floor((from - native->start) / native->every + 1e-6));
        double end = ceil((to - native->start) / native->every - 1e-6);
        return (struct bead_grid){.start = native->start + first * native->every,
                                  .every = native->every,
                                  .end = fmin(native->end, native->start + end * native->every)};
    }
    double gap = count > 1 ? INFINITY : context->resolution;
    for (size_t i = 1; i < count; i++)
        gap = fmin(gap, times[i] - times[i - 1]);
    return (struct bead_grid){from, gap, to, false, times, count};
}

enum bead_error bead_profile_times_create(const struct bead_output *output, const struct bead_run_context *context,
                                          struct bead_profile_times **made, struct bead_message *msg)
{
    *made = NULL;
    double last = output->curves.profile_times[output->curves.profile_time_count - 1];
    if (last > context->end * (1 + 1e-9)) /* possible if the run ends when the front arrives */
        return bead_output_wrong(output, msg, "at: the last time is %g, but the run ends at %g", last, context->end);
    struct bead_profile_times *m;
    BEAD_TRY(bead_new(&m, 1, msg, "profiles"));
    m->output = output;
    m->context = *context;
    m->grid = choose_grid(output, context);
    snprintf(m->why, sizeof m->why, "%s at %zu time%s", bead_field_info(output->shown.field)->name,
             output->curves.profile_time_count, output->curves.profile_time_count == 1 ? "" : "s");
    enum bead_error err = reserve(m, msg);
    if (err)
        bead_profile_times_destroy(m);
    else
        *made = m;
    return err;
}

struct bead_needs bead_profile_times_needs(const struct bead_profile_times *m)
{
    return (struct bead_needs){.fields = BEAD_FIELD_BIT(m->output->shown.field),
                               .beads = {0, SIZE_MAX},
                               .grid = m->grid,
                               .until = m->grid.end,
                               .why = m->why};
}

/* The first sample after the moment: interpolate linearly between it and the last one before. */
static void complete(struct profile *p, const struct bead_sample *sample, const double *values, size_t count, double moment)
{
    const double weight = (moment - p->time) / (sample->time - p->time);
    for (size_t i = 0; i < count; i++)
        p->values[i] += weight * ((i < sample->active ? values[i] : 0) - p->values[i]);
    p->complete = true;
}

enum bead_error bead_profile_times_feed(struct bead_profile_times *m, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *values = sample->field[m->output->shown.field];
    if (!values)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s", bead_field_info(m->output->shown.field)->title);
    size_t count = bead_profile_times_values(m, sample->chain);
    double slack = 1e-6 * m->grid.every;
    for (size_t k = 0; k < m->output->curves.profile_time_count; k++) {
        struct profile *p = &m->profiles[sample->chain * m->output->curves.profile_time_count + k];
        double moment = m->output->curves.profile_times[k];
        if (p->complete)
            continue;
        if (sample->time > moment + slack) {
            complete(p, sample, values, count, moment);
            continue;
        }
        for (size_t i = 0; i < count; i++)
            p->values[i] = i < sample->active ? values[i] : 0;
        p->time = sample->time;
        p->complete = fabs(sample->time - moment) <= slack;
    }
    return BEAD_OK;
}
