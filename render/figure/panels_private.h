/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills with a caption or of several panels, images and plots side by side, in a table of rows: plots of a row are equally high,
 * those of a column are above each other, panels of one field share a range of colours and a bar. panels.c (made and fed),
 * panels_layout.c (places), panels_write.c (the end). */
#pragma once

#include "render/figure/figure.h"
#include "render/figure/still.h"
#include "render/plot/graph_private.h"
#include "render/plot/plot_data.h"
#include "render/view/tale.h"

struct still_panel {
    const struct bead_output *output;
    size_t row, column;
    struct bead_part_settings set;
    struct bead_figure *figure;  /* or */
    struct bead_plot_data *plot; /* with */
    struct bead_needs needs;
    size_t group;          /* that shares a range of colours; figures only */
    struct bead_rect area; /* px */
    struct bead_insets insets;
};

struct bead_still {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    struct bead_look look;
    struct still_panel *panels;
    size_t count, rows;
    bool alone;                     /* one figure without caption, which has the whole page */
    struct bead_layout_grid layout; /* of the panels' plots, during the layout */
    struct bead_grid grid;
    struct graph_page words;
    struct bead_tale *tale; /* of the first figure's field; NULL: all panels are plots */
    char why[96];
    char painter[64]; /* of a canvas; "": none was needed */
};

/* The panel at a place, or NULL. */
struct still_panel *panels_at(const struct bead_still *still, size_t row, size_t column);
/* Writes a file in the format of its name. Errors: UNSUPPORTED (no outcomes for peaks), IO, MEMORY, GRAPHICS. */
BEAD_CHECK enum bead_error panels_write(struct bead_still *still, const struct bead_outcome *outcomes, const char *path,
                                        uint64_t *bytes, struct bead_message *msg);
/* Finds groups, shared axes and areas. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error panels_arrange(struct bead_still *still, struct bead_message *msg);
/* The panels of a plot as a graph; `panels` has room for all of them. */
struct bead_graph panel_graph(const struct still_panel *panel, struct bead_panel *panels);
enum { PANEL_PLOTS = 64 };
