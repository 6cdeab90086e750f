/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schematic drawings: all required words are there and never cover each other, and nothing is computed for them. */
#include "pictures.h"

/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */
#include <cairo-pdf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/schematic/schematic.h"
#include "sessions.h"
#include "tests/missing.h"
#include "tests/schematics.h"

#define EXPERIMENT                                                                                                             \
    "chain: {beads: [{cell: [large-steel, aluminium], spins: up}, {cell: [large-steel, aluminium], count: 18, spins: random, " \
    "magnetism: 0.2, seed: 7}, {bead: small-steel, sensor: first}, {cell: [large-steel, aluminium], count: 4}, {bead: "        \
    "small-steel, sensor: second}, {cell: [large-steel, aluminium], count: 10}], wall: brass, tilt: 3.5 deg}\n"
#define SIZES                                                                                                            \
    "outputs: [{plot: a.png, show: setup}, {plot: b.png, show: setup, style: slide}, {plot: c.pdf, show: setup, style: " \
    "paper, dpi: 150}, {plot: d.png, show: setup, size: [640, 480]}, {plot: e.png, show: setup, size: [1000, 1000]}, "   \
    "{plot: f.pdf, show: setup, size: [178 mm, 50 mm], dpi: 100}, {plot: g.png, show: contact}, {plot: h.pdf, show: "    \
    "contact, style: paper, dpi: 150}, {plot: i.png, show: contact, compression: 0.01}, {plot: j.png, show: contact, "   \
    "contact: 0, compression: 0.6}]\n"

static void setups_of_all_lengths(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "chain: {beads: [{bead: large-steel, count: 5}]}\n",
        "chain: {beads: [{bead: large-steel, count: 5}], wall: rigid, tilt: 44 deg}\n",
        "chain: {beads: [{bead: ptfe}], wall: brass}\n",
        "chain: {beads: [{bead: large-steel, count: 5000}], striker: {bead: small-steel, velocity: 1 m/s}}\n",
        "chain: {beads: [{cell: [small-steel, large-steel, ptfe], count: 1600, spins: random, seed: 1}, {bead: glass, sensor: a}, "
        "{bead: glass, sensor: the one with a rather long name}, {bead: glass, sensor: c}, {bead: lead, count: 190}], "
        "precompression: 10 N, wall: brass}\n",
        EXPERIMENT,
        "materials: {huge: {mass: 1 kg, radius: 30 mm, modulus: 1 GPa, poisson: 0}}\n"
        "chains:\n  - {name: a, beads: [{bead: huge, count: 3}, {bead: small-steel, count: 50}], wall: rigid}\n"
        "  - {name: the second, beads: [{cell: [glass, huge], count: 9}], tilt: 2 deg, wall: huge}\n"
        "  - {name: \"c & <d>\", beads: [{bead: small-steel, sensor: x}, {bead: huge, sensor: y}]}\n",
    };
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char text[4096];
        struct seen seen = {.count = 0};
        snprintf(text, sizeof text, "%s%s", chains[i], SIZES);
        struct staged *s = set_stage(text);
        for (size_t o = 0; o < s->scene->output_count; o++) {
            if (draw(s, o, &seen, NULL))
                fail_msg("no room for %s in %s", s->scene->outputs[o].path, chains[i]);
            if (s->scene->outputs[o].curves.show == BEAD_SHOW_SETUP)
                assert_true(wrote(&seen, "striker"));
        }
        clear_stage(s);
    }
}

/* The longest name of a sensor, of letters that take five bytes each in markup, ends where there is no more room for it. */
static void sensors_have_names_of_any_length(void **state)
{
    (void)state;
    char name[241] = "", text[600];
    struct seen seen = {.count = 0};
    memset(name, '&', sizeof name - 1);
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: glass, count: 9}, {bead: lead, sensor: '%s'}]}\noutputs: [{plot: a.png, show: setup}]\n",
             name);
    struct staged *s = set_stage(text);
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "sensor &amp;&amp;"));
    clear_stage(s);
}

/* The spaces above, between and below rows share the remaining room evenly, a third each of a page's extra height. */
static void rows_share_what_is_left(void **state)
{
    (void)state;
    struct staged *s =
        set_stage("chains:\n  - {name: a, beads: [{bead: large-steel, count: 30}]}\n"
                  "  - {name: b, beads: [{bead: large-steel, count: 30}]}\n"
                  "outputs: [{plot: a.png, show: setup, size: [1000, 900]}, {plot: b.png, show: setup, size: [1000, 1200]}]\n");
    double striker[2][2];
    for (size_t o = 0; o < 2; o++) {
        struct seen seen = {.count = 0};
        size_t found = 0;
        assert_int_equal(draw(s, o, &seen, NULL), BEAD_OK);
        for (size_t i = 0; i < seen.count; i++) {
            if (strncmp(seen.box[i].text, "striker", strlen("striker")) == 0 && found < 2)
                striker[o][found++] = seen.box[i].y;
        }
        assert_true(found == 2 && striker[o][0] < striker[o][1]);
    }
    assert_true(fabs(striker[1][0] - striker[0][0] - 100) < 2);
    assert_true(fabs(striker[1][1] - striker[0][1] - 200) < 2);
    clear_stage(s);
}

static void the_experiment_is_all_there(void **state)
{
    (void)state;
    static const char *const words[] = {"striker, 0.443 m/s", "sensor first", "sensor second", "1 dimer",   "18 dimers", "random",
                                        "4 dimers",           "10 dimers",    "brass wall",    "tilt 3.5°", "68 beads",  "up"};
    struct seen seen = {.count = 0};
    struct staged *s = set_stage(EXPERIMENT SIZES);
    for (size_t o = 0; o < 3; o++) { /* screen, slide and the column of a journal */
        assert_int_equal(draw(s, o, &seen, NULL), BEAD_OK);
        for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
            if (!wrote(&seen, words[i]))
                fail_msg("'%s' is not in %s", words[i], s->scene->outputs[o].path);
        }
    }
    clear_stage(s);
}

static void ends_that_absorb_are_no_free_ends(void **state)
{
    (void)state;
    struct seen seen = {.count = 0};
    struct staged *s =
        set_stage("chain: {beads: [{bead: brass, count: 9}], precompression: 5 N, wall: absorbing}\noutputs: [{plot: "
                  "a.png, show: setup}]\n");
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "absorbing end") && wrote(&seen, "precompressed by 5.00"));
    clear_stage(s);
}

/* Whatever moves besides the striker, and gaps that are too small to be seen, are in the line above. */
static void what_moves_is_said(void **state)
{
    (void)state;
    static const struct {
        const char *keys, *said[2];
    } cases[] = {
        {"drive: {bead: 6, displacement: sine, amplitude: 1 um, frequency: 8 kHz}",
         {"striker at rest", "bead 6 driven at 8.00\u00a0kHz"}},
        {"gap: 3 um, start: [{bead: last, velocity: -2 m/s}]", {"gaps of 3.00\u00a0µm", "bead 9 starts with \u22122.00\u00a0m/s"}},
        {"striker: {velocity: 1 m/s}, start: [{bead: 4, displacement: 2 um}]", {"striker, 1 m/s", "bead 4 starts at 2.00\u00a0µm"}},
        {"start: [{bead: [0, 3], velocity: 1 m/s}]", {"striker, 1 m/s", "3 beads that do not start at rest"}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct seen seen = {.count = 0};
        char text[400];
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: brass, count: 9}], %s}\nsimulate: {until: 1 ms}\noutputs: [{plot: a.png, "
                 "show: setup}]\n",
                 cases[i].keys);
        struct staged *s = set_stage(text);
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        for (size_t k = 0; k < 2; k++) {
            if (!wrote(&seen, cases[i].said[k]))
                fail_msg("'%s' is not said of %s", cases[i].said[k], cases[i].keys);
        }
        clear_stage(s);
    }
}

/* Many entries and many chains: a line names those left out. */
static void what_is_left_out_is_said(void **state)
{
    (void)state;
    static char text[200000];
    struct seen seen = {.count = 0};
    size_t used = (size_t)snprintf(text, sizeof text, "chain:\n  beads:\n");
    for (int i = 0; i < 2500; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - {bead: %s}\n  - {bead: ptfe, sensor: s%d}\n",
                                 i % 2 ? "glass" : "lead", i);
    snprintf(text + used, sizeof text - used, "outputs: [{plot: a.png, show: setup}]\n");
    struct staged *s = set_stage(text);
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "more entries") && wrote(&seen, "5000 beads") && wrote(&seen, "sensor s0") && wrote(&seen, "s2499"));
    clear_stage(s);

    used = (size_t)snprintf(text, sizeof text, "chains:\n");
    for (int i = 0; i < 64; i++)
        used +=
            (size_t)snprintf(text + used, sizeof text - used, "- {name: c%d, beads: [{bead: glass, count: %d}]}\n", i, 1 + 7 * i);
    snprintf(text + used, sizeof text - used, "outputs: [{plot: a.png, show: setup}]\n");
    s = set_stage(text);
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "c0") && wrote(&seen, "more chains"));
    clear_stage(s);
}

/* A tapered chain is one row of beads and one entry of the legend; of many other materials some are named. M is given if there is
 * one. */
static void tapered_chains_are_one_row(void **state)
{
    (void)state;
    char text[8192] = "materials:\n";
    size_t used = strlen(text);
    for (int i = 0; i < 20; i++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "  s%d: {density: 8027 kg/m3, radius: %.3f mm, modulus: 193 GPa, poisson: 0.3}\n", i, 5 - 0.2 * i);
    used += (size_t)snprintf(text + used, sizeof text - used, "chain:\n  beads:\n");
    for (int i = 0; i < 20; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - {bead: s%d}\n", i);
    snprintf(text + used, sizeof text - used, "outputs: [{plot: a.png, show: setup}]\n");
    struct staged *s = set_stage(text);
    struct seen seen = {.count = 0};
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "20 beads") && wrote(&seen, "s0 to s19") && wrote(&seen, "5.00\u00a0mm to 1.20\u00a0mm"));
    assert_false(wrote(&seen, "1 bead ") || wrote(&seen, "s7") || wrote(&seen, "more"));
    clear_stage(s);

    used = (size_t)snprintf(text, sizeof text, "materials:\n");
    for (int i = 0; i < 20; i++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "  s%d: {density: 8027 kg/m3, radius: 5 mm, modulus: %d GPa, poisson: 0.3}\n", i, 10 + 10 * i);
    used += (size_t)snprintf(text + used, sizeof text - used, "chain:\n  beads:\n");
    for (int i = 0; i < 20; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - {bead: s%d, count: 2}\n", i);
    snprintf(text + used, sizeof text - used, "outputs: [{plot: a.png, show: setup}]\n");
    s = set_stage(text);
    seen.count = 0;
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "40 beads") && wrote(&seen, "s5") && wrote(&seen, "and 13 more"));
    clear_stage(s);

    s = set_stage("chain:\n  beads: [{cell: [glass, ptfe], count: 9, spins: random, magnetism: 0.2}]\n"
                  "outputs: [{plot: a.png, show: setup}]\n");
    seen.count = 0;
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "random") && wrote(&seen, "0.111"));
    assert_false(wrote(&seen, "0.2"));
    clear_stage(s);
}

/* Beads of one material, but of different sizes, are one entry with the largest and the smallest of all chains, whichever they are;
 * the striker has its own. */
static void sizes_have_their_ends(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "chain: {beads: [{bead: large-steel, count: 9, taper: {from: 4.76 mm, to: 1.8 mm}}]}\n",
        "chain: {beads: [{bead: large-steel, count: 9, taper: {from: 1.8 mm, to: 4.76 mm}}]}\n",
        "chain: {striker: {bead: large-steel, radius: 9 mm, velocity: 1 m/s}, beads: [{bead: large-steel, radius: 3 mm}, {bead: "
        "large-steel, count: 5, radius: 4 mm}, {bead: large-steel, radius: 2 mm}]}\n",
        "chains:\n  - {name: a, beads: [{bead: large-steel, count: 5, radius: 4 mm}]}\n"
        "  - {name: b, beads: [{bead: large-steel, radius: 3 mm}, {bead: large-steel, radius: 6 mm}]}\n"};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char text[700], words[200], radius[2][32], mass[2][32];
        double ends[2][2] = {{0, 0}, {INFINITY, 0}};
        struct seen seen = {.count = 0};
        snprintf(text, sizeof text, "%soutputs: [{plot: a.png, show: setup}]\n", chains[i]);
        struct staged *s = set_stage(text);
        for (size_t c = 0; c < s->scene->chain_count; c++) {
            for (size_t j = 1; j < bead_chain_beads(s->chains[c]); j++) {
                const double r = bead_chain_radius(s->chains[c])[j], m = bead_chain_mass(s->chains[c])[j];
                if (r > ends[0][0])
                    ends[0][0] = r, ends[0][1] = m;
                if (r < ends[1][0])
                    ends[1][0] = r, ends[1][1] = m;
            }
        }
        for (int k = 0; k < 2; k++) {
            bead_quantity(ends[k][0], "m", 3, radius[k], sizeof radius[k]);
            bead_quantity(1e3 * ends[k][1], "g", 3, mass[k], sizeof mass[k]);
        }
        assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
        snprintf(words, sizeof words, "%s to %s, %s to %s", radius[0], radius[1], mass[0], mass[1]);
        if (!wrote(&seen, words))
            fail_msg("%s: nothing says '%s'", chains[i], words);
        clear_stage(s);
    }
}

/* N1 : N2 cells of many beads, and one of too many groups for a brace each. */
static void long_cells(void **state)
{
    (void)state;
    char text[2048] = "chain: {beads: [{count: 3, spins: up, cell: [glass";
    struct seen seen = {.count = 0};
    for (int i = 1; i < 70; i++)
        strcat(text, i < 40 ? ", glass" : ", ptfe");
    strcat(text, "]}, {cell: [glass, ptfe");
    for (int i = 1; i < 15; i++)
        strcat(text, ", glass, ptfe");
    strcat(text, "]}]}\noutputs: [{plot: a.png, show: cell}]\n");
    struct staged *s = set_stage(text);
    assert_int_equal(draw(s, 0, &seen, NULL), BEAD_OK);
    assert_true(wrote(&seen, "40 : 30") && wrote(&seen, "= 40") && wrote(&seen, "= 30") && wrote(&seen, "cell of 30 beads"));
    clear_stage(s);
}

static void too_small_is_an_error(void **state)
{
    (void)state;
    static const char *const shows[] = {"setup", "contact", "cell"};
    for (size_t i = 0; i < 3; i++) {
        char text[1024];
        struct bead_message msg = {""};
        snprintf(text, sizeof text, "%soutputs: [{plot: a.png, show: %s, size: [90, 60]}]\n", EXPERIMENT, shows[i]);
        struct staged *s = set_stage(text);
        assert_int_equal(bead_schematic_check(&s->scene->outputs[0], &s->context, &msg), BEAD_ERROR_SCENE);
        char place[32]; /* that of its value, on the last line */
        snprintf(place, sizeof place, "test:2:%zu: ", (size_t)(strstr(text, "[90") - strstr(text, "outputs")) + 1);
        assert_ptr_equal(strstr(msg.text, place), msg.text);
        assert_non_null(strstr(msg.text, ": size: 90 x 60 pixels leave no room"));
        clear_stage(s);
    }
}

/* ---- files ---- */

static struct bead_counts play(const char *scene)
{
    char path[512], folder[512];
    in_directory("scene.yaml", path, sizeof path);
    in_directory("", folder, sizeof folder);
    write_text(path, scene);
    return play_counts((struct bead_job){.input = path, .output = folder});
}

static void nothing_is_computed(void **state)
{
    (void)state;
    struct bead_counts counts =
        play(EXPERIMENT "outputs: [{plot: s.png, show: setup, size: [640, 400]}, {plot: c.pdf, show: cell}, "
                        "{plot: c.svg, show: contact}]\n");
    assert_int_equal(counts.steps, 0);
    assert_int_equal(counts.samples, 0);
    char path[512];
    in_directory("s.png", path, sizeof path);
    struct png_file png = read_png(path);
    assert_true(png.width == 640 && png.height == 400);
    free(png.rgb);
    size_t length;
    in_directory("c.svg", path, sizeof path);
    char *svg = read_all(path, &length);
    assert_null(strstr(svg, "<image")); /* only paths and glyphs */
    free(svg);
    assert_no_part_files();
}

/* Words in PDF files are words. */
static void text_is_text(void **state)
{
    (void)state;
    char path[512], command[1200], text[512];
    if (!has_program("pdftotext"))
        skip_without("pdftotext (poppler-utils)");
    play(EXPERIMENT "outputs: [{plot: t.pdf, show: setup, style: paper}]\n");
    in_directory("t.pdf", path, sizeof path);
    in_directory("t.txt", text, sizeof text);
    snprintf(command, sizeof command, "pdftotext '%s' '%s'", path, text);
    assert_int_equal(system(command), 0);
    size_t length;
    char *words = read_all(text, &length);
    assert_true(strstr(words, "18 dimers") && strstr(words, "brass wall") && strstr(words, "sensor first"));
    free(words);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tapered_chains_are_one_row),
        cmocka_unit_test(sizes_have_their_ends),
        cmocka_unit_test(setups_of_all_lengths),
        cmocka_unit_test(rows_share_what_is_left),
        cmocka_unit_test(sensors_have_names_of_any_length),
        cmocka_unit_test(the_experiment_is_all_there),
        cmocka_unit_test(ends_that_absorb_are_no_free_ends),
        cmocka_unit_test(what_moves_is_said),
        cmocka_unit_test(what_is_left_out_is_said),
        cmocka_unit_test(long_cells),
        cmocka_unit_test(too_small_is_an_error),
        cmocka_unit_test(nothing_is_computed),
        cmocka_unit_test(text_is_text),
    };
    return cmocka_run_group_tests_name("schematic", tests, make_directory, remove_directory);
}
