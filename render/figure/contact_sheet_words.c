/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact sheets: the words that explain them, names of rows, and the colours of spins. */
#include <math.h>
#include <stdio.h>

#include "render/draw/markup.h"
#include "render/draw/names.h"
#include "render/draw/quantity.h"
#include "render/draw/words.h"
#include "render/figure/contact_sheet.h"

/* Colours of the spins, from those of curves: up is pale, reversed is strong. */
enum { REVERSED = 1 };
static const double up_part = 0.45; /* share of ink in the colour of cells that are up */

struct bead_rgb contact_sheet_mix(struct bead_rgb a, struct bead_rgb b, double part)
{
    return (struct bead_rgb){a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b)};
}

struct bead_rgb contact_sheet_spin_colour(const struct contact_sheet *s, int spin)
{
    return spin == 1   ? contact_sheet_mix(s->look.background, s->look.faint, up_part)
           : spin == 0 ? bead_look_curve(&s->look, REVERSED)
                       : contact_sheet_mix(s->look.background, s->look.faint, 0.15);
}

void contact_sheet_fill(cairo_t *cr, struct bead_rgb colour, double x, double y, double width, double height)
{
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
    cairo_rectangle(cr, x, y, width, height);
    cairo_fill(cr);
}

static void draw_square(const struct contact_sheet *s, cairo_t *cr, int spin, double x, double middle)
{
    double side = 0.75 * s->look.tick;
    contact_sheet_fill(cr, contact_sheet_spin_colour(s, spin), x, middle - side / 2, side, side);
}

/* "[] cell as written  [] reversed"; returns the height. */
static double draw_key(const struct contact_sheet *s, cairo_t *cr, double x, double y)
{
    static const char *const words[] = {"cell as written", "reversed cell"};
    double width, height = 0;
    for (int i = 0; i < 2; i++) {
        const struct bead_text_style style = bead_words_style(&s->look, s->look.tick, s->look.ink, BEAD_ALIGN_MIDDLE);
        bead_text_size(NULL, &style, words[i], &width, &height);
        if (cr) {
            draw_square(s, cr, 1 - i, x, y + height / 2);
            bead_text_draw(cr, &style, x + 1.1 * s->look.tick, y + height / 2, words[i]);
        }
        x += width + 2.8 * s->look.tick;
    }
    return height;
}

static double draw_lines(cairo_t *cr, const struct bead_text_style *style, double width, double x, double y, const char *markup)
{
    double wide, high;
    bead_text_size_lines(NULL, style, width, markup, &wide, &high);
    if (cr)
        bead_text_draw_lines(cr, style, width, x, y, markup);
    return high;
}

double contact_sheet_intro(const struct contact_sheet *s, cairo_t *cr, double width)
{
    const struct bead_look *look = &s->look;
    const struct bead_text_style line = bead_words_style(look, look->tick, look->faint, BEAD_ALIGN_START);
    struct bead_text_style title = bead_words_style(look, look->title, look->ink, BEAD_ALIGN_START);
    const char *own = bead_sweep_scene(s->sweep)->title;
    char text[2048], end[64];
    double y = s->intro.y, start = y;
    title.bold = true;
    if (*own) {
        bead_text_escape(own, text, sizeof text);
        y += draw_lines(cr, &title, width, s->intro.x, y, text) + 0.4 * look->gap;
    }
    bead_quantity(s->end > 0 ? s->end : 1.234e-3, "s", 3, end, sizeof end);
    y += draw_key(s, cr, s->intro.x, y) + 0.5 * look->gap;
    const bool down = s->orientation == BEAD_TIME_DOWN;
    snprintf(
        text, sizeof text,
        "Pictures: %s from %s, time from 0 to %s %s. Numbers: configuration; " BEAD_SYMBOL("F") ", peak force%s; " BEAD_SYMBOL(
            "P") ", beads that share the energy as the front arrives; " BEAD_SYMBOL("C") " and the line under the picture, "
                                                                                         "clean index: 1 clean, 0 delocalised.",
        s->of_contacts ? "contacts" : "beads",
        down                            ? "left to right"
        : s->orientation == BEAD_MATRIX ? "top to bottom"
                                        : "bottom to top",
        end, down ? "downwards" : "to the right", s->behind ? " behind the random cells" : "");
    y += draw_lines(cr, &line, width, s->intro.x, y, text);
    return y - start;
}

void contact_sheet_row_name(const struct contact_sheet *s, const struct contact_row *row, char *text, size_t size)
{
    char name[256] = "";
    if (s->several)
        bead_text_escape(bead_sweep_panel(s->sweep, row->panel)->spec->title, name, sizeof name);
    if (isnan(row->magnetism)) {
        snprintf(text, size, "%s", name);
        return;
    }
    int decimals = 0;
    char number[32];
    for (size_t i = 0; i < s->row_count; i++) {
        const int digits = isnan(s->rows[i].magnetism) ? 0 : bead_magnetism_digits(s->rows[i].magnetism);
        decimals = digits > decimals ? digits : decimals;
    }
    bead_number(row->magnetism, decimals, number, sizeof number);
    snprintf(text, size, "%s%s" BEAD_SYMBOL("M") " = %s", name, *name ? "\n" : "", number);
}
