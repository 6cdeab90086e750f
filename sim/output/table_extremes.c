/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of extremes: a row for each time and chain, with the value of a field furthest from 0, and its place. For the difference
 * of two runs also as a part of the largest value of the first until then: when and where they part. The uncertainty is that of the
 * magnitude, because the sign may change at any moment. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/output/table.h"

static const struct bead_field_info *extremes_field(const struct bead_sink *sink)
{
    const struct bead_field_info *own = bead_chain_field(sink->context.chains[0], sink->output->shown.field);
    return own ? own : bead_field_info(sink->output->shown.field);
}

static enum bead_error extremes_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&sink->largest, sink->context.chain_count, msg, "a table"));
    for (size_t c = 0; c < sink->context.chain_count; c++)
        BEAD_TRY(bead_table_add_column(sink, c, 0, "size", msg));
    for (size_t c = 0; c < sink->context.chain_count; c++)
        sink->columns[c].field = sink->output->shown.field;
    return bead_table_choose_times(sink, extremes_field(sink)->title, msg);
}

static void extremes_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(sink->output->shown.field);
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

static void extremes_header(struct bead_sink *sink)
{
    const struct bead_field_info *field = extremes_field(sink);
    bead_table_begin_header(sink, true);
    fprintf(sink->file, "largest%s%s,%s%s%s\n", *field->unit ? "_" : "", field->unit, field->of_contacts ? "contact" : "bead",
            sink->context.difference ? ",part_of_largest" : "", bead_table_is_judged(sink) ? ",uncertainty" : "");
}

static size_t furthest(const double *values, size_t count)
{
    size_t at = 0;
    for (size_t i = 1; i < count; i++)
        at = fabs(values[i]) > fabs(values[at]) ? i : at;
    return at;
}

static enum bead_error extremes_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    const enum bead_field field = sink->output->shown.field;
    const double *values = sample->field[field], *first = sample->comparison[field];
    const size_t beads = bead_chain_beads(sink->context.chains[sample->chain]);
    const size_t count = sample->active < beads ? sample->active : beads, at = furthest(values, count);
    sink->columns[sample->chain].value = fabs(values[at]);
    bead_table_compare(sink, sample);
    if (!sink->file)
        return BEAD_OK;
    bead_table_chain_name(sink, sample->chain);
    bead_write_number(sink->file, sample->time);
    bead_table_numbers(sink->file, 1, &values[at]);
    fprintf(sink->file, ",%zu", at);
    if (sink->context.difference && first) {
        double *largest = &sink->largest[sample->chain];
        *largest = fmax(*largest, fabs(first[furthest(first, count)]));
        const double part = *largest > 0 ? fabs(values[at]) / *largest : fabs(values[at]) > 0 ? INFINITY : 0;
        bead_table_numbers(sink->file, 1, &part);
    }
    if (bead_table_is_judged(sink))
        bead_table_uncertainties(sink->file, 1, &sink->columns[sample->chain].uncertainty);
    bead_table_end_row(sink);
    return BEAD_OK;
}

const struct table bead_table_extremes = {.why = "the largest value of a field over time, and where it is",
                                          .prepare = extremes_prepare,
                                          .needs = extremes_needs,
                                          .header = extremes_header,
                                          .checked = true,
                                          .of_fields = true,
                                          .sample = extremes_sample};
