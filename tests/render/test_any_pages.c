/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of any kind and shape, drawn by seed: views, fields, parts of beads and times, long names, captions and letters, wide pages
 * and narrow ones. All keep the laws of pages, or are refused for lack of room. */
#include "drawn.h"
#include "page_laws.h"

enum { PAGES = 8, LEAST_WIDTH = 110, LEAST_HEIGHT = 80 };
static struct drawn drawn;
static uint64_t random_state = 1;

static size_t any(size_t count)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(random_state >> 33) % count;
}

#define ANY(list) (list)[any(sizeof(list) / sizeof *(list))]

static const char *const runs[] = {
    "chains:\n"
    "  - {name: even, striker: {velocity: 1 m/s}, beads: [{bead: large-steel, count: 12}, {bead: large-steel, sensor: s}], wall: "
    "brass}\n"
    "  - {name: \"one with a longer name\", striker: {velocity: 1 m/s}, beads: [{bead: large-steel, count: 6}, {cell: "
    "[large-steel, "
    "aluminium], count: 3}, {bead: ptfe, sensor: last}], wall: brass}\n",
    "chain: {striker: {velocity: 1 m/s}, precompression: 5 N, wall: brass, beads: [{bead: large-steel, count: 14}, {bead: "
    "aluminium, sensor: first}, {bead: aluminium, sensor: second}, {bead: ptfe}]}\n",
    "chain: {striker: {velocity: 0.3 m/s}, beads: [{bead: large-steel, sensor: the first bead of all}, {bead: large-steel, count: "
    "20}, "
    "{bead: large-steel, sensor: the last bead of all}]}\n"};

static void add_image(char *text, size_t size)
{
    static const char *const views[] = {"spacetime", "beads, profile", "profile, spacetime", "beads, profile, spacetime",
                                        "sensors",   "profile",        "spacetime, sensors", "beads, spacetime"},
                             *const fields[] = {"force", "velocity", "displacement", "contact-force", "energy"},
                             *const more[] = {"",
                                              ", orientation: time-down",
                                              ", beads: [2, 9]",
                                              ", time: [40 us, 150 us]",
                                              ", scale: sqrt",
                                              ", theme: dark",
                                              ", time: [20 us, 90 us]",
                                              ", caption: \"Waves of *F*_{m} in a chain\""};
    snprintf(text, size, "image: %%zu.pdf, views: [%s], field: %s%s", ANY(views), ANY(fields), ANY(more));
}

static void add_plot(char *text, size_t size)
{
    static const char *const shows[] = {"peaks",
                                        "peaks, scale: log",
                                        "sensors",
                                        "sensors, normalise: max",
                                        "sensors, time: [30 us, 160 us]",
                                        "energy",
                                        "energy, parts: place",
                                        "profiles, at: [60 us, 120 us]",
                                        "profiles, field: velocity, at: [60 us, 120 us], overlay: true",
                                        "spectrum, beads: [2, 5]",
                                        "transfer, beads: [2, 5]",
                                        "setup"};
    snprintf(text, size, "plot: %%zu.pdf, show: %s", ANY(shows));
}

/* Pages of one run in one shape. */
static void draw_pages(const char *run, int width, int height)
{
    static char text[8000];
    int used = snprintf(text, sizeof text, "%ssimulate: {until: 0.2 ms}\noutputs:\n", run);
    for (size_t i = 0; i < PAGES; i++) {
        char keys[300];
        (i % 2 ? add_plot : add_image)(keys, sizeof keys);
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {");
        used += snprintf(text + used, sizeof text - (size_t)used, keys, i);
        used +=
            snprintf(text + used, sizeof text - (size_t)used, ", style: paper, size: [%d mm, %d mm], dpi: 381}\n", width, height);
    }
    drawn_run(text, &drawn);
    assert_int_equal(drawn.pages, PAGES);
    page_laws_inside(&drawn, width * 72 / 25.4, height * 72 / 25.4);
}

static void any_page_keeps_the_laws(void **)
{
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        draw_pages(runs[i], LEAST_WIDTH + (int)any(80), LEAST_HEIGHT + (int)any(80));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_page_keeps_the_laws)};
    return cmocka_run_group_tests_name("any pages", tests, make_directory, remove_directory);
}
