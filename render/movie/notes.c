/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notes on the stage, each pointing to its subject. The stage is repainted for each frame, which erases the notes. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/movie/composer_private.h"

static const double type = 0.85, height = 1.4, pad = 0.5; /* of the label; of the type */
enum { MARKUP = 4096 };
enum arrow { NO_ARROW, ARROW, ARROW_IF_NEAR };

/* s of the motion */
static double note_end(const struct bead_note *note, const struct bead_film_clock *clock)
{
    const struct bead_movie_asked alone = {.captions = (struct bead_caption *)&note->said, .caption_count = 1};
    return bead_caption_end(&alone, clock, 0);
}

/* Below the beads, over the images in the floor, beside the notes already there; if there is no room, above these. */
static struct bead_note_box place_box(const struct bead_look *look, const struct bead_spot *spot, double width,
                                      const struct bead_note_box *before, size_t count)
{
    const struct bead_rect *s = &spot->stage;
    const double high = round(height * type * look->label), least = s->x + 2, most = fmax(least, s->x + s->width - 2 - width);
    struct bead_note_box box = {fmin(most, fmax(least, spot->x - 0.5 * width)), s->y + s->height - high - 1, width, high, 0, 0};
    for (size_t i = 0; i < count; i++) {
        const struct bead_note_box *other = &before[i];
        if (fabs(other->y - box.y) >= high || other->x > box.x + width + look->gap / 4 || other->x + other->width < box.x)
            continue;
        const double right = other->x + other->width + look->gap / 4, left = other->x - look->gap / 4 - width;
        const bool after = spot->x > other->x + 0.5 * other->width;
        if (after ? right <= most : left >= least)
            box.x = after ? right : left;
        else
            box.y = other->y - high - 2;
    }
    box.tip_x = spot->x;
    box.tip_y = spot->below ? spot->y - 0.2 * spot->r : fmin(spot->y + 0.55 * spot->r, box.y - 0.25 * high);
    return box;
}

static void draw_shape(cairo_t *cr, const struct bead_look *look, const struct bead_note_box *box, bool arrow)
{
    const double r = 0.2 * box->height, x = box->x, y = box->y, right = x + box->width, bottom = y + box->height;
    const double half = 0.25 * box->height, foot = fmin(right - r - half, fmax(x + r + half, box->tip_x));
    const bool down = box->tip_y > bottom;
    cairo_new_path(cr);
    cairo_arc(cr, x + r, y + r, r, M_PI, 1.5 * M_PI);
    if (arrow && !down) {
        cairo_line_to(cr, foot - half, y);
        cairo_line_to(cr, box->tip_x, box->tip_y);
        cairo_line_to(cr, foot + half, y);
    }
    cairo_arc(cr, right - r, y + r, r, -0.5 * M_PI, 0);
    cairo_arc(cr, right - r, bottom - r, r, 0, 0.5 * M_PI);
    if (arrow && down) {
        cairo_line_to(cr, foot + half, bottom);
        cairo_line_to(cr, box->tip_x, box->tip_y);
        cairo_line_to(cr, foot - half, bottom);
    }
    cairo_arc(cr, x + r, bottom - r, r, 0.5 * M_PI, M_PI);
    cairo_close_path(cr);
    cairo_set_source_rgb(cr, look->background.r, look->background.g, look->background.b);
    cairo_fill_preserve(cr);
    cairo_set_line_width(cr, look->line);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_source_rgb(cr, look->accent.r, look->accent.g, look->accent.b);
    cairo_stroke(cr);
}

/* Draws one note; `markup` may be cut if it is wider than the stage. */
static void draw_note(struct bead_composer *c, const struct bead_spot *spot, const char *text, enum arrow arrow,
                      struct bead_changes *changes)
{
    struct bead_note_boxes *shown = &c->notes;
    char markup[MARKUP];
    struct bead_text_style style = bead_words_style(&c->look, type * c->look.label, c->look.ink, BEAD_ALIGN_MIDDLE);
    const double around = 2 * pad * style.size;
    if (shown->count == BEAD_NOTES_SHOWN)
        return;
    const double width =
        ceil(bead_words_fit(c->cr, &style, text, true, spot->stage.width - around - 4, markup, sizeof markup) + around);
    struct bead_note_box *box = &shown->box[shown->count];
    *box = place_box(&c->look, spot, width, shown->box, shown->count);
    if (box->y < spot->stage.y) /* it would not be erased there */
        return;
    shown->count++;
    const bool near = box->tip_x > box->x && box->tip_x < box->x + width;
    draw_shape(c->cr, &c->look, box, arrow == ARROW || (arrow == ARROW_IF_NEAR && near));
    bead_text_draw(c->cr, &style, box->x + pad * style.size, box->y + 0.5 * box->height, markup);
    bead_changes_add(changes, spot->stage);
    if (spot->below)
        bead_changes_add(changes, spot->row);
}

/* Finds a thing in a chain, on the view that shows it. */
static bool find(const struct bead_composer *c, size_t chain, enum bead_note_of of, size_t number, struct bead_spot *spot)
{
    for (size_t v = 0; v < c->wants.view_count; v++) {
        struct bead_view *view = c->views[chain * c->wants.view_count + v];
        if (view && c->wants.views[v]->find && c->wants.views[v]->find(view, of, number, spot))
            return true;
    }
    return false;
}

static void draw_race(struct bead_composer *c, struct bead_changes *changes)
{
    struct bead_spot spot[2];
    char text[64];
    if (!find(c, 0, BEAD_NOTE_FRONT, 0, &spot[0]) || !find(c, 1, BEAD_NOTE_FRONT, 0, &spot[1]) || spot[0].arrived ||
        spot[1].arrived)
        return;
    const double ahead = round(spot[0].front - spot[1].front);
    if (ahead == 0)
        return;
    snprintf(text, sizeof text, "%g bead%s ahead", fabs(ahead), fabs(ahead) == 1 ? "" : "s");
    draw_note(c, &spot[ahead < 0], text, ARROW_IF_NEAR, changes);
}

void bead_overlay_notes(struct bead_composer *c, double time, struct bead_changes *changes)
{
    const struct bead_movie_asked *movie = &c->setup.output->movie;
    const double now = time + 1e-6 * c->setup.step;
    c->notes.count = 0;
    for (size_t i = 0; i < movie->note_count; i++) {
        const struct bead_note *note = &movie->notes[i];
        if (now < note->said.at || now >= note_end(note, c->setup.film))
            continue;
        for (size_t chain = 0; chain < c->wants.chain_count; chain++) {
            struct bead_spot spot;
            if ((note->chain == chain || note->chain == SIZE_MAX) && find(c, chain, note->of, note->number, &spot))
                draw_note(c, &spot, note->said.text, note->arrow ? ARROW : NO_ARROW, changes);
        }
    }
    if (movie->race)
        draw_race(c, changes);
}

const struct bead_note_boxes *bead_composer_notes(const struct bead_composer *c)
{
    return &c->notes;
}
