/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of movies: clock, headings, facts. The composer puts them on the frame. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/movie/movie_words.h"
#include "sim/chain/chain_internal.h"

#define THIN_SPACE "\u2009"
#define ELLIPSIS   "\u2026"

/* The second line of a heading, in units of the label's font size. */
static const double heading_line = 1.35;
/* Its first line, in units of the title's font size; the gap between its parts, in units of the look's gap. */
/* No letters are smaller, px. */
static const double least_letters = 11;
static const double heading_size = 1.1, heading_gap = 1.2, smallest_name = 0.6, smallest_image_name = 0.8;

struct bead_clock bead_clock_make(double end, double step, const char *unit)
{
    int exponent = bead_prefix_exponent(end, unit);
    struct bead_clock clock = {.unit = bead_power_of_ten(exponent)};
    if (*unit)
        snprintf(clock.sign, sizeof clock.sign, "%s%s", bead_prefix_sign(exponent), unit);
    double small = step / clock.unit;
    clock.decimals = small > 0 ? (int)fmax(0, fmin(4, ceil(-log10(small) - 1e-9))) : 0;
    return clock;
}

static void hex(struct bead_rgb c, char out[8])
{
    snprintf(out, 8, "#%02x%02x%02x", (unsigned)lround(255 * c.r) & 255, (unsigned)lround(255 * c.g) & 255,
             (unsigned)lround(255 * c.b) & 255);
}

void bead_clock_text(const struct bead_clock *clock, double time, const struct bead_look *look, char *out, size_t size)
{
    char number[48], faint[8];
    snprintf(number, sizeof number, "%.*f", clock->decimals, fmax(0, time / clock->unit) + 0.0);
    hex(look->faint, faint);
    snprintf(out, size,
             "<span font_features=\"tnum=1\"><span foreground=\"%s\">" BEAD_SYMBOL("t") " =</span> %s" THIN_SPACE "%s</span>",
             faint, number, clock->sign);
}

struct bead_text_style bead_clock_style(const struct bead_look *look)
{
    return bead_words_style(look, 1.15 * look->title, look->ink, BEAD_ALIGN_MIDDLE);
}

static void add_text(char *out, size_t size, const char *text)
{
    size_t used = strlen(out);
    snprintf(out + used, size - used, "%s", text);
}

/* "large steel : aluminium" for the longest cell of a chain. */
static void name_beads(const struct bead_chain *chain, char *out, size_t size)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const struct bead_scene *scene = bead_chain_scene(chain);
    const struct bead_segment *best = NULL;
    out[0] = '\0';
    for (size_t s = 0; s < spec->segment_count; s++) {
        const struct bead_segment *segment = &spec->segments[s];
        if (!best || segment->cell_beads > best->cell_beads ||
            (segment->cell_beads == best->cell_beads && segment->count > best->count))
            best = segment;
    }
    for (size_t i = 0; best && i < best->cell_beads && i < 4; i++) {
        add_text(out, size, i ? " : " : "");
        add_text(out, size, scene->materials[best->cell[i]].label);
    }
    if (best && best->cell_beads > 4)
        add_text(out, size, " : " ELLIPSIS);
}

/* Chains with a formula and a name, but no label, show the formula beside the name. */
static bool heading_shows_formula(const struct bead_chain *chain)
{
    const char *label = bead_chain_spec(chain)->label;
    char formula[256];
    bead_chain_describe(chain, formula, sizeof formula);
    return formula[0] && bead_chain_title(chain)[0] && !(label && label[0]);
}

void bead_facts_chain(const struct bead_facts *facts, char *out, size_t size)
{
    char name[160], other[160], mover[160];
    bool same_beads = true;
    out[0] = '\0';
    bead_chain_describe(facts->chains[0], name, sizeof name);
    if (name[0]) {
        if (heading_shows_formula(facts->chains[0]))
            return;
        for (size_t c = 1; c < facts->chain_count; c++) { /* only if all have one equation */
            bead_chain_describe(facts->chains[c], other, sizeof other);
            name[0] = strcmp(name, other) == 0 ? name[0] : '\0';
        }
        bead_markup_symbols(name, out, size);
        return;
    }
    name_beads(facts->chains[0], name, sizeof name);
    bead_mover_name(facts->chains[0], mover, sizeof mover);
    for (size_t c = 1; c < facts->chain_count; c++) {
        name_beads(facts->chains[c], other, sizeof other);
        same_beads = same_beads && strcmp(name, other) == 0;
        bead_mover_name(facts->chains[c], other, sizeof other);
        mover[0] = strcmp(mover, other) == 0 ? mover[0] : '\0';
    }
    if (same_beads && !facts->keyed)
        bead_markup_quote(name, out, size);
    add_text(out, size, out[0] && mover[0] ? ", " : "");
    add_text(out, size, mover);
}

enum { MOST_FACTS = 3, MOST_FACT = 256 };

void bead_facts_speed(const struct bead_facts *facts, double factor, char *out, size_t size)
{
    char number[40];
    bead_round_number(factor / facts->clock.unit, number, sizeof number);
    snprintf(out, size, "1\u00a0s of film = %s\u00a0%s", number, facts->clock.sign[0] ? facts->clock.sign : "time units");
}

static void say_pace(const struct bead_facts *facts, double factor, char *out, size_t size)
{
    char number[64];
    bool slow = factor <= 1;
    bead_round_number(slow ? 1 / factor : factor, number, sizeof number);
    if (factor == 0)
        snprintf(out, size, "paused");
    else if (facts->clock.sign[0])
        snprintf(out, size, "%s\u00a0%s\u00a0times", slow ? "slowed" : "speeded up", number);
    else
        bead_facts_speed(facts, factor, out, size);
}

void bead_badge_text(const struct bead_facts *facts, double time, char *out, size_t size)
{
    say_pace(facts, bead_film_factor(facts->film, time), out, size);
}

static struct bead_text_style badge_style(const struct bead_look *look)
{
    const struct bead_rgb dark = {0.07, 0.08, 0.10}, light = {1, 1, 1};
    return bead_words_style(look, look->label, look->dark ? dark : light, BEAD_ALIGN_MIDDLE);
}

double bead_badge_width(const struct bead_look *look, const struct bead_facts *facts)
{
    struct bead_text_style style = badge_style(look);
    char text[MOST_FACT];
    double factors[2], most = 0;
    bead_film_factors(facts->film, factors);
    /* The third is as wide as the widest rounded number between the other two. */
    const double all[] = {factors[0], factors[1], factors[0] < factors[1] ? 1.88 * pow(10, floor(log10(factors[0]))) : factors[0]};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        say_pace(facts, all[i], text, sizeof text);
        most = fmax(most, bead_words_width(NULL, &style, text));
    }
    return ceil(most + 0.9 * look->label);
}

void bead_badge_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect)
{
    struct bead_text_style style = badge_style(look);
    double width = bead_words_width(cr, &style, text) + 0.9 * look->label, height = fmin(rect.height, 1.4 * look->label),
           top = rect.y + 0.5 * (rect.height - height), round = 0.2 * look->label;
    cairo_new_path(cr);
    cairo_arc(cr, rect.x + round, top + round, round, M_PI, 1.5 * M_PI);
    cairo_arc(cr, rect.x + width - round, top + round, round, -0.5 * M_PI, 0);
    cairo_arc(cr, rect.x + width - round, top + height - round, round, 0, 0.5 * M_PI);
    cairo_arc(cr, rect.x + round, top + height - round, round, 0.5 * M_PI, M_PI);
    cairo_close_path(cr);
    cairo_set_source_rgb(cr, look->accent.r, look->accent.g, look->accent.b);
    cairo_fill(cr);
    bead_text_draw(cr, &style, rect.x + 0.45 * look->label, rect.y + 0.5 * rect.height, text);
}

static size_t words_gather(const struct bead_facts *facts, char text[MOST_FACTS][MOST_FACT])
{
    char number[64], plain[MOST_FACT];
    size_t count = 0;
    if (facts->magnify > 0 && facts->magnify != 1) {
        bead_round_number(facts->magnify, number, sizeof number);
        snprintf(text[count++], MOST_FACT, "displacements \u00d7\u00a0%s", number);
    }
    bead_facts_chain(facts, plain, sizeof plain);
    if (plain[0])
        snprintf(text[count++], MOST_FACT, "%s", plain);
    if (facts->held)
        snprintf(text[count++], MOST_FACT, "largest forces of each frame");
    return count;
}

/* Markup of the next line of facts that fits into `room`; `first` moves on. */
static void next_line(const struct bead_text_style *style, char text[MOST_FACTS][MOST_FACT], size_t count, size_t *first,
                      double room, char *line, size_t size)
{
    char longer[4096], markup[1024];
    for (line[0] = '\0'; *first < count; (*first)++) {
        bead_markup(text[*first], markup, sizeof markup);
        snprintf(longer, sizeof longer, "%s%s%s", line, line[0] ? "   \u00b7   " : "", markup);
        if (line[0] && bead_words_width(NULL, style, longer) > room)
            return;
        snprintf(line, size, "%s", longer);
    }
}

size_t bead_facts_lines(const struct bead_look *look, const struct bead_facts *facts, double room)
{
    struct bead_text_style style = bead_words_style(look, look->label, look->faint, BEAD_ALIGN_MIDDLE);
    char text[MOST_FACTS][MOST_FACT], line[4096];
    size_t count = words_gather(facts, text), lines = 0;
    for (size_t first = 0; first < count; lines++)
        next_line(&style, text, count, &first, room, line, sizeof line);
    return lines;
}

void bead_facts_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, struct bead_rect rect, bool left)
{
    struct bead_text_style style = bead_words_style(look, look->label, look->faint, BEAD_ALIGN_MIDDLE);
    char text[MOST_FACTS][MOST_FACT], line[4096];
    size_t count = words_gather(facts, text), lines = bead_facts_lines(look, facts, rect.width);
    double step = lines > 0 ? rect.height / (double)lines : 0, y = rect.y + 0.5 * step;
    style.across = left ? BEAD_ALIGN_START : BEAD_ALIGN_END;
    for (size_t first = 0; first < count; y += step) {
        next_line(&style, text, count, &first, rect.width, line, sizeof line);
        double wide = bead_words_width(cr, &style, line); /* a single fact that is wider than the frame */
        struct bead_text_style fitted = style;
        fitted.size *= fmin(1, rect.width / fmax(1, wide));
        bead_text_draw(cr, &fitted, left ? rect.x : rect.x + rect.width, y, line);
    }
}

enum { HEADING_MARKUP = 32 * 1024 + 1 };

static double plain_width(cairo_t *cr, const struct bead_text_style *style, const char *plain, size_t length)
{
    char part[1024], markup[HEADING_MARKUP];
    snprintf(part, sizeof part, "%.*s", (int)length, plain);
    bead_text_escape(part, markup, sizeof markup);
    return bead_words_width(cr, style, markup);
}

/* Bytes of the first of two lines of similar width; 0: the text is one word. */
static size_t first_line(cairo_t *cr, const struct bead_text_style *style, const char *plain)
{
    double least = INFINITY;
    size_t found = 0;
    for (const char *end = strchr(plain, ' '); end; end = strchr(end + 1, ' ')) {
        const size_t bytes = (size_t)(end - plain);
        const double widest = fmax(plain_width(cr, style, plain, bytes), plain_width(cr, style, end + 1, strlen(end + 1)));
        found = widest < least ? bytes : found;
        least = fmin(least, widest);
    }
    return found;
}

void bead_lines_draw(cairo_t *cr, struct bead_text_style style, const char *plain, struct bead_rect rect)
{
    char first[1024], markup[2048];
    const bool two = rect.height >= 2 * style.size && plain_width(cr, &style, plain, strlen(plain)) > rect.width;
    const size_t broken = two ? first_line(cr, &style, plain) : 0;
    const double x = style.across == BEAD_ALIGN_END ? rect.x + rect.width : rect.x, step = rect.height / (broken ? 2.0 : 1.0);
    if (broken) {
        snprintf(first, sizeof first, "%.*s", (int)broken, plain);
        bead_words_fit(cr, &style, first, false, rect.width, markup, sizeof markup);
        bead_text_draw(cr, &style, x, rect.y + 0.5 * step, markup);
    }
    bead_words_fit(cr, &style, broken ? plain + broken + 1 : plain, false, rect.width, markup, sizeof markup);
    bead_text_draw(cr, &style, x, rect.y + rect.height - 0.5 * step, markup);
}

bool bead_heading_has(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    return bead_chain_title(chain)[0] || bead_chain_spins(chain)[0] || (spec->label && spec->label[0]);
}

/* Markup of the line beside the name: the label, or the formula; "": neither. */
static void label_markup(const struct bead_chain *chain, char *markup, size_t size)
{
    const char *label = bead_chain_spec(chain)->label;
    char plain[256], marked[1024];
    if (!heading_shows_formula(chain)) {
        bead_text_escape(label ? label : "", markup, size);
        return;
    }
    bead_chain_describe(chain, plain, sizeof plain);
    bead_markup_symbols(plain, marked, sizeof marked);
    bead_markup(marked, markup, size);
}

/* Width, px, of name and M in one line, with the gap after each; M of size 0 is elsewhere. */
static double name_width(const struct bead_look *look, const struct bead_chain *chain, double size, double m_size)
{
    struct bead_text_style style = bead_words_style(look, size, look->ink, BEAD_ALIGN_BASELINE);
    char markup[HEADING_MARKUP];
    double gap = heading_gap * look->gap, all = 0;
    style.bold = true;
    bead_text_escape(bead_chain_title(chain), markup, sizeof markup);
    all += *markup ? bead_words_width(NULL, &style, markup) + gap : 0;
    style.bold = false;
    style.size = m_size;
    bead_text_magnetism(bead_chain_magnetism(chain), markup, sizeof markup);
    return all + (bead_chain_spins(chain)[0] && m_size > 0 ? bead_words_width(NULL, &style, markup) + gap : 0);
}

double bead_label_width(const struct bead_look *look, const struct bead_chain *chain)
{
    struct bead_text_style style = bead_words_style(look, look->label, look->ink, BEAD_ALIGN_BASELINE);
    char label[HEADING_MARKUP];
    label_markup(chain, label, sizeof label);
    return bead_words_width(NULL, &style, label);
}

double bead_heading_width(const struct bead_look *look, const struct bead_chain *chain)
{
    const double size = heading_size * look->title, label = bead_label_width(look, chain);
    return label > 0 ? 1 + name_width(look, chain, size, size) + label : 0;
}

double bead_heading_least(const struct bead_look *look, const struct bead_chain *chain, bool m)
{
    const double size = heading_size * look->title;
    return name_width(look, chain, smallest_name * size, m ? size : 0);
}

/* Long names are set smaller before they are cut. */
static struct bead_text_style name_style(const struct bead_look *look, struct bead_rgb colour)
{
    struct bead_text_style style = bead_words_style(look, look->label, colour, BEAD_ALIGN_MIDDLE);
    style.bold = true;
    style.across = BEAD_ALIGN_END;
    return style;
}

static double name_room(cairo_t *cr, const struct bead_text_style *style, const struct bead_chain *chain)
{
    const char *name = bead_chain_title(chain);
    return ceil(plain_width(cr, style, name, strlen(name)) + 1);
}

double bead_name_least(const struct bead_look *look, const struct bead_chain *chain)
{
    struct bead_text_style style = name_style(look, look->ink);
    style.size *= smallest_image_name;
    return bead_chain_title(chain)[0] ? name_room(NULL, &style, chain) : 0;
}

double bead_name_size(const struct bead_look *look, const struct bead_chain *chain, double width)
{
    const struct bead_text_style style = name_style(look, look->ink);
    return fmax(smallest_image_name, fmin(1, width / name_room(NULL, &style, chain)));
}

void bead_name_draw(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, double size,
                    struct bead_rect rect)
{
    struct bead_text_style style = name_style(look, heading->colour);
    char markup[2048];
    style.size *= size;
    bead_words_fit(cr, &style, bead_chain_title(heading->chain), false, rect.width, markup, sizeof markup);
    bead_text_draw(cr, &style, rect.x + rect.width, rect.y + 0.5 * rect.height, markup);
}

/* The parts of a heading: name, M, and the label beside the name or below it. */
struct heading {
    struct bead_text_style name, m, label;
    char name_markup[HEADING_MARKUP], m_markup[256], label_markup[HEADING_MARKUP];
    double x, m_x, label_x, y, m_y, label_y;
    double room, width; /* px: for the name; of the name in its usual size */
};

static void place_heading(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect,
                          struct heading *h)
{
    const struct bead_chain *chain = heading->chain;
    const double under = heading->lines ? heading_line * look->label : 0, line = rect.height - under;
    const double size = fmin(heading_size * look->title, 0.75 * line), part = size / (heading_size * look->title);
    const bool has_m = bead_chain_spins(chain)[0], below = has_m && heading->lines && heading->below;
    const double gap = heading_gap * look->gap;
    *h = (struct heading){.x = rect.x, .y = rect.y + 0.5 * line + 0.36 * size};
    h->m = bead_words_style(look, size, look->accent, BEAD_ALIGN_BASELINE);
    if (has_m)
        bead_text_magnetism(bead_chain_magnetism(chain), h->m_markup, sizeof h->m_markup);
    const double m_width = has_m ? bead_words_width(cr, &h->m, h->m_markup) : 0;
    double x = rect.x;
    h->room = rect.width - (has_m && !below ? m_width + gap : 0);
    if (bead_chain_title(chain)[0]) {
        h->name = h->m;
        h->name.bold = true;
        h->name.colour = heading->colour;
        bead_text_escape(bead_chain_title(chain), h->name_markup, sizeof h->name_markup);
        h->width = bead_words_width(cr, &h->name, h->name_markup);
        h->name.size *= heading->size;
        x += bead_words_fit(cr, &h->name, bead_chain_title(chain), false, h->room, h->name_markup, sizeof h->name_markup) + gap;
    }
    h->m.size = below ? part * look->label : size;
    h->m_x = below ? rect.x : x;
    h->m_y = below ? h->y + under : h->y;
    h->label_x = heading->lines && !below ? rect.x : h->m_x + (has_m ? bead_words_width(cr, &h->m, h->m_markup) + gap : 0);
    h->label_y = h->y + under;
    h->label = bead_words_style(look, part * look->label, look->faint, BEAD_ALIGN_BASELINE);
    label_markup(chain, h->label_markup, sizeof h->label_markup);
}

/* Long names are set smaller before they are cut. */
double bead_heading_name(const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect)
{
    struct heading h;
    place_heading(NULL, look, heading, rect, &h);
    return fmin(1, fmax(smallest_name, 0.98 * h.room / fmax(1, h.width)));
}

/* Does the label fit at this part of its size? */
static bool label_fits(cairo_t *cr, const struct heading *h, struct bead_rect rect, double smaller)
{
    struct bead_text_style style = h->label;
    style.size *= smaller;
    return bead_words_width(cr, &style, h->label_markup) <= rect.x + rect.width - h->label_x;
}

double bead_heading_label(const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect)
{
    struct heading h;
    place_heading(NULL, look, heading, rect, &h);
    const bool shrinks = h.label_markup[0] && BEAD_SMALLER_LABEL * h.label.size >= least_letters &&
                         !label_fits(NULL, &h, rect, 1) && label_fits(NULL, &h, rect, BEAD_SMALLER_LABEL);
    return shrinks ? BEAD_SMALLER_LABEL : 1;
}

void bead_heading_draw(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, double label,
                       struct bead_rect rect)
{
    struct heading h;
    place_heading(cr, look, heading, rect, &h);
    if (h.name_markup[0])
        bead_text_draw(cr, &h.name, h.x, h.y, h.name_markup);
    if (h.m_markup[0])
        bead_text_draw(cr, &h.m, h.m_x, h.m_y, h.m_markup);
    if (!h.label_markup[0] || !label_fits(cr, &h, rect, label))
        return;
    h.label.size *= label;
    bead_text_draw(cr, &h.label, h.label_x, h.label_y, h.label_markup);
}
