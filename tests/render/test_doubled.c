/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of the same size on paper with twice as many pixels: everything is drawn in the same place, as wide as before, but for
 * what rounding to pixels moves. All sizes and distances are thus in units of type, lines or the page, none in pixels. */
#include <pango/pangocairo.h>

#include "strokes.h"

#include <stdio.h>

#include "sessions.h"
#include "tests/pictures.h"

enum { TEXTS_MOST = 600, PAIR = 2, DPI = 254 };

/* What is drawn on pages, in points; texts begin at a place. */
struct drawn {
    size_t marks, texts;
    struct mark {
        bool filled;
        double width, low[2], high[2];
    } mark[STROKES_MOST];
    struct words {
        double x, y;
        char text[120];
    } text[TEXTS_MOST];
};
static struct drawn drawn[PAIR], *now;

static void note_text(cairo_t *cr, const char *text)
{
    if (!now || cairo_surface_get_type(cairo_get_target(cr)) != CAIRO_SURFACE_TYPE_PDF)
        return;
    assert_true(now->texts < TEXTS_MOST);
    struct words *words = &now->text[now->texts++];
    cairo_get_current_point(cr, &words->x, &words->y);
    cairo_user_to_device(cr, &words->x, &words->y);
    snprintf(words->text, sizeof words->text, "%s", text);
}

void pango_cairo_show_layout(cairo_t *cr, PangoLayout *layout)
{
    static void (*next)(cairo_t *, PangoLayout *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "pango_cairo_show_layout");
    note_text(cr, pango_layout_get_text(layout));
    next(cr, layout);
}

void pango_cairo_show_layout_line(cairo_t *cr, PangoLayoutLine *line)
{
    static void (*next)(cairo_t *, PangoLayoutLine *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "pango_cairo_show_layout_line");
    note_text(cr, pango_layout_get_text(line->layout) + line->start_index);
    next(cr, line);
}

#define STRIKER "striker: {bead: large-steel, velocity: 1 m/s}, "
static const char chains[] =
    "chains:\n"
    "  - {name: a chain of beads that are all equal, " STRIKER
    "beads: [{bead: large-steel, count: 12}, {bead: large-steel, sensor: s}], wall: brass}\n"
    "  - {name: one of beads that are not, " STRIKER "beads: [{bead: large-steel, count: 6}, {cell: [large-steel, aluminium], "
    "count: 3}, {bead: ptfe, sensor: last}], wall: brass}\n"
    "simulate: {until: 0.3 ms}\n";
static const char one[] = "chain: {" STRIKER "wall: brass, precompression: 2 N, beads: [{bead: large-steel, count: 40}, "
                          "{bead: small-steel, sensor: first}, {bead: small-steel, sensor: second}, {bead: ptfe}]}\n"
                          "simulate: {until: 0.4 ms}\n";
static const char cells[] = "chain: {" STRIKER "beads: [{cell: [large-steel, large-steel, aluminium], count: 4, spins: random}]}\n"
                            "simulate: {until: 0.2 ms}\n";
static const char solitons[] = "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
                               "simulate: {until: 30}\n";
static const char mean[] = "sweep: {cells: 2, magnetism: 0, configurations: 2}\n";
static const char sweep[] = "sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\n";

static const struct {
    const char *scene, *output;
} pictures[] = {
    {chains, "image: %s, panels: [[{field: force}, {show: sensors}], [{field: velocity, views: [beads, profile]}]]"},
    {chains, "plot: %s, show: peaks"},
    {chains, "plot: %s, show: sensors"},
    {one, "plot: %s, show: setup"},
    {one, "plot: %s, show: contact"},
    {one, "plot: %s, show: bands"},
    {one, "plot: %s, show: profiles, at: [0.2 ms]"},
    {cells, "plot: %s, show: cell"},
    {solitons, "plot: %s, show: modes"},
    {sweep, "plot: %s"},
    {mean, "image: %s"},
    {sweep, "sheet: %s"},
};

static void take(struct drawn *d)
{
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *s = &strokes.list[i];
        if (s->surface == CAIRO_SURFACE_TYPE_PDF)
            d->mark[d->marks++] =
                (struct mark){s->filled, s->filled ? 0 : s->width, {s->low[0], s->low[1]}, {s->high[0], s->high[1]}};
    }
}

static void record(const char *scene, const char *output, int dpi, struct drawn *d)
{
    char text[3000], path[512], directory[512], keys[1000];
    snprintf(keys, sizeof keys, output, "a.pdf");
    snprintf(text, sizeof text, "%soutputs: [{%s, style: paper, size: [120 mm, 90 mm], dpi: %d}]\n", scene, keys, dpi);
    in_directory("scene.yaml", path, sizeof path);
    in_directory("", directory, sizeof directory);
    write_text(path, text);
    *d = (struct drawn){.marks = 0};
    now = d;
    strokes_begin();
    play_counts((struct bead_job){.input = path, .output = directory, .threads = 1});
    strokes.on = false;
    now = NULL;
    take(d);
}

/* Places are rounded to pixels, sizes that they depend on, too: three at most, of the coarser pixels. */
static void compare(const char *picture)
{
    static const double slack = 3 * 72.0 / DPI;
    assert_true(drawn[0].marks > 0 && drawn[0].texts > 0);
    assert_int_equal(drawn[0].marks, drawn[1].marks);
    assert_int_equal(drawn[0].texts, drawn[1].texts);
    for (size_t j = 0; j < drawn[0].marks; j++) {
        const struct mark *a = &drawn[0].mark[j], *b = &drawn[1].mark[j];
        double apart = a->filled == b->filled ? fabs(a->width - b->width) : INFINITY;
        for (int k = 0; k < 2; k++)
            apart = fmax(apart, fmax(fabs(a->low[k] - b->low[k]), fabs(a->high[k] - b->high[k])));
        if (!(apart < slack))
            fail_msg("%s: path %zu, %g to %g, %g to %g pt, is also at %g to %g, %g to %g", picture, j, a->low[0], a->high[0],
                     a->low[1], a->high[1], b->low[0], b->high[0], b->low[1], b->high[1]);
    }
    for (size_t j = 0; j < drawn[0].texts; j++) {
        const struct words *a = &drawn[0].text[j], *b = &drawn[1].text[j];
        if (strcmp(a->text, b->text) != 0 || !(hypot(a->x - b->x, a->y - b->y) < slack))
            fail_msg("%s: '%s' at %g, %g pt is also '%s' at %g, %g", picture, a->text, a->x, a->y, b->text, b->x, b->y);
    }
}

static void pictures_are_the_same_at_twice_the_resolution(void **)
{
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        for (int k = 0; k < PAIR; k++)
            record(pictures[i].scene, pictures[i].output, DPI * (k + 1), &drawn[k]);
        compare(pictures[i].output);
    }
}

static size_t count_texts(const struct drawn *d, const char *text)
{
    size_t count = 0;
    for (size_t i = 0; i < d->texts; i++)
        count += strstr(d->text[i].text, text) != NULL;
    return count;
}

/* Equal axes of panels above each other have numbers and titles below the lowest only. */
static void equal_axes_are_labelled_once(void **)
{
    record(one, "image: %s, panels: [[{field: force}], [{field: velocity}]]", DPI, &drawn[0]);
    assert_int_equal(count_texts(&drawn[0], "time ("), 1);
    assert_int_equal(count_texts(&drawn[0], "300"), 1);
    assert_int_equal(count_texts(&drawn[0], "bead"), 3); /* along both, and in the title of a bar */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_the_same_at_twice_the_resolution),
        cmocka_unit_test(equal_axes_are_labelled_once),
    };
    return cmocka_run_group_tests_name("pictures at twice the resolution", tests, make_directory, remove_directory);
}
