/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage: all painters agree, light rises with force, the camera stands still and follows the wave, beads are where they belong.
 */
#include "tests/scenes.h"

#include "beadreel/view.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/paint/canvas.h"
#include "render/paint/paint.h"
#include "render/paint/pixel_kernels.h"
#include "render/stage/stage_key.h"
#include "render/stage/stage_view.h"
#include "render/view/views.h"
#include "sim/chain/system.h"
#include "tests/eyes.h"
#include "tests/missing.h"
#include "tests/painting.h"

enum { WIDTH = 620, HEIGHT = 190, BEADS_SHOWN = 12 };

/* ---- stages without a chain ---- */

static const struct bead_stage_theme *const themes[] = {&bead_stage_dark, &bead_stage_light};

static void open_stage(struct bead_stage *s, const struct bead_stage_theme *theme, float unit)
{
    struct bead_message msg = {""};
    *s = (struct bead_stage){.theme = theme, .width = WIDTH, .height = HEIGHT, .unit = unit, .centre = 80, .room = BEADS_SHOWN};
    require(bead_stage_open(s, &msg), &msg);
}

/* The plane in which two neighbours touch: the tangent of both. */
static void touch(const struct bead_stage *s, struct bead_stage_bead *a, struct bead_stage_bead *b)
{
    const float dx = b->x - a->x, rise = b->r - a->r, distance = hypotf(dx, rise), part = a->r / (a->r + b->r);
    const float slope = -BEAD_STAGE_COSINE * rise / dx, high = BEAD_STAGE_COSINE * (a->r + rise * part);
    a->edge[1] = b->edge[0] = roundf(64 * (a->x + dx * part - slope * high)) / 64;
    a->slope[1] = b->slope[0] = slope;
    a->tilt[1] = rise / distance;
    b->tilt[0] = -a->tilt[1];
    a->near[1] = b->near[0] = fminf(1, fmaxf(0, 1.15f - (distance - a->r - b->r) / (0.58f * s->unit)));
}

/* Unlike beads of all colours, touching, apart and pressed into each other, some lit; a wall. */
static void fill_stage(struct bead_stage *s, uint32_t seed)
{
    float x = -10;
    s->count = BEADS_SHOWN;
    for (int i = 0; i < BEADS_SHOWN; i++) {
        struct bead_stage_bead *b = &s->beads[i];
        *b = (struct bead_stage_bead){
            .x = x, .r = roundf(4 * random_place(&seed, 0.4 * s->unit, s->unit)) / 4, .edge = {-INFINITY, INFINITY}};
        for (int c = 0; c < 3; c++)
            b->colour[c] = random_place(&seed, 0.05, 1);
        if (i > 0) {
            const float gap = random_place(&seed, -0.2 * s->unit, 0.4 * s->unit);
            b->x = roundf(64 * (x + 2 * sqrtf(b->r * b[-1].r) + fmaxf(gap, -0.2f * b->r))) / 64;
            touch(s, b - 1, b);
            bead_stage_glow(random_place(&seed, -0.5, 1), b->light[0]);
            memcpy(b[-1].light[1], b->light[0], sizeof b->light[0]);
        }
        x = b->x;
    }
    s->wall = (struct bead_stage_wall){.x = x + s->beads[BEADS_SHOWN - 1].r + 0.25f, .width = s->unit, .colour = {.1f, .2f, .3f}};
    s->beads[BEADS_SHOWN - 1].edge[1] = s->wall.x;
    bead_stage_glow(0.6, s->wall.light);
}

static const struct bead_rect place = {13, 5, WIDTH, HEIGHT};

static void paint(const char *canvas, const struct bead_stage_theme *theme, uint32_t seed, struct bead_frame *frame)
{
    struct bead_message msg = {""};
    struct bead_canvas *c;
    struct bead_stage s;
    require(bead_canvas_create(canvas, WIDTH + 7, HEIGHT + 9, &c, &msg), &msg);
    require(bead_frame_create(WIDTH + 40, HEIGHT + 20, frame, &msg), &msg);
    open_stage(&s, theme, (float)(20 + seed % 40));
    fill_stage(&s, seed);
    require(bead_stage_prepare(&s, &msg), &msg);
    require(bead_paint_stage(c, &s, place, 7, frame, &msg), &msg);
    bead_stage_close(&s);
    bead_canvas_destroy(c);
}

static void painters_agree(void **state)
{
    static const char *const others[] = {"osmesa", "egl"};
    struct bead_message msg = {""};
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct bead_canvas *c;
        if (bead_canvas_create(others[k], 1, 1, &c, &msg))
            skip_without("OSMesa or EGL (libosmesa6, libegl1)");
        bead_canvas_destroy(c);
        for (uint32_t seed = 0; seed < 12; seed++) {
            struct bead_frame plain, other;
            int most = 0;
            paint("plain", themes[seed % 2], 7 * seed, &plain);
            paint(others[k], themes[seed % 2], 7 * seed, &other);
            for (size_t i = 0; i < plain.stride * (size_t)plain.height; i++)
                most = i % 4 < 3 && abs(plain.pixels[i] - other.pixels[i]) > most ? abs(plain.pixels[i] - other.pixels[i]) : most;
            if (most > 3)
                fail_msg("%s, stage %u: levels differ by %d", others[k], seed, most);
            bead_frame_free(&plain);
            bead_frame_free(&other);
        }
    }
}

static void instruction_sets_give_the_same_pixels(void **state)
{
    static const char *const names[] = {"portable", "sse2", "avx2", "avx512"};
    struct bead_message msg = {""};
    (void)state;
    for (uint32_t seed = 0; seed < 6; seed++) {
        struct bead_frame frame[4] = {0};
        for (int k = 0; k < 4; k++) {
            const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(names[k]);
            struct bead_stage s;
            require(bead_frame_create(WIDTH + 40, HEIGHT + 20, &frame[k], &msg), &msg);
            if (!kernels)
                continue; /* not on this machine */
            open_stage(&s, themes[seed % 2], (float)(20 + 9 * seed));
            fill_stage(&s, seed);
            require(bead_stage_prepare(&s, &msg), &msg);
            kernels->stage_floor(&s);
            const struct bead_ground ground = {frame[k].pixels, frame[k].stride, {13, 5}, {3, 7, WIDTH - 8, HEIGHT - 9}};
            kernels->stage(&ground, &s);
            bead_stage_close(&s);
            assert_memory_equal(frame[0].pixels, frame[k].pixels, frame[0].stride * (size_t)frame[0].height);
        }
        assert_int_equal(frame[0].pixels[3 + 4 * 20 + 30 * frame[0].stride], 255);
        for (int k = 0; k < 4; k++)
            bead_frame_free(&frame[k]);
    }
}

/* ---- fine stages ---- */

static void paint_fine(const char *canvas, uint32_t seed, int fine, struct bead_frame *frame)
{
    struct bead_message msg = {""};
    struct bead_canvas *c;
    struct bead_stage coarse, s;
    open_stage(&coarse, themes[seed % 2], (float)(20 + seed % 40));
    fill_stage(&coarse, seed);
    const float times = (float)fine;
    s = (struct bead_stage){.fine = fine, .theme = coarse.theme, .width = fine * WIDTH, .height = fine * HEIGHT};
    s.unit = times * coarse.unit;
    s.centre = times * coarse.centre;
    s.room = s.count = coarse.count;
    require(bead_stage_open(&s, &msg), &msg);
    for (size_t i = 0; i < s.count; i++) {
        struct bead_stage_bead *b = &s.beads[i];
        *b = coarse.beads[i];
        b->x *= times;
        b->r *= times;
        b->edge[0] *= times;
        b->edge[1] *= times;
    }
    s.wall = coarse.wall;
    s.wall.x *= times;
    s.wall.width *= times;
    require(bead_canvas_create(canvas, WIDTH, HEIGHT, &c, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, frame, &msg), &msg);
    require(bead_stage_prepare(&s, &msg), &msg);
    require(bead_paint_stage(c, &s, (struct bead_rect){0, 0, WIDTH, HEIGHT}, 0, frame, &msg), &msg);
    bead_stage_close(&s);
    bead_stage_close(&coarse);
    bead_canvas_destroy(c);
}

/* Mean square of what two pictures differ by, levels. */
static double difference(const struct bead_frame *a, const struct bead_frame *b)
{
    double sum = 0;
    for (size_t i = 0; i < a->stride * (size_t)a->height; i++)
        sum += (a->pixels[i] - b->pixels[i]) * (a->pixels[i] - b->pixels[i]);
    return sum / (WIDTH * HEIGHT * 3);
}

/* Fine stages look as those of films do, whose beads stand on whole pixels, by half a pixel too high or low, and are moved by
 * blending two: what a fine one shows is among what their neighbours show there,
 * but for gaps narrower than a pixel. At edges they are nearer to the truth, that of 9 x
 * 9 values a pixel. On all canvases they are the same. */
static void fine_stages_look_the_same(void **state)
{
    struct bead_message msg = {""};
    struct bead_canvas *c;
    const bool has_gl = !bead_canvas_create("osmesa", 1, 1, &c, &msg);
    (void)state;
    if (has_gl)
        bead_canvas_destroy(c);
    for (uint32_t seed = 1; seed < 7; seed++) {
        struct bead_frame film, fine, truth, other;
        paint_fine("plain", 7 * seed, 1, &film);
        paint_fine("plain", 7 * seed, 3, &fine);
        paint_fine("plain", 7 * seed, 9, &truth);
        paint_fine(has_gl ? "osmesa" : "plain", 7 * seed, 3, &other);
        assert_memory_equal(fine.pixels, other.pixels, fine.stride * HEIGHT);
        int outside = 0;
        for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
            const int x = i / 3 % WIDTH, y = i / 3 / WIDTH;
            int low = 255, high = 0;
            for (int k = 0; k < 25; k++) {
                const int nx = x + k % 5 - 2, ny = y + k / 5 - 2;
                if (nx < 0 || nx >= WIDTH || ny < 0 || ny >= HEIGHT)
                    continue;
                const int level = film.pixels[(size_t)ny * film.stride + 4 * (size_t)nx + i % 3];
                low = level < low ? level : low;
                high = level > high ? level : high;
            }
            const int level = fine.pixels[(size_t)y * fine.stride + 4 * (size_t)x + i % 3];
            outside += level < low - 3 || level > high + 3;
        }
        if (getenv("SHOW"))
            printf("stage %u: %.2f, fine %.2f; %d outside\n", seed, difference(&film, &truth), difference(&fine, &truth), outside);
        assert_true(outside < 3 * WIDTH * HEIGHT / 1000);
        assert_true(difference(&fine, &truth) < 0.25 * difference(&film, &truth));
        bead_frame_free(&film);
        bead_frame_free(&fine);
        bead_frame_free(&truth);
        bead_frame_free(&other);
    }
}

/* Mean lightness of a square of 8 x 8 pixels, over which levels are rounded in turn. */
static double lightness(const struct bead_frame *f, int x, int y)
{
    double sum = 0;
    for (int k = 0; k < 64; k++) {
        const uint8_t *p = f->pixels + (size_t)(y + k / 8) * f->stride + 4 * (size_t)(x + k % 8);
        const double srgb[3] = {p[2] / 255.0, p[1] / 255.0, p[0] / 255.0};
        double lab[3];
        eyes_lab(EYES_ALL_CONES, srgb, lab);
        sum += lab[0] / 64;
    }
    return sum;
}

/* Three beads of a material side by side. */
static void put_three(struct bead_stage *s, const double colour[3])
{
    s->count = 3;
    for (int i = 0; i < 3; i++) {
        s->beads[i] = (struct bead_stage_bead){.x = (float)(160 + 112 * i), .r = 56, .edge = {-INFINITY, INFINITY}};
        for (int k = 0; k < 3; k++)
            s->beads[i].colour[k] = (float)colour[k];
        if (i > 0)
            touch(s, &s->beads[i - 1], &s->beads[i]);
    }
}

/* Their picture with this part of the largest force at the first contact. */
static void paint_force(struct bead_canvas *c, struct bead_stage *s, double force, struct bead_frame *frame)
{
    struct bead_message msg = {""};
    bead_stage_glow(force, s->beads[0].light[1]);
    bead_stage_glow(force, s->beads[1].light[0]);
    require(bead_stage_prepare(s, &msg), &msg);
    require(bead_paint_stage(c, s, (struct bead_rect){0, 0, WIDTH, HEIGHT}, 0, frame, &msg), &msg);
}

static void light_rises_with_force(void **state)
{
    (void)state;
    enum { STEPS = 20 };
    struct bead_scene *scene = parse(BEADS OUTPUTS);
    struct bead_message msg = {""};
    struct bead_frame frame, before;
    struct bead_canvas *canvas;
    require(bead_canvas_create("plain", WIDTH, HEIGHT, &canvas, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &frame, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &before, &msg), &msg);
    assert_true(scene->material_count > 10);
    for (size_t m = 0; m < scene->material_count; m++)
        for (int t = 0; t < 2; t++) {
            static const int x[] = {206, 218}; /* beside the contact: on the left bead, on the right */
            double last[2] = {-1, -1}, first[2] = {0, 0};
            struct bead_stage stage;
            open_stage(&stage, themes[t], 56);
            put_three(&stage, scene->materials[m].colour);
            for (int f = 0; f <= STEPS; f++) {
                paint_force(canvas, &stage, (double)f / STEPS, &frame);
                for (int k = 0; k < 2; k++) {
                    const double now = lightness(&frame, x[k], 76);
                    if (now <= last[k])
                        fail_msg("%s, theme %d, force %d/%d: lightness %g after %g", scene->materials[m].name, t, f, STEPS, now,
                                 last[k]);
                    first[k] = f == 0 ? now : first[k];
                    last[k] = now;
                }
                for (size_t i = 0; f > 0 && i < frame.stride * HEIGHT; i++)
                    if (frame.pixels[i] + 1 < before.pixels[i])
                        fail_msg("%s: a pixel is darker with more force", scene->materials[m].name);
                memcpy(before.pixels, frame.pixels, frame.stride * HEIGHT);
            }
            assert_true(last[0] - first[0] > 10 && last[1] - first[1] > 10);
            bead_stage_close(&stage);
        }
    bead_frame_free(&frame);
    bead_frame_free(&before);
    bead_canvas_destroy(canvas);
    bead_scene_free(scene);
}

/* ---- camera ---- */

/* A pulse five beads wide runs to the end and back, through a window of 16 beads in so many frames. Returns the part of frames in
 * which the camera stands still. */
static double follow_pulse(double crossing)
{
    enum { CONTACTS = 129 };
    const double pitch = 109, width = 16 * pitch, step = 11 * pitch, speed = 16 / crossing;
    const int frames = (int)(256 / speed);
    struct bead_step_camera c = {.width = width, .step = step, .margin = 2.5 * pitch, .ends = {-200, CONTACTS * pitch + 150}};
    double load[CONTACTS], last = 0;
    int still = 0, moving = 0, back = 0;
    for (int f = 0; f < frames; f++) {
        const double way = speed * f, at = way < 128 ? way : 256 - way;
        for (int k = 0; k < CONTACTS; k++)
            load[k] = fabs(k - at) < 2.5 ? 0.7 * pow(cos((k - at) * M_PI / 5), 3) : 0;
        const double head = bead_step_camera_find(&c, (struct bead_loads){load, NULL, CONTACTS});
        bead_step_camera_advance(&c, (head + 0.5) * pitch, 0);
        const double left = round(c.middle - 0.5 * width), peak = (at + 0.5) * pitch;
        if (peak < left + pitch || peak > left + width - pitch)
            fail_msg("frame %d: the pulse at %g is not in the window from %g to %g", f, peak, left, left + width);
        assert_true(left >= c.ends[0] - 1 && left + width <= c.ends[1] + 1);
        still += f > 0 && left == last;
        moving += f > 0 && left != last;
        back += f > 0 && left < last;
        last = left;
    }
    assert_true(back > 0 && c.middle < 3 * width); /* it came back with the pulse */
    const double pans = ceil((c.ends[1] - c.ends[0] - width) / step);
    assert_true(moving <= BEAD_PAN_FRAMES * (2 * pans + 1));
    return (double)still / frames;
}

/* Adds a pulse five beads wide that goes this way. */
static void add_pulse(double *load, signed char *ways, size_t count, double at, int way)
{
    for (size_t k = 0; k < count; k++) {
        const double x = (double)k - at, own = fabs(x) < 2.5 ? 0.7 * pow(cos(x * M_PI / 5), 3) : 0;
        if (own > load[k])
            ways[k] = (signed char)way;
        load[k] += own;
    }
}

/* Two equal pulses from the ends pass through each other: the window holds the one from the left, on to the other end and back, and
 * both while they are no further apart than fits. The window moves by whole pans only, never by jumps. */
static void waves_that_meet_are_both_in_the_window(void **state)
{
    (void)state;
    enum { CONTACTS = 80 };
    const double pitch = 100, width = 14.5 * pitch, margin = 2.5 * pitch, speed = 0.2, end = CONTACTS - 1, fits = 9, rests = 4;
    struct bead_step_camera c = {.width = width, .step = 9 * pitch, .margin = margin, .ends = {-200, CONTACTS * pitch + 200}};
    double last = 0;
    int both = 0, still = 0, near = 0;
    for (int f = 0; f < (int)(1.8 * end / speed); f++) {
        double load[CONTACTS] = {0};
        signed char ways[CONTACTS] = {0};
        const double at = speed * f, own = at < end ? at : 2 * end - at, other = at < end ? end - at : at - end;
        add_pulse(load, ways, CONTACTS, own, at < end ? 1 : -1);
        add_pulse(load, ways, CONTACTS, other, at < end ? -1 : 1);
        const double head = bead_step_camera_find(&c, (struct bead_loads){load, ways, CONTACTS});
        bead_step_camera_advance(&c, (head + 0.5) * pitch, (c.other + 0.5) * pitch);
        const double left = c.middle - 0.5 * width, places[2] = {(own + 0.5) * pitch, (other + 0.5) * pitch};
        const bool together = at < end && fabs(own - other) < fits;
        for (int k = 0; k < 1 + together; k++) {
            if (places[k] < left + pitch || places[k] > left + width - pitch)
                fail_msg("frame %d: the pulse at %g is not in the window from %g to %g", f, places[k], left, left + width);
        }
        both += together;
        /* The fastest part of a pan is 15/8 of its mean speed; else, the window goes along with a pulse. */
        if (f > 0 && fabs(left - last) > fmax(15.0 / 8 * c.step / BEAD_PAN_FRAMES, 2 * speed * pitch))
            fail_msg("frame %d: the window jumps by %g", f, left - last);
        still += at < end && fabs(own - other) < rests && left == last;
        near += at < end && fabs(own - other) < rests;
        last = left;
    }
    assert_true(both > 40);
    assert_int_equal(still, near); /* it stands where they meet */
}

static void camera_rests_and_follows(void **state)
{
    (void)state;
    assert_true(follow_pulse(64) > 0.6);   /* the demo's pace: 15 beads a second */
    assert_true(follow_pulse(120) > 0.72); /* two seconds */
    (void)follow_pulse(7);                 /* faster than pans */
    (void)follow_pulse(2);
    assert_true(bead_pan_eased(0) == 0 && bead_pan_eased(1) == 1 && fabs(bead_pan_eased(0.5) - 0.5) < 1e-12);
    assert_true(bead_pan_eased(0.01) < 1e-4 && bead_pan_eased(0.99) > 1 - 1e-4);
}

/* ---- the view ---- */

/* A word below the stage: its middle, its width, px; and its number, -1 of names. */
struct label {
    double x, width;
    int number;
    char text[24];
};
struct labels {
    struct label at[40];
    size_t count;
};

static void see(void *context, const char *markup, double x, double y, double width, double)
{
    struct labels *labels = context;
    char *end;
    const long number = strtol(markup, &end, 10);
    if (y < 300 || labels->count == 40) /* the key */
        return;
    struct label *label = &labels->at[labels->count++];
    *label = (struct label){.x = x + 0.5 * width, .width = width, .number = end != markup && !*end ? (int)number : -1};
    snprintf(label->text, sizeof label->text, "%.23s", markup);
}

struct setting {
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_colormap map;
    struct bead_view *view;
    struct labels labels;
};

/* Feeds a moment: no displacements, this value of every contact or bead. */
static void feed_view(struct setting *s, enum bead_field field, double value)
{
    struct bead_message msg = {""};
    const size_t beads = bead_chain_beads(s->chain);
    double *zeros = calloc(2 * (beads + 1), sizeof *zeros), *values = zeros + beads + 1;
    for (size_t i = 0; i <= beads; i++)
        values[i] = value;
    struct bead_sample sample = {.field = {[BEAD_FIELD_DISPLACEMENT] = zeros, [BEAD_FIELD_CONTACT_FORCE] = zeros}};
    sample.field[field] = values;
    require(bead_view_stage_type.feed(s->view, &sample, &msg), &msg);
    free(zeros);
    bead_stage_advance(s->view, 0);
    bead_stage_compose(s->view);
    bead_stage_compose_row(s->view);
}

/* A stage of this chain, at rest, of 1740 x 260 px. */
static void open_magnified(struct setting *s, const char *chain, enum bead_light light, double magnify)
{
    struct bead_message msg = {""};
    char text[600];
    snprintf(text, sizeof text, "%s\noutputs: [{movie: a.mp4}]\n", chain);
    *s = (struct setting){.scene = parse(text)};
    require(bead_chain_create(s->scene, 0, &s->chain, &msg), &msg);
    bead_look_film(&s->look, 1920, 1080, true, false);
    const size_t beads = bead_chain_beads(s->chain);
    const struct bead_view_setup setup = {.chain = s->chain,
                                          .field = bead_chain_spec(s->chain)->system->has_contacts ? BEAD_FIELD_FORCE
                                                                                                   : BEAD_FIELD_DISPLACEMENT,
                                          .beads = {0, beads - 1},
                                          .time = {0, 1e-3},
                                          .colours = {&s->map, BEAD_SCALE_LINEAR, 0, 40},
                                          .look = &s->look,
                                          .axes = true,
                                          .bead_labels = true,
                                          .magnify = magnify,
                                          .light = light};
    require(bead_view_stage_type.create(&setup, &s->view, &msg), &msg);
    require(bead_view_stage_type.place(s->view, (struct bead_rect){90, 100, 1740, 360}, NULL, &msg), &msg);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1920, 1080);
    const struct bead_text_watch watch = {see, &s->labels};
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    require(bead_view_stage_type.decorate(s->view, cr, &msg), &msg);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    feed_view(s, bead_stage_field(&setup), 0);
}

static void open_view(struct setting *s, const char *chain, enum bead_light light)
{
    open_magnified(s, chain, light, 1e-6);
}

static void close_view(struct setting *s)
{
    bead_view_stage_type.destroy(s->view);
    bead_chain_destroy(s->chain);
    bead_scene_free(s->scene);
}

#define STRIKER "striker: {bead: large-steel, velocity: 0.4 m/s}, "
static const char *const few = "chain: {" STRIKER "beads: [{bead: large-steel, count: 4}], wall: rigid}";
static const char *const unlike =
    "chain: {" STRIKER "beads: [{cell: [large-steel, small-steel], count: 4}, {bead: small-steel, count: 3}], wall: brass}";
static const char *const taper = "chain: {" STRIKER "beads: [{bead: large-steel, count: 20, taper: 4 %}], wall: brass}";
static const char *const apart = "chain: {" STRIKER "beads: [{bead: large-steel, count: 8}], gap: 1 mm}";
static const char *const many = "chain: {" STRIKER "beads: [{cell: [large-steel, aluminium], count: 100}], wall: brass}";

/* Free space between neighbours on the stage, px. */
static double gap_of(const struct bead_stage *s, size_t i)
{
    const struct bead_stage_bead *a = &s->beads[i], *b = &s->beads[i + 1];
    return hypot(b->x - a->x, b->r - a->r) - a->r - b->r;
}

/* No bead goes through another, and what is between two heavy ones has as much air on both sides. */
static void light_beads_part_heavy_ones(void **state)
{
    (void)state;
    static const char *const between[] = {"{bead: large-steel, radius: 2 mm}", "{bead: large-steel, radius: 1 mm, count: 3}",
                                          "{bead: large-steel, radius: 3 mm}"};
    for (size_t c = 0; c < 3; c++) {
        struct setting s;
        char text[300];
        snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, radius: 10 mm}, %s, {bead: large-steel, radius: 10 mm}]}",
                 between[c]);
        open_view(&s, text, BEAD_LIGHT_CONTACTS);
        const struct bead_view *v = s.view;
        const size_t last = v->count - 1;
        for (size_t i = 0; i < last; i++) {
            for (size_t j = i + 1; j <= last; j++)
                assert_true(hypot(v->place[j] - v->place[i], v->radius[j] - v->radius[i]) >=
                            (v->radius[i] + v->radius[j]) * (1 - 1e-9));
        }
        const size_t heavy = last - 1 - (c == 1 ? 3 : 1); /* the second last of them */
        const double left = v->place[heavy + 1] - v->place[heavy], right = v->place[last] - v->place[last - 1];
        assert_float_equal(left, right, 1e-9 * left);
        assert_true(c < 2 || fabs(left - 2 * sqrt(30e-6)) < 1e-9); /* large enough: all touch */
        close_view(&s);
    }
}

static void beads_touch_where_they_do(void **state)
{
    (void)state;
    const char *const chains[] = {few, unlike, taper, apart};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct setting s;
        open_view(&s, chains[c], BEAD_LIGHT_CONTACTS);
        const struct bead_stage *stage = &s.view->stage;
        /* Of two radii, and of places. */
        const double rounding = (double)stage->unit / BEAD_STAGE_RADII + 1.0 / 64;
        const double free_space = c == 3 ? 1e-3 * s.view->scale : 0;
        assert_int_equal(stage->count, bead_chain_beads(s.chain));
        for (size_t i = 0; i + 1 < stage->count; i++) {
            const double expected = i > 0 ? free_space : 0; /* the striker touches the first bead */
            if (fabs(gap_of(stage, i) - expected) > rounding)
                fail_msg("chain %zu, beads %zu and %zu: %g px between them, not %g", c, i, i + 1, gap_of(stage, i), expected);
        }
        /* Radii in proportion; all on the stage, with room for the striker to fly back. */
        assert_true(fabs(stage->beads[2].r / stage->unit - bead_chain_radius(s.chain)[2] / s.view->largest) < 0.01);
        assert_true(stage->beads[0].x - 2 * stage->beads[0].r > 0);
        const struct bead_stage_bead *last = &stage->beads[stage->count - 1];
        assert_true(last->x + last->r < (float)stage->width);
        assert_true((stage->wall.width > 0) == (c != 3));
        if (c != 3)
            assert_true(fabs(last->x + last->r - stage->wall.x) < rounding && last->edge[1] == stage->wall.x);
        close_view(&s);
    }
}

/* Beads on pendulums stay on the stage wherever they swing. */
static void swings_stay_on_the_stage(void **state)
{
    (void)state;
    struct setting s;
    open_magnified(&s,
                   "chain: {" STRIKER "beads: [{bead: large-steel, count: 4}], cradle: {length: 20 cm}}\n"
                   "simulate: {until: 1 s}",
                   BEAD_LIGHT_CONTACTS, 1);
    const double swing = 0.4 * sqrt(0.2 / 9.80665);
    assert_int_equal(s.view->row.height, 0);
    for (int side = -1; side <= 1; side += 2) {
        feed_view(&s, BEAD_FIELD_DISPLACEMENT, side * swing);
        const struct bead_stage *stage = &s.view->stage;
        const struct bead_stage_bead *end = &stage->beads[side < 0 ? 0 : stage->count - 1];
        assert_int_equal(stage->count, 5);
        assert_true(end->x - end->r >= 0 && end->x + end->r <= (float)stage->width);
        assert_true(side < 0 ? end->x < 2 * end->r : end->x > (float)stage->width - 2 * end->r); /* and have no more room */
    }
    close_view(&s);
}

static void beads_are_over_their_numbers(void **state)
{
    (void)state;
    const char *const chains[] = {few, unlike, taper, apart, many};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct setting s;
        open_view(&s, chains[c], BEAD_LIGHT_CONTACTS);
        const struct bead_view *v = s.view;
        assert_true((v->row.height > 0) == (c == 4)); /* more than there is room for: a row of all */
        assert_true(s.labels.count >= 2);
        for (size_t i = 0; i < s.labels.count; i++) {
            const size_t bead = (size_t)s.labels.at[i].number;
            if (s.labels.at[i].number < 0)
                continue;
            const double x = v->row.height > 0 ? (double)v->balls[bead].x : (double)v->stage.beads[bead].x;
            const double r = v->row.height > 0 ? (double)v->balls[bead].r : (double)v->stage.beads[bead].r;
            if (fabs(s.labels.at[i].x - v->strip.x - x) > fmax(1, 0.5 * r))
                fail_msg("chain %zu: number %zu at %g, its bead at %g", c, bead, s.labels.at[i].x - v->strip.x, x);
        }
        close_view(&s);
    }
}

/* Lights go as the step of a compression does, that of beads pushed right or its mirror image, forward or back, however little the
 * beads have moved from one moment to the next. */
static void lights_know_the_way_of_the_wave(void **state)
{
    (void)state;
    enum { ALL = 202 };
    struct bead_message msg = {""};
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (int back = 0; back < 2; back++) {
            struct setting s;
            double u[ALL], force[ALL];
            open_view(&s, many, BEAD_LIGHT_CONTACTS);
            assert_int_equal(bead_chain_beads(s.chain), ALL - 1);
            for (int moment = 0; moment < 2; moment++) {
                const double at = moment == back ? 100 : 100.1;
                struct bead_sample sample = {.time = 1e-6 * (moment + 1),
                                             .field = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_CONTACT_FORCE] = force}};
                for (int i = 0; i < ALL; i++)
                    u[i] = mirrored ? -1e-5 / (1 + exp(at - i)) : 1e-5 / (1 + exp(i - at));
                for (int i = 0; i < ALL; i++)
                    force[i] = i + 1 < ALL ? 4e6 * (u[i] - u[i + 1]) : 0;
                require(bead_view_stage_type.feed(s.view, &sample, &msg), &msg);
            }
            bead_stage_advance(s.view, 2e-6);
            const int way = back ? -1 : 1;
            for (size_t k = 90; k < 110; k++) {
                if (s.view->excess[k] > 0.01 && s.view->way[k] != way)
                    fail_msg("contact %zu: %d, not %d", k, s.view->way[k], way);
            }
            assert_true(s.view->excess[99] > 0.1);
            close_view(&s);
        }
}

/* Sensors and the wall are named, over each other nothing is. */
static void names_have_room(void **state)
{
    static const char *const sensors =
        "chain: {" STRIKER "beads: [{bead: large-steel, count: 20}, {bead: small-steel, sensor: first}, "
        "{bead: large-steel, count: 19}, {bead: small-steel, sensor: second}, {bead: large-steel, count: 15}], wall: brass}";
    const char *const chains[] = {sensors, taper, unlike, many};
    (void)state;
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct setting s;
        int found = 0;
        open_view(&s, chains[c], BEAD_LIGHT_CONTACTS);
        for (size_t i = 0; i < s.labels.count; i++) {
            const struct label *a = &s.labels.at[i];
            const size_t bead = strcmp(a->text, "first") == 0 ? 21 : strcmp(a->text, "second") == 0 ? 41 : 0;
            found += bead > 0 && fabs(a->x - s.view->strip.x - (double)s.view->balls[bead].x) < 2;
            found += strcmp(a->text, "brass wall") == 0;
            for (size_t k = 0; k < i; k++)
                assert_true(fabs(a->x - s.labels.at[k].x) > 0.5 * (a->width + s.labels.at[k].width));
        }
        assert_true(c > 0 || found == 3);
        close_view(&s);
    }
}

/* Large beads: 12 to 18 across where there are more. */
static void beads_are_large(void **state)
{
    struct setting s;
    (void)state;
    open_view(&s, many, BEAD_LIGHT_CONTACTS);
    const double across = s.view->strip.width / (2 * (double)s.view->stage.unit);
    assert_true(across >= 12 && across <= 18);
    assert_true(s.view->left == round(s.view->left));
    assert_true(s.view->camera.step == round(s.view->camera.step));
    close_view(&s);
}

/* Contacts light up, or whole beads, or nothing; masses of an equation, which have no contacts, always as a whole. */
static void the_key_light_is_heard(void **state)
{
    static const char *const fput = "chain: {equation: fput, points: 31, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 10}";
    (void)state;
    for (int light = BEAD_LIGHT_CONTACTS; light <= BEAD_LIGHT_NONE; light++)
        for (int equation = 0; equation < 2; equation++) {
            struct setting s;
            open_view(&s, equation ? fput : many, (enum bead_light)light);
            const struct bead_stage_bead *bead = &s.view->stage.beads[3];
            assert_true(bead->light[0][0] == 0 && bead->light[1][0] == 0 && bead->own[0] == 0);
            feed_view(&s, equation ? BEAD_FIELD_DISPLACEMENT : BEAD_FIELD_CONTACT_FORCE, 20); /* half of the range */
            float half[3];
            bead_stage_glow(0.5, half);
            const bool contacts = light == BEAD_LIGHT_CONTACTS && !equation, whole = !contacts && light != BEAD_LIGHT_NONE;
            assert_true(bead->light[0][0] == (contacts ? half[0] : 0) && bead->light[1][2] == (contacts ? half[2] : 0));
            assert_true((bead->own[0] > 0) == whole && (bead->own[2] > 0) == whole);
            assert_true((s.view->row.height > 0) == !equation); /* no wave to follow */
            close_view(&s);
        }
}

/* How far from light on a nearly black bead the colours are along a row of pixels, at most, levels. */
static double off_scale(const uint8_t *row, int from, int width)
{
    double most = 0;
    for (int x = 0; x < width; x++) {
        float light[3];
        bead_stage_glow((x + 0.5) / width, light);
        for (int c = 0; c < 3; c++)
            most = fmax(most, fabs(row[4 * (from + x) + 2 - c] - 255 * bead_stage_shown((c < 2 ? 0.05 : 0.06) + light[c])));
    }
    return most;
}

/* The scale of the key is light itself, from none to all, no shorter than three letters are wide. */
static void the_key_shows_light(void **state)
{
    (void)state;
    enum { WIDE = 400, HIGH = 40, SIZE = 20 };
    struct setting s;
    open_view(&s, few, BEAD_LIGHT_CONTACTS);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDE, HIGH);
    cairo_t *cr = cairo_create(surface);
    (void)bead_stage_draw_key_of(cr, &s.view->setup, NULL, 0, WIDE - SIZE, HIGH / 2, SIZE);
    cairo_surface_flush(surface);
    const uint8_t *row = cairo_image_surface_get_data(surface) + HIGH / 2 * (size_t)cairo_image_surface_get_stride(surface);
    double least = 255;
    for (int width = 3 * SIZE; width < 6 * SIZE; width++)
        for (int from = 0; from + width < WIDE; from++)
            least = fmin(least, off_scale(row, from, width));
    if (least > 8) /* measured: 4.6, where light rises most, as between its 17 points the scale is linear */
        fail_msg("what comes nearest to light is off by %g levels", least);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    close_view(&s);
}

/* Materials without a colour of their own are told apart by all eyes, as curves are. */
static void own_materials_differ(void **state)
{
    (void)state;
    enum { OWN = 5 };
    struct bead_scene *scene =
        parse("materials: {a: &m {modulus: 1 GPa, poisson: 0.3}, b: *m, c: *m, d: *m, e: *m}\n" BEADS OUTPUTS);
    const struct bead_material *own = scene->materials + scene->material_count - OWN;
    for (int i = 0; i < EYES_KINDS * OWN * OWN; i++) {
        const int one = i / OWN % OWN, two = i % OWN;
        double lab[2][3];
        eyes_lab((enum eyes)(i / OWN / OWN), own[one].colour, lab[0]);
        eyes_lab((enum eyes)(i / OWN / OWN), own[two].colour, lab[1]);
        if (one != two && !(eyes_difference(lab[0], lab[1]) >= 12))
            fail_msg("eyes %d: %s and %s differ by %.1f", i / OWN / OWN, own[one].name, own[two].name,
                     eyes_difference(lab[0], lab[1]));
    }
    bead_scene_free(scene);
}

/* A neighbour hides light of contacts from a bead, here more and there less, and gives none. */
static void neighbours_hide_light(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    for (int theme = 0; theme < 2; theme++) {
        struct bead_stage s;
        open_stage(&s, themes[theme], 40);
        put_three(&s, (const double[]){0.7, 0.7, 0.72});
        for (int i = 0; i < 3; i++)
            s.beads[i].near[0] = s.beads[i].near[1] = 0.5;
        require(bead_stage_prepare(&s, &msg), &msg);
        const struct bead_stage_bake *bake = s.beads[1].bake;
        const int span = bake->wide + 2 * BEAD_STAGE_PAD;
        const float *beside = bake->picture[BEAD_STAGE_BESIDE], *alone = bake->picture[BEAD_STAGE_ALONE];
        assert_non_null(beside);
        assert_non_null(alone);
        float most = 0;
        for (int y = 0; y < bake->high; y++)
            for (int x = 0; x < bake->wide; x++) {
                const int at = (y * BEAD_STAGE_PLANES + BEAD_STAGE_FORM) * span + BEAD_STAGE_PAD + x;
                assert_true(beside[at] >= 0 && beside[at] <= alone[at]);
                most = fmaxf(most, alone[at] - beside[at]);
            }
        assert_true(most > 0.1f);
        bead_stage_close(&s);
    }
}

/* The floor below a wall is brighter than without it, and where the contact's light is mirrored brighter still. */
static void walls_are_mirrored(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_canvas *canvas;
    struct bead_frame frame;
    double lit[3][2];
    require(bead_frame_create(WIDTH, HEIGHT, &frame, &msg), &msg);
    require(bead_canvas_create("plain", WIDTH, HEIGHT, &canvas, &msg), &msg);
    for (int k = 0; k < 3; k++) {
        struct bead_stage s;
        open_stage(&s, &bead_stage_dark, 30);
        s.wall = (struct bead_stage_wall){.x = 200, .width = k > 0 ? 80 : 0, .colour = {.2f, .2f, .2f}};
        bead_stage_glow(k > 1 ? 1 : 0, s.wall.light);
        require(bead_stage_prepare(&s, &msg), &msg);
        require(bead_paint_stage(canvas, &s, (struct bead_rect){0, 0, WIDTH, HEIGHT}, 0, &frame, &msg), &msg);
        const int centre = (int)(2 * bead_stage_foot(&s) - s.centre);
        for (int far = 0; far < 2; far++)
            lit[k][far] = lightness(&frame, far ? 270 : 202, centre < HEIGHT - 8 ? centre : HEIGHT - 8);
        bead_stage_close(&s);
    }
    if (!(lit[1][0] > lit[0][0] + 1 && lit[1][1] > lit[0][1] + 1 && lit[2][0] > lit[1][0] + 5 && lit[2][0] > lit[2][1] + 5))
        fail_msg("below the wall's face and its back: %g, %g without it, %g, %g with it, %g, %g lit", lit[0][0], lit[0][1],
                 lit[1][0], lit[1][1], lit[2][0], lit[2][1]);
    bead_canvas_destroy(canvas);
    bead_frame_free(&frame);
}

/* Without a background a stage laid over grey is the stage on a grey floor, and lets through all where nothing is. */
static void stages_are_transparent(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct setting s;
    open_view(&s, few, BEAD_LIGHT_CONTACTS);
    struct bead_view *v = s.view;
    const struct bead_rect all = {0, 0, v->strip.width, v->strip.height};
    struct bead_frame clear, grey;
    struct bead_canvas *canvas;
    require(bead_frame_create(all.width, all.height, &clear, &msg), &msg);
    require(bead_frame_create(all.width, all.height, &grey, &msg), &msg);
    require(bead_canvas_create("plain", all.width, all.height, &canvas, &msg), &msg);
    require(bead_stage_prepare(&v->stage, &msg), &msg);
    v->look.clear = true;
    require(bead_stage_paint(v, canvas, all, &clear, &msg), &msg);
    v->look.clear = false;
    v->stage.theme = &v->floors[1];
    require(bead_stage_paint(v, canvas, all, &grey, &msg), &msg);
    const int behind = (int)(255 * bead_stage_shown(v->floors[1].floor[0]));
    int most = 0, solid = 0, nothing = 0;
    for (int y = v->head; y < all.height - (int)v->stage.unit; y++) {
        for (int x = 0; x < all.width; x++) {
            const uint8_t *over = clear.pixels + (size_t)y * clear.stride + 4 * (size_t)x,
                          *on = grey.pixels + (size_t)y * grey.stride + 4 * (size_t)x;
            solid += over[3] == 255;
            nothing += over[3] == 0;
            int off = 0;
            for (int c = 0; c < 3; c++) {
                off += over[c] + behind * (255 - over[3]) / 255 - on[c];
                assert_true(over[c] <= over[3]);
            }
            most = abs(off) > most ? abs(off) : most;
        }
    }
    const double balls = 5 * 3.14159 * v->stage.unit * v->stage.unit; /* with the striker */
    most = (most + 2) / 3;                                            /* one alpha serves three channels: their mean is right */
    if (most > 2 || solid < 0.9 * balls || solid > 1.1 * balls || nothing < all.width * 10)
        fail_msg("off by %d levels; %d pixels hide all, balls have %.0f; %d hide nothing", most, solid, balls, nothing);
    bead_canvas_destroy(canvas);
    bead_frame_free(&clear);
    bead_frame_free(&grey);
    close_view(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(painters_agree),
        cmocka_unit_test(instruction_sets_give_the_same_pixels),
        cmocka_unit_test(light_rises_with_force),
        cmocka_unit_test(fine_stages_look_the_same),
        cmocka_unit_test(camera_rests_and_follows),
        cmocka_unit_test(waves_that_meet_are_both_in_the_window),
        cmocka_unit_test(light_beads_part_heavy_ones),
        cmocka_unit_test(beads_touch_where_they_do),
        cmocka_unit_test(swings_stay_on_the_stage),
        cmocka_unit_test(beads_are_over_their_numbers),
        cmocka_unit_test(lights_know_the_way_of_the_wave),
        cmocka_unit_test(names_have_room),
        cmocka_unit_test(beads_are_large),
        cmocka_unit_test(the_key_light_is_heard),
        cmocka_unit_test(the_key_shows_light),
        cmocka_unit_test(own_materials_differ),
        cmocka_unit_test(neighbours_hide_light),
        cmocka_unit_test(stages_are_transparent),
        cmocka_unit_test(walls_are_mirrored),
    };
    return cmocka_run_group_tests_name("stage", tests, NULL, NULL);
}
