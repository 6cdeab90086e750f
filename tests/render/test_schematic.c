/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schematic drawings: geometry and scale at known pixels, words that never cover each other, and nothing computed for them. */
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
#include "tests/scenes.h"

/* ---- drawings of many scenes ---- */

struct staged {
    struct bead_scene *scene;
    struct bead_chain *chains[64];
    struct bead_run_context context;
};

static struct staged *set_stage(const char *text)
{
    struct bead_message msg = {""};
    struct staged *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->scene = parse(text);
    for (size_t i = 0; i < s->scene->chain_count; i++) {
        if (bead_chain_create(s->scene, i, &s->chains[i], &msg))
            fail_msg("%s", msg.text);
    }
    s->context = (struct bead_run_context){.scene = s->scene,
                                           .chains = (const struct bead_chain *const *)s->chains,
                                           .chain_count = s->scene->chain_count,
                                           .directory = "."};
    return s;
}

static void clear_stage(struct staged *s)
{
    for (size_t i = 0; i < s->scene->chain_count; i++)
        bead_chain_destroy(s->chains[i]);
    bead_scene_free(s->scene);
    free(s);
}

struct seen {
    struct {
        double x, y, width, height;
        char text[300];
    } box[512];
    size_t count;
};

static void see(void *context, const char *markup, double x, double y, double width, double height)
{
    struct seen *seen = context;
    assert_true(seen->count < 512);
    seen->box[seen->count].x = x;
    seen->box[seen->count].y = y;
    seen->box[seen->count].width = width;
    seen->box[seen->count].height = height;
    snprintf(seen->box[seen->count++].text, 300, "%s", markup);
}

/* The ink of all words, as drawn: none over another, none cut off. */
static void assert_legible(const struct seen *seen, double width, double height, const char *scene)
{
    for (size_t i = 0; i < seen->count; i++) {
        double x = seen->box[i].x, y = seen->box[i].y, right = x + seen->box[i].width, bottom = y + seen->box[i].height;
        if (x < 0 || y < 0 || right > width || bottom > height)
            fail_msg("'%s' is cut off in %s", seen->box[i].text, scene);
        for (size_t j = 0; j < i; j++) {
            if (x < seen->box[j].x + seen->box[j].width && seen->box[j].x < right && y < seen->box[j].y + seen->box[j].height &&
                seen->box[j].y < bottom)
                fail_msg("'%s' lies over '%s' in %s", seen->box[i].text, seen->box[j].text, scene);
        }
    }
}

/* Draw output `index` of the scene; what was written is in `seen`. */
static enum bead_error draw(const struct staged *s, size_t index, struct seen *seen, cairo_surface_t **kept)
{
    const struct bead_output *output = &s->scene->outputs[index];
    struct bead_message msg = {""};
    struct bead_page page;
    struct bead_look look;
    assert_int_equal(bead_page_find(output, "test", &page, &msg), BEAD_OK);
    bead_page_look(&page, &output->paper, &look);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, page.width, page.height);
    struct bead_text_watch watch = {see, seen};
    seen->count = 0;
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    struct bead_sketch sketch = {.cr = cr, .look = &look};
    enum bead_error err = bead_schematic_draw(output, &s->context, &sketch, page.width, page.height, &msg);
    if (err)
        assert_non_null(strstr(msg.text, "leave no room"));
    else
        assert_legible(seen, page.width, page.height, s->scene->text);
    assert_int_equal(cairo_status(cr), CAIRO_STATUS_SUCCESS);
    bead_sketch_free(&sketch);
    cairo_destroy(cr);
    cairo_surface_flush(surface);
    if (kept)
        *kept = surface;
    else
        cairo_surface_destroy(surface);
    return err;
}

static bool wrote(const struct seen *seen, const char *text)
{
    for (size_t i = 0; i < seen->count; i++) {
        if (strstr(seen->box[i].text, text))
            return true;
    }
    return false;
}

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

/* Many entries and many chains: what is left out is said. */
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

/* A tapered chain is one row of beads and one entry of the legend; of many other materials some are named. One M is said. */
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
        assert_non_null(strstr(msg.text, "test:2:11: size: 90 x 60 pixels leave no room"));
        clear_stage(s);
    }
}

/* ---- geometry at known pixels ---- */

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
        close_to((grey.count + 2) / scale, d1 + d2, 6 / scale); /* but for the chord, which is not grey */
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
    assert_null(strstr(svg, "<image")); /* nothing but paths and glyphs */
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
        cmocka_unit_test(setups_of_all_lengths),
        cmocka_unit_test(the_experiment_is_all_there),
        cmocka_unit_test(what_is_left_out_is_said),
        cmocka_unit_test(long_cells),
        cmocka_unit_test(too_small_is_an_error),
        cmocka_unit_test(contact_is_to_scale),
        cmocka_unit_test(cells_are_to_scale),
        cmocka_unit_test(setup_shows_the_beads),
        cmocka_unit_test(nothing_is_computed),
        cmocka_unit_test(text_is_text),
    };
    return cmocka_run_group_tests_name("schematic", tests, make_directory, remove_directory);
}
