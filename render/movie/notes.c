/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notes on the stage, each pointing to its subject. The stage is repainted for each frame, which erases the notes. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/movie/composer_private.h"
#include "render/movie/film.h"
#include "render/origin/origin.h"

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

/* The comment, chapters and subtitles of a movie's file. */

/* The times of the film, s, from which and until which a caption is seen; equal if it is not seen. */
static void find_span(const struct bead_film *film, size_t caption, double span[2])
{
    const struct bead_movie_asked *movie = &film->output->movie;
    const struct bead_movie_times *times = &film->times;
    double until = bead_caption_end(movie, &times->film, caption), length = (double)times->frames / movie->fps;
    span[0] = bead_movie_film_time(times, movie->captions[caption].at, movie->fps);
    span[1] = until < times->time[1] ? bead_movie_film_time(times, until, movie->fps) : length;
}

/* Chapters begin with the film: one is added for what is before the first. */
static void add_beginning(const struct bead_film *film, struct bead_movie_notes *notes, double first)
{
    const char *title = film->context.scene->title;
    if (notes->chapter_count == 0 && first > 0)
        notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){0, title[0] ? title : "Beginning"};
}

/* Puts the stops among the chapters, but for those that begin with a caption, within a frame, which has the better name. */
static void add_stops(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    for (size_t i = 0; i < movie->stop_count; i++) {
        const double start = bead_movie_stop_time(&film->times, movie->stops[i], movie->fps);
        add_beginning(film, notes, start);
        size_t at = notes->chapter_count;
        while (at > 0 && notes->chapters[at - 1].start > start)
            at--;
        if (at > 0 && start - notes->chapters[at - 1].start < 1 / movie->fps)
            continue;
        memmove(&notes->chapters[at + 1], &notes->chapters[at], (notes->chapter_count - at) * sizeof *notes->chapters);
        snprintf(notes->stop_names[i], sizeof notes->stop_names[i], "Stop %zu", i + 1);
        notes->chapters[at] = (struct bead_movie_chapter){start, notes->stop_names[i]};
        notes->chapter_count++;
    }
}

/* Chapters begin with the captions and at the stops. false: out of memory. */
static bool fill(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    char *text = notes->text;
    for (size_t i = 0; i < movie->caption_count; i++) {
        double span[2];
        find_span(film, i, span);
        if (!(span[1] > span[0]))
            continue;
        add_beginning(film, notes, span[0]);
        size_t size = strlen(movie->captions[i].text) + 1;
        if (!bead_markup_plain(movie->captions[i].text, text, size))
            return false;
        notes->chapters[notes->chapter_count++] = (struct bead_movie_chapter){span[0], text};
        notes->subtitles[notes->subtitle_count++] = (struct bead_movie_subtitle){span[0], span[1], text};
        text += size;
    }
    add_stops(film, notes);
    return true;
}

/* One subtitle after another about each chain; their words come at the end of the film. */
static bool reserve_words(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    const size_t count = film->context.chain_count;
    if (movie->subtitles != BEAD_SUBTITLES_WORDS || movie->caption_count > 0)
        return true;
    free(notes->subtitles);
    notes->subtitles = calloc(count, sizeof *notes->subtitles);
    notes->words = calloc(count, sizeof *notes->words);
    if (!notes->subtitles || !notes->words)
        return false;
    const double from = bead_movie_film_time(&film->times, film->times.time[0], movie->fps),
                 each = ((double)film->times.frames / movie->fps - from) / (double)count;
    for (size_t i = 0; i < count; i++)
        notes->subtitles[i] = (struct bead_movie_subtitle){from + (double)i * each, from + (double)(i + 1) * each, notes->words[i]};
    notes->subtitle_count = count;
    return true;
}

void bead_movie_notes_tell(const struct bead_tale *tale, struct bead_movie_notes *notes)
{
    for (size_t i = 0; notes->words && i < notes->subtitle_count; i++) {
        bead_tale_of_chain(tale, i, notes->words[i], sizeof *notes->words);
        if (!*notes->words[i])
            snprintf(notes->words[i], sizeof *notes->words, "There is no wave.");
    }
}

static bool reserve(const struct bead_film *film, struct bead_movie_notes *notes)
{
    const struct bead_movie_asked *movie = &film->output->movie;
    size_t captions = movie->caption_count, bytes = 0;
    for (size_t i = 0; i < captions; i++)
        bytes += strlen(movie->captions[i].text) + 1;
    if (captions + movie->stop_count == 0)
        return reserve_words(film, notes);
    notes->chapters = calloc(captions + movie->stop_count + 1, sizeof *notes->chapters);
    notes->subtitles = calloc(captions + 1, sizeof *notes->subtitles);
    notes->text = malloc(bytes + 1);
    notes->stop_names = calloc(movie->stop_count + 1, sizeof *notes->stop_names);
    return notes->chapters && notes->subtitles && notes->text && notes->stop_names && reserve_words(film, notes);
}

enum bead_error bead_movie_notes_make(const struct bead_film *film, struct bead_movie_notes *notes, struct bead_message *msg)
{
    *notes = (struct bead_movie_notes){.comment = NULL};
    BEAD_TRY(bead_origin_text(NULL, film->context.scene->text, &notes->comment, msg));
    if (!reserve(film, notes) || !fill(film, notes))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the notes of a movie");
    return BEAD_OK;
}

void bead_movie_notes_free(struct bead_movie_notes *notes)
{
    free(notes->comment);
    free(notes->chapters);
    free(notes->subtitles);
    free(notes->text);
    free(notes->stop_names);
    free(notes->words);
}
