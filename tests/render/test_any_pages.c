/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of any kind and shape, drawn by seed: chains, views, fields, parts of beads and times, long names, captions, letters and
 * panels, wide pages and narrow ones. All keep the laws of pages. They are the same in other ways: with twice as many pixels,
 * drawn after others or before them. */
#include "drawn.h"
#include "page_laws.h"

enum { PAGES = 8, RUNS = 4, FIRST_SEED = 20, LEAST_WIDTH = 120, LEAST_HEIGHT = 90, DPI = 381, CHAINS_MOST = 3 };
static struct drawn drawn[2];
static uint64_t random_state;

static size_t any(size_t count)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(random_state >> 33) % count;
}

#define ANY(list) (list)[any(sizeof(list) / sizeof *(list))]

struct scene {
    size_t used;
    char text[8000];
};

__attribute__((format(printf, 2, 3))) static void add(struct scene *s, const char *words, ...)
{
    va_list more;
    va_start(more, words);
    s->used += (size_t)vsnprintf(s->text + s->used, sizeof s->text - s->used, words, more);
    va_end(more);
    assert_true(s->used < sizeof s->text);
}

/* ---- chains ---- */

static void add_chain(struct scene *s, size_t index, size_t count, bool pressed)
{
    static const char *const names[] = {"even", "one with a longer name", "*B*_{2}"},
                             *const segments[] = {"{bead: large-steel, count: 12}",
                                                  "{cell: [large-steel, aluminium], count: 5}",
                                                  "{cell: [large-steel, aluminium], count: 4, spins: random}",
                                                  "{cell: [large-steel, large-steel, ptfe], count: 3}",
                                                  "{bead: small-steel, count: 9}",
                                                  "{bead: large-steel, count: 8, taper: 4 %}, {bead: brass}"},
                             *const sensors[] = {"{bead: large-steel, sensor: s}",
                                                 "{bead: ptfe, sensor: first}, {bead: large-steel, sensor: the last bead of all}"},
                             *const ends[] = {"", ", wall: brass", ", wall: rigid", ", wall: aluminium, tilt: 5 deg"};
    add(s, count > 1 ? "  - {name: \"%s\", " : "chain: {", names[index]);
    add(s, "striker: {velocity: %s}, beads: [%s, %s%s]%s}\n", any(2) ? "1 m/s" : "0.3 m/s",
        pressed ? "{cell: [large-steel, aluminium], count: 6}" : ANY(segments), ANY(sensors),
        any(2) ? ", {bead: large-steel, count: 3}" : "", pressed ? ", wall: brass, precompression: 5 N" : ANY(ends));
}

/* ---- pages ---- */

static void add_image(struct scene *s)
{
    static const char *const times[] = {"spacetime", "profile, spacetime", "beads, profile, spacetime",
                                        "sensors",   "spacetime, sensors", "beads, spacetime"},
                             *const moments[] = {"beads, profile", "profile", "beads"},
                             *const fields[] = {"force", "velocity", "displacement", "contact-force", "energy", "compression"},
                             *const of_times[] = {", orientation: time-down", ", time: [40 us, 150 us]", ", trust: true"},
                             *const of_moments[] = {", at: 90 us", ", light: beads"},
                             *const more[] = {"",
                                              "",
                                              ", beads: [2, 9]",
                                              ", scale: log",
                                              ", theme: dark",
                                              ", scale: linear",
                                              ", caption: \"Waves of *F*_{m} in a chain\"",
                                              ", colormap: batlow"};
    const bool moment = any(3) == 0;
    add(s, "views: [%s], field: %s%s%s", moment ? ANY(moments) : ANY(times), ANY(fields),
        any(2)   ? ""
        : moment ? ANY(of_moments)
                 : ANY(of_times),
        ANY(more));
}

static void add_panels(struct scene *s)
{
    static const char *const panels[] = {"{field: force}",  "{field: velocity, title: How fast}",
                                         "{show: sensors}", "{field: energy}",
                                         "{show: peaks}",   "{show: energy}"};
    add(s, "panels: [[%s, %s], [%s]]%s", ANY(panels), ANY(panels), ANY(panels), any(3) ? "" : ", letters: false");
}

static const char *const shows[] = {"peaks",
                                    "peaks, scale: log",
                                    "sensors",
                                    "sensors, normalise: max",
                                    "sensors, time: [30 us, 160 us], caption: At the sensor",
                                    "sensors, overlay: true",
                                    "sensors, field: velocity, theme: dark",
                                    "energy",
                                    "energy, parts: place",
                                    "spreading",
                                    "profiles, at: [60 us, 120 us]",
                                    "profiles, field: velocity, at: [60 us, 120 us], overlay: true",
                                    "spectrum, beads: [2, 5], every: 2 us",
                                    "spectrum, beads: [2, 3, 4], scale: log, every: 2 us",
                                    "transfer, beads: [2, 5], every: 2 us",
                                    "dispersion, every: 2 us",
                                    "setup",
                                    "setup",
                                    "contact",
                                    "eigenmodes",
                                    "bands"};

static const char *add_page(struct scene *s, bool pressed)
{
    enum { OF_PRESSED = 3 }; /* the last ones */
    const size_t kind = any(12), all = sizeof shows / sizeof *shows;
    if (kind < 7)
        add(s, "show: %s", shows[any(all - (pressed ? 0 : OF_PRESSED))]);
    else if (kind < 8)
        add_panels(s);
    else
        add_image(s);
    return kind < 7 ? "plot" : "image";
}

static struct page {
    const char *file;
    struct scene keys;
} pages[PAGES];

static void record(const struct scene *run, const int size[2], int dpi, bool reversed, struct drawn *d)
{
    static struct scene s;
    s = *run;
    add(&s, "outputs:\n");
    for (size_t i = 0; i < PAGES; i++) {
        const size_t p = reversed ? PAGES - 1 - i : i;
        add(&s, "  - {%s: %zu.pdf, %s, style: paper, size: [%d mm, %d mm], dpi: %d}\n", pages[p].file, p, pages[p].keys.text,
            size[0], size[1], dpi);
    }
    drawn_run(s.text, d);
    assert_int_equal(d->pages, PAGES);
}

static size_t next_mark(const struct drawn *d, size_t page, size_t from)
{
    while (from < d->marks && d->mark[from].page != page)
        from++;
    return from;
}

static size_t next_text(const struct drawn *d, size_t page, size_t from)
{
    while (from < d->texts && d->text[from].page != page)
        from++;
    return from;
}

/* Is all of a page drawn in the same order, in the same places, as another in the other way? Else what is not goes to `why`. */
static bool same_marks(size_t page, size_t other, double slack, char why[200])
{
    const struct drawn *a = &drawn[0], *b = &drawn[1];
    size_t i = next_mark(a, page, 0), j = next_mark(b, other, 0);
    for (; i < a->marks && j < b->marks; i = next_mark(a, page, i + 1), j = next_mark(b, other, j + 1)) {
        const struct mark *m = &a->mark[i], *n = &b->mark[j];
        double apart = m->filled == n->filled ? 8 * fabs(m->width - n->width) : INFINITY; /* widths are rounded more finely */
        for (int k = 0; k < 2; k++)
            apart = fmax(apart, fmax(fabs(m->low[k] - n->low[k]), fabs(m->high[k] - n->high[k])));
        snprintf(why, 200, "path %zu, %g wide, %g to %g, %g to %g pt, is also %g wide, at %g to %g, %g to %g", i, m->width,
                 m->low[0], m->high[0], m->low[1], m->high[1], n->width, n->low[0], n->high[0], n->low[1], n->high[1]);
        if (!(apart <= slack))
            return false;
    }
    snprintf(why, 200, "other paths");
    return i >= a->marks && j >= b->marks;
}

static bool same_texts(size_t page, size_t other, double slack, char why[200])
{
    const struct drawn *a = &drawn[0], *b = &drawn[1];
    size_t i = next_text(a, page, 0), j = next_text(b, other, 0);
    for (; i < a->texts && j < b->texts; i = next_text(a, page, i + 1), j = next_text(b, other, j + 1)) {
        const struct words *m = &a->text[i], *n = &b->text[j];
        snprintf(why, 200, "'%.40s' at %g, %g pt is also '%.40s' at %g, %g", m->text, m->x, m->y, n->text, n->x, n->y);
        if (strcmp(m->text, n->text) != 0 || !(hypot(m->x - n->x, m->y - n->y) <= slack))
            return false;
    }
    snprintf(why, 200, "other words");
    return i >= a->texts && j >= b->texts;
}

/* ---- laws ---- */

static bool has_even_axes(const char *keys)
{
    static const char *const others[] = {"views: [beads", "panels", "scale: log", "spreading"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (strstr(keys, others[i]))
            return false;
    }
    return true;
}

static void pages_have_no_order(const struct scene *run, const int size[2])
{
    char why[200];
    record(run, size, DPI, true, &drawn[1]);
    for (size_t p = 0; p < PAGES; p++) {
        if (!same_marks(p, PAGES - 1 - p, 0, why) || !same_texts(p, PAGES - 1 - p, 0, why))
            fail_msg("%s: in another order, %s", pages[p].keys.text, why);
    }
}

/* What rounding decides, as the number of ticks, differs in one size, but not in all: a page is the same in one of three. */
static void pages_have_no_pixels(const struct scene *run, const int size[2])
{
    enum { SIZES = 3 };
    const double slack = 3; /* pt: legends are put to one of a few places, beads are a part of a row of whole pixels */
    char why[PAGES][200];
    bool same[PAGES] = {false}, all = false;
    for (int s = 0; s < SIZES && !all; s++) {
        const int larger[2] = {size[0] + s, size[1] + s};
        for (int k = 0; k < 2; k++)
            record(run, larger, DPI << k, false, &drawn[k]);
        all = true;
        for (size_t p = 0; p < PAGES; p++) {
            same[p] = same[p] || (same_marks(p, p, slack, why[p]) && same_texts(p, p, slack, why[p]));
            all = all && same[p];
        }
    }
    for (size_t p = 0; p < PAGES; p++) {
        if (!same[p])
            fail_msg("%s: with twice the pixels, %s", pages[p].keys.text, why[p]);
    }
}

static void draw_pages(size_t seed)
{
    static struct scene run;
    random_state = seed;
    (void)any(2);
    const int size[2] = {LEAST_WIDTH + (int)any(70), LEAST_HEIGHT + (int)any(70)};
    const size_t chains = 1 + any(CHAINS_MOST);
    const bool pressed = any(3) == 0;
    run.used = 0;
    add(&run, "simulate: {until: 0.2 ms}\n%s", chains > 1 ? "chains:\n" : "");
    for (size_t c = 0; c < chains; c++)
        add_chain(&run, c, chains, pressed);
    for (size_t p = 0; p < PAGES; p++) {
        pages[p].keys.used = 0;
        pages[p].file = add_page(&pages[p].keys, pressed);
    }
    record(&run, size, DPI, false, &drawn[0]);
    page_laws_everywhere(&drawn[0], size[0] * 72 / 25.4, size[1] * 72 / 25.4);
    for (size_t p = 0; p < PAGES; p++) {
        if (has_even_axes(pages[p].keys.text))
            page_laws_of_axes(&drawn[0], p);
    }
    pages_have_no_order(&run, size);
    pages_have_no_pixels(&run, size);
}

static void any_page_keeps_the_laws(void **)
{
    for (size_t seed = FIRST_SEED; seed < FIRST_SEED + RUNS; seed++)
        draw_pages(seed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_page_keeps_the_laws)};
    return cmocka_run_group_tests_name("any pages", tests, make_directory, remove_directory);
}
