/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The view of a stage: beads are where they belong, light up where they are pressed, and have their names below them. */
#include "tests/scenes.h"

#include "beadreel/view.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/paint/canvas.h"
#include "render/stage/stage_key.h"
#include "render/stage/stage_view.h"
#include "render/view/views.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

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

/* A stage of this chain, at rest, of 1740 x 360 px, or of a part of that. */
static void open_smaller(struct setting *s, const char *chain, enum bead_light light, double magnify, int part)
{
    struct bead_message msg = {""};
    char text[600];
    snprintf(text, sizeof text, "%s\noutputs: [{movie: a.mp4}]\n", chain);
    *s = (struct setting){.scene = parse(text)};
    require(bead_chain_create(s->scene, 0, &s->chain, &msg), &msg);
    bead_look_film(&s->look, 1920 / part, 1080 / part, true, false);
    const size_t beads = bead_chain_beads(s->chain);
    const struct bead_view_setup setup = {.chain = s->chain,
                                          .field = bead_chain_spec(s->chain)->system->has_contacts ? BEAD_FIELD_FORCE
                                                                                                   : BEAD_FIELD_DISPLACEMENT,
                                          .beads = {0, beads - 1},
                                          .time = {0, 1e-3},
                                          .colours = {&s->map, BEAD_SCALE_LINEAR, 0, 40, 0},
                                          .look = &s->look,
                                          .axes = true,
                                          .bead_labels = true,
                                          .magnify = magnify,
                                          .light = light};
    require(bead_view_stage_type.create(&setup, &s->view, &msg), &msg);
    require(bead_view_stage_type.place(s->view, (struct bead_rect){90 / part, 100 / part, 1740 / part, 360 / part}, NULL, &msg),
            &msg);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1920, 1080);
    const struct bead_text_watch watch = {see, &s->labels};
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    require(bead_view_stage_type.decorate(s->view, cr, &msg), &msg);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    feed_view(s, bead_stage_field(&setup), 0);
}

static void open_magnified(struct setting *s, const char *chain, enum bead_light light, double magnify)
{
    open_smaller(s, chain, light, magnify, 1);
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

/* No bead passes through another, and one between two heavy ones has equal air on both sides. */
static void light_beads_part_heavy_ones(void **state)
{
    (void)state;
    static const char *const between[] = {"{bead: large-steel, radius: 2 mm}", "{bead: large-steel, radius: 1 mm, count: 3}",
                                          "{bead: large-steel, radius: 3 mm}", "{bead: large-steel, radius: 2 mm}"};
    for (size_t c = 0; c < 4; c++) { /* first of all the striker, once heavy as well */
        struct setting s;
        char text[300];
        snprintf(text, sizeof text, "chain: {%s%s, {bead: large-steel, radius: 10 mm}]}",
                 c < 3 ? "beads: [{bead: large-steel, radius: 10 mm}, "
                       : "striker: {bead: large-steel, radius: 10 mm, velocity: 1 m/s}, beads: [",
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
        assert_true(c != 2 || fabs(left - 2 * sqrt(30e-6)) < 1e-9); /* large enough: all touch */
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
            assert_true(fabs(last->x + last->r - stage->wall.x) < rounding && last->edge[1] == stage->wall.x && last->near[1] == 1);
        const struct bead_chain_spec *spec = bead_chain_spec(s.chain);
        for (int k = 0; k < 3 && c != 3;
             k++) { /* walls are dark: their material's colour, squared as light is, less than a third */
            const double own = spec->wall == BEAD_WALL_MATERIAL ? s.scene->materials[spec->wall_material].colour[k] : sqrt(0.3);
            assert_true(fabs(stage->wall.colour[k] - 0.3 * own * own) < 1e-6);
        }
        close_view(&s);
    }
}

/* A stage half as large shows the same: all places in radii of the largest bead, all lights and colours as they are. */
static void stages_scale(void **state)
{
    (void)state;
    const char *const chains[] = {few, unlike, taper, apart};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct setting s[2];
        for (int k = 0; k < 2; k++) {
            open_smaller(&s[k], chains[c], BEAD_LIGHT_CONTACTS, 1e-6, 1 + k);
            feed_view(&s[k], BEAD_FIELD_CONTACT_FORCE, 25);
        }
        const struct bead_stage *a = &s[0].view->stage, *b = &s[1].view->stage;
        const double rounding = 2.0 / BEAD_STAGE_RADII + 2.0 / 64 / (double)b->unit, first[2] = {a->beads[0].x, b->beads[0].x};
        assert_true(a->count == b->count && fabs(a->unit / (2 * (double)b->unit) - 1) < 0.03);
        for (size_t i = 0; i < a->count; i++) {
            const struct bead_stage_bead *of[2] = {&a->beads[i], &b->beads[i]};
            double places[2][4];
            for (int k = 0; k < 2; k++) {
                const double unit = k ? b->unit : a->unit,
                             all[4] = {of[k]->x - first[k], of[k]->r, of[k]->edge[0] - first[k], of[k]->edge[1] - first[k]};
                for (int p = 0; p < 4; p++)
                    places[k][p] = isfinite(all[p]) ? all[p] / unit : 99;
            }
            for (int p = 0; p < 4; p++) {
                if (!(fabs(places[0][p] - places[1][p]) < rounding * (double)(1 + i)))
                    fail_msg("chain %zu, bead %zu, place %d: %g and %g radii", c, i, p, places[0][p], places[1][p]);
            }
            assert_memory_equal(of[0]->colour, of[1]->colour, sizeof of[0]->colour);
            assert_memory_equal(of[0]->light, of[1]->light, sizeof of[0]->light);
            for (int side = 0; side < 2; side++)
                assert_true(fabs(of[0]->near[side] - of[1]->near[side]) < 0.1 &&
                            fabs(of[0]->tilt[side] - of[1]->tilt[side]) < 0.05 &&
                            fabs(of[0]->slope[side] - of[1]->slope[side]) < 0.05);
        }
        const double wall[2] = {(a->wall.x - first[0]) / a->unit, (b->wall.x - first[1]) / b->unit};
        assert_true((a->wall.width > 0) == (c != 3) && fabs(a->wall.width / a->unit - b->wall.width / b->unit) < 1e-5);
        assert_true(c == 3 || fabs(wall[0] - wall[1]) < rounding * (double)a->count);
        assert_memory_equal(a->wall.light, b->wall.light, sizeof a->wall.light);
        close_view(&s[0]);
        close_view(&s[1]);
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

/* The largest distance, in levels, from light on a nearly black bead of the colours along a row of pixels. */
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
    if (least > 5) /* measured: 4.6, where light rises most, as between its 17 points the scale is linear */
        fail_msg("what comes nearest to light is off by %g levels", least);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    close_view(&s);
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
    for (int x = 0; x < all.width; x++) { /* without an edge below: the lowest row has next to nothing */
        const uint8_t *over = clear.pixels + (size_t)(all.height - 1) * clear.stride + 4 * (size_t)x;
        assert_true(over[3] <= 255 / (0.6 * (double)v->stage.unit) && over[0] <= over[3]);
    }
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
    double let[2] = {0, 0}; /* at the half and the quarter of the way to the lower edge over which light on the floor ends */
    for (int k = 0; k < 2; k++) {
        const uint8_t *row = clear.pixels + (size_t)(all.height - (int)(0.6 * (double)v->stage.unit) / (2 << k)) * clear.stride;
        for (int x = 0; x < all.width; x++)
            let[k] += row[4 * x + 3];
    }
    assert_true(let[0] > 10 * all.width && fabs(let[1] / let[0] - 0.5) < 0.1); /* shadows end there, too */
    const double balls = 5 * 3.14159 * v->stage.unit * v->stage.unit;          /* with the striker */
    most = (most + 2) / 3; /* one alpha serves three channels: their mean is right */
    if (most > 2 || solid < 0.9 * balls || solid > 1.1 * balls || nothing < all.width * 10)
        fail_msg("off by %d levels; %d pixels hide all, balls have %.0f; %d hide nothing", most, solid, balls, nothing);
    bead_canvas_destroy(canvas);
    bead_frame_free(&clear);
    bead_frame_free(&grey);
    close_view(&s);
}

/* What presses a chain together all the time is no wave: light begins beyond it, and the relieved contacts have none. */
static void pressed_chains_are_dark_at_rest(void **state)
{
    (void)state;
    static const struct {
        double force, load; /* N, of 20 N at rest; of 20 N more, where colours end at 40 N */
    } cases[] = {{20, 0}, {25, 0.25}, {40, 1}, {50, 1}, {15, 0}};
    struct setting s;
    open_view(&s, "chain: {precompression: 20 N, " STRIKER "beads: [{bead: large-steel, count: 4}], wall: rigid}",
              BEAD_LIGHT_CONTACTS);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        feed_view(&s, BEAD_FIELD_CONTACT_FORCE, cases[i].force);
        for (size_t k = 0; k < s.view->contacts; k++)
            assert_float_equal(s.view->load[k], cases[i].load, 1e-9);
    }
    close_view(&s);
}

/* Beads are displaced, magnified, and light up on both sides of the contact that is pressed and nowhere else; between two moments
 * so far as the time has come. */
static void beads_move_and_light_up(void **state)
{
    (void)state;
    enum { PRESSED = 2, ALL = 6 };
    static const double magnify = 50, step = 1e-6, parts[] = {1, 0.5, 0};
    struct bead_message msg = {""};
    struct setting s;
    double at_rest[ALL], u[ALL + 1] = {0}, force[ALL + 1] = {0};
    open_magnified(&s, few, BEAD_LIGHT_CONTACTS, magnify);
    struct bead_view *v = s.view;
    assert_int_equal(v->stage.count, ALL - 1);
    assert_int_equal(v->contacts, ALL - 1); /* one is the wall's */
    for (size_t i = 0; i < v->count; i++)
        at_rest[i] = (double)v->stage.beads[i].x;
    for (int moment = 0; moment < 2; moment++) {
        for (size_t i = 0; i < v->count && moment; i++)
            u[i] = 1e-5 * (double)(i + 1) * (i % 2 ? 1 : -1);
        force[PRESSED] = moment ? 30 : 0; /* of 40 */
        force[v->contacts - 1] = moment ? 20 : 0;
        const struct bead_sample sample = {.time = step * (moment + 1),
                                           .field = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_CONTACT_FORCE] = force}};
        require(bead_view_stage_type.feed(v, &sample, &msg), &msg);
    }
    for (size_t p = 0; p < 3; p++) {
        float pressed[3], wall[3], dark[3];
        bead_stage_glow(0.75 * parts[p], pressed);
        bead_stage_glow(0.5 * parts[p], wall);
        bead_stage_glow(0, dark);
        bead_stage_advance(v, step * (1 + parts[p]));
        bead_stage_compose(v);
        for (size_t i = 0; i < v->count; i++) {
            const struct bead_stage_bead *b = &v->stage.beads[i];
            const double moved = magnify * parts[p] * u[i] * v->scale * v->stage.fine;
            assert_true(fabs(b->x - at_rest[i] - moved) <= 1.0 / 64 + 1e-4);
            const float *left = i == PRESSED + 1 ? pressed : dark, *right = i == PRESSED        ? pressed
                                                                            : i + 1 == v->count ? wall
                                                                                                : dark;
            for (int c = 0; c < 3; c++)
                assert_true(fabsf(b->light[0][c] - left[c]) < 1e-6f && fabsf(b->light[1][c] - right[c]) < 1e-6f && b->own[c] == 0);
        }
        for (int c = 0; c < 3; c++)
            assert_true(fabsf(v->stage.wall.light[c] - wall[c]) < 1e-6f);
        for (size_t i = 0; i + 1 < v->count; i++) { /* contacts move along */
            const struct bead_stage_bead *a = &v->stage.beads[i], *b = a + 1;
            struct bead_spot spot;
            assert_true(bead_stage_find(v, BEAD_NOTE_CONTACT, i, &spot));
            assert_true(fabs(spot.x - v->strip.x - 0.5 * (double)(a->x + a->r + b->x - b->r)) < 1.0 / 32);
        }
    }
    close_view(&s);
}

/* Beads that touch are parted by the plane that touches both: through the point where they do, square to the line of their centres.
 */
static void neighbours_are_parted_where_they_touch(void **state)
{
    (void)state;
    const char *const chains[] = {few, unlike, taper};
    for (size_t c = 0; c < 3; c++) {
        struct setting s;
        open_view(&s, chains[c], BEAD_LIGHT_CONTACTS);
        const struct bead_stage *stage = &s.view->stage;
        for (size_t i = 0; i + 1 < stage->count; i++) {
            const struct bead_stage_bead *a = &stage->beads[i], *b = &stage->beads[i + 1];
            const double part = (double)a->r / (double)(a->r + b->r), x = a->x + part * (b->x - a->x),
                         high = a->r + part * (b->r - a->r), rounding = 2.0 * stage->unit / BEAD_STAGE_RADII;
            assert_true(a->edge[1] == b->edge[0] && a->slope[1] == b->slope[0] && a->near[1] == 1 && b->near[0] == 1);
            assert_true(fabs(a->edge[1] + a->slope[1] * BEAD_STAGE_COSINE * high - x) < rounding);
            assert_true(fabs(a->slope[1] / BEAD_STAGE_COSINE * (b->x - a->x) + b->r - a->r) < 1e-3);
            assert_true(fabs(a->tilt[1] + b->tilt[0]) < 1e-6 &&
                        fabs(a->tilt[1] * hypot(b->x - a->x, b->r - a->r) - (b->r - a->r)) < 1e-3);
        }
        close_view(&s);
    }
}

/* The row has all beads where they are along the chain; those under force are larger, in the accent's colour; the box is around
 * those that are on the stage. */
static void the_row_marks_what_is_on_the_stage(void **state)
{
    (void)state;
    for (int lit = 0; lit < 2; lit++) {
        struct setting s;
        open_view(&s, many, BEAD_LIGHT_CONTACTS);
        feed_view(&s, BEAD_FIELD_CONTACT_FORCE, lit ? 50 : 0); /* more than full */
        const struct bead_view *v = s.view;
        const size_t last = v->count - 1;
        const float *top = v->window[0].box, *bottom = v->window[1].box, *left = v->window[2].box, *right = v->window[3].box;
        const double line = round(fmax(1, v->look.line));
        assert_true(top[1] == 0 && top[3] == line && bottom[3] == v->row.height && bottom[1] == v->row.height - line);
        assert_true(left[0] == top[0] && left[0] == bottom[0] && left[2] == left[0] + line && right[2] == top[2] &&
                    right[2] == bottom[2] && right[0] == right[2] - line && left[1] == 0 && right[3] == v->row.height);
        assert_true(fabs(v->balls[0].x + v->balls[last].x - v->row.width) < 0.05 * v->row.width);
        for (size_t i = 0; i <= last; i++) {
            const struct bead_ball *ball = &v->balls[i];
            const double pitch = (v->balls[last].x - v->balls[0].x) / (v->position[last] - v->position[0]),
                         r = fmax(0.7, 0.8 * v->radius[i] * pitch), room = 0.5 * v->row.height - 2;
            const double x = v->scale * v->place[i] - v->left;
            const double *own = bead_chain_colour(s.chain, i), accent[3] = {v->look.accent.r, v->look.accent.g, v->look.accent.b};
            assert_true(fabs(ball->x - v->balls[0].x - pitch * (v->position[i] - v->position[0])) < 1.0 / 32);
            const bool whole = lit && i > 0; /* the striker is pressed on one side only */
            assert_true((lit && !whole) || fabs(ball->r - fmin(room, r + (whole ? fmax(0.5 * r, 2.5) : 0))) < 1.0 / 32);
            assert_true(ball->y == 0.5f * (float)v->row.height);
            assert_true(ball->left <= ball->x - ball->r && ball->right >= ball->x + ball->r);
            for (int c = 0; c < 3; c++)
                assert_true((lit && !whole) || fabs(ball->rgba[c] - 255 * (lit ? accent[c] : own[c])) <= 0.51);
            if (fabs(x) > 2 && fabs(x - v->strip.width) > 2)
                assert_true((x > 0 && x < v->strip.width) == (ball->x > left[0] - 1 && ball->x < right[2] + 1));
        }
        close_view(&s);
    }
}

/* A struck bead is in the window, from one end of a long chain to the other, which is seen as a whole: the window ends beyond its
 * last bead, and moves by less than its width, so that a pulse of five beads stays in it. A stage twice as wide may be twice as
 * high. */
static void windows_go_along(void **state)
{
    (void)state;
    struct setting s;
    struct bead_message msg = {""};
    double u[257], force[256];
    open_view(&s, many, BEAD_LIGHT_CONTACTS);
    struct bead_view *v = s.view;
    const double pitch = v->scale * (v->place[v->count - 1] - v->place[0]) / (double)(v->count - 1);
    assert_true(v->count < 256 && v->camera.width == v->strip.width);
    assert_true(v->camera.step <= v->camera.width - 4 * pitch && v->camera.step > v->camera.width - 6.5 * pitch);
    double left = v->left;
    const size_t frames = 12 * (v->contacts + 3);
    for (size_t f = 0; f < frames; f++) {
        const double at = (double)f / 12;
        for (size_t i = 0; i <= v->count; i++)
            u[i] = 1e-5 / (1 + exp((double)i - at));
        for (size_t i = 0; i < v->count; i++)
            force[i] = 1.6e7 * (u[i] - u[i + 1]);
        const struct bead_sample sample = {.time = 1e-6 * (double)(f + 1),
                                           .field = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_CONTACT_FORCE] = force}};
        require(bead_view_stage_type.feed(v, &sample, &msg), &msg);
        bead_stage_advance(v, sample.time);
        const double x = v->scale * bead_stage_between(v, at - 0.5) - v->left;
        if (at < (double)v->contacts && !(x > 0 && x < v->strip.width && v->left >= left && v->left == round(v->left)))
            fail_msg("the wave is at %g, %g px of %d; the window at %g, before at %g", at, x, v->strip.width, v->left, left);
        left = v->left;
    }
    const double end = v->scale * v->ends[1] - v->left;
    assert_true(end < v->strip.width && end > v->strip.width - 3 * pitch);
    assert_true(fabs(bead_stage_height(2000) / bead_stage_height(1000) - 2) < 1e-12);
    close_view(&s);
}

/* Notes point at beads where they are drawn, at contacts where two beads touch, at the wall; at things out of sight in the row. */
static void things_are_found_where_they_are_drawn(void **state)
{
    (void)state;
    const char *const chains[] = {few, unlike, many};
    for (size_t c = 0; c < 3; c++) {
        struct setting s;
        struct bead_spot spot;
        size_t below = 0;
        open_view(&s, chains[c], BEAD_LIGHT_CONTACTS);
        struct bead_view *v = s.view;
        const struct bead_stage_bead *b = v->stage.beads;
        const double rounding = (double)v->stage.unit / BEAD_STAGE_RADII + 1.0 / 32;
        for (size_t i = 0; i < v->count; i++) {
            assert_true(bead_stage_find(v, BEAD_NOTE_BEAD, i, &spot));
            assert_true(spot.stage.x == v->strip.x && spot.stage.width == v->strip.width && spot.stage.y == v->strip.y + v->head &&
                        spot.stage.y + spot.stage.height == v->strip.y + v->strip.height);
            below += spot.below;
            const double off = spot.below ? spot.x - v->row.x - (double)v->balls[i].x : spot.x - v->strip.x - (double)b[i].x;
            assert_true(fabs(off) < rounding);
            if (spot.below)
                assert_true(spot.y == v->row.y + spot.r && spot.r == 0.5 * v->row.height && spot.row.width == v->row.width);
            else /* they rest on one floor, seen from above */
                assert_true(fabs(spot.r - (double)b[i].r) < rounding &&
                            fabs(spot.y - v->strip.y - v->stage.centre - BEAD_STAGE_COSINE * (v->stage.unit - spot.r)) < 1e-3);
        }
        for (size_t i = 0; i + 1 < v->count && c < 2; i++) {
            assert_true(bead_stage_find(v, BEAD_NOTE_CONTACT, i, &spot));
            assert_true(fabs(spot.x - v->strip.x - 0.5 * (double)(b[i].x + b[i].r + b[i + 1].x - b[i + 1].r)) < 2 * rounding);
            assert_true(fabs(spot.r - fmin((double)b[i].r, (double)b[i + 1].r)) < rounding);
        }
        assert_true((below > 0) == (c == 2) && !bead_stage_find(v, BEAD_NOTE_BEAD, v->count, &spot));
        assert_false(bead_stage_find(v, BEAD_NOTE_FRONT, 0, &spot)); /* nothing has moved */
        assert_int_equal(bead_stage_find(v, BEAD_NOTE_WALL, 0, &spot), v->wall);
        assert_true(!v->wall || c == 2 || fabs(spot.x - v->strip.x - (double)v->stage.wall.x) < rounding);
        assert_false(bead_stage_find(v, BEAD_NOTE_CONTACT, v->contacts, &spot));
        close_view(&s);
    }
}

/* Of a part of the chain the same beads are on the stage, with their own radii and forces, as of the whole. */
static void parts_of_chains_have_their_own(void **state)
{
    (void)state;
    enum { FIRST = 4, LAST = 9 };
    struct setting s;
    struct bead_message msg = {""};
    struct bead_view *part;
    double u[64] = {0}, force[64];
    open_view(&s, taper, BEAD_LIGHT_CONTACTS);
    struct bead_view_setup setup = s.view->setup;
    setup.beads = (struct bead_span){FIRST, LAST};
    require(bead_view_stage_type.create(&setup, &part, &msg), &msg);
    require(bead_view_stage_type.place(part, (struct bead_rect){90, 100, 1740, 360}, NULL, &msg), &msg);
    for (int i = 0; i < 64; i++)
        force[i] = i;
    const struct bead_sample sample = {.field = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_CONTACT_FORCE] = force}};
    require(bead_view_stage_type.feed(part, &sample, &msg), &msg);
    bead_stage_advance(part, 0);
    assert_true(part->count == LAST - FIRST + 1 && part->contacts == LAST - FIRST && !part->wall);
    for (size_t i = 0; i < part->count; i++) {
        assert_true(part->radius[i] == bead_chain_radius(s.chain)[FIRST + i]);
        assert_true(fabs(part->position[i] - part->position[0] - bead_chain_position(s.chain)[FIRST + i] +
                         bead_chain_position(s.chain)[FIRST]) < 1e-12);
        if (i < part->contacts)
            assert_true(fabs(part->load[i] - (double)(FIRST + i) / 40) < 1e-12);
    }
    bead_view_stage_type.destroy(part);
    close_view(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_beads_part_heavy_ones),
        cmocka_unit_test(beads_touch_where_they_do),
        cmocka_unit_test(stages_scale),
        cmocka_unit_test(swings_stay_on_the_stage),
        cmocka_unit_test(beads_are_over_their_numbers),
        cmocka_unit_test(lights_know_the_way_of_the_wave),
        cmocka_unit_test(names_have_room),
        cmocka_unit_test(beads_are_large),
        cmocka_unit_test(the_key_light_is_heard),
        cmocka_unit_test(the_key_shows_light),
        cmocka_unit_test(stages_are_transparent),
        cmocka_unit_test(beads_move_and_light_up),
        cmocka_unit_test(pressed_chains_are_dark_at_rest),
        cmocka_unit_test(neighbours_are_parted_where_they_touch),
        cmocka_unit_test(the_row_marks_what_is_on_the_stage),
        cmocka_unit_test(windows_go_along),
        cmocka_unit_test(things_are_found_where_they_are_drawn),
        cmocka_unit_test(parts_of_chains_have_their_own),
    };
    return cmocka_run_group_tests_name("stage view", tests, NULL, NULL);
}
