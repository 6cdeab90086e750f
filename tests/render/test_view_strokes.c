/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strokes of views in a plot of 400 x 200 pixels at 100, 50, as numbers: curves, bars, lines of theory, rings of sensors are
 * where the samples put them. */
#include "render/draw/looks.h"
#include "render/stage/magnify.h"
#include "render/stage/panel.h"
#include "render/stage/stage_key.h"
#include "render/stage/stage_view.h"
#include "render/view/horizon.h"
#include "render/view/theory_line.h"
#include "render/view/views.h"
#include "sim/chain/chain_internal.h"
#include "sim/measure/compacton.h"
#include "strokes.h"
#include "tests/scenes.h"

enum { LEFT = 100, TOP = 50, WIDTH = 400, HEIGHT = 200, RIGHT = LEFT + WIDTH, BOTTOM = TOP + HEIGHT, MOST = 64 };
static const struct bead_rect plot = {LEFT, TOP, WIDTH, HEIGHT};
static const double em = 20;

struct seen {
    size_t count;
    struct {
        char markup[160];
        double x, y, width, height;
    } text[MOST];
};

struct shown {
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_view_setup setup;
    const struct bead_view_type *type;
    struct bead_view *view;
    cairo_surface_t *surface;
    cairo_t *cr;
    struct seen seen;
    struct bead_text_watch watch;
};

static void see(void *context, const char *markup, double x, double y, double width, double height)
{
    struct seen *seen = context;
    if (seen->count == MOST)
        return;
    snprintf(seen->text[seen->count].markup, sizeof seen->text[0].markup, "%s", markup);
    seen->text[seen->count].x = x;
    seen->text[seen->count].y = y;
    seen->text[seen->count].width = width;
    seen->text[seen->count++].height = height;
}

static size_t find(const struct seen *seen, const char *text)
{
    for (size_t i = 0; i < seen->count; i++) {
        if (strcmp(seen->text[i].markup, text) == 0)
            return i;
    }
    fail_msg("nothing says '%s'", text);
    return 0;
}

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static void open_shown(struct shown *s, const char *text)
{
    struct bead_message msg = {""};
    *s = (struct shown){.scene = parse(text)};
    require(bead_chain_create(s->scene, 0, &s->chain, &msg), &msg);
    bead_look_screen(&s->look, 1000, 800, false);
    s->look.label = em;
    s->look.tick = 18;
    s->look.line = 2;
    s->setup = (struct bead_view_setup){.chain = s->chain,
                                        .field = BEAD_FIELD_FORCE,
                                        .beads = {0, bead_chain_beads(s->chain) - 1},
                                        .time = {0, 1e-3},
                                        .colours = {NULL, BEAD_SCALE_LINEAR, 0, 50, 0},
                                        .look = &s->look,
                                        .axes = true,
                                        .bead_labels = true,
                                        .orientation = BEAD_TIME_RIGHT,
                                        .magnify = 1};
    s->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 800, 400);
    s->watch = (struct bead_text_watch){see, &s->seen};
    assert_true(bead_text_watch(s->surface, &s->watch));
    s->cr = cairo_create(s->surface);
}

static void open_view(struct shown *s, enum bead_view_kind kind)
{
    struct bead_message msg = {""};
    s->type = bead_view_find(kind);
    require(s->type->create(&s->setup, &s->view, &msg), &msg);
    require(s->type->place(s->view, plot, NULL, &msg), &msg);
}

static void decorate(struct shown *s)
{
    struct bead_message msg = {""};
    s->seen.count = 0;
    strokes_begin();
    require(s->type->decorate(s->view, s->cr, &msg), &msg);
}

static void draw(struct shown *s, double time)
{
    struct bead_message msg = {""};
    strokes_begin();
    require(s->type->vector(s->view, time, s->cr, &msg), &msg);
}

static void close_shown(struct shown *s)
{
    if (s->view)
        s->type->destroy(s->view);
    cairo_destroy(s->cr);
    cairo_surface_destroy(s->surface);
    bead_chain_destroy(s->chain);
    bead_scene_free(s->scene);
}

/* ---- sensors ---- */

#define SENSORS                                                                                                               \
    "chain: {beads: [{bead: large-steel, count: 2}, {bead: large-steel, sensor: one}, {bead: large-steel, count: 3}, {bead: " \
    "large-steel, sensor: the second}, {bead: large-steel}]}\noutputs: [{table: a.csv}]\n"
static const size_t bead_of[] = {3, 7};

static double force_at(size_t sensor, size_t k)
{
    return (sensor ? 5 * (double)k : 40 - 3 * (double)k) + (double)(k % 2);
}

/* Names in a line above the curves, after samples of their lines; the axis ends 3 % above the largest value, below the names. */
static void sensors_have_their_curves(void **)
{
    for (int variant = 0; variant < 5; variant++) {
        const double given = variant == 3 ? -10 : variant == 4 ? 10 : 0, least = fmin(0, given); /* axes begin at 0, or below */
        struct shown s;
        struct bead_message msg = {""};
        open_shown(&s, SENSORS);
        s.setup.fill = variant == 1;
        s.setup.trust = variant == 2;
        s.setup.colours.low = given;
        open_view(&s, BEAD_VIEW_SENSORS);
        for (size_t k = 0; k <= 10; k++) {
            double force[16] = {0}, other[16] = {0};
            for (size_t n = 0; n < 2; n++) {
                force[bead_of[n]] = force_at(n, k);
                other[bead_of[n]] = force_at(n, k) + (n == 1 && k >= 6 ? 0.51 : n == 1 && k == 5 ? 0.49 : 0);
            }
            const struct bead_sample sample = {
                .time = 1e-4 * (double)k, .field = {[BEAD_FIELD_FORCE] = force}, .comparison = {[BEAD_FIELD_FORCE] = other}};
            require(s.type->feed(s.view, &sample, &msg), &msg);
        }
        double low, high;
        s.type->extremes(s.view, &low, &high);
        assert_true(low == 0 && high == 50);
        if (variant < 3) /* none was given */
            s.type->set_range(s.view, NULL, (const double[]){low, high});
        decorate(&s);
        const double row = 1.5 * em, end = (50 - least) * 1.03 / (1 - 1.15 * row / HEIGHT), sample = 1.6 * em, y = TOP + 0.65 * row;
        double width, height, x = LEFT + 0.6 * em;
        size_t names = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *line = &strokes.list[i];
            if (line->filled || line->count != 2 || fabs(line->width - 2 * s.look.line) > 1e-9)
                continue;
            const char *name = names ? "the second" : "one";
            const struct bead_text_style style = {.family = s.look.family, .size = em};
            assert_true(stroke_has(line, false, bead_look_curve(&s.look, names++)));
            assert_bounds(line, x, y, x + sample, y);
            bead_text_size(s.cr, &style, name, &width, &height);
            const size_t at = find(&s.seen, name);
            assert_true(fabs(s.seen.text[at].x - (x + sample + 0.4 * em)) < 3 &&
                        fabs(s.seen.text[at].y + s.seen.text[at].height / 2 - y) < 0.25 * em);
            x += sample + 0.4 * em + width + 1.2 * em;
        }
        assert_int_equal(names, 2);
        size_t numbers = 0;
        for (size_t i = 0; i < s.seen.count; i++) { /* of the axis, at their values */
            char *rest;
            const double value = strtod(s.seen.text[i].markup, &rest);
            if (*rest || rest == s.seen.text[i].markup || s.seen.text[i].x + s.seen.text[i].width > LEFT)
                continue;
            assert_true(fabs(s.seen.text[i].y + s.seen.text[i].height / 2 - (BOTTOM - HEIGHT * (value - least) / end)) < 2);
            numbers++;
        }
        assert_true(numbers >= 3);
        const size_t title = find(&s.seen, "bead force (N)");
        assert_true(s.seen.text[title].x + s.seen.text[title].width < LEFT);
        /* Curves. */
        draw(&s, 3.5e-4);
        const size_t first = variant == 2 ? 2 : 0; /* the horizon, with its edge, is below them */
        assert_int_equal(strokes.count, first + 2);
        for (size_t i = 0; i < first; i++) {
            const struct stroke *horizon = &strokes.list[i];
            assert_int_equal(horizon->count, 2);
            assert_true(fabs(horizon->width - (i ? 1 : 3) * s.look.line) < 1e-9);
            assert_true(fabs(horizon->at[0].x - (LEFT + 0.6 * WIDTH)) <= 1 && horizon->low[1] == TOP && horizon->high[1] == BOTTOM);
            assert_true(s.type->horizon(s.view) == 1e-4 * 6);
        }
        for (size_t n = 0; n < 2; n++) {
            const struct stroke *curve = &strokes.list[first + n];
            assert_true(stroke_has(curve, false, bead_look_curve(&s.look, n)) && fabs(curve->width - 2 * s.look.line) < 1e-9);
            assert_true(curve->join == CAIRO_LINE_JOIN_ROUND && curve->clip_low[0] == LEFT && curve->clip_high[1] == BOTTOM);
            assert_int_equal(curve->count, variant == 1 ? 5 : 11); /* films show what has been, also between samples */
            assert_at(curve->at[0].x, LEFT);
            assert_at(curve->at[0].y, BOTTOM - HEIGHT * (force_at(n, 0) - least) / end);
            const double last = variant == 1 ? 0.5 * (force_at(n, 3) + force_at(n, 4)) : force_at(n, 10);
            assert_at(curve->at[curve->count - 1].x, LEFT + (variant == 1 ? 0.35 : 1) * WIDTH);
            assert_at(curve->at[curve->count - 1].y, BOTTOM - HEIGHT * (last - least) / end);
        }
        close_shown(&s);
    }
}

/* Names that need two lines have no samples of lines, but the colours of their curves. */
static void many_sensors_are_named_in_colour(void **)
{
    struct shown s;
    open_shown(
        &s,
        "chain: {beads: [{bead: large-steel, sensor: the first of them}, {bead: large-steel, sensor: the second one}, "
        "{bead: large-steel, sensor: the third one}, {bead: large-steel, sensor: the last of them}]}\noutputs: [{table: a.csv}]\n");
    open_view(&s, BEAD_VIEW_SENSORS);
    decorate(&s);
    static const char *const names[] = {"the first of them", "the second one", "the third one", "the last of them"};
    double x = LEFT + 0.6 * em, width, height;
    int row = 0;
    for (int k = 0; k < 4; k++) {
        const struct bead_text_style style = {.family = s.look.family, .size = em};
        const size_t at = find(&s.seen, names[k]);
        bead_text_size(s.cr, &style, names[k], &width, &height);
        if (x + width > RIGHT - 0.2 * em) {
            row++;
            x = LEFT + 0.6 * em;
        }
        assert_true(fabs(s.seen.text[at].x - x) < 3);
        assert_true(fabs(s.seen.text[at].y + s.seen.text[at].height / 2 - (TOP + (row + 0.65) * 1.5 * em)) < 0.25 * em);
        x += width + 0.8 * em;
    }
    assert_true(row == 1);
    for (size_t i = 0; i < strokes.count; i++)
        assert_true(fabs(strokes.list[i].width - 2 * s.look.line) > 0.1); /* no sample */
    close_shown(&s);
}

/* ---- profiles ---- */

/* y of a value on an axis from 0 to 50 N, with a twenty-fifth above it, between lines of 2 px: rounded to 32nds of pixels. */
static double profile_y(double value)
{
    return TOP + round(32 * (1 + (1 - value / 52) * (HEIGHT - 2))) / 32;
}

static bool passes(const struct stroke *curve, double x, double y)
{
    for (size_t i = 0; i < curve->count; i++) {
        if (fabs(curve->at[i].x - x) < 0.02 && fabs(curve->at[i].y - y) < 0.02)
            return true;
    }
    return false;
}

/* Numbers below the plot are below their beads, of which the first and the last have half a step more; returns how many there
 * are. */
static size_t numbers_are_below_beads(const struct shown *s, double first, double last)
{
    size_t count = 0;
    for (size_t i = 0; i < s->seen.count; i++) {
        char *end;
        const double number = strtod(s->seen.text[i].markup, &end);
        if (*end || end == s->seen.text[i].markup || s->seen.text[i].y < BOTTOM)
            continue;
        const double x = LEFT + (number - first + 0.5) / (last - first + 1) * WIDTH;
        assert_true(number >= first && number <= last);
        assert_true(fabs(s->seen.text[i].x + s->seen.text[i].width / 2 - x) < 2);
        count++;
    }
    return count;
}

/* Profiles of two chains in one plot share an axis, that of both. */
static void overlaid_profiles_share_an_axis(void **)
{
    struct shown s, other;
    struct bead_message msg = {""};
    open_shown(&s, "chain: {beads: [{bead: large-steel, count: 20}]}\noutputs: [{table: a.csv}]\n");
    open_shown(&other, "chain: {beads: [{bead: large-steel, count: 30}]}\noutputs: [{table: a.csv}]\n");
    s.setup.own_colour = other.setup.own_colour = true;
    s.setup.beads = (struct bead_span){3, 17};
    other.setup.beads = (struct bead_span){5, 27};
    s.type = bead_view_find(BEAD_VIEW_PROFILE);
    require(s.type->create(&s.setup, &s.view, &msg), &msg);
    require(s.type->create(&other.setup, &other.view, &msg), &msg);
    other.type = s.type;
    require(s.type->overlay(s.view, other.view, &msg), &msg);
    require(s.type->place(s.view, plot, NULL, &msg), &msg);
    decorate(&s);
    assert_true(numbers_are_below_beads(&s, 3, 27) >= 3);
    close_shown(&s);
    close_shown(&other);
}

/* The curve goes through each value in the middle of its bead's share of the width, over an area down to zero, with a dot there
 * where dots have room; of a single bead it is level, from edge to edge. */
static void profiles_have_their_values(void **)
{
    static const size_t all[] = {8, 40, 1};
    for (size_t variant = 0; variant < 3; variant++) {
        const size_t n = all[variant];
        const bool dots = variant == 0;
        struct shown s;
        struct bead_message msg = {""};
        char text[200];
        double values[64], *force = values + 1; /* bead 0 is out of sight */
        snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, count: %zu}]}\noutputs: [{table: a.csv}]\n", n);
        open_shown(&s, text);
        s.setup.beads = (struct bead_span){1, n};
        s.setup.own_colour = variant == 1; /* of the second of several chains */
        s.setup.chain_index = 1;
        open_view(&s, BEAD_VIEW_PROFILE);
        decorate(&s);
        assert_bounds(&strokes.list[1], LEFT, round(profile_y(0) - 1), RIGHT, round(profile_y(0) - 1) + 2); /* the line of zero */
        assert_true(numbers_are_below_beads(&s, 1, (double)n) >= 1);
        values[0] = 33;
        for (size_t i = 0; i < n; i++)
            force[i] = 26 + 24 * cos((double)i);
        const struct bead_sample sample = {.field = {[BEAD_FIELD_FORCE] = values}};
        require(s.type->feed(s.view, &sample, &msg), &msg);
        draw(&s, 0);
        assert_int_equal(strokes.count, dots ? 3 : 2);
        const struct stroke *area = &strokes.list[0], *curve = &strokes.list[1], *dot = &strokes.list[2];
        const double pitch = (double)WIDTH / (double)n, first = n == 1 ? LEFT : LEFT + pitch / 2, last = LEFT + RIGHT - first;
        const struct bead_rgb ink = variant == 1 ? bead_look_curve(&s.look, 1) : s.look.accent;
        assert_true(stroke_has(area, true, ink) && stroke_has(curve, false, ink));
        assert_at(curve->width, 1.8 * s.look.line);
        const struct bead_dashes *dashes = bead_look_dashes(1);
        assert_int_equal(curve->dashes, variant == 1 ? dashes->count : 0);
        for (int i = 0; i < curve->dashes; i++)
            assert_at(curve->dash[i], curve->width * dashes->lengths[i]);
        assert_true(curve->clip_low[0] == LEFT && curve->clip_high[1] == BOTTOM && curve->join == CAIRO_LINE_JOIN_ROUND);
        for (int e = 0; e < 2; e++) {
            assert_at(curve->at[e ? curve->count - 1 : 0].x, e ? last : first);
            assert_true(passes(curve, e ? last : first, profile_y(force[e ? n - 1 : 0])));
            assert_true(passes(area, e ? last : first, profile_y(0)));
        }
        for (size_t i = 0; n > 1 && i < n; i++)
            assert_true(passes(curve, LEFT + ((double)i + 0.5) * pitch, profile_y(force[i])));
        assert_true(area->count >= curve->count + 2);
        if (dots) {
            const double r = 1.5 * 1.8 * s.look.line;
            assert_bounds(dot, first - r, profile_y(50) - r, last + r, profile_y(26 + 24 * cos(3)) + r);
            assert_int_equal(dot->begun, n);
        }
        close_shown(&s);
    }
}

/* For a string the curve passes through each mass between the ends, where it is zero. */
static void strings_are_fixed(void **)
{
    enum { MASSES = 7 };
    struct shown s;
    struct bead_message msg = {""};
    double values[MASSES];
    open_shown(&s, "chain: {equation: fput, points: 7, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 10}\noutputs: [{table: "
                   "a.csv, show: modes}]\n");
    s.setup.field = BEAD_FIELD_DISPLACEMENT;
    open_view(&s, BEAD_VIEW_PROFILE);
    decorate(&s);
    for (size_t i = 0; i < MASSES; i++)
        values[i] = 26 + 5 * (double)i;
    const struct bead_sample sample = {.field = {[BEAD_FIELD_DISPLACEMENT] = values}};
    require(s.type->feed(s.view, &sample, &msg), &msg);
    draw(&s, 0);
    const struct stroke *curve = &strokes.list[1];
    for (size_t i = 0; i < MASSES + 2; i++)
        assert_true(
            passes(curve, LEFT + (double)WIDTH * (double)i / (MASSES + 1), profile_y(i > 0 && i <= MASSES ? values[i - 1] : 0)));
    close_shown(&s);
}

/* The thin line of films is explained where its peaks are kept: of forces, and with all beads in view. */
static void kept_peaks_are_explained(void **)
{
    for (int variant = 0; variant < 4; variant++) {
        struct shown s;
        open_shown(&s, SENSORS);
        s.setup.titles = BEAD_TITLES_ABOVE;
        s.setup.fill = true;
        s.setup.hold = variant != 1;
        s.setup.cells = variant == 1;
        s.setup.colours.low = variant == 2 ? -50 : 0;
        s.setup.fill = variant != 3;
        open_view(&s, BEAD_VIEW_PROFILE);
        decorate(&s);
        size_t said = 0;
        for (size_t i = 0; i < s.seen.count; i++)
            said += strcmp(s.seen.text[i].markup, "faint: peak so far") == 0;
        assert_int_equal(said, variant == 0);
        close_shown(&s);
    }
}

/* ---- images ---- */

/* A pixel is enough for an image, less is none; it needs beads, and a stretch of time. */
static void images_need_room(void **)
{
    struct shown s;
    struct bead_message msg = {""};
    const struct bead_view_type *type = bead_view_find(BEAD_VIEW_SPACETIME);
    struct bead_colormap map;
    require(bead_colormap_load("ember", &map, &msg), &msg);
    open_shown(&s, SENSORS);
    s.setup.colours.map = &map;
    for (int i = 0; i < 4; i++) {
        const int width = i == 1 ? 0 : 1, height = i == 2 ? 0 : 1;
        struct bead_view *view = NULL;
        require(type->create(&s.setup, &view, &msg), &msg);
        assert_int_equal(type->place(view, (struct bead_rect){LEFT, TOP, width, height}, NULL, &msg),
                         width && height ? BEAD_OK : BEAD_ERROR_UNSUPPORTED);
        type->destroy(view);
    }
    for (int i = 0; i < 4; i++) {
        struct bead_view *view = NULL;
        s.setup.beads = (struct bead_span){3, i == 1 ? 2 : 3};
        s.setup.time[0] = i == 2 ? s.setup.time[1] : 0;
        const enum bead_error err = type->create(&s.setup, &view, &msg);
        assert_int_equal(err, i == 1 || i == 2 ? BEAD_ERROR_UNSUPPORTED : BEAD_OK);
        type->destroy(view);
    }
    close_shown(&s);
}

/* ---- colour bars ---- */

static const uint8_t *pixel_at(const struct shown *s, double x, double y)
{
    return cairo_image_surface_get_data(s->surface) + (size_t)y * (size_t)cairo_image_surface_get_stride(s->surface) +
           4 * (size_t)x;
}

static bool is_colour(const uint8_t *bgr, const uint8_t rgb[3])
{
    return abs(bgr[0] - rgb[2]) < 3 && abs(bgr[1] - rgb[1]) < 3 && abs(bgr[2] - rgb[0]) < 3;
}

/* Each colour is at its value, upwards or to the right, and numbers are beside it; pointed ends have the last colours, where values
 * lie beyond. */
static void bars_have_numbers_at_their_colours(void **)
{
    for (int variant = 0; variant < 8; variant++) {
        const bool lies = variant & 1, over = variant & 2, under = variant & 4;
        const struct bead_rect bar = lies ? (struct bead_rect){120, 60, 400, 14} : (struct bead_rect){120, 60, 14, 256};
        struct shown s;
        struct bead_message msg = {""};
        struct bead_colormap map;
        open_shown(&s, SENSORS);
        require(bead_colormap_load("ember", &map, &msg), &msg);
        const struct bead_colours colours = {&map, BEAD_SCALE_LINEAR, 0, 50, 0};
        cairo_set_source_rgb(s.cr, 0, 1, 0);
        cairo_paint(s.cr);
        s.seen.count = 0;
        const double reach = lies ? bead_colour_bar_draw_lying(s.cr, &s.look, &colours, "N", bar, over, under)
                                  : bead_colour_bar_draw(s.cr, &s.look, &colours, "N", NULL, bar, over, under);
        cairo_surface_flush(s.surface);
        assert_true(reach > 5);
        for (int value = 1; value < 50; value++) {
            const double part = (value + 0.05) / 50;
            const uint8_t *here = lies ? pixel_at(&s, bar.x + part * bar.width, bar.y + bar.height / 2)
                                       : pixel_at(&s, bar.x + bar.width / 2, bar.y + (1 - part) * bar.height);
            bool near = false; /* bands and pixels have other borders */
            for (int k = -1; k <= 1; k++)
                near |= is_colour(here, map.rgb[(int)(256 * part) + k]);
            assert_true(near);
        }
        size_t numbers = 0;
        for (size_t i = 0; i < s.seen.count; i++) {
            char *end;
            const double value = strtod(s.seen.text[i].markup, &end), part = value / 50;
            const double x = s.seen.text[i].x + s.seen.text[i].width / 2, y = s.seen.text[i].y + s.seen.text[i].height / 2;
            if (*end || end == s.seen.text[i].markup)
                continue;
            assert_true(fabs(lies ? x - bar.x - part * bar.width : y - bar.y - (1 - part) * bar.height) < 3);
            assert_true(lies ? s.seen.text[i].y > bar.y + bar.height : s.seen.text[i].x > bar.x + bar.width);
            numbers++;
        }
        assert_true(numbers >= 3);
        const uint8_t *beyond[] = {lies ? pixel_at(&s, bar.x - 5, bar.y + 7) : pixel_at(&s, bar.x + 7, bar.y + bar.height + 4),
                                   lies ? pixel_at(&s, bar.x + bar.width + 4, bar.y + 7) : pixel_at(&s, bar.x + 7, bar.y - 5)};
        assert_int_equal(is_colour(beyond[0], map.rgb[0]), under);
        assert_int_equal(is_colour(beyond[1], map.rgb[255]), over);
        close_shown(&s);
    }
}

/* ---- modes ---- */

/* A bar for each mode, in the middle of its share of the width; its height is its part of the first sample's energy, 1.04 at the
 * top. */
static void bars_of_modes_have_their_energy(void **)
{
    enum { MODES = 4, POINTS = 15 };
    struct shown s;
    struct bead_message msg = {""};
    open_shown(&s, "chain: {equation: fput, points: 15, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 10}\noutputs: [{table: "
                   "a.csv, show: modes}]\n");
    s.setup.modes = MODES;
    s.setup.time[1] = 10;
    open_view(&s, BEAD_VIEW_MODES);
    const size_t beads = bead_chain_beads(s.chain);
    double share[2][MODES];
    for (int k = 0; k < 2; k++) {
        double u[MOST] = {0}, v[MOST] = {0};
        for (size_t i = 0; i < beads; i++) { /* modes of fixed ends */
            for (int m = 1; m <= MODES; m++)
                u[i] += (k == 0 ? 1.0 / m : 0.3 * m) * sin(M_PI * m * ((double)i + (beads == POINTS ? 1 : 0)) / (POINTS + 1));
        }
        const struct bead_sample sample = {.time = k, .field = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_VELOCITY] = v}};
        double whole = 0;
        bead_chain_mode_energies(s.chain, sample.field, MODES, share[k]);
        for (int m = 0; m < MODES; m++) {
            const double frequency = 2 * sin(0.5 * M_PI * (m + 1) / (POINTS + 1)),
                         amplitude = k == 0 ? 1.0 / (m + 1) : 0.3 * (m + 1);
            whole += share[0][m];
            assert_true(fabs(share[k][m] / share[0][0] - pow(frequency * amplitude / (2 * sin(0.5 * M_PI / (POINTS + 1))), 2)) <
                        1e-9 * share[k][m] / share[0][0] + 1e-9);
        }
        require(s.type->feed(s.view, &sample, &msg), &msg);
        draw(&s, k);
        assert_int_equal(strokes.count, MODES);
        for (size_t m = 0; m < MODES; m++) {
            const double middle = LEFT + ((double)m + 0.5) * WIDTH / MODES, width = 0.62 * WIDTH / MODES;
            const double top = TOP + round(16 * HEIGHT * (1 - fmin(1, share[k][m] / (1.04 * whole)))) / 16;
            assert_true(stroke_has(&strokes.list[m], true, bead_look_curve(&s.look, m)));
            assert_bounds(&strokes.list[m], round(middle - width / 2), top, round(middle - width / 2) + round(width), BOTTOM);
        }
    }
    draw(&s, 0.5); /* half way between two samples */
    const double half = (share[0][1] + share[1][1]) / 2, whole = share[0][0] + share[0][1] + share[0][2] + share[0][3];
    assert_at(strokes.list[1].low[1], TOP + round(16 * HEIGHT * (1 - half / (1.04 * whole))) / 16);
    decorate(&s);
    double width, height;
    const struct bead_text_style style = {.family = s.look.family, .size = s.look.tick};
    for (size_t m = 1; m <= MODES; m++) { /* numbers below their bars */
        const char number[] = {(char)('0' + m), '\0'};
        const size_t at = find(&s.seen, number);
        bead_text_size(s.cr, &style, number, &width, &height);
        assert_true(fabs(s.seen.text[at].x + s.seen.text[at].width / 2 - (LEFT + ((double)m - 0.5) * WIDTH / MODES)) < 2 &&
                    s.seen.text[at].y > BOTTOM);
    }
    close_shown(&s);
}

/* ---- panels ---- */

/* Axes are at the panel's left, beyond the plot and its colours; titles beside it or above; names left of the numbers below. */
static void axes_are_at_their_panels(void **)
{
    struct shown s;
    open_shown(&s, SENSORS);
    struct bead_axis axis;
    bead_axis_make(&axis, 0, 50, "N", BEAD_SCALE_LINEAR, HEIGHT, s.look.tick, false);
    for (int variant = 0; variant < 8; variant++) {
        const int beyond = variant & 1 ? 30 : 0, coloured = variant & 2 ? 9 : 0, panel = LEFT - beyond, left = panel - coloured;
        const bool over = variant & 4;
        s.setup.beyond[0] = beyond;
        s.setup.beyond[1] = variant & 1 ? 17 : 0;
        s.setup.coloured = coloured;
        s.setup.titles = over ? BEAD_TITLES_ABOVE : BEAD_TITLES_BESIDE;
        strokes_begin();
        bead_panel_fill(s.cr, &s.setup, plot);
        assert_bounds(&strokes.list[0], panel, TOP, RIGHT + s.setup.beyond[1], BOTTOM);
        assert_true(stroke_has(&strokes.list[0], true, s.look.panel));
        s.seen.count = 0;
        strokes_begin();
        bead_panel_axis(s.cr, &s.setup, &axis, plot, false, "force");
        const struct stroke *ticks = &strokes.list[0];
        assert_at(ticks->high[0], left - s.look.line);
        assert_at(ticks->low[0], left - s.look.line - round(0.38 * s.look.tick));
        const size_t title = s.seen.count - 1;
        assert_true(strncmp(s.seen.text[title].markup, "force (", 7) == 0);
        if (over) {
            assert_true(fabs(s.seen.text[title].x - left) < 3 &&
                        s.seen.text[title].y + s.seen.text[title].height > TOP - 0.38 * em - 1);
            assert_true(s.seen.text[title].y + s.seen.text[title].height < TOP); /* below its baseline are parts of letters */
        } else {
            assert_true(s.seen.text[title].x + s.seen.text[title].width < left - 0.38 * s.look.tick);
            assert_true(fabs(s.seen.text[title].y + s.seen.text[title].height / 2 - (TOP + HEIGHT / 2.0)) < 3);
        }
        /* Names: 0.65 of a letter from the panel to their ends, or clear of a number that reaches out of it. */
        struct bead_axis along;
        bead_axis_make(&along, 0.5, 9.5, "1", BEAD_SCALE_LINEAR, WIDTH, s.look.tick, true);
        s.seen.count = 0;
        bead_panel_name(s.cr, &s.setup, &along, plot, "bead");
        assert_int_equal(s.seen.count, 1);
        const double width = bead_panel_name_room(&s.look, "bead") - 0.65 * s.look.tick;
        assert_true(fabs(s.seen.text[0].x + width - (left - 0.65 * s.look.tick)) < 3);
        assert_true(fabs(s.seen.text[0].y + s.seen.text[0].height - (BOTTOM + s.look.line + 1.38 * s.look.tick)) < 2);
        bead_axis_make(&along, 100000, 900000, "", BEAD_SCALE_LINEAR, WIDTH, s.look.tick, true);
        double reach = 0, number, height;
        const struct bead_text_style style = {.family = s.look.family, .size = s.look.tick};
        for (size_t i = 0; i < along.count; i++) {
            bead_text_size(NULL, &style, along.ticks[i].label, &number, &height);
            reach = fmax(reach, number / 2 - along.ticks[i].place * WIDTH);
        }
        s.seen.count = 0;
        bead_panel_name(s.cr, &s.setup, &along, plot, "bead");
        assert_true(fabs(s.seen.text[0].x + width - (left - fmax(0.65 * s.look.tick, reach + 0.3 * s.look.tick))) < 3);
        /* A remark at the right end of the title's line, where both have room, with a letter between. */
        double taken, said;
        char markup[200];
        const struct bead_text_style label = {.family = s.look.family, .size = em};
        bead_axis_title(&axis, "force", markup, sizeof markup);
        bead_text_size(s.cr, &label, markup, &taken, &height);
        bead_text_size(s.cr, &label, "as measured", &said, &height);
        for (int wide = 0; wide < 2; wide++) {
            struct bead_rect narrow = plot;
            narrow.width = (int)ceil(taken + said + em) - coloured + (wide ? 1 : -1);
            s.seen.count = 0;
            bead_panel_remark(s.cr, &s.setup, &axis, narrow, "force", "as measured");
            assert_int_equal(s.seen.count, over && wide);
            if (s.seen.count > 0)
                assert_true(fabs(s.seen.text[0].x + s.seen.text[0].width - (LEFT + narrow.width)) < 3 && s.seen.text[0].y < TOP);
        }
        s.setup.ticks_only = true;
        s.seen.count = 0;
        bead_panel_axis(s.cr, &s.setup, &axis, plot, false, "force");
        bead_panel_name(s.cr, &s.setup, &along, plot, "bead");
        bead_panel_remark(s.cr, &s.setup, &axis, plot, "force", "as measured");
        assert_int_equal(s.seen.count, 0);
        s.setup.ticks_only = false;
    }
    close_shown(&s);
}

/* ---- the line of theory ---- */

/* From bead 1 when the striker hits it, as fast as the wave of the force that passed; dark below light. */
static void theory_is_as_fast_as_its_force(void **)
{
    for (int orientation = 0; orientation < 3; orientation++) {
        struct shown s;
        struct bead_message msg = {""};
        struct bead_theory_line *line;
        open_shown(&s, "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 60}]}\noutputs: "
                       "[{table: a.csv}]\n");
        const bool down = orientation == 1, matrix = orientation == 2;
        s.setup.orientation = down ? BEAD_TIME_DOWN : matrix ? BEAD_MATRIX : BEAD_TIME_RIGHT;
        s.setup.time[1] = 5e-4;
        require(bead_theory_line_create(&s.setup, &line, &msg), &msg);
        double force[64] = {0};
        const size_t passed = 12;
        for (int k = 0; k < 4; k++) { /* contact j: 100 + j at its highest */
            for (size_t j = 0; j < passed; j++)
                force[j] = (double[]){0, 20, 100, 0.001}[k] * (k == 2 ? 1 + 0.01 * (double)j : 1);
            bead_theory_line_feed(
                line, &(struct bead_sample){.time = k * 1e-5, .active = 61, .field = {[BEAD_FIELD_CONTACT_FORCE] = force}});
        }
        strokes_begin();
        s.seen.count = 0;
        bead_theory_line_draw(line, &s.look, plot, plot, s.cr);
        const struct stroke *dark = &strokes.list[0], *light = &strokes.list[1];
        assert_true(dark->count == 2 && light->count == 2 && dark->rgb[0] == 0 && light->rgb[0] == 1);
        assert_at(dark->width, 3.5 * s.look.line);
        assert_at(light->width, 1.5 * s.look.line);
        assert_true(light->dashes == 2 && light->dash_offset == 0 && light->dash[0] == 6 * s.look.line &&
                    light->dash[1] == 4 * s.look.line);
        assert_true(light->clip_low[0] == LEFT && light->clip_high[0] == RIGHT);
        /* Rows of beads 0 to 60, each as high as the others; the top of a parabola through 20, 100, 0 is a little higher. */
        const double peak = 100 * (1 + 0.01 * (double)(passed - 1)), before = 20, after = 0.001, bend = before - 2 * peak + after;
        const double top = peak - (after - before) * (after - before) / (8 * bend), speed = bead_compacton_speed(s.chain, top);
        const double place[2] = {1.5 / 61, 60.5 / 61}, when[2] = {0, 59 / speed / 5e-4};
        for (int e = 0; e < 2; e++) {
            assert_at(light->at[e].x, LEFT + WIDTH * (down ? place[e] : when[e]));
            assert_true(fabs(light->at[e].y - (TOP + HEIGHT * (down ? when[e] : matrix ? place[e] : 1 - place[e]))) < 0.02);
        }
        /* The words are in the corner where beads are at rest, on a piece of the page. */
        const struct stroke *box = &strokes.list[2];
        const double pad = 0.4 * s.look.tick;
        assert_true(strokes.count == 3 && stroke_has(box, true, s.look.background) && s.seen.count == 1);
        if (down)
            assert_at(box->high[0], RIGHT - pad);
        else
            assert_at(box->low[0], LEFT + pad);
        if (matrix)
            assert_at(box->high[1], BOTTOM - pad);
        else
            assert_at(box->low[1], TOP + pad);
        assert_true(fabs(s.seen.text[0].x - (box->low[0] + pad)) < 3 && s.seen.text[0].y > box->low[1] &&
                    s.seen.text[0].x + s.seen.text[0].width < box->high[0] &&
                    s.seen.text[0].y + s.seen.text[0].height < box->high[1]);
        assert_true(strstr(s.seen.text[0].markup, "theory: Nesterenko") != NULL);
        strokes_begin();
        s.seen.count = 0;
        bead_theory_line_draw(line, &s.look, plot, (struct bead_rect){LEFT + 60, TOP + 60, 50, 50}, s.cr);
        assert_true(strokes.count == 2 && s.seen.count == 0); /* over a part that has no room for words */
        bead_theory_line_destroy(line);
        close_shown(&s);
    }
}

/* ---- the stage's row of all beads ---- */

/* Names and pointers below beads with sensors, rings around them in the row. */
static void sensors_of_stages_have_rings(void **)
{
    struct shown s;
    open_shown(&s, "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 40}, {bead: "
                   "small-steel, sensor: one}, "
                   "{bead: large-steel, count: 19}, {bead: large-steel, sensor: other}, {bead: large-steel, count: 30}], wall: "
                   "brass}\noutputs: [{table: a.csv}]\n");
    s.look.tick = 12;
    s.look.line = 1;
    s.setup.field = BEAD_FIELD_CONTACT_FORCE;
    s.setup.light = BEAD_LIGHT_CONTACTS;
    open_view(&s, BEAD_VIEW_STAGE);
    decorate(&s);
    const struct bead_view *v = s.view;
    const double *position = bead_chain_position(s.chain), *radius = bead_chain_radius(s.chain);
    const size_t beads = bead_chain_beads(s.chain), bead[] = {41, 61};
    const double scale = WIDTH / (position[beads - 1] - position[0] + radius[0] + radius[beads - 1]),
                 middle = v->row.y + v->row.height / 2.0;
    assert_int_equal(v->row.y, v->strip.y + v->strip.height);
    assert_int_equal(v->row.height, (int)ceil(fmax(6, 0.8 * 12)));
    assert_int_equal(v->row.y + v->row.height + (int)ceil(BEAD_STAGE_NUMBERS * 12), BOTTOM);
    size_t rings = 0, pointers = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *ring = &strokes.list[i];
        if (!stroke_has(ring, ring->filled, s.look.ink))
            continue;
        if (ring->filled && ring->count == 3) {
            const double x = LEFT + (position[bead[pointers]] - position[0] + radius[0]) * scale;
            assert_bounds(ring, x - 3, v->row.y + v->row.height, x + 3, v->row.y + v->row.height + 3);
            assert_at(ring->at[2].x, x);
            assert_at(ring->at[2].y, v->row.y + v->row.height);
            pointers++;
        } else if (!ring->filled && ring->count > 2) {
            const double x = LEFT + (position[bead[rings]] - position[0] + radius[0]) * scale;
            const double r = fmin(radius[bead[rings]] * scale + 2, 0.5 * v->row.height - 1);
            assert_at((ring->low[0] + ring->high[0]) / 2, x);
            assert_at((ring->high[0] - ring->low[0]) / 2, r);
            assert_at(ring->at[0].y, middle);
            rings++;
        }
    }
    assert_true(rings == 2 && pointers == 2);
    for (int k = 0; k < 2; k++) {
        const size_t at = find(&s.seen, k ? "other" : "one");
        assert_true(fabs(s.seen.text[at].x + s.seen.text[at].width / 2 -
                         (LEFT + (position[bead[k]] - position[0] + radius[0]) * scale)) < 2);
        assert_true(fabs(s.seen.text[at].y + s.seen.text[at].height - (v->row.y + v->row.height + 1.1 * 12)) < 2);
    }
    close_shown(&s);
}

/* What lights up: contacts by their force; whole beads by their own, the mean of their contacts', whichever of the two is the
 * field. */
static void keys_say_what_lights_up(void **)
{
    static const struct {
        enum bead_field field;
        enum bead_light light;
        const char *words;
    } cases[] = {{BEAD_FIELD_CONTACT_FORCE, BEAD_LIGHT_CONTACTS, "light: contact force  0"},
                 {BEAD_FIELD_CONTACT_FORCE, BEAD_LIGHT_BEADS, "light: bead force  0"},
                 {BEAD_FIELD_FORCE, BEAD_LIGHT_BEADS, "light: bead force  0"}};
    struct shown s;
    open_shown(&s, SENSORS);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        s.setup.field = cases[i].field;
        s.setup.light = cases[i].light;
        s.seen.count = 0;
        (void)bead_stage_draw_key_of(s.cr, &s.setup, (const struct bead_chain *const *)&s.chain, 1, 780, 200, em);
        (void)find(&s.seen, cases[i].words);
    }
    close_shown(&s);
}

/* A bead is brightest at the largest value shown; of quantities that are no forces, at the force of the chain's compression, by
 * Hertz's law. */
static void light_is_full_at_a_force(void **)
{
    struct shown s;
    open_shown(&s, "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 9}]}\n"
                   "outputs: [{table: a.csv}]\n");
    assert_true(bead_stage_full(&s.setup) == 50);
    s.setup.field = BEAD_FIELD_VELOCITY;
    const double radius = bead_chain_radius(s.chain)[0];
    const struct bead_material *steel = material_of(s.scene, "large-steel");
    const double stiffness = 4.0 / 3 * (0.5 * steel->modulus / (1 - steel->poisson * steel->poisson)) * sqrt(radius / 2);
    const double force = stiffness * pow(bead_compression_scale(s.chain), 1.5);
    assert_true(force > 1 && fabs(bead_stage_full(&s.setup) / force - 1) < 1e-9);
    close_shown(&s);
}

/* ---- the line about the horizon ---- */

/* A piece of the horizon's line, 1.6 em long, stands before the words, half an em from them, at the height of their middle; both
 * together keep to the left or the right. Of a chain that is predictable throughout there is no line. */
static void horizons_are_explained(void **)
{
    const struct bead_rect rect = {60, 90, 700, 40};
    struct shown s;
    open_shown(&s, SENSORS);
    for (int variant = 0; variant < 4; variant++) {
        const bool right = variant & 1, throughout = variant & 2;
        struct bead_trust trust = bead_trust_make(s.chain, 10);
        trust.until = throughout ? INFINITY : 5e-4;
        s.seen.count = 0;
        strokes_begin();
        bead_trust_draw(s.cr, &s.look, &trust, rect, right);
        assert_int_equal(s.seen.count, 1);
        double begins = s.seen.text[0].x, width, height;
        const struct bead_text_style style = {.family = s.look.family, .size = em};
        bead_text_size(s.cr, &style, s.seen.text[0].markup, &width, &height);
        assert_int_equal(strokes.count, throughout ? 0 : 2); /* the line and its edges */
        for (size_t i = 0; i < strokes.count; i++) {
            const double from = right ? rect.x + rect.width - width - 2.1 * em : rect.x;
            assert_bounds(&strokes.list[i], from, rect.y + 20, from + 1.6 * em, rect.y + 20);
        }
        begins -= right ? rect.x + rect.width - width : throughout ? rect.x : rect.x + 2.1 * em;
        assert_true(fabs(begins) < 3 && fabs(s.seen.text[0].y + s.seen.text[0].height / 2 - (rect.y + 20)) < 0.25 * em);
    }
    close_shown(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sensors_have_their_curves),
        cmocka_unit_test(many_sensors_are_named_in_colour),
        cmocka_unit_test(bars_of_modes_have_their_energy),
        cmocka_unit_test(axes_are_at_their_panels),
        cmocka_unit_test(theory_is_as_fast_as_its_force),
        cmocka_unit_test(sensors_of_stages_have_rings),
        cmocka_unit_test(keys_say_what_lights_up),
        cmocka_unit_test(light_is_full_at_a_force),
        cmocka_unit_test(horizons_are_explained),
        cmocka_unit_test(profiles_have_their_values),
        cmocka_unit_test(strings_are_fixed),
        cmocka_unit_test(kept_peaks_are_explained),
        cmocka_unit_test(images_need_room),
        cmocka_unit_test(bars_have_numbers_at_their_colours),
        cmocka_unit_test(overlaid_profiles_share_an_axis),
    };
    return cmocka_run_group_tests_name("what views draw", tests, NULL, NULL);
}
