/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `panels` of images and plots. */
#include <stdlib.h>
#include <string.h>

#include "sim/base/suggest.h"
#include "sim/scene/scene_output.h"

enum { MOST_ROWS = 8, MOST_COLUMNS = 8 };

void bead_output_free(struct bead_output *output)
{
    for (size_t i = 0; i < output->still.panel_count; i++)
        bead_output_free(&output->still.panels[i]);
    free(output->still.panels);
    free(output->still.caption);
    free(output->panel.title);
    free(output->path);
    free(output->colours.colormap);
    free(output->paper.font);
    free(output->sweep_curves.threshold);
    free(output->sheet.magnetism);
    free(output->trajectory.xdmf);
    free(output->curves.contacts);
    bead_output_free_movie(output);
}

BEAD_OUTPUT_READER(bead_output_read_chain)
{
    const struct bead_scene *scene = reader->scene;
    struct bead_output *output = settings;
    struct bead_suggest search;
    const char *name = NULL;
    char shown[64], near[96];
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &name);
    if (err)
        return err;
    if (reader->unsound)
        return BEAD_OK;
    bead_suggest_begin(&search, name);
    for (size_t c = 0; c < scene->chain_count; c++) {
        output->panel.chain = c;
        if (strcmp(scene->chains[c].name, name) == 0)
            return BEAD_OK;
        bead_suggest_try(&search, scene->chains[c].name);
    }
    output->panel.chain = SIZE_MAX;
    if (strcmp(name, "all") == 0)
        return BEAD_OK;
    return bead_wrong(reader, at, "%s is not the name of a chain%s", bead_node_show(at->node, shown, sizeof shown),
                      bead_suggest_text(&search, near, sizeof near));
}

static bool has_sensors(const struct bead_scene *scene, size_t chain)
{
    for (size_t c = 0; c < scene->chain_count; c++) {
        for (size_t s = 0; (chain == SIZE_MAX || c == chain) && s < scene->chains[c].segment_count; s++) {
            if (scene->chains[c].segments[s].sensor)
                return true;
        }
    }
    return false;
}

static enum bead_error read_panel(struct bead_reader *reader, const struct bead_at *at, size_t row, struct bead_output *panel)
{
    char shown[64];
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_wrong(reader, at, "is %s; must be a map such as {field: force}", bead_node_show(at->node, shown, sizeof shown));
    bool plot = bead_node_get(at->node, "show", NULL) != NULL;
    *panel = bead_output_automatic;
    panel->kind = plot ? BEAD_OUTPUT_PLOT : BEAD_OUTPUT_IMAGE;
    panel->place = at->node->place;
    panel->panel.row = row;
    enum bead_error err = bead_output_read_settings(reader, at, plot ? &bead_plot_panel_options : &bead_image_panel_options, panel);
    struct bead_at show = bead_at_key(at, "show");
    if (!err && plot && bead_output_show(panel)->drawing)
        return bead_wrong(reader, &show,
                          "panels show sensors, peaks, modes or profiles; this needs a picture of its own: {plot: FILE, show: %s}",
                          show.node->text);
    bool sensors =
        plot ? panel->curves.show == BEAD_SHOW_SENSORS : bead_views_any(panel->views.kinds, panel->views.count, BEAD_SHOWS_SENSORS);
    struct bead_at where = bead_at_key(at, "chain");
    if (!err && !reader->unsound && sensors && !has_sensors(reader->scene, panel->panel.chain))
        err = bead_wrong(reader, &where, "has no bead with a `sensor` that could be shown");
    return err;
}

/* A list with something in it, and not too much. */
static enum bead_error need_list(const struct bead_reader *reader, const struct bead_at *at, size_t most, const char *wanted)
{
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), wanted);
    if (at->node->count == 0 || at->node->count > most)
        return bead_wrong(reader, at, "has %zu entries; must have from 1 to %zu", at->node->count, most);
    return BEAD_OK;
}

BEAD_OUTPUT_READER(bead_output_read_panels)
{
    struct bead_output *output = settings;
    enum bead_error err = need_list(reader, at, MOST_ROWS, option->shape);
    if (err)
        return err;
    output->still.panels = calloc((size_t)MOST_COLUMNS * at->node->count, sizeof *output->still.panels);
    if (!output->still.panels)
        return bead_no_memory(reader);
    for (size_t r = 0; !err && r < at->node->count; r++) {
        struct bead_at row = {at, NULL, r, at->node->items[r]};
        err = need_list(reader, &row, MOST_COLUMNS, "a row: a list of panels such as [{field: force}, {field: velocity}]");
        for (size_t i = 0; !err && i < row.node->count; i++) {
            struct bead_at panel = {&row, NULL, i, row.node->items[i]};
            err = read_panel(reader, &panel, r, &output->still.panels[output->still.panel_count++]);
        }
    }
    return err;
}

/* The first key of single panels that stands beside `panels`; NULL: none. */
static const char *panel_key(const struct bead_at *at, const struct bead_options *options)
{
    const struct bead_option *row;
    for (size_t i = 0; (row = bead_options_row(options, i)); i++) {
        if (bead_node_get(at->node, row->key, NULL))
            return row->key;
    }
    return NULL;
}

BEAD_OUTPUT_CHECK(bead_output_check_panels)
{
    struct bead_at where = bead_at_key(at, "letters");
    if (output->still.panel_count == 0 && where.node != at->node)
        return bead_wrong(reader, &where, "belongs to `panels`; there are none");
    where = bead_at_key(at, "axes");
    if (!output->views.axes && (output->still.panel_count > 0 || output->still.caption))
        return bead_wrong(reader, &where, "is false: bare pixels have neither panels nor a caption");
    if (output->still.panel_count == 0)
        return BEAD_OK;
    const char *key = panel_key(at, &bead_image_panel_options);
    key = key ? key : panel_key(at, &bead_plot_panel_options);
    where = bead_at_key(at, key ? key : "");
    return key ? bead_wrong(reader, &where, "is a key of a single panel; it belongs in the maps of `panels`") : BEAD_OK;
}
