/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes as drawn: ticks and labels are at their values, titles fit into the room beside or below the plot, and measurements without
 * drawing agree with drawing. Ticks are black and texts red here; texts report their boxes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "tests/texts.h"

enum { WIDTH = 700, HEIGHT = 600 };
static const struct bead_rect all = {200, 150, 300, 250};

struct drawn {
    struct bead_look look;
    struct bead_axis axis;
    struct bead_rect plot;
    enum bead_side side;
    bool downwards;
    cairo_surface_t *surface;
    double reach; /* px, returned */
    struct texts texts;
};

/* An axis from low to high at a side of the plot, on white. */
static void draw(struct drawn *d, double low, double high, bool labels, const char *title)
{
    const bool lying = d->side == BEAD_SIDE_BOTTOM;
    d->look.axis = (struct bead_rgb){0, 0, 0};
    d->look.ink = (struct bead_rgb){1, 0, 0};
    bead_axis_make(&d->axis, low, high, "N", d->axis.scale, lying ? d->plot.width : d->plot.height, d->look.tick, lying);
    const double measured = bead_axis_draw(NULL, &d->look, &d->axis, d->plot, d->side, d->downwards, labels, title);
    d->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    d->texts.count = 0;
    const struct bead_text_watch watch = {texts_note, &d->texts};
    assert_true(bead_text_watch(d->surface, &watch));
    cairo_t *cr = cairo_create(d->surface);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    d->reach = bead_axis_draw(cr, &d->look, &d->axis, d->plot, d->side, d->downwards, labels, title);
    cairo_destroy(cr);
    cairo_surface_flush(d->surface);
    assert_true(d->reach == measured);
}

static void clear(struct drawn *d)
{
    cairo_surface_destroy(d->surface);
}

/* Whether a tick covers the pixel that is `along` px from the picture's left (or top) and `out` px outside of the plot's pixels. */
static bool is_tick(const struct drawn *d, int along, int out)
{
    const int x = d->side == BEAD_SIDE_LEFT    ? d->plot.x - 1 - out
                  : d->side == BEAD_SIDE_RIGHT ? d->plot.x + d->plot.width + out
                                               : along,
              y = d->side == BEAD_SIDE_BOTTOM ? d->plot.y + d->plot.height + out : along;
    const unsigned char *pixel = cairo_image_surface_get_data(d->surface) + y * cairo_image_surface_get_stride(d->surface) + 4 * x;
    return pixel[0] < 128 && pixel[2] < 128; /* blue and red */
}

/* px along the axis of a place from 0 to 1. */
static double along(const struct drawn *d, double place)
{
    if (d->side == BEAD_SIDE_BOTTOM)
        return d->plot.x + place * d->plot.width;
    return d->plot.y + (d->downwards ? place : 1 - place) * d->plot.height;
}

/* Whether a labelled, or a shorter, tick belongs in the middle of these pixels. */
static bool has_place(const struct drawn *d, bool minor, double middle)
{
    bool found = false;
    for (size_t i = 0; i < (minor ? d->axis.minor_count : d->axis.count); i++)
        found = found || fabs(along(d, minor ? d->axis.minor[i] : d->axis.ticks[i].place) - middle) <= 0.5 + 1e-9;
    return found;
}

/* Ticks that extend `out` px from the plot; each is at a label's place, or at one of the shorter ticks, and as wide as the line. */
static size_t ticks_at(const struct drawn *d, int out, bool minor)
{
    size_t count = 0;
    for (int at = 0; at < (d->side == BEAD_SIDE_BOTTOM ? WIDTH : HEIGHT); at++) {
        int wide = 0;
        while (is_tick(d, at + wide, out))
            wide++;
        if (wide == 0)
            continue;
        count++;
        assert_int_equal(wide, (int)d->look.line);
        const double middle = at + 0.5 * wide;
        assert_true(has_place(d, false, middle) || (minor && has_place(d, true, middle)));
        at += wide;
    }
    return count;
}

/* All sides, upwards and downwards, lines of 1 to 3 px, with and without shorter ticks. */
static void next_axis(struct drawn *d, int i)
{
    static const enum bead_side sides[] = {BEAD_SIDE_LEFT, BEAD_SIDE_BOTTOM, BEAD_SIDE_RIGHT};
    bead_look_screen(&d->look, 1280, 720, false);
    d->look.line = 1 + i / 6 % 3;
    d->look.tick = 16 + i;
    d->side = sides[i % 3];
    d->downwards = i / 3 % 2;
    d->plot = all;
    d->axis.scale = i % 2 ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR;
}

static void ticks_stand_at_their_values(void **state)
{
    (void)state;
    for (int i = 0; i < 18; i++) {
        struct drawn d = {0};
        next_axis(&d, i);
        draw(&d, i % 2 ? 0.7 : -3, i % 2 ? 300 : 11, false, NULL);
        assert_int_equal(d.texts.count, 0); /* ticks only */
        assert_true(d.axis.count >= 3);
        const int line = (int)d.look.line, length = (int)d.reach - line;
        assert_true(d.reach == line + length && length > 0.3 * d.look.tick && length < 0.5 * d.look.tick);
        assert_int_equal(ticks_at(&d, line - 1, true), 0); /* the box's line is there */
        assert_int_equal(ticks_at(&d, line, true), d.axis.count + d.axis.minor_count);
        assert_int_equal(ticks_at(&d, line + length - 1, false), d.axis.count);
        assert_int_equal(ticks_at(&d, line + length, false), 0);
        if (i % 2) { /* shorter ones have about half the length */
            assert_true(d.axis.minor_count > 8);
            assert_int_equal(ticks_at(&d, line + (int)(0.45 * length), true), d.axis.count + d.axis.minor_count);
            assert_int_equal(ticks_at(&d, line + (int)ceil(0.65 * length), false), d.axis.count);
        }
        clear(&d);
    }
}

/* Where a text begins and ends, px away from the plot's pixels. */
static double begin_of(const struct drawn *d, const struct text *text)
{
    return d->side == BEAD_SIDE_LEFT    ? d->plot.x - text->x - text->width
           : d->side == BEAD_SIDE_RIGHT ? text->x - d->plot.x - d->plot.width
                                        : text->y - d->plot.y - d->plot.height;
}

static double end_of(const struct drawn *d, const struct text *text)
{
    return begin_of(d, text) + (d->side == BEAD_SIDE_BOTTOM ? text->height : text->width);
}

static double middle_of(const struct drawn *d, const struct text *text)
{
    return d->side == BEAD_SIDE_BOTTOM ? text->x + 0.5 * text->width : text->y + 0.5 * text->height;
}

/* Labels are beside the ends of their ticks, a third of a letter away, in the middle; the axis extends to the end of the widest. */
static void labels_stand_at_their_ticks(void **state)
{
    (void)state;
    for (int i = 0; i < 18; i++) {
        struct drawn d = {0};
        next_axis(&d, i);
        draw(&d, i % 2 ? 0.7 : -3, i % 2 ? 1300 : 11, false, NULL);
        const double ticks = d.reach, em = d.look.tick;
        clear(&d);
        draw(&d, i % 2 ? 0.7 : -3, i % 2 ? 1300 : 11, true, NULL);
        assert_int_equal(d.texts.count, d.axis.count);
        double furthest = 0;
        for (size_t k = 0; k < d.texts.count; k++) {
            const struct text *text = &d.texts.text[k];
            assert_string_equal(text->markup, d.axis.ticks[k].label);
            const double bearing = 0.12 * em; /* between a letter's box and its ink */
            if (!(fabs(middle_of(&d, text) - along(&d, d.axis.ticks[k].place)) < bearing))
                fail_msg("'%s' of axis %d stands %g px from its tick", text->markup, i,
                         middle_of(&d, text) - along(&d, d.axis.ticks[k].place));
            if (!(fabs(begin_of(&d, text) - ticks - 0.3 * em) < bearing))
                fail_msg("'%s' of axis %d begins %g px behind its tick", text->markup, i, begin_of(&d, text) - ticks);
            furthest = fmax(furthest, end_of(&d, text));
        }
        if (!(fabs(d.reach - furthest) < 0.12 * em))
            fail_msg("axis %d reaches %g px, its labels %g", i, d.reach, furthest);
        clear(&d);
    }
}

/* ---- titles ---- */

/* How a title was made to fit. */
enum fitted { FULL, SMALLER, LINES, SMALL, UNIT, NONE, WAYS };

static double natural_width(const struct bead_look *look, const char *markup, double *height)
{
    double width;
    const struct bead_text_style style = {.family = look->family, .size = look->label};
    bead_text_size(NULL, &style, markup, &width, height);
    return width;
}

/* The title of a plot with this much room along its axis: within that room, outside the labels, inside the reach of the axis. */
static enum fitted fit(struct drawn *d, int room, const char *title)
{
    const bool lying = d->side == BEAD_SIDE_BOTTOM;
    d->plot = (struct bead_rect){200, 150, lying ? room : 300, lying ? 250 : room};
    draw(d, 0, 10, true, NULL);
    const double labels = d->reach, em = d->look.label;
    clear(d);
    draw(d, 0, 10, true, title);
    const struct text found = d->texts.text[d->texts.count - 1];
    const double axis = d->axis.count, reach = d->reach;
    char whole[400];
    bead_axis_title(&d->axis, title, whole, sizeof whole);
    clear(d);
    if (d->texts.count == axis) {
        assert_true(reach == labels);
        return NONE;
    }
    assert_int_equal(d->texts.count, axis + 1);
    double line, width = lying ? found.width : found.height, thickness = lying ? found.height : found.width;
    const double full = natural_width(&d->look, whole, &line), middle = lying ? found.x + width / 2 : found.y + width / 2;
    if (!(width <= room + 1))
        fail_msg("%g px of '%s' in %d px", width, found.markup, room);
    if (!(fabs(middle - (lying ? 200 : 150) - 0.5 * room) < 0.1 * em))
        fail_msg("'%s' is %g px away from the middle of %d px", found.markup, middle - (lying ? 200 : 150) - 0.5 * room, room);
    if (!(begin_of(d, &found) > labels + 0.3 * em && begin_of(d, &found) < labels + em))
        fail_msg("'%s' in %d px begins %g em behind the labels", found.markup, room, (begin_of(d, &found) - labels) / em);
    /* a line is higher than its ink: descent, and the leading of symbols */
    if (!(reach > end_of(d, &found) - 0.1 * em && reach < end_of(d, &found) + 0.6 * em))
        fail_msg("'%s' in %d px ends %g px before the axis does", found.markup, room, reach - end_of(d, &found));
    if (strcmp(found.markup, d->axis.unit) == 0)
        return UNIT;
    if (thickness > 1.2 * line) {
        if (!(thickness <= 3.3 * line && room < 0.85 * full))
            fail_msg("%g px of lines for '%s' of %g x %g px in %d px", thickness, found.markup, full, line, room);
        return LINES;
    }
    assert_string_equal(found.markup, whole);
    if (width > full - 0.15 * em)
        return FULL;
    assert_true(width > 0.95 * room || room > 0.98 * full); /* no smaller than the room demands */
    return room > 0.84 * full ? SMALLER : SMALL;
}

/* As the room shrinks: smaller, then lines, then small, then the unit, then nothing. */
static void titles_fit_the_room(void **state)
{
    (void)state;
    static const enum bead_side sides[] = {BEAD_SIDE_LEFT, BEAD_SIDE_BOTTOM, BEAD_SIDE_RIGHT};
    static const struct {
        const char *title;
        bool way[WAYS];
    } titles[] = {{"largest force of all contacts", {true, true, true, false, true, true}},
                  {"*F*_m of all contacts *c* and beads", {true, true, true, false, true, true}}, /* with markup */
                  {"Gesamtkontaktkraft", {true, true, false, true, true, true}}};                 /* one word */
    for (size_t i = 0; i < 9; i++) {
        struct drawn d = {.side = sides[i % 3]};
        bool way[WAYS] = {false};
        enum fitted last = FULL;
        bead_look_screen(&d.look, 1280, 720, false);
        for (int room = 400; room > 4; room -= 5) {
            const enum fitted now = fit(&d, room, titles[i / 3].title);
            if (now < last)
                fail_msg("'%s' at side %d in %d px: way %d after %d", titles[i / 3].title, (int)d.side, room, now, last);
            way[now] = true;
            last = now;
        }
        for (int w = 0; w < WAYS; w++) {
            if (way[w] != titles[i / 3].way[w])
                fail_msg("'%s' at side %d: way %d: %d", titles[i / 3].title, (int)d.side, w, way[w]);
        }
    }
}

/* A box's line lies around the plot's pixels, and covers none of them. */
static void boxes_surround_their_pixels(void **state)
{
    (void)state;
    for (int line = 1; line <= 3; line++) {
        struct bead_look look;
        bead_look_screen(&look, 1280, 720, false);
        look.line = line;
        look.axis = (struct bead_rgb){0, 0, 0};
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
        cairo_t *cr = cairo_create(surface);
        cairo_set_source_rgb(cr, 1, 1, 1);
        cairo_paint(cr);
        bead_box_draw(cr, &look, all);
        cairo_destroy(cr);
        cairo_surface_flush(surface);
        const unsigned char *pixels = cairo_image_surface_get_data(surface);
        const int stride = cairo_image_surface_get_stride(surface);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const bool within = x >= all.x && x < all.x + all.width && y >= all.y && y < all.y + all.height;
                const bool around =
                    x >= all.x - line && x < all.x + all.width + line && y >= all.y - line && y < all.y + all.height + line;
                assert_int_equal(pixels[y * stride + 4 * x], around && !within ? 0 : 255);
            }
        }
        cairo_surface_destroy(surface);
    }
}

/* One label defines no scale: wherever a range begins, and however long it is, there are two or more, with minor ticks between. */
static void logarithmic_axes_have_labels(void **state)
{
    (void)state;
    for (int begin = 0; begin < 20; begin++) {
        for (int decades = 3; decades < 60; decades++) {
            struct bead_axis axis;
            const double low = pow(10, begin / 20.0), high = low * pow(10, decades / 10.0);
            bead_axis_make(&axis, low, high, "", BEAD_SCALE_LOG, 600, 16, true);
            if (axis.count < 2)
                fail_msg("%g to %g: %zu labels", low, high, axis.count);
            for (size_t i = 0; i < axis.count; i++)
                assert_true(fabs(axis.ticks[i].place - log(axis.ticks[i].value / low) / log(high / low)) < 1e-12);
        }
    }
}

/* Labels beside each other are apart by 1.2 of their type, or nearly so, on long axes and short ones. */
static void logarithmic_labels_are_apart(void **)
{
    struct bead_look look;
    bead_look_screen(&look, 1280, 720, false);
    const struct bead_text_style style = {.family = look.family, .size = look.tick};
    for (int begin = -3; begin < 3; begin++) {
        for (int decades = 2; decades < 8; decades++) {
            for (int length = 60; length < 400; length += 20) {
                struct bead_axis axis;
                double end = -INFINITY, width, height;
                bead_axis_make(&axis, pow(10, begin), pow(10, begin + decades), "", BEAD_SCALE_LOG, length, look.tick, true);
                for (size_t i = 0; i < axis.count; i++) {
                    bead_text_size(NULL, &style, axis.ticks[i].label, &width, &height);
                    const double middle = axis.ticks[i].place * length;
                    if (!(middle - width / 2 > end + 1.15 * look.tick))
                        fail_msg("1e%d to 1e%d in %d px: '%s' is too near the label before", begin, begin + decades, length,
                                 axis.ticks[i].label);
                    end = middle + width / 2;
                }
            }
        }
    }
}

/* The label of a number with so many decimals, as it is shown, in characters. */
static size_t letters_of(double number, int decimals)
{
    char text[64];
    return (size_t)snprintf(text, sizeof text, "%.*f", decimals, number);
}

/* Have ticks `step` apart (in shown numbers) room? Labels above each other 1.9 of the type; beside each other their width of 0.6 a
 * character, 1.8 at least, and 1.2 between them; no more than seven steps. */
static size_t ticks_of(double low, double high, double step, int exponent, double length, double em, bool lying)
{
    const double from = ceil(low / step), to = floor(high / step);
    size_t widest = 0;
    if (to - from >= 7)
        return 0;
    for (double k = from; k <= to; k++) {
        const size_t letters = letters_of(k * step + 0.0, exponent < 0 ? -exponent : 0);
        widest = letters > widest ? letters : widest;
    }
    const double needed = lying ? em * (fmax(0.6 * (double)widest, 1.8) + 1.2) : 1.9 * em;
    return length * step / (high - low) >= needed ? (size_t)(to - from + 1) : 0;
}

/* Of steps of 1, 2 and 5 times powers of ten, the smallest whose labels have room, if it gives two ticks. */
static void steps_are_the_smallest_that_fit(void **)
{
    uint64_t random = 12345;
    size_t compared = 0;
    for (int i = 0; i < 3000; i++) {
        double draws[4];
        for (int k = 0; k < 4; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            draws[k] = (double)(random >> 11) / 9007199254740992.0;
        }
        const bool lying = i % 2;
        const double low = (i % 3 ? 0.01237 : -0.5) + draws[0], high = low + 0.0101 + pow(10, 2.5 * draws[1]),
                     length = 100 + 900 * draws[2], em = 8 + 20 * draws[3];
        struct bead_axis axis;
        bead_axis_make(&axis, low, high, "", BEAD_SCALE_LINEAR, length, em, lying);
        assert_true(axis.factor == 1);
        size_t expected = 0;
        double step = 0;
        for (int e = -5; e <= 4 && expected == 0; e++) {
            for (int m = 0; m < 3 && expected == 0; m++) {
                step = (double[]){1, 2, 5}[m] * pow(10, e);
                expected = ticks_of(low, high, step, e, length, em, lying);
            }
        }
        if (expected < 2)
            continue; /* labels are set closer */
        compared++;
        if (axis.count != expected || fabs(axis.ticks[0].value - step * ceil(low / step)) > 1e-9 * high ||
            fabs(axis.ticks[1].value - axis.ticks[0].value - step) > 1e-9 * high)
            fail_msg("%g to %g, %g px of %g, %s: %zu ticks from %g by %g, not %zu by %g", low, high, length, em,
                     lying ? "lying" : "upright", axis.count, axis.ticks[0].value, axis.ticks[1].value - axis.ticks[0].value,
                     expected, step);
        for (size_t t = 0; t < axis.count; t++)
            assert_true(fabs(axis.ticks[t].place - (axis.ticks[t].value - low) / (high - low)) < 1e-9);
    }
    assert_true(compared > 2000);
}

/* Labels of some axes, all of them. */
static void axes_have_these_labels(void **)
{
    static const struct {
        double low, high;
        const char *si_unit;
        enum bead_scale scale;
        double length;
        bool lying;
        const char *labels, *unit;
        size_t minor;
    } cases[] = {{0, 10, "", BEAD_SCALE_LINEAR, 400, true, "0 2 4 6 8 10", "", 0},
                 {0.6, 1.5, "", BEAD_SCALE_LINEAR, 400, true, "0.6 0.9 1.2 1.5", "", 6},
                 {0, 1e-3, "s", BEAD_SCALE_LINEAR, 400, true, "0.0 0.2 0.4 0.6 0.8 1.0", "ms", 0},
                 {0, 25e3, "N", BEAD_SCALE_LINEAR, 200, false, "0 5 10 15 20 25", "kN", 0},
                 {0, 25e-42, "N", BEAD_SCALE_LINEAR, 200, false, "0 5 10 15 20 25", "\u00d710<sup>\u221242</sup>\u00a0N", 0},
                 {0, 3e6, "", BEAD_SCALE_LINEAR, 400, true, "0.0 0.5 1.0 1.5 2.0 2.5 3.0", "\u00d710<sup>6</sup>", 0},
                 {0, 3e-6, "", BEAD_SCALE_LINEAR, 400, true, "0.0 0.5 1.0 1.5 2.0 2.5 3.0", "\u00d710<sup>\u22126</sup>", 0},
                 {0.5, 5.5, "1", BEAD_SCALE_LINEAR, 400, true, "1 2 3 4 5", "", 0},
                 {0.5, 40.5, "1", BEAD_SCALE_LINEAR, 400, true, "10 20 30 40", "", 0},
                 {1, 1000, "", BEAD_SCALE_LOG, 400, true, "1 10 100 1000", "", 24},
                 {1e-6, 1, "", BEAD_SCALE_LOG, 600, true,
                  "10<sup>\u22126</sup> 10<sup>\u22125</sup> 10<sup>\u22124</sup> 10<sup>\u22123</sup> 10<sup>\u22122</sup> "
                  "10<sup>\u22121</sup> 10<sup>0</sup>",
                  "", 48},
                 {0, 100, "N", BEAD_SCALE_SQRT, 400, false, NULL, "N", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bead_axis axis;
        char labels[600] = "";
        bead_axis_make(&axis, cases[i].low, cases[i].high, cases[i].si_unit, cases[i].scale, cases[i].length, 18, cases[i].lying);
        for (size_t t = 0; t < axis.count; t++)
            snprintf(labels + strlen(labels), sizeof labels - strlen(labels), "%s%s", t ? " " : "", axis.ticks[t].label);
        if (cases[i].labels && (strcmp(labels, cases[i].labels) != 0 || axis.minor_count != cases[i].minor))
            fail_msg("%g to %g %s: %s, %zu minor ticks", cases[i].low, cases[i].high, cases[i].si_unit, labels, axis.minor_count);
        assert_string_equal(axis.unit, cases[i].unit);
    }
}

/* A low axis has two numbers wherever its room, two thirds of which is the least between 0 and a number of one digit, has it. */
static void test_low_axes_have_two_numbers(void **state)
{
    (void)state;
    enum { EM = 20 };
    for (int i = 20; i <= 100; i++) {
        struct bead_axis axis;
        bead_axis_make(&axis, 0, i, "N", BEAD_SCALE_LINEAR, 2.2 * EM, EM, false);
        if (axis.count < 2)
            fail_msg("an axis to %d has %zu numbers", i, axis.count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_low_axes_have_two_numbers),  cmocka_unit_test(ticks_stand_at_their_values),
        cmocka_unit_test(steps_are_the_smallest_that_fit), cmocka_unit_test(axes_have_these_labels),
        cmocka_unit_test(labels_stand_at_their_ticks),     cmocka_unit_test(titles_fit_the_room),
        cmocka_unit_test(boxes_surround_their_pixels),     cmocka_unit_test(logarithmic_axes_have_labels),
        cmocka_unit_test(logarithmic_labels_are_apart)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
