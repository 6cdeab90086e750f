/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the chains of a sweep over keys, means over seeds with a band of a standard error on both sides: a panel for each
 * place. A dispersion is an image with the exact bands over it, a panel for each combination of the other keys. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/plot/sweep_plot.h"
#include "sim/measure/places.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/sweep/sweep_lines.h"

/* Series for each curve: its band and itself; numbers for each of its points, which all have the same x. */
enum { SERIES = 2, NUMBERS = 2 };

struct lines_panel {
    struct bead_series *series;
    double *numbers;
    char (*labels)[300];
    char title[300];
    struct bead_graph_image image;
    size_t count;
};

struct lines_plot {
    struct sweep_page *page;
    struct bead_sweep_lines lines;
    struct lines_panel *panels;
    double *x; /* of all curves */
    char axis[120];
};

static enum bead_show show_of(const struct lines_plot *plot)
{
    return plot->lines.output.curves.show;
}

static double largest_of(const struct lines_plot *plot)
{
    double most = 0;
    for (size_t k = 0; k < plot->lines.count; k++)
        most = fmax(most, plot_spectral_largest(&plot->lines.of[k].mean));
    return most;
}

static enum bead_error choose_frequencies(const struct lines_plot *plot, double range[2], struct bead_message *msg)
{
    const double most = largest_of(plot);
    double reach = 0;
    for (size_t k = 0; k < plot->lines.count; k++) {
        const struct bead_sweep_line *line = &plot->lines.of[k];
        reach = fmax(reach, plot_spectral_reach(&plot->lines.output, &line->mean, line->medium, most));
    }
    return plot_spectral_frequencies(&plot->lines.output, reach, range, msg);
}

/* ---- curves ---- */

static void label(const struct bead_sweep_line *line, char text[300])
{
    char mean[60] = "";
    size_t used;
    if (line->chains > 1)
        snprintf(mean, sizeof mean, "mean of %zu chains", line->chains);
    bead_markup_quote(line->name, text, 300);
    used = strlen(text);
    snprintf(text + used, 300 - used, "%s%s", used > 0 && *mean ? ", " : "", mean);
}

static void add_series(struct lines_panel *p, const struct lines_plot *plot, size_t k, size_t place)
{
    const struct bead_sweep_line *line = &plot->lines.of[k];
    const size_t n = line->mean.rows;
    const double *mean = line->mean.values + place * n, *error = line->error + place * n;
    double *low = p->numbers + NUMBERS * k * n, *high = low + n;
    struct bead_series *band = &p->series[p->count], *curve = band + (line->chains > 1);
    if (line->chains > 1) {
        for (size_t i = 0; i < n; i++) {
            low[i] = mean[i] - error[i];
            high[i] = mean[i] + error[i];
        }
        snprintf(p->labels[p->count], sizeof *p->labels, "± standard error");
        *band = plot_line(plot->x, low, n, k == 0 ? p->labels[p->count] : NULL, k);
        band->upper = high;
        band->faint = true;
        band->mark = BEAD_MARK_BAND;
        p->count++;
    }
    label(line, p->labels[p->count]);
    *curve = plot_line(plot->x, mean, n, *p->labels[p->count] ? p->labels[p->count] : NULL, k);
    p->count++;
}

static void set_axes(struct lines_plot *plot, size_t place, const double frequencies[2])
{
    const struct bead_output *output = &plot->lines.output;
    const struct bead_place_shown shown = bead_place_shown(output, plot->lines.of[0].chain, place);
    const struct bead_field_info *field = bead_chain_field(plot->lines.of[0].chain, shown.field);
    const bool sensors = show_of(plot) == BEAD_SHOW_SENSORS, transfer = show_of(plot) == BEAD_SHOW_TRANSFER;
    struct bead_panel *panel = &plot->page->panels[place];
    snprintf(plot->axis, sizeof plot->axis, "%s%s", transfer ? "transfer of " : sensors ? "" : "amplitude of ", field->title);
    panel->x =
        sensors
            ? (struct bead_graph_axis){"time", "s", plot->x[0], plot->x[plot->lines.of[0].mean.rows - 1], BEAD_SCALE_LINEAR, false}
            : (struct bead_graph_axis){"frequency", "Hz", frequencies[0], frequencies[1], BEAD_SCALE_LINEAR, false};
    panel->y = (struct bead_graph_axis){plot->axis,
                                        transfer ? "" : field->unit,
                                        plot_spectral_low(output, largest_of(plot)),
                                        output->plot.range[1],
                                        output->plot.scale,
                                        true};
    bead_markup_quote(shown.name, plot->panels[place].title, sizeof plot->panels[place].title);
}

static enum bead_error fill_curves(struct lines_plot *plot, struct bead_message *msg)
{
    const struct bead_sweep_lines *lines = &plot->lines;
    const struct bead_spectral *first = &lines->of[0].mean;
    struct plot_store *store = &plot->page->store;
    const bool sensors = show_of(plot) == BEAD_SHOW_SENSORS;
    double frequencies[2] = {NAN, NAN};
    BEAD_TRY(plot_new(store, &plot->x, first->rows, msg));
    for (size_t i = 0; i < first->rows; i++)
        plot->x[i] = (sensors ? first->first : 0) + (double)i * first->step;
    if (!sensors)
        BEAD_TRY(choose_frequencies(plot, frequencies, msg));
    for (size_t p = 0; p < plot->page->count; p++) {
        struct lines_panel *panel = &plot->panels[p];
        BEAD_TRY(plot_new(store, &panel->series, SERIES * lines->count, msg));
        BEAD_TRY(plot_new(store, &panel->labels, SERIES * lines->count, msg));
        BEAD_TRY(plot_new(store, &panel->numbers, NUMBERS * lines->count * first->rows, msg));
        for (size_t k = 0; k < lines->count; k++)
            add_series(panel, plot, k, p);
        set_axes(plot, p, frequencies);
    }
    return BEAD_OK;
}

/* ---- images ---- */

static enum bead_error fill_images(struct lines_plot *plot, struct bead_message *msg)
{
    const double most = largest_of(plot);
    double frequencies[2];
    BEAD_TRY(choose_frequencies(plot, frequencies, msg));
    snprintf(plot->axis, sizeof plot->axis, "amplitude of %s",
             bead_chain_field(plot->lines.of[0].chain, plot->lines.output.shown.field)->title);
    for (size_t p = 0; p < plot->page->count; p++) {
        struct lines_panel *panel = &plot->panels[p];
        struct bead_panel *shown = &plot->page->panels[p];
        struct bead_sweep_line *line = &plot->lines.of[p];
        struct bead_spectral *mean = &line->mean;
        if (mean->columns < 2 || !(most > 0))
            return bead_output_wrong(&plot->lines.output, msg, "show: there are no waves, or only one column of amplitudes");
        panel->image = plot_spectral_image(mean, most, plot->axis);
        if (plot_spectral_top(line->medium) > 0) {
            BEAD_TRY(plot_new(&plot->page->store, &panel->series, 1, msg));
            BEAD_TRY(plot_new(&plot->page->store, &panel->numbers, PLOT_BAND_VALUES * line->medium->cell.count, msg));
            panel->series[0] = plot_exact_bands(line->medium, panel->numbers);
            panel->count = 1;
        }
        label(line, panel->title);
        shown->image = &panel->image;
        shown->x = (struct bead_graph_axis){"wave number × cell / π", "", 0, 1, BEAD_SCALE_LINEAR, false};
        shown->y = (struct bead_graph_axis){"frequency", "Hz", frequencies[0], frequencies[1], BEAD_SCALE_LINEAR, false};
    }
    return BEAD_OK;
}

/* ---- the graph ---- */

static enum bead_error make(struct lines_plot *plot, struct bead_message *msg)
{
    struct sweep_page *page = plot->page;
    const bool images = page->output->curves.show == BEAD_SHOW_DISPERSION;
    BEAD_TRY(bead_sweep_lines_find(page->context->sweep, page->output, page->context->sweep_settings, false, &plot->lines, msg));
    BEAD_TRY(sweep_page_reserve(page, images ? plot->lines.count : plot->lines.of[0].mean.columns, msg));
    BEAD_TRY(plot_new(&page->store, &plot->panels, page->count, msg));
    BEAD_TRY(images ? fill_images(plot, msg) : fill_curves(plot, msg));
    for (size_t p = 0; p < page->count; p++) {
        page->panels[p].title = *plot->panels[p].title ? plot->panels[p].title : NULL;
        page->panels[p].series = plot->panels[p].series;
        page->panels[p].series_count = plot->panels[p].count;
    }
    return sweep_page_write(page, msg);
}

enum bead_error bead_lines_plot_write(struct sweep_page *page, struct bead_message *msg)
{
    struct lines_plot plot = {.page = page};
    enum bead_error err = make(&plot, msg);
    bead_sweep_lines_free(&plot.lines);
    return err;
}
