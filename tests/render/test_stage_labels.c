/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Labels that move with the camera, read back from pixels, and the key of a stage, read from the drawing: all at the places that
 * follow from the look's letters. */
#include "beadreel/law.h"
#include "beadreel/render.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/draw/words.h"
#include "render/stage/moving_labels.h"
#include "render/stage/stage_key.h"
#include "strokes.h"
#include "tests/scenes.h"
#include "tests/texts.h"

enum { WIDTH = 500, HEIGHT = 100 };
static const struct bead_rect strip = {40, 20, 400, 60};
static const double scale = 1000; /* px a metre */

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static void make_look(struct bead_look *look)
{
    bead_look_screen(look, 1000, 800, false);
    look->tick = 20;
    look->label = 22;
    look->line = 3;
    look->axis = (struct bead_rgb){0, 0, 1};
}

/* ---- labels that move ---- */

struct drawn {
    struct bead_look look;
    struct bead_moving_labels *labels;
    struct bead_frame frame, background;
};

static void open_drawn(struct drawn *d)
{
    struct bead_message msg = {""};
    make_look(&d->look);
    require(bead_moving_labels_create(&d->look, strip, scale, &d->labels, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &d->frame, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &d->background, &msg), &msg);
    for (size_t i = 0; i < d->frame.stride * HEIGHT; i++)
        d->frame.pixels[i] = d->background.pixels[i] = 255;
}

static void close_drawn(struct drawn *d)
{
    bead_moving_labels_destroy(d->labels);
    bead_frame_free(&d->frame);
    bead_frame_free(&d->background);
}

static void draw(struct drawn *d, double left)
{
    struct bead_message msg = {""};
    require(bead_moving_labels_draw(d->labels, left, &d->frame, &d->background, NULL, &msg), &msg);
}

/* How much ink that takes away from this channel (0: blue) is in a box of the strip, in pixels, and the place of its middle. */
static double ink(const struct drawn *d, int channel, int x0, int x1, int y0, int y1, double *middle)
{
    double sum = 0, moment = 0;
    for (int y = strip.y + y0; y < strip.y + y1; y++) {
        for (int x = strip.x + x0; x < strip.x + x1; x++) {
            const double here = (255 - d->frame.pixels[(size_t)y * d->frame.stride + 4 * (size_t)x + (size_t)channel]) / 255.0;
            sum += here;
            moment += here * (x - strip.x + 0.5);
        }
    }
    if (middle)
        *middle = moment / sum;
    return sum;
}

static const struct bead_rgb black = {0, 0, 0};

/* Marks are at their place to a sixteenth of a pixel: lines of the look's width above a text, triangles below one. */
static void marks_move_by_parts_of_a_pixel(void **)
{
    for (int pointer = 0; pointer < 2; pointer++) {
        struct bead_message msg = {""};
        struct drawn d;
        open_drawn(&d);
        require(bead_moving_labels_add(d.labels, 0.2, "8", black, pointer ? BEAD_LABEL_POINTER : BEAD_LABEL_TICK, &msg), &msg);
        for (int k = 0; k <= 32; k++) {
            const double left = (k + (k % 2 ? 0.3 : 0.7)) / 16 / scale, x = 200 - (k + 1 - k % 2) / 16.0;
            double middle;
            draw(&d, left);
            const int high = pointer ? (int)round(1.3 * 0.3 * 20) : (int)round(0.38 * 20), from = pointer ? strip.height - high : 0;
            for (int y = 0; y < high; y++) {
                const double wide = pointer ? 2 * 0.3 * 20 * (1 - (y + 0.5) / high) : 3;
                if (fabs(ink(&d, 2, 0, strip.width, from + y, from + y + 1, &middle) - wide) > 0.03 ||
                    fabs(middle - x) > 0.02 + 0.1 / wide)
                    fail_msg("mark %d, row %d at %g: %g px about %g", pointer, y, x,
                             ink(&d, 2, 0, strip.width, from + y, from + y + 1, NULL), middle);
                if (!pointer) /* in the colour of axes */
                    assert_true(ink(&d, 0, 0, strip.width, y, y + 1, NULL) < 0.02);
            }
            assert_true(ink(&d, 2, 0, strip.width, pointer ? from - 1 : high, pointer ? from : high + 1, NULL) < 0.02 || pointer);
        }
        close_drawn(&d);
    }
}

/* The text is below a tick by its gap, above a pointer at the top; in its middle; it moves as a whole. */
static void texts_are_in_the_middle(void **)
{
    for (int sign = BEAD_LABEL_PLAIN; sign <= BEAD_LABEL_POINTER; sign++) {
        struct bead_message msg = {""};
        struct drawn d;
        open_drawn(&d);
        require(bead_moving_labels_add(d.labels, 0.2, "8", black, (enum bead_label_sign)sign, &msg), &msg);
        draw(&d, 0);
        const bool below = sign == BEAD_LABEL_TICK;
        const int base = below ? (int)round(round(0.38 * 20) + 20) : (int)round(0.95 * 20), top = base - 16;
        double middle, all = ink(&d, 1, 0, strip.width, top, base + 1, &middle);
        assert_true(all > 15 && fabs(middle - 200) < 0.7);
        assert_true(ink(&d, 1, 0, strip.width, base + 1, base + 3, NULL) < 0.1); /* digits are on their line */
        int highest = top;
        while (highest < base && ink(&d, 1, 0, strip.width, highest, highest + 1, NULL) < 0.2)
            highest++;
        assert_true(base - highest >= 13 && base - highest <= 16); /* a digit of 0.7 of the type */
        for (int k = 1; k <= 16; k++) {
            double moved;
            draw(&d, k / 16.0 / scale);
            assert_true(fabs(ink(&d, 1, 0, strip.width, top, base + 1, &moved) - all) < 0.02 * all + 0.2);
            assert_true(fabs(middle - k / 16.0 - moved) < 0.05);
        }
        /* At the ends it fades, over a letter's size, before it would be cut off. */
        double width, height;
        const struct bead_text_style style = {.family = d.look.family, .size = 20, .down = BEAD_ALIGN_BASELINE};
        bead_text_size(NULL, &style, "8", &width, &height);
        for (int k = -4; k <= 24; k += 4) {
            for (int right = 0; right < 2; right++) {
                const double room = k, at = right ? strip.width - width / 2 - 1 - room : width / 2 + 1 + room;
                draw(&d, 0.2 - at / scale);
                const double part = ink(&d, 1, 0, strip.width, top, base + 1, NULL) / all, expected = fmax(0, fmin(1, room / 20));
                if (fabs(part - expected) > 0.05)
                    fail_msg("%g px before the end %g of the ink is left", room, part);
            }
        }
        close_drawn(&d);
    }
}

/* Labels closer than half a letter to an earlier one are left out. */
static void labels_do_not_touch(void **)
{
    double width, height;
    for (int apart = 0; apart < 2; apart++) {
        struct bead_message msg = {""};
        struct drawn d;
        open_drawn(&d);
        const struct bead_text_style style = {.family = d.look.family, .size = 20, .down = BEAD_ALIGN_BASELINE};
        bead_text_size(NULL, &style, "8888", &width, &height);
        require(bead_moving_labels_add(d.labels, 0.2, "8888", black, BEAD_LABEL_PLAIN, &msg), &msg);
        draw(&d, 0);
        const double one = ink(&d, 1, 0, strip.width, 0, strip.height, NULL);
        for (int side = -1; side <= 1; side += 2)
            require(bead_moving_labels_add(d.labels, 0.2 + side * (width + 0.5 * 20 + (apart ? 0.1 : -0.1)) / scale, "8888", black,
                                           BEAD_LABEL_PLAIN, &msg),
                    &msg);
        draw(&d, 0);
        assert_true(fabs(ink(&d, 1, 0, strip.width, 0, strip.height, NULL) / one - (apart ? 3 : 1)) < 0.02);
        /* The same place again: nothing is done, and nothing told; elsewhere, the strip has changed. */
        struct bead_changes changes = {.count = 0};
        const uint8_t before = d.frame.pixels[0];
        memset(d.frame.pixels, 7, 4);
        require(bead_moving_labels_draw(d.labels, 0, &d.frame, &d.background, &changes, &msg), &msg);
        assert_true(changes.count == 0 && before == 255);
        require(bead_moving_labels_draw(d.labels, 0.01, &d.frame, &d.background, &changes, &msg), &msg);
        assert_true(changes.count == 1 && memcmp(&changes.rect[0], &strip, sizeof strip) == 0);
        close_drawn(&d);
    }
}

/* Numbers of beads: multiples of a round step that has room for the widest, at their beads; those of sensors come first. */
static void beads_are_counted(void **)
{
    double place[200];
    for (int i = 0; i < 200; i++)
        place[i] = 0.01 * i; /* 10 px apart */
    struct bead_message msg = {""};
    struct drawn d, one;
    open_drawn(&d);
    require(bead_moving_labels_count(d.labels, place, 17, 200, strip.width / scale, BEAD_LABEL_TICK, &msg), &msg);
    size_t seen = 0;
    double before = -1;
    for (int k = 0; k < 40; k++) { /* the camera advances by one bead at a time */
        draw(&d, place[k]);
        double middle;
        for (int bead = 17 + k + 5; bead < 17 + k + 35; bead++) {
            const int x = 10 * (bead - 17 - k);
            if (ink(&d, 2, x - 2, x + 3, 0, 5, &middle) < 5)
                continue;
            assert_true(fabs(middle - x) < 0.1 && bead % 5 == 0);
            if (before >= 0 && k == 0)
                assert_true(bead - before == 5 || bead - before == 10);
            before = k == 0 ? bead : before;
            seen++;
        }
    }
    assert_true(seen > 40);
    close_drawn(&d);
    open_drawn(&one);
    require(bead_moving_labels_add(one.labels, place[33 - 17], "a sensor", black, BEAD_LABEL_POINTER, &msg), &msg);
    require(bead_moving_labels_count(one.labels, place, 17, 200, strip.width / scale, BEAD_LABEL_TICK, &msg), &msg);
    draw(&one, 0);
    assert_true(ink(&one, 2, 10 * (30 - 17) - 2, 10 * (30 - 17) + 3, 0, 5, NULL) < 5 ||
                ink(&one, 2, 10 * (35 - 17) - 2, 10 * (35 - 17) + 3, 0, 5, NULL) < 5);
    close_drawn(&one);
}

/* If an axis has no second number, a window shows one of its beads at a time: a multiple of all that it shows. */
static void few_numbers_have_room(void **)
{
    const struct bead_rect narrow = {strip.x, strip.y, 60, strip.height};
    struct bead_message msg = {""};
    struct drawn d;
    double place[30], middle;
    for (int i = 0; i < 30; i++)
        place[i] = 0.00205 * i; /* 2.05 px apart: 29.3 in the strip */
    open_drawn(&d);
    bead_moving_labels_destroy(d.labels);
    require(bead_moving_labels_create(&d.look, narrow, scale, &d.labels, &msg), &msg);
    require(bead_moving_labels_count(d.labels, place, 195, 30, narrow.width / scale, BEAD_LABEL_TICK, &msg), &msg);
    draw(&d, 0);
    assert_true(ink(&d, 2, 0, narrow.width, 0, 5, &middle) > 5 && fabs(middle - 2.05 * (210 - 195)) < 0.1);
    close_drawn(&d);
}

/* Of beads that are further apart than numbers need, each has its own, however fine an axis of that length would be. */
static void wide_windows_number_all(void **)
{
    double place[8];
    for (int i = 0; i < 8; i++)
        place[i] = 0.4 * i; /* 400 px apart: as far as the strip is wide */
    struct bead_message msg = {""};
    struct drawn d;
    open_drawn(&d);
    require(bead_moving_labels_count(d.labels, place, 5, 8, strip.width / scale, BEAD_LABEL_TICK, &msg), &msg);
    for (int bead = 6; bead < 10; bead++) {
        draw(&d, place[bead - 5] - 0.2);
        assert_true(ink(&d, 2, 198, 203, 0, 5, NULL) > 5);
    }
    close_drawn(&d);
}

/* ---- the key of a stage ---- */

struct keyed {
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_view_setup setup;
};

static void open_keyed(struct keyed *k, const char *chain)
{
    struct bead_message msg = {""};
    char text[700];
    snprintf(text, sizeof text, "chain: {%s}\nsimulate: {until: 1 ms}\noutputs: [{table: a.csv}]\n", chain);
    *k = (struct keyed){.scene = parse(text)};
    require(bead_chain_create(k->scene, 0, &k->chain, &msg), &msg);
    make_look(&k->look);
    k->setup = (struct bead_view_setup){.chain = k->chain,
                                        .field = BEAD_FIELD_CONTACT_FORCE,
                                        .beads = {0, bead_chain_beads(k->chain) - 1},
                                        .colours = {NULL, BEAD_SCALE_LINEAR, -12, 48, 0},
                                        .look = &k->look,
                                        .axes = true,
                                        .light = BEAD_LIGHT_CONTACTS};
}

static void close_keyed(struct keyed *k)
{
    bead_chain_destroy(k->chain);
    bead_scene_free(k->scene);
}

#define STRIKER  "striker: {bead: large-steel, velocity: 1 m/s}, "
#define BEADS_OF "beads: [{bead: large-steel, count: 3}, {bead: small-steel, count: 2}, {bead: large-steel, count: 4}]"

/* From the right: the value of full light, the scale, its zero; then the materials in their order along the chain, each a ball in
 * proportion and a word. */
static void keys_are_rows_of_samples(void **)
{
    struct keyed k;
    const double size = 20, right = 780, middle = 33;
    open_keyed(&k, STRIKER BEADS_OF);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 900, 80);
    struct texts seen = {.count = 0};
    const struct bead_text_watch watch = {texts_note, &seen};
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    const struct bead_chain *chains[] = {k.chain};
    strokes_begin();
    const double used = bead_stage_draw_key_of(cr, &k.setup, chains, 1, right, middle, size);
    assert_true(used == bead_stage_draw_key_of(NULL, &k.setup, chains, 1, right, middle, size));
    assert_true(fabs(bead_stage_key_room(&k.setup) - used) < 1e-9); /* type of the ticks */
    assert_true(strokes.count == 3 && seen.count == 4);
    const double *radius = bead_chain_radius(k.chain);
    const struct bead_text_style style = {.family = k.look.family, .size = size, .down = BEAD_ALIGN_MIDDLE};
    double x = right, width, height;
    for (size_t i = 0; i < 4; i++) {
        if (i == 2)
            x -= 1.1 * size; /* between entries */
        bead_text_size(NULL, &style, seen.text[i].markup, &width, &height);
        assert_true(fabs(seen.text[i].x + seen.text[i].width - x) < 3 &&
                    fabs(seen.text[i].y + seen.text[i].height / 2 - middle) < 0.3 * size);
        x -= width;
        if (i == 0) {
            x -= 0.3 * size;
            assert_bounds(&strokes.list[0], x - 4 * size, middle - 0.25 * size, x, middle + 0.25 * size);
            x -= 4 * size + 0.3 * size;
        }
        if (i >= 2) {
            const double r = 0.36 * size * (i == 2 ? fmax(0.5, radius[4] / radius[0]) : 1);
            const struct stroke *ball = &strokes.list[i - 1];
            assert_at(ball->low[0], x - 0.3 * size - 2 * r); /* the path comes from the word */
            assert_at(ball->at[1].x, x - 0.3 * size);
            assert_at(ball->at[1].y, middle);
            x -= 0.3 * size + 2 * r + (i == 2 ? 1.1 * size : 0);
        }
    }
    assert_at(right - used, x);
    assert_non_null(strstr(seen.text[0].markup, "48")); /* the larger magnitude */
    assert_non_null(strstr(seen.text[1].markup, "light: "));
    assert_true(seen.text[2].x > seen.text[3].x && radius[4] < radius[0]);
    /* The scale is dark at its left, light at its right. */
    cairo_surface_flush(surface);
    const unsigned char *row = cairo_image_surface_get_data(surface) + 33 * cairo_image_surface_get_stride(surface);
    const struct stroke *bar = &strokes.list[0];
    int before = -1;
    for (int i = 1; i < 8; i++) {
        const int at = (int)(bar->low[0] + i / 8.0 * (bar->high[0] - bar->low[0])),
                  light = row[4 * at] + row[4 * at + 1] + row[4 * at + 2];
        assert_true(light >= before);
        before = light;
    }
    assert_true(before > 300);
    /* Without light, only materials; the same where another stage has its scale; nothing where it has both. */
    k.setup.light = BEAD_LIGHT_NONE;
    const double materials = bead_stage_draw_key_of(NULL, &k.setup, chains, 1, right, middle, size);
    assert_true(materials < used - 4 * size);
    k.setup.light = BEAD_LIGHT_CONTACTS;
    k.setup.elsewhere = BEAD_KEY_LIGHT;
    assert_true(bead_stage_draw_key_of(NULL, &k.setup, chains, 1, right, middle, size) == materials);
    assert_true(bead_stage_draw_key_of(NULL, &k.setup, chains, 0, right, middle, size) == 0);
    k.setup.elsewhere = BEAD_KEY_LIGHT | BEAD_KEY_MATERIALS;
    assert_true(bead_stage_draw_key_of(NULL, &k.setup, chains, 1, right, middle, size) == 0);
    k.setup.elsewhere = BEAD_KEY_LIGHT;
    k.setup.beads = (struct bead_span){4, 5}; /* small ones alone */
    assert_true(bead_stage_draw_key_of(NULL, &k.setup, chains, 1, right, middle, size) < 0.6 * materials);
    k.setup.axes = false;
    assert_true(bead_stage_key_room(&k.setup) == 0);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    close_keyed(&k);
}

/* Strikers are of steel. Of several stages one says what the light is: the last whose materials another one has named, as its key
 * has room, else the first; and each material is named by the first that has it. */
static void keys_share_what_they_say(void **)
{
    static const struct {
        const char *beads[3]; /* of the chains; NULL: none */
        size_t lit;
        unsigned named; /* a bit for each chain whose materials are named before */
    } cases[] = {{{"{bead: large-steel, count: 4}"}, 0, 0},
                 {{"{bead: large-steel, count: 4}", "{bead: large-steel, count: 6}"}, 1, 2},
                 {{"{bead: large-steel, count: 4}", "{bead: aluminium, count: 6}"}, 0, 0},
                 {{"{bead: large-steel, count: 4}", "{bead: large-steel}", "{bead: aluminium, count: 6}"}, 1, 2},
                 {{"{cell: [large-steel, aluminium]}", "{bead: aluminium, count: 2}", "{bead: large-steel, count: 6}"}, 2, 6},
                 {{"{bead: large-steel}", "{cell: [large-steel, aluminium]}", "{bead: aluminium, count: 6}"}, 2, 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_message msg = {""};
        struct bead_chain *chains[3] = {NULL};
        char text[900] = "chains:\n";
        size_t count = 0;
        for (; count < 3 && cases[i].beads[count]; count++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "  - {name: c%zu, beads: [%s]}\n", count,
                     cases[i].beads[count]);
        strcat(text, "outputs: [{movie: a.mp4}]\n");
        struct bead_scene *scene = parse(text);
        for (size_t c = 0; c < count; c++)
            require(bead_chain_create(scene, c, &chains[c], &msg), &msg);
        for (size_t c = 0; c < count; c++) {
            const unsigned wanted = (c == cases[i].lit ? 0 : BEAD_KEY_LIGHT) | (cases[i].named >> c & 1 ? BEAD_KEY_MATERIALS : 0),
                           found = bead_stage_key_elsewhere((const struct bead_chain *const *)chains, count, c);
            if (found != wanted)
                fail_msg("case %zu, chain %zu: %x, not %x", i, c, found, wanted);
        }
        for (size_t c = 0; c < count; c++)
            bead_chain_destroy(chains[c]);
        bead_scene_free(scene);
    }
}

/* The window follows one of several waves: its key says so if there are two or more, of strikers, drives, and beads that start. */
static void several_waves_are_told(void **)
{
    static const struct {
        const char *chain;
        bool several;
    } cases[] = {{STRIKER BEADS_OF, false},
                 {STRIKER "start: [{bead: 5, velocity: 1 m/s}], " BEADS_OF, true},
                 {STRIKER "start: [{bead: 1, velocity: 1 m/s}], " BEADS_OF, false}, /* neighbours start one */
                 {STRIKER "start: [{bead: 9, velocity: 1 m/s}], " BEADS_OF, true},
                 {"start: [{bead: 5, velocity: 1 m/s}], " BEADS_OF, true},  /* both ways */
                 {"start: [{bead: 9, velocity: 1 m/s}], " BEADS_OF, false}, /* from the end one way */
                 {"start: [{bead: 5, displacement: 1 um}], " BEADS_OF, true},
                 {"start: [{bead: 9, velocity: 1 m/s}, {bead: 8, velocity: 1 m/s}], " BEADS_OF, true},
                 {"start: [{bead: 0, velocity: 1 m/s}, {bead: 1, velocity: 1 m/s}], " BEADS_OF, false},
                 {"start: [{bead: 0, velocity: 1 m/s}, {bead: 9, velocity: 1 m/s}], " BEADS_OF, true},
                 {"start: [{bead: 0, velocity: 1 m/s}, {bead: 5, velocity: 0 m/s}], " BEADS_OF, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct keyed k;
        open_keyed(&k, cases[i].chain);
        const struct bead_chain *chains[] = {k.chain};
        const double key = bead_stage_draw_key_of(NULL, &k.setup, chains, 1, 0, 0, k.look.tick),
                     room = bead_stage_key_room(&k.setup);
        const struct bead_text_style style = {.family = k.look.family, .size = k.look.tick};
        double width, height;
        const bool striker = bead_chain_spec(k.chain)->striker_velocity != 0;
        bead_text_size(NULL, &style, striker ? "window: striker's wave" : "window: one wave", &width, &height);
        if (fabs(room - key - (cases[i].several ? width + 1.1 * k.look.tick : 0)) > 0.01)
            fail_msg("%s: %g px for it", cases[i].chain, room - key);
        close_keyed(&k);
    }
}

/* Walls are named by their material, without the size that its beads have, and by 40 letters of it. */
static void walls_are_named(void **)
{
    static const char *const labels[][2] = {
        {"Glass, 5 mm", "Glass wall"},
        {"Glass", "Glass wall"},
        {"0123456789012345678901234567890123456789 and more", "0123456789012345678901234567890123456789 wall"}};
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++) {
        char text[600], name[96];
        struct bead_message msg = {""};
        struct bead_chain *chain;
        snprintf(text, sizeof text,
                 "materials: {glass: {label: \"%s\", density: 2500 kg/m3, radius: 5 mm, modulus: 70 GPa, poisson: 0.2}}\n"
                 "chain: {beads: [{bead: glass, count: 3}], wall: glass}\noutputs: [{table: a.csv}]\n",
                 labels[i][0]);
        struct bead_scene *scene = parse(text);
        require(bead_chain_create(scene, 0, &chain, &msg), &msg);
        bead_wall_name(chain, name, sizeof name);
        assert_string_equal(name, labels[i][1]);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_move_by_parts_of_a_pixel),
        cmocka_unit_test(texts_are_in_the_middle),
        cmocka_unit_test(labels_do_not_touch),
        cmocka_unit_test(beads_are_counted),
        cmocka_unit_test(few_numbers_have_room),
        cmocka_unit_test(wide_windows_number_all),
        cmocka_unit_test(keys_are_rows_of_samples),
        cmocka_unit_test(keys_share_what_they_say),
        cmocka_unit_test(walls_are_named),
        cmocka_unit_test(several_waves_are_told),
    };
    return cmocka_run_group_tests_name("labels and keys of stages", tests, NULL, NULL);
}
