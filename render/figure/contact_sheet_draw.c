/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws a contact sheet: pictures, spins, numbers, and the bar of colours. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "render/draw/raster.h"
#include "render/draw/words.h"
#include "render/figure/contact_sheet.h"
#include "render/view/orientation.h"
#include "sim/base/memory.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* Contact sheets: the words that explain them, names of rows, and the colours of spins. */

/* Colours of the spins, from those of curves: up is pale, reversed is strong. */
enum { REVERSED = 1 };
static const double up_part = 0.45; /* share of ink in the colour of cells that are up */

struct bead_rgb contact_sheet_spin_colour(const struct contact_sheet *s, int spin)
{
    return spin == 1   ? bead_rgb_mix(s->look.background, s->look.faint, up_part)
           : spin == 0 ? bead_look_curve(&s->look, REVERSED)
                       : bead_rgb_mix(s->look.background, s->look.faint, 0.15);
}

/* Fills the rectangle from a to b. */
static void contact_sheet_fill(cairo_t *cr, struct bead_rgb colour, double x, double y, double width, double height)
{
    bead_rgb_set(cr, colour);
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

static const struct bead_over *over_of(const struct contact_sheet *s)
{
    return &bead_sweep_panel(s->sweep, 0)->spec->over;
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
    const char *clean = "; " BEAD_SYMBOL("C") " and the line under the picture, clean index: 1 clean, 0 delocalised";
    snprintf(text, sizeof text,
             "Pictures: %s from %s, time from 0 to %s %s. Numbers: configuration; " BEAD_SYMBOL("F") ", peak force%s; " BEAD_SYMBOL(
                 "P") ", beads that share the energy as the front arrives%s.",
             s->of_contacts ? "contacts" : "beads",
             down                            ? "left to right"
             : s->orientation == BEAD_MATRIX ? "top to bottom"
                                             : "bottom to top",
             end, down ? "downwards" : "to the right", s->behind && !over_of(s)->key_count ? " behind the random cells" : "",
             over_of(s)->key_count ? "" : clean);
    y += draw_lines(cr, &line, width, s->intro.x, y, text);
    return y - start;
}

void contact_sheet_row_name(const struct contact_sheet *s, const struct contact_row *row, char *text, size_t size)
{
    char name[256] = "";
    if (s->several)
        bead_text_escape(bead_sweep_panel(s->sweep, row->panel)->spec->title, name, sizeof name);
    if (s->by_key) {
        char values[200] = "";
        bead_sweep_curve_name(s->sweep, 0, row->first, over_of(s)->key_count - 1, values);
        bead_text_escape(values, name, sizeof name);
    }
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

/* ---- words ---- */

/* "seed 3": the last key's value in a configuration, or all keys' values if rows do not have them; "": for spins. */
static void name_values(const struct contact_sheet *s, size_t index, char *text, size_t size)
{
    const struct bead_over *over = over_of(s);
    char name[100], value[150], escaped[200];
    *text = '\0';
    for (size_t k = s->by_key && over->key_count > 0 ? over->key_count - 1 : 0; k < over->key_count; k++) {
        bead_over_key_name(over, k, false, name, sizeof name);
        snprintf(value, sizeof value, "%s %s", name, over->keys[k].text[bead_sweep_value(s->sweep, 0, index, k)]);
        bead_text_escape(value, escaped, sizeof escaped);
        snprintf(text + strlen(text), size - strlen(text), "  %s", escaped);
    }
}

static void draw_row_names(const struct contact_sheet *s, cairo_t *cr)
{
    struct bead_text_style style = bead_words_style(&s->look, s->look.tick, s->look.ink, BEAD_ALIGN_MIDDLE);
    style.bold = true;
    size_t before = (size_t)-1;
    for (size_t i = 0; i < s->image_count; i++) {
        const struct contact_image *image = &s->images[i];
        char text[400];
        if (image->row == before)
            continue;
        before = image->row;
        contact_sheet_row_name(s, &s->rows[image->row], text, sizeof text);
        if (*text)
            bead_text_draw(cr, &style, s->look.margin, image->picture.y + image->picture.height / 2.0, text);
    }
}

/* Draws texts at the left and right end of a line if both fit, else only the left one. */
static void draw_pair(const struct contact_sheet *s, cairo_t *cr, const struct bead_rect *box, double y, bool strong,
                      const char *left, const char *right)
{
    const struct bead_rgb colour = strong ? s->look.ink : s->look.faint;
    struct bead_text_style style = bead_words_style(&s->look, s->small, colour, BEAD_ALIGN_BASELINE);
    const double wide = bead_words_width(NULL, &style, left) + bead_words_width(NULL, &style, right);
    bead_text_draw(cr, &style, box->x, y, left);
    style.across = BEAD_ALIGN_END;
    if (wide + 0.5 * s->small <= box->width)
        bead_text_draw(cr, &style, box->x + box->width, y, right);
}

static void sheet_draw_words(const struct contact_sheet *s, cairo_t *cr, size_t index)
{
    const struct contact_image *image = &s->images[index];
    const struct bead_sweep_watch *found = &s->watches[index];
    const double small = s->small, meter = fmax(1, round(0.16 * small));
    char left[320], right[160], force[64], name[160] = "";
    double y = image->words.y + round(0.3 * small);
    if (!over_of(s)->key_count)
        contact_sheet_fill(cr, bead_rgb_mix(s->look.background, s->look.faint, 0.25), image->words.x, y, image->words.width, meter);
    if (found->clean_index > 0)
        contact_sheet_fill(cr, s->look.accent, image->words.x, y, fmax(1, found->clean_index * image->words.width), meter);
    if (s->several)
        bead_text_escape(bead_sweep_panel(s->sweep, image->panel)->spec->title, name, sizeof name);
    snprintf(left, sizeof left, "<b>%s%s%zu</b>", name, *name ? ":" : "#", image->index);
    name_values(s, image->index, left + strlen(left), sizeof left - strlen(left));
    if (over_of(s)->key_count == 0 && isnan(s->rows[image->row].magnetism) && isfinite(image->magnetism))
        snprintf(left + strlen(left), sizeof left - strlen(left), "  " BEAD_SYMBOL("M") " %.3g", image->magnetism);
    snprintf(right, sizeof right, BEAD_SYMBOL("C") " %.2f", found->clean_index);
    if (isnan(found->clean_index))
        right[0] = '\0';
    draw_pair(s, cr, &image->words, y + meter + 1.25 * small, true, left, right);
    bead_quantity(found->force, "N", 3, force, sizeof force);
    snprintf(left, sizeof left, BEAD_SYMBOL("F") " %s", force);
    snprintf(right, sizeof right, BEAD_SYMBOL("P") " %.*f", found->participation < 9.95 ? 1 : 0, found->participation);
    if (isnan(found->participation))
        right[0] = '\0';
    draw_pair(s, cr, &image->words, y + meter + 2.55 * small, false, left, right);
}

/* ---- pictures ---- */

/* Fills beads from..to - 1 of the spins, which are along the chain. */
static void fill_spins(const struct contact_sheet *s, cairo_t *cr, const struct contact_image *image, size_t from, size_t to)
{
    const struct bead_rect *box = &image->spins;
    const struct bead_rgb colour = contact_sheet_spin_colour(s, image->spin[from]);
    const bool down = s->orientation == BEAD_TIME_DOWN;
    const double step = (double)(down ? box->width : box->height) / (double)image->beads;
    const double begin = (double)from * step, length = (double)(to - from) * step;
    if (down)
        contact_sheet_fill(cr, colour, box->x + begin, box->y, length, box->height);
    else
        contact_sheet_fill(cr, colour, box->x, box->y + (s->orientation == BEAD_MATRIX ? begin : box->height - begin - length),
                           box->width, length);
}

static void draw_spins(const struct contact_sheet *s, cairo_t *cr, const struct contact_image *image)
{
    const struct bead_rect *box = &image->spins;
    contact_sheet_fill(cr, contact_sheet_spin_colour(s, -1), box->x, box->y, box->width, box->height);
    for (size_t j = 0; j < image->beads;) {
        size_t next = j + 1;
        while (next < image->beads && image->spin[next] == image->spin[j])
            next++;
        if (image->spin[j] >= 0)
            fill_spins(s, cr, image, j, next);
        j = next;
    }
}

/* Finds indices of colours, [height][width]; 0 for pixels without samples. */
static enum bead_error find_indices(const struct contact_sheet *s, const struct contact_image *image, uint8_t *indices,
                                    struct bead_message *msg)
{
    const int columns = contact_columns(s, image), places = image->picture.width + image->picture.height - columns;
    const struct bead_area_image to = bead_orientation_image(s->orientation, places, indices, image->picture.width);
    struct bead_colour_table table;
    bead_colour_table_make(&s->colours, &table);
    for (int c = 0, done; c < columns; c = done + 1)
        BEAD_TRY(bead_area_colour(image->area, &table, c, columns, &to, &done, msg));
    return BEAD_OK;
}

static enum bead_error draw_picture(const struct contact_sheet *s, cairo_t *cr, const struct contact_image *image,
                                    struct bead_message *msg)
{
    BEAD_FREED uint8_t *indices = NULL;
    BEAD_TRY(bead_new(&indices, (size_t)image->picture.width * (size_t)image->picture.height, msg, "a sheet"));
    BEAD_TRY(find_indices(s, image, indices, msg));
    return bead_raster_indices(cr, image->picture, indices, s->colours.map, msg);
}

enum bead_error contact_sheet_draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct contact_sheet *s = context;
    const struct bead_field_info *field = bead_field_info(s->output->shown.field);
    bead_look_paint(&s->look, cr);
    contact_sheet_intro(s, cr, s->intro.width);
    draw_row_names(s, cr);
    for (size_t i = 0; i < s->image_count; i++) {
        BEAD_TRY(draw_picture(s, cr, &s->images[i], msg));
        draw_spins(s, cr, &s->images[i]);
        sheet_draw_words(s, cr, i);
    }
    bead_colour_bar_draw(cr, &s->look, &s->colours, field->unit, field->title, s->bar, s->range.over, s->range.under);
    return bead_raster_status(cr, "sheet", msg);
}
