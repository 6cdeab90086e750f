#include "render/movie/movie_card.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/draw/quantity.h"

enum { MOST_WORDS = 3, LONGEST = 32 * 1024 + 1 };

/* Where things stand, px; heights of single lines. */
struct card {
    cairo_t *cr;
    const struct bead_look *look;
    double left, width, y;
};

static void draw_line(struct card *c, const char *markup, double size, bool bold, struct bead_rgb colour)
{
    double width, height;
    struct bead_text_style style = {c->look->family, size, colour, bold, BEAD_ALIGN_START, BEAD_ALIGN_MIDDLE, false};
    bead_text_size(c->cr, &style, markup, &width, &height);
    style.size *= fmax(0.5, fmin(1, c->width / fmax(1, width)));
    cairo_save(c->cr);
    cairo_rectangle(c->cr, c->left, c->y, c->width, 2 * size);
    cairo_clip(c->cr);
    bead_text_draw(c->cr, &style, c->left, c->y + 0.8 * size, markup);
    cairo_restore(c->cr);
    c->y += 1.6 * size;
}

static void draw_plain(struct card *c, const char *plain, double size, bool bold, struct bead_rgb colour)
{
    char markup[5 * 1024 + 1];
    bead_text_escape(plain, markup, sizeof markup);
    draw_line(c, markup, size, bold, colour);
}

/* "Shown 3 600 times slower: 1 ms takes 3.6 s" */
static void say_slowness(const struct bead_facts *facts, char *out, size_t size)
{
    char factor[64], motion[48], film[48];
    const char *second = bead_chain_time_unit(facts->chains[0]);
    bool slower = facts->slowed >= 1;
    double unit = pow(10, floor(log10(5 / facts->slowed))); /* takes from 0.5 to 5 s */
    bead_round_number(slower ? facts->slowed : 1 / facts->slowed, factor, sizeof factor);
    bead_quantity(unit, second, 1, motion, sizeof motion);
    bead_quantity(unit * facts->slowed, "s", 2, film, sizeof film);
    if (!*second) {
        snprintf(out, size, "A time of %s takes %s", motion, film);
        return;
    }
    snprintf(out, size, "Shown %s times %s: %s takes %s", factor, slower ? "slower" : "faster", motion, film);
}

static size_t gather(const struct bead_facts *facts, char words[MOST_WORDS][256])
{
    char number[64];
    size_t count = 0;
    bead_facts_chain(facts, words[0], sizeof words[0]);
    count += words[0][0] != '\0';
    say_slowness(facts, words[count++], sizeof words[0]);
    if (facts->magnify > 0 && facts->magnify != 1) {
        bead_round_number(facts->magnify, number, sizeof number);
        snprintf(words[count++], sizeof words[0], "Displacements drawn %s times larger", number);
    }
    return count;
}

/* Chains with something to say about them, as many as have room. */
static void draw_chains(struct card *c, const struct bead_facts *facts, double room)
{
    const struct bead_look *look = c->look;
    double step = 1.9 * look->title, bottom = c->y + room;
    size_t named = 0, shown = 0;
    for (size_t i = 0; i < facts->chain_count; i++)
        named += bead_heading_has(facts->chains[i]);
    for (size_t i = 0; i < facts->chain_count; i++) {
        double left = named - shown > 1 ? 2 * step : step; /* the last line may have to say how many more there are */
        if (!bead_heading_has(facts->chains[i]))
            continue;
        if (c->y + left > bottom + 0.5) {
            char more[64];
            snprintf(more, sizeof more, "and %zu more chains", named - shown);
            if (c->y + step <= bottom + 0.5)
                draw_plain(c, more, look->label, false, look->faint);
            return;
        }
        struct bead_rect rect = {(int)c->left, (int)c->y, (int)c->width, (int)step};
        bead_heading_draw(c->cr, look, facts->chains[i], rect);
        c->y += step;
        shown++;
    }
}

void bead_card_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, const char *title, const char *text,
                    int width, int height)
{
    char words[MOST_WORDS][256];
    size_t count = gather(facts, words), chains = 0;
    bool has_title = title && title[0], has_text = text && text[0];
    double large = 2.1 * look->title, small = 1.15 * look->label, line = fmax(2, 2 * look->line);
    struct card card = {.cr = cr, .look = look, .left = round(0.12 * width), .width = round(0.76 * width)};
    for (size_t i = 0; i < facts->chain_count; i++)
        chains += bead_heading_has(facts->chains[i]);
    double fixed =
        (has_title ? 1.6 * large : 0) + (has_text ? 1.76 * look->title : 0) + 3 * look->title + 1.6 * small * (double)count;
    double wanted = 1.9 * look->title * (double)chains, room = fmax(0, fmin(wanted, 0.9 * height - fixed));
    cairo_save(cr);
    cairo_set_source_rgb(cr, look->background.r, look->background.g, look->background.b);
    cairo_paint(cr);
    card.y = round(fmax(0, 0.46 * (height - fixed - room)));
    if (has_title)
        draw_plain(&card, title, large, true, look->ink);
    if (has_text) {
        char markup[LONGEST];
        bead_markup(text, markup, sizeof markup);
        draw_line(&card, markup, 1.1 * look->title, false, look->faint);
    }
    card.y += look->title;
    cairo_set_source_rgb(cr, look->accent.r, look->accent.g, look->accent.b);
    cairo_rectangle(cr, card.left, round(card.y), 3 * large, line);
    cairo_fill(cr);
    card.y += look->title;
    double below = card.y + room + look->title;
    draw_chains(&card, facts, room);
    card.y = below;
    for (size_t i = 0; i < count; i++) {
        char markup[LONGEST];
        bead_markup(words[i], markup, sizeof markup);
        draw_line(&card, markup, small, false, look->faint);
    }
    cairo_restore(cr);
}
