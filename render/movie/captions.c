/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Captions of movies: timing, line breaks, drawing. The composer shows one at a time. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/movie/movie_words.h"

enum { MOST_LINES = 2, LONGEST = 1024, MARKUP = 32 * LONGEST + 1 /* see bead_markup_size */ };
static const double line_height = 1.4;                /* in units of the font size */
static const double least_time = 2.5, reading = 15.0; /* s of the film; characters a second */
static const double smaller[] = {0.86, 0.74};         /* sizes to try */

static double font_size(const struct bead_look *look)
{
    return fmax(14, look->title);
}

double bead_caption_height(const struct bead_look *look)
{
    return ceil(line_height * font_size(look));
}

double bead_caption_end(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, size_t caption)
{
    const struct bead_caption *c = &movie->captions[caption];
    bool last = caption + 1 == movie->caption_count;
    double next = last ? INFINITY : c[1].at;
    if (!isnan(c->until))
        return fmin(c->until, next);
    if (!isnan(c->lasting))
        return fmin(bead_film_after(clock, c->at, fmax(c->lasting, c->pause)), next);
    return last ? bead_film_after(clock, c->at, c->pause + fmax(least_time, (double)strlen(c->text) / reading)) : next;
}

size_t bead_captions_find(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, double time)
{
    size_t found = SIZE_MAX;
    for (size_t i = 0; i < movie->caption_count && movie->captions[i].at <= time; i++)
        found = i;
    return found != SIZE_MAX && time < bead_caption_end(movie, clock, found) ? found : SIZE_MAX;
}

static struct bead_text_style style_of(const struct bead_look *look)
{
    struct bead_text_style style = bead_words_style(look, font_size(look), look->ink, BEAD_ALIGN_MIDDLE);
    style.across = BEAD_ALIGN_MIDDLE;
    return style;
}

static double captions_width_of(cairo_t *cr, const struct bead_text_style *style, const char *text, size_t length)
{
    char part[LONGEST], markup[MARKUP];
    snprintf(part, sizeof part, "%.*s", (int)length, text);
    bead_markup(part, markup, sizeof markup);
    return bead_words_width(cr, style, markup);
}

/* The next place after `from` where a line may break: a space outside braces, tags and italics, or the end. */
static size_t next_break(const char *text, size_t from)
{
    int depth = 0;
    bool italics = false, equation = false;
    size_t i = 0, tagged;
    for (; text[i]; i++) {
        if (text[i] == '\\' && text[i + 1])
            i++;
        else if ((tagged = bead_markup_tagged(text + i)) > 0)
            i += tagged - 1;
        else if (text[i] == '*')
            italics = !italics;
        else if (text[i] == '$')
            equation = !equation && strchr(text + i + 1, '$');
        else if (text[i] == ' ' && depth == 0 && !italics && !equation && i > from)
            break;
        else
            depth += (text[i] == '{') - (text[i] == '}' && depth > 0);
    }
    return i;
}

/* Lines of a caption: first bytes and lengths. */
struct lines {
    const char *text[MOST_LINES];
    size_t length[MOST_LINES], count;
    bool whole; /* the whole caption fits */
};

/* One line if it fits, else two of similar length. */
static struct lines wrap(cairo_t *cr, const struct bead_text_style *style, const char *text, double room, size_t most)
{
    size_t all = strlen(text), best = 0, fullest = 0;
    double least = INFINITY;
    struct lines one = {.text = {text}, .length = {all}, .count = 1, .whole = captions_width_of(cr, style, text, all) <= room};
    if (one.whole || most < 2)
        return one;
    for (size_t at = next_break(text, 0); at < all; at = next_break(text, at + 1)) {
        double first = captions_width_of(cr, style, text, at), second = captions_width_of(cr, style, text + at + 1, all - at - 1);
        if (first <= room)
            fullest = at;
        if (fmax(first, second) < least) {
            least = fmax(first, second);
            best = at;
        }
    }
    if (least > room) /* only the end is cut */
        best = fullest;
    if (best == 0)
        return one;
    return (struct lines){.text = {text, text + best + 1}, .length = {best, all - best - 1}, .count = 2, .whole = least <= room};
}

int bead_captions_lines(const struct bead_movie_asked *movie, const struct bead_look *look, int width)
{
    struct bead_text_style style = style_of(look);
    double room = width - 2 * ceil(1.3 * look->gap);
    size_t most = 0;
    for (size_t i = 0; i < movie->caption_count; i++) {
        struct lines lines = wrap(NULL, &style, movie->captions[i].text, room, MOST_LINES);
        most = lines.count > most ? lines.count : most;
    }
    return (int)most;
}

static void draw_line(cairo_t *cr, const struct bead_text_style *style, const char *text, size_t length, double x, double y,
                      double room)
{
    char part[LONGEST], markup[MARKUP];
    snprintf(part, sizeof part, "%.*s", (int)length, text);
    bead_words_fit(cr, style, part, true, room, markup, sizeof markup);
    bead_text_draw(cr, style, x, y, markup);
}

void bead_caption_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect)
{
    size_t most = (size_t)fmax(1, floor(rect.height / bead_caption_height(look) + 1e-6));
    most = most < MOST_LINES ? most : MOST_LINES;
    struct bead_text_style style = style_of(look);
    struct lines lines = wrap(cr, &style, text, rect.width, most);
    for (size_t i = 0; i < sizeof smaller / sizeof smaller[0] && !lines.whole; i++) {
        style.size = smaller[i] * font_size(look);
        lines = wrap(cr, &style, text, rect.width, most);
    }
    double step = line_height * style.size, y = rect.y + 0.5 * (rect.height - step * (double)(lines.count - 1));
    for (size_t i = 0; i < lines.count; i++)
        draw_line(cr, &style, lines.text[i], lines.length[i], rect.x + 0.5 * rect.width, y + step * (double)i, rect.width);
}
