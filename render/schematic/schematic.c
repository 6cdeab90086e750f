/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Entry to schematic drawings: finds the drawing of an output, checks that there is room for it, and writes it as a file. */
#include "render/schematic/schematic.h"

#include <math.h>

#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "sim/base/memory.h"

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

/* Draws a wrapped text at the bottom of the area, which shrinks by its height. */
static bool draw_caption(const struct bead_drafting *d, struct bead_box *area)
{
    double em = d->sketch->look->label, width, height;
    const char *text = d->output->still.caption;
    if (!text || !*text)
        return true;
    BEAD_FREED char *markup = bead_markup_new(text);
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
    return room;
}

static enum bead_error no_room(const struct bead_output *output, struct bead_message *msg)
{
    struct bead_page page;
    char size[BEAD_SIZE_WORDS];
    enum bead_error err = bead_page_find(output, &page, msg);
    return err ? err
               : bead_output_wrong(output, msg, "size: %s leave no room for the drawing and its labels",
                                   bead_page_size(&page, size));
}

enum bead_error bead_schematic_draw(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sketch *sketch, double width, double height, struct bead_message *msg)
{
    const struct drawing *drawing = find_drawing(output->curves.show);
    struct bead_drafting d = {.sketch = sketch, .output = output, .context = context};
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
    return room && !bead_sketch_crowded(sketch, width, height) ? BEAD_OK : no_room(output, msg);
}

struct paper {
    const struct bead_output *output;
    const struct bead_run_context *context;
    struct bead_page page;
    struct bead_look look;
};

/* Chains are long and low: on screens, the type of their drawings is also a part of the width. */
static void enlarge(struct bead_look *look, int width)
{
    static const double part = 0.017, most = 1.6;
    const double factor = fmin(most, fmax(1, part * width / look->label));
    look->title *= factor;
    look->label *= factor;
    look->tick *= factor;
}

static enum bead_error open_paper(const struct bead_output *output, const struct bead_run_context *context, struct paper *paper,
                                  struct bead_message *msg)
{
    *paper = (struct paper){.output = output, .context = context};
    BEAD_TRY(bead_page_find(output, &paper->page, msg));
    bead_page_look(&paper->page, &output->paper, &paper->look);
    if (output->curves.show == BEAD_SHOW_SETUP && !paper->page.paper)
        enlarge(&paper->look, paper->page.width);
    return BEAD_OK;
}

static enum bead_error draw_paper(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct paper *p = context;
    BEAD_LEFT_TO(bead_sketch_free) struct bead_sketch sketch = {.cr = cr, .look = &p->look};
    return bead_schematic_draw(p->output, p->context, &sketch, p->page.width, p->page.height, msg);
}

static enum bead_error try_paper(struct paper *paper, struct bead_message *msg)
{
    cairo_surface_t *nowhere = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cr = cairo_create(nowhere);
    enum bead_error err = draw_paper(paper, cr, msg);
    cairo_destroy(cr);
    cairo_surface_destroy(nowhere);
    return err;
}

/* Chooses larger type if there is room for it. */
static enum bead_error choose_paper(const struct bead_output *output, const struct bead_run_context *context, struct paper *paper,
                                    struct bead_message *msg)
{
    struct bead_message why;
    BEAD_TRY(open_paper(output, context, paper, msg));
    if (try_paper(paper, &why) == BEAD_OK)
        return BEAD_OK;
    bead_page_look(&paper->page, &output->paper, &paper->look);
    return try_paper(paper, msg);
}

enum bead_error bead_schematic_check(const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_message *msg)
{
    struct paper paper;
    return choose_paper(output, context, &paper, msg);
}

enum bead_error bead_schematic_write(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                     uint64_t *bytes, struct bead_message *msg)
{
    struct paper paper;
    const struct bead_drawing drawing = {draw_paper, NULL, &paper, NULL};
    BEAD_TRY(choose_paper(output, context, &paper, msg));
    return bead_page_write(&paper.page, output, context->scene, &drawing, path, bytes, msg);
}
