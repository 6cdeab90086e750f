/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A dark page shows what a light one does: the same words, lines and areas in the same places, in other colours. Only panels
 * differ: they have frames on light pages, and are themselves visible on dark ones. */
#include "drawn.h"
#include "page_laws.h"

enum { THEMES = 2, OUTPUTS_MOST = 16 };
static const int size[2] = {150, 120}; /* mm */
static const double slack = 1;         /* pt: layouts leave room for frames where there are some */
static struct drawn drawn[THEMES];

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
      "image: %s, views: [spacetime, sensors], trust: true, orientation: time-down", "plot: %s, show: peaks",
      "plot: %s, show: energy", "plot: %s, show: sensors, trust: true"}},
    {"chain: {" STRIKER "wall: brass, precompression: 2 N, beads: [{bead: large-steel, count: 20}, "
     "{bead: small-steel, sensor: first}, {bead: ptfe}]}\n"
     "simulate: {until: 0.2 ms}\n",
     {"plot: %s, show: setup", "plot: %s, show: contact", "plot: %s, show: bands",
      "plot: %s, show: profiles, at: [0.1 ms, 0.2 ms]"}},
    {"chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
     "simulate: {until: 30}\n",
     {"plot: %s, show: modes", "image: %s"}},
    {"sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\n", {"plot: %s", "sheet: %s"}},
};

static void record(size_t scene, int dark, struct drawn *d)
{
    char keys[100];
    snprintf(keys, sizeof keys, "theme: %s, size: [%d mm, %d mm], dpi: 381", dark ? "dark" : "light", size[0], size[1]);
    drawn_run_all(scenes[scene].chains, scenes[scene].outputs, OUTPUTS_MOST, keys, d);
}

/* The places of strokes and fills of a page in one theme; strokes are recorded anew for each. */
static struct place {
    size_t page;
    bool filled, rectangle;
    int dashes;
    double width, low[2], high[2];
} places[THEMES][STROKES_MOST];
static size_t counts[THEMES];

/* With sides along the page's. */
static bool is_rectangle(const struct stroke *s)
{
    if (s->begun != 1 || s->count < 4 || s->count > 5)
        return false;
    for (size_t i = 0; i < s->count; i++) {
        for (int k = 0; k < 2; k++) {
            const double at = k ? s->at[i].y : s->at[i].x;
            if (fabs(at - s->low[k]) > 0.01 && fabs(at - s->high[k]) > 0.01)
                return false;
        }
    }
    return true;
}

static void take_places(int theme)
{
    counts[theme] = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *s = &strokes.list[i];
        if (s->surface != CAIRO_SURFACE_TYPE_PDF)
            continue;
        struct place *p = &places[theme][counts[theme]++];
        *p = (struct place){drawn_page[i], s->filled, is_rectangle(s), s->dashes, s->filled ? 0 : s->width, {0, 0}, {0, 0}};
        for (int k = 0; k < 2; k++)
            p->low[k] = fmax(s->low[k], s->clip_low[k]), p->high[k] = fmin(s->high[k], s->clip_high[k]);
    }
}

static bool same_place(const struct place *a, const struct place *b, double apart)
{
    return a->page == b->page && fabs(a->low[0] - b->low[0]) < apart && fabs(a->low[1] - b->low[1]) < apart &&
           fabs(a->high[0] - b->high[0]) < apart && fabs(a->high[1] - b->high[1]) < apart;
}

/* All but rectangles, in the same order. */
static void lines_are_the_same(const char *chains)
{
    size_t j = 0, compared = 0;
    for (size_t i = 0; i < counts[0]; i++) {
        const struct place *a = &places[0][i];
        if (a->rectangle)
            continue;
        while (j < counts[1] && places[1][j].rectangle)
            j++;
        const struct place *b = &places[1][j++];
        if (j > counts[1] || a->filled != b->filled || a->dashes != b->dashes || a->width != b->width || !same_place(a, b, slack))
            fail_msg("%s: page %zu, line %zu at %g to %g, %g to %g is another one, %g to %g, %g to %g", chains, a->page, i,
                     a->low[0], a->high[0], a->low[1], a->high[1], b->low[0], b->high[0], b->low[1], b->high[1]);
        compared++;
    }
    while (j < counts[1] && places[1][j].rectangle)
        j++;
    assert_true(compared > 0 && j == counts[1]);
}

static bool has_rectangle(int theme, const struct place *like, bool filled)
{
    for (size_t j = 0; j < counts[theme]; j++) {
        if (places[theme][j].rectangle && places[theme][j].filled == filled && same_place(like, &places[theme][j], 1))
            return true;
    }
    return false;
}

/* A frame is drawn on light pages only, and around what is filled on dark ones; others, as of legends, on both. */
static size_t panels_are_framed_or_filled(const char *chains)
{
    size_t framed = 0;
    for (int theme = 0; theme < THEMES; theme++) {
        for (size_t i = 0; i < counts[theme]; i++) {
            const struct place *a = &places[theme][i];
            if (!a->rectangle || a->filled || fmin(a->high[0] - a->low[0], a->high[1] - a->low[1]) < 20)
                continue;
            const bool both = has_rectangle(!theme, a, false), panel = theme == 0 && has_rectangle(1, a, true);
            if (both == panel)
                fail_msg("%s: page %zu, theme %d: a frame from %g to %g, %g to %g", chains, a->page, theme, a->low[0], a->high[0],
                         a->low[1], a->high[1]);
            framed += panel;
        }
    }
    return framed;
}

static void dark_pages_are_light_ones_in_other_colours(void **)
{
    size_t framed = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        for (int dark = 0; dark < THEMES; dark++) {
            record(i, dark, &drawn[dark]);
            take_places(dark);
        }
        page_laws(&drawn[1], size[0] * 72 / 25.4, size[1] * 72 / 25.4);
        lines_are_the_same(scenes[i].chains);
        framed += panels_are_framed_or_filled(scenes[i].chains);
        assert_int_equal(drawn[0].texts, drawn[1].texts);
        for (size_t j = 0; j < drawn[0].texts; j++) {
            const struct words *a = &drawn[0].text[j], *b = &drawn[1].text[j];
            if (strcmp(a->text, b->text) != 0 || a->page != b->page || hypot(a->x - b->x, a->y - b->y) > slack)
                fail_msg("page %zu: '%s' at %g, %g is '%s' at %g, %g in the dark", a->page, a->text, a->x, a->y, b->text, b->x,
                         b->y);
        }
    }
    assert_true(framed > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(dark_pages_are_light_ones_in_other_colours)};
    return cmocka_run_group_tests_name("dark pages", tests, make_directory, remove_directory);
}
