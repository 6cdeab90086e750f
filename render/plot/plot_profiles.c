/* A field along the chain at several times: a panel for each chain. */
#include <math.h>
#include <stdio.h>

#include "beadreel/look.h"
#include "beadreel/profile_times.h"
#include "render/draw/quantity.h"
#include "render/plot/plot_private.h"

/* As many digits as the time needs, at most five. */
static void plot_profiles_time_words(double time, const char *unit, char *text, size_t size)
{
    double shown = time / bead_power_of_ten(bead_prefix_exponent(time, unit));
    int digits = 1;
    while (digits < 5 && shown != 0) {
        double part = bead_power_of_ten(digits - 1 - (int)floor(log10(fabs(shown))));
        if (fabs(round(shown * part) / part - shown) < 1e-7 * fabs(shown))
            break;
        digits++;
    }
    int whole = shown >= 1 ? (int)floor(log10(shown)) + 1 : 1; /* 500, not 5e2 */
    bead_quantity(time, unit, digits > whole ? digits : whole, text, size);
}

static void plot_profiles_make_axes(struct bead_plot_data *data)
{
    const struct bead_output *output = data->output;
    for (size_t p = 0; p < data->count; p++) {
        const size_t c = data->parts[p].chain;
        const struct bead_field_info *field = bead_chain_field(data->context.chains[c], output->shown.field);
        const struct bead_chain_axis along = bead_chain_axis(data->context.chains[c], field->of_contacts);
        const double *places = bead_profile_times_places(data->moments, c);
        data->panels[p].x = (struct bead_graph_axis){
            along.title, along.unit, places[0], places[bead_profile_times_values(data->moments, c) - 1], BEAD_SCALE_LINEAR, false};
        data->panels[p].y = (struct bead_graph_axis){field->title,          field->unit,       output->plot.range[0],
                                                     output->plot.range[1], BEAD_SCALE_LINEAR, true};
    }
}

static enum bead_error plot_profiles_create(struct bead_plot_data *data, struct bead_message *msg)
{
    char time[48];
    enum bead_error err = bead_profile_times_create(data->output, &data->context, &data->moments, msg);
    if (!err)
        err = plot_reserve_chains(data, data->output->curves.profile_time_count, msg);
    for (size_t m = 0; !err && m < data->output->curves.profile_time_count; m++) {
        plot_profiles_time_words(data->output->curves.profile_times[m], bead_chain_time_unit(data->context.chains[0]), time,
                                 sizeof time);
        snprintf(data->parts[0].labels[m], sizeof *data->parts[0].labels, "*t* = %s", time);
    }
    if (!err)
        plot_profiles_make_axes(data);
    return err;
}

static void plot_profiles_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    *needs = bead_profile_times_needs(data->moments);
}

static enum bead_error plot_profiles_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_profile_times_feed(data->moments, sample, msg);
}

static enum bead_error plot_profiles_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes,
                                            struct bead_message *msg)
{
    (void)outcomes, (void)msg;
    const struct bead_output *output = data->output;
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        const double *places = bead_profile_times_places(data->moments, part->chain);
        size_t count = bead_profile_times_values(data->moments, part->chain);
        for (size_t m = 0; m < output->curves.profile_time_count; m++)
            part->series[m] = (struct bead_series){.x = places,
                                                   .y = bead_profile_times_profile(data->moments, part->chain, m),
                                                   .count = count,
                                                   .mark = BEAD_MARK_LINE,
                                                   .colour = m,
                                                   .label = p == 0 ? part->labels[m] : NULL};
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_profiles = {
    BEAD_SHOW_PROFILES, false, true, plot_profiles_create, plot_profiles_needs, plot_profiles_feed, plot_profiles_finish};
