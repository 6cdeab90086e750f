/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of fits: the values found before the run. */
#include "sim/output/table.h"

static void fit_header(struct bead_sink *sink)
{
    fputs("key,unit,value,standard_error,first,points,rms\n", sink->file);
}

static void fit_end(struct bead_sink *sink, const struct bead_outcome *)
{
    const struct bead_fit *fit = &sink->context.scene->fit;
    for (size_t i = 0; i < fit->count; i++) {
        const struct bead_fit_key *key = &fit->keys[i];
        fprintf(sink->file, "%s,%s", key->path, key->unit);
        bead_table_numbers(sink->file, 5, (const double[]){key->value, key->error, key->first, (double)fit->points, fit->rms});
        bead_table_end_row(sink);
    }
}

const struct table bead_table_fit = {.why = "what the fit has found", .header = fit_header, .end = fit_end};
