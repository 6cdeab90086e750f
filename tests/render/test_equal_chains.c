/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains that are equal look equal, on paper, as numbers: each panel of a page shows the same lines, areas and words in the same
 * places of its frame. Those that differ say the same in any order. What is done for one is done for all, the last one, too. */
#include "drawn.h"
#include "page_laws.h"

enum { EQUAL = 3, PANELS_MOST = 16, OUTPUTS_MOST = 12 };
static const int size[2] = {180, 150}; /* mm */
static struct drawn drawn;
static size_t named; /* pages with names above their panels */

#define STRIKER      "striker: {bead: large-steel, velocity: 1 m/s}, "
#define THREE(chain) "chains:\n  - {name: one, " chain "}\n  - {name: two, " chain "}\n  - {name: six, " chain "}\n"
static const char *const names[EQUAL] = {"one", "two", "six"};
static const struct {
    const char *chains, *outputs[OUTPUTS_MOST];
} scenes[] = {
    {THREE(STRIKER "beads: [{bead: large-steel, count: 5}, {bead: large-steel, sensor: s}, {bead: large-steel, count: 3}, {cell: "
                   "[large-steel, aluminium], count: 3}], "
                   "wall: brass, precompression: 1 N") "simulate: {until: 0.2 ms}\n",
     {"image: %s, views: [beads, profile, spacetime]", "image: %s, orientation: time-down", "image: %s, views: [sensors]",
      "image: %s, field: velocity, views: [profile, spacetime], at: 0.1 ms", "plot: %s, show: sensors", "plot: %s, show: energy",
      "plot: %s, show: peaks", "plot: %s, show: setup", "plot: %s, show: profiles, at: [0.05 ms, 0.1 ms]",
      "plot: %s, show: spectrum"}},
    {THREE("precompression: 100 N, beads: [{cell: [large-steel, aluminium], count: 6}, {bead: large-steel, sensor: s}], wall: "
           "brass") "simulate: {until: 0.4 ms}\n",
     {"plot: %s, show: bands", "plot: %s, show: eigenmodes", "plot: %s, show: cell"}},
    {THREE("precompression: 100 N, " STRIKER
           "beads: [{bead: large-steel, count: 20}, {bead: large-steel, sensor: s}], wall: brass") "simulate: {until: 0.4 ms}\n",
     {"plot: %s, show: spectrogram", "plot: %s, show: dispersion", "plot: %s, show: spreading", "plot: %s, show: transfer"}},
    {THREE("equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}") "simulate: {until: 30}\n",
     {"plot: %s, show: modes", "image: %s"}},
};

/* The frames of panels of a page; one that is drawn twice counts once. */
static size_t find_panels(size_t page, const struct stroke *panels[PANELS_MOST])
{
    size_t count = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        bool known = !is_panel(j, page);
        for (size_t k = 0; !known && k < count; k++)
            known = hypot(s->low[0] - panels[k]->low[0], s->low[1] - panels[k]->low[1]) < 0.1;
        assert_true(known || count < PANELS_MOST);
        if (!known)
            panels[count++] = s;
    }
    return count;
}

static void visible(const struct stroke *s, double low[2], double high[2])
{
    for (int k = 0; k < 2; k++)
        low[k] = fmax(s->low[k], s->clip_low[k]), high[k] = fmin(s->high[k], s->clip_high[k]);
}

static bool is_inside(const struct stroke *s, const struct stroke *panel)
{
    double low[2], high[2];
    visible(s, low, high);
    for (int k = 0; k < 2; k++) {
        if (low[k] < panel->low[k] - 0.5 || high[k] > panel->high[k] + 0.5)
            return false;
    }
    return low[0] < high[0] || low[1] < high[1];
}

/* The same line, or area, in the same place of another panel; chains have colours and dashes of their own. */
static bool is_same_in(const struct stroke *a, const struct stroke *panel, const struct stroke *b, const struct stroke *other)
{
    double low[2][2], high[2][2], apart = 0;
    visible(a, low[0], high[0]), visible(b, low[1], high[1]);
    for (int k = 0; k < 2; k++) {
        apart = fmax(apart, fabs(low[0][k] - panel->low[k] - (low[1][k] - other->low[k])));
        apart = fmax(apart, fabs(high[0][k] - panel->low[k] - (high[1][k] - other->low[k])));
    }
    return a->filled == b->filled && labs((long)a->count - (long)b->count) <= 1 + (long)a->count / 8 &&
           (a->filled || fabs(a->width - b->width) < 0.01) && apart < 0.45;
}

/* Samples of lines in a legend are short; there is one of all panels. */
static bool is_of_all(const struct stroke *s, const struct stroke *panel)
{
    return s->count > 5 || s->high[0] - s->low[0] > 0.4 * (panel->high[0] - panel->low[0]) ||
           s->high[1] - s->low[1] > 0.4 * (panel->high[1] - panel->low[1]);
}

/* What is in a panel is in another. */
static size_t assert_is_in(size_t page, const char *output, const struct stroke *panel, const struct stroke *other, bool all)
{
    size_t count = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        bool found = !is_on_page(j, page) || !is_inside(s, panel) || !(all || is_of_all(s, panel));
        count += !found;
        for (size_t i = 0; !found && i < strokes.count; i++)
            found = is_on_page(i, page) && is_inside(&strokes.list[i], other) && is_same_in(s, panel, &strokes.list[i], other);
        if (!found)
            fail_msg("%s: a line of %zu points, %g to %g, %g to %g, is not in the panel at %g, %g", output, s->count, s->low[0],
                     s->high[0], s->low[1], s->high[1], other->low[0], other->low[1]);
    }
    return count;
}

/* The heading with a chain's name; there is one. */
static const struct words *name_of(size_t page, size_t chain)
{
    const struct words *found = NULL;
    for (size_t i = 0; i < drawn.texts; i++) {
        if (drawn.text[i].page == page && drawn.text[i].text[0] == '(' && strstr(drawn.text[i].text, names[chain])) {
            assert_null(found);
            found = &drawn.text[i];
        }
    }
    return found;
}

/* Names are in the same place above their panels. */
static void names_are_above(size_t page, const struct stroke *const panels[EQUAL])
{
    const struct words *first = name_of(page, 0);
    named += first != NULL;
    for (size_t c = 1; c < EQUAL; c++) {
        const struct words *name = name_of(page, c);
        assert_int_equal(name != NULL, first != NULL);
        if (!first)
            continue;
        assert_page(name, fabs(name->x - panels[c]->low[0] - first->x + panels[0]->low[0]) < 0.45);
        assert_page(name, fabs(name->y - panels[c]->low[1] - first->y + panels[0]->low[1]) < 0.45);
    }
}

static bool is_disc(size_t stroke, size_t page)
{
    const struct stroke *s = &strokes.list[stroke];
    return is_on_page(stroke, page) && s->filled && s->count > 4 && s->high[0] - s->low[0] < 30 &&
           fabs(s->high[0] - s->low[0] - s->high[1] + s->low[1]) < 0.1;
}

/* Beads, and points of plots, are drawn chain after chain: each third is the first one, elsewhere. */
static void discs_are_equal(size_t page, const char *output)
{
    enum { DISCS_MOST = 2000 };
    static const struct stroke *discs[DISCS_MOST];
    size_t count = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        if (is_disc(j, page) && count < DISCS_MOST)
            discs[count++] = &strokes.list[j];
    }
    const size_t each = count / EQUAL;
    for (size_t i = 0; i < count; i++) {
        const struct stroke *a = discs[i % each], *b = discs[i], *from = discs[0], *to = discs[i - i % each];
        for (int k = 0; k < 2; k++) {
            if (fabs(b->low[k] - to->low[k] - a->low[k] + from->low[k]) > 0.45 ||
                fabs(b->high[k] - to->low[k] - a->high[k] + from->low[k]) > 0.45)
                fail_msg("%s: disc %zu of %zu at %g, %g, is elsewhere than the first one", output, i, count, b->low[0], b->low[1]);
        }
    }
}

static void panels_are_equal(size_t page, const char *output)
{
    const struct stroke *panels[PANELS_MOST];
    const size_t count = find_panels(page, panels);
    if (count == EQUAL)
        names_are_above(page, panels);
    for (size_t p = 1; p < count; p++) {
        const struct stroke *a = panels[0], *b = panels[p];
        for (int k = 0; k < 2; k++)
            assert_true(fabs(a->high[k] - a->low[k] - b->high[k] + b->low[k]) < 0.45);
        assert_true(assert_is_in(page, output, b, a, true) > 0);
        assert_true(assert_is_in(page, output, a, b, false) > 0);
    }
}

/* What is among the beads of each chain is named, from left to right. */
static void beads_are_named(size_t page)
{
    static const char *const things[] = {"striker", "s", "brass wall"};
    enum { THINGS = sizeof things / sizeof *things };
    double at[THINGS] = {0};
    size_t found[THINGS] = {0};
    for (size_t i = 0; i < drawn.texts; i++) {
        const struct words *a = &drawn.text[i];
        for (size_t k = 0; a->page == page && k < THINGS; k++) {
            const bool named_so = strcmp(a->text, things[k]) == 0;
            found[k] += named_so;
            at[k] = named_so ? a->centre[0] : at[k];
        }
    }
    for (size_t k = 0; k < THINGS; k++)
        assert_true(found[k] == EQUAL && at[k] > (k ? at[k - 1] : 0));
}

/* The band of equal beads is a quarter of a sine: at half the wave number, sin(45 deg) of its top, at the right. */
static void bands_are_sines(size_t page)
{
    const struct stroke *panels[PANELS_MOST];
    const size_t count = find_panels(page, panels);
    size_t bands = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        for (size_t p = 0; p < count; p++) {
            const struct stroke *f = panels[p];
            if (!is_on_page(j, page) || s->filled || s->dashes == 0 || s->count < 10 || !is_inside(s, f))
                continue;
            const double middle = (f->low[0] + f->high[0]) / 2, high = f->high[1] - s->low[1];
            double at = NAN;
            for (size_t i = 1; i < s->count; i++)
                at = s->at[i - 1].x <= middle && s->at[i].x > middle ? f->high[1] - s->at[i].y : at;
            assert_true(fabs(s->high[1] - f->high[1]) < 1 && fabs(s->high[0] - f->high[0]) < 1 &&
                        fabs(at / high - sqrt(0.5)) < 0.02);
            bands++;
        }
    }
    assert_int_equal(bands, 2 * EQUAL); /* a wider line is behind each */
}

/* Cells of two beads have two bands, and nothing is drawn from one to the other. */
static void bands_are_apart(size_t page)
{
    size_t curves = 0;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        if (!is_on_page(j, page) || s->filled || s->count < 20)
            continue;
        assert_int_equal(s->begun, 2);
        curves++;
    }
    assert_int_equal(curves, EQUAL);
}

static void equal_chains_look_equal(void **)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char keys[100];
        snprintf(keys, sizeof keys, "size: [%d mm, %d mm], dpi: 381", size[0], size[1]);
        drawn_run_all(scenes[i].chains, scenes[i].outputs, OUTPUTS_MOST, keys, &drawn);
        page_laws(&drawn, size[0] * 72 / 25.4, size[1] * 72 / 25.4);
        for (size_t p = 0; p < drawn.pages; p++) {
            if (strstr(scenes[i].outputs[p], "[beads"))
                beads_are_named(p);
            if (strstr(scenes[i].outputs[p], "bands"))
                bands_are_apart(p);
            if (strstr(scenes[i].outputs[p], "dispersion"))
                bands_are_sines(p);
            panels_are_equal(p, scenes[i].outputs[p]);
            discs_are_equal(p, scenes[i].outputs[p]);
        }
    }
    assert_true(named > 10);
}

/* Words of a page without letters of panels, sorted. */
static int by_words(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static size_t words_of(const struct drawn *d, size_t page, const char *words[WORDS_MOST])
{
    size_t count = 0;
    for (size_t i = 0; i < d->texts; i++) {
        const char *text = d->text[i].text, *letter = text[0] == '(' ? strchr(text, ')') : NULL;
        if (d->text[i].page == page)
            words[count++] = letter ? letter + 1 : text;
    }
    qsort(words, count, sizeof *words, by_words);
    return count;
}

/* Chains that differ say the same in any order: no range, unit, legend or label is of the first alone. */
static void chains_have_no_order(void **)
{
    static const char one[] = "{name: one, " STRIKER "beads: [{bead: large-steel, count: 9}, {bead: ptfe, sensor: s}]}",
                      two[] = "{name: two, " STRIKER "beads: [{bead: large-steel, count: 4}, {bead: small-steel, sensor: t}, "
                              "{bead: large-steel}], wall: brass}",
                      six[] = "{name: six, striker: {bead: large-steel, velocity: 0.2 m/s}, beads: [{cell: [large-steel, "
                              "aluminium], count: 6}, {bead: large-steel, sensor: s}], wall: rigid}";
    static const char *const chains[] = {one, two, six};
    static const char *const outputs[] = {"image: %zu.pdf",
                                          "image: %zu.pdf, views: [beads, profile]",
                                          "image: %zu.pdf, field: velocity, orientation: time-down",
                                          "plot: %zu.pdf, show: sensors",
                                          "plot: %zu.pdf, show: energy",
                                          "plot: %zu.pdf, show: peaks",
                                          "plot: %zu.pdf, show: setup",
                                          "plot: %zu.pdf, show: profiles, at: [0.05 ms, 0.1 ms]",
                                          "plot: %zu.pdf, show: spectrum",
                                          "plot: %zu.pdf, show: spreading"};
    enum { OUTPUTS = sizeof outputs / sizeof *outputs };
    static struct drawn orders[2];
    for (int k = 0; k < 2; k++) {
        char text[5000];
        int used = snprintf(text, sizeof text, "chains:\n  - %s\n  - %s\n  - %s\nsimulate: {until: 0.2 ms}\noutputs:\n",
                            chains[k ? 2 : 0], chains[1], chains[k ? 0 : 2]);
        for (size_t i = 0; i < OUTPUTS; i++) {
            used += snprintf(text + used, sizeof text - (size_t)used, "  - {");
            used += snprintf(text + used, sizeof text - (size_t)used, outputs[i], i);
            used += snprintf(text + used, sizeof text - (size_t)used, ", style: paper, size: [%d mm, %d mm], dpi: 127}\n", size[0],
                             size[1]);
        }
        drawn_run(text, &orders[k]);
    }
    for (size_t p = 0; p < OUTPUTS; p++) {
        static const char *words[2][WORDS_MOST];
        const size_t count = words_of(&orders[0], p, words[0]), other = words_of(&orders[1], p, words[1]);
        assert_true(count > 10);
        assert_int_equal(count, other);
        for (size_t i = 0; i < count; i++) {
            if (strcmp(words[0][i], words[1][i]) != 0)
                fail_msg("%s: '%s' is '%s' in another order", outputs[p], words[0][i], words[1][i]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_chains_look_equal),
        cmocka_unit_test(chains_have_no_order),
    };
    return cmocka_run_group_tests_name("equal chains", tests, make_directory, remove_directory);
}
