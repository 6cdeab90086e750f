/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage: all painters agree, light rises with force, the camera rests, and follows the wave. */
#include "tests/scenes.h"

#include "beadreel/view.h"
#include "render/paint/canvas.h"
#include "render/paint/paint.h"
#include "render/paint/pixel_kernels.h"
#include "render/stage/stage_view.h"
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

/* Unlike beads of all colours, touching, apart and pressed into each other, some lit; a wall. Every third stage has like beads
 * pressed together, every other one of them on whole pixels. */
static void fill_stage(struct bead_stage *s, uint32_t seed)
{
    const bool alike = seed % 3 == 2;
    float x = -10;
    s->count = BEADS_SHOWN;
    for (int i = 0; i < BEADS_SHOWN; i++) {
        struct bead_stage_bead *b = &s->beads[i];
        *b = (struct bead_stage_bead){.x = x,
                                      .r = alike ? s->unit : roundf(4 * random_place(&seed, 0.4 * s->unit, s->unit)) / 4,
                                      .edge = {-INFINITY, INFINITY}};
        for (int c = 0; c < 3; c++)
            b->colour[c] = random_place(&seed, 0.05, 1);
        if (i > 0) {
            const float gap = random_place(&seed, -0.2 * s->unit, alike ? 0 : 0.4 * s->unit);
            const float whole = alike && i % 2 ? 1 : 64;
            b->x = roundf(whole * (x + 2 * sqrtf(b->r * b[-1].r) + fmaxf(gap, -0.2f * b->r))) / whole;
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
    for (uint32_t seed = 1; seed < 4; seed++) {
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

/* A pulse five beads wide runs to the end and back, through a window of 16 beads in this many frames. Returns the part of frames in
 * which the camera is still. */
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
    assert_int_equal(still, near); /* it stays where they meet */
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

/* Materials without given colours differ for all eyes, like curves. */
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

/* The mean light of a bead alone where its surface rises so much, from straight down, -1, to straight up, 1. */
static double light_where(const struct bead_stage_bake *bake, float from, float to)
{
    const int span = bake->wide + 2 * BEAD_STAGE_PAD;
    const float *picture = bake->picture[BEAD_STAGE_ALONE];
    double sum = 0, count = 0;
    for (int y = 0; y < bake->high; y++) {
        for (int x = 0; x < bake->wide; x++) {
            const float *at = picture + y * BEAD_STAGE_PLANES * span + BEAD_STAGE_PAD + x;
            if (at[BEAD_STAGE_COVER * span] < 1 || at[BEAD_STAGE_RISE * span] < from || at[BEAD_STAGE_RISE * span] > to)
                continue;
            sum += at[0] + at[span] + at[2 * span];
            count++;
        }
    }
    assert_true(count > 20);
    return sum / count;
}

/* The floor hides most of the light that would come from below. */
static void beads_are_dark_near_the_floor(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    for (int theme = 0; theme < 2; theme++) {
        struct bead_stage s;
        open_stage(&s, themes[theme], 40);
        put_three(&s, (const double[]){0.7, 0.7, 0.72});
        require(bead_stage_prepare(&s, &msg), &msg);
        const double below = light_where(s.beads[1].bake, -1, -0.7f), beside = light_where(s.beads[1].bake, -0.1f, 0.1f),
                     above = light_where(s.beads[1].bake, 0.3f, 0.6f);
        /* Measured: 0.12 and 0.26 of the light from the side; without a floor more than twice as much. */
        assert_true(below < (theme ? 0.4 : 0.2) * beside && beside < above);
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

/* The floor is of one colour near, of another far away, and goes from the one to the other without a step back. */
static void floors_go_far(void **state)
{
    (void)state;
    for (int theme = 0; theme < 2; theme++) {
        struct bead_stage s;
        open_stage(&s, themes[theme], 40);
        float light[3], before[3];
        double done = 0;
        bead_stage_base(&s, s.centre + 1.21f * s.unit, before);
        assert_memory_equal(before, s.theme->floor, sizeof before);
        for (float up = -1.2f; up < 0.92f; up += 0.02f) {
            bead_stage_base(&s, s.centre - up * s.unit, light);
            for (int c = 0; c < 3; c++) {
                const float step = (light[c] - before[c]) / (s.theme->back[c] - s.theme->floor[c]);
                assert_true(step > -1e-5f && step < 0.02f);
                done += step / 3.0;
            }
            memcpy(before, light, sizeof light);
        }
        assert_true(fabs(done - 1) < 1e-4);
        bead_stage_close(&s);
    }
}

/* Balls as they are baked: as high as seen from 12 degrees above, with the area of a disc, the same at the left and at the right
 * but for their light; in the floor upside down and fainter, the more the deeper. */
static void balls_are_round(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_stage s;
    open_stage(&s, &bead_stage_dark, 37);
    put_three(&s, (const double[]){0.7, 0.5, 0.2});
    for (int i = 0; i < 3; i++)
        s.beads[i].r = 37;
    s.beads[0].near[0] = 0; /* baked alone, too */
    require(bead_stage_prepare(&s, &msg), &msg);
    const struct bead_stage_bake *bake = s.beads[0].bake;
    const int wide = bake->wide, high = bake->high;
    assert_true(wide == high && wide == 76); /* the ball's edge is soft */
    for (int k = 0; k < BEAD_STAGE_PICTURES; k++) {
        const enum bead_stage_picture picture = (enum bead_stage_picture)k;
        double area = 0, faint[2] = {0, 0};
        for (int y = 0; y < high; y++) {
            const float *rise = bead_stage_row(bake, picture, y, BEAD_STAGE_RISE),
                        *cover = bead_stage_row(bake, picture, y, BEAD_STAGE_COVER),
                        *form = bead_stage_row(bake, picture, y, BEAD_STAGE_FORM);
            for (int x = 0; x < wide; x++) {
                const double dx = (x + 0.5 - 0.5 * wide) / bake->r, dy = (0.5 * high - y - 0.5) / bake->r,
                             z = 1 - dx * dx - dy * dy;
                const double up = dy * cos(M_PI / 15) + sqrt(fmax(0, z)) * sin(M_PI / 15);
                assert_true(z < 0 || fabs(rise[x] - (picture == BEAD_STAGE_MIRROR ? -up : up)) < 1e-5);
                assert_true(fabsf(rise[x] - rise[wide - 1 - x]) < 1e-6f && cover[x] == cover[wide - 1 - x] &&
                            fabsf(form[x] - form[wide - 1 - x]) < 1e-5f && form[x] >= 0 && form[x] <= 1);
                area += cover[x];
                faint[dy < 0] += form[x];
            }
        }
        assert_true(picture == BEAD_STAGE_MIRROR ? area == 0 : fabs(area / (M_PI * bake->r * bake->r) - 1) < 0.002);
        assert_true(faint[0] > 1.05 * faint[1]); /* contacts light what is above more; the image in the floor is fainter below */
    }
    bead_stage_close(&s);
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
        cmocka_unit_test(own_materials_differ),
        cmocka_unit_test(beads_are_dark_near_the_floor),
        cmocka_unit_test(neighbours_hide_light),
        cmocka_unit_test(walls_are_mirrored),
        cmocka_unit_test(floors_go_far),
        cmocka_unit_test(balls_are_round),
    };
    return cmocka_run_group_tests_name("stage", tests, NULL, NULL);
}
