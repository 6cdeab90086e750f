/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact drawn to scale: two beads, or a bead and the wall, cut along their axis and pressed together as the output asks. The
 * outlines meet in a chord of half length q; each bead is flattened by delta_i = R_i - sqrt(R_i^2 - q^2), for small q about q^2 /
 * (2 R_i): Hertz's share of the compression (thesis, 2.1 and Fig. 2). */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "beadreel/law.h"
#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/schematic/schematic.h"
#include "render/schematic/schematic_sketch.h"

/* In units of the label's font size: rows above and below the beads, and distances. */
static const double names_row = 1.9, dimensions_row = 3.0, near = 0.95, right_angle = 0.4;
/* Of a bead this many times larger than the other, only this many radii of the other are shown. */
static const double whole = 2.2, shown = 1.5;
/* Thickness of the wall, in radii of the bead. */
static const double thickness = 0.3;

struct side {
    const struct bead_material *material; /* NULL: rigid wall */
    bool wall, cut;                       /* cut: not shown whole */
    int index;                            /* of its symbols; 0: the beads are alike, or there is only one */
    double sign;                          /* -1: left of the chord */
    double radius, flattened, extent;     /* m; extent: from the chord outwards */
    double x, r;                          /* px: centre, radius */
};

struct contact {
    const struct bead_drafting *d;
    struct side side[2];
    size_t number; /* of the contact in its chain */
    double half_chord;
    double chord_x, y, q, scale; /* px; px a metre */
};

static size_t chosen_contact(const struct bead_drafting *d)
{
    const struct bead_chain *chain = d->context->chains[0];
    size_t contacts = bead_chain_contacts(chain);
    if (d->output->plot.contact < contacts)
        return d->output->plot.contact;
    return contacts > 1 && bead_chain_beads(chain) > 2 ? 1 : 0;
}

static void find_sides(struct contact *c)
{
    const struct bead_chain *chain = c->d->context->chains[0];
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const struct bead_scene *scene = c->d->context->scene;
    size_t beads = bead_chain_beads(chain), k = c->number = chosen_contact(c->d);
    for (size_t i = 0; i < 2; i++) {
        struct side *s = &c->side[i];
        s->sign = i == 0 ? -1 : 1;
        s->wall = k + i >= beads;
        if (!s->wall)
            s->material = &scene->materials[bead_chain_material(chain)[k + i]];
        else if (spec->wall == BEAD_WALL_MATERIAL)
            s->material = &scene->materials[spec->wall_material];
        s->radius = s->wall ? INFINITY : bead_chain_radius(chain)[k + i];
    }
    bool alike = c->side[0].radius == c->side[1].radius;
    double small = fmin(c->side[0].radius, c->side[1].radius), part = 1 - c->d->output->plot.compression;
    c->half_chord = small * sqrt(1 - part * part);
    for (size_t i = 0; i < 2; i++) {
        struct side *s = &c->side[i];
        s->index = alike || c->side[1].wall ? 0 : (int)i + 1;
        s->flattened = s->wall ? 0 : s->radius - sqrt(s->radius * s->radius - c->half_chord * c->half_chord);
        s->cut = !s->wall && s->radius > whole * small;
        s->extent = s->wall ? thickness * small : s->cut ? shown * small : 2 * s->radius - s->flattened;
    }
}

static bool contact_find_places(struct contact *c, struct bead_box *area)
{
    double em = c->d->sketch->look->label, half = 0;
    for (size_t i = 0; i < 2; i++)
        half = fmax(half, c->side[i].cut || c->side[i].wall ? 0 : c->side[i].radius);
    double height = area->height - (names_row + dimensions_row) * em, width = c->side[0].extent + c->side[1].extent;
    if (!(height > 0))
        return false;
    c->scale = fmin(height / (2 * half), area->width / width);
    c->chord_x = area->x + 0.5 * (area->width - c->scale * width) + c->scale * c->side[0].extent;
    c->y = area->y + names_row * em + 0.5 * height;
    c->q = c->scale * c->half_chord;
    for (size_t i = 0; i < 2; i++) {
        struct side *s = &c->side[i];
        s->r = s->wall ? 0 : c->scale * s->radius;
        s->x = c->chord_x + s->sign * c->scale * (s->wall ? 0 : s->radius - s->flattened);
    }
    *area =
        (struct bead_box){c->chord_x - c->scale * c->side[0].extent, c->y - c->scale * half, c->scale * width, 2 * c->scale * half};
    return true;
}

/* Adds the arc beyond the chord, or the rest of the circle, to the path. */
static void arc(const struct contact *c, const struct side *s, bool beyond)
{
    cairo_t *cr = c->d->sketch->cr;
    double half = asin(fmin(c->q / s->r, 1));
    double towards = s->sign < 0 ? 0 : M_PI;
    if (beyond)
        cairo_arc(cr, s->x, c->y, s->r, towards - half, towards + half);
    else
        cairo_arc(cr, s->x, c->y, s->r, towards + half, towards - half + 2 * M_PI);
}

static void draw_bodies(const struct contact *c, const struct bead_box *area)
{
    struct bead_sketch *sketch = c->d->sketch;
    cairo_t *cr = sketch->cr;
    const struct bead_look *look = sketch->look;
    double grey = look->dark ? 0.40 : 0.66, rim = 2 * look->line;
    cairo_save(cr);
    cairo_rectangle(cr, area->x - rim, area->y - rim, area->width + 2 * rim, area->height + 2 * rim);
    cairo_clip(cr);
    for (size_t i = 0; i < 2; i++) {
        const struct side *s = &c->side[i];
        if (s->wall) {
            bead_sketch_hatch(sketch, (struct bead_box){c->chord_x, area->y, c->scale * s->extent, area->height},
                              s->material ? s->material->colour : NULL);
            continue;
        }
        cairo_new_path(cr);
        arc(c, s, false);
        cairo_close_path(cr);
        const double *own = s->material->colour;
        bead_sketch_colour(sketch, bead_sketch_mixed(look, (struct bead_rgb){own[0], own[1], own[2]}, 0.45));
        cairo_fill(cr);
    }
    for (size_t i = 0; i < 2; i++) { /* deformed */
        if (c->side[i].wall)
            continue;
        cairo_new_path(cr);
        arc(c, &c->side[i], true);
        cairo_close_path(cr);
        bead_sketch_colour(sketch, (struct bead_rgb){grey, grey, grey});
        cairo_fill(cr);
    }
    cairo_set_line_width(cr, 1.6 * look->line);
    for (size_t i = 0; i < 4; i++) {
        const struct side *s = &c->side[i / 2];
        if (s->wall)
            continue;
        bead_sketch_colour(sketch, i % 2 ? look->faint : look->ink);
        bead_sketch_dashed(sketch, i % 2);
        cairo_new_path(cr);
        arc(c, s, i % 2);
        cairo_stroke(cr);
    }
    bead_sketch_dashed(sketch, false);
    bead_sketch_colour(sketch, look->ink);
    if (c->side[1].wall)
        bead_sketch_line(sketch, c->chord_x, area->y, c->chord_x, area->y + area->height);
    cairo_restore(cr);
}

static void put_symbol(const struct contact *c, const char *letter, int index, double x, double y, enum bead_align across)
{
    struct bead_text_style style = bead_sketch_style(c->d->sketch, c->d->sketch->look->label);
    char markup[160];
    bead_symbol_words(letter, index, markup, sizeof markup);
    style.across = across;
    bead_sketch_text(c->d->sketch, &style, x, y, markup);
}

/* Draws the triangle of centre, foot and end of the chord. */
static void draw_triangle(const struct contact *c, const struct side *s)
{
    const struct side *other = &c->side[s == &c->side[0]];
    struct bead_sketch *sketch = c->d->sketch;
    double em = sketch->look->label, foot = c->chord_x, top = c->y - c->q, square = right_angle * em;
    double run = foot - s->x, length = hypot(run, c->q), up_x = -c->q / length * (run > 0 ? 1 : -1), up_y = -fabs(run) / length;
    char leg[400], radius[160], flat[160];
    struct bead_text_style style = bead_sketch_style(sketch, em);
    bead_sketch_colour(sketch, sketch->look->accent);
    cairo_set_line_width(sketch->cr, 1.4 * sketch->look->line);
    bead_sketch_line(sketch, s->x, c->y, foot, c->y);
    bead_sketch_line(sketch, s->x, c->y, foot, top);
    bead_sketch_line(sketch, foot, c->y - square, foot + s->sign * square, c->y - square);
    bead_sketch_line(sketch, foot + s->sign * square, c->y - square, foot + s->sign * square, c->y);
    cairo_new_path(sketch->cr);
    cairo_arc(sketch->cr, s->x, c->y, 0.12 * em, 0, 2 * M_PI);
    cairo_fill(sketch->cr);
    put_symbol(c, "R", s->index, 0.5 * (s->x + foot) + near * em * up_x, 0.5 * (c->y + top) + near * em * up_y, BEAD_ALIGN_MIDDLE);
    bead_symbol_words("R", s->index, radius, sizeof radius);
    bead_symbol_words("δ", s->index, flat, sizeof flat);
    snprintf(leg, sizeof leg, "%s − %s", radius, flat);
    style.across = BEAD_ALIGN_MIDDLE;
    /* Clear of the other bead's outline. */
    double clear = foot + s->sign * (c->scale * other->flattened + 0.3 * em), half = 0.5 * bead_sketch_width(&style, leg);
    double middle = 0.5 * (s->x + foot + s->sign * c->scale * other->flattened);
    middle = s->sign < 0 ? fmin(middle, clear - half) : fmax(middle, clear + half);
    bead_sketch_text(sketch, &style, middle, c->y + 0.85 * em, leg);
}

static void draw_chord(const struct contact *c)
{
    struct bead_sketch *sketch = c->d->sketch;
    double em = sketch->look->label;
    bead_sketch_colour(sketch, sketch->look->accent);
    cairo_set_line_width(sketch->cr, 2 * sketch->look->line);
    bead_sketch_line(sketch, c->chord_x, c->y - c->q, c->chord_x, c->y + c->q);
    /* Beside the chord if there is room within the other bead's outline, else beside the outline. */
    const double up = 0.42, outline = c->scale * c->side[1].flattened * (1 - up * up);
    double x = c->chord_x - (outline > 1.1 * em ? 0 : outline) - 0.35 * em;
    put_symbol(c, "r̃", 0, x, c->y - up * c->q, BEAD_ALIGN_END);
}

/* Draws the dimension of each bead's flattening below it, from the chord to its original outline. */
static bool draw_dimensions(const struct contact *c, const struct bead_box *area)
{
    struct bead_sketch *sketch = c->d->sketch;
    double em = sketch->look->label, y = area->y + area->height + 0.9 * em, ends[3] = {c->chord_x, c->chord_x, c->chord_x};
    struct bead_text_style style = bead_sketch_style(sketch, em);
    struct bead_label labels[2];
    char markup[2][160];
    size_t count = 0;
    for (size_t i = 2; i-- > 0;) { /* the right bead's lies left of the chord */
        const struct side *s = &c->side[i];
        if (s->wall)
            continue;
        ends[s->sign < 0 ? 2 : 0] = s->x - s->sign * s->r;
        bead_symbol_words("δ", s->index, markup[count], sizeof markup[count]);
        labels[count] =
            (struct bead_label){0.5 * (c->chord_x + s->x - s->sign * s->r), bead_sketch_width(&style, markup[count]), 0};
        count++;
    }
    cairo_set_line_width(sketch->cr, sketch->look->line);
    bead_sketch_colour(sketch, sketch->look->faint);
    for (size_t i = 0; i < 3; i++) {
        if (i == 1 || ends[i] != c->chord_x)
            bead_sketch_line(sketch, ends[i], i == 1 ? c->y + c->q + 0.3 * em : c->y, ends[i], y + 0.35 * em);
    }
    bead_sketch_colour(sketch, sketch->look->ink);
    const double arrows = 1.3 * em; /* room for two heads */
    bool inside = true;
    for (size_t i = 0; i < 2; i++)
        inside = inside && (ends[i + 1] == ends[i] || ends[i + 1] - ends[i] > arrows);
    for (size_t i = 0; inside && i < 2; i++)
        bead_sketch_arrow(sketch, ends[i], y, ends[i + 1], y, true);
    if (!inside) {
        bead_sketch_line(sketch, ends[0], y, ends[2], y);
        bead_sketch_arrow(sketch, ends[0] - arrows, y, ends[0], y, false);
        bead_sketch_arrow(sketch, ends[2] + arrows, y, ends[2], y, false);
    }
    if (!bead_labels_spread(labels, count, 0.5 * em, area->x, area->x + area->width))
        return false;
    for (size_t i = 0; i < count; i++)
        bead_sketch_text(sketch, &style, labels[i].x, y + 1.1 * em, markup[i]);
    return true;
}

static void side_name(const struct bead_chain *chain, const struct side *s, char *out, size_t size)
{
    char name[96];
    if (s->wall)
        bead_wall_name(chain, name, sizeof name);
    bead_text_escape(s->wall ? name : s->material->label, out, size);
}

static bool contact_draw_names(const struct contact *c, const struct bead_box *area, const struct bead_box *page)
{
    struct bead_sketch *sketch = c->d->sketch;
    struct bead_text_style style = bead_sketch_style(sketch, sketch->look->label);
    struct bead_label labels[2];
    char markup[2][200];
    for (size_t i = 0; i < 2; i++) {
        const struct side *s = &c->side[i];
        side_name(c->d->context->chains[0], s, markup[i], sizeof markup[i]);
        double at = s->wall || s->cut ? c->chord_x + 0.5 * s->sign * c->scale * s->extent : s->x;
        labels[i] = (struct bead_label){at, bead_sketch_width(&style, markup[i]), 0};
    }
    if (!bead_labels_spread(labels, 2, 1.2 * style.size, page->x, page->x + page->width))
        return false;
    for (size_t i = 0; i < 2; i++)
        bead_sketch_text(sketch, &style, labels[i].x, area->y - 0.95 * style.size, markup[i]);
    return true;
}

/* "7.0 × 10^9" */
static void contact_power_of_ten(double value, char *out, size_t size)
{
    int exponent = value > 0 ? (int)floor(log10(value)) : 0;
    if (exponent >= -2 && exponent <= 3)
        snprintf(out, size, "%.4g", value);
    else
        snprintf(out, size, "%.3f × 10^{%d}", value / pow(10, exponent), exponent);
}

/* Makes a piece of a formula in the syntax of bead_markup. */
BEAD_PRINTF(2, 3) static void put_piece(struct bead_piece *piece, const char *format, ...)
{
    char text[256];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    bead_markup(text, piece->markup, sizeof piece->markup);
}

enum { PIECES = 8 };

static size_t write_pieces(const struct contact *c, struct bead_piece pieces[PIECES])
{
    const struct side *a = &c->side[0], *b = &c->side[1], *small = a->radius <= b->radius ? a : b;
    const struct bead_chain *chain = c->d->context->chains[0];
    char length[48], number[64];
    size_t n = 0;
    const struct bead_law *law = bead_chain_spec(chain)->law.row;
    bool two = a->index > 0;
    const char *of_small = !two ? "" : small == a ? "_1" : "_2";
    put_piece(&pieces[n++], two ? "*r̃*^2 + (*R_i* − *δ_i*)^2 = *R_i*^2" : "*r̃*^2 + (*R* − *δ*)^2 = *R*^2");
    put_piece(&pieces[n++], two ? "*r̃*^2 ≈ 2*R*_1*δ*_1 ≈ 2*R*_2*δ*_2" : "*r̃*^2 = 2*Rδ* − *δ*^2");
    for (size_t i = 0; i < (two ? 2u : 1u); i++) {
        bead_quantity(c->side[i].radius, "m", 3, length, sizeof length);
        put_piece(&pieces[n++], "*R*%s = %s", !two ? "" : i == 0 ? "_1" : "_2", length);
    }
    put_piece(&pieces[n++], "*δ*%s = %.3g *R*%s", of_small, c->d->output->plot.compression, of_small);
    put_piece(&pieces[n++], "*r̃* = %.3g *R*%s", c->half_chord / small->radius, of_small);
    if (law->hertz && !law->as_printed) {
        contact_power_of_ten(bead_chain_stiffness(chain)[c->number], number, sizeof number);
        put_piece(&pieces[n++], "*F* = *A* %s^{3/2}, *A* = %s N/m^{3/2}",
                  two       ? "(*δ*_1 + *δ*_2)"
                  : b->wall ? "*δ*"
                            : "(2*δ*)",
                  number);
    }
    return n;
}

bool bead_schematic_contact(const struct bead_drafting *d)
{
    struct contact c = {.d = d};
    struct bead_piece pieces[PIECES] = {{{0}, NULL}};
    struct bead_box area = d->area, page = d->area;
    find_sides(&c);
    size_t count = write_pieces(&c, pieces);
    if (!bead_sketch_pieces(d->sketch, &area, pieces, count, true) || !contact_find_places(&c, &area))
        return false;
    draw_bodies(&c, &area);
    for (size_t i = 0; i < 2; i++) {
        bool first = i == 0 || c.side[0].index > 0 || c.side[0].cut;
        if (!c.side[i].wall && !c.side[i].cut && first)
            draw_triangle(&c, &c.side[i]);
    }
    draw_chord(&c);
    return draw_dimensions(&c, &area) && contact_draw_names(&c, &area, &page);
}
