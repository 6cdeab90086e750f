/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `panels` of images and plots: the keys of a panel, the rows of them, and checks. */
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/view_kinds.h"

enum { MOST_ROWS = 8, MOST_COLUMNS = 8 };

enum bead_error bead_output_find_chain(struct bead_reader *reader, const struct bead_at *at, const char *shape, size_t *chain)
{
    const struct bead_scene *scene = reader->scene;
    struct bead_suggest search;
    const char *name = NULL;
    char shown[64], near[96];
    BEAD_TRY(bead_read_scalar(reader, at, shape, &name));
    if (reader->unsound)
        return BEAD_OK;
    bead_suggest_begin(&search, name);
    for (size_t c = 0; c < scene->chain_count; c++) {
        *chain = c;
        if (strcmp(scene->chains[c].name, name) == 0)
            return BEAD_OK;
        bead_suggest_try(&search, scene->chains[c].name);
    }
    *chain = SIZE_MAX;
    if (strcmp(name, "all") == 0)
        return BEAD_OK;
    return bead_wrong(reader, at, "%s is not the name of a chain%s", bead_node_show(at->node, shown, sizeof shown),
                      bead_suggest_text(&search, near, sizeof near));
}

static BEAD_OPTION_READER(read_chain)
{
    return bead_output_find_chain(reader, at, option->shape, &((struct bead_output *)settings)->panel.chain);
}

static const struct bead_option panel_rows[] = {
    {"chain", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(panel.chain), .initial = "all", .shape = "all, or the name of a chain",
     .like = "text", .read = read_chain, .help = "in panels: the chain whose waves are shown", .example = "clean"},
    {"title", BEAD_OPTION_TEXT, BEAD_OF_OUTPUT(panel.title),
     .help = "in panels: heading, instead of the name of the chain; set like `caption`", .example = "Peak forces"},
};

static const struct bead_option_rows image_panel_shared[] = {{BEAD_OPTIONS(bead_field_row)},
                                                             {BEAD_OPTIONS(bead_time_row)},
                                                             {BEAD_OPTIONS(bead_beads_row)},
                                                             {BEAD_OPTIONS(bead_every_row)},
                                                             {BEAD_OPTIONS(bead_colormap_row)},
                                                             {BEAD_OPTIONS(bead_image_rows)},
                                                             {BEAD_OPTIONS(bead_square_root_row)},
                                                             {BEAD_OPTIONS(bead_range_row)},
                                                             {BEAD_OPTIONS(bead_magnify_row)},
                                                             {BEAD_OPTIONS(bead_trust_row)},
                                                             {BEAD_OPTIONS(bead_theory_row)},
                                                             {BEAD_OPTIONS(bead_orientation_row)},
                                                             {NULL, 0}};
const struct bead_options bead_image_panel_options = {NULL, "a panel that is an image", BEAD_OPTIONS(panel_rows),
                                                      image_panel_shared, &bead_output_family};

static const struct bead_option_rows plot_panel_shared[] = {{BEAD_OPTIONS(bead_curves_rows)}, {BEAD_OPTIONS(bead_plot_rows)},
                                                            {BEAD_OPTIONS(bead_time_row)},    {BEAD_OPTIONS(bead_every_row)},
                                                            {BEAD_OPTIONS(bead_trust_row)},   {NULL, 0}};
const struct bead_options bead_plot_panel_options = {NULL, "a panel that is a plot", BEAD_OPTIONS(panel_rows), plot_panel_shared,
                                                     &bead_output_family};
const struct bead_options bead_panel_options = {"outputs.panels",
                                                "a panel takes the keys of an image, or with `show` those of a plot, and these",
                                                BEAD_OPTIONS(panel_rows), NULL, NULL};

static BEAD_OUTPUT_CHECK(check_show)
{
    return bead_output_check_show(reader, at, output, &bead_plot_panel_options);
}

static const struct bead_output_type image_panel = {.options = &bead_image_panel_options,
                                                    .checks = {bead_output_check_field, bead_output_check_still_views,
                                                               bead_output_check_times, bead_output_check_moment,
                                                               bead_output_check_trust, bead_output_check_theory}};
static const struct bead_output_type plot_panel = {
    .options = &bead_plot_panel_options,
    .checks = {bead_output_check_times, bead_output_check_drawing, check_show, bead_output_check_plot_trust}};

static enum bead_error read_panel(struct bead_reader *reader, const struct bead_at *at, size_t row, struct bead_output *panel)
{
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_must_be(reader, at, "a map such as {field: force}");
    bool plot = bead_node_get(at->node, "show", NULL) != NULL;
    *panel = bead_output_automatic;
    panel->kind = plot ? BEAD_OUTPUT_PLOT : BEAD_OUTPUT_IMAGE;
    panel->file = reader->scene->file;
    panel->node = at->node;
    panel->panel.row = row;
    BEAD_TRY(bead_output_read_settings(reader, at, plot ? &plot_panel : &image_panel, panel));
    if (plot && bead_show_type(panel->curves.show)->drawing)
        return BEAD_WRONG_KEY(
            reader, at, "show",
            "panels show sensors, peaks, modes or profiles; this needs a picture of its own: {plot: FILE, show: %s}",
            bead_at_key(at, "show").node->text);
    const bool listed = panel->curves.beads.all || panel->curves.contacts.all;
    const bool sensors =
        plot ? panel->curves.show == BEAD_SHOW_SENSORS && !listed : bead_views_any(&panel->views, BEAD_SHOWS_SENSORS);
    if (!reader->unsound && sensors && !bead_scene_has_sensors(reader->scene, panel->panel.chain))
        return BEAD_WRONG_KEY(reader, at, "chain", "has no bead with a `sensor` that could be shown%s",
                              plot ? "; give one, or say which `beads`" : "");
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_panels)
{
    struct bead_output *output = settings;
    BEAD_TRY(bead_need_list(reader, at, option->shape, MOST_ROWS, "entries"));
    BEAD_TRY(bead_new(&output->still.panels, MOST_COLUMNS * at->node->count, reader->msg, "an output"));
    for (size_t r = 0; r < at->node->count; r++) {
        struct bead_at row = bead_at_item(at, r);
        BEAD_TRY(bead_need_list(reader, &row, "a row: a list of panels such as [{field: force}, {field: velocity}]", MOST_COLUMNS,
                                "entries"));
        for (size_t i = 0; i < row.node->count; i++) {
            struct bead_at panel = bead_at_item(&row, i);
            BEAD_TRY(read_panel(reader, &panel, r, &output->still.panels[output->still.panel_count++]));
        }
    }
    return BEAD_OK;
}

/* Keys of pictures with panels. */
const struct bead_option bead_panels_rows[2] = {
    {"panels", BEAD_OPTION_CUSTOM,
     .shape = "a list of rows, each a list of panels such as [{field: force, chain: clean}, {show: peaks}]",
     .like = "[[outputs.panel]]", .read = read_panels,
     .help = "several panels in one picture; a panel takes the keys of an image, or with `show` those of a plot, and `chain` and "
             "`title`; panels of one field share range and colour bar",
     .example = "[[{field: force, chain: clean}, {show: peaks}], [{field: velocity}]]"},
    {"letters", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(still.letters), .initial = "true", .help = "(a), (b), ... at the panels"},
};

/* The first key of single panels that is given beside `panels`; NULL: none. */
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
    if (output->still.panel_count == 0 && bead_given(at, "letters"))
        return BEAD_WRONG_KEY(reader, at, "letters", "belongs to `panels`; there are none");
    if (!output->views.axes && (output->still.panel_count > 0 || output->still.caption))
        return BEAD_WRONG_KEY(reader, at, "axes", "is false: bare pixels have neither panels nor a caption");
    if (output->still.panel_count == 0)
        return BEAD_OK;
    const char *key = panel_key(at, &bead_image_panel_options);
    key = key ? key : panel_key(at, &bead_plot_panel_options);
    return key ? BEAD_WRONG_KEY(reader, at, key, "is a key of a single panel; it belongs in the maps of `panels`") : BEAD_OK;
}
