/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways to the same film of each view. What is shown does not depend on when it begins, how long it takes, in which units the
 * values and lengths are, where the plot is, or how many samples there are on a straight line; a part of a chain looks as a chain
 * of its own, and a wave from the other end as its mirror image. */
#include "render/stage/beads.h"

#include "view_films.h"

#include "render/draw/axis.h"
#include "tests/texts.h"

#define AT_REST "chain: {striker: {velocity: 0 m/s}, beads: ["
#define PART                                                                                                               \
    "{cell: [large-steel, aluminium], count: 6}, {bead: small-steel, sensor: one}, {bead: large-steel, count: 9}, {bead: " \
    "large-steel, sensor: two}, {bead: aluminium, count: 3}"
#define ENDS "]}\noutputs: [{table: a.csv}]\n"
enum { SHOWN = 26, BEFORE = 7 }; /* bead 0 is the striker */
static const char alone[] = AT_REST PART ENDS,
                  among[] = AT_REST "{bead: ptfe, count: 5}, {bead: large-steel, sensor: no}, " PART
                                    ", {bead: large-steel, count: 7}, {bead: large-steel, sensor: neither}" ENDS,
                  reversed[] = AT_REST "{bead: aluminium, count: 3}, {bead: large-steel, sensor: one}, {bead: large-steel, count: "
                                       "9}, {bead: small-steel, sensor: two}, {cell: [aluminium, large-steel], count: 6}" ENDS,
                  even[] = AT_REST "{bead: large-steel, count: 26}" ENDS,
                  odd[] = AT_REST "{bead: ptfe, count: 6}, {bead: large-steel, count: 26}, {bead: ptfe}" ENDS;

/* The largest difference of two frames, of which the second has all elsewhere. */
static int differ(const struct shown *a, const struct shown *b, int at[2])
{
    int most = 0;
    for (int y = 0; y + b->as.down < HEIGHT; y++) {
        const uint8_t *p = a->frame.pixels + (size_t)y * a->frame.stride;
        const uint8_t *q = b->frame.pixels + (size_t)(y + b->as.down) * b->frame.stride + 4 * (size_t)b->as.right;
        const int end = 4 * (WIDTH - b->as.right);
        for (int i = 0; memcmp(p, q, (size_t)end) != 0 && i < end; i++) {
            if (i % 4 == 3 || abs(p[i] - q[i]) <= most)
                continue;
            most = abs(p[i] - q[i]);
            at[0] = i / 4, at[1] = y;
        }
    }
    return most;
}

/* Both are drawn frame by frame. */
static void assert_same_film(const struct film *one, const struct film *other, const char *what, int slack)
{
    struct shown a, b;
    int at[2];
    open_shown(&a, one);
    open_shown(&b, other);
    for (size_t k = 0; k < FRAMES; k++) {
        const double time = feed(&a, k), then = feed(&b, k);
        draw(&a, time, &(struct bead_changes){0});
        draw(&b, then, &(struct bead_changes){0});
        const int most = differ(&a, &b, at);
        if (most > slack)
            fail_msg("%s, %s: frame %zu differs by %d at %d, %d", one->name, what, k, most, at[0], at[1]);
    }
    close_shown(&a);
    close_shown(&b);
}

enum law { LATER = 1, SLOWER = 2, STRONGER = 4, ELSEWHERE = 8, FINELY = 16, LARGER = 32, ALL = 63 };

/* Strikers have the speed of the scene, which cameras wait for, too; the line of theory is that of a wave from time 0 on, with a
 * speed; and the horizon is at a sample. */
#define IMAGES(o)                                                                                                                  \
    {{"image", BEAD_VIEW_SPACETIME, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o}, ALL},                        \
        {{"image of the future", BEAD_VIEW_SPACETIME, alone, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true, .ghost = true,         \
          .orientation = o},                                                                                                       \
         LATER | SLOWER | STRONGER | ELSEWHERE | LARGER},                                                                          \
        {{"image with a camera", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o,              \
          .window = window},                                                                                                       \
         LATER | SLOWER | ELSEWHERE | FINELY | LARGER},                                                                            \
        {{"image with trust", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o, .trust = true}, \
         ALL},                                                                                                                     \
        {{"image with theory", BEAD_VIEW_SPACETIME, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .orientation = o,                \
          .theory = true},                                                                                                         \
         ELSEWHERE},                                                                                                               \
    {                                                                                                                              \
        {"still image", BEAD_VIEW_SPACETIME, DIMERS, BEAD_FIELD_VELOCITY, -0.1, 0.25, .orientation = o, .marked = true}, ALL       \
    }
static const double window = 8 * 9.525e-3;
static const struct {
    struct film film;
    unsigned laws;
} films[] = {
    {{"beads", BEAD_VIEW_BEADS, alone, BEAD_FIELD_FORCE, 0, 35, .film = true}, ALL},
    {{"beads and a striker", BEAD_VIEW_BEADS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true}, LATER | ELSEWHERE | FINELY | LARGER},
    {{"beads with a camera", BEAD_VIEW_BEADS, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window},
     LATER | SLOWER | ELSEWHERE | FINELY | LARGER},
    {{"profile", BEAD_VIEW_PROFILE, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true}, ALL},
    {{"profile of contacts", BEAD_VIEW_PROFILE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .light = true, .beads = {2, 20}}, ALL},
    {{"profile of velocities", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_VELOCITY, -0.1, 0.25, .film = true}, ALL},
    {{"profile held", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .hold = true}, ALL},
    {{"profile in decades", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 1e-3, 35, .film = true, .scale = BEAD_SCALE_LOG}, ALL},
    {{"profiles overlaid", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .overlaid = true}, ALL},
    {{"profile with a camera", BEAD_VIEW_PROFILE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window},
     LATER | SLOWER | ELSEWHERE | FINELY | LARGER},
    {{"profile of a string", BEAD_VIEW_PROFILE, STRING, BEAD_FIELD_DISPLACEMENT, 0, 2e-5, .film = true}, ALL & ~LARGER},
    {{"sensors", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true}, ALL},
    {{"sensors of velocity", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_VELOCITY, -0.1, 0.25, .film = true, .light = true}, ALL},
    {{"sensors with trust", BEAD_VIEW_SENSORS, DIMERS, BEAD_FIELD_FORCE, 0, 35, .film = true, .trust = true}, ALL & ~FINELY},
    {{"modes", BEAD_VIEW_MODES, STRING, BEAD_FIELD_DISPLACEMENT, 0, 1, .film = true}, LATER | ELSEWHERE},
    {{"stage", BEAD_VIEW_STAGE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true}, ALL},
    {{"stage and row", BEAD_VIEW_STAGE, DIMERS, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true, .row = true},
     ALL & ~STRONGER}, /* says how strong */
    {{"light stage with a camera", BEAD_VIEW_STAGE, PLAIN, BEAD_FIELD_FORCE, 0, 35, .film = true, .light = true, .window = window},
     LATER | SLOWER | ELSEWHERE | FINELY | LARGER},
    IMAGES(BEAD_TIME_RIGHT),
    IMAGES(BEAD_TIME_DOWN),
    IMAGES(BEAD_MATRIX),
};

/* All that hold at once; edges of lines through more points differ by the last bits. */
static void films_are_the_same_in_other_manners(void **)
{
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        const unsigned laws = films[i].laws;
        struct film other = films[i].film;
        other.as = (struct manner){.later = laws & LATER ? 0x1p-7 : 0,
                                   .slower = laws & SLOWER ? 4 : 1,
                                   .stronger = laws & STRONGER ? 8 : 1,
                                   .larger = laws & LARGER ? 4 : 1,
                                   .right = laws & ELSEWHERE ? 32 : 0,
                                   .down = laws & ELSEWHERE ? 16 : 0,
                                   .finely = laws & FINELY};
        assert_same_film(&films[i].film, &other, "in another manner", other.kind == BEAD_VIEW_SENSORS ? 10 : 0);
    }
}

static void parts_look_as_chains_of_their_own(void **)
{
#define EACH(o)                                                                                                 \
    {"image", BEAD_VIEW_SPACETIME, alone, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true, .orientation = o},     \
    {                                                                                                           \
        "image with trust", BEAD_VIEW_SPACETIME, even, BEAD_FIELD_FORCE, 0, 35, .trust = true, .orientation = o \
    }
    static const struct film all[] = {
        {"beads", BEAD_VIEW_BEADS, alone, BEAD_FIELD_FORCE, 0, 35, .film = true,
         .beads = {1, 15}}, /* without a lens, which moves by whole pixels */
        {"beads with a camera", BEAD_VIEW_BEADS, even, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window},
        {"profile", BEAD_VIEW_PROFILE, alone, BEAD_FIELD_FORCE, 0, 35, .film = true, .hold = true},
        {"profile of contacts", BEAD_VIEW_PROFILE, even, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true},
        {"profiles overlaid", BEAD_VIEW_PROFILE, even, BEAD_FIELD_FORCE, 0, 35, .film = true, .overlaid = true},
        {"profile with a camera", BEAD_VIEW_PROFILE, even, BEAD_FIELD_FORCE, 0, 35, .film = true, .window = window},
        {"stage", BEAD_VIEW_STAGE, alone, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true},
        {"stage and row", BEAD_VIEW_STAGE, alone, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true, .row = true},
        EACH(BEAD_TIME_RIGHT),
        EACH(BEAD_TIME_DOWN),
        EACH(BEAD_MATRIX)};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        struct film part = all[i], whole = all[i];
        const size_t last = part.beads.last ? part.beads.last : SHOWN - 1 - (part.field == BEAD_FIELD_CONTACT_FORCE);
        part.beads = (struct bead_span){1, 1 + last};
        part.as.before = 1;
        whole.chain = all[i].chain == alone ? among : odd;
        whole.beads = (struct bead_span){BEFORE, BEFORE + last};
        whole.as.before = BEFORE;
        assert_same_film(&part, &whole, "a part", 0);
    }
}

/* Along the chain. */
static void turn(struct shown *s, bool upright)
{
    for (int y = 0; y < (upright ? plot.height / 2 : plot.height); y++) {
        for (int x = 0; x < (upright ? plot.width : plot.width / 2); x++) {
            uint8_t *a = s->frame.pixels + (size_t)(plot.y + y) * s->frame.stride + 4 * (size_t)(plot.x + x), was[4];
            uint8_t *b = s->frame.pixels + (size_t)(plot.y + (upright ? plot.height - 1 - y : y)) * s->frame.stride +
                         4 * (size_t)(plot.x + (upright ? x : plot.width - 1 - x));
            memcpy(was, a, 4), memcpy(a, b, 4), memcpy(b, was, 4);
        }
    }
}

/* A wave from the other end. */
static void mirrored_chains_look_mirrored(void **)
{
#define TURNED(o, ...)                                                                   \
    {                                                                                    \
        "image", BEAD_VIEW_SPACETIME, alone, __VA_ARGS__, .film = true, .orientation = o \
    }
    static const struct film all[] = {
        {"profile", BEAD_VIEW_PROFILE, even, BEAD_FIELD_FORCE, 0, 35, .film = true, .hold = true},
        {"profile of contacts", BEAD_VIEW_PROFILE, alone, BEAD_FIELD_CONTACT_FORCE, 0, 35, .film = true},
        {"profile of velocities", BEAD_VIEW_PROFILE, alone, BEAD_FIELD_VELOCITY, -0.1, 0.25, .film = true},
        TURNED(BEAD_TIME_RIGHT, BEAD_FIELD_FORCE, 0, 35),
        TURNED(BEAD_TIME_DOWN, BEAD_FIELD_CONTACT_FORCE, 0, 35),
        TURNED(BEAD_MATRIX, BEAD_FIELD_VELOCITY, -0.1, 0.25)};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        struct film one = all[i], other = all[i];
        struct shown a, b;
        int at[2];
        const size_t last = SHOWN - 1 - (one.field == BEAD_FIELD_CONTACT_FORCE);
        one.beads = other.beads = (struct bead_span){1, 1 + last};
        one.as.before = 1;
        other.as.mirrored = SHOWN + 1; /* one of them is out of sight */
        other.chain = one.chain == alone ? reversed : one.chain;
        open_shown(&a, &one);
        open_shown(&b, &other);
        for (int y = 0; y < HEIGHT; y++) { /* the same everywhere */
            memset(a.background.pixels + (size_t)y * a.background.stride, 20, 4 * WIDTH);
            memset(b.background.pixels + (size_t)y * b.background.stride, 20, 4 * WIDTH);
        }
        bead_frame_copy(&a.frame, &a.background, page);
        bead_frame_copy(&b.frame, &b.background, page);
        for (size_t k = 0; k < FRAMES; k++) {
            const double time = feed(&a, k), then = feed(&b, k);
            const bool upright = one.kind == BEAD_VIEW_SPACETIME && one.orientation != BEAD_TIME_DOWN;
            draw(&a, time, &(struct bead_changes){0});
            draw(&b, then, &(struct bead_changes){0});
            turn(&b, upright);
            const int most = differ(&a, &b, at);
            turn(&b, upright);
            if (most > 16)
                fail_msg("%s, mirrored: frame %zu differs by %d at %d, %d", one.name, k, most, at[0], at[1]);
        }
        close_shown(&a);
        close_shown(&b);
    }
}

/* Where two frames differ. */
static struct bead_rect difference(const struct shown *a, const struct shown *b)
{
    int from[2] = {WIDTH, HEIGHT}, to[2] = {0, 0};
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const size_t at = (size_t)y * a->frame.stride + 4 * (size_t)x;
            if (memcmp(a->frame.pixels + at, b->frame.pixels + at, 3) == 0)
                continue;
            from[0] = x < from[0] ? x : from[0], to[0] = x + 1 > to[0] ? x + 1 : to[0];
            from[1] = y < from[1] ? y : from[1], to[1] = y + 1 > to[1] ? y + 1 : to[1];
        }
    }
    return (struct bead_rect){from[0], from[1], to[0] - from[0], to[1] - from[1]};
}

/* Until the camera of the lens sees it, a chain with a wall looks as one without, but for the wall: at the end of the plot, about
 * twice as high as a bead, in the middle of its row. */
static void walls_are_beside_their_chains(void **state)
{
    (void)state;
#define WALLED(wall)                                                                                                        \
    "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 29}], wall: " wall "}\n" \
    "outputs: [{table: a.csv}]\n"
    static const char *const walls[] = {WALLED("rigid"), WALLED("brass")};
    const double diameter = plot.width / 30.0;
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        struct film open = {"beads", BEAD_VIEW_BEADS, WALLED("none"), BEAD_FIELD_FORCE, 0, 35, .film = true, .row = true};
        struct film closed = open;
        struct shown a, b;
        closed.chain = walls[i];
        open_shown(&a, &open);
        open_shown(&b, &closed);
        for (size_t k = 0; k < 10; k++) {
            const double time = feed(&a, k);
            feed(&b, k);
            draw(&a, time, &(struct bead_changes){0});
            draw(&b, time, &(struct bead_changes){0});
            const struct bead_rect wall = difference(&a, &b);
            if (wall.x != plot.x + plot.width || wall.width < 4 || wall.height < 1.5 * diameter || wall.height > 2.1 * diameter)
                fail_msg("wall %zu, frame %zu: %d x %d at %d, %d", i, k, wall.width, wall.height, wall.x, wall.y);
        }
        close_shown(&a);
        close_shown(&b);
    }
}

/* Names above a row of beads are within it and apart; those that would not be are left out. */
static void names_stay_above_their_row(void **)
{
#define NAMED(first, last, wall)                                                                                               \
    "chain: {striker: {velocity: 1 m/s}, beads: [{bead: large-steel, sensor: " first "}, {bead: large-steel, count: 20}, "     \
    "{bead: large-steel, sensor: middle}, {bead: large-steel, count: 20}, {bead: large-steel, sensor: " last "}], wall: " wall \
    "}\noutputs: [{table: a.csv}]\n"
    static const struct {
        struct film film;
        size_t names; /* also of the striker and the wall */
    } rows[] = {{{"short names", BEAD_VIEW_BEADS, NAMED("a", "b", "none"), BEAD_FIELD_FORCE, 0, 35, .film = true, .row = true}, 3},
                {{"a long name first", BEAD_VIEW_BEADS, NAMED("the first of all the beads of this chain", "b", "none"),
                  BEAD_FIELD_FORCE, 0, 35, .film = true, .row = true},
                 3},
                {{"a long name last", BEAD_VIEW_BEADS, NAMED("a", "the last of all the beads of this chain", "none"),
                  BEAD_FIELD_FORCE, 0, 35, .film = true, .row = true},
                 2},
                {{"a wall", BEAD_VIEW_BEADS, NAMED("a", "the last of all the beads of this chain", "brass"), BEAD_FIELD_FORCE, 0,
                  35, .film = true, .row = true},
                 3}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct shown s;
        struct texts texts = {.count = 0};
        struct bead_message msg = {""};
        const struct bead_text_watch watch = {texts_note, &texts};
        open_shown(&s, &rows[i].film);
        int left = 0, right = 0;
        if (s.type->margins)
            s.type->margins(&s.look, &left, &right);
        cairo_surface_t *paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
        assert_true(bead_text_watch(paper, &watch));
        cairo_t *cr = cairo_create(paper);
        require(s.type->decorate(s.view, cr, &msg), &msg);
        cairo_destroy(cr);
        cairo_surface_destroy(paper);
        for (size_t t = 0; t < texts.count; t++) {
            const struct text *a = &texts.text[t], *b = t > 0 ? &texts.text[t - 1] : NULL;
            if (a->x < plot.x - left - 1 || a->x + a->width > plot.x + plot.width + right + 1 ||
                (b && a->x < b->x + b->width && b->x < a->x + a->width))
                fail_msg("%s: '%s' from %g to %g", rows[i].film.name, a->markup, a->x, a->x + a->width);
        }
        if (texts.count != rows[i].names)
            fail_msg("%s: %zu names", rows[i].film.name, texts.count);
        close_shown(&s);
    }
}

/* Is there anything in the lens that is behind the last bead? */
static bool is_anything_behind(const struct shown *s)
{
    const struct bead_view *v = s->view;
    const double x = v->area.x + bead_window_x(&v->lens, v->ends[1] + 0.13 * v->largest);
    const struct bead_rect *lens = &v->lens.rect;
    bool any = false;
    for (int y = v->area.y + lens->y; y < v->area.y + lens->y + lens->height; y++) {
        for (int column = (int)x; column < v->area.x + lens->x + lens->width; column++) {
            const size_t at = (size_t)y * s->frame.stride + 4 * (size_t)column;
            any |= memcmp(s->frame.pixels + at, s->background.pixels + at, 3) != 0;
        }
    }
    return any;
}

static void lenses_show_walls_where_they_are(void **state)
{
    (void)state;
    static const char *const walls[] = {WALLED("none"), WALLED("rigid"), WALLED("brass")};
    for (size_t i = 0; i < 6; i++) {
        const struct film film = {"beads",      BEAD_VIEW_BEADS,         walls[i % 3], BEAD_FIELD_FORCE, 0, 35,
                                  .film = true, .window = i / 3 * window};
        struct shown s;
        size_t seen = 0;
        open_shown(&s, &film);
        for (size_t k = 0; k < FRAMES; k++) {
            draw(&s, feed(&s, k), &(struct bead_changes){0});
            seen += is_anything_behind(&s);
        }
        if (i % 3 ? seen < 2 || seen > FRAMES / 2 : seen > 1) /* the last bead moves there at the end */
            fail_msg("wall %zu: something is behind the chain in %zu frames", i, seen);
        close_shown(&s);
    }
}

static void assert_within(struct bead_rect rect, const struct bead_view *v, const char *what)
{
    if (rect.x < 0 || rect.y < 0 || rect.x + rect.width > v->area.width || rect.y + rect.height > v->area.height)
        fail_msg("%s of %d x %d: %d x %d at %d, %d", what, v->area.width, v->area.height, rect.width, rect.height, rect.x, rect.y);
}

/* Row and lens are within the view, one below the other, and beads within them and the frame; the lens has all room that is left,
 * or as few beads side by side as are worth it. */
static void assert_windows(const struct bead_view *v, int line)
{
    const double row = 2 * v->largest * v->row.scale, lens = 2 * v->largest * v->lens.scale;
    if (v->row.scale > 0) {
        assert_within(v->row.rect, v, "row");
        assert_true(v->strip ? row < 3 : row <= v->row.rect.height);
    }
    if (!(v->lens.scale > 0))
        return;
    const int bottom = v->lens.rect.y + v->lens.rect.height + line;
    assert_within(v->lens.rect, v, "lens");
    if (lens > v->lens.rect.height + line || (bottom < v->area.height - 2 && fabs(v->plot.width / lens - 14) > 0.01))
        fail_msg("beads of %g px in a lens of %d x %d, from %d to %d of %d", lens, v->lens.rect.width, v->lens.rect.height,
                 v->lens.rect.y, bottom, v->area.height);
    assert_true(!(v->row.scale > 0) || (v->zoom.y >= v->row.rect.y + v->row.rect.height &&
                                        v->lens.rect.y == v->zoom.y + v->zoom.height + line && lens > row));
}

static void windows_have_room_for_their_beads(void **state)
{
    (void)state;
    static const char many[] = AT_REST "{cell: [large-steel, aluminium], count: 200}" ENDS;
    static const char *const chains[] = {ONE, PLAIN, DIMERS, many};
    static const int widths[] = {60, 151, 420, 1200}, heights[] = {12, 40, 90, 200, 401};
    struct bead_message msg = {""};
    size_t lenses = 0, strips = 0;
    for (size_t i = 0; i < 160; i++) {
        const struct film film = {"beads", BEAD_VIEW_BEADS, chains[i % 4], BEAD_FIELD_FORCE, 0, 35, .film = true, .row = i / 4 % 2};
        const struct bead_rect place = {31, 17, widths[i / 8 % 4], heights[i / 32]};
        struct shown s;
        struct bead_canvas *canvas;
        struct bead_view *v;
        open_shown(&s, &film);
        require(bead_canvas_create("plain", place.width + 80, place.height, &canvas, &msg), &msg);
        require(s.type->create(&s.view->setup, &v, &msg), &msg); /* a view has one place */
        require(s.type->place(v, place, canvas, &msg), &msg);
        assert_windows(v, 4);
        lenses += v->lens.scale > 0;
        strips += v->strip;
        s.type->destroy(v);
        bead_canvas_destroy(canvas);
        close_shown(&s);
    }
    assert_true(lenses > 10 && strips > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_are_the_same_in_other_manners), cmocka_unit_test(parts_look_as_chains_of_their_own),
        cmocka_unit_test(mirrored_chains_look_mirrored),       cmocka_unit_test(walls_are_beside_their_chains),
        cmocka_unit_test(lenses_show_walls_where_they_are),    cmocka_unit_test(windows_have_room_for_their_beads),
        cmocka_unit_test(names_stay_above_their_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
