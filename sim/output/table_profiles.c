/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of profiles: a row for each time and place. */
#include "sim/base/number.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/output/profile_times.h"
#include "sim/output/table.h"

static enum bead_error profiles_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    enum bead_error err = bead_profile_times_create(sink->output, &sink->context, &sink->moments, msg);
    if (!err)
        snprintf(sink->why, sizeof sink->why, "%s", bead_profile_times_needs(sink->moments).why);
    return err;
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
    fputs(sink->context.chain_count > 1 ? "chain," : "", sink->file);
    bead_table_time_header(sink);
    fprintf(sink->file, ",%s,%s%s%s\n", bead_chain_axis(chain, field->of_contacts).title, column, *field->unit ? "_" : "",
            field->unit);
}

static enum bead_error profiles_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_profile_times_feed(sink->moments, sample, msg);
}

static void profiles_end(struct bead_sink *sink, const struct bead_outcome *)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        const double *places = bead_profile_times_places(sink->moments, c);
        for (size_t m = 0; m < sink->output->curves.profile_time_count; m++) {
            const double *values = bead_profile_times_profile(sink->moments, c, m);
            for (size_t i = 0; i < bead_profile_times_values(sink->moments, c); i++) {
                bead_table_chain_name(sink, c);
                bead_write_number(sink->file, sink->output->curves.profile_times[m]);
                bead_table_numbers(sink->file, 2, (const double[]){places[i], values[i]});
                bead_table_end_row(sink);
            }
        }
    }
}

const struct table bead_table_profiles = {.why = "a field at some times",
                                          .prepare = profiles_prepare,
                                          .needs = profiles_needs,
                                          .header = profiles_header,
                                          .sample = profiles_sample,
                                          .end = profiles_end};
