/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of all pictures, on paper, as numbers. On paper with twice as many pixels everything is drawn in the same place, as wide as
 * before, but for what rounding to pixels moves: all sizes and distances are in units of type, lines or the page, none in pixels.
 */
#include "drawn.h"
#include "page_laws.h"

enum { PAIR = 2, DPI = 254, OUTPUTS_MOST = 16 };
static struct drawn drawn[PAIR];
static const int size[2] = {144, 110}; /* mm */

#define STRIKER "striker: {bead: large-steel, velocity: 1 m/s}, "
static const struct {
    const char *chains, *outputs[OUTPUTS_MOST];
} scenes[] = {
    {"chains:\n"
     "  - {name: even, " STRIKER "beads: [{bead: large-steel, count: 12}, {bead: large-steel, sensor: s}], wall: brass}\n"
     "  - {name: mixed, " STRIKER "beads: [{bead: large-steel, count: 6}, {cell: [large-steel, aluminium], "
     "count: 3}, {bead: ptfe, sensor: last}], wall: brass}\n"
     "simulate: {until: 0.3 ms}\n",
     {"image: %s, panels: [[{field: force}, {show: sensors}], [{field: velocity, views: [beads, profile]}]]",
      "plot: %s, show: peaks", "plot: %s, show: sensors", "plot: %s, show: energy"}},
    {"chain: {" STRIKER "wall: brass, precompression: 2 N, beads: [{bead: large-steel, count: 40}, "
     "{bead: small-steel, sensor: first}, {bead: small-steel, sensor: second}, {bead: ptfe}]}\n"
     "simulate: {until: 0.4 ms}\n",
     {"image: %s", "image: %s, views: [sensors], theme: dark", "plot: %s, show: setup", "plot: %s, show: contact",
      "plot: %s, show: bands", "plot: %s, show: profiles, at: [0.1 ms, 0.2 ms]", "plot: %s, show: eigenmodes"}},
    {"chain: {" STRIKER
     "beads: [{cell: [large-steel, large-steel, aluminium], count: 4, spins: random}], wall: brass, tilt: 4 deg}\n"
     "simulate: {until: 0.2 ms}\n",
     {"plot: %s, show: cell", "plot: %s, show: setup", "plot: %s, show: peaks, scale: log",
      "image: %s, views: [beads, profile, spacetime]"}},
    {"chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
     "simulate: {until: 30}\n",
     {"plot: %s, show: modes", "image: %s"}},
    {"chain: {" STRIKER "wall: brass, beads: [{bead: large-steel, count: 20}, {bead: large-steel, sensor: s}]}\n"
     "simulate: {until: 0.4 ms}\n",
     {"image: %s, theory: true, trust: true, views: [spacetime, sensors], caption: \"Waves of *F*_{m}\"",
      "plot: %s, show: sensors, trust: true, normalise: max",
      "plot: %s, show: profiles, field: contact-force, at: [0.1 ms], overlay: true", "plot: %s, show: setup",
      "plot: %s, show: spreading"}},
    {"sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\n", {"plot: %s", "sheet: %s"}},
    {"sweep: {cells: 2, magnetism: 0, configurations: 2}\n", {"image: %s"}},
    {"chain: {" STRIKER "beads: [{bead: small-steel, count: 3}, {bead: small-steel, sensor: s}]}\n"
     "sweep: {over: {chain.striker.velocity: [0.1 m/s, 1 m/s], chain.striker.mass: [2 g, 4 g]}}\n"
     "simulate: {until: 60 us}\n",
     {"plot: %s", "plot: %s, show: plane"}},
};

static void record(size_t scene, int dpi, struct drawn *d)
{
    char keys[100];
    snprintf(keys, sizeof keys, "size: [%d mm, %d mm], dpi: %d", size[0], size[1], dpi);
    drawn_run_all(scenes[scene].chains, scenes[scene].outputs, OUTPUTS_MOST, keys, d);
}

/* Balls are lit from above on the left, as those that are painted. */
cairo_pattern_t *cairo_pattern_create_radial(double x, double y, double r, double x1, double y1, double r1)
{
    static cairo_pattern_t *(*next)(double, double, double, double, double, double);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "cairo_pattern_create_radial");
    assert_true(r < r1 && x < x1 && y < y1 && hypot(x - x1, y - y1) < r1 - r);
    return next(x, y, r, x1, y1, r1);
}

/* Places are rounded to pixels, sizes that they depend on, too: four at most, of the coarser pixels. */
static void compare(const char *chains)
{
    static const double slack = 4 * 72.0 / DPI;
    assert_true(drawn[0].marks > 0 && drawn[0].texts > 0);
    assert_int_equal(drawn[0].marks, drawn[1].marks);
    assert_int_equal(drawn[0].texts, drawn[1].texts);
    for (size_t j = 0; j < drawn[0].marks; j++) {
        const struct mark *a = &drawn[0].mark[j], *b = &drawn[1].mark[j];
        double apart = a->filled == b->filled ? 10 * fabs(a->width - b->width) : INFINITY;
        for (int k = 0; k < 2; k++)
            apart = fmax(apart, fmax(fabs(a->low[k] - b->low[k]), fabs(a->high[k] - b->high[k])));
        if (!(apart < slack))
            fail_msg("%s: page %zu path %zu, %g wide, %g to %g, %g to %g pt, is also %g wide, at %g to %g, %g to %g", chains,
                     a->page, j, a->width, a->low[0], a->high[0], a->low[1], a->high[1], b->width, b->low[0], b->high[0], b->low[1],
                     b->high[1]);
    }
    for (size_t j = 0; j < drawn[0].texts; j++) {
        const struct words *a = &drawn[0].text[j], *b = &drawn[1].text[j];
        if (strcmp(a->text, b->text) != 0 || !(hypot(a->x - b->x, a->y - b->y) < slack))
            fail_msg("%s: page %zu '%s' at %g, %g pt is also '%s' at %g, %g", chains, a->page, a->text, a->x, a->y, b->text, b->x,
                     b->y);
    }
}

static void pictures_are_the_same_at_twice_the_resolution(void **)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        for (int k = 0; k < PAIR; k++)
            record(i, DPI * (k + 1), &drawn[k]);
        compare(scenes[i].chains);
        page_laws(&drawn[1], size[0] * 72 / 25.4, size[1] * 72 / 25.4);
    }
}

/* Are two texts the same but for prefixes of units? */
static bool same_but_for_prefixes(const char *a, const char *b)
{
    static const char prefixes[] = "\u00b5kmMGTPnpfa";
    for (;; a++, b++) {
        a += strspn(a, prefixes), b += strspn(b, prefixes);
        if (!*a || *a != *b)
            return *a == *b;
    }
}

/* Beads a thousand million times as large, and all times as long: everything is drawn in the same place, with other units. No
 * number of the program is a length, a time, a frequency or a force. */
static void pictures_are_the_same_in_other_units(void **)
{
    static const char *const units[PAIR][3] = {{"0.9 um", "30 ns", "0.2 uN"}, {"900 m", "30 s", "0.2 TN"}};
    for (int k = 0; k < PAIR; k++) {
        const char *length = units[k][0], *time = units[k][1], *force = units[k][2];
        char text[4000];
        snprintf(text, sizeof text,
                 "materials:\n"
                 "  large: {density: 7800 kg/m3, modulus: 200 GPa, poisson: 0.3, radius: %s}\n"
                 "  light: {density: 2700 kg/m3, modulus: 70 GPa, poisson: 0.3, radius: %s}\n"
                 "chain: {striker: {bead: large, velocity: 1 m/s}, wall: rigid, precompression: %s, beads: [{cell: [large, "
                 "light], count: 5}, "
                 "{bead: large, sensor: s}]}\n"
                 "simulate: {until: %s}\n"
                 "outputs:\n",
                 length, length, force, time);
        static const char *const outputs[] = {
            "image: 0.pdf",
            "image: 1.pdf, field: velocity, views: [beads, profile, sensors]",
            "image: 2.pdf, field: displacement, orientation: time-down",
            "plot: 5.pdf, show: peaks",
            "plot: 6.pdf, show: energy",
            "plot: 7.pdf, show: spectrum",
            "plot: 8.pdf, show: dispersion",
            "plot: 9.pdf, show: spectrogram",
            "plot: 10.pdf, show: transfer",
            "plot: 12.pdf, show: bands",
            "plot: 16.pdf, show: eigenmodes",
        };
        for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "  - {%s, style: paper, size: [140 mm, 110 mm], dpi: %d}\n",
                     outputs[i], DPI);
        drawn_run(text, &drawn[k]);
    }
    assert_int_equal(drawn[0].marks, drawn[1].marks);
    assert_int_equal(drawn[0].texts, drawn[1].texts);
    for (size_t j = 0; j < drawn[0].marks; j++) {
        const struct mark *a = &drawn[0].mark[j], *b = &drawn[1].mark[j];
        for (int i = 0; i < 2; i++) {
            if (!(fabs(a->low[i] - b->low[i]) < 2 && fabs(a->high[i] - b->high[i]) < 2))
                fail_msg("page %zu: path %zu, %g to %g, is also %g to %g", a->page, j, a->low[i], a->high[i], b->low[i],
                         b->high[i]);
        }
    }
    for (size_t j = 0; j < drawn[0].texts; j++) {
        const char *a = drawn[0].text[j].text, *b = drawn[1].text[j].text;
        if (!same_but_for_prefixes(a, b))
            fail_msg("page %zu: '%s' is also '%s'", drawn[0].text[j].page, a, b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_the_same_at_twice_the_resolution),
        cmocka_unit_test(pictures_are_the_same_in_other_units),
    };
    return cmocka_run_group_tests_name("pictures at twice the resolution", tests, make_directory, remove_directory);
}
