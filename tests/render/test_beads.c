/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Animation: drawing bit by bit gives the same picture as drawing at once, reported changes are true, frames do not depend on
 * threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "beadreel/view.h"
#include "render/draw/looks.h"
#include "render/draw/picture.h"
#include "render/movie/composer.h"
#include "render/movie/film.h"
#include "render/paint/canvas.h"
#include "render/stage/beads.h"
#include "render/stage/camera.h"
#include "render/stage/magnify.h"
#include "render/view/views.h"
#include "sim/chain/chain_internal.h"
#include "tests/sweeps.h"

extern const struct bead_sink_type bead_movie_sink;

#define CHAIN(name, spins)                                                                    \
    "  - name: " name "\n    striker: {bead: large-steel, velocity: 0.443 m/s}\n    beads:\n" \
    "      - {cell: [large-steel, aluminium], count: 20, spins: " spins "}\n"                 \
    "      - {bead: small-steel, sensor: here}\n      - {bead: large-steel, count: 5}\n    wall: brass\n"

static const char scene_text[] = "title: Test\nchains:\n" CHAIN("One", "up")
    CHAIN("Two", "random, magnetism: 0.2, seed: 7") "simulate: {until: 0.8 ms}\n"
                                                    "outputs:\n  - {movie: m.mkv, views: [beads, profile, spacetime, sensors], "
                                                    "size: [640, 480], fps: 20, "
                                                    "duration: 2 s}\n";

struct world {
    struct bead_scene *scene;
    struct bead_chain *chains[2];
};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static struct world make_world(void)
{
    struct world w = {NULL, {NULL, NULL}};
    struct bead_message msg = {""};
    require(bead_scene_parse("test", scene_text, strlen(scene_text), NULL, &w.scene, &msg), &msg);
    for (size_t c = 0; c < 2; c++)
        require(bead_chain_create(w.scene, c, &w.chains[c], &msg), &msg);
    return w;
}

static void free_world(struct world *w)
{
    for (size_t c = 0; c < 2; c++)
        bead_chain_destroy(w->chains[c]);
    bead_scene_free(w->scene);
}

enum { BEADS = 47, FRAMES = 24 };

/* A pulse that travels, beads behind it pushed on, the first ones drifting back. */
static void make_sample(size_t chain, size_t index, double *u, double *f, struct bead_sample *sample)
{
    double time = (double)index * 0.8e-3 / (FRAMES - 1), front = 2.0 * (double)index - 2 * (double)chain;
    for (size_t i = 0; i < BEADS; i++) {
        double x = (double)i - front;
        f[i] = 30 * exp(-0.5 * x * x) * (index > 0);
        u[i] = 1e-5 / (1 + exp(1.3 * x)) - (i < 3 && index > 4 ? 2e-6 * (double)(index - 4) * (double)(3 - i) : 0);
        if (x > 8)
            u[i] = f[i] = 0;
    }
    *sample = (struct bead_sample){.chain = chain, .index = index, .time = time, .active = BEADS};
    sample->field[BEAD_FIELD_FORCE] = f;
    sample->field[BEAD_FIELD_DISPLACEMENT] = u;
}

static void copy_changes(struct bead_frame *to, const struct bead_frame *from, const struct bead_changes *changes)
{
    for (size_t i = 0; i < changes->count; i++) {
        const struct bead_rect *r = &changes->rect[i];
        assert_true(r->x >= 0 && r->y >= 0 && r->x + r->width <= from->width && r->y + r->height <= from->height);
        bead_frame_copy(to, from, *r);
    }
}

/* A view drawn by its changes, the same view drawn whole each time, and a copy updated by the changes that the first one
 * reports. */
struct pair {
    struct bead_view *dirty, *full;
    struct bead_camera *camera; /* NULL: none */
    struct bead_canvas *canvas;
    struct bead_frame background, frame, whole, copy;
    struct bead_colormap map;
    struct bead_look look;
};

/* Where a view is drawn, and on what. */
struct place {
    struct bead_rect plot;
    double window; /* m that a camera shows, 0: there is none */
    bool plain;    /* each row of pixels of the background has one colour */
};

static void make_pair(struct pair *p, const struct world *w, const struct bead_view_type *type, struct place place)
{
    struct bead_message msg = {""};
    *p = (struct pair){.camera = NULL};
    const int width = 900, height = 200;
    bead_look_screen(&p->look, 1280, 720, true);
    require(bead_colormap_load("inferno", &p->map, &msg), &msg);
    struct bead_view_setup setup = {.chain = w->chains[0],
                                    .field = BEAD_FIELD_FORCE,
                                    .beads = {0, bead_chain_beads(w->chains[0]) - 1},
                                    .time = {0, 0.8e-3},
                                    .colours = {&p->map, BEAD_SCALE_SQRT, 0, 35, 0},
                                    .look = &p->look,
                                    .axes = true,
                                    .bead_labels = place.window > 0,
                                    .orientation = BEAD_TIME_DOWN,
                                    .fill = true,
                                    .magnify = 200};
    if (place.window > 0)
        require(bead_camera_create(w->chains[0], setup.beads, place.window, setup.time, &p->camera, &msg), &msg);
    setup.camera = p->camera;
    require(bead_canvas_create(NULL, width, height, &p->canvas, &msg), &msg);
    require(bead_frame_create(width, height, &p->background, &msg), &msg);
    require(bead_frame_create(width, height, &p->frame, &msg), &msg);
    require(bead_frame_create(width, height, &p->whole, &msg), &msg);
    require(bead_frame_create(width, height, &p->copy, &msg), &msg);
    for (size_t i = 0; i < p->background.stride * (size_t)height; i++)
        p->background.pixels[i] = (uint8_t)(20 + (place.plain ? i / p->background.stride : i) * 7 % 31);
    struct bead_view **views[2] = {&p->dirty, &p->full};
    cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cr = cairo_create(paper);
    for (int k = 0; k < 2; k++) {
        require(type->create(&setup, views[k], &msg), &msg);
        require(type->place(*views[k], place.plot, p->canvas, &msg), &msg);
        require(type->decorate(*views[k], cr, &msg), &msg);
    }
    cairo_destroy(cr);
    cairo_surface_destroy(paper);
    struct bead_rect all = {0, 0, width, height};
    bead_frame_copy(&p->frame, &p->background, all);
    bead_frame_copy(&p->whole, &p->background, all);
    bead_frame_copy(&p->copy, &p->background, all);
}

static void free_pair(struct pair *p, const struct bead_view_type *type)
{
    type->destroy(p->dirty);
    type->destroy(p->full);
    bead_camera_destroy(p->camera);
    bead_canvas_destroy(p->canvas);
    bead_frame_free(&p->background);
    bead_frame_free(&p->frame);
    bead_frame_free(&p->whole);
    bead_frame_free(&p->copy);
}

static bool same_pixels(const struct bead_frame *a, const struct bead_frame *b)
{
    int y = 0;
    while (y < a->height && memcmp(a->pixels + (size_t)y * a->stride, b->pixels + (size_t)y * b->stride, 4 * (size_t)a->width) == 0)
        y++;
    return y == a->height && a->width == b->width && a->height == b->height;
}

static void compare_dirty_with_full(const struct bead_view_type *type, struct place place)
{
    struct world w = make_world();
    struct pair p;
    struct bead_message msg = {""};
    double u[BEADS], f[BEADS];
    make_pair(&p, &w, type, place);
    size_t small = 0;
    for (size_t i = 0; i < FRAMES; i++) {
        struct bead_sample sample;
        struct bead_changes changes = {0};
        make_sample(0, i, u, f, &sample);
        if (p.camera) {
            require(bead_camera_feed(p.camera, &sample, &msg), &msg);
            bead_camera_advance(p.camera, sample.time);
        }
        require(type->feed(p.dirty, &sample, &msg), &msg);
        require(type->feed(p.full, &sample, &msg), &msg);
        require(type->draw(p.dirty, sample.time, &p.frame, &p.background, &changes, &msg), &msg);
        require(type->draw(p.full, sample.time, &p.whole, &p.background, NULL, &msg), &msg);
        copy_changes(&p.copy, &p.frame, &changes);
        if (!same_pixels(&p.frame, &p.whole))
            fail_msg("%s: frame %zu differs from the one drawn whole", type->info->name, i);
        if (!same_pixels(&p.frame, &p.copy))
            fail_msg("%s: frame %zu has changes that were not told", type->info->name, i);
        size_t area = 0;
        for (size_t k = 0; k < changes.count; k++)
            area += (size_t)changes.rect[k].width * (size_t)changes.rect[k].height;
        small += area < (size_t)place.plot.width * (size_t)place.plot.height;
    }
    assert_true(place.window > 0 || small > 0); /* and something was saved */
    /* Beads at rest cost nothing. */
    struct bead_changes none = {0};
    struct bead_sample sample;
    make_sample(0, FRAMES - 1, u, f, &sample);
    for (int k = 0; k < 60; k++) {
        none.count = 0;
        sample.time += 1e-4;
        if (p.camera) {
            require(bead_camera_feed(p.camera, &sample, &msg), &msg);
            bead_camera_advance(p.camera, sample.time);
        }
        require(type->feed(p.dirty, &sample, &msg), &msg);
        require(type->draw(p.dirty, sample.time, &p.frame, &p.background, &none, &msg), &msg);
    }
    assert_int_equal(none.count, 0);
    free_pair(&p, type);
    free_world(&w);
}

static void test_beads_with_lens(void **state)
{
    (void)state;
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 20, 780, 160}, 0, false});
}

/* On a plain background beads that have only moved with the lens are moved in the frame. */
static void test_lens_on_plain_background(void **state)
{
    (void)state;
    const double window = 15 * 2 * 9.525e-3 / 2;
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 20, 780, 160}, 0, true});
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 20, 780, 100}, window, true});
}

static void test_beads_in_one_row(void **state)
{
    (void)state;
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 60, 780, 30}, 0, false});
}

static void test_beads_as_strip(void **state)
{
    (void)state;
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 60, 100, 30}, 0, false});
}

static void test_profile(void **state)
{
    (void)state;
    compare_dirty_with_full(&bead_view_profile_type, (struct place){{80, 20, 780, 120}, 0, false});
}

/* A window of 15 of the 47 beads. */
static void test_views_that_move(void **state)
{
    (void)state;
    const double window = 15 * 2 * 9.525e-3 / 2;
    compare_dirty_with_full(&bead_view_beads_type, (struct place){{80, 20, 780, 100}, window, false});
    compare_dirty_with_full(&bead_view_profile_type, (struct place){{80, 20, 780, 120}, window, false});
}

/* Mean brightness of a column of the frame. */
static double brightness(const struct bead_frame *frame, int x, int from, int to)
{
    double sum = 0;
    for (int y = from; y < to; y++)
        sum += frame->pixels[(size_t)y * frame->stride + 4 * (size_t)x + 1];
    return sum / (to - from);
}

/* At rest beads touch; a bead that has moved away leaves a gap where the background shows, and is seen beyond the plot. */
static void test_gaps_show(void **state)
{
    (void)state;
    struct world w = make_world();
    struct pair p;
    struct bead_message msg = {""};
    double u[BEADS] = {0}, f[BEADS] = {0};
    struct bead_rect plot = {80, 60, 780, 30};
    make_pair(&p, &w, &bead_view_beads_type, (struct place){plot, 0, false});
    memset(p.background.pixels, 0, p.background.stride * 200);
    memset(p.frame.pixels, 0, p.frame.stride * 200);
    struct bead_sample sample = {.active = BEADS};
    sample.field[BEAD_FIELD_FORCE] = f;
    sample.field[BEAD_FIELD_DISPLACEMENT] = u;
    const double *position = bead_chain_position(w.chains[0]), *radius = bead_chain_radius(w.chains[0]);
    double scale = plot.width / (position[BEADS - 1] + radius[BEADS - 1] - position[0] + radius[0]);
    int contact = plot.x + (int)floor((position[10] + radius[10] - position[0] + radius[0]) * scale);
    int middle = plot.y + plot.height / 2;
    require(bead_view_beads_type.feed(p.dirty, &sample, &msg), &msg);
    require(bead_view_beads_type.draw(p.dirty, 0, &p.frame, &p.background, NULL, &msg), &msg);
    double touching = brightness(&p.frame, contact, middle - 1, middle + 1);
    for (size_t i = 11; i < BEADS; i++)
        u[i] = 0.6 * radius[10] / 200; /* magnified 200 times */
    u[BEADS - 1] = 3 * radius[10] / 200;
    sample.time = 1e-4;
    require(bead_view_beads_type.feed(p.dirty, &sample, &msg), &msg);
    require(bead_view_beads_type.draw(p.dirty, sample.time, &p.frame, &p.background, NULL, &msg), &msg);
    double apart = brightness(&p.frame, contact + 2, middle - 1, middle + 1);
    assert_true(touching > 20);
    assert_true(apart < 2);
    double beyond = 0;
    for (int x = plot.x + plot.width + 1; x < plot.x + plot.width + 30; x++)
        beyond = fmax(beyond, brightness(&p.frame, x, middle - 1, middle + 1));
    assert_true(beyond > 20);
    free_pair(&p, &bead_view_beads_type);
    free_world(&w);
}

/* From the first bead beside one under force to the second, where a spline swings below zero, the curve runs along it. */
static void test_profiles_of_forces_stay_above_zero(void **state)
{
    (void)state;
    struct world w = make_world();
    struct pair p;
    struct bead_message msg = {""};
    double f[BEADS] = {[20] = 30};
    const struct bead_rect plot = {80, 20, 780, 120};
    struct bead_sample sample = {.active = BEADS};
    make_pair(&p, &w, &bead_view_profile_type, (struct place){plot, 0, true});
    memset(p.background.pixels, 0, p.background.stride * 200);
    bead_frame_copy(&p.frame, &p.background, (struct bead_rect){0, 0, 900, 200});
    sample.field[BEAD_FIELD_FORCE] = f;
    require(bead_view_profile_type.feed(p.dirty, &sample, &msg), &msg);
    require(bead_view_profile_type.draw(p.dirty, 0, &p.frame, &p.background, NULL, &msg), &msg);
    const double pitch = (double)plot.width / BEADS;
    const int bottom = plot.y + plot.height - 1;
    double line = brightness(&p.frame, plot.x + (int)(40.5 * pitch), bottom, bottom + 1);
    assert_true(line > 20);
    for (int side = -1; side <= 1; side += 2) {
        for (double beads = 1.1; beads < 1.9; beads += 0.1) {
            const int x = plot.x + (int)((20.5 + side * beads) * pitch);
            if (brightness(&p.frame, x, bottom, bottom + 1) < 0.9 * line)
                fail_msg("%g beads beside the force: %g, not %g", side * beads, brightness(&p.frame, x, bottom, bottom + 1), line);
        }
    }
    free_pair(&p, &bead_view_profile_type);
    free_world(&w);
}

static uint8_t level_at(const struct bead_frame *frame, int x, int y, int channel)
{
    return frame->pixels[(size_t)y * frame->stride + 4 * (size_t)x + (size_t)channel];
}

/* The line above the way to the lens has the length and place in the row of the part shown by the lens; it does not leave the
 * plot. */
static void test_what_the_lens_shows_is_marked(void **state)
{
    (void)state;
    struct world w = make_world();
    struct pair p;
    struct bead_message msg = {""};
    double u[BEADS], f[BEADS];
    make_pair(&p, &w, &bead_view_beads_type, (struct place){{80, 20, 780, 160}, 0, true});
    for (size_t i = 0; i < FRAMES; i++) {
        struct bead_sample sample;
        struct bead_changes changes = {0};
        make_sample(0, i, u, f, &sample);
        require(bead_view_beads_type.feed(p.dirty, &sample, &msg), &msg);
        require(bead_view_beads_type.feed(p.full, &sample, &msg), &msg);
        require(bead_view_beads_type.draw(p.dirty, sample.time, &p.frame, &p.background, &changes, &msg), &msg);
        const struct bead_view *v = p.dirty;
        const int y = v->area.y + v->zoom.y, accent = (int)lround(255 * v->look.accent.r);
        int first = 0, last = 0;
        for (int x = 1; x < 900; x++) { /* the slanted lines that go on from its ends are paler */
            const double behind = level_at(&p.background, x, y, 2),
                         part = (level_at(&p.frame, x, y, 2) - behind) / (accent - behind);
            first = part > 0.6 && first == 0 ? x : first;
            last = part > 0.6 ? x + 1 : last;
        }
        const double length = v->lens.rect.width * v->row.scale / v->lens.scale,
                     left = v->row.left + (v->lens.from - v->row.from) * v->row.scale;
        const double from = fmax(80 - v->area.x - v->look.gap, left), to = fmin(80 + 780 - v->area.x, left + length);
        if (fabs(first - v->area.x - from) > 1.5 || fabs(last - v->area.x - to) > 1.5)
            fail_msg("frame %zu: marked from %d to %d, shown from %.1f to %.1f", i, first - v->area.x, last - v->area.x, from, to);
        assert_true(length < 0.6 * v->area.width);
    }
    /* Also as paths, without a frame before, the lens is full of beads. */
    cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 900, 200);
    cairo_t *cr = cairo_create(paper);
    const struct bead_view *v = p.full;
    require(bead_view_beads_type.decorate(p.full, cr, &msg), &msg);
    cairo_surface_flush(paper);
    const uint8_t *ground = cairo_image_surface_get_data(paper) +
                            (size_t)(v->area.y + v->lens.rect.y) * (size_t)cairo_image_surface_get_stride(paper) +
                            4 * (size_t)(v->area.x + v->lens.rect.x);
    const double panel[] = {p.look.panel.b, p.look.panel.g, p.look.panel.r};
    for (int c = 0; c < 3; c++)
        assert_true(fabs(ground[c] - 255 * panel[c]) < 1);
    require(bead_view_beads_type.vector(p.full, 0.8e-3, cr, &msg), &msg);
    cairo_surface_flush(paper);
    const uint8_t *row = cairo_image_surface_get_data(paper) +
                         (size_t)(v->area.y + (int)v->lens.middle) * (size_t)cairo_image_surface_get_stride(paper);
    int inked = 0;
    for (int x = 0; x < v->lens.rect.width; x++)
        inked += row[4 * (v->area.x + v->lens.rect.x + x) + 1] > 30;
    assert_true(inked > v->lens.rect.width / 2);
    cairo_destroy(cr);
    cairo_surface_destroy(paper);
    free_pair(&p, &bead_view_beads_type);
    free_world(&w);
}

/* Beads that overlap end at one plane, which parts their distance as their radii do; others are whole. Returns how many do. */
static size_t count_pressed(const struct bead_composed *beads)
{
    size_t pressed = 0;
    for (size_t i = 0; i + 1 < beads->count; i++) {
        const struct bead_ball *a = &beads->balls[i], *b = a + 1;
        const float distance = b->x - a->x, both = a->r + b->r;
        if (distance < both)
            assert_true(a->right == b->left && fabsf(a->right - a->x - distance * a->r / both) < 1e-3f);
        else
            assert_true(a->right >= a->x + a->r && b->left <= b->x - b->r);
        pressed += distance < both;
    }
    return pressed;
}

/* The striker's arrow is as long as it is for its first speed times the part that is left; a bead has the mean of the forces of its
 * contacts, at the ends its only one. */
static void test_arrows_and_means(void **state)
{
    (void)state;
    static const double parts[] = {1, 0.6, 0.3, 1.5};
    double length[4];
    for (size_t k = 0; k < 4; k++) {
        struct bead_message msg = {""};
        struct bead_look look;
        struct bead_colormap map;
        struct bead_chain *chain;
        struct bead_view *view;
        struct bead_scene *scene = parse("chain: {striker: {bead: small-steel, velocity: 2 m/s}, beads: [{bead: large-steel, "
                                         "count: 7}]}\noutputs: [{table: t.csv}]\n");
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        require(bead_colormap_load("inferno", &map, &msg), &msg);
        bead_look_screen(&look, 1280, 720, true);
        const struct bead_view_setup setup = {.chain = chain,
                                              .field = BEAD_FIELD_CONTACT_FORCE,
                                              .beads = {0, 7},
                                              .time = {0, 1e-3},
                                              .colours = {&map, BEAD_SCALE_LINEAR, 0, 40, 0},
                                              .look = &look,
                                              .magnify = 1};
        require(bead_view_beads_type.create(&setup, &view, &msg), &msg);
        require(bead_view_beads_type.place(view, (struct bead_rect){100, 10, 700, 160}, NULL, &msg), &msg);
        for (size_t i = 0; i < 2; i++) {
            double u[8] = {i ? 2 * parts[k] * 1e-6 : 0, 0, 1e-3}, force[8] = {4, 8, 16, 0, 0, 10, 3};
            struct bead_sample sample = {.time = 1e-6 * (double)i, .index = i, .active = 8};
            sample.field[BEAD_FIELD_CONTACT_FORCE] = force;
            sample.field[BEAD_FIELD_DISPLACEMENT] = u;
            require(bead_view_beads_type.feed(view, &sample, &msg), &msg);
        }
        cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 900, 180);
        cairo_t *cr = cairo_create(paper);
        require(bead_view_beads_type.vector(view, 1e-6, cr, &msg), &msg);
        const struct bead_drawing *d = &view->row_drawing;
        length[k] = 0;
        assert_true(count_pressed(&d->now) > 0); /* the third moved to the fourth */
        for (size_t i = 0; i < d->now.mark_count; i++) {
            const float *box = d->now.marks[i].box;
            if (d->now.marks[i].kind != BEAD_MARK_ARROW)
                continue;
            length[k] += box[2] - box[0];
            const struct bead_ball *ball = &d->now.balls[0]; /* about its middle, clear of it */
            assert_true(fabs(box[3] - ball->y - (ball->y - box[1])) < 0.05 && fabs(box[3] - ball->y - 0.55 * ball->r) < 0.05);
            assert_true(fabs(ball->x - 1.25 * ball->r - box[2]) < 0.05);
        }
        assert_true(length[k] > 0);
        static const double means[] = {4, 6, 12, 8, 0, 5, 6.5, 3};
        for (size_t i = 0; i < 8; i++)
            assert_true(view->value[view->latest.newest][i] == means[i]);
        cairo_destroy(cr);
        cairo_surface_destroy(paper);
        bead_view_beads_type.destroy(view);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
    for (size_t k = 1; k < 4; k++) /* faster than at first, a fifth at most */
        assert_true(fabs(length[k] / length[0] - fmin(parts[k], 1.2)) < 0.5 / length[0]);
}

/* The ends of a string are as far beyond its outermost masses as these are from each other. */
static void test_strings_have_fixed_ends(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_look look;
    struct bead_colormap map;
    struct bead_chain *chain;
    struct bead_view *view;
    struct bead_scene *scene = parse("chain: {equation: fput, points: 7, start: {mode: 1, amplitude: 1}}\n"
                                     "simulate: {until: 10}\noutputs: [{table: a.csv, show: modes}]\n");
    assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
    require(bead_colormap_load("inferno", &map, &msg), &msg);
    bead_look_screen(&look, 1280, 720, true);
    const struct bead_view_setup setup = {.chain = chain,
                                          .field = BEAD_FIELD_DISPLACEMENT,
                                          .beads = {0, 6},
                                          .time = {0, 10},
                                          .colours = {&map, BEAD_SCALE_LINEAR, -1, 1, 0},
                                          .look = &look,
                                          .magnify = 1};
    require(bead_view_beads_type.create(&setup, &view, &msg), &msg);
    const double *at = bead_chain_position(chain), apart = at[1] - at[0];
    assert_true(fabs(view->ends[0] - (at[0] - apart)) < 1e-9 && fabs(view->ends[1] - (at[6] + apart)) < 1e-9);
    bead_view_beads_type.destroy(view);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Also as paths, in PDF and SVG, each sensor has its ring, with the striker in the picture and without. */
static void test_sensors_have_rings_as_paths(void **state)
{
    (void)state;
    static const struct bead_rect plot = {10, 10, 880, 160};
    for (size_t k = 0; k < 2; k++) {
        char text[400];
        struct bead_message msg = {""};
        struct bead_look look;
        struct bead_colormap map;
        struct bead_chain *chain;
        struct bead_view *view;
        snprintf(
            text, sizeof text,
            "chain: {striker: {bead: large-steel, velocity: %zu m/s}, beads: [{bead: large-steel, count: 2}, {bead: aluminium, "
            "sensor: a}, {bead: large-steel, count: 3}, {bead: aluminium, sensor: b}]}\noutputs: [{table: t.csv}]\n",
            k);
        struct bead_scene *scene = parse(text);
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        require(bead_colormap_load("inferno", &map, &msg), &msg);
        bead_look_screen(&look, 1280, 720, true);
        const struct bead_view_setup setup = {.chain = chain,
                                              .field = BEAD_FIELD_FORCE,
                                              .beads = {1 - k, bead_chain_beads(chain) - 1},
                                              .time = {0, 1e-3},
                                              .colours = {&map, BEAD_SCALE_LINEAR, 0, 40, 0},
                                              .look = &look,
                                              .magnify = 1};
        require(bead_view_beads_type.create(&setup, &view, &msg), &msg);
        require(bead_view_beads_type.place(view, plot, NULL, &msg), &msg);
        double zeros[16] = {0};
        struct bead_sample sample = {.active = bead_chain_beads(chain)};
        sample.field[BEAD_FIELD_FORCE] = sample.field[BEAD_FIELD_DISPLACEMENT] = zeros;
        require(bead_view_beads_type.feed(view, &sample, &msg), &msg);
        cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 900, 180);
        cairo_t *cr = cairo_create(paper);
        require(bead_view_beads_type.vector(view, 0, cr, &msg), &msg);
        cairo_surface_flush(paper);
        const uint8_t *pixels = cairo_image_surface_get_data(paper);
        const int stride = cairo_image_surface_get_stride(paper), ink = (int)lround(255 * look.ink.g);
        size_t sensors, ringed = 0;
        const struct bead_sensor *sensor = bead_chain_sensors(chain, &sensors);
        assert_int_equal(sensors, 2);
        for (size_t i = 0; i < view->count; i++) {
            assert_true(view->load[i] == 0); /* nor does anything glow, where nothing has pressed yet */
            /* In its ring, at its lower left, where the ball itself is darkest. */
            const double r = view->radius[i] * view->row.scale, in = r - 0.5 * fmax(1.2, 0.07 * r);
            const double x = view->area.x + bead_window_x(&view->row, view->position[i]) - in * sqrt(0.5),
                         y = view->area.y + view->row.middle + in * sqrt(0.5);
            const bool ring = abs(pixels[(int)y * stride + 4 * (int)x + 1] - ink) < 40;
            const size_t bead = view->first + i;
            if (ring != (bead == sensor[0].bead || bead == sensor[1].bead)) /* the striker's has another colour */
                fail_msg("bead %zu, at %g, %g: %d", bead, x, y, ring);
            ringed += ring;
        }
        assert_int_equal(ringed, 2);
        cairo_destroy(cr);
        cairo_surface_destroy(paper);
        bead_view_beads_type.destroy(view);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* Whole frames, all views: a copy that only gets the reported changes stays equal. */
static void compare_copies(enum bead_follow follow)
{
    struct world w = make_world();
    struct bead_message msg = {""};
    struct bead_composer *composer;
    struct bead_frame copy;
    double u[BEADS], f[BEADS];
    struct bead_caption captions[] = {{1e-4, 3e-4, NAN, 0, "F_{max}"}, {5e-4, NAN, NAN, 0, "the last"}};
    struct bead_output changed = w.scene->outputs[0];
    const struct bead_output *output = &changed;
    changed.movie.follow = follow;
    changed.movie.window = 12;
    changed.movie.captions = captions;
    changed.movie.caption_count = 2;
    struct bead_composer_setup setup = {.output = output,
                                        .chains = (const struct bead_chain *const *)w.chains,
                                        .chain_count = 2,
                                        .title = "Test",
                                        .width = 640,
                                        .height = 480,
                                        .time = {0, 0.8e-3},
                                        .step = 0.8e-3 / (FRAMES - 1),
                                        .range = {.high = 35}};
    assert_int_equal(bead_composer_fields(output, w.chains[0]),
                     BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT));
    require(bead_composer_create(&setup, &composer, &msg), &msg);
    require(bead_composer_open(composer, &msg), &msg);
    require(bead_frame_create(640, 480, &copy, &msg), &msg);
    struct bead_changes card = {0};
    require(bead_composer_card(composer, &card, &msg), &msg);
    copy_changes(&copy, bead_composer_frame(composer), &card);
    for (size_t i = 0; i < FRAMES; i++) {
        struct bead_changes changes = {0};
        struct bead_sample sample;
        for (size_t c = 0; c < 2; c++) {
            make_sample(c, i, u, f, &sample);
            require(bead_composer_feed(composer, &sample, &msg), &msg);
        }
        require(bead_composer_draw(composer, sample.time, &changes, &msg), &msg);
        copy_changes(&copy, bead_composer_frame(composer), &changes);
        if (bead_frame_hash(&copy) != bead_frame_hash(bead_composer_frame(composer)))
            fail_msg("frame %zu has changes that were not told", i);
    }
    bead_frame_free(&copy);
    bead_composer_close(composer);
    bead_composer_destroy(composer);
    free_world(&w);
}

static void test_frames_tell_their_changes(void **state)
{
    (void)state;
    compare_copies(BEAD_FOLLOW_ALL);
    compare_copies(BEAD_FOLLOW_FRONT);
}

static char *read_all(const char *path)
{
    char *text = calloc(1, 1 << 16);
    FILE *file = fopen(path, "r");
    assert_non_null(text);
    assert_non_null(file);
    assert_true(fread(text, 1, (1 << 16) - 1, file) > 0);
    fclose(file);
    return text;
}

/* The sink's whole way, from samples to hashes of encoded frames, with samples that come more often than frames. */
static char *run_with_threads(const char *directory, int threads, struct bead_grid native)
{
    struct world w = make_world();
    struct bead_caption captions[] = {{1e-4, NAN, NAN, 0, "something happens"}};
    struct bead_output output = w.scene->outputs[0];
    struct bead_message msg = {""};
    struct bead_sink *sink;
    struct bead_needs needs;
    char name[] = "m.hash", result[300];
    double u[BEADS], f[BEADS];
    output.movie.follow = BEAD_FOLLOW_FRONT;
    output.movie.window = 10;
    output.movie.captions = captions;
    output.movie.caption_count = 1;
    output.path = name; /* a codec for tests; scenes cannot choose it */
    struct bead_run_context context = {.scene = w.scene,
                                       .chains = (const struct bead_chain *const *)w.chains,
                                       .chain_count = 2,
                                       .end = 0.8e-3,
                                       .native = native,
                                       .resolution = 5e-6,
                                       .threads = threads,
                                       .directory = directory};
    require(bead_movie_sink.create(&output, &context, &sink, &msg), &msg);
    bead_movie_sink.needs(sink, &needs);
    assert_true(needs.range && needs.range_field == BEAD_FIELD_FORCE);
    require(bead_movie_sink.begin(sink, (struct bead_range){0, 33}, &msg), &msg);
    for (size_t i = 0; i < bead_grid_count(&needs.grid); i++) {
        for (size_t c = 0; c < 2; c++) {
            struct bead_sample sample;
            double time = bead_grid_time(&needs.grid, i);
            make_sample(c, (size_t)(time / 0.8e-3 * FRAMES), u, f, &sample);
            sample.index = i;
            sample.time = time;
            require(bead_movie_sink.sample(sink, &sample, &msg), &msg);
        }
    }
    require(bead_movie_sink.end(sink, NULL, &msg), &msg);
    bead_movie_sink.destroy(sink);
    free_world(&w);
    snprintf(result, sizeof result, "%s/m.hash", directory);
    char *text = read_all(result);
    remove(result);
    return text;
}

static void check_threads(const char *directory, struct bead_grid native)
{
    char *one = run_with_threads(directory, 1, native), *two = run_with_threads(directory, 2, native);
    char *more = run_with_threads(directory, 5, native);
    size_t lines = 0, distinct = 0;
    for (const char *at = one; *at; at += 17) {
        lines++;
        distinct += at == one || strncmp(at, at - 17, 16) != 0;
    }
    assert_int_equal(lines, 40);
    assert_int_equal(distinct, 40); /* no two frames alike: something moves */
    assert_string_equal(one, two);
    assert_string_equal(one, more);
    free(one);
    free(two);
    free(more);
}

static void test_frames_do_not_depend_on_threads(void **state)
{
    (void)state;
    char directory[256];
    snprintf(directory, sizeof directory, "%s/beadreel-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(directory));
    check_threads(directory, (struct bead_grid){.every = 0});
    check_threads(directory, (struct bead_grid){.every = 3e-6, .end = 0.8e-3}); /* samples that fall between frames */
    check_threads(directory, (struct bead_grid){.every = 5e-5, .end = 0.8e-3}); /* fewer samples than frames */
    rmdir(directory);
}

static void test_magnification(void **state)
{
    (void)state;
    struct world w = make_world();
    double d = bead_compression_scale(w.chains[0]), factor = bead_magnify_auto((const struct bead_chain *const *)w.chains, 2);
    /* Two masses and Hertz: d = (5 m v^2 / 4 A)^(2/5), m the reduced mass of two steel beads. */
    double m = 0.5 * 3.63e-3, v = 0.443, a = bead_chain_stiffness(w.chains[0])[0];
    assert_true(fabs(d / pow(5 * m * v * v / (4 * a), 0.4) - 1) < 1e-6);
    assert_true(factor * d <= 0.25 * 4.76e-3 && factor * d > 0.1 * 4.76e-3);
    free_world(&w);
}

/* The factor is no more than a quarter of a bead allows, and at most a third less: 1, 1.5, 2, 3, 4, 5, 6, 8 of any power of ten. */
static void test_magnification_is_as_large_as_can_be(void **state)
{
    (void)state;
    static const double first[] = {1, 1.5, 2, 3, 4, 5, 6, 8};
    unsigned met = 0;
    for (int i = 0; i < 60; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "chain: {striker: {bead: large-steel, velocity: %g m/s}, beads: [{bead: large-steel, count: 4}]}\n"
                 "outputs: [{movie: a.mp4}]\n",
                 pow(10, -2 + i / 30.0));
        struct bead_scene *scene = parse(text);
        struct bead_chain *chain;
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        const double factor = bead_magnify_auto((const struct bead_chain *const *)&chain, 1);
        const double part = factor * bead_compression_scale(chain) / bead_chain_radius(chain)[0];
        for (unsigned k = 0; k < 8; k++)
            met |= (fabs(factor / pow(10, floor(log10(factor))) - first[k]) < 1e-9) << k;
        if (!(part <= 0.25 && part > 0.25 / 1.5))
            fail_msg("%g times: %g of a radius", factor, part);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
    assert_int_equal(met, 0xff);
}

/* Heavy beads press the light one between them with all their energy, whether it is struck first or later: as drawn, no contact
 * takes more than half of its radius. Compressions by Hertz's law, from the energy of the two heavy beads' relative motion. */
static void test_magnification_of_light_beads(void **state)
{
    (void)state;
    static const char *const beads[] = {
        "{bead: large-steel, radius: 2 mm}, {bead: large-steel, radius: 10 mm, count: 2}",
        "{bead: large-steel, radius: 10 mm}, {bead: large-steel, radius: 2 mm}, {bead: large-steel, radius: 10 mm}"};
    for (size_t i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "chain: {striker: {bead: large-steel, radius: 10 mm, velocity: 1 m/s}, beads: [%s]}\noutputs: [{movie: a.mp4}]\n",
                 beads[i]);
        struct bead_scene *scene = parse(text);
        struct bead_chain *chain;
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        const double factor = bead_magnify_auto((const struct bead_chain *const *)&chain, 1), *mass = bead_chain_mass(chain);
        for (size_t k = i; k < i + 2; k++) {
            const double energy = 0.25 * mass[0], d = pow(2.5 * energy / bead_chain_stiffness(chain)[k], 0.4);
            assert_true(factor * d <= 0.5 * 2e-3 && factor * d > 0.25 * 2e-3);
        }
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* Beads on pendulums swing by v sqrt(l/g) and more than collisions press them: as drawn, no further than to the next place. */
static void test_magnification_of_swings(void **state)
{
    (void)state;
    static const char *const held[] = {"cradle: {length: 20 cm}", "cradle: {length: 2 mm}", ""};
    for (size_t i = 0; i < 3; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "chain:\n  striker: {bead: large-steel, velocity: 0.01 m/s}\n  beads: [{bead: large-steel, count: 4}]\n  %s\n"
                 "simulate: {until: 1 s}\noutputs: [{movie: a.mp4}]\n",
                 held[i]);
        struct bead_scene *scene = parse(text);
        struct bead_chain *chain;
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        const double length = i == 0 ? 0.2 : 2e-3, swing = i < 2 ? 0.01 * sqrt(length / 9.80665) : 0;
        assert_true(fabs(bead_chain_swing(chain) - swing) <= 1e-12 * swing);
        const double factor = bead_magnify_auto((const struct bead_chain *const *)&chain, 1), radius = bead_chain_radius(chain)[0];
        assert_true(factor * swing <= 2 * radius && factor >= 1);
        assert_true(i == 2 ? factor > 100 : factor * swing > radius);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_magnification_of_light_beads),
        cmocka_unit_test(test_beads_with_lens),
        cmocka_unit_test(test_lens_on_plain_background),
        cmocka_unit_test(test_beads_in_one_row),
        cmocka_unit_test(test_beads_as_strip),
        cmocka_unit_test(test_profile),
        cmocka_unit_test(test_views_that_move),
        cmocka_unit_test(test_gaps_show),
        cmocka_unit_test(test_profiles_of_forces_stay_above_zero),
        cmocka_unit_test(test_what_the_lens_shows_is_marked),
        cmocka_unit_test(test_arrows_and_means),
        cmocka_unit_test(test_strings_have_fixed_ends),
        cmocka_unit_test(test_sensors_have_rings_as_paths),
        cmocka_unit_test(test_frames_tell_their_changes),
        cmocka_unit_test(test_frames_do_not_depend_on_threads),
        cmocka_unit_test(test_magnification),
        cmocka_unit_test(test_magnification_is_as_large_as_can_be),
        cmocka_unit_test(test_magnification_of_swings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
