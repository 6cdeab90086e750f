/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured data beside the curves of sensors, and the differences in a panel below. */
#include <math.h>

#include "render/plot/plot_private.h"

static size_t count_of(const struct bead_plot_data *data, const struct plot_panel *part)
{
    const size_t given = data->output->curves.measured_count;
    return given < part->curves.curves ? given : part->curves.curves;
}

/* The number of measured curves beside a panel's: with an overlay, beside the first chain's. */
size_t plot_measured_count(const struct bead_plot_data *data, const struct plot_panel *part)
{
    return data->output->curves.overlay && part != data->parts ? 0 : count_of(data, part);
}

/* A curve with no more points than are visible: the measured values at place `k`, or their differences from the computed ones. */
static enum bead_error reduce(const struct bead_plot_data *data, const struct plot_panel *part, size_t k, bool difference,
                              struct bead_curves *curves, struct bead_message *msg)
{
    const struct bead_measured *measured = &data->output->curves.measured[k];
    bead_curves_init(curves, 1, data->time);
    for (size_t i = 0; i < measured->count; i++) {
        const struct bead_wave_point *p = &measured->points[i];
        const double value = p->value - (difference ? bead_recorded_at(&part->recorded, k, p->time) : 0);
        if (p->time < data->time[0] || p->time > data->time[1])
            continue;
        BEAD_TRY(bead_curves_reserve(curves, msg));
        bead_curves_add(curves, p->time, &value);
    }
    return BEAD_OK;
}

/* Adds it to panel `into`: differences to another one than `part`. */
static enum bead_error add(const struct bead_plot_data *data, const struct plot_panel *part, size_t k, struct bead_series series,
                           struct plot_panel *into, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_curves_free) struct bead_curves curves;
    BEAD_TRY(reduce(data, part, k, part != into, &curves, msg));
    plot_add_curve(into, series, &curves, 0, 1);
    return BEAD_OK;
}

/* Adds them to panel `p`, and their differences from the computed ones to the panel below. Errors: MEMORY. */
enum bead_error plot_measured_add(struct bead_plot_data *data, size_t p, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p], *below = &data->parts[data->count + p];
    const size_t count = count_of(data, part), sensors = part->curves.curves;
    size_t room = 0;
    for (size_t k = 0; k < count; k++)
        room += 8 * data->output->curves.measured[k].count;
    BEAD_TRY(plot_reserve_series(data, data->count + p, count, room, msg));
    for (size_t k = 0; k < plot_measured_count(data, part); k++) {
        char *label = part->labels[sensors + k], text[sizeof *part->labels];
        snprintf(text, sizeof text, "%.200s%smeasured", sensors > 1 ? part->labels[k] : "", sensors > 1 ? ", " : "");
        memcpy(label, text, sizeof text);
        struct bead_series points = {.mark = BEAD_MARK_POINTS, .label = label};
        plot_tell_apart(&points, sensors + k);
        BEAD_TRY(add(data, part, k, points, part, msg));
    }
    for (size_t k = 0; k < count; k++) {
        struct bead_series line = plot_line(NULL, NULL, 0, NULL, sensors + k);
        line.dash = k % BEAD_DASHES;
        BEAD_TRY(add(data, part, k, line, below, msg));
    }
    return BEAD_OK;
}
