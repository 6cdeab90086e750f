/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spreading: second moment, participation and front over time, and the exponents of the window that ends there. The last
 * row has those of the whole run. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/output/spreading.h"
#include "sim/output/table.h"

static enum bead_error spreading_prepare(struct bead_sink *sink, struct bead_message *msg)
{
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

static void spreading_header(struct bead_sink *sink)
{
    if (sink->context.chain_count > 1)
        fputs("chain,", sink->file);
    bead_table_time_header(sink);
    fputs(",second_moment,participation,front,gamma,gamma_error,eta,eta_error\n", sink->file);
}

static enum bead_error spreading_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    enum { EXPONENTS = 4 };
    struct bead_spreading *s = &sink->spreading[sample->chain];
    double numbers[BEAD_SPREADING_NUMBERS + EXPONENTS];
    const size_t before = s->count;
    bead_spreading_feed(s, sample, bead_chain_beads(sink->context.chains[sample->chain]), numbers);
    for (int i = 0; i < EXPONENTS / 2; i++) {
        const struct bead_exponent e = s->count > before ? bead_spreading_exponent(s, i) : (struct bead_exponent){NAN, NAN, NAN};
        numbers[BEAD_SPREADING_NUMBERS + 2 * i] = e.slope;
        numbers[BEAD_SPREADING_NUMBERS + 2 * i + 1] = e.error;
    }
    bead_table_chain_name(sink, sample->chain);
    bead_write_number(sink->file, sample->time);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        fputc(',', sink->file);
        if (isfinite(numbers[i]))
            bead_write_number(sink->file, numbers[i]);
    }
    bead_table_end_row(sink);
    return BEAD_OK;
}

const struct table bead_table_spreading = {.why = "how far energy has spread",
                                           .prepare = spreading_prepare,
                                           .needs = spreading_needs,
                                           .begin = spreading_begin,
                                           .header = spreading_header,
                                           .sample = spreading_sample};
