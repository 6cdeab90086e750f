/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws everything in a figure except its views: headings, title and time, the colour bar. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/draw/raster.h"
#include "render/draw/words.h"
#include "render/figure/figure.h"
#include "render/stage/panel.h"
#include "render/view/horizon.h"

struct words {
    char letter[128], magnetism[128], moment[160];
    const char *name, *label;
    bool marked; /* the name is a panel's title, with markup */
};

/* "t = 1.64 ms" in the unit of the axis of time, with as many decimals as the time needs, at most three; "" if no view shows one
 * moment. */
static void moment_words(const struct bead_figure *f, char *markup, size_t size)
{
    const char *unit = bead_chain_time_unit(f->context.chains[0]);
    const int exponent = bead_prefix_exponent(f->time[1], unit);
    const double shown = f->at / bead_power_of_ten(exponent);
    char text[64];
    int decimals = 0;
    while (decimals < 3 && fabs(remainder(shown, bead_power_of_ten(-decimals))) > 1e-6 * shown)
        decimals++;
    bead_number(shown, decimals, text, sizeof text);
    snprintf(markup, f->stills ? size : 1, BEAD_SYMBOL("t") " = %s%s%s%s", text, *unit ? "\u00a0" : "", bead_prefix_sign(exponent),
             unit);
}

/* A panel's heading has the letter, the title and the moment; other figures show the moment above everything. */
static void part_words(const struct bead_figure *f, struct words *words)
{
    bool alone = f->cell_count == 1;
    if (alone && f->set.title)
        words->name = f->set.title;
    words->marked = words->name == f->set.title;
    snprintf(words->letter, sizeof words->letter, "%s%s%s", f->set.letter, !alone && f->set.title && *f->set.letter ? " " : "",
             !alone && f->set.title ? f->set.title : "");
    moment_words(f, words->moment, sizeof words->moment);
}

/* "M = 0.20", with the same decimals for all chains. */
static void figure_magnetism(const struct bead_figure *f, const struct bead_chain *chain, char *text, size_t size)
{
    char number[32];
    const int decimals = bead_magnetism_decimals(f->context.chains, f->context.chain_count);
    bead_number(bead_chain_magnetism(chain), decimals, number, sizeof number);
    snprintf(text, size, BEAD_SYMBOL("M") " = %s", number);
}

static bool words_of(const struct bead_figure *f, const struct bead_cell *cell, struct words *words)
{
    const struct bead_chain *chain = f->context.chains[cell->chain];
    size_t index = (size_t)(cell - f->cells);
    *words = (struct words){.name = bead_chain_title(chain), .label = bead_chain_spec(chain)->label};
    if (!f->part && f->output->panel.title) /* of many chains */
        words->name = f->output->panel.title;
    if (f->part && index == 0)
        part_words(f, words);
    if (!f->part && f->page.paper && f->cell_count > 1 && index < 26)
        snprintf(words->letter, sizeof words->letter, "(%c)", (char)('a' + (int)index));
    if (*bead_chain_spins(chain) && words->name == bead_chain_title(chain))
        figure_magnetism(f, chain, words->magnetism, sizeof words->magnetism);
    return f->output->views.axes && (*words->letter || *words->name || *words->magnetism || *words->moment);
}

/* The words of headings, from everything to a shortened name: the same for all chains, chosen so that the longest fits. Several
 * chains always keep their names, shortened if necessary, to distinguish them. */
enum terseness { NAME_M_LABEL, NAME_M, NAME, CUT_NAME_M, M, CUT_NAME };

static const double shortest_cut = 3; /* of a name beside M, in units of its font size */

struct heading {
    struct words words;
    struct bead_text_style letter, name, magnetism, label;
    double gap;
    bool comma; /* "ordered, M = 1" as in legends; else M is separate, in its colour */
};

static void make_heading(const struct bead_figure *f, const struct bead_cell *cell, struct heading *h)
{
    const struct bead_look *look = &f->look;
    const bool small = f->page.paper || f->part, slide = f->output->paper.style == BEAD_STYLE_SLIDE;
    const bool plain = small || slide; /* like the headings of plots, which may be beside it */
    const double size = f->part || slide ? look->label : look->title;
    (void)words_of(f, cell, &h->words);
    h->letter = h->name = bead_words_style(look, size, look->ink, BEAD_ALIGN_BASELINE);
    h->magnetism = bead_words_style(look, size, plain ? look->ink : look->accent, BEAD_ALIGN_BASELINE);
    h->label = bead_words_style(look, look->label, look->faint, BEAD_ALIGN_BASELINE);
    h->name.bold = !plain;
    h->gap = (plain ? 0.5 : 0.7) * look->label; /* 0.5: an en space, as in headings of plots */
    h->letter.bold = true;
    h->comma = plain;
    if (small)
        h->words.label = h->words.moment;
}

/* Removes the words left out at this terseness. */
static void shorten(struct words *words, enum terseness terse)
{
    bool name = *words->name, magnetism = *words->magnetism;
    if (terse > NAME_M_LABEL)
        words->label = words->moment;
    if ((terse == NAME || terse == CUT_NAME) && name)
        words->magnetism[0] = '\0';
    if (terse == M && magnetism)
        words->name = "";
}

/* Returns the width of the heading with a name no longer than `longest`; draws it if `draw` is set. */
static double put_heading(cairo_t *cr, const struct heading *h, double x, double y, double room, double longest, bool draw)
{
    char name[4096], label[1024], letters[2048], magnetism[160];
    const struct bead_text_style *styles[] = {&h->letter, &h->name, &h->magnetism, &h->label};
    const bool comma = h->comma && *h->words.name;
    const double after[] = {h->gap, comma ? 0 : h->gap, 2 * h->gap, 0};
    snprintf(magnetism, sizeof magnetism, "%s%s", comma && *h->words.magnetism ? ", " : "", h->words.magnetism);
    if (h->words.label == h->words.moment)
        snprintf(label, sizeof label, "%s", h->words.moment);
    else
        bead_text_escape(h->words.label, label, sizeof label);
    bead_markup(h->words.letter, letters, sizeof letters);
    double letter = *h->words.letter ? bead_words_width(cr, &h->letter, letters) + h->gap : 0;
    double after_name = *magnetism ? after[1] + bead_words_width(cr, &h->magnetism, magnetism) : 0;
    after_name += *label ? 2 * h->gap + bead_words_width(cr, &h->label, label) : 0;
    bead_words_fit(cr, &h->name, h->words.name, h->words.marked, draw ? room - letter - after_name : INFINITY, name, sizeof name);
    const char *words[] = {letters, name, magnetism, label};
    double begin = x, end = x;
    for (size_t i = 0; i < 4; i++) {
        if (!*words[i])
            continue;
        if (draw)
            bead_text_draw(cr, styles[i], x, y, words[i]);
        double width = bead_words_width(cr, styles[i], words[i]);
        end = x + (i == 1 ? fmin(width, longest) : width);
        x = end + after[i];
    }
    return end - begin;
}

int bead_figure_terseness(const struct bead_figure *f, cairo_t *cr)
{
    enum terseness terse = (enum terseness)f->set.terseness;
    for (size_t c = 0; c < f->cell_count; c++) {
        for (; terse < CUT_NAME; terse++) {
            struct heading h;
            make_heading(f, &f->cells[c], &h);
            shorten(&h.words, terse);
            if (terse == CUT_NAME_M && f->cell_count == 1)
                continue;
            double longest = terse == CUT_NAME_M ? shortest_cut * f->look.title : INFINITY;
            if (put_heading(cr, &h, 0, 0, 0, longest, false) <= f->cells[c].heading.width)
                break;
        }
    }
    return terse;
}

bool bead_figure_heading(const struct bead_figure *f, const struct bead_cell *cell, cairo_t *cr)
{
    struct heading h;
    bool any = words_of(f, cell, &h.words);
    if (!any || !cr)
        return any;
    const struct bead_rect *box = &cell->heading;
    make_heading(f, cell, &h);
    shorten(&h.words, (enum terseness)bead_figure_terseness(f, cr));
    put_heading(cr, &h, box->x, box->y + box->height - bead_heading_drop * f->look.label, box->width, INFINITY, true);
    return true;
}

/* "t = 1.64 ms, displacements x 60": for figures with beads or profiles. */
static void line_words(const struct bead_figure *f, char *markup, size_t size)
{
    char magnify[64];
    moment_words(f, markup, size);
    for (size_t v = 0; f->stills && v < f->view_count; v++) {
        const struct bead_tile *panel = &f->cells[0].panel[v];
        if (!bead_view_has(panel->type, BEAD_SHOWS_BEADS))
            continue;
        bead_round_number(panel->setup.magnify, magnify, sizeof magnify);
        size_t used = strlen(markup);
        snprintf(markup + used, size - used, "  \u00b7  displacements \u00d7 %s", magnify);
        break;
    }
}

bool bead_figure_line(const struct bead_figure *f, cairo_t *cr)
{
    const struct bead_look *look = &f->look;
    const char *title = bead_page_titled(&f->page) ? f->context.scene->title : "";
    if (f->part || !f->output->views.axes || (!*title && !f->stills))
        return false;
    if (!cr)
        return true;
    char markup[1024], moment[256];
    line_words(f, moment, sizeof moment);
    struct bead_text_style bold = bead_words_style(look, 1.2 * look->title, look->ink, BEAD_ALIGN_BASELINE),
                           right = bead_words_style(look, look->label, look->ink, BEAD_ALIGN_BASELINE);
    bold.bold = true;
    right.across = *title ? BEAD_ALIGN_END : BEAD_ALIGN_START;
    const double gap = 2 * look->label;
    const double y = f->line.y + look->title, taken = bead_words_width(cr, &right, moment);
    double from = f->line.x, to = from + f->line.width;
    if (bead_words_fit(cr, &bold, title, false, INFINITY, markup, sizeof markup) > to - from - (taken > 0 ? taken + gap : 0)) {
        from = f->area.x + f->margin; /* as over plots */
        to = f->area.x + f->area.width - f->margin;
    }
    if (bead_words_fit(cr, &bold, title, false, to - from - (taken > 0 ? taken + gap : 0), markup, sizeof markup) > 0)
        bead_text_draw(cr, &bold, from, y, markup);
    if (*moment)
        bead_text_draw(cr, &right, *title ? to : from, y, moment);
    return true;
}

/* Draws the time until which the two runs of the chain agree. */
static void draw_trust(const struct bead_figure *f, const struct bead_cell *cell, cairo_t *cr)
{
    struct bead_trust trust = bead_trust_make(f->context.chains[0], f->context.tolerance_factor);
    trust.from = f->time[0];
    trust.until = cell->horizon;
    trust.bold = !f->page.paper;
    bead_trust_draw(cr, &f->look, &trust, cell->trust, false);
}

void bead_figure_bar_title(const struct bead_figure *f, char *title, size_t size)
{
    const struct bead_field_info *field = bead_chain_field(f->context.chains[0], f->output->shown.field);
    const char *name = f->view_count > 1 ? bead_field_short(field) : field->title; /* as on the profile's axis */
    bool largest = false;
    for (size_t v = 0; v < f->view_count; v++)
        largest = largest || bead_view_has(f->cells[0].panel[v].type, BEAD_SHOWS_IMAGE);
    largest = largest && f->output->image.sampling == BEAD_SAMPLING_MAX;
    snprintf(title, size, largest ? "largest %s" : "%s", name);
    if (f->range.hidden > 0) { /* in the unit of the axis, which follows in brackets */
        const char *unit = bead_chain_field(f->context.chains[0], f->output->shown.field)->unit;
        struct bead_axis axis;
        bead_axis_make(&axis, f->range.low, f->range.high, unit, f->colours.scale, f->bar.height, f->look.tick, false);
        char peak[32];
        bead_round_number(f->range.hidden * axis.factor, peak, sizeof peak);
        size_t used = strlen(title);
        snprintf(title + used, size - used, "; peak %s", peak);
    }
}

/* Shortens the bar by its pointed ends, which are level with the ends of the images. */
static void figure_draw_bar(const struct bead_figure *f, cairo_t *cr)
{
    struct bead_rect bar = f->bar;
    int point = (int)ceil(0.9 * bar.width);
    const struct bead_field_info *field = bead_chain_field(f->context.chains[0], f->output->shown.field);
    bar.y += f->range.over ? point : 0;
    bar.height -= (f->range.over + f->range.under) * point;
    char title[64];
    bead_figure_bar_title(f, title, sizeof title);
    if (bar.height > 0)
        bead_colour_bar_draw(cr, &f->look, &f->colours, field->unit, title, bar, f->range.over, f->range.under);
}

enum bead_error bead_figure_decorate(struct bead_figure *f, cairo_t *cr, struct bead_message *msg)
{
    bead_figure_line(f, cr);
    for (size_t c = 0; c < f->cell_count; c++) {
        bead_figure_heading(f, &f->cells[c], cr);
        if (f->cells[c].trust.height > 0)
            draw_trust(f, &f->cells[c], cr);
        for (size_t v = 0; v < f->view_count; v++)
            BEAD_TRY(f->cells[c].panel[v].type->decorate(f->cells[c].panel[v].view, cr, msg));
    }
    if (f->bar.width > 0)
        figure_draw_bar(f, cr);
    return bead_raster_status(cr, "figure", msg);
}
