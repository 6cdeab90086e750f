/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The title card: the subject of the film, and the chains at rest. */
#include <math.h>
#include <stdio.h>

#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/movie/movie_words.h"
#include "render/view/views.h"

/* Lower stages, in units of the label's font size, show too little. */
static const double least_beads = 3;

enum { MOST_FACTS = 3, MOST_FACT = 256, MARKUP = 5 * 1024 + 1 };

/* Its lines, from the top; px. */
struct card {
    cairo_t *cr;
    const struct bead_look *look;
    double left, width, y;
};

static void card_line(struct card *c, const char *markup, double size, bool bold, struct bead_rgb colour)
{
    struct bead_text_style style = bead_words_style(c->look, size, colour, BEAD_ALIGN_MIDDLE);
    struct bead_rect box = {(int)c->left, (int)c->y, (int)c->width, (int)(2 * size)};
    style.bold = bold;
    style.size *= fmax(0.5, fmin(1, c->width / fmax(1, bead_words_width(c->cr, &style, markup))));
    bead_words_draw_within(c->cr, &style, box, c->left, c->y + 0.8 * size, markup);
    c->y += 1.6 * size;
}

/* `text` is for bead_markup. */
static void card_marked(struct card *c, const char *text, double size)
{
    char markup[MARKUP];
    bead_markup(text, markup, sizeof markup);
    card_line(c, markup, size, false, c->look->faint);
}

static void card_plain(struct card *c, const char *plain, double size, bool bold, struct bead_rgb colour)
{
    char markup[MARKUP];
    bead_text_escape(plain, markup, sizeof markup);
    card_line(c, markup, size, bold, colour);
}

/* "1 s of film = 0.28 ms, 3 600 times slower", or "1 s of film = 0.25 to 2 ms" */
static void say_slowness(const struct bead_facts *facts, char *out, size_t size)
{
    char least[160], most[40], factor[64];
    double factors[2];
    bead_film_factors(facts->film, factors);
    bool slower = factors[0] <= 1, even = factors[1] <= 1.001 * factors[0];
    bead_facts_speed(facts, factors[0], least, sizeof least);
    bead_round_number(slower ? 1 / factors[0] : factors[0], factor, sizeof factor);
    bead_round_number(factors[0] / facts->clock.unit, most, sizeof most);
    if (!even) {
        char other[40];
        bead_round_number(factors[1] / facts->clock.unit, other, sizeof other);
        snprintf(out, size, "1\u00a0s of film = %s to %s\u00a0%s", most, other,
                 facts->clock.sign[0] ? facts->clock.sign : "time units");
    } else if (facts->clock.sign[0])
        snprintf(out, size, "%s, %s times %s", least, factor, slower ? "slower" : "faster");
    else
        snprintf(out, size, "%s", least);
}

static size_t card_words(const struct bead_facts *facts, char words[MOST_FACTS][MOST_FACT])
{
    struct bead_facts all = *facts; /* without a key that names the materials */
    char number[64];
    size_t count = 0;
    all.keyed = false;
    bead_facts_chain(&all, words[0], sizeof words[0]);
    count += words[0][0] != '\0';
    say_slowness(facts, words[count++], sizeof words[0]);
    if (facts->magnify > 0 && facts->magnify != 1) {
        bead_round_number(facts->magnify, number, sizeof number);
        snprintf(words[count++], sizeof words[0], "Displacements drawn %s times larger", number);
    }
    return count;
}

/* The room of each chain: its heading, and below it its beads, if they are large enough to be worth looking at; px. */
struct card_room {
    int heading, beads;
};

static struct card_room share(const struct bead_look *look, bool headed, double width, double each)
{
    const double heading = headed ? 1.9 * look->title : 0, beads = fmin(each - heading - look->gap, 0.17 * width);
    return (struct card_room){(int)heading, beads >= least_beads * look->label ? (int)beads : 0};
}

/* As many chains as fit. */
static enum bead_error card_chains(struct card *c, const struct bead_facts *facts, const struct bead_view_setup *stage, bool headed,
                                   double room, struct bead_message *msg)
{
    const struct bead_look *look = c->look;
    const double bottom = c->y + room, line = 1.9 * look->title;
    const struct card_room each = share(look, headed, c->width, stage ? room / (double)facts->chain_count : 0);
    const double step = each.heading + (each.beads > 0 ? each.beads + look->gap : 0);
    for (size_t i = 0; i < facts->chain_count && step > 0; i++) {
        const size_t left = facts->chain_count - i;
        if (c->y + (left > 1 ? step + line : step) > bottom + 0.5 && c->y + step * (double)left > bottom + 0.5) {
            char more[64];
            snprintf(more, sizeof more, "and %zu more chains", left);
            if (c->y + line <= bottom + 0.5)
                card_plain(c, more, look->label, false, look->faint);
            return BEAD_OK;
        }
        struct bead_rect rect = {(int)c->left, (int)c->y, (int)c->width, each.heading};
        struct bead_heading heading = {facts->chains[i], look->ink, false, false, 1};
        if (headed) {
            heading.size = bead_heading_name(look, &heading, rect);
            bead_heading_draw(c->cr, look, &heading, bead_heading_label(look, &heading, rect), rect);
        }
        if (each.beads > 0) {
            struct bead_view_setup setup = *stage;
            setup.chain = facts->chains[i];
            setup.beads.last = SIZE_MAX;
            rect = (struct bead_rect){rect.x, rect.y + each.heading, rect.width, each.beads};
            BEAD_TRY(bead_stage_at_rest(&setup, rect, c->cr, msg));
        }
        c->y += step;
    }
    return BEAD_OK;
}

enum bead_error bead_card_draw(cairo_t *cr, const struct bead_facts *facts, const struct bead_view_setup *stage,
                               const struct bead_look *look, const char *title, const char *text, const int size[2],
                               struct bead_message *msg)
{
    char words[MOST_FACTS][MOST_FACT];
    const size_t count = card_words(facts, words);
    const bool has_title = title && title[0], has_text = text && text[0];
    const double large = 2.1 * look->title, small = 1.15 * look->label, line = fmax(2, 2 * look->line);
    const double chains = (double)facts->chain_count;
    struct card card = {.cr = cr, .look = look, .left = round(0.12 * size[0]), .width = round(0.76 * size[0])};
    bool headed = false;
    for (size_t i = 0; i < facts->chain_count; i++)
        headed = headed || bead_heading_has(facts->chains[i]);
    const double fixed =
        (has_title ? 1.6 * large : 0) + (has_text ? 1.76 * look->title : 0) + 3 * look->title + 1.6 * small * (double)count;
    const double most = fmax(0, 0.92 * size[1] - fixed), heading = headed ? 1.9 * look->title : 0;
    const struct card_room each = share(look, headed, card.width, stage ? most / chains : 0);
    const double room = fmin(most, chains * (each.beads > 0 ? each.heading + each.beads + look->gap : heading));
    cairo_save(cr);
    bead_look_paint(look, cr);
    card.y = round(fmax(0, 0.46 * (size[1] - fixed - room)));
    if (has_title)
        card_plain(&card, title, large, true, look->ink);
    if (has_text)
        card_marked(&card, text, 1.1 * look->title);
    card.y += look->title;
    cairo_set_source_rgb(cr, look->accent.r, look->accent.g, look->accent.b);
    cairo_rectangle(cr, card.left, round(card.y), 3 * large, line);
    cairo_fill(cr);
    card.y += look->title;
    double below = card.y + room + look->title;
    enum bead_error err = card_chains(&card, facts, stage, headed, room, msg);
    card.y = below;
    for (size_t i = 0; i < count; i++)
        card_marked(&card, words[i], small);
    cairo_restore(cr);
    return err;
}
