/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact sheets: the configurations they show, and the places of pictures, spins, numbers and words. But for the last two
 * tests nothing is run: the results of runs are made up. */
#include "beadreel/render.h"
#include "render/draw/looks.h"
#include "render/figure/contact_sheet.h"
#include "render/view/orientation.h"
#include "sessions.h"
#include "strokes.h"
#include "tests/scratch.h"
#include "tests/sweeps.h"
#include "tests/texts.h"

struct laid {
    struct bead_scene *scene;
    struct bead_sweep *sweep;
    struct contact_sheet sheet;
    cairo_surface_t *surface;
    struct texts texts;
};

static enum bead_error lay_out(struct laid *l, const char *sweep, const char *output)
{
    struct bead_message msg = {""};
    char text[1000];
    snprintf(text, sizeof text, "title: A sheet\n%s\noutputs: [{sheet: sheet.png, %s}]\n", sweep, output);
    *l = (struct laid){.scene = parse(text)};
    if (bead_sweep_create(l->scene, &l->sweep, &msg))
        fail_msg("%s", msg.text);
    struct contact_sheet *s = &l->sheet;
    *s = (struct contact_sheet){.output = &l->scene->outputs[0], .sweep = l->sweep, .end = 1e-3};
    assert_int_equal(bead_page_find(s->output, &s->page, &msg), BEAD_OK);
    bead_page_look(&s->page, &s->output->paper, &s->look);
    s->small = 0.85 * s->look.tick;
    s->orientation = bead_orientation_of(s->output);
    assert_int_equal(bead_colormap_load("ember", &s->map, &msg), BEAD_OK);
    s->colours = (struct bead_colours){&s->map, BEAD_SCALE_LINEAR, 0, 1, 0};
    return contact_sheet_arrange(s, &msg);
}

static void clear(struct laid *l)
{
    contact_sheet_clear(&l->sheet);
    bead_sweep_close(l->sweep);
    bead_scene_free(l->scene);
    if (l->surface)
        cairo_surface_destroy(l->surface);
}

static int right_of(struct bead_rect r)
{
    return r.x + r.width;
}

static int end_of(struct bead_rect r)
{
    return r.y + r.height;
}

/* Pictures of one size in a grid, 1.1 numbers apart; spins along the chain before each, numbers below; names of rows at the left,
 * the bar at the right, as high as all rows. */
static void assert_places(const struct laid *l, const char *what)
{
    const struct contact_sheet *s = &l->sheet;
    const double small = s->small;
    const int gap = (int)(1.1 * small), spins = (int)fmax(2, round(0.55 * small)), apart = (int)fmax(1, round(0.22 * small)),
              words = (int)round(3.3 * small);
    const bool down = s->orientation == BEAD_TIME_DOWN;
    const struct bead_rect first = s->images[0].picture;
    struct bead_rect before = {0};
    double bold = 0;
    size_t row = (size_t)-1;
    for (size_t r = 0; r < s->row_count; r++) {
        char name[400];
        struct bead_text_style style = {.family = s->look.family, .size = s->look.tick, .bold = true};
        double width, height;
        contact_sheet_row_name(s, &s->rows[r], name, sizeof name);
        bead_text_size(NULL, &style, name, &width, &height);
        bold = fmax(bold, *name ? width : 0);
    }
    if (fabs(s->label_width - (bold > 0 ? bold + s->look.gap : 0)) > 0.01)
        fail_msg("%s: names have %g px, not %g", what, s->label_width, bold);
    for (size_t i = 0; i < s->image_count; i++) {
        const struct contact_image *image = &s->images[i];
        const struct bead_rect p = image->picture,
                               box = {down ? p.x : image->spins.x, down ? image->spins.y : p.y,
                                      right_of(p) - (down ? p.x : image->spins.x), end_of(p) - (down ? image->spins.y : p.y)};
        const bool begins = image->row != row;
        assert_true(p.width == first.width && p.height == first.height);
        assert_true(down ? image->spins.width == p.width && image->spins.x == p.x && image->spins.height == spins &&
                               p.y - end_of(image->spins) == apart
                         : image->spins.height == p.height && image->spins.y == p.y && image->spins.width == spins &&
                               p.x - right_of(image->spins) == apart);
        assert_true(image->words.x == box.x && image->words.width == box.width && image->words.y == end_of(p) &&
                    image->words.height == words);
        if (begins && abs(box.x - (int)(s->look.margin + s->label_width + 1.1 * small)) > 2 &&
            abs(box.x - (int)(s->look.margin + s->label_width)) > 2)
            fail_msg("%s: row %zu begins at %d, not at %g", what, image->row, box.x, s->look.margin + s->label_width);
        if (!begins)
            assert_true(box.y == before.y && abs(box.x - right_of(before) - gap) <= 1);
        else if (i > 0)
            assert_true(box.y - end_of(before) >= words + gap && box.y - end_of(before) <= words + gap + 3);
        row = image->row;
        before = box;
    }
    const struct contact_image *last = &s->images[s->image_count - 1];
    assert_int_equal(s->bar.y, s->orientation == BEAD_TIME_DOWN ? s->images[0].spins.y : s->images[0].picture.y);
    assert_true(abs(end_of(s->bar) - end_of(last->picture)) <= 2);
    assert_true(abs(s->bar.width - (int)round(bead_colour_bar_width(&s->look, BEAD_BAR_OF_SHEET))) <= 1);
    assert_true(abs(end_of(last->words) - (s->page.height - (int)s->look.margin)) <= 3 + (int)s->row_count);
    int most = 0;
    for (size_t i = 0; i < s->image_count; i++)
        most = right_of(s->images[i].picture) > most ? right_of(s->images[i].picture) : most;
    if (s->rows[0].count == s->columns)
        assert_true(abs(s->bar.x - most - (int)(1.5 * s->look.gap)) <= 2);
    assert_true(first.width >= 6 * small - spins - apart - 1 && first.height >= 2.5 * small - spins - apart - 1);
}

static void pictures_stand_in_a_grid(void **)
{
    static const char *const sweeps[] = {"sweep: {cells: 6, configurations: 12, seed: 7}",
                                         "sweep: {cells: 6, configurations: 5, seed: 7, magnetism: all}",
                                         "sweep: {cells: 6, configurations: 3, seed: 7, magnetism: [0, 0.5, 1]}"};
    static const char *const outputs[] = {"size: [1200, 900]", "size: [700, 1100], orientation: time-right",
                                          "size: [900, 700], orientation: matrix", "size: [1600, 1000], style: slide"};
    for (size_t k = 0; k < 3; k++) {
        for (size_t o = 0; o < 4; o++) {
            struct laid l;
            if (lay_out(&l, sweeps[k], outputs[o]) == BEAD_OK)
                assert_places(&l, outputs[o]);
            else
                assert_true(o == 3 || k == 2); /* large type */
            clear(&l);
        }
    }
}

/* As many as fit, in their order; with many magnetisms, from the highest to the lowest, evenly in 1 - M^2 to the power of 1.5; the
 * requested ones. */
static void assert_spread(const char *sweep, const char *size)
{
    struct laid l;
    assert_int_equal(lay_out(&l, sweep, size), BEAD_OK);
    const struct contact_sheet *s = &l.sheet;
    const struct bead_sweep_spec *spec = bead_sweep_panel(s->sweep, 0)->spec;
    const double high = spec->groups[spec->group_count - 1].magnetism, low = spec->groups[0].magnetism;
    assert_true(s->row_count > 2 && s->row_count <= spec->group_count);
    assert_true(s->rows[0].magnetism == high && s->rows[s->row_count - 1].magnetism == low);
    size_t images = 0, first = 0;
    for (size_t r = 0; r < s->row_count; r++) {
        images += s->rows[r].count;
        assert_true(r == 0 || s->rows[r].magnetism < s->rows[r - 1].magnetism);
        size_t group = 0;
        for (first = 0; spec->groups[group].magnetism != s->rows[r].magnetism; group++)
            first += spec->groups[group].configurations;
        assert_true(s->rows[r].first == first && s->rows[r].panel == 0);
        assert_int_equal(s->rows[r].count,
                         spec->groups[group].configurations < s->columns ? spec->groups[group].configurations : s->columns);
        if (spec->group_count <= s->row_count)
            continue;
        const double part = pow((double)r / (double)(s->row_count - 1), 1.5),
                     wanted = sqrt(high * high - part * (high * high - low * low));
        double nearest = INFINITY;
        for (size_t g = 0; g < spec->group_count; g++)
            nearest = fmin(nearest, fabs(spec->groups[g].magnetism - wanted));
        const double off = fabs(s->rows[r].magnetism - wanted);
        assert_true(off <= nearest + 1e-12 || (r > 0 && s->rows[r].magnetism < wanted)); /* each group has one row */
    }
    assert_int_equal(s->image_count, images);
    for (size_t i = 0, r = 0, c = 0; i < images; i++, c++) {
        if (c == s->rows[r].count) {
            c = 0;
            r++;
        }
        assert_true(s->images[i].row == r && s->images[i].index == s->rows[r].first + c);
    }
    /* The words are beside a single picture, else above all. */
    const struct bead_rect begin = s->images[0].spins;
    if (s->rows[0].count == 1 && s->columns >= 3 && s->intro.y == begin.y)
        assert_true(abs(s->intro.x - right_of(begin) - (int)(1.1 * s->small)) <= 1 &&
                    contact_sheet_intro(s, NULL, s->intro.width) <= s->intro.height);
    else
        assert_true(s->intro.x == (int)s->look.margin && s->intro.y == (int)s->look.margin &&
                    begin.y >= end_of(s->intro) + (int)(1.5 * 1.1 * s->small));
    clear(&l);
}

static void rows_are_spread_over_magnetism(void **)
{
    assert_spread("sweep: {cells: 8, configurations: 5, seed: 7, magnetism: all}", "size: [900, 700], orientation: time-down");
    assert_spread("sweep: {cells: 8, configurations: 5, seed: 7, magnetism: all}", "size: [2000, 1100], orientation: time-down");
    assert_spread("sweep: {cells: 16, configurations: 5, seed: 7, magnetism: [0.25, 0.375, 0.5, 0.625, 0.75, 0.875]}",
                  "size: [900, 700], orientation: time-down");
    struct laid l;
    const struct contact_sheet *s = &l.sheet;
    assert_int_equal(lay_out(&l, "sweep: {cells: 8, configurations: 5, seed: 7, magnetism: all}",
                             "size: [900, 900], orientation: time-down, magnetism: [0.25, 1, 0.26, 0.75], configurations: 2"),
                     BEAD_OK);
    assert_true(s->row_count == 3 && s->columns == 2 && s->image_count <= 6); /* 0.26 is that of 0.25 */
    assert_true(s->rows[0].magnetism == 0.25 && s->rows[1].magnetism == 1 && s->rows[2].magnetism == 0.75);
    char name[300];
    contact_sheet_row_name(s, &s->rows[1], name, sizeof name); /* with the decimals that the others need */
    assert_string_equal(name + strlen(name) - strlen(" = 1.00"), " = 1.00");
    clear(&l);
    assert_int_equal(lay_out(&l, "sweep: {cells: 8, configurations: 5, seed: 7, magnetism: all}",
                             "size: [900, 900], orientation: time-down, magnetism: 0.5"),
                     BEAD_OK);
    assert_true(s->row_count == 1 && s->rows[0].magnetism == 0.5);
    clear(&l);
    assert_int_equal(
        lay_out(&l, "sweep: {cells: 8, configurations: 50, seed: 7, magnetism: 0.5}", "size: [900, 700], orientation: time-down"),
        BEAD_OK);
    for (size_t i = 0; i < s->image_count; i++)
        assert_true(s->images[i].index == i && s->images[i].row == i / s->columns);
    assert_true(isnan(s->rows[0].magnetism) && s->image_count >= s->columns);
    clear(&l);
}

/* Makes up the results of runs, of eight beads; the second one's wave never arrives, which leaves out two numbers. */
static void make_up(struct contact_sheet *s, size_t i)
{
    static const signed char spins[8] = {-1, 1, 1, 0, 0, 0, 1, -1};
    struct bead_message msg = {""};
    struct contact_image *image = &s->images[i];
    const int columns = contact_columns(s, image), places = image->picture.width + image->picture.height - columns;
    const struct bead_area_setup setup = {{0, 7}, {0, 1e-3}, places, columns, BEAD_SAMPLING_AREA};
    image->beads = 8;
    image->spin = malloc(8);
    assert_non_null(image->spin);
    memcpy(image->spin, spins, 8);
    assert_int_equal(bead_area_create(&setup, &image->area, &msg), BEAD_OK);
    s->watches[i] = (struct bead_sweep_watch){.panel = 0,
                                              .index = image->index,
                                              .force = 12.34 + (double)i,
                                              .clean_index = i == 0   ? 0.25
                                                             : i == 1 ? NAN
                                                                      : 1,
                                              .participation = i == 0   ? 3.21
                                                               : i == 1 ? NAN
                                                                        : 12.3};
}

/* The sheet of such runs; strokes and texts are noted. */
static cairo_t *draw(struct laid *l)
{
    struct bead_message msg = {""};
    struct contact_sheet *s = &l->sheet;
    const struct bead_text_watch watch = {texts_note, &l->texts};
    for (size_t i = 0; i < s->image_count; i++)
        make_up(s, i);
    l->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, s->page.width, s->page.height);
    assert_true(bead_text_watch(l->surface, &watch));
    cairo_t *cr = cairo_create(l->surface);
    strokes_begin();
    l->texts.count = 0;
    assert_int_equal(contact_sheet_draw(s, cr, &msg), BEAD_OK);
    strokes.on = false;
    return cr;
}

/* Of a sweep over keys each row has all values of the last key, for values of the others that are evenly spread. */
static void rows_have_all_values_of_the_last_key(void **)
{
    struct laid l;
    static const char over[] = "chain: {beads: [{bead: large-steel, count: 12}]}\nsimulate: {until: 0.1 ms}\n"
                               "sweep: {over: {chain.precompression: [1 N, 2 N, 3 N, 4 N, 5 N, 6 N, 7 N, 8 N, 9 N], "
                               "chain.striker.velocity: [1 m/s, 2 m/s, 3 m/s]}}";
    assert_int_equal(lay_out(&l, over, "size: [1200, 700], orientation: time-down"), BEAD_OK);
    const struct contact_sheet *s = &l.sheet;
    assert_true(s->by_key && s->columns == 3 && s->row_count > 2 && s->row_count < 9);
    for (size_t r = 0; r < s->row_count; r++) {
        char name[400], value[16];
        const size_t outer = r * 8 / (s->row_count - 1);
        assert_int_equal(s->rows[r].first, 3 * outer);
        assert_true(s->rows[r].count == 3 && isnan(s->rows[r].magnetism));
        contact_sheet_row_name(s, &s->rows[r], name, sizeof name);
        snprintf(value, sizeof value, "%zu", outer + 1);
        assert_non_null(strstr(name, value));
    }
    assert_places(&l, "over keys");
    cairo_destroy(draw(&l));
    for (size_t i = 0; i < s->image_count; i++) { /* its value of the last key is below each picture */
        char value[40];
        size_t said = 0;
        snprintf(value, sizeof value, "velocity %zu m/s", i % 3 + 1);
        for (size_t t = 0; t < l.texts.count; t++)
            said += l.texts.text[t].y > end_of(s->images[i].picture) && fabs(l.texts.text[t].x - s->images[i].words.x) < 3 &&
                    l.texts.text[t].y < end_of(s->images[i].words) && strstr(l.texts.text[t].markup, value);
        assert_int_equal(said, 1);
    }
    clear(&l);
}

static void assert_filled(const struct stroke *s, struct bead_rgb colour, double x, double y, double width, double height)
{
    assert_true(stroke_has(s, true, colour));
    assert_bounds(s, x, y, x + width, y + height);
}

static size_t find(const struct laid *l, const char *words, size_t n)
{
    for (size_t i = 0; i < l->texts.count; i++) {
        if (strstr(l->texts.text[i].markup, words) && n-- == 0)
            return i;
    }
    fail_msg("nothing says '%s'", words);
    return 0;
}

/* Spins where their beads are; a line as long as the index is clean; numbers at both ends of two lines below the picture. */
static void words_say_what_was_found(void **)
{
    for (int orientation = 0; orientation < 3; orientation++) {
        struct laid l;
        char output[100];
        snprintf(output, sizeof output, "size: [1200, 900], orientation: %s",
                 (const char *[]){"time-down", "time-right", "matrix"}[orientation]);
        assert_int_equal(lay_out(&l, "sweep: {cells: 6, configurations: 4, seed: 7, magnetism: [0, 1]}", output), BEAD_OK);
        struct contact_sheet *s = &l.sheet;
        const struct bead_look *look = &s->look;
        cairo_t *cr = draw(&l);
        /* Between the page's colour and the faint ink's, as far in each channel. */
        for (int spin = -1; spin < 2; spin += 2) {
            const struct bead_rgb mixed = contact_sheet_spin_colour(s, spin), page = look->background, ink = look->faint;
            const double parts[] = {(mixed.r - page.r) / (ink.r - page.r), (mixed.g - page.g) / (ink.g - page.g),
                                    (mixed.b - page.b) / (ink.b - page.b)};
            for (int c = 0; c < 3; c++)
                assert_true(fabs(parts[c] - (spin < 0 ? 0.15 : 0.45)) < 1e-9);
        }
        /* The key: squares of 0.75 of the type in the middle of their words. */
        size_t at = 0;
        for (int i = 0; i < 2; i++, at++) {
            const struct text *word = &l.texts.text[find(&l, i ? "reversed cell" : "cell as written", 0)];
            const struct stroke *square = &strokes.list[at];
            assert_true(stroke_has(square, true, contact_sheet_spin_colour(s, 1 - i)));
            assert_at(square->high[0] - square->low[0], 0.75 * look->tick);
            assert_at(square->high[1] - square->low[1], 0.75 * look->tick);
            assert_true(fabs(word->x - square->low[0] - 1.1 * look->tick) < 3 &&
                        fabs(word->y + word->height / 2 - (square->low[1] + square->high[1]) / 2) < 0.3 * look->tick);
            assert_true(i > 0 || square->low[0] == s->intro.x);
        }
        const double meter = fmax(1, round(0.16 * s->small));
        for (size_t i = 0; i < s->image_count; i++) {
            const struct contact_image *image = &s->images[i];
            const struct bead_rect b = image->spins, w = image->words;
            const double part = i == 0 ? 0.25 : 1, y = w.y + round(0.3 * s->small);
            static const struct {
                int spin;
                double from, to;
            } parts[] = {{-1, 0, 8}, {1, 1, 3}, {0, 3, 6}, {1, 6, 7}};
            for (size_t k = 0; k < 4; k++) { /* of eight beads, from the left, from below, from above */
                const double from = parts[k].from / 8, to = parts[k].to / 8;
                const struct bead_rgb colour = contact_sheet_spin_colour(s, parts[k].spin);
                if (orientation == 0)
                    assert_filled(&strokes.list[at++], colour, b.x + from * b.width, b.y, (to - from) * b.width, b.height);
                else
                    assert_filled(&strokes.list[at++], colour, b.x, b.y + (orientation == 1 ? 1 - to : from) * b.height, b.width,
                                  (to - from) * b.height);
            }
            assert_bounds(&strokes.list[at], w.x, y, right_of(w), y + meter);
            at++;
            if (i != 1)
                assert_filled(&strokes.list[at++], look->accent, w.x, y, part * w.width, meter);
            char number[32];
            snprintf(number, sizeof number, "<b>#%zu</b>", image->index);
            const struct text *index = &l.texts.text[find(&l, number, 0)];
            assert_true(fabs(index->x - w.x) < 3 &&
                        fabs(index->y + index->height - (y + meter + 1.25 * s->small)) < 0.3 * s->small);
        }
        assert_non_null(strstr(l.texts.text[find(&l, ">F<", 1)].markup, "12.3")); /* the first one explains */
        const struct text *clean = &l.texts.text[find(&l, " 0.25", 0)], *share = &l.texts.text[find(&l, " 3.2", 0)],
                          *force = &l.texts.text[find(&l, "12.3", 0)];
        const struct bead_rect w = s->images[0].words;
        const double y = w.y + round(0.3 * s->small) + meter;
        assert_true(fabs(clean->x + clean->width - right_of(w)) < 3 &&
                    fabs(clean->y + clean->height - y - 1.25 * s->small) < 0.3 * s->small);
        assert_true(fabs(share->x + share->width - right_of(w)) < 3 &&
                    fabs(share->y + share->height - y - 2.55 * s->small) < 0.3 * s->small);
        assert_true(fabs(force->x - w.x) < 3);
        (void)find(&l, " 12", 0);                     /* beads from ten on without decimals */
        for (size_t i = 0; i < s->image_count; i++) { /* numbers that are none are left out */
            size_t at_the_right = 0;
            for (size_t t = 0; t < l.texts.count; t++) {
                const struct text *text = &l.texts.text[t];
                at_the_right += fabs(text->x + text->width - right_of(s->images[i].words)) < 3 && *text->markup &&
                                text->y > s->images[i].words.y && text->y < end_of(s->images[i].words);
            }
            assert_int_equal(at_the_right, i == 1 ? 0 : 2);
        }
        /* Names of rows: in the middle of their pictures, at the margin. */
        for (size_t r = 0; r < 2; r++) {
            char name[400];
            contact_sheet_row_name(s, &s->rows[r], name, sizeof name);
            const struct text *row = &l.texts.text[find(&l, name, 0)];
            const struct bead_rect p = s->images[r * s->rows[0].count].picture;
            assert_true(fabs(row->x - look->margin) < 3 &&
                        fabs(row->y + row->height / 2 - (p.y + p.height / 2.0)) < 0.3 * look->tick);
        }
        cairo_destroy(cr);
        clear(&l);
    }
}

/* At M = 0 half of the random cells are reversed: of each picture's eight, four. */
static void spins_are_those_of_the_chains(void **)
{
    static const char sweep[] = "sweep: {cells: 8, configurations: 3, seed: 7, magnetism: 0}", size[] = "size: [900, 700]";
    struct laid l;
    char text[500], path[600];
    assert_int_equal(lay_out(&l, sweep, size), BEAD_OK);
    snprintf(text, sizeof text, "%s\noutputs: [{sheet: sheet.png, %s}]\n", sweep, size);
    write_scene(text, path);
    strokes_begin();
    play_counts((struct bead_job){.input = path, .output = directory, .threads = 1});
    strokes.on = false;
    double cell = INFINITY, reversed = 0, whole = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *s = &strokes.list[i];
        const double width = s->high[0] - s->low[0];
        const bool up = stroke_has(s, true, contact_sheet_spin_colour(&l.sheet, 1)),
                   down = stroke_has(s, true, contact_sheet_spin_colour(&l.sheet, 0));
        if ((!up && !down) || s->high[1] - s->low[1] != l.sheet.images[0].spins.height) /* not the key's */
            continue;
        cell = fmin(cell, width);
        reversed += down ? width : 0;
        whole += width;
    }
    assert_int_equal(l.sheet.image_count, 3);
    assert_true(fabs(reversed / cell - 3 * 4) < 0.05 && whole > 3 * 8 * cell);
    clear(&l);
}

/* Ahead of a small wave, pressed chains have the colour in the middle of the map for both signs, and the striker, which has a
 * contact on one side only, the lowest. */
static void pressed_chains_are_shown_about_rest(void **)
{
    static const char sweep[] = "chain: {precompression: 5 N, striker: {velocity: 0.01 m/s}, wall: rigid}\n"
                                "sweep: {cells: 8, configurations: 2, seed: 7, magnetism: 0}",
                      size[] = "size: [900, 700], orientation: time-down";
    struct laid l;
    struct bead_colormap map;
    char text[500], path[600];
    assert_int_equal(lay_out(&l, sweep, size), BEAD_OK);
    assert_int_equal(bead_colormap_load("dawn", &map, NULL), BEAD_OK);
    snprintf(text, sizeof text, "%s\noutputs: [{sheet: sheet.png, %s}]\n", sweep, size);
    write_scene(text, path);
    play_counts((struct bead_job){.input = path, .output = directory, .threads = 1});
    snprintf(path, sizeof path, "%s/sheet.png", directory);
    cairo_surface_t *made = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(made), CAIRO_STATUS_SUCCESS);
    for (size_t i = 0; i < l.sheet.image_count; i++) {
        const struct bead_rect r = l.sheet.images[i].picture;
        const uint8_t *row = cairo_image_surface_get_data(made) + (ptrdiff_t)r.y * cairo_image_surface_get_stride(made),
                      *first = row + 4 * (ptrdiff_t)(r.x + 1), *last = row + 4 * (ptrdiff_t)(r.x + r.width - 2);
        for (int c = 0; c < 3; c++) {
            assert_true(last[2 - c] == map.rgb[127][c] || last[2 - c] == map.rgb[128][c]);
            assert_int_equal(first[2 - c], map.rgb[0][c]);
        }
    }
    cairo_surface_destroy(made);
    clear(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_stand_in_a_grid),
        cmocka_unit_test(rows_are_spread_over_magnetism),
        cmocka_unit_test(rows_have_all_values_of_the_last_key),
        cmocka_unit_test(words_say_what_was_found),
        cmocka_unit_test(spins_are_those_of_the_chains),
        cmocka_unit_test(pressed_chains_are_shown_about_rest),
    };
    return cmocka_run_group_tests_name("contact sheets", tests, make_directory, remove_directory);
}
