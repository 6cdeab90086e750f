/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of a stored run, computed from its samples, for --info. */
#include "sim/cli/command_line.h"

#include <math.h>
#include <stdlib.h>

#include "beadreel/measure.h"

enum { MOST_MEASURES = 128 };
/* Files with more values than this are not read through for --info. */
static const double most_values = 5e7;

static enum bead_error feed(struct bead_trajectory *trajectory, size_t chain, size_t samples, struct bead_measures *measures,
                            struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < samples; i++) {
        struct bead_sample sample = {.chain = chain, .index = i};
        err = bead_trajectory_read(trajectory, i, chain, BEAD_MEASURE_FIELDS, &sample, msg);
        if (!err)
            err = bead_measures_feed(measures, &sample, msg);
    }
    return err;
}

static void print(FILE *out, size_t chain, const struct bead_measure *found, size_t count)
{
    char text[48];
    fprintf(out, "measures of chain %zu, from these samples:\n", chain);
    for (size_t i = 0; i < count && i < MOST_MEASURES; i++) {
        bool prefixed = found[i].unit[0] && !found[i].unit[1] && found[i].unit[0] != '1'; /* s, m, N, J */
        const char *note = found[i].note;
        if (isnan(found[i].value))
            fprintf(out, "  %-27s %s\n", found[i].name, note);
        else if (prefixed)
            fprintf(out, "  %-27s %s%s%s\n", found[i].name, command_quantity(found[i].value, found[i].unit, text, sizeof text),
                    *note ? ", " : "", note);
        else
            fprintf(out, "  %-27s %.6g%s%s%s%s\n", found[i].name, found[i].value, *found[i].unit ? " " : "", found[i].unit,
                    *note ? ", " : "", note);
    }
}

enum bead_error command_measures(FILE *out, struct bead_trajectory *trajectory, size_t chain, const struct bead_outcome *outcome,
                                 struct bead_message *msg)
{
    size_t chains, samples = bead_grid_count(bead_trajectory_grid(trajectory));
    const struct bead_chain *of = bead_trajectory_chains(trajectory, &chains)[chain];
    struct bead_span beads = bead_trajectory_beads(trajectory);
    struct bead_measure found[MOST_MEASURES];
    struct bead_measures *measures = NULL;
    bool there = (bead_trajectory_fields(trajectory) & BEAD_MEASURE_FIELDS) == BEAD_MEASURE_FIELDS && beads.first == 0 &&
                 beads.last >= bead_chain_beads(of) - 1;
    if (!there || bead_chain_spec(of)->equation.name || (double)samples * (double)bead_chain_beads(of) > most_values)
        return BEAD_OK;
    enum bead_error err = bead_measures_create(of, &measures, msg);
    if (!err)
        err = feed(trajectory, chain, samples, measures, msg);
    if (!err)
        print(out, chain, found, bead_measures_read(measures, outcome, found, MOST_MEASURES));
    bead_measures_destroy(measures);
    return err;
}
