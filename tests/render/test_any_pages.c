/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of any kind and shape, drawn by seed: chains, views, fields, parts of beads and times, long names, captions, letters and
 * panels, wide pages and narrow ones. All keep the laws of pages. They are the same in other ways: with twice as many pixels,
 * drawn after others or before them. */
#include "drawn.h"
#include "page_laws.h"

enum { PAGES_MOST = 8, RUNS = 3, FIRST_SEED = 20, LEAST_WIDTH = 120, LEAST_HEIGHT = 90, DPI = 190, CHAINS_MOST = 3 };
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

static void add(struct scene *s, const char *words, ...)
{
    va_list more;
    va_start(more, words);
    s->used += (size_t)vsnprintf(s->text + s->used, sizeof s->text - s->used, words, more);
    va_end(more);
    assert_true(s->used < sizeof s->text);
}

static struct scene pages[PAGES_MOST];
static size_t page_count;

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
                             *const ends[] = {"",
                                              ", wall: brass",
                                              ", wall: rigid",
                                              ", wall: aluminium, tilt: 5 deg",
                                              ", wall: brass, gap: 2 um",
                                              ", drive: {bead: last, force: sine, amplitude: 1 N, frequency: 20 kHz}",
                                              ", start: [{bead: last, velocity: -0.5 m/s}], cradle: {length: 20 cm}"};
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

static void add_page(struct scene *s, bool pressed)
{
    enum { OF_PRESSED = 3 }; /* the last ones */
    const size_t kind = any(12), all = sizeof shows / sizeof *shows;
    add(s, "%s: %zu.pdf, ", kind < 7 ? "plot" : "image", page_count);
    if (kind < 7)
        add(s, "show: %s", shows[any(all - (pressed ? 0 : OF_PRESSED))]);
    else if (kind < 8)
        add_panels(s);
    else
        add_image(s);
}

/* Other systems, with what only they show. */
static const struct system {
    const char *text, *pages[5];
} systems[] = {
    {"chain: {equation: fput, points: 15, alpha: 0.25, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 60}\n",
     {"plot: %s, show: modes, modes: 2", "image: %s, views: [profile, spacetime]", "image: %s, field: velocity",
      "plot: %s, show: profiles, at: [0, 20, 60]", "image: %s, views: [beads, profile]"}},
    {"chain: {equation: kdv, low: -12, length: 34, points: 100, start: {solitons: [{speed: 4, at: 0}]}}\nsimulate: {until: 0.5}\n",
     {"image: %s", "plot: %s, show: profiles, at: [0, 0.2, 0.5]", "image: %s, views: [profile, spacetime], theme: dark",
      "image: %s, orientation: time-down, scale: log", "image: %s, views: [profile], at: 0.3"}},
    {"materials:\n  one: {density: 7800 kg/m3, modulus: 200 GPa, poisson: 0.3, radius: 5 mm, colour: \"#19a7e3\"}\n"
     "  other: {density: 2700 kg/m3, modulus: 70 GPa, poisson: 0.3, radius: 5 mm, colour: \"#d1396d\"}\n"
     "chain: {striker: {bead: one, velocity: 1 m/s}, beads: [{cell: [one, other], count: 3}, {bead: one, sensor: s}], wall: "
     "other}\n"
     "simulate: {until: 0.1 ms}\n",
     {"image: %s, views: [beads, profile]", "plot: %s, show: setup", "plot: %s, show: contact", "plot: %s, show: cell",
      "image: %s, views: [beads, spacetime], theme: dark"}},
    {"sweep: {cells: 3, magnetism: [0, 1], configurations: 3}\n",
     {"plot: %s", "plot: %s, show: mean", "sheet: %s, configurations: 2", "plot: %s, show: median, theme: dark",
      "sheet: %s, field: velocity, theme: dark, orientation: time-down"}},
    {"sweep: {cells: 4, magnetism: 0, configurations: 4}\n",
     {"image: %s", "image: %s, show: deviation, field: velocity, orientation: time-down",
      "image: %s, show: median, theme: dark, caption: The middle", "image: %s, show: upper-quartile, scale: log", "sheet: %s"}},
    {"chain: {striker: {velocity: 1 m/s}, beads: [{bead: small-steel, count: 3}, {bead: small-steel, sensor: s}]}\n"
     "sweep: {over: {chain.striker.velocity: [0.1 m/s, 0.4 m/s, 1 m/s], chain.striker.mass: [2 g, 4 g]}}\nsimulate: {until: 80 "
     "us}\n",
     {"plot: %s", "plot: %s, show: plane", "plot: %s, against: chain.striker.mass", "plot: %s, show: sensors",
      "plot: %s, measure: front speed, theme: dark"}},
};

static void record(const struct scene *run, const int size[2], int dpi, bool reversed, struct drawn *d)
{
    static struct scene s;
    s = *run;
    add(&s, "outputs:\n");
    for (size_t i = 0; i < page_count; i++) {
        const size_t p = reversed ? page_count - 1 - i : i;
        add(&s, "  - {%s, style: paper, size: [%d mm, %d mm], dpi: %d}\n", pages[p].text, size[0], size[1], dpi);
    }
    drawn_run(s.text, d);
    assert_int_equal(d->pages, page_count);
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
        double apart = m->filled == n->filled ? 6 * fabs(m->width - n->width) : INFINITY; /* widths are rounded more finely */
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
    static const char *const others[] = {"views: [beads", "panels", "scale: log", "spreading", "show: contact"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (strstr(keys, others[i]))
            return false;
    }
    return true;
}

/* Are all pages, or were they in another size, the same in another order and with twice the pixels? */
static bool all_same(bool same[PAGES_MOST], char why[PAGES_MOST][200])
{
    const double slack = 3; /* pt: legends are put to one of a few places, beads are a part of a row of whole pixels */
    bool all = true;
    for (size_t p = 0; p < page_count; p++) {
        const size_t other = page_count - 1 - p;
        same[p] = same[p] || (same_marks(p, other, slack, why[p]) && same_texts(p, other, slack, why[p]));
        all = all && same[p];
    }
    return all;
}

/* What rounding decides, as the number of ticks, differs in one size, but not in all: a page is the same in one of three. */
static void draw_pages(const struct scene *run)
{
    enum { SIZES = 3 };
    char why[PAGES_MOST][200];
    bool same[PAGES_MOST] = {false}, all = false;
    int size[2] = {LEAST_WIDTH + (int)any(70), LEAST_HEIGHT + (int)any(70)};
    for (int s = 0; s < SIZES && !all; s++, size[0]++, size[1]++) {
        record(run, size, DPI, false, &drawn[0]);
        record(run, size, 2 * DPI, true, &drawn[1]);
        all = all_same(same, why);
        page_laws_everywhere(&drawn[1], size[0] * 72 / 25.4, size[1] * 72 / 25.4);
        for (size_t p = 0; p < page_count; p++) {
            if (has_even_axes(pages[page_count - 1 - p].text))
                page_laws_of_axes(&drawn[1], p);
        }
    }
    for (size_t p = 0; p < page_count; p++) {
        if (!same[p])
            fail_msg("%s: in other ways, %s", pages[p].text, why[p]);
    }
}

static void draw_chains(uint64_t seed)
{
    static struct scene run;
    random_state = seed;
    (void)any(2);
    const size_t chains = 1 + any(CHAINS_MOST);
    const bool pressed = any(3) == 0;
    run.used = 0;
    add(&run, "simulate: {until: 0.2 ms}\n%s", chains > 1 ? "chains:\n" : "");
    for (size_t c = 0; c < chains; c++)
        add_chain(&run, c, chains, pressed);
    for (page_count = 0; page_count < PAGES_MOST; page_count++) {
        pages[page_count].used = 0;
        add_page(&pages[page_count], pressed);
    }
    draw_pages(&run);
}

/* What has two parts of the colour of a material has the third, in their order. Returns how often. */
static size_t whole_colours(void)
{
    size_t whole = 0;
    static const double own[][3] = {{0x19 / 255.0, 0xa7 / 255.0, 0xe3 / 255.0}, {0xd1 / 255.0, 0x39 / 255.0, 0x6d / 255.0}};
    for (size_t i = 0; i < strokes.count; i++) {
        for (size_t m = 0; m < sizeof own / sizeof *own; m++) {
            const double *c = strokes.list[i].rgb;
            int parts = 0, there = 0;
            for (int k = 0; k < 3; k++) {
                there += fabs(c[k] - own[m][k]) < 1e-9;
                parts += fmin(fabs(c[0] - own[m][k]), fmin(fabs(c[1] - own[m][k]), fabs(c[2] - own[m][k]))) < 1e-9;
            }
            whole += there == 3;
            if (parts > 1 && there < 3)
                fail_msg("a colour of %g, %g, %g", c[0], c[1], c[2]);
        }
    }
    return whole;
}

static void draw_system(const struct system *system)
{
    static struct scene run;
    run.used = 0;
    add(&run, "%s", system->text);
    for (page_count = 0; page_count < sizeof system->pages / sizeof *system->pages; page_count++) {
        char file[16];
        snprintf(file, sizeof file, "%zu.pdf", page_count);
        pages[page_count].used = 0;
        add(&pages[page_count], system->pages[page_count], file);
    }
    draw_pages(&run);
    assert_true(whole_colours() > 0 || !strstr(system->text, "colour:"));
}

static void other_systems_keep_the_laws(void **)
{
    random_state = FIRST_SEED;
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++)
        draw_system(&systems[i]);
}

static void any_page_keeps_the_laws(void **)
{
    for (uint64_t seed = FIRST_SEED; seed < FIRST_SEED + RUNS; seed++)
        draw_chains(seed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_page_keeps_the_laws), cmocka_unit_test(other_systems_keep_the_laws)};
    return cmocka_run_group_tests_name("any pages", tests, make_directory, remove_directory);
}
