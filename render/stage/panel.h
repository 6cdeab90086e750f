/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The panel behind a plot of a movie, which extends beyond it in views of beads, and the axes at its sides. */
#pragma once

#include <string.h>

#include "beadreel/view.h"
#include "render/draw/axis.h"

/* "force" for "bead force", in pictures that name the beads elsewhere. */
static inline const char *bead_field_short(const struct bead_field_info *field)
{
    const char *last = strrchr(field->title, ' ');
    return last ? last + 1 : field->title;
}

/* The plot of a view with the room beside it that its panel covers; the axis is to the left of that, and of its colours. */
static inline struct bead_rect bead_panel_rect(const struct bead_view_setup *setup, struct bead_rect plot)
{
    const int *beyond = setup->beyond;
    return (struct bead_rect){plot.x - beyond[0], plot.y, plot.width + beyond[0] + beyond[1], plot.height};
}

void bead_panel_fill(cairo_t *cr, const struct bead_view_setup *setup, struct bead_rect plot);
/* Ticks, labels and title of the vertical axis, as the setup asks for them. */
void bead_panel_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                     bool downwards, const char *title);
/* Words to the right of a title above the panel, if they fit. */
void bead_panel_remark(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                       const char *title, const char *remark);
/* The axis along the chain, or of modes, below the plot. `title` NULL: also without numbers. */
void bead_panel_chain_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                           const char *title);
/* The title of both axes, if only that of the axis along the chain fits; followed by the unit of times. */
#define BEAD_PANEL_AGAINST "%s against time"
/* The axis of time below the plot, with its title unless the picture has none, or has it above. */
void bead_panel_time_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot);
/* The title of the axis along the chain, left of its numbers, below the labels of vertical axes; its room there, px. */
void bead_panel_name(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                     const char *title);
double bead_panel_name_room(const struct bead_look *look, const char *title);

/* The axis along a chain: numbers of beads or contacts, or positions of an equation's points, for values first..last, each one unit
 * wide. Returns the title. */
const char *bead_axis_along_chain(struct bead_axis *axis, const struct bead_chain *chain, bool of_contacts, size_t first,
                                  size_t last, double length, double em, bool horizontal);
