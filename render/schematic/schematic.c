/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Entry to schematic drawings: finds the drawing that an output shows, tries it for room, and writes it as a file. */
#include "render/schematic/schematic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/picture.h"
#include "render/draw/markup.h"

/* In units of the label's font size. */
static const double line_height = 1.45, piece_gap = 1.6, ball_radius = 0.42;

static const struct drawing {
    enum bead_show show;
    bool (*draw)(const struct bead_drafting *d);
} drawings[] = {
    {BEAD_SHOW_SETUP, bead_schematic_setup}, {BEAD_SHOW_CONTACT, bead_schematic_contact}, {BEAD_SHOW_CELL, bead_schematic_cell}};

static const struct drawing *find_drawing(enum bead_show show)
{
    for (size_t i = 0; i < sizeof drawings / sizeof *drawings; i++) {
        if (drawings[i].show == show)
            return &drawings[i];
    }
    return NULL;
}

bool bead_schematic_is(enum bead_show show)
{
    return find_drawing(show) != NULL;
}

void bead_schematic_symbol(const char *letter, int index, char *out, size_t size)
{
    char text[64];
    if (index > 0)
        snprintf(text, sizeof text, "*%s*_%d", letter, index);
    else
        snprintf(text, sizeof text, "*%s*", letter);
    bead_markup(text, out, size);
}

bool bead_drafting_pieces(const struct bead_drafting *d, struct bead_box *area, const struct bead_piece *pieces, size_t count,
                          bool centred)
{
    double em = d->sketch->look->label, used = 0;
    struct bead_text_style style = bead_sketch_style(d->sketch, em);
    enum { MOST = 64 };
    double width[MOST], line_width[MOST] = {0};
    size_t line[MOST], lines = 0;
    if (count > MOST)
        return false;
    for (size_t i = 0; i < count; i++) {
        width[i] = bead_sketch_width(&style, pieces[i].markup) + (pieces[i].colour ? (2 * ball_radius + 0.4) * em : 0);
        if (width[i] > area->width)
            return false;
        if (lines == 0 || used + piece_gap * em + width[i] > area->width) {
            lines++;
            used = -piece_gap * em;
        }
        used += piece_gap * em + width[i];
        line[i] = lines - 1;
        line_width[lines - 1] = used;
    }
    double height = line_height * em * (double)lines, x = 0;
    if (height > area->height)
        return false;
    area->height -= height + (lines > 0 ? 0.4 * em : 0);
    double top = area->y + area->height + (lines > 0 ? 0.4 * em : 0);
    for (size_t i = 0; i < count; i++) {
        double y = top + line_height * em * ((double)line[i] + 0.5);
        if (i == 0 || line[i] != line[i - 1])
            x = area->x + (centred ? 0.5 * (area->width - line_width[line[i]]) : 0);
        double text = x;
        if (pieces[i].colour) {
            bead_sketch_ball(d->sketch, x + ball_radius * em, y, ball_radius * em, pieces[i].colour);
            text += (2 * ball_radius + 0.4) * em;
        }
        bead_sketch_text(d->sketch, &style, text, y, pieces[i].markup);
        x += width[i] + piece_gap * em;
    }
    return true;
}

/* ---- strips ---- */

bool bead_strip_add(struct bead_strip *strip, size_t material, bool left_out, size_t mark)
{
    if (strip->count == strip->room) {
        size_t room = strip->room ? 2 * strip->room : 64;
        struct bead_strip_bead *grown = realloc(strip->beads, room * sizeof *grown);
        if (!grown) {
            strip->failed = true;
            return false;
        }
        strip->beads = grown;
        strip->room = room;
    }
    strip->beads[strip->count++] = (struct bead_strip_bead){.material = material, .left_out = left_out, .mark = mark};
    return true;
}

void bead_strip_free(struct bead_strip *strip)
{
    free(strip->beads);
    *strip = (struct bead_strip){0};
}

double bead_strip_width(const struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap)
{
    double width = 0;
    for (size_t i = 0; i < strip->count; i++)
        width += strip->beads[i].left_out ? gap : 2 * scale * scene->materials[strip->beads[i].material].radius;
    return width;
}

void bead_strip_place(struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap, double x)
{
    for (size_t i = 0; i < strip->count; i++) {
        struct bead_strip_bead *b = &strip->beads[i];
        b->r = b->left_out ? gap / 2 : scale * scene->materials[b->material].radius;
        b->x = x + b->r;
        x += 2 * b->r;
    }
}

bool bead_strip_extent(const struct bead_strip *strip, size_t mark, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < strip->count; i++) {
        const struct bead_strip_bead *b = &strip->beads[i];
        if (b->mark == mark) {
            *low = fmin(*low, b->x - b->r);
            *high = fmax(*high, b->x + b->r);
        }
    }
    return *low < *high;
}

/* ---- pages ---- */

static void draw_title(const struct bead_drafting *d, struct bead_box *area)
{
    const struct bead_look *look = d->sketch->look;
    char title[512];
    if (d->output->paper.size_is_length || !*d->context->scene->title || area->height < 10 * look->title)
        return;
    struct bead_text_style style = bead_sketch_style(d->sketch, look->title);
    style.bold = true;
    bead_text_escape(d->context->scene->title, title, sizeof title);
    if (bead_sketch_width(&style, title) > area->width)
        return;
    bead_sketch_text(d->sketch, &style, area->x, area->y + 0.6 * look->title, title);
    area->y += 2 * look->title;
    area->height -= 2 * look->title;
}

/* A wrapped text at the bottom of the area, which shrinks by its height. */
static bool draw_caption(const struct bead_drafting *d, struct bead_box *area)
{
    double em = d->sketch->look->label, width, height;
    const char *text = d->output->still.caption;
    if (!text || !*text)
        return true;
    char *markup = bead_markup_new(text);
    if (!markup) {
        d->sketch->failed = true;
        return false;
    }
    struct bead_text_style style = bead_sketch_style(d->sketch, em);
    style.down = BEAD_ALIGN_START;
    bead_text_size_lines(NULL, &style, area->width, markup, &width, &height);
    area->height -= height + 0.8 * em;
    bool room = area->height > 0;
    if (room)
        bead_text_draw_lines(d->sketch->cr, &style, area->width, area->x, area->y + area->height + 0.8 * em, markup);
    free(markup);
    return room;
}

static enum bead_error no_room(const struct bead_output *output, const struct bead_run_context *context, struct bead_message *msg)
{
    struct bead_page page;
    char size[BEAD_SIZE_WORDS];
    enum bead_error err = bead_page_find(output, context->scene->file, &page, msg);
    return err ? err
               : bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: size: %s leave no room for the drawing and its labels",
                           context->scene->file, output->place.line, output->place.column, bead_page_size(&page, size));
}

enum bead_error bead_schematic_draw(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sketch *sketch, double width, double height, struct bead_message *msg)
{
    const struct drawing *drawing = find_drawing(output->curves.show);
    struct bead_drafting d = {sketch, output, context, {0, 0, width, height}};
    double margin = sketch->look->margin;
    d.area = (struct bead_box){margin, margin, width - 2 * margin, height - 2 * margin};
    bead_look_paint(sketch->look, sketch->cr);
    cairo_set_line_width(sketch->cr, sketch->look->line);
    cairo_set_line_join(sketch->cr, CAIRO_LINE_JOIN_ROUND);
    bool room = drawing && d.area.width > 0 && d.area.height > 0;
    if (room) {
        draw_title(&d, &d.area);
        room = draw_caption(&d, &d.area) && drawing->draw(&d);
    }
    if (sketch->failed)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a drawing");
    return room && !bead_sketch_crowded(sketch, width, height) ? BEAD_OK : no_room(output, context, msg);
}

struct paper {
    const struct bead_output *output;
    const struct bead_run_context *context;
    struct bead_page page;
    struct bead_look look;
};

static enum bead_error open_paper(const struct bead_output *output, const struct bead_run_context *context, struct paper *paper,
                                  struct bead_message *msg)
{
    *paper = (struct paper){.output = output, .context = context};
    enum bead_error err = bead_page_find(output, context->scene->file, &paper->page, msg);
    if (!err)
        bead_page_look(&paper->page, &output->paper, &paper->look);
    return err;
}

static enum bead_error draw_paper(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct paper *p = context;
    struct bead_sketch sketch = {.cr = cr, .look = &p->look};
    enum bead_error err = bead_schematic_draw(p->output, p->context, &sketch, p->page.width, p->page.height, msg);
    bead_sketch_free(&sketch);
    return err;
}

enum bead_error bead_schematic_check(const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_message *msg)
{
    struct paper paper;
    enum bead_error err = open_paper(output, context, &paper, msg);
    if (err)
        return err;
    cairo_surface_t *nowhere = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cr = cairo_create(nowhere);
    err = draw_paper(&paper, cr, msg);
    cairo_destroy(cr);
    cairo_surface_destroy(nowhere);
    return err;
}

enum bead_error bead_schematic_write(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                     uint64_t *bytes, struct bead_message *msg)
{
    struct paper paper;
    const struct bead_drawing drawing = {draw_paper, NULL, &paper};
    enum bead_error err = open_paper(output, context, &paper, msg);
    return err ? err : bead_page_write(&paper.page, output, context->scene, &drawing, path, bytes, msg);
}
