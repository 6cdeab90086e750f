/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The places of the parts of a figure: plots in rows and columns, headings above them, the bar beside them; they fill the page and
 * stay within it; texts do not touch. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/figure/figure.h"
#include "tests/sweeps.h"
#include "tests/texts.h"

enum { MOST_CHAINS = 7 };

struct laid {
    struct bead_scene *scene;
    struct bead_chain *chains[MOST_CHAINS];
    const struct bead_chain *shown[MOST_CHAINS];
    struct bead_look look;
    struct bead_figure *figure;
    struct texts texts;
};

/* A figure of the scene's output on `area`, NULL: on its page. */
static void lay_out_scene(struct laid *l, const char *text, const struct bead_rect *area)
{
    l->scene = parse(text);
    const size_t chains = l->scene->chain_count;
    for (size_t c = 0; c < chains; c++) {
        assert_int_equal(bead_chain_create(l->scene, c, &l->chains[c], NULL), BEAD_OK);
        l->shown[c] = l->chains[c];
    }
    const struct bead_run_context context = {
        .scene = l->scene, .chains = l->shown, .chain_count = chains, .end = 1e-3, .resolution = 1e-6, .tolerance_factor = 1e-2};
    struct bead_page page;
    struct bead_insets insets;
    struct bead_message msg = {""};
    assert_int_equal(bead_page_find(&l->scene->outputs[0], &page, NULL), BEAD_OK);
    bead_page_look(&page, &l->scene->outputs[0].paper, &l->look);
    assert_int_equal(bead_figure_create(&l->scene->outputs[0], &context, &page, &l->look, NULL, &l->figure, &msg), BEAD_OK);
    const struct bead_rect whole = {0, 0, page.width, page.height};
    if (bead_figure_put(l->figure, area ? *area : whole, &(struct bead_insets){0}, &insets, &msg))
        fail_msg("%s: %s", text, msg.text);
}

/* Of several chains. */
static void lay_out(struct laid *l, size_t chains, const char *output, const struct bead_rect *area)
{
    static const char *const beads[] = {"{bead: large-steel, count: 40}", "{cell: [large-steel, aluminium], count: 20}"};
    char text[3000];
    size_t used = (size_t)snprintf(text, sizeof text, "title: A wave\nchains:\n");
    for (size_t c = 0; c < chains; c++)
        used +=
            (size_t)snprintf(text + used, sizeof text - used, "  - {name: chain %zu, beads: [%s], wall: brass}\n", c, beads[c % 2]);
    snprintf(text + used, sizeof text - used, "simulate: {until: 1 ms}\noutputs: [{image: a.png, %s}]\n", output);
    lay_out_scene(l, text, area);
}

static void clear(struct laid *l)
{
    bead_figure_destroy(l->figure);
    for (size_t c = 0; c < l->scene->chain_count; c++)
        bead_chain_destroy(l->chains[c]);
    bead_scene_free(l->scene);
}

static int right_of(const struct bead_rect *r)
{
    return r->x + r->width;
}

static int bottom_of(const struct bead_rect *r)
{
    return r->y + r->height;
}

/* Views of one column have one width; those of one row have one height, as have all rows of a view. */
static void assert_grid(const struct bead_figure *f)
{
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *tile = &f->tiles[t];
        const struct bead_cell *cell = tile->cell;
        const size_t view = t % f->view_count;
        assert_int_equal(cell->column, cell->chain % f->columns);
        assert_int_equal(cell->row, cell->chain / f->columns);
        const struct bead_rect *plot = &tile->plot, *top = &f->cells[cell->column].panel[view].plot,
                               *left = &f->cells[cell->row * f->columns].panel[view].plot;
        assert_true(plot->width == f->tiles[0].plot.width && plot->height == f->tiles[view].plot.height);
        assert_int_equal(plot->x, top->x);
        assert_int_equal(plot->y, left->y);
        assert_true(plot->width >= 12 && plot->height >= 12);
        assert_true(cell->column == 0 || plot->x > right_of(&f->cells[cell->chain - 1].panel[view].plot));
        assert_true(cell->row == 0 ||
                    cell->panel[0].plot.y > bottom_of(&f->cells[cell->chain - f->columns].panel[f->view_count - 1].plot));
        assert_true(view == 0 || plot->y >= bottom_of(&tile[-1].plot) + (int)(0.5 * f->look.label));
    }
}

/* A few beads, as large as their row allows, are less wide than the page: all plots of the column end where they do. */
static void assert_width(const struct bead_figure *f, bool few, const char *what)
{
    const struct bead_rect *plot = &f->tiles[0].plot;
    double most = 0;
    for (size_t t = 0; f->view_count > 1 && t < f->tile_count; t++) {
        if (f->tiles[t].type->most_width)
            most = fmax(most, f->tiles[t].type->most_width(&f->tiles[t].setup, f->tiles[t].plot.height));
    }
    assert_true(most == 0 || plot->width <= most);
    for (size_t t = 0; f->view_count > 1 && t < f->tile_count; t++) { /* nor higher than a view can use */
        const struct bead_tile *tile = &f->tiles[t];
        assert_true(!tile->type->most_height || tile->plot.height <= tile->type->most_height(&tile->setup, plot->width));
    }
    const double part = plot->width * (double)f->columns / f->area.width;
    if (!(few ? plot->width > most - 1.5 && part < 0.8 : part > 0.5))
        fail_msg("%s: %zu columns of %d px take %.2f of the page; beads are %.1f px long", what, f->columns, plot->width, part,
                 most);
}

/* A line for each heading, and one for the horizon, between a chain's plots and the parts above; as wide as the plots, the last one
 * up to the margin, unless that is beside the bar of colours. */
static void assert_headings(const struct laid *l, bool trust)
{
    const struct bead_figure *f = l->figure;
    for (size_t c = 0; c < f->cell_count; c++) {
        const struct bead_cell *cell = &f->cells[c];
        const struct bead_rect *plot = &cell->panel[0].plot;
        const bool last = cell->column + 1 == f->columns && (cell->row == 0 || f->bar.width == 0);
        const int above = cell->row > 0 ? bottom_of(&f->cells[c - f->columns].panel[f->view_count - 1].plot) : bottom_of(&f->line);
        assert_true(cell->heading.x == plot->x && cell->heading.width == plot->width && cell->heading.y >= above);
        assert_true(cell->heading.height >= (f->cell_count > 1 ? (int)l->look.title : 0));
        assert_true(cell->trust.x == plot->x && (!trust || cell->trust.height >= l->look.label));
        assert_true(bottom_of(&cell->heading) <= cell->trust.y && bottom_of(&cell->trust) <= plot->y);
        assert_true(trust || (bottom_of(&cell->heading) == plot->y && cell->trust.height == 0));
        if (last)
            assert_int_equal(right_of(&cell->trust), right_of(&f->area) - (int)f->margin);
        else
            assert_int_equal(cell->trust.width, plot->width);
    }
    assert_true(f->line.x == f->cells[0].panel[0].plot.x && f->line.y >= f->area.y && f->line.height >= 1.2 * l->look.title);
    assert_int_equal(right_of(&f->line), right_of(&f->cells[f->columns - 1].panel[0].plot));
}

/* The widest labels of a bar of so many px, for ranges that end between 1 and 1000 units. */
static double widest_labels(const struct laid *l)
{
    const struct bead_figure *f = l->figure;
    const double *range = l->scene->outputs[0].colours.range;
    double widest = 0;
    for (double high = 1; high < 1000; high *= 1.13) {
        struct bead_colours colours = f->colours;
        colours.low = isnan(range[0]) ? (f->colours.low < 0 ? -high : colours.scale == BEAD_SCALE_LOG ? 1e-4 * high : 0) : range[0];
        colours.high = isnan(range[1]) ? high : range[1];
        char title[64];
        bead_figure_bar_title(f, title, sizeof title);
        widest =
            fmax(widest, bead_colour_bar_draw(NULL, &l->look, &colours, bead_chain_field(l->shown[0], f->output->shown.field)->unit,
                                              title, f->bar, true, true));
    }
    return widest;
}

/* The bar is as high as all plots, about a letter beside them, and its labels reach to the page's margin (a tenth of a letter into
 * it for a few ranges, as the room is that of three). */
static void assert_bar(const struct laid *l, bool few, const char *what)
{
    const struct bead_figure *f = l->figure;
    const struct bead_rect *first = &f->cells[0].panel[0].plot, *last = &f->cells[f->columns - 1].panel[0].plot;
    const struct bead_tile *lowest = &f->cells[f->columns * (f->rows - 1)].panel[f->view_count - 1];
    assert_int_equal(f->bar.y, first->y);
    assert_int_equal(bottom_of(&f->bar), bottom_of(&lowest->plot));
    assert_int_equal(f->bar.width, (int)fmax(4, round(bead_colour_bar_width(&l->look, BEAD_BAR_OF_FIGURE))));
    const double em = l->look.label, gap = f->bar.x - right_of(last);
    assert_true(gap >= 0.85 * em && gap < 3 * em);
    const double left = right_of(&f->area) - f->margin - right_of(&f->bar) - widest_labels(l);
    if (!(left > -0.12 * em && (few || left < 0.7 * em)))
        fail_msg("%s: %.1f px, %.2f letters, are left beside the labels of the bar", what, left, left / em);
}

static const char *const styles[] = {"size: [1280, 720]", "size: [600, 800]", "style: paper, dpi: 300", "style: slide",
                                     "style: movie, size: [1280, 720]"};
enum { STYLES = sizeof styles / sizeof styles[0] };

static void parts_stand_in_a_grid(void **state)
{
    (void)state;
    static const struct {
        const char *views;
        size_t most;
        bool bar, trust, few;
    } cases[] = {{"field: force", 7, true, false, false},
                 {"field: velocity", 4, true, false, false},
                 {"field: force, range: [0, 12.5]", 3, true, false, false},
                 {"field: force, scale: log", 2, true, false, false},
                 {"field: force, trust: true", 4, true, true, false},
                 {"field: force, views: [profile, spacetime], at: 0.3 ms", 3, true, false, false},
                 {"field: velocity, views: [beads, profile, spacetime], at: 0.3 ms", 2, true, false, false},
                 {"field: force, views: [profile], at: 0.3 ms", 4, false, false, false},
                 {"field: velocity, views: [beads, profile], at: 0.3 ms, beads: [0, 2]", 3, true, false, true},
                 {"field: force, views: [beads, spacetime], at: 0.3 ms, beads: [3, 5]", 1, true, false, true},
                 {"field: force, views: [beads, profile], at: 0.3 ms", 3, true, false, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (size_t chains = 1; chains <= cases[k].most; chains++) {
            const size_t style = (k + chains) % STYLES;
            char output[300];
            struct laid l = {.texts = {.count = 0}};
            snprintf(output, sizeof output, "%s, %s", styles[chains > 4 ? 0 : style], cases[k].views);
            lay_out(&l, chains, output, NULL);
            assert_grid(l.figure);
            assert_width(l.figure, cases[k].few, output);
            if (l.figure->line.height > 0)
                assert_headings(&l, cases[k].trust);
            if (cases[k].bar)
                assert_bar(&l, cases[k].few, output);
            else
                assert_int_equal(l.figure->bar.width, 0);
            clear(&l);
        }
    }
}

/* A bar says what its images show: the largest value of each pixel if they do; beads and curves have their own values. */
static void bars_say_what_images_show(void **)
{
    static const struct {
        const char *output, *begins;
    } bars[] = {{"field: force, sample: max", "largest "},
                {"field: force, sample: area", "bead force"},
                {"field: force, sample: max, views: [beads, spacetime], at: 0.3 ms", "largest "},
                {"field: force, sample: max, views: [beads, profile], at: 0.3 ms", "force"},
                {"field: velocity", "velocity"}};
    for (size_t i = 0; i < sizeof bars / sizeof *bars; i++) {
        struct laid l = {.texts = {.count = 0}};
        char title[64];
        lay_out(&l, 2, bars[i].output, NULL);
        bead_figure_bar_title(l.figure, title, sizeof title);
        if (strncmp(title, bars[i].begins, strlen(bars[i].begins)) != 0)
            fail_msg("%s: '%s', not '%s'", bars[i].output, title, bars[i].begins);
        clear(&l);
    }
}

/* ---- texts ---- */

/* All words around images are on the page, apart, and near the page's margin on each side. */
static void texts_are_apart_and_fill_the_page(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3 * STYLES; i++) {
        const size_t chains = 1 + i % 4;
        const bool trust = i >= 2 * STYLES;
        struct laid l = {.texts = {.count = 0}};
        struct bead_message msg = {""};
        char output[200];
        snprintf(output, sizeof output, "%s, field: %s%s", styles[i % STYLES], i < STYLES ? "force" : "velocity",
                 trust ? ", trust: true" : "");
        lay_out(&l, chains, output, NULL);
        const struct bead_text_watch watch = {texts_note, &l.texts};
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1); /* texts are reported wherever they are */
        assert_true(bead_text_watch(surface, &watch));
        cairo_t *cr = cairo_create(surface);
        assert_int_equal(bead_figure_start(l.figure, &msg), BEAD_OK);
        if (bead_figure_decorate(l.figure, cr, &msg))
            fail_msg("%s", msg.text);
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
        assert_true(l.texts.count > 6 + 4 * chains);
        const struct bead_rect *page = &l.figure->area;
        double left = page->width, top = page->height, right = 0, bottom = 0;
        size_t trusts = 0, letters = 0;
        for (size_t t = 0; t < l.texts.count; t++) {
            const struct text *a = &l.texts.text[t];
            trusts += strstr(a->markup, "predictable") != NULL;
            const char letter[] = {'(', (char)('a' + (int)letters), ')', '\0'};
            letters += strcmp(a->markup, letter) == 0;
            for (size_t u = 0; u < t; u++) {
                const struct text *b = &l.texts.text[u];
                if (a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height)
                    fail_msg("%s: '%s' and '%s' collide", output, a->markup, b->markup);
            }
            left = fmin(left, a->x);
            top = fmin(top, a->y);
            right = fmax(right, a->x + a->width);
            bottom = fmax(bottom, a->y + a->height);
        }
        assert_int_equal(trusts, trust ? chains : 0); /* above each chain */
        assert_int_equal(letters, strstr(output, "paper") && chains > 1 ? chains : 0);
        const double margin = l.figure->margin, em = l.look.label;
        const double off[] = {left - margin, top - margin, page->width - margin - right, page->height - margin - bottom};
        for (size_t side = 0; side < 4; side++) {
            if (!(off[side] > -0.35 * em && off[side] < 1.2 * em))
                fail_msg("%s, %zu chains: texts end %.2f letters before the margin at side %zu", output, chains, off[side] / em,
                         side);
        }
        clear(&l);
    }
}

/* A title that is as long as its line is not shortened where nothing else is in the line. */
static void titles_take_all_of_their_line(void **state)
{
    (void)state;
    struct laid l = {.texts = {.count = 0}};
    char title[600] = "A";
    lay_out(&l, 1, styles[0], NULL);
    const struct bead_text_style style = {.family = l.look.family, .size = 1.2 * l.look.title, .bold = true};
    double width = 0, height;
    while (width < l.figure->line.width - l.look.label) { /* a letter of l is thinner */
        strcat(title, "l");
        bead_text_size(NULL, &style, title, &width, &height);
    }
    assert_true(width < l.figure->line.width);
    char *own = l.scene->title;
    l.scene->title = title;
    const struct bead_text_watch watch = {texts_note, &l.texts};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    assert_true(bead_figure_line(l.figure, cr));
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    l.scene->title = own;
    assert_true(l.texts.count == 1 && strstr(l.texts.text[0].markup, title));
    clear(&l);
}

/* Laid out elsewhere on the page, all parts move along; laid out again, they are where they were. */
static void layouts_move_with_their_area(void **state)
{
    (void)state;
    const struct bead_rect areas[] = {{0, 0, 900, 600}, {131, 57, 900, 600}};
    struct bead_rect plot[2][4], bar[2], heading[2];
    for (int i = 0; i < 2; i++) {
        struct laid l = {.texts = {.count = 0}};
        struct bead_insets insets;
        lay_out(&l, 4, "size: [1280, 720], field: velocity", &areas[i]);
        assert_int_equal(bead_figure_put(l.figure, areas[i], &(struct bead_insets){0}, &insets, NULL), BEAD_OK);
        for (size_t c = 0; c < 4; c++)
            plot[i][c] = l.figure->cells[c].panel[0].plot;
        bar[i] = l.figure->bar;
        heading[i] = l.figure->cells[3].heading;
        assert_true(insets.left == plot[i][0].x - areas[i].x && insets.top == plot[i][0].y - areas[i].y);
        assert_true(insets.right == right_of(&areas[i]) - right_of(&plot[i][3]) &&
                    insets.bottom == bottom_of(&areas[i]) - bottom_of(&plot[i][3]));
        clear(&l);
    }
    for (size_t c = 0; c < 6; c++) {
        const struct bead_rect *a = c < 4    ? &plot[0][c]
                                    : c == 4 ? &bar[0]
                                             : &heading[0],
                               *b = c < 4    ? &plot[1][c]
                                    : c == 4 ? &bar[1]
                                             : &heading[1];
        assert_true(a->x + 131 == b->x && a->y + 57 == b->y && a->width == b->width && a->height == b->height);
    }
}

/* Three chains leave no quarter of a screen empty, nor of a column of a paper; of more chains at most a sixth of the cells is. */
static void pages_are_full(void **state)
{
    (void)state;
    for (size_t chains = 2; chains <= MOST_CHAINS; chains++) {
        for (size_t s = 0; s < STYLES; s++) {
            static struct laid l;
            char output[200];
            snprintf(output, sizeof output, "field: force, %s", styles[s]);
            lay_out(&l, chains, output, NULL);
            const size_t empty = l.figure->rows * l.figure->columns - chains;
            if (6 * empty > l.figure->rows * l.figure->columns)
                fail_msg("%s: %zu chains leave %zu of %zu x %zu cells empty", output, chains, empty, l.figure->columns,
                         l.figure->rows);
            clear(&l);
        }
    }
}

/* Headings say all, then less where there is less room: first the label goes, then M; of one chain the name rather than M, of
 * several names are cut. All chains say the same; nothing leaves its heading. */
static void headings_say_less_in_less_room(void **)
{
    static const char *const names[] = {"An ordered chain of many beads", "A disordered chain of many beads", "A chain"};
    enum { NAME = 1, CUT = 2, M = 4, LABEL = 8 };
    for (size_t chains = 1; chains <= 3; chains += 2) {
        static const int levels[] = {NAME | M | LABEL, NAME | M, NAME, CUT | M, M, CUT};
        unsigned met = 0;
        int last = 0;
        for (int width = 1800; width >= 170; width = width * 7 / 8) {
            static struct laid l;
            char text[2000];
            size_t used = (size_t)snprintf(text, sizeof text, "chains:\n");
            for (size_t c = 0; c < chains; c++)
                used +=
                    (size_t)snprintf(text + used, sizeof text - used,
                                     "  - {name: %s, label: as the magnets say, beads: [{cell: [large-steel, aluminium], count: 6, "
                                     "spins: \"110111\"}]}\n",
                                     names[c]);
            snprintf(text + used, sizeof text - used, "simulate: {until: 1 ms}\noutputs: [{image: a.png, size: [%d, 500]}]\n",
                     width);
            lay_out_scene(&l, text, NULL);
            cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 16, 16);
            const struct bead_text_watch watch = {texts_note, &l.texts};
            assert_true(bead_text_watch(surface, &watch));
            cairo_t *cr = cairo_create(surface);
            for (size_t c = 0; c < chains; c++) {
                const struct bead_cell *cell = &l.figure->cells[c];
                int said = 0, level = 0;
                l.texts.count = 0;
                assert_true(bead_figure_heading(l.figure, cell, cr));
                for (size_t i = 0; i < l.texts.count; i++) {
                    const struct text *t = &l.texts.text[i];
                    said |= strcmp(t->markup, names[c]) == 0               ? NAME
                            : strstr(t->markup, " = 0.")                   ? M
                            : strcmp(t->markup, "as the magnets say") == 0 ? LABEL
                                                                           : CUT;
                    assert_true(t->x >= cell->heading.x - 1 && t->x + t->width <= cell->heading.x + cell->heading.width + 1);
                }
                if (c > 0 && (said & NAME) && (levels[last] & CUT)) /* a short name needs no cut */
                    said += CUT - NAME;
                while (level < 6 && levels[level] != said)
                    level++;
                if (level == 6 || (c > 0 ? level != last : chains == 1 && level < last))
                    fail_msg("%zu chains on %d px: chain %zu says %d after level %d", chains, width, c, said, last);
                if (c == 0) {
                    last = level;
                    met |= 1u << level;
                }
            }
            cairo_destroy(cr);
            cairo_surface_destroy(surface);
            clear(&l);
        }
        assert_int_equal(met, chains == 1 ? 0x37 : 0x3f); /* one chain has no need of its name beside M */
    }
}

/* In the line above stills the title begins where plots do, or where it has no room beside the moment at the page's margin; it is
 * shortened there, and two letters before the moment, which ends with the line, it ends. */
static void titles_leave_room_for_moments(void **)
{
    unsigned met = 0;
    for (int width = 1600; width >= 300; width = width * 9 / 10) {
        static struct laid l;
        char text[600];
        snprintf(text, sizeof text,
                 "title: A wave through a chain of steel balls\nchain: {beads: [{bead: large-steel, count: 9}]}\nsimulate: {until: "
                 "1 ms}\n"
                 "outputs: [{image: a.png, views: [profile], at: 0.3 ms, size: [%d, 400]}]\n",
                 width);
        lay_out_scene(&l, text, NULL);
        const struct bead_figure *f = l.figure;
        const struct bead_rect *line = &f->line;
        const struct bead_text_watch watch = {texts_note, &l.texts};
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
        assert_true(bead_text_watch(surface, &watch));
        cairo_t *cr = cairo_create(surface);
        l.texts.count = 0;
        assert_true(bead_figure_line(f, cr) && l.texts.count == 2);
        const struct text *title = &l.texts.text[0], *moment = &l.texts.text[1];
        const struct bead_text_style bold = {.family = l.look.family, .size = 1.2 * l.look.title, .bold = true},
                                     plain = {.family = l.look.family, .size = l.look.label};
        double whole, taken, height;
        bead_text_size(NULL, &bold, l.scene->title, &whole, &height);
        bead_text_size(NULL, &plain, moment->markup, &taken, &height);
        const double spare = line->width - whole - taken - 2 * l.look.label, page = f->area.width - 2 * f->margin;
        const bool at_plots = spare >= 0, cut = whole + taken + 2 * l.look.label > page;
        if (fabs(spare) > 2) {
            assert_true(fabs(title->x - (at_plots ? line->x : f->area.x + f->margin)) < 3);
            assert_true(fabs(moment->x + moment->width - (at_plots ? line->x + line->width : f->area.x + f->margin + page)) < 3);
            met |= at_plots ? 1 : cut ? 4 : 2;
        }
        assert_true(title->x + title->width <= moment->x - 2 * l.look.label + 3);
        assert_true(cut || strcmp(title->markup, l.scene->title) == 0);
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
        clear(&l);
    }
    assert_int_equal(met, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pages_are_full),
                                       cmocka_unit_test(parts_stand_in_a_grid),
                                       cmocka_unit_test(bars_say_what_images_show),
                                       cmocka_unit_test(texts_are_apart_and_fill_the_page),
                                       cmocka_unit_test(titles_take_all_of_their_line),
                                       cmocka_unit_test(layouts_move_with_their_area),
                                       cmocka_unit_test(headings_say_less_in_less_room),
                                       cmocka_unit_test(titles_leave_room_for_moments)};
    return cmocka_run_group_tests_name("layout of figures", tests, NULL, NULL);
}
