/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of words, for all that has headings, captions and facts. */
#include "render/draw/words.h"

#include <stdio.h>
#include <string.h>

#include "render/draw/markup.h"

enum { LONGEST = 1024 };

struct bead_text_style bead_words_style(const struct bead_look *look, double size, struct bead_rgb colour, enum bead_align down)
{
    return (struct bead_text_style){.family = look->family, .size = size, .colour = colour, .down = down};
}

double bead_words_width(cairo_t *cr, const struct bead_text_style *style, const char *markup)
{
    double width = 0, height;
    if (*markup)
        bead_text_size(cr, style, markup, &width, &height);
    return width;
}

void bead_words_draw_within(cairo_t *cr, const struct bead_text_style *style, struct bead_rect box, double x, double y,
                            const char *markup)
{
    cairo_save(cr);
    cairo_rectangle(cr, box.x, box.y, box.width, box.height);
    cairo_clip(cr);
    bead_text_draw(cr, style, x, y, markup);
    cairo_restore(cr);
}

/* Cuts after `length` bytes, never within a character or behind a space. */
static void cut(const char *text, size_t length, char *out, size_t size)
{
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    while (length > 0 && text[length - 1] == ' ')
        length--;
    snprintf(out, size, "%.*s%s", (int)length, text, length > 0 ? "\u2026" : "");
}

double bead_words_fit(cairo_t *cr, const struct bead_text_style *style, const char *text, bool marked, double room, char *markup,
                      size_t size)
{
    void (*const to_markup)(const char *, char *, size_t) = marked ? bead_markup : bead_text_escape;
    char part[LONGEST + sizeof "\u2026"];
    size_t length = strnlen(text, LONGEST), low = 0, high = length;
    to_markup(text, markup, size);
    double width = bead_words_width(cr, style, markup);
    if (width <= room && !text[length])
        return width;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        cut(text, middle, part, sizeof part);
        to_markup(part, markup, size);
        if (bead_words_width(cr, style, markup) <= room)
            low = middle;
        else
            high = middle - 1;
    }
    cut(text, low, part, sizeof part);
    to_markup(part, markup, size);
    return bead_words_width(cr, style, markup);
}
