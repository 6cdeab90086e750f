/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Composes the stage at one time: the places of its beads, the light at their contacts, and the row of all beads. */
#include <math.h>

#include "render/stage/stage_view.h"
#include "sim/chain/chain_internal.h"

/* Light and shadow of beads this far beyond the edges reach the stage, in radii of the largest. */
static const double reach = 9;
/* In radii: neighbours further away than this leave a bead alone. */
static const double alone = 0.58;

static double contact_load(const struct bead_view *v, double value)
{
    return v->full > 0 ? fmin(1, fabs(value) / v->full) : 0;
}

double bead_stage_between(const struct bead_view *v, double head)
{
    const double whole = floor(fmax(0, head));
    const size_t i = (size_t)fmin(whole, (double)(v->count - 1)), next = i + 1 < v->count ? i + 1 : i;
    return v->place[i] + (head - whole + 0.5) * (v->place[next] - v->place[i]);
}

/* Waves go the same way as beads that they press, and the opposite way to beads that they relieve. */
static signed char way_of(const struct bead_view *v, size_t k, double excess)
{
    const double *now = v->u[v->latest.newest], *before = v->u[1 - v->latest.newest];
    double moved = now[k] - before[k];
    if (k + 1 < v->count)
        moved += now[k + 1] - before[k + 1];
    const double way = excess * moved;
    return (signed char)((way > 0) - (way < 0));
}

void bead_stage_advance(struct bead_view *v, double time)
{
    const struct bead_latest *l = &v->latest;
    const double weight = bead_latest_weight(l, time);
    for (size_t i = 0; i < v->count; i++)
        v->shift[i] = v->setup.magnify * bead_latest_value(l, v->u, i, weight);
    const double *rest = v->has_contacts ? bead_chain_static_force(v->setup.chain) + v->first : NULL;
    for (size_t k = 0; k < v->contacts; k++) {
        const double force = bead_latest_value(l, v->force, k, weight);
        const double excess = force - (rest ? rest[k] : 0);
        v->load[k] = contact_load(v, rest ? fmax(0, excess) : force);
        v->excess[k] = contact_load(v, excess);
        v->way[k] = way_of(v, k, excess);
    }
    const struct bead_loads wave = {v->excess, v->way, v->contacts};
    const double head = v->has_contacts ? bead_step_camera_find(&v->camera, wave) : 0;
    if (v->setup.camera) {
        const double middle = bead_camera_left(v->setup.camera) + 0.5 * bead_camera_width(v->setup.camera);
        size_t i = 0;
        while (i + 2 < v->count && v->position[i + 1] < middle)
            i++;
        const double part = v->count < 2 ? 0 : (middle - v->position[i]) / (v->position[i + 1] - v->position[i]);
        const double there = v->place[i] + part * (v->count < 2 ? 0 : v->place[i + 1] - v->place[i]);
        v->camera.middle = there * v->scale;
    } else if (v->camera.width > 0) {
        bead_step_camera_advance(&v->camera, v->scale * bead_stage_between(v, head),
                                 v->scale * bead_stage_between(v, v->camera.other));
    }
    if (v->camera.width > 0)
        v->left = round(v->camera.middle - 0.5 * v->strip.width);
}

/* ---- on the stage ---- */

/* Positions are rounded to this fraction of a pixel: motion is smooth, and a bead at rest does not change. */
static float on_grid(double x)
{
    return (float)(round(64 * x) / 64);
}

/* In steps of a part of the largest, because pictures of beads are baked for each radius, and in some chains all differ. */
static float shown_radius(const struct bead_view *v, size_t i)
{
    const double steps = fmax(1, round(BEAD_STAGE_RADII * v->radius[i] / v->largest));
    return fmaxf(2, (float)steps * v->stage.unit / BEAD_STAGE_RADII);
}

/* px of the stage. */
static double stage_x(const struct bead_view *v, double place)
{
    return v->stage.fine * (v->scale * place - v->left);
}

static void set_colour(const double *from, float to[3])
{
    for (int c = 0; c < 3; c++)
        to[c] = (float)fmin(1, fmax(0, from[c]));
}

static void set_light(const struct bead_view *v, struct bead_stage_bead *b, size_t i)
{
    const bool contacts = v->has_contacts && v->setup.light == BEAD_LIGHT_CONTACTS;
    const double left = v->has_contacts && i > 0 ? v->load[i - 1] : 0, right = v->has_contacts && i < v->contacts ? v->load[i] : 0;
    if (contacts) {
        bead_stage_glow(left, b->light[0]);
        bead_stage_glow(right, b->light[1]);
    } else if (v->setup.light != BEAD_LIGHT_NONE) {
        float light[3];
        bead_stage_glow(v->has_contacts ? 0.5 * (left + right) : v->load[i], light);
        for (int c = 0; c < 3; c++)
            b->own[c] = 0.4f * light[c];
    }
}

/* The surface at which two neighbours touch, or would: a plane between them that leans towards the smaller. */
static void join(const struct bead_view *v, struct bead_stage_bead *a, struct bead_stage_bead *b)
{
    const double dx = fmax(1e-3, b->x - a->x), rise = b->r - a->r, distance = sqrt(dx * dx + rise * rise),
                 gap = distance - a->r - b->r;
    const double near = fmin(1, fmax(0, 1.15 - gap / (alone * v->stage.unit)));
    const double plane = a->x + dx * (0.5 + 0.5 * ((double)a->r * a->r - (double)b->r * b->r) / (distance * distance));
    const double high = BEAD_STAGE_COSINE * (a->r + rise * (plane - a->x) / dx), slope = -BEAD_STAGE_COSINE * rise / dx;
    a->near[1] = b->near[0] = (float)near;
    a->tilt[1] = (float)(rise / distance);
    b->tilt[0] = (float)(-rise / distance);
    a->edge[1] = b->edge[0] = on_grid(plane - slope * high);
    a->slope[1] = b->slope[0] = (float)slope;
}

static void put_wall(struct bead_view *v)
{
    const struct bead_chain_spec *spec = bead_chain_spec(v->setup.chain);
    struct bead_stage_wall *w = &v->stage.wall;
    *w = (struct bead_stage_wall){.width = 0};
    const double x = stage_x(v, v->ends[1]);
    if (!v->wall || x > v->stage.width)
        return;
    w->x = on_grid(x);
    w->width = 1.2f * v->stage.unit;
    for (int c = 0; c < 3; c++)
        w->colour[c] = 0.09f;
    if (spec->wall == BEAD_WALL_MATERIAL) {
        const double *own = bead_chain_scene(v->setup.chain)->materials[spec->wall_material].colour;
        for (int c = 0; c < 3; c++)
            w->colour[c] = (float)(0.30 * own[c] * own[c]);
    }
    if (v->has_contacts && v->setup.light == BEAD_LIGHT_CONTACTS)
        bead_stage_glow(v->load[v->contacts - 1], w->light);
}

void bead_stage_compose(struct bead_view *v)
{
    struct bead_stage *s = &v->stage;
    s->count = 0;
    size_t before = 0;
    for (size_t i = 0; i < v->count; i++) {
        const double x = stage_x(v, v->place[i] + v->shift[i]);
        if (x < -reach * s->unit || x > s->width + reach * s->unit || s->count == s->room)
            continue;
        struct bead_stage_bead *b = &s->beads[s->count++];
        *b = (struct bead_stage_bead){.x = on_grid(x), .edge = {-INFINITY, INFINITY}};
        b->r = shown_radius(v, i);
        set_colour(bead_chain_colour(v->setup.chain, v->first + i), b->colour);
        set_light(v, b, i);
        if (s->count > 1 && before + 1 == i)
            join(v, b - 1, b);
        before = i;
    }
    put_wall(v);
    if (s->count > 0 && s->wall.width > 0 && before + 1 == v->count) {
        struct bead_stage_bead *last = &s->beads[s->count - 1];
        last->edge[1] = s->wall.x;
        last->near[1] = (float)fmin(1, fmax(0, 1.15 - (s->wall.x - last->x - last->r) / (alone * s->unit)));
    }
}

/* ---- without a background ---- */

/* Black and grey floors send the same light and let the same part of the background through: the picture on black is the colour,
 * and the light that the grey floor adds gives the transparency. Linear light of the grey floor; radii above the lower edge in
 * which the picture fades. */
static const float grey = 0.5f, fade = 0.6f;

static void make_floors(struct bead_view *v)
{
    for (int k = 0; k < 2; k++) {
        v->floors[k] = *v->stage.theme;
        for (int c = 0; c < 3; c++)
            v->floors[k].floor[c] = v->floors[k].back[c] = k ? grey : 0;
    }
}

/* `part`: the part of it to keep. */
static void set_alpha(uint8_t *pixel, const uint8_t *on_grey, int whole, float part)
{
    int through = 0, most = 0;
    for (int c = 0; c < 3; c++) {
        through += on_grey[c] - pixel[c];
        most = pixel[c] > most ? pixel[c] : most;
    }
    const int all = 3 * whole, alpha = through + 3 >= all ? 0 : through <= 3 ? 255 : 255 - (255 * through + all / 2) / all;
    for (int c = 0; alpha == 0 && most <= 1 && c < 3; c++) /* only dither */
        pixel[c] = 0;
    pixel[3] = (uint8_t)(most <= 1 || alpha > most ? alpha : most);
    for (int c = 0; part < 1 && c < 4; c++)
        pixel[c] = (uint8_t)(part * (float)pixel[c]);
}

enum bead_error bead_stage_paint(struct bead_view *v, struct bead_canvas *canvas, struct bead_rect place, struct bead_frame *frame,
                                 struct bead_message *msg)
{
    const struct bead_stage_theme *own = v->stage.theme;
    const struct bead_rect all = {0, 0, place.width, place.height};
    if (!v->look.clear)
        return bead_paint_stage(canvas, &v->stage, place, v->head, frame, msg);
    make_floors(v);
    enum bead_error err = v->on_grey.pixels ? BEAD_OK : bead_frame_create(all.width, all.height, &v->on_grey, msg);
    v->stage.theme = &v->floors[0];
    if (!err)
        err = bead_paint_stage(canvas, &v->stage, place, v->head, frame, msg);
    v->stage.theme = &v->floors[1];
    if (!err)
        err = bead_paint_stage(canvas, &v->stage, all, v->head, &v->on_grey, msg);
    v->stage.theme = own;
    for (int y = v->head; !err && y < place.height; y++) {
        const float part =
            (float)(v->stage.fine * (place.height - y)) / (fade * v->stage.unit); /* light on the floor ends without an edge */
        uint8_t *pixel = frame->pixels + (size_t)(place.y + y) * frame->stride + 4 * (size_t)place.x;
        for (int x = 0; x < place.width; x++)
            set_alpha(pixel + 4 * (size_t)x, v->on_grey.pixels + (size_t)y * v->on_grey.stride + 4 * (size_t)x,
                      (int)(255 * bead_stage_shown(grey)), part);
    }
    return err;
}

/* ---- the row of all beads ---- */

static uint8_t level(double x)
{
    return (uint8_t)lround(255 * fmin(1, fmax(0, x)));
}

static void row_ball(const struct bead_view *v, size_t i, struct bead_ball *ball)
{
    const double left = i > 0 ? v->load[i - 1] : 0, right = i < v->contacts ? v->load[i] : 0;
    const double load = v->setup.light == BEAD_LIGHT_NONE ? 0 : v->has_contacts ? 0.5 * (left + right) : v->load[i];
    const double *own = bead_chain_colour(v->setup.chain, v->first + i);
    const double room = 0.5 * v->row.height - 2, r = fmin(room, fmax(0.7, 0.8 * v->radius[i] * v->row_scale));
    const double lit = fmin(1, 1.5 * load), accent[3] = {v->look.accent.r, v->look.accent.g, v->look.accent.b};
    const float x = on_grid(v->row_left + (v->position[i] - v->position[0]) * v->row_scale);
    const float size = on_grid(fmin(room, r + load * fmax(0.5 * r, 2.5)));
    *ball = (struct bead_ball){.x = x, .y = 0.5f * (float)v->row.height, .r = size, .left = x - size - 2, .right = x + size + 2};
    for (int c = 0; c < 3; c++)
        ball->rgba[c] = level(own[c] + lit * (accent[c] - own[c]));
    ball->rgba[3] = 255;
}

/* A position along the chain at a place on the stage. */
static double position_of(const struct bead_view *v, double place)
{
    size_t i = 0;
    while (i + 2 < v->count && v->place[i + 1] < place)
        i++;
    if (v->count < 2)
        return v->position[0] + place - v->place[0];
    return v->position[i] + (place - v->place[i]) * (v->position[i + 1] - v->position[i]) / (v->place[i + 1] - v->place[i]);
}

double bead_stage_row_x(const struct bead_view *v, double place)
{
    return v->row_left + (position_of(v, place) - v->position[0]) * v->row_scale;
}

static void mark_window(struct bead_view *v)
{
    const double line = round(v->look.line), high = v->row.height;
    const double from = round(fmax(0, bead_stage_row_x(v, v->left / v->scale)));
    const double to = round(fmin(v->row.width, bead_stage_row_x(v, (v->left + v->strip.width) / v->scale)));
    const double boxes[4][4] = {
        {from, 0, to, line}, {from, high - line, to, high}, {from, 0, from + line, high}, {to - line, 0, to, high}};
    const double rgb[3] = {v->look.accent.r, v->look.accent.g, v->look.accent.b};
    for (int k = 0; k < 4; k++) {
        v->window[k] = (struct bead_mark){.kind = BEAD_MARK_BOX};
        for (int c = 0; c < 4; c++)
            v->window[k].box[c] = (float)boxes[k][c];
        for (int c = 0; c < 3; c++)
            v->window[k].rgba[c] = level(rgb[c]);
        v->window[k].rgba[3] = 255;
    }
}

void bead_stage_compose_row(struct bead_view *v)
{
    for (size_t i = 0; i < v->count; i++)
        row_ball(v, i, &v->balls[i]);
    mark_window(v);
}
