/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of views as films: a pulse that travels along a chain, drawn by any view into frames of 420 x 150 pixels. */
#ifndef BEADREEL_TESTS_VIEW_FILMS_H
#define BEADREEL_TESTS_VIEW_FILMS_H

#include "tests/scenes.h"

#include "beadreel/view.h"
#include "render/draw/looks.h"
#include "render/paint/canvas.h"
#include "render/stage/camera.h"
#include "render/view/views.h"
#include "sim/chain/chain_data.h"

enum { WIDTH = 420, HEIGHT = 150, FRAMES = 17, ROOM = 64, RUNS = 2 };
static const struct bead_rect page = {0, 0, WIDTH, HEIGHT}, plot = {31, 17, 350, 117};
static const double span = 0x1p-10; /* s: times of frames are exact, also later and slower */

#define DIMERS                                                                                                                   \
    "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 6}, {bead: "     \
    "small-steel, sensor: one}, {bead: large-steel, count: 9}, {bead: large-steel, sensor: two}, {bead: aluminium, count: 3}], " \
    "wall: brass}\noutputs: [{table: a.csv}]\n"
#define PLAIN                                                                                                                 \
    "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 30}]}\noutputs: [{table: " \
    "a.csv}]\n"
#define ONE "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel}]}\noutputs: [{table: a.csv}]\n"
#define STRING                                                                                                                    \
    "chain: {equation: fput, points: 15, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 10}\noutputs: [{table: a.csv, show: " \
    "modes}]\n"

/* Ways to show the same: later, each moment this many times as long, values this many times as large, beads and their distances,
 * too, elsewhere in the frame, as a part of a chain with beads before it, in twice as many samples with those between in the middle
 * of their neighbours, from the other end of a chain of this many beads. */
struct manner {
    double later, slower, stronger, larger; /* 0: as 1 */
    int right, down;
    size_t before;
    bool finely;
    int mirrored; /* 0: is not */
    double swing; /* m: of the first bead, which is slower and faster again */
};

struct film {
    const char *name;
    enum bead_view_kind kind;
    const char *chain;
    enum bead_field field;
    double low, high, rest;
    bool film, light;
    enum bead_orientation orientation;
    double window; /* m; 0: no camera */
    bool hold, ghost, trust, theory, marked, overlaid;
    bool row;               /* stages: of all beads; shaded in frames, flat as paths */
    struct bead_span beads; /* {0, 0}: all */
    enum bead_scale scale;
    int ends; /* px at the ends of the plot where lines end, with a round end or without */
    struct manner as;
};

static double times_or_one(double factor)
{
    return factor > 0 ? factor : 1;
}

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

/* ---- what is shown ---- */

struct fields {
    double value[BEAD_FIELD_COUNT][ROOM];
    struct bead_sample sample;
};

/* A pulse of some beads that travels, and leaves those behind it pushed on. */
static void make_values(const struct manner *as, double at, double values[BEAD_FIELD_COUNT][ROOM])
{
    const double times = times_or_one(as->stronger);
    for (int i = 0; i < ROOM; i++) {
        const bool other = as->mirrored > 0;
        const int bead = other ? as->mirrored - 1 - i : i - (int)as->before;
        const double x = bead - at, contact = x + (other ? -0.5 : 0.5), pulse = times * exp(-0.5 * x * x / 1.5),
                     pushed = times / (1 + exp(1.5 * x));
        const bool touched = x < 7;
        values[BEAD_FIELD_FORCE][i] = touched ? 30 * pulse : 0;
        values[BEAD_FIELD_CONTACT_FORCE][i] = contact < 7 ? times * 33 * exp(-0.5 * contact * contact / 1.5) : 0;
        values[BEAD_FIELD_COMPRESSION][i] = 1e-6 * values[BEAD_FIELD_CONTACT_FORCE][i];
        values[BEAD_FIELD_VELOCITY][i] = touched ? 0.2 * pulse - (bead < 3 ? times * 0.02 * bead : 0) : 0;
        values[BEAD_FIELD_DISPLACEMENT][i] = (touched ? 1e-5 * pushed : 0) + (bead == 0 ? as->swing * sin(at) : 0);
        values[BEAD_FIELD_ENERGY][i] = touched ? 1e-3 * pulse : 0;
    }
}

/* The comparison run's pulse is late from the middle of the span on. `lag`: of another chain. */
static void make_fields(const struct manner *as, struct fields run[RUNS], const struct bead_chain *chain, size_t k, double lag)
{
    const double at = 1.8 * (double)k - lag;
    memset(run, 0, RUNS * sizeof *run);
    make_values(as, at, run[0].value);
    make_values(as, at - (k > FRAMES / 2 ? 0.4 * (double)(k - FRAMES / 2) : 0), run[1].value);
    struct bead_sample *s = &run[0].sample;
    const size_t beads = bead_chain_beads(chain);
    const double time = as->later + times_or_one(as->slower) * span * (double)k / (FRAMES - 1);
    *s = (struct bead_sample){.index = k, .time = time, .active = beads, .comparison_active = beads};
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        s->field[f] = run[0].value[f];
        s->comparison[f] = run[1].value[f];
    }
}

/* In the middle between samples k - 1 and k. */
static void make_middle(const struct manner *as, struct fields run[RUNS], const struct bead_chain *chain, size_t k, double lag)
{
    static struct fields before[RUNS];
    make_fields(as, before, chain, k - 1, lag);
    make_fields(as, run, chain, k, lag);
    run[0].sample.time = 0.5 * (before[0].sample.time + run[0].sample.time);
    for (size_t i = 0; i < RUNS * BEAD_FIELD_COUNT * ROOM; i++) {
        double *to = &run[i / (BEAD_FIELD_COUNT * ROOM)].value[i / ROOM % BEAD_FIELD_COUNT][i % ROOM];
        *to = 0.5 * (*to + before[i / (BEAD_FIELD_COUNT * ROOM)].value[i / ROOM % BEAD_FIELD_COUNT][i % ROOM]);
    }
}

/* ---- views ---- */

/* A view with what it looks through. */
struct shown {
    struct manner as;
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_colormap map;
    struct bead_camera *camera;
    struct bead_canvas *canvas;
    const struct bead_view_type *type;
    struct bead_view *view, *other; /* `other` is drawn by `view` */
    struct bead_frame background, frame;
};

static void enlarge(struct bead_chain *chain, double times)
{
    for (size_t i = 0; i < chain->beads; i++) {
        chain->position[i] *= times;
        chain->radius[i] *= times;
    }
}

/* It is as much elsewhere as the plot. */
static void fill_background(const struct manner *as, struct bead_frame *frame)
{
    for (int y = 0; y < HEIGHT; y++) {
        for (size_t i = 0; i < 4 * WIDTH; i++)
            frame->pixels[(size_t)y * frame->stride + i] = (uint8_t)(20 + 7 * (y + 31 - as->down) % 31 + 3 * (int)(i % 4));
    }
}

static void open_shown(struct shown *s, const struct film *film)
{
    struct bead_message msg = {""};
    *s = (struct shown){.as = film->as, .scene = parse(film->chain), .type = bead_view_find(film->kind)};
    require(bead_chain_create(s->scene, 0, &s->chain, &msg), &msg);
    require(bead_colormap_load("inferno", &s->map, &msg), &msg);
    bead_look_screen(&s->look, 1280, 720, !film->light);
    s->look.line = 4;
    const struct manner *as = &s->as;
    const double slower = times_or_one(as->slower), stronger = times_or_one(as->stronger), larger = times_or_one(as->larger);
    enlarge(s->chain, larger);
    struct bead_view_setup setup = {
        .chain = s->chain,
        .field = film->field,
        .beads = film->beads,
        .time = {as->later, as->later + slower * span},
        .colours = {&s->map, film->scale, stronger * film->low, stronger * film->high, stronger * film->rest},
        .look = &s->look,
        .axes = film->row,
        .orientation = film->orientation,
        .fill = film->film,
        .hold = film->hold,
        .ghost = film->ghost,
        .trust = film->trust,
        .theory = film->theory,
        .marked = film->marked,
        .mark = as->later + 0.375 * slower * span,
        .own_colour = film->overlaid,
        .modes = 5,
        .magnify = 150 * larger / stronger};
    if (setup.beads.last == 0)
        setup.beads.last = bead_chain_beads(s->chain) - 1;
    if (film->window > 0)
        require(bead_camera_create(s->chain, setup.beads, larger * film->window, setup.time, &s->camera, &msg), &msg);
    setup.camera = s->camera;
    require(bead_canvas_create("plain", WIDTH, HEIGHT, &s->canvas, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->background, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->frame, &msg), &msg);
    fill_background(as, &s->background);
    bead_frame_copy(&s->frame, &s->background, page);
    require(s->type->create(&setup, &s->view, &msg), &msg);
    setup.chain_index = 2; /* with dashes */
    if (film->overlaid) {
        require(s->type->create(&setup, &s->other, &msg), &msg);
        require(s->type->overlay(s->view, s->other, &msg), &msg);
    }
    require(s->type->place(s->view, (struct bead_rect){plot.x + as->right, plot.y + as->down, plot.width, plot.height}, s->canvas,
                           &msg),
            &msg);
    cairo_surface_t *paper =
        cairo_image_surface_create_for_data(s->background.pixels, CAIRO_FORMAT_RGB24, WIDTH, HEIGHT, (int)s->background.stride);
    cairo_t *cr = cairo_create(paper);
    require(s->type->decorate(s->view, cr, &msg), &msg);
    cairo_destroy(cr);
    cairo_surface_destroy(paper);
    bead_frame_copy(&s->frame, &s->background, page);
}

static void close_shown(struct shown *s)
{
    s->type->destroy(s->view);
    if (s->other)
        s->type->destroy(s->other);
    bead_camera_destroy(s->camera);
    bead_canvas_destroy(s->canvas);
    bead_frame_free(&s->background);
    bead_frame_free(&s->frame);
    bead_chain_destroy(s->chain);
    bead_scene_free(s->scene);
}

static void feed_chain(struct shown *s, struct bead_view *view, size_t k, double lag)
{
    struct fields run[RUNS];
    struct bead_message msg = {""};
    for (int middle = s->as.finely && k > 0; middle >= 0; middle--) {
        (middle ? make_middle : make_fields)(&s->as, run, s->chain, k, lag);
        require(s->type->feed(view, &run[0].sample, &msg), &msg);
        if (s->camera && view == s->view)
            require(bead_camera_feed(s->camera, &run[0].sample, &msg), &msg);
    }
}

/* Sample `k`; returns its time, or of every other one a time before. */
static double feed(struct shown *s, size_t k)
{
    const double step = span / (FRAMES - 1), at = fmax(0, step * ((double)k - (k % 2 ? 0 : 0.25)));
    const double time = s->as.later + times_or_one(s->as.slower) * at;
    feed_chain(s, s->view, k, 0);
    if (s->camera)
        bead_camera_advance(s->camera, time);
    if (s->other)
        feed_chain(s, s->other, k, 4);
    return time;
}

static void draw(struct shown *s, double time, struct bead_changes *changes)
{
    struct bead_message msg = {""};
    require(s->type->draw(s->view, time, &s->frame, &s->background, changes, &msg), &msg);
}

#endif
