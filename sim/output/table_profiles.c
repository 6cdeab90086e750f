/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of profiles: a row for each time and place. */
#include <math.h>

#include "sim/base/number.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/measure/profile_times.h"
#include "sim/output/table.h"

static enum bead_error profiles_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_TRY(bead_profile_times_create(sink->output, &sink->context, &sink->moments, msg));
    snprintf(sink->why, sizeof sink->why, "%s", bead_profile_times_needs(sink->moments).why);
    return BEAD_OK;
}

static void profiles_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = bead_profile_times_needs(sink->moments);
}

static void profiles_header(struct bead_sink *sink)
{
    const struct bead_chain *chain = sink->context.chains[0];
    const struct bead_field_info *field = bead_chain_field(chain, sink->output->shown.field);
    const char *column = bead_chain_spec(chain)->system->names_fields ? field->title : field->name;
    bead_table_begin_header(sink, true);
    fprintf(sink->file, "%s,%s%s%s%s\n", bead_chain_axis(chain, field->of_contacts).title, column, *field->unit ? "_" : "",
            field->unit, bead_table_is_judged(sink) ? ",uncertainty" : "");
}

static enum bead_error profiles_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_profile_times_feed(sink->moments, sample, msg);
}

/* The uncertainty is the largest of all moments so far: *worst. */
static void write_profile(struct bead_sink *sink, size_t chain, size_t moment, double *worst)
{
    const double *places = bead_profile_times_places(sink->moments, chain);
    const double *values = bead_profile_times_profile(sink->moments, chain, moment);
    const double *checks = sink->check ? bead_profile_times_profile(sink->check->moments, chain, moment) : NULL;
    const size_t count = bead_profile_times_values(sink->moments, chain);
    if (checks)
        *worst = fmax(*worst, bead_table_worst(sink, values, checks, count));
    else /* a trajectory knows nothing between its samples */
        *worst = sink->bounds && bead_profile_times_are_samples(sink->moments)
                     ? bead_table_bound(sink, chain, sink->output->shown.field)
                     : NAN;
    for (size_t i = 0; i < count; i++) {
        bead_table_chain_name(sink, chain);
        bead_write_number(sink->file, sink->output->curves.profile_times[moment]);
        bead_table_numbers(sink->file, 2, (const double[]){places[i], values[i]});
        if (bead_table_is_judged(sink))
            bead_table_uncertainties(sink->file, 1, (const double[]){checks && sink->unknown ? NAN : *worst});
        bead_table_end_row(sink);
    }
}

static void profiles_end(struct bead_sink *sink, const struct bead_outcome *)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        double worst = 0;
        for (size_t m = 0; m < sink->output->curves.profile_time_count; m++)
            write_profile(sink, c, m, &worst);
    }
}

const struct table bead_table_profiles = {.why = "a field at some times",
                                          .prepare = profiles_prepare,
                                          .needs = profiles_needs,
                                          .header = profiles_header,
                                          .sample = profiles_sample,
                                          .checked = true,
                                          .of_fields = true,
                                          .end = profiles_end};
