/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks: fonts, sizes and colours of paper, slide, screen and movie. Every picture takes its look from here. */
#include "render/draw/axis.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/draw/looks.h"

/* In units of the label's font size. */
static const double paper_margin = 0.35, screen_margin = 1.3;

static double whole(double px)
{
    return fmax(1, round(px));
}

void bead_look_paper(struct bead_look *look, double dpi)
{
    double pt = dpi / 72;
    *look = (struct bead_look){
        .title = 8 * pt,
        .label = 8 * pt,
        .tick = 8 * pt,
        .line = whole(0.5 * pt),
        .gap = 4 * pt,
        .margin = round(paper_margin * 8 * pt),
        .background = {1, 1, 1},
        .panel = {0.94, 0.94, 0.94},
        .ink = {0, 0, 0},
        .faint = {0.35, 0.35, 0.35},
        .accent = {0.11, 0.31, 0.55},
        .axis = {0, 0, 0},
    };
    snprintf(look->family, sizeof look->family, "STIX");
}

void bead_look_darken(struct bead_look *look)
{
    look->dark = true;
    look->background = (struct bead_rgb){0.051, 0.059, 0.078};
    look->panel = (struct bead_rgb){0.078, 0.090, 0.122};
    look->ink = (struct bead_rgb){0.91, 0.92, 0.94};
    look->faint = (struct bead_rgb){0.60, 0.63, 0.68};
    look->accent = (struct bead_rgb){0.96, 0.76, 0.31};
    look->axis = (struct bead_rgb){0.42, 0.44, 0.49};
}

void bead_look_screen(struct bead_look *look, int width, int height, bool dark)
{
    double size = fmin(height, 0.75 * width);
    *look = (struct bead_look){
        .title = fmax(13, 0.030 * size),
        .label = fmax(11, 0.0225 * size),
        .tick = fmax(10, 0.0205 * size),
        .line = whole(size / 800),
        .gap = fmax(5, 0.012 * size),
        .margin = round(screen_margin * fmax(11, 0.0225 * size)),
        .background = {1, 1, 1},
        .panel = {0.945, 0.95, 0.96},
        .ink = {0.13, 0.14, 0.17},
        .faint = {0.40, 0.42, 0.46},
        .accent = {0.70, 0.31, 0.05},
        .axis = {0.40, 0.42, 0.46},
    };
    if (dark)
        bead_look_darken(look);
    snprintf(look->family, sizeof look->family, "Lato");
}

/* px: of legible type. */
static const double least_label = 11, least_title = 13;

/* Labels, ticks and the facts have one size; titles and captions are larger. Upright frames are seen on phones, a third as wide as
 * a screen. Floors keep type readable in small frames. */
void bead_look_film(struct bead_look *look, int width, int height, bool dark, bool large)
{
    const bool phone = height >= 1.25 * width;
    double side = fmin(height, width), part = phone ? (large ? 0.06 : 0.05) : large ? 0.04 : 0.03;
    bead_look_screen(look, width, height, dark);
    look->label = look->tick = fmax(least_label, part * side);
    look->title = fmax(least_title, 1.15 * part * side);
    look->line = whole(side / 800);
    look->gap = fmax(5, 0.012 * side);
    look->margin = round(look->gap);
}

void bead_look_type(struct bead_look *look, double part)
{
    look->label = look->tick = fmax(least_label, part * look->label);
    look->title = fmax(least_title, part * look->title);
}

double bead_look_least_type(const struct bead_look *look)
{
    return least_label / look->label;
}

/* Legible from the back of a room: type 1/28 of the height. */
void bead_look_slide(struct bead_look *look, int width, int height, bool dark)
{
    static const double larger = 1.6;
    bead_look_screen(look, width, height, dark);
    look->title *= 0.8 * larger;
    look->label *= larger;
    look->tick *= 0.95 * larger;
    look->line = whole(1.5 * look->line);
    look->gap *= larger;
    look->margin = round(screen_margin * look->label);
}

void bead_look_font(struct bead_look *look, const char *family)
{
    if (family && strcmp(family, "auto") != 0)
        snprintf(look->family, sizeof look->family, "%s", family);
}

void bead_rgb_set(cairo_t *cr, struct bead_rgb colour)
{
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
}

struct bead_rgb bead_rgb_mix(struct bead_rgb a, struct bead_rgb b, double part)
{
    return (struct bead_rgb){a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b)};
}

struct bead_rgb bead_look_ground(const struct bead_look *look)
{
    return look->dark ? look->panel : look->background;
}

void bead_look_paint(const struct bead_look *look, cairo_t *cr)
{
    if (look->clear)
        return;
    bead_rgb_set(cr, look->background);
    cairo_paint(cr);
}

void bead_look_paint_panel(const struct bead_look *look, cairo_t *cr, double x, double y, double width, double height)
{
    if (look->clear)
        return;
    bead_rgb_set(cr, look->panel);
    cairo_rectangle(cr, x, y, width, height);
    cairo_fill(cr);
}

/* First row for light, second for dark backgrounds; any two differ by 12 or more (CIEDE2000) for eyes that lack red, green or blue,
 * each has a contrast of 4.5, as letters need. */
static const struct bead_rgb inks[2][6] = {
    {{0.02, 0.34, 0.81}, {0.74, 0.28, 0.05}, {0.17, 0.40, 0.27}, {0.64, 0.01, 0.52}, {0.43, 0.42, 0.43}, {0.24, 0.16, 0.11}},
    {{0.22, 0.57, 0.98}, {0.99, 0.58, 0.31}, {0.08, 0.83, 0.65}, {0.91, 0.68, 0.95}, {0.89, 0.28, 0.34}, {0.94, 0.99, 0.67}},
};

struct bead_rgb bead_look_curve(const struct bead_look *look, size_t index)
{
    return inks[look->dark][index % (sizeof inks[0] / sizeof inks[0][0])];
}

/* Solid, dashed, dash-dot, short dashes, long dashes, dash-dot-dot; dotted. */
static const struct bead_dashes dashes[] = {{0, {0}},        {2, {5.5, 2.5}}, {4, {6, 2, 1.3, 2}},
                                            {2, {2.5, 1.8}}, {2, {12, 2.8}},  {6, {6, 1.8, 1.3, 1.8, 1.3, 1.8}},
                                            {2, {1.2, 1.8}}};
static_assert(sizeof dashes / sizeof dashes[0] == BEAD_DASHES + 1, "patterns of dashes");

const struct bead_dashes *bead_look_dashes(size_t index)
{
    return &dashes[index % (BEAD_DASHES + 1)];
}
