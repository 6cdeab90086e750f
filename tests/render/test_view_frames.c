/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Three ways to the same picture, for each view: frames drawn one after the other, each by its changes; a frame drawn for the first
 * time; and paths filled by cairo. Differences between the first two are trails that should not be there; differences from the
 * third are misplaced parts. */
#include "view_films.h"

/* ---- the two ways of frames ---- */

/* The largest difference of two frames. */
static int difference(const struct bead_frame *a, const struct bead_frame *b)
{
    int most = 0;
    for (int y = 0; y < HEIGHT; y++) {
        const bool same = memcmp(a->pixels + (size_t)y * a->stride, b->pixels + (size_t)y * b->stride, 4 * WIDTH) == 0;
        for (size_t i = 0; !same && i < 4 * WIDTH; i++) {
            const int off = i % 4 < 3 ? abs(a->pixels[(size_t)y * a->stride + i] - b->pixels[(size_t)y * b->stride + i]) : 0;
            most = off > most ? off : most;
        }
    }
    return most;
}

/* What is told to have changed is in the view's place, with its margins. */
static void copy_told(struct bead_frame *to, const struct shown *s, const struct bead_changes *changes)
{
    int left = 0, right = 0;
    if (s->type->margins)
        s->type->margins(&s->look, &left, &right);
    for (size_t i = 0; i < changes->count; i++) {
        const struct bead_rect *r = &changes->rect[i];
        assert_true(r->x >= plot.x - left && r->x + r->width <= plot.x + plot.width + right);
        assert_true(r->y >= plot.y && r->y + r->height <= plot.y + plot.height);
        bead_frame_copy(to, &s->frame, *r);
    }
}

/* Returns the time. */
static double draw_anew(const struct film *film, size_t k, struct shown *s)
{
    double time = 0;
    open_shown(s, film);
    for (size_t j = 0; j <= k; j++) {
        time = feed(s, j);
        if (j < k && s->type->pass)
            s->type->pass(s->view, time);
    }
    draw(s, time, &(struct bead_changes){0});
    return time;
}

/* Lines that begin anew at the edge of what has changed have another edge by the last bits. */
static void assert_no_trails(const struct film *film, int most)
{
    struct shown on, anew;
    struct bead_frame copy;
    struct bead_message msg = {""};
    size_t moved = 0;
    open_shown(&on, film);
    require(bead_frame_create(WIDTH, HEIGHT, &copy, &msg), &msg);
    bead_frame_copy(&copy, &on.background, page);
    for (size_t k = 0; k < FRAMES; k++) {
        struct bead_changes changes = {0};
        const double time = feed(&on, k);
        draw(&on, time, &changes);
        moved += changes.count > 0;
        copy_told(&copy, &on, &changes);
        if (difference(&copy, &on.frame) > 0)
            fail_msg("%s: frame %zu has changes that were not told", film->name, k);
        if (k % 3 != 1 && k + 1 < FRAMES)
            continue;
        (void)draw_anew(film, k, &anew);
        const int off = difference(&anew.frame, &on.frame);
        if (off > most)
            fail_msg("%s: frame %zu differs by %d from the same drawn first", film->name, k, off);
        close_shown(&anew);
    }
    assert_true(moved > 1);
    bead_frame_free(&copy);
    close_shown(&on);
}

/* ---- paths ---- */

/* The mean around a pixel: edges are soft in more than one way. */
static double mean_at(const uint8_t *pixels, size_t stride, int x, int y, size_t channel)
{
    double sum = 0;
    for (int k = 0; k < 9; k++)
        sum += pixels[(size_t)(y + k / 3 - 1) * stride + 4 * (size_t)(x + k % 3 - 1) + channel];
    return sum / 9;
}

static void assert_paths_agree(const struct film *film, double most)
{
    struct shown s;
    struct bead_message msg = {""};
    double worst = 0;
    size_t inked = 0;
    int at[2] = {0, 0};
    const double time = draw_anew(film, FRAMES / 2, &s);
    cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    const size_t stride = (size_t)cairo_image_surface_get_stride(paper);
    uint8_t *pixels = cairo_image_surface_get_data(paper);
    for (size_t y = 0; y < HEIGHT; y++)
        memcpy(pixels + y * stride, s.background.pixels + y * s.background.stride, 4 * WIDTH);
    cairo_surface_mark_dirty(paper);
    cairo_t *cr = cairo_create(paper);
    require(s.type->vector(s.view, time, cr, &msg), &msg);
    cairo_surface_flush(paper);
    for (int y = 1; y + 1 < HEIGHT; y++) {
        for (int x = plot.x + film->ends; x < plot.x + plot.width - film->ends; x++) {
            const size_t here = (size_t)y * stride + 4 * (size_t)x, there = (size_t)y * s.frame.stride + 4 * (size_t)x;
            inked += memcmp(pixels + here, s.background.pixels + there, 3) != 0;
            for (size_t c = 0; c < 3 && memcmp(pixels + here, s.frame.pixels + there, 3) != 0; c++) {
                const double off = fabs(mean_at(pixels, stride, x, y, c) - mean_at(s.frame.pixels, s.frame.stride, x, y, c));
                if (off <= worst)
                    continue;
                worst = off;
                at[0] = x;
                at[1] = y;
            }
        }
    }
    if (worst > most)
        fail_msg("%s: frame and paths differ by %.1f at %d, %d", film->name, worst, at[0], at[1]);
    assert_true(inked > 500);
    cairo_destroy(cr);
    cairo_surface_destroy(paper);
    close_shown(&s);
}

/* ---- */

static const double window = 8 * 9.525e-3;

#define SWING 1.2e-5

static void beads(void **)
{
    static const struct film films[] = {
        {"beads", BEAD_VIEW_BEADS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true},
        {"a striker that swings", BEAD_VIEW_BEADS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .as = {.swing = SWING}},
        {"a striker in a window", BEAD_VIEW_BEADS, ONE, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window,
         .as = {.swing = SWING}},
        {"a striker in a row", BEAD_VIEW_BEADS, ONE, BEAD_FIELD_FORCE, 0, 35, .film = true, .as = {.swing = SWING}},
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; i++)
        assert_no_trails(&films[i], 0);
}

#define FEW                                                                                                                      \
    "chain: {equation: fput, points: 4, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 10}\noutputs: [{table: a.csv, show: " \
    "modes}]\n"

static void profiles(void **)
{
    const struct film films[] = {
        {"forces", BEAD_VIEW_PROFILE, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .ends = 12},
        {"on paper", BEAD_VIEW_PROFILE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .light = true, .beads = {2, 20}, .ends = 14},
        {"velocities", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_VELOCITY, -0.1, 0.25, .film = true, .ends = 11},
        {"displacements", BEAD_VIEW_PROFILE, STRING, BEAD_FIELD_DISPLACEMENT, 0, 2e-5, .film = true, .ends = 5},
        {"few points on paper", BEAD_VIEW_PROFILE, FEW, BEAD_FIELD_DISPLACEMENT, 0, 2e-5, .light = true, .ends = 5},
        {"one bead", BEAD_VIEW_PROFILE, ONE, BEAD_FIELD_FORCE, 0, 35, .film = true, .beads = {1, 1}},
        {"decades", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 1e-3, 35, .film = true, .scale = BEAD_SCALE_LOG, .ends = 11},
        {"held", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .hold = true},
        {"overlaid", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .overlaid = true},
        {"a window", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window},
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        assert_no_trails(&films[i], 0);
        if (!films[i].hold && !films[i].overlaid) /* paths have neither */
            assert_paths_agree(&films[i], 10);
    }
}

/* Forces about a static one are drawn as velocities about 0. */
static void forces_about_rest_go_to_both_sides(void **)
{
    static const double rest = 20, half = 0.25;
    const struct film films[] = {
        {"velocities", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_VELOCITY, -half, half, .film = true, .hold = true},
        {"forces", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, rest - half, rest + half, .rest = rest, .film = true, .hold = true}};
    struct shown s[2];
    struct bead_message msg = {""};
    struct fields run[RUNS];
    for (int i = 0; i < 2; i++) {
        open_shown(&s[i], &films[i]);
        make_fields(&s[i].as, run, s[i].chain, FRAMES / 2, 0);
        for (int b = 0; b < ROOM; b++) {
            const double value = half * sin(0.8 * b);
            run[0].value[BEAD_FIELD_VELOCITY][b] = value;
            run[0].value[BEAD_FIELD_FORCE][b] = rest + value;
        }
        require(s[i].type->feed(s[i].view, &run[0].sample, &msg), &msg);
        draw(&s[i], run[0].sample.time, &(struct bead_changes){0});
    }
    assert_true(difference(&s[0].frame, &s[0].background) > 50);
    assert_true(difference(&s[0].frame, &s[1].frame) <= 1);
    close_shown(&s[0]);
    close_shown(&s[1]);
}

static void images(void **)
{
    for (enum bead_orientation o = BEAD_TIME_RIGHT; o <= BEAD_MATRIX; o++) {
        const struct film films[] = {
            {"image", BEAD_VIEW_SPACETIME, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o},
            {"image with a camera", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o,
             .window = window},
            {"image with trust", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o,
             .trust = true},
            {"image with theory", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o,
             .theory = true},
        };
        for (size_t i = 0; i < sizeof films / sizeof *films; i++)
            assert_no_trails(&films[i], 16);
        const struct film stills[] = {
            {"still", BEAD_VIEW_SPACETIME, DIMERS, BEAD_FIELD_VELOCITY, -0.1, 0.25, .orientation = o, .marked = true},
            {"still with trust", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .orientation = o, .trust = true},
            {"still with theory", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .orientation = o, .theory = true},
        };
        for (size_t i = 0; i < sizeof stills / sizeof *stills; i++)
            assert_paths_agree(&stills[i], 0);
    }
}

static void sensors(void **)
{
    const struct film films[] = {
        {"sensors", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true},
        {"sensors of velocity", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_VELOCITY, -0.1, 0.25, .film = true, .light = true},
        {"sensors with trust", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .trust = true},
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        assert_no_trails(&films[i], 16);
        assert_paths_agree(&films[i], 0);
    }
}

static void modes(void **)
{
    const struct film film = {"modes", BEAD_VIEW_MODES, STRING, BEAD_FIELD_DISPLACEMENT, 0, 1, .film = true};
    assert_no_trails(&film, 0);
    assert_paths_agree(&film, 0);
}

static void stages(void **)
{
    const struct film films[] = {
        {"stage", BEAD_VIEW_STAGE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true},
        {"stage and row", BEAD_VIEW_STAGE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true, .row = true},
        {"light stage", BEAD_VIEW_STAGE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .light = true, .window = window},
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        assert_no_trails(&films[i], 0);
        if (!films[i].row)
            assert_paths_agree(&films[i], 0);
    }
}

/* Nothing moves: beads look the same beside colours that begin at 0 and about it. */
static void beads_at_rest_have_no_light(void **)
{
    static const struct film films[] = {{"forces", BEAD_VIEW_BEADS, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true},
                                        {"velocities", BEAD_VIEW_BEADS, PLAIN, BEAD_FIELD_VELOCITY, -0.25, 0.25, .film = true}};
    struct shown s[2];
    struct bead_message msg = {""};
    for (int i = 0; i < 2; i++) {
        static struct fields run[RUNS];
        open_shown(&s[i], &films[i]);
        make_fields(&s[i].as, run, s[i].chain, 0, 0);
        memset(run[0].value, 0, sizeof run[0].value);
        require(s[i].type->feed(s[i].view, &run[0].sample, &msg), &msg);
        draw(&s[i], 0, &(struct bead_changes){0});
    }
    assert_true(difference(&s[0].frame, &s[0].background) > 50);
    assert_int_equal(difference(&s[0].frame, &s[1].frame), 0);
    for (int i = 0; i < 2; i++)
        close_shown(&s[i]);
}

/* Where an image has time down, its cursor is light below what the camera sees, of equal beads as many as its window is long. */
static void cursors_show_the_window(void **)
{
    static const struct film film = {"image",
                                     BEAD_VIEW_SPACETIME,
                                     PLAIN,
                                     BEAD_FIELD_FORCE,
                                     0,
                                     35,
                                     .film = true,
                                     .orientation = BEAD_TIME_DOWN,
                                     .window = 8 * 9.525e-3};
    struct shown s;
    size_t seen = 0;
    open_shown(&s, &film);
    const double beads = 31, spacing = 9.525e-3, first = bead_chain_position(s.chain)[0];
    const struct bead_rgb accent = s.look.accent;
    for (size_t k = 0; k < FRAMES; k++) {
        const double time = feed(&s, k), left = (bead_camera_left(s.camera) - first) / spacing + 0.5;
        draw(&s, time, &(struct bead_changes){0});
        int from = WIDTH, to = 0;
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const uint8_t *p = s.frame.pixels + (size_t)y * s.frame.stride + 4 * (size_t)x;
                if (abs(p[0] - (int)lround(255 * accent.b)) > 1 || abs(p[1] - (int)lround(255 * accent.g)) > 1 ||
                    abs(p[2] - (int)lround(255 * accent.r)) > 1)
                    continue;
                from = x < from ? x : from, to = x >= to ? x + 1 : to;
            }
        }
        if (to == 0)
            continue;
        assert_true(fabs(from - plot.x - plot.width * fmax(0, left) / beads) < 0.6);
        assert_true(fabs(to - plot.x - plot.width * fmin(beads, left + 8) / beads) < 0.6);
        seen++;
    }
    assert_true(seen > FRAMES / 2);
    close_shown(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beads),
        cmocka_unit_test(profiles),
        cmocka_unit_test(forces_about_rest_go_to_both_sides),
        cmocka_unit_test(images),
        cmocka_unit_test(sensors),
        cmocka_unit_test(modes),
        cmocka_unit_test(stages),
        cmocka_unit_test(cursors_show_the_window),
        cmocka_unit_test(beads_at_rest_have_no_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
