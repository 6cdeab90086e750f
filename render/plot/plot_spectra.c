/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spectra, a panel for each chain: amplitudes, or ratios to the driven bead, against frequency; and amplitudes as colours, against
 * time, or against wave number with the exact bands over them. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/plot_private.h"
#include "sim/chain/chain_internal.h"
#include "sim/measure/places.h"

/* Of the first place: all chains of a scene are of one kind. */
static struct bead_graph_axis amplitudes(struct bead_plot_data *data, double largest)
{
    const struct bead_chain *chain = data->context.chains[data->parts[0].chain];
    return plot_spectral_axis(data, bead_chain_field(chain, bead_place_shown(data->output, chain, 0).field), largest);
}

static bool is_image(const struct bead_plot_data *data)
{
    const enum bead_show show = data->output->curves.show;
    return show == BEAD_SHOW_SPECTROGRAM || show == BEAD_SHOW_DISPERSION;
}

/* `frequencies`, `columns`: the ranges; NaN before they are known; so `largest` is 0. */
static void make_axes(struct bead_plot_data *data, const double frequencies[2], const double columns[2], double largest)
{
    const char *time = bead_chain_time_unit(data->context.chains[0]), *hertz = *time ? "Hz" : "";
    const struct bead_graph_axis frequency = {"frequency", hertz, frequencies[0], frequencies[1], BEAD_SCALE_LINEAR, false},
                                 moment = {"time", time, columns[0], columns[1], BEAD_SCALE_LINEAR, false};
    for (size_t p = 0; p < data->count; p++) {
        data->panels[p].x = !is_image(data)                                     ? frequency
                            : data->output->curves.show == BEAD_SHOW_DISPERSION ? plot_wave_numbers
                                                                                : moment;
        data->panels[p].y = is_image(data) ? frequency : amplitudes(data, largest);
    }
}

/* The bar names the quantity of the amplitudes; the title of a spectrogram names the place. */
static void make_images(struct bead_plot_data *data)
{
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        const struct bead_chain *chain = data->context.chains[part->chain];
        struct bead_place_shown place = {.field = data->output->shown.field};
        char name[2 * sizeof place.name];
        if (data->output->curves.show == BEAD_SHOW_SPECTROGRAM) {
            place = bead_place_shown(data->output, chain, 0);
            const size_t used = strlen(part->title);
            bead_markup_quote(place.name, name, sizeof name);
            snprintf(part->title + used, sizeof part->title - used, "%s%s",
                     used == 0                  ? ""
                     : *bead_chain_title(chain) ? ": "
                                                : ", ",
                     name);
        }
        (void)plot_spectral_axis(data, bead_chain_field(chain, place.field), 0);
        plot_spectral_colours(data, p, &part->spectral, 1); /* none yet: its bar needs room */
    }
}

static enum bead_error create(struct bead_plot_data *data, struct bead_message *msg)
{
    BEAD_TRY(bead_spectra_create(data->output, &data->context, &data->spectra, msg));
    BEAD_TRY(plot_reserve_chains(data, 0, 0, msg));
    snprintf(data->why, sizeof data->why, "spectra");
    make_axes(data, (const double[]){NAN, NAN}, (const double[]){NAN, NAN}, 0);
    if (is_image(data))
        make_images(data);
    return BEAD_OK;
}

static void needs_of(const struct bead_plot_data *data, struct bead_needs *needs)
{
    *needs = bead_spectra_needs(data->spectra);
}

static enum bead_error feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_spectra_feed(data->spectra, sample, msg);
}

static enum bead_error find_all(struct bead_plot_data *data, struct plot_spectrum **all, double *largest, double range[2],
                                struct bead_message *msg)
{
    BEAD_TRY(plot_new(&data->store, all, data->count, msg));
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        BEAD_TRY(bead_spectra_of(data->spectra, part->chain, &part->spectral, msg));
        (*all)[p] = (struct plot_spectrum){&part->spectral, bead_spectra_medium(data->spectra, part->chain)};
    }
    return plot_spectral_ranges(data->output, *all, data->count, largest, range, msg);
}

/* ---- curves ---- */

static enum bead_error fill_curves(struct bead_plot_data *data, size_t p, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    const struct bead_spectral *found = &part->spectral;
    BEAD_TRY(plot_reserve_series(data, p, found->columns, found->rows, msg));
    for (size_t k = 0; k < found->rows; k++)
        part->values[k] = (double)k * found->step;
    for (size_t i = 0; i < found->columns; i++) {
        const struct bead_place_shown place = bead_place_shown(data->output, data->context.chains[part->chain], i);
        bead_markup_quote(place.name, part->labels[i], sizeof part->labels[i]);
        plot_add(part, plot_line(part->values, found->values + i * found->rows, found->rows, part->labels[i], i));
    }
    return BEAD_OK;
}

static enum bead_error finish_curves(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    struct plot_spectrum *all = NULL;
    double range[2], largest;
    BEAD_TRY(find_all(data, &all, &largest, range, msg));
    make_axes(data, range, (const double[]){NAN, NAN}, largest);
    for (size_t p = 0; p < data->count; p++)
        BEAD_TRY(fill_curves(data, p, msg));
    return BEAD_OK;
}

/* ---- images ---- */

static enum bead_error finish_image(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    const double *asked = data->output->shown.time;
    struct plot_spectrum *all = NULL;
    double range[2], largest, time[2] = {0, 0};
    BEAD_TRY(find_all(data, &all, &largest, range, msg));
    for (size_t p = 0; p < data->count; p++) {
        if (data->parts[p].spectral.columns < 2)
            return bead_output_wrong(data->output, msg, "show: there is only one column of amplitudes; a picture needs two");
        BEAD_TRY(plot_spectral_image(data, p, &all[p], largest, msg));
        time[0] = isnan(asked[0]) ? data->parts[p].image.x[0] : asked[0];
        time[1] = isnan(asked[1]) ? fmax(time[1], data->parts[p].image.x[1]) : asked[1];
    }
    make_axes(data, range, time, largest);
    return BEAD_OK;
}

const struct plot_kind bead_plot_spectrum = {BEAD_SHOW_SPECTRUM, create, needs_of, feed, finish_curves};
const struct plot_kind bead_plot_transfer = {BEAD_SHOW_TRANSFER, create, needs_of, feed, finish_curves};
const struct plot_kind bead_plot_spectrogram = {BEAD_SHOW_SPECTROGRAM, create, needs_of, feed, finish_image};
const struct plot_kind bead_plot_dispersion = {BEAD_SHOW_DISPERSION, create, needs_of, feed, finish_image};
