/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws axes: line, ticks, labels and title, and measures their reach. Without a context it only measures, for layouts. */
#include <math.h>
#include <stdio.h>

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/draw/markup.h"

/* In units of the ticks' font size. */
static const double tick_length = 0.38, minor_length = 0.55 /* of a tick */, label_gap = 0.3, digit_height = 0.7, title_gap = 0.45;
/* Limits of titles: sizes, lines. */
static const double little_smaller = 0.85, smallest_title = 0.72, most_lines = 3.2, line_height = 1.3;

void bead_box_draw(cairo_t *cr, const struct bead_look *look, struct bead_rect plot)
{
    cairo_set_source_rgb(cr, look->axis.r, look->axis.g, look->axis.b);
    cairo_set_line_width(cr, look->line);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    cairo_rectangle(cr, plot.x - look->line / 2, plot.y - look->line / 2, plot.width + look->line, plot.height + look->line);
    cairo_stroke(cr);
}

/* The nearest coordinate at which a line of this width covers whole pixels. */
static double crisp(double at, double line)
{
    return round(at - line / 2) + line / 2;
}

struct drawing {
    cairo_t *cr; /* NULL: measure only */
    const struct bead_look *look;
    const struct bead_axis *axis;
    struct bead_rect plot;
    enum bead_side side;
    bool downwards;
    double edge;   /* px: outer edge of the box's line on this side */
    double length; /* of ticks */
};

/* The direction away from the plot, along x. */
static double outwards(const struct drawing *d)
{
    return d->side == BEAD_SIDE_LEFT ? -1 : 1;
}

static double along(const struct drawing *d, double place)
{
    if (d->side == BEAD_SIDE_BOTTOM)
        return d->plot.x + place * d->plot.width;
    return d->downwards ? d->plot.y + place * d->plot.height : d->plot.y + (1 - place) * d->plot.height;
}

static void draw_tick(const struct drawing *d, double place, double length)
{
    double at = crisp(along(d, place), d->look->line);
    if (d->side == BEAD_SIDE_BOTTOM) {
        cairo_move_to(d->cr, at, d->edge);
        cairo_rel_line_to(d->cr, 0, length);
    } else {
        cairo_move_to(d->cr, d->edge, at);
        cairo_rel_line_to(d->cr, outwards(d) * length, 0);
    }
}

static void draw_ticks(const struct drawing *d)
{
    cairo_set_source_rgb(d->cr, d->look->axis.r, d->look->axis.g, d->look->axis.b);
    cairo_set_line_width(d->cr, d->look->line);
    for (size_t i = 0; i < d->axis->count; i++)
        draw_tick(d, d->axis->ticks[i].place, d->length);
    for (size_t i = 0; i < d->axis->minor_count; i++)
        draw_tick(d, d->axis->minor[i], round(minor_length * d->length));
    cairo_stroke(d->cr);
}

static struct bead_text_style tick_style(const struct drawing *d)
{
    enum bead_align across[] = {
        [BEAD_SIDE_LEFT] = BEAD_ALIGN_END, [BEAD_SIDE_BOTTOM] = BEAD_ALIGN_MIDDLE, [BEAD_SIDE_RIGHT] = BEAD_ALIGN_START};
    return (struct bead_text_style){.family = d->look->family,
                                    .size = d->look->tick,
                                    .colour = d->look->ink,
                                    .across = across[d->side],
                                    .down = d->side == BEAD_SIDE_BOTTOM ? BEAD_ALIGN_BASELINE : BEAD_ALIGN_MIDDLE};
}

/* Returns the labels' reach beyond the ticks. */
static double draw_labels(const struct drawing *d)
{
    struct bead_text_style style = tick_style(d);
    double em = d->look->tick, widest = 0;
    for (size_t i = 0; i < d->axis->count; i++) {
        double width, height, at = along(d, d->axis->ticks[i].place);
        const char *label = d->axis->ticks[i].label;
        bead_text_size(d->cr, &style, label, &width, &height);
        widest = fmax(widest, width);
        if (!d->cr)
            continue;
        if (d->side == BEAD_SIDE_BOTTOM)
            bead_text_draw(d->cr, &style, at, d->edge + d->length + (label_gap + digit_height) * em, label);
        else
            bead_text_draw(d->cr, &style, d->edge + outwards(d) * (d->length + label_gap * em), at, label);
    }
    if (d->axis->count == 0)
        return 0;
    return label_gap * em + (d->side == BEAD_SIDE_BOTTOM ? digit_height * em : widest);
}

static bool fits(const struct drawing *d, const struct bead_text_style *style, double wrap, const char *markup, double room,
                 double most)
{
    double width, height;
    bead_text_size_lines(d->cr, style, wrap, markup, &width, &height);
    return width <= room * (1 + 1e-6) && height <= most;
}

/* Do lines of this width break no word? */
static bool words_fit(const struct drawing *d, const struct bead_text_style *style, const char *markup, double room)
{
    while (*markup) {
        char word[512];
        size_t length = 0;
        for (bool tag = false; markup[length] && (tag || markup[length] != ' '); length++)
            tag = markup[length] == '<' || (tag && markup[length] != '>');
        snprintf(word, sizeof word, "%.*s", (int)length, markup);
        if (!fits(d, style, 0, word, room, INFINITY))
            return false;
        markup += length + (markup[length] == ' ');
    }
    return true;
}

static void title_of(const struct bead_axis *axis, const char *title, const char *space, char *out, size_t size)
{
    char name[2048], symbols[512];
    bead_markup_symbols(title, symbols, sizeof symbols);
    bead_markup(symbols, name, sizeof name);
    snprintf(out, size, *axis->unit ? "%s%s(%s)" : "%s", name, space, axis->unit);
}

void bead_axis_title(const struct bead_axis *axis, const char *title, char *out, size_t size)
{
    title_of(axis, title, " ", out, size);
}

/* Shrinks a title to the room, down to `least` of its full size. */
static bool shrink(const struct drawing *d, double least, double room, const char *markup, struct bead_text_style *style)
{
    double width, height;
    style->size = d->look->label;
    bead_text_size(d->cr, style, markup, &width, &height);
    style->size *= fmin(1, fmax(least, 0.99 * room / width)); /* widths are not quite proportional to the size */
    return fits(d, style, 0, markup, room, INFINITY);
}

/* Finds a title that fits: a little smaller, then in lines (*wrap) that neither break words nor separate name and unit, then small,
 * then only its unit, then none. */
static bool fit_title(const struct drawing *d, const char *title, struct bead_text_style *style, double *wrap, char *markup,
                      size_t size)
{
    double room = d->side == BEAD_SIDE_BOTTOM ? d->plot.width : d->plot.height;
    bead_axis_title(d->axis, title, markup, size);
    if (shrink(d, little_smaller, room, markup, style))
        return true;
    style->size = d->look->label;
    *wrap = room;
    title_of(d->axis, title, "\u00a0", markup, size);
    if (words_fit(d, style, markup, room) && fits(d, style, room, markup, room, most_lines * line_height * style->size))
        return true;
    *wrap = 0;
    bead_axis_title(d->axis, title, markup, size);
    if (shrink(d, smallest_title, room, markup, style))
        return true;
    if (*d->axis->unit)
        snprintf(markup, size, "%s", d->axis->unit);
    return shrink(d, smallest_title, room, markup, style);
}

static double one_line(const struct drawing *d, const struct bead_text_style *style)
{
    double width, height;
    bead_text_size(d->cr, style, "0", &width, &height);
    return height;
}

/* `out`: reach of ticks and labels. Returns the title's reach. */
static double draw_title(const struct drawing *d, double out, const char *title)
{
    char markup[2100];
    double em = d->look->label, wrap = 0, width, height;
    bool vertical = d->side != BEAD_SIDE_BOTTOM;
    struct bead_text_style style = {.family = d->look->family,
                                    .size = em,
                                    .colour = d->look->ink,
                                    .across = BEAD_ALIGN_MIDDLE,
                                    .down = vertical ? BEAD_ALIGN_MIDDLE : BEAD_ALIGN_BASELINE,
                                    .upwards = vertical};
    if (!fit_title(d, title, &style, &wrap, markup, sizeof markup))
        return out;
    bead_text_size_lines(d->cr, &style, wrap, markup, &width, &height);
    double lines = wrap > 0 ? height - one_line(d, &style) : 0;
    double thickness = vertical ? height : 0.98 * em + lines;
    if (!d->cr)
        return out + title_gap * em + thickness;
    if (vertical)
        bead_text_draw_lines(d->cr, &style, wrap, d->edge + outwards(d) * (out + title_gap * em + thickness / 2),
                             d->plot.y + d->plot.height / 2.0, markup);
    else
        bead_text_draw_lines(d->cr, &style, wrap, d->plot.x + d->plot.width / 2.0, d->edge + out + title_gap * em + 0.75 * em,
                             markup);
    return out + title_gap * em + thickness;
}

double bead_axis_draw(cairo_t *cr, const struct bead_look *look, const struct bead_axis *axis, struct bead_rect plot,
                      enum bead_side side, bool downwards, bool labels, const char *title)
{
    double edges[] = {[BEAD_SIDE_LEFT] = plot.x - look->line,
                      [BEAD_SIDE_BOTTOM] = plot.y + plot.height + look->line,
                      [BEAD_SIDE_RIGHT] = plot.x + plot.width + look->line};
    struct drawing d = {cr, look, axis, plot, side, downwards, edges[side], round(tick_length * look->tick)};
    double out = axis->count ? d.length : 0;
    if (cr)
        draw_ticks(&d);
    if (labels) {
        out += draw_labels(&d);
        if (title)
            out = draw_title(&d, out, title);
    }
    return out + look->line;
}
