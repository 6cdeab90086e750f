/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws panels and their axes. The title of a vertical axis is beside it in figures, and above the panel in movies, where it is
 * horizontal and never breaks. */
#include "render/stage/panel.h"
#include "render/draw/looks.h"
#include "sim/chain/chain_internal.h"

#include <math.h>

/* From a panel's top to the baseline of its title, in units of the label's font size. */
static const double title_rise = 0.38;
/* Titles left of a panel: from its left edge, or a number there, to the end of the title; from its bottom to the baseline, as for
 * numbers of axes. */
static const double name_gap = 0.65, least_gap = 0.3, name_drop = 1.38;
/* Places this close look the same, px. */
static const double same_pixel = 1.5;

void bead_panel_fill(cairo_t *cr, const struct bead_view_setup *setup, struct bead_rect plot)
{
    struct bead_rect panel = bead_panel_rect(setup, plot);
    bead_look_paint_panel(setup->look, cr, panel.x, panel.y, panel.width, panel.height);
}

void bead_panel_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                     bool downwards, const char *title)
{
    const struct bead_look *look = setup->look;
    struct bead_rect panel = bead_panel_rect(setup, plot);
    panel.x -= setup->coloured;
    bool beside = setup->titles == BEAD_TITLES_BESIDE;
    bead_axis_draw(cr, look, axis, panel, BEAD_SIDE_LEFT, downwards, !setup->ticks_only, beside ? title : NULL);
    if (setup->titles != BEAD_TITLES_ABOVE || setup->ticks_only)
        return;
    char markup[2100];
    struct bead_text_style style = {
        .family = look->family, .size = look->label, .colour = look->ink, .across = BEAD_ALIGN_START, .down = BEAD_ALIGN_BASELINE};
    bead_axis_title(axis, title, markup, sizeof markup);
    bead_text_draw(cr, &style, panel.x, panel.y - title_rise * look->label, markup);
}

void bead_panel_remark(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                       const char *title, const char *remark)
{
    const struct bead_look *look = setup->look;
    struct bead_text_style style = {
        .family = look->family, .size = look->label, .colour = look->faint, .across = BEAD_ALIGN_END, .down = BEAD_ALIGN_BASELINE};
    char markup[2100];
    double width, height, taken;
    bead_axis_title(axis, title, markup, sizeof markup);
    bead_text_size(cr, &style, markup, &taken, &height);
    bead_text_size(cr, &style, remark, &width, &height);
    if (setup->titles == BEAD_TITLES_ABOVE && !setup->ticks_only && taken + width + look->label < plot.width + setup->coloured)
        bead_text_draw(cr, &style, plot.x + plot.width, plot.y - title_rise * look->label, remark);
}

static struct bead_text_style name_style(const struct bead_look *look)
{
    return (struct bead_text_style){
        .family = look->family, .size = look->label, .colour = look->ink, .across = BEAD_ALIGN_END, .down = BEAD_ALIGN_BASELINE};
}

double bead_panel_name_room(const struct bead_look *look, const char *title)
{
    struct bead_axis plain = {.unit = ""};
    struct bead_text_style style = name_style(look);
    char markup[2100];
    double width, height;
    bead_axis_title(&plain, title, markup, sizeof markup);
    bead_text_size(NULL, &style, markup, &width, &height);
    return width + name_gap * look->tick;
}

/* Room that the numbers of the axis need left of the panel, px. */
static double number_reach(const struct bead_look *look, const struct bead_axis *axis, struct bead_rect plot)
{
    struct bead_text_style style = {.family = look->family, .size = look->tick};
    double reach = 0, width, height;
    for (size_t i = 0; axis && i < axis->count; i++) {
        bead_text_size(NULL, &style, axis->ticks[i].label, &width, &height);
        reach = fmax(reach, 0.5 * width - axis->ticks[i].place * plot.width);
    }
    return reach;
}

void bead_panel_name(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                     const char *title)
{
    const struct bead_look *look = setup->look;
    double gap = fmax(name_gap * look->tick, number_reach(look, axis, plot) + least_gap * look->tick);
    struct bead_axis plain = {.unit = ""};
    struct bead_text_style style = name_style(look);
    char markup[2100];
    if (setup->ticks_only)
        return;
    bead_axis_title(&plain, title, markup, sizeof markup);
    bead_text_draw(cr, &style, plot.x - setup->beyond[0] - setup->coloured - gap,
                   plot.y + plot.height + look->line + name_drop * look->tick, markup);
}

void bead_panel_chain_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot,
                           const char *title)
{
    bead_axis_draw(cr, setup->look, axis, plot, BEAD_SIDE_BOTTOM, false, title != NULL, setup->name_left ? NULL : title);
    if (title && setup->name_left)
        bead_panel_name(cr, setup, axis, plot, title);
}

void bead_panel_time_axis(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_axis *axis, struct bead_rect plot)
{
    bead_axis_draw(cr, setup->look, axis, plot, BEAD_SIDE_BOTTOM, false, !setup->time_shared,
                   setup->titles == BEAD_TITLES_NONE || setup->against ? NULL : "time");
}

const char *bead_axis_along_chain(struct bead_axis *axis, const struct bead_chain *chain, bool of_contacts, size_t first,
                                  size_t last, double length, double em, bool horizontal)
{
    const struct bead_chain_axis along = bead_chain_axis(chain, of_contacts);
    double low = along.first + ((double)first - 0.5) * along.spacing, high = along.first + ((double)last + 0.5) * along.spacing;
    const bool points = strcmp(along.unit, "1") != 0;
    if (points && 0.5 * along.spacing / (high - low) * length < same_pixel) /* half a cell from a round number: 2, not 1.998 */
        high += 0.5 * along.spacing;
    bead_axis_make(axis, low, high, along.unit, BEAD_SCALE_LINEAR, length, em, horizontal);
    return along.title;
}
