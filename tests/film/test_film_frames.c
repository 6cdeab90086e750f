/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of films in every layout, shape, theme and size of type, with one to four chains: no word is cut off, shortened or covered
 * by another, and everything a viewer needs is there. SHOW=DIRECTORY keeps the frames as pictures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/picture.h"
#include "render/movie/composer_private.h"
#include "tests/texts.h"

static void assert_legible(const struct texts *seen, const int size[2], const char *what)
{
    for (size_t i = 0; i < seen->count; i++) {
        double x = seen->text[i].x, y = seen->text[i].y, right = x + seen->text[i].width, bottom = y + seen->text[i].height;
        if (x < 0 || y < 0 || right > size[0] || bottom > size[1])
            fail_msg("%s: '%s' is cut off", what, seen->text[i].markup);
        if (strstr(seen->text[i].markup, "\u2026"))
            fail_msg("%s: '%s' is shortened", what, seen->text[i].markup);
        for (size_t j = 0; j < i; j++) {
            if (x < seen->text[j].x + seen->text[j].width && seen->text[j].x < right &&
                y < seen->text[j].y + seen->text[j].height && seen->text[j].y < bottom)
                fail_msg("%s: '%s' lies over '%s'", what, seen->text[i].markup, seen->text[j].markup);
        }
    }
}

static bool is_number(const char *markup)
{
    return markup[strspn(markup, "0123456789")] == '\0';
}

/* Numbers of neighbouring axes are not read as one. */
static void assert_numbers_part(const struct texts *seen, const char *what)
{
    for (size_t i = 0; i < seen->count; i++) {
        for (size_t j = 0; j < seen->count; j++) {
            const double gap = seen->text[j].x - seen->text[i].x - seen->text[i].width;
            if (is_number(seen->text[i].markup) && is_number(seen->text[j].markup) &&
                fabs(seen->text[i].y - seen->text[j].y) < 0.5 * seen->text[i].height && gap > 0 && gap < 0.5 * seen->text[i].height)
                fail_msg("%s: '%s' is too close to '%s'", what, seen->text[i].markup, seen->text[j].markup);
        }
    }
}

static size_t times_written(const struct texts *seen, const char *text)
{
    size_t times = 0;
    for (size_t i = 0; i < seen->count; i++)
        times += strstr(seen->text[i].markup, text) != NULL;
    return times;
}

static bool wrote(const struct texts *seen, const char *text)
{
    return times_written(seen, text) > 0;
}

static const char *const layouts[] = {"auto", "stacked", "columns", "grid", "overlay", "beside", "images"};
enum { LAYOUTS = sizeof layouts / sizeof *layouts };

struct wish {
    int size[2];
    size_t chains;
    unsigned layout;
    bool light, large, caption, follow, right, inset; /* right: where time runs */
};

static void describe(const struct wish *w, char *text, size_t size)
{
    static const char *const chains[] = {
        "  - {name: Clean, label: every dimer the same way round, striker: {bead: large-steel, velocity: 0.443 m/s}, wall: brass,"
        " beads: [{cell: [large-steel, aluminium], count: 32, spins: up}]}\n",
        "  - {name: Delocalised, label: half of the dimers reversed at random, striker: {bead: large-steel, velocity: 0.443 m/s},"
        " wall: brass, beads: [{cell: [large-steel, aluminium], count: 32, spins: random, magnetism: 0, seed: 2}]}\n",
        "  - {name: Steel, striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 64}]}\n",
        "  - {name: Glass, striker: {bead: large-steel, velocity: 0.443 m/s}, wall: rigid, beads: [{bead: glass, count: 64}]}\n"};
    int used = snprintf(text, size, "title: A story in a frame\nsimulate: {until: 1.2 ms}\nchains:\n");
    for (size_t i = 0; i < w->chains; i++)
        used += snprintf(text + used, size - (size_t)used, "%s", chains[i]);
    snprintf(text + used, size - (size_t)used,
             "outputs: [{movie: m.mp4, size: [%d, %d], layout: %s, theme: %s, type: %s, range: [0, 45 N]%s%s%s%s}]\n", w->size[0],
             w->size[1], layouts[w->layout], w->light ? "light" : "dark", w->large ? "large" : "normal",
             w->caption ? ", captions: [{at: 0, text: The striker squeezes the first contacts}]" : "",
             w->follow ? ", follow: front" : "", w->right ? ", orientation: time-right" : "", w->inset ? ", inset: cell" : "");
}

enum { MANY = 12 }; /* chains */

struct stage {
    struct bead_scene *scene;
    struct bead_chain *chains[MANY];
    struct bead_composer *composer;
    struct texts seen;
    struct bead_text_watch watch;
};

static enum bead_error create_stage(struct stage *s, const char *text, const int size[2], struct bead_message *msg)
{
    if (bead_scene_parse("test", text, strlen(text), NULL, &s->scene, msg))
        fail_msg("%s\n%s", msg->text, text);
    for (size_t i = 0; i < s->scene->chain_count; i++)
        assert_int_equal(bead_chain_create(s->scene, i, &s->chains[i], msg), BEAD_OK);
    s->watch = (struct bead_text_watch){texts_note, &s->seen};
    s->seen.count = 0;
    struct bead_composer_setup setup = {.output = &s->scene->outputs[0],
                                        .chains = (const struct bead_chain *const *)s->chains,
                                        .chain_count = s->scene->chain_count,
                                        .title = s->scene->title,
                                        .width = size[0],
                                        .height = size[1],
                                        .time = {0, 1.2e-3},
                                        .step = 2e-6,
                                        .range = {0, 45, .over = true},
                                        .scene = s->scene,
                                        .canvas = "plain",
                                        .tolerance_factor = 1,
                                        .interest = true,
                                        .watch = &s->watch};
    return bead_composer_create(&setup, &s->composer, msg);
}

static void open_stage(struct stage *s, const char *text, const int size[2])
{
    struct bead_message msg = {""};
    struct bead_changes changes = {0};
    if (create_stage(s, text, size, &msg) || bead_composer_open(s->composer, &msg) ||
        bead_composer_draw(s->composer, 1e-3, &changes, &msg))
        fail_msg("%s\n%s", msg.text, text);
}

static void close_stage(struct stage *s)
{
    if (s->composer)
        bead_composer_close(s->composer);
    bead_composer_destroy(s->composer);
    for (size_t i = 0; i < s->scene->chain_count; i++)
        bead_chain_destroy(s->chains[i]);
    bead_scene_free(s->scene);
}

static void show(const struct stage *s, const char *what)
{
    const struct bead_picture_notes notes = {.size = sizeof notes, .title = what};
    char path[300];
    uint64_t bytes;
    if (!getenv("SHOW"))
        return;
    snprintf(path, sizeof path, "%s/%s.png", getenv("SHOW"), what);
    assert_int_equal(bead_png_write(path, bead_composer_frame(s->composer), &notes, &bytes, NULL), BEAD_OK);
}

static double image_share(const struct stage *s)
{
    const struct bead_movie_layout *layout = &s->composer->layout;
    const struct bead_movie_wants *w = &s->composer->wants;
    double area = 0;
    for (size_t i = 0; i < layout->chain_count * w->view_count; i++) {
        const struct bead_rect *plot = &layout->chains[i / w->view_count].plot[i % w->view_count];
        if (bead_view_has(w->views[i % w->view_count], BEAD_SHOWS_IMAGE))
            area += (double)plot->width * plot->height;
    }
    return area / ((double)w->width * w->height);
}

/* Things a viewer cannot do without: title, exaggeration, names and units of axes, names of chains and M. */
static void check_words(const struct stage *s, const struct wish *w, const char *what)
{
    const char *words[] = {"A story in a frame", "displacements", "force (N)", "bead", "Clean", "Delocalised", "Steel", "Glass"};
    const bool curve = s->composer->layout.chains[0].plot[1].width > 0;
    if (!curve && !(w->caption && w->large))
        fail_msg("%s: there is no curve", what);
    for (size_t i = 0; i < 4 + w->chains; i++) {
        if (!wrote(&s->seen, words[i]) && (curve || (i != 2 && i != 3)))
            fail_msg("%s: nothing says '%s'", what, words[i]);
    }
    const bool full = w->size[1] > w->size[0] && w->large && w->chains + w->caption > 3; /* the key gives way to the curve */
    if (times_written(&s->seen, "light: contact force") + times_written(&s->seen, "light 0") != !full ||
        (!full && !wrote(&s->seen, "aluminium")))
        fail_msg("%s: there is not one scale of the light, or no material", what);
    size_t magnetisms = 0;
    for (size_t i = 0; i < s->seen.count; i++)
        magnetisms += strstr(s->seen.text[i].markup, "M</") != NULL;
    if (magnetisms != (w->chains < 2 ? w->chains : 2))
        fail_msg("%s: M is said %zu times", what, magnetisms);
    if (image_share(s) > 0 && !wrote(&s->seen, "time (ms)"))
        fail_msg("%s: nothing says what the axis of time is", what);
    for (size_t i = 0; i < w->chains && w->chains > 1 && image_share(s) > 0; i++) {
        if (times_written(&s->seen, words[4 + i]) != 2)
            fail_msg("%s: '%s' is not at its stage and at its image", what, words[4 + i]);
    }
}

static void check(const struct wish *w)
{
    static struct stage s;
    char text[4096], what[120];
    snprintf(what, sizeof what, "%dx%d-%s-%zu%s%s%s%s%s", w->size[0], w->size[1], layouts[w->layout], w->chains,
             w->light ? "-light" : "", w->large ? "-large" : "", w->caption ? "-caption" : "", w->follow ? "-follow" : "",
             w->right ? "-right" : "");
    describe(w, text, sizeof text);
    open_stage(&s, text, w->size);
    show(&s, what);
    assert_legible(&s.seen, w->size, what);
    if (image_share(&s) > (w->layout == 0 ? 0.26 : 0.7))
        fail_msg("%s: images have %.1f %%", what, 100 * image_share(&s));
    const char *always[] = {"ms</span>", "times", "A story in a frame", "displacements", "bead",
                            "force (N)", "Clean", "Delocalised",        "Steel",         "Glass"};
    for (size_t i = 0; i < 6 + w->chains; i++) {
        if (!wrote(&s.seen, always[i]) && (w->layout > 0 || i < 2))
            fail_msg("%s: nothing says '%s'", what, always[i]);
    }
    if (w->layout > 0 && s.composer->layout.lacks)
        fail_msg("%s: there is no scale of colours, or another word is missing", what);
    if (w->layout == 0)
        check_words(&s, w, what);
    close_stage(&s);
}

static void test_every_frame(void **state)
{
    (void)state;
    static const int shapes[4][2] = {{1280, 720}, {960, 720}, {720, 720}, {720, 1280}};
    for (unsigned i = 0; i < 4 * LAYOUTS * 4 * 2; i++) {
        struct wish w = {.chains = 1 + i / (4 * LAYOUTS) % 4, .layout = i / 4 % LAYOUTS, .light = i / (16 * LAYOUTS)};
        /* Every layout, shape and number of chains has both. */
        w.caption = (i + w.layout + w.chains + w.light) % 2;
        w.right = (i / 2 + w.layout + w.light) % 2;
        w.size[0] = shapes[i % 4][0];
        w.size[1] = shapes[i % 4][1];
        w.large = w.light; /* light parts have the places of dark ones */
        check(&w);
    }
}

/* Words never give way to many chains: images do, then type does, and a layout that has no room for words is refused. */
static void test_many_chains(void **state)
{
    (void)state;
    static struct stage s;
    static const int shapes[][2] = {{1280, 720}, {720, 720}, {1080, 1920}, {390, 844}};
    size_t refused = 0;
    for (unsigned i = 0; i < 4 * LAYOUTS; i++) {
        const unsigned chains = MANY - i % 2 * 4, layout = i / 4 % LAYOUTS;
        char text[4096] = "title: A story in a frame\nchains:\n", what[120], name[20];
        for (unsigned k = 0; k < chains; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "  - {name: Dimers %c, beads: [{cell: [large-steel, aluminium], count: 20, spins: random, seed: %u}]}\n",
                     'A' + k, k);
        snprintf(text + strlen(text), sizeof text - strlen(text), "outputs: [{movie: m.mp4, size: [%d, %d], layout: %s}]\n",
                 shapes[i % 4][0], shapes[i % 4][1], layouts[layout]);
        snprintf(what, sizeof what, "%dx%d-%s-%u", shapes[i % 4][0], shapes[i % 4][1], layouts[layout], chains);
        struct bead_message msg = {""};
        if (create_stage(&s, text, shapes[i % 4], &msg)) {
            assert_true(layout > 0 && strstr(msg.text, "test:") && strstr(msg.text, "layout: "));
            refused++;
        } else {
            assert_int_equal(bead_composer_open(s.composer, &msg), BEAD_OK);
            show(&s, what);
            assert_legible(&s.seen, shapes[i % 4], what);
            for (unsigned k = 0; k < chains; k++) {
                snprintf(name, sizeof name, "Dimers %c", 'A' + k);
                if (!wrote(&s.seen, name))
                    fail_msg("%s: nothing says '%s'", what, name);
            }
            if (times_written(&s.seen, "M</") != chains || !wrote(&s.seen, "bead") || !wrote(&s.seen, "force (N)") ||
                !wrote(&s.seen, "A story") || !wrote(&s.seen, "displacements"))
                fail_msg("%s: a word is missing", what);
        }
        close_stage(&s);
    }
    assert_in_range(refused, 1, 12); /* eight columns or twelve rows, or more, in small frames */
}

static void test_windows_that_move(void **state)
{
    (void)state;
    static const int shapes[4][2] = {{1280, 720}, {960, 720}, {720, 720}, {720, 1280}};
    for (unsigned i = 0; i < 4 * 4; i++) {
        struct wish w = {.chains = 1 + i / 4, .follow = true, .size = {shapes[i % 4][0], shapes[i % 4][1]}};
        check(&w);
        w.right = true;
        check(&w);
    }
}

/* The drawing of the cell is in the picture once, whole, in the room beside the curve, and hides nothing. */
static void test_cells_in_the_picture(void **state)
{
    (void)state;
    static const int shapes[3][2] = {{1280, 720}, {960, 720}, {720, 720}};
    for (unsigned i = 0; i < 3 * 4 * 2; i++) {
        static struct stage s;
        char text[4096], what[64];
        struct wish w = {.chains = 1 + i / 3 % 4, .inset = true, .light = i / 12, .size = {shapes[i % 3][0], shapes[i % 3][1]}};
        check(&w);
        describe(&w, text, sizeof text);
        open_stage(&s, text, w.size);
        snprintf(what, sizeof what, "%d x %d, %zu chains", w.size[0], w.size[1], w.chains);
        const struct bead_rect at = s.composer->layout.inset;
        size_t inside = 0;
        for (size_t t = 0; t < s.seen.count; t++) {
            const double x = s.seen.text[t].x, y = s.seen.text[t].y;
            const bool in = x >= at.x && y >= at.y && x + s.seen.text[t].width <= at.x + at.width &&
                            y + s.seen.text[t].height <= at.y + at.height;
            inside += in && (strstr(s.seen.text[t].markup, "N</i>") || strstr(s.seen.text[t].markup, "cell of 2 beads"));
        }
        if (inside != 3)
            fail_msg("%s: %zu of the cell's three words are in its place", what, inside);
        close_stage(&s);
    }
}

/* If a bar does not fit beside the images, the axis of the curve has their colours: each number is at the colour of its force. */
static void test_colours_have_a_scale(void **state)
{
    (void)state;
    static const int shapes[][2] = {{1280, 720}, {1920, 1080}, {1024, 768}, {960, 720}, {720, 720}, {720, 1280}, {390, 844}};
    size_t bars = 0, axes = 0;
    for (unsigned i = 0; i < 7 * 4 * 2 * 2; i++) {
        static struct stage s;
        char text[4096], what[80];
        struct wish w = {.chains = 1 + i / 7 % 4, .light = i / 28 % 2, .size = {shapes[i % 7][0], shapes[i % 7][1]}};
        w.inset = i / 56 && w.size[0] > w.size[1] && w.size[0] != 1024;
        describe(&w, text, sizeof text);
        open_stage(&s, text, w.size);
        snprintf(what, sizeof what, "scale-%zu-%dx%d%s%s", w.chains, w.size[0], w.size[1], w.light ? "-light" : "",
                 w.inset ? "-inset" : "");
        show(&s, what);
        const struct bead_movie_layout *layout = &s.composer->layout;
        const struct bead_rect curve = layout->chains[0].plot[1];
        if (image_share(&s) > 0 && (layout->bar.width > 0) == (layout->colours > 0))
            fail_msg("%s: images have %s", what, layout->colours > 0 ? "two scales" : "no scale");
        bars += layout->bar.width > 0;
        size_t numbers = 0;
        for (size_t t = 0; layout->colours > 0 && t < s.seen.count; t++) {
            const double y = s.seen.text[t].y + 0.5 * s.seen.text[t].height;
            if (!is_number(s.seen.text[t].markup) || y <= curve.y + 2 || y > curve.y + curve.height - 2 ||
                s.seen.text[t].x + s.seen.text[t].width > curve.x)
                continue;
            const int index = bead_colours_index(&s.composer->colours, strtod(s.seen.text[t].markup, NULL));
            const struct bead_frame *frame = bead_composer_frame(s.composer);
            const uint8_t *pixel = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)(curve.x - (layout->colours + 1) / 2);
            double nearest = INFINITY; /* a pixel is so much of the range, and the middle of letters is not known better */
            for (int k = index - 10; k <= index + 10; k++) {
                const uint8_t *rgb = s.composer->colours.map->rgb[k < 0 ? 0 : k > 255 ? 255 : k];
                nearest = fmin(nearest, abs(pixel[2] - rgb[0]) + abs(pixel[1] - rgb[1]) + abs(pixel[0] - rgb[2]));
            }
            if (nearest > 3)
                fail_msg("%s: the colour at %s is not that of its force (%g)", what, s.seen.text[t].markup, nearest);
            numbers++;
        }
        assert_true(layout->colours == 0 || numbers > 0);
        axes += layout->colours > 0;
        close_stage(&s);
    }
    assert_true(bars > 0 && axes > 0);
}

/* Rows of coloured beads have a scale, also where images gave way. */
static void test_coloured_beads_have_a_scale(void **state)
{
    (void)state;
    static const int shapes[][2] = {{1280, 720}, {1024, 768}, {1080, 1080}, {1080, 1920}, {390, 844}};
    bool without_images = false;
    for (unsigned i = 0; i < 5 * 3 * 2 * 3; i++) {
        static struct stage s;
        char text[4096], what[80];
        struct wish w = {
            .chains = 1 + i / 5 % 3, .large = i / 15 % 2, .layout = 1 + i / 30, .size = {shapes[i % 5][0], shapes[i % 5][1]}};
        describe(&w, text, sizeof text);
        open_stage(&s, text, w.size);
        snprintf(what, sizeof what, "coloured-%s-%zu-%dx%d%s", layouts[w.layout], w.chains, w.size[0], w.size[1],
                 w.large ? "-large" : "");
        show(&s, what);
        const bool tall = w.chains > 2 && w.size[1] > w.size[0]; /* three columns on a phone have no room for any words */
        if (s.composer->layout.bar.width == 0 && !(tall && strcmp(layouts[w.layout], "columns") == 0))
            fail_msg("%s: no scale", what);
        without_images = without_images || image_share(&s) == 0;
        close_stage(&s);
    }
    assert_true(without_images);
}

/* Properties shared by chains are shown once: materials at the first chain, the scale of the light at the last, and labels have the
 * rest of the room. */
static void test_keys_leave_room_for_labels(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1920, 1080}, {1280, 720}, {1024, 768}, {960, 720}};
    for (unsigned i = 0; i < 4 * 2 * 2; i++) {
        static struct stage s;
        char text[4096], what[80];
        struct wish w = {.chains = 2 + i / 4 % 2, .light = i / 8, .size = {sizes[i % 4][0], sizes[i % 4][1]}};
        describe(&w, text, sizeof text);
        open_stage(&s, text, w.size);
        snprintf(what, sizeof what, "labels-%zu-%dx%d", w.chains, w.size[0], w.size[1]);
        show(&s, what);
        assert_legible(&s.seen, w.size, what);
        static const char *const words[] = {"every dimer the same way round", "half of the dimers reversed", "light: contact force",
                                            "aluminium"};
        for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
            if (times_written(&s.seen, words[k]) != 1)
                fail_msg("%s: '%s' is written %zu times", what, words[k], times_written(&s.seen, words[k]));
        }
        close_stage(&s);
    }
}

/* On small frames names become smaller, but do not touch the key beside them. */
static void test_keys_are_apart_from_headings(void **state)
{
    (void)state;
    size_t beside = 0;
    for (int width = 300; width <= 640; width += 20) {
        static struct stage s;
        const int size[2] = {width, 2 * (width * 9 / 32)};
        open_stage(&s,
                   "chains:\n"
                   "  - {name: Clean, beads: [{cell: [large-steel, aluminium], count: 40}]}\n"
                   "  - {name: Delocalised, beads: [{cell: [large-steel, aluminium], count: 40, spins: random}]}\n"
                   "simulate: {until: 0.3 ms}\noutputs: [{movie: m.mp4}]\n",
                   size);
        for (size_t k = 0; k < s.seen.count; k++) {
            const struct text *key = &s.seen.text[k];
            for (size_t t = 0; strncmp(key->markup, "light", 5) == 0 && t < s.seen.count; t++) {
                const struct text *text = &s.seen.text[t];
                const bool line = fabs(text->y + 0.5 * text->height - key->y - 0.5 * key->height) < 0.5 * key->height;
                if (!line || text->x >= key->x)
                    continue;
                beside++;
                if (text->x + text->width + 0.4 * s.composer->look.label > key->x)
                    fail_msg("%d x %d: '%s' ends %.1f px before the key", size[0], size[1], text->markup,
                             key->x - text->x - text->width);
            }
        }
        close_stage(&s);
    }
    assert_true(beside >= 18);
}

/* Names for people, not the scene's identifiers. */
static void test_names_are_words(void **state)
{
    static struct stage s;
    static const int size[2] = {1280, 720};
    static const char text[] =
        "materials: {big-steel: {label: \"steel, 5 mm\", mass: 4 g, radius: 5 mm, modulus: 193 GPa, poisson: 0.3}}\n"
        "chains: [{name: half-reversed_1, striker: {bead: small-steel, velocity: 0.443 m/s}, wall: big-steel,"
        " beads: [{cell: [big-steel, tungsten-carbide], count: 4}, {bead: ptfe}]}]\n"
        "outputs: [{movie: m.mp4, size: [1280, 720]}]\n";
    (void)state;
    open_stage(&s, text, size);
    static const char *const words[] = {"half reversed 1", "steel, 5 mm", "tungsten carbide"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (!wrote(&s.seen, words[i]))
            fail_msg("nothing says '%s'", words[i]);
    }
    assert_false(wrote(&s.seen, "half-reversed") || wrote(&s.seen, "big-steel") || wrote(&s.seen, "tungsten-carbide"));
    close_stage(&s);
}

/* The poster is chosen by how far two chains differ, not by how much they show. */
static void test_differences_count(void **state)
{
    static struct stage s;
    static const int size[2] = {640, 360};
    double rest[65] = {0}, one[65] = {0}, far[65] = {0};
    (void)state;
    struct wish w = {.size = {640, 360}, .chains = 2};
    char text[4096];
    describe(&w, text, sizeof text);
    *strstr(text, "}]\n") = '\0';
    strcat(text, ", views: [profile]}]\n");
    open_stage(&s, text, size);
    one[7] = 30;
    far[40] = 12;
    const struct {
        const double *first, *second;
        double difference;
    } cases[] = {{one, one, 0}, {one, rest, 30 / sqrt(2)}, {rest, far, 12 / sqrt(2)}, {one, far, sqrt((900 + 144) / 2.0)}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (size_t chain = 0; chain < 2; chain++) {
            struct bead_sample sample = {.chain = chain, .time = 1e-4 * (double)i, .active = 64};
            sample.field[BEAD_FIELD_FORCE] = chain ? cases[i].second : cases[i].first;
            assert_int_equal(bead_composer_feed(s.composer, &sample, NULL), BEAD_OK);
        }
        assert_float_equal(bead_composer_interest(s.composer, 1e-4 * (double)i), cases[i].difference, 1e-9);
    }
    close_stage(&s);
}

/* Initial compression is not interesting: the wave is, wherever it adds the same. */
static void test_precompression_is_no_peak(void **state)
{
    static struct stage s;
    static const int size[2] = {640, 360};
    (void)state;
    open_stage(
        &s,
        "chain: {precompression: 20 N, striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: "
        "40}], wall: rigid}\nsimulate: {until: 1.2 ms}\n"
        "outputs: [{movie: m.mp4, views: [profile], range: [0, 45 N], scale: linear}]\n",
        size);
    double value[41], interest[3];
    for (int i = 0; i < 3; i++) { /* at rest; pressed by 9 N more; relieved by 9 N */
        struct bead_sample sample = {.time = 1e-4 * (double)i, .active = 41};
        for (size_t j = 0; j < 41; j++)
            value[j] = j == 0 ? 10 : 20;
        value[20] += i == 1 ? 9 : i == 2 ? -9 : 0;
        sample.field[BEAD_FIELD_FORCE] = value;
        assert_int_equal(bead_composer_feed(s.composer, &sample, NULL), BEAD_OK);
        interest[i] = bead_composer_interest(s.composer, sample.time);
    }
    assert_float_equal(interest[0], 0, 1e-12);
    assert_float_equal(interest[1], 9 / 45.0 / 41, 1e-9);
    assert_float_equal(interest[2], 9 / 45.0 / 41, 1e-9);
    close_stage(&s);
}

/* Numbers of a bar beside the clock end above a badge in the next line; those of images begin behind the curve. */
static void test_numbers_are_apart_from_what_is_beside_them(void **state)
{
    static struct stage s;
    static const int phone[2] = {1080, 1920}, wide[2] = {1920, 1080};
    (void)state;
    open_stage(&s,
               "title: A soliton\nsimulate: {until: 1}\n"
               "chain: {equation: kdv, length: 2, points: 640, dispersion: 4.84e-4, start: {cosine: 1, amplitude: 1}}\n"
               "outputs: [{movie: m.mp4, views: [profile, spacetime], size: [1080, 1920]}]\n",
               phone);
    const struct bead_movie_layout *l = &s.composer->layout;
    size_t above = 0;
    assert_true(l->badge.y >= l->time.y + l->time.height && l->bar.y < l->badge.y);
    for (size_t t = 0; t < s.seen.count; t++) {
        const struct text *text = &s.seen.text[t];
        if (!is_number(text->markup) || text->y < l->bar.y || text->y >= l->badge.y)
            continue;
        above++;
        assert_true(text->y + text->height <= l->badge.y);
    }
    assert_true(above >= 2);
    close_stage(&s);
    open_stage(&s,
               "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 2000}]}\n"
               "outputs: [{movie: m.mp4}]\n",
               wide);
    l = &s.composer->layout;
    const struct bead_rect curve = l->chains[0].plot[1], image = l->chains[0].plot[2];
    size_t left = 0;
    for (size_t t = 0; t < s.seen.count; t++) {
        const struct text *text = &s.seen.text[t];
        if (!is_number(text->markup) || text->x + text->width > image.x || text->x < curve.x + curve.width - text->width ||
            text->y > image.y + image.height)
            continue;
        left++;
        assert_true(text->x >= curve.x + curve.width + 0.3 * s.composer->look.tick);
    }
    assert_true(left >= 3);
    close_stage(&s);
}

/* On phones labels have no room beside names, but below them, where no plot becomes smaller for them. */
static void test_labels_on_phones(void **state)
{
    static struct stage s;
    (void)state;
    for (size_t chains = 1; chains <= 2; chains++) {
        struct wish w = {.size = {1080, 1920}, .chains = chains};
        char text[4096];
        describe(&w, text, sizeof text);
        open_stage(&s, text, w.size);
        show(&s, chains == 1 ? "labels-1" : "labels-2");
        assert_legible(&s.seen, w.size, text);
        assert_true(wrote(&s.seen, "every dimer the same way round"));
        const struct bead_movie_layout with = s.composer->layout;
        const double shown = image_share(&s);
        const struct bead_rect beads = with.chains[0].plot[0];
        close_stage(&s);
        for (char *label = strstr(text, " label: "); label; label = strstr(text, " label: "))
            memmove(label, strstr(label, ", "), strlen(strstr(label, ", ")) + 1);
        for (char *comma = strstr(text, ",,"); comma; comma = strstr(text, ",,"))
            memmove(comma, comma + 1, strlen(comma));
        open_stage(&s, text, w.size);
        assert_true(shown >= image_share(&s) - 0.005);
        assert_true(beads.width == s.composer->layout.chains[0].plot[0].width);
        close_stage(&s);
    }
}

/* Chains of equations have their equation beside their name, unless they have a label. */
static void test_headings_show_equations(void **state)
{
    (void)state;
    struct stage s = {0};
    const int size[2] = {1280, 720};
    open_stage(
        &s,
        "simulate: {until: 1}\nchains:\n"
        "  - {name: String, equation: fput, points: 63, alpha: 0.5, start: {pulse: 0.05, width: 8, at: 20}}\n"
        "  - {name: Limit, equation: kdv, length: 2, dispersion: 0.25, variable: strain, start: {pulse: 1, width: 0.2, at: 1}}\n"
        "outputs: [{movie: m.mp4, field: strain, views: [profile], layout: columns}]\n",
        size);
    assert_true(wrote(&s.seen, "63 masses") && wrote(&s.seen, "0.25 "));
    assert_legible(&s.seen, size, "headings of equations");
    close_stage(&s);
}

/* Axes that end on a number, and long titles, are complete also on phones and on old projectors. */
static void test_numbers_at_the_end_are_whole(void **state)
{
    static const int sizes[][2] = {{390, 844}, {390, 218}, {1024, 768}};
    (void)state;
    for (size_t i = 0; i < 2 * sizeof sizes / sizeof *sizes; i++) {
        static struct stage s;
        const int *size = sizes[i / 2];
        char text[1024], what[80];
        snprintf(text, sizeof text,
                 "title: Zabusky's and Kruskal's solitons cross a line of two lengths\nsimulate: {until: 1}\n"
                 "chain: {equation: kdv, length: 2, points: 640, dispersion: 4.84e-4, start: {cosine: 1, amplitude: 1}}\n"
                 "outputs: [{movie: m.mp4, views: [%s], size: [%d, %d]}]\n",
                 i % 2 ? "profile" : "profile, spacetime", size[0], size[1]);
        snprintf(what, sizeof what, "equation-%zu-%dx%d", i % 2, size[0], size[1]);
        open_stage(&s, text, size);
        show(&s, what);
        assert_legible(&s.seen, size, what);
        assert_true(wrote(&s.seen, "2.0"));
        assert_true(wrote(&s.seen, "Zabusky") && wrote(&s.seen, "lengths"));
        close_stage(&s);
    }
}

/* `contact` is a longer word than `bead`. */
static void test_axes_of_contacts_have_their_word(void **state)
{
    static const int sizes[][2] = {{960, 540}, {1920, 1080}, {1080, 1080}, {1080, 1920}, {390, 844}};
    static const char *const arranged[] = {"stage", "stacked", "columns"};
    (void)state;
    for (size_t i = 0; i < 3 * sizeof sizes / sizeof *sizes; i++) {
        static struct stage s;
        const int *size = sizes[i / 3];
        char text[400], what[80];
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: large-steel, count: 20}]}\n"
                 "outputs: [{movie: m.mp4, field: contact-force, layout: %s, views: [%s, profile, spacetime]}]\n",
                 arranged[i % 3], i % 3 ? "beads" : "stage");
        snprintf(what, sizeof what, "contacts, %s, %dx%d", arranged[i % 3], size[0], size[1]);
        open_stage(&s, text, size);
        assert_legible(&s.seen, size, what);
        assert_true(wrote(&s.seen, "contact"));
        close_stage(&s);
    }
}

/* Forty beads: the last number of a stage in a grid would be beside the first one of the next. */
static void test_numbers_of_a_grid_part(void **state)
{
    static const int sizes[][2] = {{1920, 1080}, {1080, 1080}, {1024, 768}};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        static struct stage s;
        char text[1024] = "chains:\n", what[80];
        for (int c = 0; c < 4; c++)
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "  - {name: c%d, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 40}]}\n",
                     c);
        snprintf(text + strlen(text), sizeof text - strlen(text), "outputs: [{movie: m.mp4, size: [%d, %d]}]\n", sizes[i][0],
                 sizes[i][1]);
        snprintf(what, sizeof what, "grid-%dx%d", sizes[i][0], sizes[i][1]);
        open_stage(&s, text, sizes[i]);
        show(&s, what);
        assert_legible(&s.seen, sizes[i], what);
        assert_numbers_part(&s.seen, what);
        assert_true(wrote(&s.seen, "30"));
        close_stage(&s);
    }
}

/* Rows of beads share the numbers below the last one only if each bead of every row is above its number there. */
static void test_unlike_rows_have_their_own_numbers(void **state)
{
    static const int size[2] = {1920, 1080};
    static const struct {
        const char *beads;
        bool own;
    } cases[] = {{"{bead: large-steel, count: 64, taper: 1 %}", true},
                 {"{bead: large-steel, count: 32}, {bead: small-steel, count: 32}", true},
                 {"{bead: large-steel, count: 20, gap: 3 mm}, {bead: large-steel, count: 44}", true},
                 {"{bead: aluminium, count: 64}", false},
                 {"{cell: [large-steel, aluminium], count: 32}", false}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        static struct stage s;
        char text[1024];
        snprintf(text, sizeof text,
                 "chains:\n  - {name: One, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [%s]}\n"
                 "  - {name: Two, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 64}]}\n"
                 "outputs: [{movie: m.mp4}]\n",
                 cases[k].beads);
        open_stage(&s, text, size);
        const struct bead_movie_chain *chains = s.composer->layout.chains;
        assert_true(chains[1].labels[0]);
        assert_int_equal(chains[0].labels[0], cases[k].own);
        assert_legible(&s.seen, size, cases[k].beads);
        close_stage(&s);
    }
}

/* Beside the title of the first image its name has less room than the others: like labels have one size. */
static void test_names_of_images_have_one_size(void **state)
{
    static const int size[2] = {1080, 1080};
    static struct stage s;
    (void)state;
    char text[1024] = "chains:\n";
    for (int c = 1; c <= 4; c++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "  - {name: Chain %d, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 60}]}\n",
                 c);
    snprintf(text + strlen(text), sizeof text - strlen(text), "outputs: [{movie: m.mp4, size: [1080, 1080]}]\n");
    open_stage(&s, text, size);
    show(&s, "names");
    size_t names = 0;
    double height = 0;
    for (size_t k = 0; k < s.seen.count; k++) { /* those above images are the lower half of the frame's */
        if (!strstr(s.seen.text[k].markup, "Chain ") || s.seen.text[k].y < 0.6 * size[1])
            continue;
        if (names++ > 0 && fabs(s.seen.text[k].height - height) > 0.01)
            fail_msg("'%s' is %g px high, not %g", s.seen.text[k].markup, s.seen.text[k].height, height);
        height = s.seen.text[k].height;
    }
    assert_int_equal(names, 4);
    close_stage(&s);
}

/* If the label beside one name has to be smaller, so are those beside the others. */
static void test_labels_of_chains_have_one_size(void **state)
{
    (void)state;
    double least = INFINITY, most = 0;
    for (int width = 700; width < 1400; width += 20) {
        static struct stage s;
        const int size[2] = {width, 720};
        char text[1024], what[80];
        snprintf(text, sizeof text,
                 "chains:\n"
                 "  - {name: A, label: five long balls that touch, beads: [{bead: large-steel, count: 5}]}\n"
                 "  - {name: B, label: five balls of a long row that touch another, beads: [{bead: large-steel, count: 5}]}\n"
                 "outputs: [{movie: m.mp4, size: [%d, %d]}]\n",
                 size[0], size[1]);
        snprintf(what, sizeof what, "labels-%d", width);
        open_stage(&s, text, size);
        show(&s, what);
        double height = 0;
        for (size_t k = 0; k < s.seen.count; k++) {
            if (!strstr(s.seen.text[k].markup, "that touch"))
                continue;
            if (height > 0 && fabs(s.seen.text[k].height - height) > 0.01)
                fail_msg("%s: '%s' is %g px high, not %g", what, s.seen.text[k].markup, s.seen.text[k].height, height);
            height = s.seen.text[k].height;
        }
        least = height > 0 ? fmin(least, height) : least;
        most = fmax(most, height);
        close_stage(&s);
    }
    assert_true(least < most); /* there were frames where they had to be smaller */
}

static const struct text *written(const struct texts *seen, const char *part)
{
    for (size_t i = 0; i < seen->count; i++) {
        if (strstr(seen->text[i].markup, part))
            return &seen->text[i];
    }
    fail_msg("'%s' is not written", part);
    return NULL;
}

/* If one name has to be smaller, or to have its M below, so do the others; and all are complete. */
static void test_names_of_chains_have_one_size(void **state)
{
    (void)state;
    bool small[2] = {false}, below[2] = {false};
    for (int i = 0; i < 2 * 16; i++) {
        static struct stage s;
        static const int sizes[2][2] = {{1080, 1920}, {720, 480}};
        static const char name[] = "Orderly no more but at random like any others";
        const int *size = sizes[i % 2];
        char text[1024], what[80];
        snprintf(text, sizeof text,
                 "chains:\n"
                 "  - {name: Orderly, beads: [{cell: [large-steel, aluminium], count: 8, spins: \"11111111\"}]}\n"
                 "  - {name: %.*s, beads: [{cell: [large-steel, aluminium], count: 8, spins: \"11110000\"}]}\n"
                 "outputs: [{movie: m.mp4, size: [%d, %d], type: large%s}]\n",
                 14 + i, name, size[0], size[1], i % 2 ? ", views: [profile]" : "");
        snprintf(what, sizeof what, "chains-%dx%d-%d", size[0], size[1], i / 2);
        open_stage(&s, text, size);
        show(&s, what);
        const struct text *one = written(&s.seen, "Orderly"), *two = written(&s.seen, "no mo"),
                          *m[2] = {written(&s.seen, "> = 1"), written(&s.seen, "> = 0")};
        if (fabs(one->height - two->height) > 0.01)
            fail_msg("%s: names are %g and %g px high", what, one->height, two->height);
        const bool under[2] = {m[0]->y > one->y + 0.9 * one->height, m[1]->y > two->y + 0.9 * two->height};
        if (under[0] != under[1])
            fail_msg("%s: M is below one name, but not the other", what);
        small[i % 2] = small[i % 2] || one->height < 0.9 * s.composer->look.title;
        below[i % 2] = below[i % 2] || under[0];
        close_stage(&s);
    }
    assert_true(small[0] && small[1] && below[0] && below[1]);
}

/* Numbers at the end of a chain do not touch the edge of a phone, below its stage or its curve, with images or without. */
static void test_numbers_at_the_end_have_air(void **state)
{
    static const int sizes[][2] = {{390, 844}, {1080, 1920}, {1080, 1080}};
    (void)state;
    for (size_t i = 0; i < 4 * sizeof sizes / sizeof *sizes; i++) {
        static struct stage s;
        const int *size = sizes[i / 4];
        char text[1024] = "chains:\n", what[80];
        for (size_t c = 0; c <= i % 4; c++)
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "  - {name: c%zu, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 80}]}\n",
                     c);
        snprintf(text + strlen(text), sizeof text - strlen(text), "outputs: [{movie: m.mp4, size: [%d, %d]}]\n", size[0], size[1]);
        snprintf(what, sizeof what, "end-%zu-%dx%d", i % 4, size[0], size[1]);
        open_stage(&s, text, size);
        show(&s, what);
        assert_legible(&s.seen, size, what);
        for (size_t k = 0; k < s.seen.count; k++) {
            const double air = size[0] - s.seen.text[k].x - s.seen.text[k].width;
            if (is_number(s.seen.text[k].markup) && air < s.composer->look.gap - 1)
                fail_msg("%s: '%s' is %g px from the edge", what, s.seen.text[k].markup, air);
        }
        assert_true(wrote(&s.seen, "80") || i % 4 == 3);
        close_stage(&s);
    }
}

/* ---- notes ---- */

/* px: left, right and top of the red pixels in rows from..to. */
static void find_red(const struct bead_frame *frame, int from, int to, double red[3])
{
    red[0] = red[2] = INFINITY;
    red[1] = -INFINITY;
    for (int y = from; y < to; y++) {
        for (int x = 0; x < frame->width; x++) {
            const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
            if (p[2] < 60 || p[2] < 2 * p[1] || p[2] < 2 * p[0])
                continue;
            red[0] = fmin(red[0], x);
            red[1] = fmax(red[1], x + 1);
            red[2] = fmin(red[2], y);
        }
    }
}

static void feed_shift(struct stage *s, size_t bead, double shift, double time)
{
    static double values[200];
    memset(values, 0, sizeof values);
    values[bead] = shift;
    static const double rest[200];
    struct bead_sample sample = {.time = time, .active = 199};
    for (int f = 0; f < BEAD_FIELD_COUNT; f++)
        sample.field[f] = f == BEAD_FIELD_DISPLACEMENT ? values : rest;
    assert_int_equal(bead_composer_feed(s->composer, &sample, NULL), BEAD_OK);
}

/* The red bead alone is red: the tip of its note lies within its radius in each frame, while it moves, and where only the row of
 * all beads shows it. */
static void test_tips_meet_their_beads(void **state)
{
    (void)state;
    static struct stage s;
    static const int size[2] = {1280, 720};
    static const struct {
        size_t before, after;
    } chains[] = {{3, 4}, {50, 10}};
    for (size_t k = 0; k < 2; k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "materials: {red: {mass: 4 g, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3, colour: \"#ff0000\"}}\n"
                 "chain: {beads: [{bead: large-steel, count: %zu}, {bead: red}, {bead: large-steel, count: %zu}]}\n"
                 "simulate: {until: 1.2 ms}\n"
                 "outputs: [{movie: m.mp4, light: none, magnify: 1, notes: [{at: 0, until: 1 ms, bead: %zu, text: here}]}]\n",
                 chains[k].before, chains[k].after, chains[k].before + 1);
        open_stage(&s, text, size);
        const struct bead_movie_layout *layout = &s.composer->layout;
        const struct bead_rect *plot = &layout->chains[0].plot[0];
        for (int i = 0; i < 5; i++) {
            struct bead_changes changes = {0};
            const double time = 1e-4 * i;
            feed_shift(&s, chains[k].before + 1, 1e-3 * i, time);
            assert_int_equal(bead_composer_draw(s.composer, time, &changes, NULL), BEAD_OK);
            const struct bead_note_boxes *notes = bead_composer_notes(s.composer);
            assert_int_equal(notes->count, 1);
            const struct bead_note_box *box = &notes->box[0];
            double red[3];
            const bool row = box->tip_y > box->y;
            assert_true(row == (k == 1));
            find_red(bead_composer_frame(s.composer), row ? (int)(box->y + box->height) + 1 : plot->y + layout->head,
                     row ? plot->y + plot->height : (int)box->y, red);
            const double r = 0.5 * (red[1] - red[0]), across = box->tip_x - 0.5 * (red[0] + red[1]), down = box->tip_y - red[2] - r;
            if (!(across * across + down * down <= r * r))
                fail_msg("frame %d: the tip is %.1f, %.1f px from a bead of %.1f px", i, across, down, r);
        }
        struct bead_changes changes = {0};
        feed_shift(&s, 0, 0, 1.1e-3);
        assert_int_equal(bead_composer_draw(s.composer, 1.1e-3, &changes, NULL), BEAD_OK);
        assert_int_equal(bead_composer_notes(s.composer)->count, 0);
        close_stage(&s);
    }
}

/* More notes at one bead than there is room for: those that would leave the stage are not drawn, as nothing would erase them. */
static void test_notes_stay_on_the_stage(void **state)
{
    (void)state;
    static struct stage s;
    static const int size[2] = {640, 360};
    char text[2048] = "chain: {beads: [{bead: large-steel, count: 9}]}\nsimulate: {until: 1.2 ms}\n"
                      "outputs: [{movie: m.mp4, light: none, notes: [";
    for (int i = 0; i < 12; i++)
        strcat(text, "{at: 0, bead: 5, text: a note that takes a third of the width or a little more}, ");
    strcat(text, "{at: 0, bead: front, text: x}]}]\n");
    open_stage(&s, text, size);
    const struct bead_rect *plot = &s.composer->layout.chains[0].plot[0];
    struct bead_changes changes = {0};
    feed_shift(&s, 0, 0, 0);
    assert_int_equal(bead_composer_draw(s.composer, 0, &changes, NULL), BEAD_OK);
    const struct bead_note_boxes *notes = bead_composer_notes(s.composer);
    assert_in_range(notes->count, 2, 11);
    for (size_t i = 0; i < notes->count; i++) {
        const struct bead_note_box *box = &notes->box[i];
        assert_true(box->x >= plot->x - s.composer->layout.beyond[0] && box->y >= plot->y + s.composer->layout.head);
        assert_true(box->y + box->height <= plot->y + plot->height);
        for (size_t j = 0; j < i; j++)
            assert_true(box->x >= notes->box[j].x + notes->box[j].width || notes->box[j].x >= box->x + box->width ||
                        fabs(box->y - notes->box[j].y) >= box->height);
    }
    close_stage(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_frame),
        cmocka_unit_test(test_many_chains),
        cmocka_unit_test(test_windows_that_move),
        cmocka_unit_test(test_numbers_at_the_end_have_air),
        cmocka_unit_test(test_names_of_images_have_one_size),
        cmocka_unit_test(test_labels_of_chains_have_one_size),
        cmocka_unit_test(test_names_of_chains_have_one_size),
        cmocka_unit_test(test_tips_meet_their_beads),
        cmocka_unit_test(test_notes_stay_on_the_stage),
        cmocka_unit_test(test_cells_in_the_picture),
        cmocka_unit_test(test_colours_have_a_scale),
        cmocka_unit_test(test_coloured_beads_have_a_scale),
        cmocka_unit_test(test_keys_leave_room_for_labels),
        cmocka_unit_test(test_keys_are_apart_from_headings),
        cmocka_unit_test(test_names_are_words),
        cmocka_unit_test(test_differences_count),
        cmocka_unit_test(test_headings_show_equations),
        cmocka_unit_test(test_numbers_at_the_end_are_whole),
        cmocka_unit_test(test_axes_of_contacts_have_their_word),
        cmocka_unit_test(test_numbers_of_a_grid_part),
        cmocka_unit_test(test_precompression_is_no_peak),
        cmocka_unit_test(test_labels_on_phones),
        cmocka_unit_test(test_numbers_are_apart_from_what_is_beside_them),
        cmocka_unit_test(test_unlike_rows_have_their_own_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
