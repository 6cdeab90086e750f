/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the peaks of contacts or beads: a row for each, at the end of the run. */
#include <math.h>

#include "sim/chain/validity.h"
#include "sim/kinds/scene_facts.h"
#include "sim/measure/places.h"
#include "sim/measure/sink_grid.h"
#include "sim/output/table.h"

static void peaks_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->contact_peaks = sink->output->curves.show == BEAD_SHOW_PEAKS;
    needs->bead_peaks = sink->output->curves.show == BEAD_SHOW_BEAD_PEAKS;
    needs->uncertainty = sink->output->curves.uncertainty;
    needs->deviation = bead_scene_tolerances(sink->context.scene);
    const struct bead_listed *listed = needs->contact_peaks ? &sink->output->curves.contacts : &sink->output->curves.beads;
    needs->beads = (struct bead_span){listed->count > 0 ? SIZE_MAX : 0, SIZE_MAX};
    for (size_t i = 0; i < listed->count; i++)
        needs->beads.first = listed->all[i] < needs->beads.first ? listed->all[i] : needs->beads.first;
}

static void peaks_header(struct bead_sink *sink)
{
    bead_table_begin_header(sink, false);
    fprintf(sink->file, "%s,peak_force_N,time_s,state%s%s%s\n", sink->output->curves.show == BEAD_SHOW_PEAKS ? "contact" : "bead",
            sink->output->curves.uncertainty ? ",uncertainty_N" : "",
            bead_scene_tolerances(sink->context.scene) ? ",deviation_N" : "",
            sink->output->curves.uncertainty ? ",time_s_uncertainty" : "");
}

/* The peaks of a chain, their uncertainties and deviations; NULL: unknown, or not asked for. */
struct listed {
    const struct bead_peak *peaks;
    const double *uncertainty, *time_uncertainty, *deviation;
    const bool *rivalled;
};

static void write_uncertainty(const struct bead_sink *sink, const double *numbers, size_t index)
{
    const double unknown = NAN;
    if (sink->output->curves.uncertainty)
        bead_table_uncertainties(sink->file, 1, numbers ? &numbers[index] : &unknown);
}

static void write_deviation(const struct bead_sink *sink, const double *numbers, size_t index)
{
    const double unknown = NAN;
    if (bead_scene_tolerances(sink->context.scene))
        bead_table_numbers(sink->file, 1, numbers ? &numbers[index] : &unknown);
}

/* Is a contact, or one of the two of a bead, beyond the limits of the model? */
static bool is_beyond(const struct bead_sink *sink, const struct bead_chain *chain, const struct bead_outcome *o, size_t index)
{
    bool beyond = false;
    size_t k = sink->output->curves.show == BEAD_SHOW_PEAKS || index == 0 ? index : index - 1;
    for (; o->contact_peaks && k <= index && k < bead_chain_contacts(chain); k++)
        beyond = beyond || bead_validity_beyond(chain, k, o->contact_peaks[k].value);
    return beyond;
}

static void write_peak(const struct bead_sink *sink, const struct listed *listed, size_t index, bool beyond)
{
    const struct bead_peak *peak = &listed->peaks[index];
    const struct {
        bool holds;
        const char *word;
    } states[] = {{peak->open, "open"},
                  {peak->exceeded && !peak->open, "exceeded"},
                  {peak->unpredictable, "unpredictable"},
                  {listed->rivalled && listed->rivalled[index], "rival"},
                  {beyond, "invalid"}};
    fprintf(sink->file, "%zu", index);
    bead_table_numbers(sink->file, 2, (const double[]){peak->value, peak->time});
    fputc(',', sink->file);
    for (size_t i = 0, used = 0; i < sizeof states / sizeof *states; i++) {
        if (states[i].holds)
            fprintf(sink->file, "%s%s", used++ > 0 ? " " : "", states[i].word);
    }
    write_uncertainty(sink, listed->uncertainty, index);
    write_deviation(sink, listed->deviation, index);
    write_uncertainty(sink, listed->time_uncertainty, index);
    fputc('\n', sink->file);
}

static void peaks_end(struct bead_sink *sink, const struct bead_outcome *outcomes)
{
    const bool contacts = sink->output->curves.show == BEAD_SHOW_PEAKS;
    for (size_t c = 0; outcomes && c < sink->context.chain_count; c++) {
        const struct bead_chain *chain = sink->context.chains[c];
        const struct bead_outcome *o = &outcomes[c];
        const struct listed listed = contacts
                                         ? (struct listed){o->contact_peaks, o->contact_uncertainty, o->contact_time_uncertainty,
                                                           o->contact_deviation, o->contact_rivalled}
                                         : (struct listed){o->bead_peaks, o->bead_uncertainty, o->bead_time_uncertainty,
                                                           o->bead_deviation, o->bead_rivalled};
        size_t first = sink->output->shown.beads.first;
        size_t count = bead_span_rows(&sink->output->shown.beads, contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain));
        for (size_t i = first; listed.peaks && i < first + count; i++) {
            if (!bead_is_listed(contacts ? &sink->output->curves.contacts : &sink->output->curves.beads, i))
                continue;
            bead_table_chain_name(sink, c);
            write_peak(sink, &listed, i, is_beyond(sink, chain, o, i));
            sink->rows++;
        }
    }
}

const struct table bead_table_contact_peaks = {
    .why = "largest force of every contact", .needs = peaks_needs, .header = peaks_header, .end = peaks_end};
const struct table bead_table_bead_peaks = {
    .why = "largest force of every bead", .needs = peaks_needs, .header = peaks_header, .end = peaks_end};
