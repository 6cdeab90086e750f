/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of small vibrations: the bands and gaps of each cell that a chain repeats, and the modes of the chain. They need no run.
 */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/frequency/bands.h"
#include "sim/output/table.h"

static void write_range(struct bead_sink *sink, size_t chain, const struct bead_medium *medium, const char *kind, size_t number,
                        const double ends[2])
{
    bead_table_chain_name(sink, chain);
    fprintf(sink->file, "%zu,%zu,%s,%zu", medium->first, medium->last, kind, number);
    bead_table_numbers(sink->file, 2, ends);
    bead_table_end_row(sink);
}

static void write_medium(struct bead_sink *sink, size_t chain, const struct bead_medium *medium)
{
    double ends[2];
    size_t gaps = 0;
    for (size_t i = 0; i < medium->cell.count; i++) {
        bead_band(medium, i, ends);
        write_range(sink, chain, medium, "band", i + 1, ends);
        if (bead_gap(medium, i, ends))
            write_range(sink, chain, medium, "gap", ++gaps, ends);
    }
}

static enum bead_error bands_finish(struct bead_sink *sink, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t c = 0; c < sink->context.chain_count && !err; c++) {
        struct bead_medium *media = NULL;
        size_t count = 0;
        err = bead_media_find(sink->context.chains[c], &media, &count, msg);
        for (size_t i = 0; i < count && !err; i++)
            write_medium(sink, c, &media[i]);
        bead_media_free(media, count);
    }
    return err;
}

const struct table bead_table_bands = {
    .why = "bands of each cell", .columns = "first_bead,last_bead,kind,number,low_Hz,high_Hz", .finish = bands_finish};

static enum bead_error eigenmodes_finish(struct bead_sink *sink, struct bead_message *msg)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        BEAD_FREED struct bead_mode *modes = NULL;
        BEAD_TRY(bead_modes_find(sink->context.chains[c], &modes, msg));
        for (size_t i = 0; i < bead_chain_beads(sink->context.chains[c]); i++, sink->rows++) {
            bead_table_chain_name(sink, c);
            fprintf(sink->file, "%zu", i + 1);
            bead_table_numbers(sink->file, 4,
                               (const double[]){modes[i].frequency, modes[i].participation, modes[i].length, modes[i].centre});
            fputc('\n', sink->file);
        }
    }
    return BEAD_OK;
}

const struct table bead_table_eigenmodes = {.why = "modes of each chain",
                                            .columns = "mode,frequency_Hz,participation,localisation_length,centre",
                                            .finish = eigenmodes_finish};
