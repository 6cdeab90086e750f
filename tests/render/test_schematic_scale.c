/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schematic drawings: geometry and scale at known pixels. */
#include <math.h>
#include <stdlib.h>

#include "tests/schematics.h"

static const uint8_t *pixel(cairo_surface_t *surface, int x, int y)
{
    return cairo_image_surface_get_data(surface) + (ptrdiff_t)y * cairo_image_surface_get_stride(surface) + 4 * (ptrdiff_t)x;
}

static bool is_colour(const uint8_t *p, int r, int g, int b, int tolerance)
{
    return abs(p[2] - r) <= tolerance && abs(p[1] - g) <= tolerance && abs(p[0] - b) <= tolerance;
}

/* Pixels of a row or column with this colour: first, last, count. */
struct run {
    int first, last, count;
};

static struct run find_run(cairo_surface_t *surface, bool row, int at, int r, int g, int b, int tolerance)
{
    int length = row ? cairo_image_surface_get_width(surface) : cairo_image_surface_get_height(surface);
    struct run run = {-1, -1, 0};
    for (int i = 0; i < length; i++) {
        if (!is_colour(row ? pixel(surface, i, at) : pixel(surface, at, i), r, g, b, tolerance))
            continue;
        run.first = run.count++ == 0 ? i : run.first;
        run.last = i;
    }
    return run;
}

static void close_to(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.5g instead of %.5g +- %.2g", value, expected, tolerance);
}

#define COLOURED                                                                                    \
    "materials: {red: {mass: 1 g, radius: 4 mm, modulus: 1 GPa, poisson: 0, colour: \"#ff0000\"}, " \
    "blue: {mass: 1 g, radius: 2 mm, modulus: 1 GPa, poisson: 0, colour: \"#0000ff\"}}\n"

/* Two beads of radii 4 and 2 mm, the smaller flattened by c of its radius: circles, chord and grey lens have their true sizes. */
static void contact_is_to_scale(void **state)
{
    (void)state;
    static const double parts[] = {0.2, 0.45};
    for (size_t i = 0; i < 2; i++) {
        char text[1024];
        struct seen seen = {.count = 0};
        cairo_surface_t *picture;
        snprintf(text, sizeof text,
                 COLOURED "chain: {beads: [{bead: red}, {bead: blue}]}\n"
                          "outputs: [{plot: a.png, show: contact, compression: %g, size: [1600, 1000]}]\n",
                 parts[i]);
        struct staged *s = set_stage(text);
        assert_int_equal(draw(s, 0, &seen, &picture), BEAD_OK);
        double q = 2e-3 * sqrt(1 - (1 - parts[i]) * (1 - parts[i])), d1 = 4e-3 - sqrt(16e-6 - q * q), d2 = parts[i] * 2e-3;
        /* The row with most grey is next to that of the centres; dimensions and words are below row 800. */
        int middle = 0, most = 0;
        for (int y = 0; y < 800; y++) {
            struct run run = find_run(picture, true, y, 168, 168, 168, 2);
            middle = run.count > most ? y : middle;
            most = run.count > most ? run.count : most;
        }
        /* Pale red and blue, 45 % on white; outlines are 1.6 px wide. */
        struct run red = find_run(picture, true, middle, 255, 140, 140, 4),
                   blue = find_run(picture, true, middle, 140, 140, 255, 4);
        struct run grey = find_run(picture, true, middle, 168, 168, 168, 2);
        double width = blue.last - red.first + 1, scale = width / (12e-3 - d1 - d2);
        close_to((grey.count + 2) / scale, d1 + d2, 6 / scale); /* except for the chord, which is not grey */
        int chord = (int)lround(red.first + scale * (8e-3 - d1));
        struct run line = {-1, -1, 0};
        for (int x = chord - 4; x <= chord + 4; x++) {
            struct run here = find_run(picture, false, x, 184, 82, 13, 6); /* the accent's colour */
            line = here.count > line.count ? here : line;
        }
        close_to((line.last - line.first + 1) / scale, 2 * q, 8 / scale);
        struct run tall = find_run(picture, false, (int)lround(red.first + scale * 4e-3) - 3, 255, 140, 140, 4);
        close_to((tall.last - tall.first + 1) / scale, 8e-3, 8 / scale);
        cairo_surface_destroy(picture);
        clear_stage(s);
    }
}

static void cells_are_to_scale(void **state)
{
    (void)state;
    struct seen seen = {.count = 0};
    cairo_surface_t *picture;
    struct staged *s = set_stage(COLOURED "chain: {beads: [{cell: [red, red, blue], count: 4, spins: random}]}\n"
                                          "outputs: [{plot: a.png, show: cell, size: [1600, 1000]}]\n");
    assert_int_equal(draw(s, 0, &seen, &picture), BEAD_OK);
    assert_true(wrote(&seen, "2 : 1") && wrote(&seen, "dimer cell") && wrote(&seen, "= 2") && wrote(&seen, "up") &&
                wrote(&seen, "down"));
    int rows[2] = {0, 0}, found = 0;
    double reds = 0, blues = 0;
    for (int y = 1; y < 1000; y++) { /* the widest row of each way round: through the centres */
        struct run red = {-1, -1, 0}, blue = {-1, -1, 0};
        for (int x = 0; x < 1600; x++) {
            const uint8_t *p = pixel(picture, x, y);
            bool is_red = p[2] > p[0] + 100, is_blue = p[0] > p[2] + 100;
            red.first = is_red && red.count++ == 0 ? x : red.first;
            red.last = is_red ? x : red.last;
            blue.first = is_blue && blue.count++ == 0 ? x : blue.first;
            blue.last = is_blue ? x : blue.last;
        }
        if (red.count == 0 || blue.count == 0)
            continue;
        bool up = red.last < blue.first;
        rows[!up] = y;
        found |= up ? 1 : 2;
        reds = fmax(reds, red.last - red.first + 1);
        blues = fmax(blues, blue.last - blue.first + 1);
    }
    assert_int_equal(found, 3);
    assert_true(rows[0] < rows[1]); /* up above down */
    close_to(reds / blues, 16.0 / 4, 0.1);
    cairo_surface_destroy(picture);
    clear_stage(s);
}

/* Every bead of a short chain is there, as large as the others; striker ahead of them, the wall behind. */
static void setup_shows_the_beads(void **state)
{
    (void)state;
    struct seen seen = {.count = 0};
    cairo_surface_t *picture;
    struct staged *s =
        set_stage(COLOURED "chain: {striker: {bead: blue, velocity: 1 m/s}, beads: [{bead: red, count: 7}], wall: brass}\n"
                           "outputs: [{plot: a.png, show: setup, size: [1600, 900]}]\n");
    assert_int_equal(draw(s, 0, &seen, &picture), BEAD_OK);
    int best = 0, beads = 0, first = 0, last = 0;
    for (int y = 0; y < 700; y++) { /* above the legend */
        int runs = 0, from = -1, to = -1;
        bool before = false;
        for (int x = 0; x < 1600; x++) {
            const uint8_t *p = pixel(picture, x, y);
            bool red = p[2] > p[0] + 90 && p[2] > p[1] + 90 && !(p[1] > p[0] + 25);
            runs += red && !before;
            from = red && from < 0 ? x : from;
            to = red ? x : to;
            before = red;
        }
        if (to - from > last - first) {
            best = y;
            first = from;
            last = to;
        }
        beads = runs > beads ? runs : beads;
    }
    assert_int_equal(beads, 7);
    int tall = 0;
    for (int y = best - 200; y < best + 200; y++) {
        const uint8_t *p = pixel(picture, first + (last - first) / 14, y);
        tall += p[2] > p[0] + 90 && p[2] > p[1] + 90;
    }
    close_to(7.0 * tall / (last - first + 1), 1, 0.05); /* round, in contact */
    cairo_surface_destroy(picture);
    clear_stage(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contact_is_to_scale),
        cmocka_unit_test(cells_are_to_scale),
        cmocka_unit_test(setup_shows_the_beads),
    };
    return cmocka_run_group_tests_name("schematic to scale", tests, NULL, NULL);
}
