/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spreading: second moment, participation and front over time, and the exponents of the window that ends there. The last
 * row has those of the whole run. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/measure/spreading.h"
#include "sim/output/table.h"

enum { EXPONENTS = 2, NUMBERS = BEAD_SPREADING_NUMBERS + EXPONENTS };

static enum bead_error spreading_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    for (size_t i = 0; i < sink->context.chain_count * NUMBERS; i++)
        BEAD_TRY(bead_table_add_column(sink, i / NUMBERS, 0, "", msg));
    return bead_table_choose_times(sink, "the energy of every bead", msg);
}

static enum bead_error spreading_begin(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&sink->spreading, sink->context.chain_count, msg, "a table"));
    for (size_t c = 0; c < sink->context.chain_count; c++)
        BEAD_TRY(bead_spreading_begin(&sink->spreading[c], sink->context.chains[c], bead_grid_count(&sink->grid), msg));
    return BEAD_OK;
}

void bead_table_spreading_free(struct bead_sink *sink)
{
    for (size_t c = 0; sink->spreading && c < sink->context.chain_count; c++)
        bead_spreading_free(&sink->spreading[c]);
    free(sink->spreading);
}

static void spreading_needs(const struct bead_sink *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_ENERGY);
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

/* Numbers that are not known yet are left out. */
static void write_row(struct bead_sink *sink, const struct bead_sample *sample, const double errors[EXPONENTS])
{
    const struct column *columns = &sink->columns[sample->chain * NUMBERS];
    bead_table_chain_name(sink, sample->chain);
    bead_write_number(sink->file, sample->time);
    for (size_t i = 0; i < NUMBERS; i++) {
        bead_table_known(sink->file, columns[i].value);
        if (i >= BEAD_SPREADING_NUMBERS)
            bead_table_known(sink->file, errors[i - BEAD_SPREADING_NUMBERS]);
    }
    for (size_t i = 0; bead_table_is_judged(sink) && i < NUMBERS; i++)
        bead_table_known_uncertainty(sink->file, columns[i].uncertainty);
    bead_table_end_row(sink);
}

static enum bead_error spreading_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    struct bead_spreading *s = &sink->spreading[sample->chain];
    struct column *columns = &sink->columns[sample->chain * NUMBERS];
    double numbers[NUMBERS], errors[EXPONENTS];
    const size_t before = s->count;
    bead_spreading_feed(s, sample, numbers);
    for (int i = 0; i < EXPONENTS; i++) {
        const struct bead_line e = s->count > before ? bead_spreading_exponent(s, i) : bead_line_of(NULL, NULL, 0);
        numbers[BEAD_SPREADING_NUMBERS + i] = e.slope;
        errors[i] = e.error;
    }
    for (size_t i = 0; i < NUMBERS; i++)
        columns[i].value = numbers[i];
    bead_table_compare(sink, sample);
    if (sink->file) /* the check run has none */
        write_row(sink, sample, errors);
    return BEAD_OK;
}

const struct table bead_table_spreading = {.why = "how far energy has spread",
                                           .prepare = spreading_prepare,
                                           .needs = spreading_needs,
                                           .begin = spreading_begin,
                                           .columns = "second_moment,participation,front,gamma,gamma_error,eta,eta_error",
                                           .uncertainties =
                                               ",second_moment_uncertainty,participation_uncertainty,front_uncertainty,"
                                               "gamma_uncertainty,eta_uncertainty",
                                           .of_times = true,
                                           .checked = true,
                                           .sample = spreading_sample};
