/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force at sensors against time: a panel for each chain with sensors, all with one axis of forces. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/picture_times.h"
#include "render/plot/plot_private.h"
#include "render/view/horizon.h"
#include "sim/measure/places.h"

/* Number of times that a plot can distinguish. */
static const double moments = 2000;

/* The first chain's field: all chains of a scene are of one kind. Plots of only contacts have the contacts' field. */
static const struct bead_field_info *plot_sensors_field_of(const struct bead_plot_data *data)
{
    const struct bead_chain *chain = data->context.chains[data->parts[0].chain];
    const enum bead_field field = bead_place_shown(data->output, chain, 0).field;
    const struct bead_field_info *own = bead_chain_field(chain, field);
    return own ? own : bead_field_info(field);
}

/* The name of the first place of all chains, if they have one. */
static bool first_name(const struct bead_plot_data *data, char *name, size_t size)
{
    bool same = true;
    for (size_t p = 0; p < data->count; p++) {
        const struct bead_place_shown first = bead_place_shown(data->output, data->context.chains[data->parts[p].chain], 0);
        same = same && (p == 0 || strcmp(first.name, name) == 0);
        if (p == 0)
            snprintf(name, size, "%s", first.name);
    }
    return same;
}

/* All figures name normalised forces in the same way. */
static void name_axis(struct bead_plot_data *data)
{
    const struct bead_curves_asked *curves = &data->output->curves;
    const bool mixed = curves->beads.all && curves->contacts.all;
    const char *title = mixed ? "force" : plot_sensors_field_of(data)->title;
    const char *sign = plot_sensors_field_of(data)->unit[0] == 'N' ? "F" : "y";
    char quoted[300] = "first sensor", first[128];
    if (first_name(data, first, sizeof first))
        bead_markup_quote(first, quoted, sizeof quoted);
    if (data->output->plot.normalise == BEAD_NORMALISE_NONE)
        snprintf(data->axis_title, sizeof data->axis_title, "%s", title);
    else if (data->output->plot.normalise == BEAD_NORMALISE_MAX)
        snprintf(data->axis_title, sizeof data->axis_title, "%s *%s*/\u2060*%s*_{max}", title, sign, sign);
    else
        snprintf(data->axis_title, sizeof data->axis_title, "%s *%s*/\u2060*%s*_{max}(%s)", title, sign, sign, quoted);
}

static void plot_sensors_make_axes(struct bead_plot_data *data)
{
    const double *range = data->output->plot.range;
    const char *unit = data->output->plot.normalise == BEAD_NORMALISE_NONE ? plot_sensors_field_of(data)->unit : "";
    for (size_t p = 0; p < data->count; p++) {
        const struct plot_panel *part = &data->parts[p];
        const char *seconds = bead_chain_time_unit(data->context.chains[part->chain]);
        data->panels[p].x = (struct bead_graph_axis){"time", seconds, data->time[0], data->time[1], BEAD_SCALE_LINEAR, false};
        data->panels[p].y = (struct bead_graph_axis){data->axis_title, unit, range[0], range[1], BEAD_SCALE_LINEAR, true};
        plot_heading(data, part->chain, data->parts[p].title, sizeof part->title);
        if (!data->residuals)
            continue;
        struct bead_panel *below = &data->panels[data->count + p];
        below->x = data->panels[p].x;
        below->y = (struct bead_graph_axis){"residual", unit, NAN, NAN, BEAD_SCALE_LINEAR, false};
    }
}

static enum bead_error plot_sensors_create(struct bead_plot_data *data, struct bead_message *msg)
{
    const struct bead_output *output = data->output;
    size_t most = 0;
    BEAD_TRY(bead_picture_times(output, &data->context, data->time, msg));
    BEAD_TRY(plot_reserve(data, 2 * data->context.chain_count, msg));
    for (size_t c = 0; c < data->context.chain_count; c++) {
        const size_t sensors = bead_places_count(output, data->context.chains[c]);
        if (!plot_shows(data, c))
            continue;
        struct plot_panel *part = &data->parts[data->count++];
        part->chain = c;
        part->recorded.curves = sensors;
        bead_curves_init(&part->curves, sensors, data->time);
        bead_curves_init(&part->differences, sensors, data->time);
        most = sensors > most ? sensors : most;
    }
    BEAD_TRY(plot_new(&data->store, &data->sample, most, msg));
    if (data->count == 0)
        return BEAD_OK;
    data->residuals = data->apart[1] = output->curves.measured_count > 0;
    data->grid = bead_picture_grid(&data->context, &output->shown, data->time, moments);
    name_axis(data);
    plot_sensors_make_axes(data);
    snprintf(data->why, sizeof data->why, "curves of sensors");
    return BEAD_OK;
}

static void plot_sensors_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    needs->beads = (struct bead_span){SIZE_MAX, 0};
    for (size_t p = 0; p < data->count; p++)
        bead_places_need(data->output, data->context.chains[data->parts[p].chain], needs);
    needs->comparison = data->output->shown.trust ? needs->fields : 0;
}

static enum bead_error plot_sensors_add(struct bead_plot_data *data, struct plot_panel *part, const struct bead_sample *sample,
                                        bool difference, struct bead_message *msg)
{
    struct bead_curves *curves = difference ? &part->differences : &part->curves;
    for (size_t k = 0; k < curves->curves; k++) {
        const struct bead_place_shown place = bead_place_shown(data->output, data->context.chains[part->chain], k);
        const double *value = sample->field[place.field], *comparison = sample->comparison[place.field];
        if (!value || (difference && !comparison))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s%s", bead_field_info(place.field)->name,
                             difference ? " of a comparison run" : "");
        data->sample[k] = value[place.index] - (difference ? comparison[place.index] : 0);
    }
    if (data->residuals && !difference)
        BEAD_TRY(bead_recorded_add(&part->recorded, sample->time, data->sample, msg));
    BEAD_TRY(bead_curves_reserve(curves, msg));
    bead_curves_add(curves, sample->time, data->sample);
    return BEAD_OK;
}

static enum bead_error plot_sensors_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    for (size_t p = 0; p < data->count; p++) {
        if (data->parts[p].chain != sample->chain)
            continue;
        BEAD_TRY(plot_sensors_add(data, &data->parts[p], sample, false, msg));
        if (data->output->shown.trust)
            BEAD_TRY(plot_sensors_add(data, &data->parts[p], sample, true, msg));
    }
    return BEAD_OK;
}

/* ---- the end ---- */

static double peak_of(const struct bead_curves *curves, size_t k)
{
    double peak = 0;
    for (size_t s = 0; s < curves->count; s++)
        peak = fmax(peak, curves->stretch[s * curves->curves + k].high.value);
    return peak;
}

/* The factor that normalises sensor `k`; NaN: its reference force is 0. */
static double plot_sensors_factor_of(const struct bead_plot_data *data, const struct plot_panel *part, size_t k)
{
    if (data->output->plot.normalise == BEAD_NORMALISE_NONE)
        return 1;
    double peak = peak_of(&part->curves, data->output->plot.normalise == BEAD_NORMALISE_FIRST ? 0 : k);
    return peak > 0 ? 1 / peak : NAN;
}

static enum bead_error plot_sensors_fill(struct bead_plot_data *data, size_t p, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    const struct bead_curves *curves = &part->curves;
    const size_t sensors = curves->curves, measured = plot_measured_count(data, part);
    size_t room = 8 * curves->count * sensors;
    for (size_t k = 0; k < measured; k++)
        room += 8 * data->output->curves.measured[k].count;
    BEAD_TRY(plot_reserve_series(data, p, sensors + measured, room, msg));
    for (size_t k = 0; k < sensors; k++) {
        bead_markup_quote(bead_place_shown(data->output, data->context.chains[part->chain], k).name, part->labels[k],
                          sizeof part->labels[k]);
        plot_add_curve(part, plot_line(NULL, NULL, 0, part->labels[k], k), curves, k, plot_sensors_factor_of(data, part, k));
    }
    return data->residuals ? plot_measured_add(data, p, msg) : BEAD_OK;
}

static double axis_length(const struct bead_plot_data *data)
{
    double range[2] = {0, 0};
    for (size_t p = 0; p < data->count; p++) {
        const struct plot_panel *part = &data->parts[p];
        for (size_t k = 0; k < part->curves.curves; k++) {
            for (size_t i = 0; i < part->series[k].count; i++) {
                range[0] = fmin(range[0], part->series[k].y[i]);
                range[1] = fmax(range[1], part->series[k].y[i]);
            }
        }
    }
    for (int i = 0; i < 2; i++)
        range[i] = isnan(data->output->plot.range[i]) ? range[i] : data->output->plot.range[i];
    return range[1] - range[0];
}

/* The first time at which a curve differs from its comparison run by more than one hundredth of the axis. */
static double horizon_of(const struct bead_plot_data *data, const struct plot_panel *part, double threshold)
{
    const struct bead_curves *curves = &part->differences;
    for (size_t s = 0; s < curves->count; s++) {
        for (size_t k = 0; k < curves->curves; k++) {
            const struct bead_stretch *stretch = &curves->stretch[s * curves->curves + k];
            if (plot_sensors_factor_of(data, part, k) * fmax(-stretch->low.value, stretch->high.value) > threshold)
                return stretch->first.time;
        }
    }
    return INFINITY;
}

static void tell_trust(struct bead_plot_data *data)
{
    double threshold = BEAD_HORIZON_PART * axis_length(data);
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        struct bead_trust trust = bead_trust_make(data->context.chains[part->chain], data->context.tolerance_factor);
        trust.from = data->time[0];
        trust.until = horizon_of(data, part, threshold);
        part->ruler = (struct bead_ruler){.vertical = true, .value = trust.until, .low = NAN, .high = NAN};
        if (*part->title)
            strncat(part->title, "; ", sizeof part->title - strlen(part->title) - 1);
        size_t used = strlen(part->title);
        bead_trust_say(&trust, 0, part->title + used, sizeof part->title - used);
        data->panels[p].rulers = &part->ruler;
        data->panels[p].ruler_count = isfinite(trust.until) ? 1 : 0;
    }
}

static enum bead_error plot_sensors_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    for (size_t p = 0; p < data->count; p++)
        BEAD_TRY(plot_sensors_fill(data, p, msg));
    if (data->output->shown.trust)
        tell_trust(data);
    return BEAD_OK;
}

const struct plot_kind bead_plot_sensors = {BEAD_SHOW_SENSORS, plot_sensors_create, plot_sensors_needs, plot_sensors_feed,
                                            plot_sensors_finish};
