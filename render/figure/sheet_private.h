/* What the parts of a sheet share: sheet.c (life), sheet_layout.c (where panels go), sheet_write.c (the end). */
#ifndef BEADREEL_RENDER_FIGURE_SHEET_PRIVATE_H
#define BEADREEL_RENDER_FIGURE_SHEET_PRIVATE_H

#include "render/figure/figure.h"
#include "render/figure/sheet.h"
#include "render/plot/graph_private.h"
#include "render/plot/plot_data.h"

struct sheet_panel {
    const struct bead_output *output;
    size_t row, column;
    struct bead_part_settings set;
    struct bead_figure *figure;  /* or */
    struct bead_plot_data *plot; /* with */
    struct bead_needs needs;
    char title[600];       /* of a plot, in place of the chain's name */
    size_t group;          /* of one range of colours; figures only */
    struct bead_rect area; /* px */
    struct bead_insets insets;
};

struct bead_sheet {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    struct bead_look look;
    struct sheet_panel *panels;
    size_t count, rows;
    struct bead_grid grid;
    char *title, *caption; /* markup; NULL: none */
    double title_height, caption_height;
    char why[96];
};

/* Number of panels in a row. */
size_t sheet_columns(const struct bead_sheet *sheet, size_t row);
/* The panel at a place, or NULL. */
struct sheet_panel *sheet_at(const struct bead_sheet *sheet, size_t row, size_t column);
/* Groups, shared axes, areas. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error sheet_arrange(struct bead_sheet *sheet, struct bead_message *msg);
/* The panels of a plot as a graph; `panels` has room for all of them. */
struct bead_graph sheet_graph(const struct sheet_panel *panel, struct bead_panel *panels);
enum { SHEET_PLOTS = 64 };

#endif
