/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of thousands of beads: a pixel shows the mean of its beads, and a pulse of one bead is not lost. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/paint/canvas.h"
#include "render/view/views.h"
#include "sim/chain/chain_internal.h"

enum { BEADS = 5000, HEIGHT = 40 };

struct strip {
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_colormap map;
    struct bead_canvas *canvas;
    struct bead_view *view;
    struct bead_frame background, frame;
    struct bead_rect plot;
    double u[BEADS], force[BEADS];
};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static struct strip *make_strip(int width)
{
    static const char text[] = "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: aluminium}, "
                               "{cell: [large-steel, aluminium], count: 2499}]}\noutputs: [{movie: a.mp4}]\n";
    struct bead_message msg = {""};
    struct strip *s = calloc(1, sizeof *s);
    assert_non_null(s);
    require(bead_scene_parse("test", text, sizeof text - 1, NULL, &s->scene, &msg), &msg);
    require(bead_chain_create(s->scene, 0, &s->chain, &msg), &msg);
    assert_int_equal(bead_chain_beads(s->chain), BEADS);
    require(bead_colormap_load("inferno", &s->map, &msg), &msg);
    bead_look_screen(&s->look, width, 9 * width / 16, true);
    struct bead_view_setup setup = {.chain = s->chain,
                                    .field = BEAD_FIELD_FORCE,
                                    .beads = {0, BEADS - 1},
                                    .time = {0, 1e-3},
                                    .colours = {&s->map, BEAD_SCALE_SQRT, 0, 40, 0},
                                    .look = &s->look,
                                    .magnify = 1};
    s->plot = (struct bead_rect){10, 2, width, HEIGHT - 4};
    require(bead_canvas_create(NULL, width, HEIGHT, &s->canvas, &msg), &msg);
    require(bead_frame_create(width + 20, HEIGHT, &s->background, &msg), &msg);
    require(bead_frame_create(width + 20, HEIGHT, &s->frame, &msg), &msg);
    require(bead_view_beads_type.create(&setup, &s->view, &msg), &msg);
    require(bead_view_beads_type.place(s->view, s->plot, s->canvas, &msg), &msg);
    return s;
}

static void free_strip(struct strip *s)
{
    bead_view_beads_type.destroy(s->view);
    bead_canvas_destroy(s->canvas);
    bead_frame_free(&s->background);
    bead_frame_free(&s->frame);
    bead_chain_destroy(s->chain);
    bead_scene_free(s->scene);
    free(s);
}

static void draw(struct strip *s, struct bead_changes *changes)
{
    struct bead_message msg = {""};
    struct bead_sample sample = {.active = BEADS};
    sample.field[BEAD_FIELD_FORCE] = s->force;
    sample.field[BEAD_FIELD_DISPLACEMENT] = s->u;
    require(bead_view_beads_type.feed(s->view, &sample, &msg), &msg);
    require(bead_view_beads_type.draw(s->view, 0, &s->frame, &s->background, changes, &msg), &msg);
}

static const uint8_t *pixel(const struct strip *s, const struct bead_frame *frame, int x)
{
    return frame->pixels + (size_t)(s->plot.y + 3) * frame->stride + 4 * (size_t)(s->plot.x + x);
}

static int difference(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    for (int c = 0; c < 3; c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return most;
}

/* One bead of 5000, 3 and 10 of them a pixel. */
static void a_pulse_of_one_bead_stays_visible(void **state)
{
    (void)state;
    for (int width = 500; width <= 1700; width += 1200) {
        struct strip *s = make_strip(width);
        struct bead_frame rest;
        struct bead_message msg = {""};
        draw(s, NULL);
        require(bead_frame_create(s->frame.width, s->frame.height, &rest, &msg), &msg);
        bead_frame_copy(&rest, &s->frame, (struct bead_rect){0, 0, s->frame.width, s->frame.height});
        for (size_t bead = 3; bead < BEADS; bead += 331) {
            struct bead_changes changes = {0};
            s->force[bead] = 30;
            draw(s, &changes);
            int at = (int)(((double)bead + 0.5) / BEADS * width), most = 0;
            for (int x = 0; x < width; x++) {
                int here = difference(pixel(s, &s->frame, x), pixel(s, &rest, x));
                if (abs(x - at) <= 1)
                    most = here > most ? here : most;
                else
                    assert_int_equal(here, 0);
            }
            if (most < 40)
                fail_msg("bead %zu of %d on %d pixels stands out by %d levels", bead, BEADS, width, most);
            s->force[bead] = 0;
            draw(s, &changes);
            assert_true(changes.count >= 1 && difference(pixel(s, &s->frame, at), pixel(s, &rest, at)) == 0);
        }
        bead_frame_free(&rest);
        free_strip(s);
    }
}

/* At rest each pixel has the mean colour of steel and aluminium, darkened alike in red, green and blue; those at the ends, which
 * have fewer beads, nearly so, with some of the black behind them. */
static void a_row_at_rest_has_the_colours_of_its_beads(void **state)
{
    (void)state;
    for (int width = 500; width <= 1700; width += 1200) {
        struct strip *s = make_strip(width);
        draw(s, NULL);
        double mean[3];
        for (int c = 0; c < 3; c++)
            mean[c] = 127.5 * (bead_chain_colour(s->chain, BEADS - 1)[c] + bead_chain_colour(s->chain, BEADS - 2)[c]);
        for (int x = 0; x < width; x++) {
            const uint8_t *p = pixel(s, &s->frame, x);
            const bool end = x < 10 || x >= width - 10;
            const double share = p[1] / mean[1], near = end ? 12 : 1.6; /* of green */
            const double inside = pixel(s, &s->frame, width / 2)[1] / mean[1];
            assert_true(share > (end ? 0.4 * inside : 0.4) && share < (end ? 1.1 * inside : 0.9));
            if (!(fabs(p[2] - share * mean[0]) < near && fabs(p[0] - share * mean[2]) < near))
                fail_msg("pixel %d of %d is %d, %d, %d, beads %.1f, %.1f, %.1f", x, width, p[2], p[1], p[0], mean[0], mean[1],
                         mean[2]);
        }
        free_strip(s);
    }
}

/* Steel and aluminium in turn, against pixels of every width: no pattern except the real one. */
static void cells_do_not_beat_against_pixels(void **state)
{
    (void)state;
    for (int width = 401; width < 3000; width += 333) {
        struct strip *s = make_strip(width);
        for (int k = 0; k < 2; k++) {
            int low[3] = {255, 255, 255}, high[3] = {0, 0, 0};
            for (size_t i = 0; i < BEADS; i++)
                s->force[i] = k ? 12 : 0;
            draw(s, NULL);
            for (int x = width / 20; x < width - width / 20; x++) {
                for (int c = 0; c < 3; c++) {
                    int level = pixel(s, &s->frame, x)[c];
                    low[c] = level < low[c] ? level : low[c];
                    high[c] = level > high[c] ? level : high[c];
                }
            }
            for (int c = 0; c < 3; c++)
                assert_in_range(high[c] - low[c], 0, 8);
            assert_true(high[1] > 20);
        }
        free_strip(s);
    }
}

/* Two forces of half the size on neighbours in a pixel look like one on either. */
static void pixels_show_means(void **state)
{
    (void)state;
    struct strip *s = make_strip(500); /* 10 beads a pixel */
    uint8_t one[3], two[3];
    s->force[2502] = 30;
    draw(s, NULL);
    memcpy(one, pixel(s, &s->frame, 250), 3);
    s->force[2502] = s->force[2506] = 15;
    draw(s, NULL);
    memcpy(two, pixel(s, &s->frame, 250), 3);
    assert_in_range(difference(one, two), 0, 1);
    free_strip(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pulse_of_one_bead_stays_visible),
        cmocka_unit_test(a_row_at_rest_has_the_colours_of_its_beads),
        cmocka_unit_test(cells_do_not_beat_against_pixels),
        cmocka_unit_test(pixels_show_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
