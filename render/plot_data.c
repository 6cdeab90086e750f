#include "render/plot_data.h"

#include <stdio.h>
#include <stdlib.h>

#include "render/figure.h"
#include "render/markup.h"
#include "render/plot_private.h"

static const struct plot_kind *const kinds[] = {&bead_plot_sensors, &bead_plot_peaks};

static const struct plot_kind *kind_of(const struct bead_plot_data *data)
{
    return kinds[data->output->show == BEAD_SHOW_PEAKS];
}

bool plot_shows(const struct bead_plot_data *data, size_t chain)
{
    return data->chain == SIZE_MAX || data->chain == chain;
}

void plot_heading(const struct bead_chain *chain, char *text, size_t size)
{
    char name[300], magnetism[64] = "";
    bead_markup_quote(bead_chain_name(chain), name, sizeof name);
    if (*bead_chain_spins(chain))
        snprintf(magnetism, sizeof magnetism, "*M*\u00a0=\u00a0%.3g", bead_chain_magnetism(chain));
    snprintf(text, size, "%s%s%s", name, *name && *magnetism ? ", " : "", magnetism);
}

void plot_tell_apart(struct bead_series *series, size_t index)
{
    enum { COLOURS = 6 };
    series->colour = index % COLOURS;
    series->shape = (index + index / COLOURS) % 4; /* rings are for what is open */
    series->dashed = index / COLOURS % 2 == 1;
}

enum bead_error plot_reserve(struct bead_plot_data *data, size_t panels, struct bead_message *msg)
{
    data->parts = calloc(panels + 1, sizeof *data->parts);
    data->panels = calloc(panels + 1, sizeof *data->panels);
    return data->parts && data->panels ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
}

enum bead_error bead_plot_data_create(const struct bead_output *output, const struct bead_stage *stage, size_t chain,
                                      struct bead_plot_data **data, struct bead_message *msg)
{
    struct bead_plot_data *d = *data = calloc(1, sizeof *d);
    if (!d)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    d->output = output;
    d->stage = *stage;
    d->chain = chain;
    enum bead_error err = kind_of(d)->create(d, msg);
    if (err) {
        bead_plot_data_destroy(d);
        *data = NULL;
    }
    return err;
}

void bead_plot_data_destroy(struct bead_plot_data *data)
{
    if (!data)
        return;
    for (size_t p = 0; p < data->count; p++) {
        bead_curves_free(&data->parts[p].curves);
        bead_curves_free(&data->parts[p].differences);
        free(data->parts[p].series);
        free(data->parts[p].values);
        free(data->parts[p].labels);
    }
    free(data->parts);
    free(data->panels);
    free(data->sample);
    free(data);
}

void bead_plot_data_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    kind_of(data)->needs(data, needs);
}

enum bead_error bead_plot_data_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    return kind_of(data)->feed(data, sample, msg);
}

enum bead_error bead_plot_data_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    return kind_of(data)->finish(data, outcomes, msg);
}

const struct bead_panel *bead_plot_data_panels(const struct bead_plot_data *data, size_t *count)
{
    *count = data->count;
    return data->panels;
}
