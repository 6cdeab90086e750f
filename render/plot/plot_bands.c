/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small vibrations, a panel for each chain: frequency against wave number of the cells that it repeats, with the gaps shaded; or
 * how many beads take part in each of its modes, against their frequencies. They need no run. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/plot_private.h"
#include "sim/base/memory.h"

static void set_axes(struct bead_plot_data *data, struct bead_graph_axis x, struct bead_graph_axis y)
{
    for (size_t p = 0; p < data->count; p++) {
        data->panels[p].x = x;
        data->panels[p].y = y;
    }
}

/* ---- bands ---- */

static enum bead_error plot_bands_create(struct bead_plot_data *data, struct bead_message *msg)
{
    BEAD_TRY(plot_reserve_chains(data, 0, 0, msg));
    for (size_t p = 0; p < data->count; p++) /* of a cell, however its neighbours are turned: no M */
        bead_markup_quote(bead_chain_title(data->context.chains[data->parts[p].chain]), data->parts[p].title,
                          sizeof data->parts[p].title);
    set_axes(data, plot_wave_numbers,
             (struct bead_graph_axis){"frequency", "Hz", data->output->plot.range[0], data->output->plot.range[1],
                                      BEAD_SCALE_LINEAR, true});
    snprintf(data->why, sizeof data->why, "bands of each cell");
    return BEAD_OK;
}

/* The gaps of a chain with one kind of cell. */
static enum bead_error shade_gaps(struct bead_plot_data *data, size_t p, const struct bead_medium *medium, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    struct bead_panel *panel = &data->panels[p];
    BEAD_TRY(plot_new(&data->store, &part->rulers, medium->cell.count, msg));
    for (size_t i = 0; i < medium->cell.count; i++) {
        double ends[2];
        if (bead_gap(medium, i, ends))
            part->rulers[panel->ruler_count++] = (struct bead_ruler){false, NAN, ends[0], ends[1], "gap"};
    }
    panel->rulers = part->rulers;
    return BEAD_OK;
}

static enum bead_error fill_bands(struct bead_plot_data *data, size_t p, const struct bead_medium *media, size_t count,
                                  struct bead_message *msg)
{
    size_t values = 0;
    for (size_t i = 0; i < count; i++)
        values += PLOT_BAND_VALUES * media[i].cell.count;
    struct plot_panel *part = &data->parts[p];
    BEAD_TRY(plot_reserve_series(data, p, count, values, msg));
    for (size_t i = 0; i < count; i++) {
        snprintf(part->labels[i], sizeof *part->labels, "beads %zu to %zu", media[i].first, media[i].last);
        struct bead_series *bands = plot_add_bands(part, &media[i]);
        bands->label = count > 1 ? part->labels[i] : NULL;
        plot_tell_apart(bands, i);
    }
    return count == 1 ? shade_gaps(data, p, &media[0], msg) : BEAD_OK;
}

static enum bead_error plot_bands_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t p = 0; p < data->count && !err; p++) {
        struct bead_medium *media = NULL;
        size_t count = 0;
        err = bead_media_find(data->context.chains[data->parts[p].chain], &media, &count, msg);
        if (!err)
            err = fill_bands(data, p, media, count, msg);
        bead_media_free(media, count);
    }
    return err;
}

const struct plot_kind bead_plot_bands = {BEAD_SHOW_BANDS, plot_bands_create, NULL, NULL, plot_bands_finish};

/* ---- modes ---- */

static enum bead_error plot_eigenmodes_create(struct bead_plot_data *data, struct bead_message *msg)
{
    size_t most = 0;
    for (size_t c = 0; c < data->context.chain_count; c++) {
        const size_t beads = bead_chain_beads(data->context.chains[c]);
        most = beads > most ? beads : most;
    }
    BEAD_TRY(plot_reserve_chains(data, 1, 2 * most, msg));
    set_axes(data, (struct bead_graph_axis){"frequency", "Hz", NAN, NAN, BEAD_SCALE_LINEAR, true},
             (struct bead_graph_axis){"participation in beads", "", data->output->plot.range[0], data->output->plot.range[1],
                                      data->output->plot.scale, true});
    snprintf(data->why, sizeof data->why, "modes of each chain");
    return BEAD_OK;
}

static enum bead_error plot_eigenmodes_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        const size_t count = bead_chain_beads(data->context.chains[part->chain]);
        BEAD_FREED struct bead_mode *modes = NULL;
        BEAD_TRY(bead_modes_find(data->context.chains[part->chain], &modes, msg));
        double *x = plot_add_numbers(part, (struct bead_series){.mark = BEAD_MARK_POINTS}, count, 2);
        for (size_t i = 0; i < count; i++) {
            x[i] = modes[i].frequency;
            x[count + i] = modes[i].participation;
        }
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_eigenmodes = {BEAD_SHOW_EIGENMODES, plot_eigenmodes_create, NULL, NULL, plot_eigenmodes_finish};
