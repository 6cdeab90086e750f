/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of measures: a row for each number, a block for each chain. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/system.h"
#include "sim/measure/sink_grid.h"
#include "sim/output/table.h"

enum { MOST_MEASURES = 128 };

static bool of_beads(const struct bead_chain *chain)
{
    return bead_chain_spec(chain)->system->has_contacts;
}

/* Make the last sample the end of the run, so that measures include all of it. */
static void end_with_run(struct bead_grid *grid)
{
    const double length = grid->end - grid->start, parts = ceil(length / grid->every * (1 - 1e-9));
    if (parts >= 1)
        grid->every = length / parts;
}

static enum bead_error measures_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    size_t watched = 0;
    char every[32];
    for (size_t c = 0; c < sink->context.chain_count; c++)
        watched += of_beads(sink->context.chains[c]);
    if (watched == 0)
        return BEAD_OK;
    struct bead_run_context context = sink->context;
    sink->each = bead_measures_each(context.chains, context.chain_count);
    context.resolution *= BEAD_MEASURE_SPACING;
    BEAD_TRY(bead_sink_grid(sink->output, &context, &sink->grid, msg));
    if (!(context.native.every > 0))
        end_with_run(&sink->grid);
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    snprintf(sink->why, sizeof sink->why, "measures of the run, from %zu samples every %s", bead_grid_count(&sink->grid), every);
    return BEAD_OK;
}

static void measures_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    if (!(sink->grid.every > 0)) {
        needs->until = INFINITY;
        return;
    }
    needs->fields = BEAD_MEASURE_FIELDS;
    needs->beads = (struct bead_span){0, SIZE_MAX};
    needs->states = true;
}

static bool is_check(const struct bead_sink *sink)
{
    return !sink->path; /* it is not written */
}

/* Not earlier, because creating measures simulates the clean wave. */
static enum bead_error measures_begin(struct bead_sink *sink, struct bead_message *msg)
{
    size_t count = sink->context.chain_count;
    BEAD_TRY(bead_new(&sink->measures, count, msg, "a table"));
    for (size_t c = 0; c < count; c++) {
        if (of_beads(sink->context.chains[c])) /* equations have other measures */
            BEAD_TRY(bead_measures_create(sink->context.chains[c], is_check(sink), &sink->measures[c], msg));
    }
    return BEAD_OK;
}

static enum bead_error measures_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    struct bead_measures *measures = sink->measures[sample->chain];
    return measures ? bead_measures_feed(measures, sample, msg) : BEAD_OK;
}

/* The measures of a chain or of an equation. */
static size_t read_all(struct bead_sink *sink, size_t chain, const struct bead_outcome *outcome,
                       struct bead_measure found[MOST_MEASURES])
{
    size_t count = sink->measures[chain] ? bead_measures_read(sink->measures[chain], outcome, found, MOST_MEASURES) : 0;
    for (size_t i = 0; outcome && outcome->measures && i < outcome->measure_count && count < MOST_MEASURES; i++)
        found[count++] = outcome->measures[i];
    return count < MOST_MEASURES ? count : MOST_MEASURES;
}

static void measures_end(struct bead_sink *sink, const struct bead_outcome *outcomes)
{
    struct bead_measure found[MOST_MEASURES], checks[MOST_MEASURES];
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        const struct bead_outcome *outcome = outcomes ? &outcomes[c] : NULL, *check = outcome ? outcome->check : NULL;
        const size_t count = read_all(sink, c, outcome, found);
        const size_t checked = sink->check && check ? read_all(sink->check, c, check, checks) : 0;
        for (size_t i = 0; i < count; i++) {
            const struct bead_measure *m = &found[i];
            const double uncertainty = bead_measure_uncertainty(m, checks, checked);
            bead_table_chain_name(sink, c);
            bead_table_text(sink->file, m->name);
            bead_table_numbers(sink->file, 1, &m->value);
            fprintf(sink->file, ",%s,%s", m->unit, m->note);
            if (bead_table_is_judged(sink))
                bead_table_uncertainties(sink->file, 1, &uncertainty);
            bead_table_end_row(sink);
        }
    }
}

const struct table bead_table_measures = {.why = "measures of the run",
                                          .prepare = measures_prepare,
                                          .needs = measures_needs,
                                          .columns = "name,value,unit,note",
                                          .uncertainties = ",uncertainty",
                                          .sample = measures_sample,
                                          .end = measures_end,
                                          .checked = true,
                                          .begin = measures_begin};
