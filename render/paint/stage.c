/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The look of the stage: materials, lamps, themes; pictures of beads, baked when first needed. */
#include "render/paint/stage.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"

typedef float light __attribute__((vector_size(16))); /* red, green, blue; or x, y (up), z (away from the camera) */

const struct bead_stage_theme bead_stage_dark = {.floor = {.036f, .040f, .051f},
                                                 .back = {.016f, .018f, .025f},
                                                 .up = {.115f, .128f, .155f},
                                                 .down = {.014f, .016f, .022f},
                                                 .key = {.40f, .388f, .364f},
                                                 .surroundings = 0.90f,
                                                 .ground_light = 0.075f,
                                                 .halo = 0.011f,
                                                 .mirror = 0.30f,
                                                 .shade = 0.85f};
const struct bead_stage_theme bead_stage_light = {.floor = {.42f, .43f, .45f},
                                                  .back = {.52f, .53f, .55f},
                                                  .up = {.26f, .27f, .29f},
                                                  .down = {.12f, .12f, .12f},
                                                  .key = {.34f, .333f, .32f},
                                                  .surroundings = 1,
                                                  .ground_light = 0.20f,
                                                  .halo = 0.035f,
                                                  .mirror = 0.16f,
                                                  .shade = 0.75f};

static float unit_part(float x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* From 0 at `a` to 1 at `b`, smoothly. */
static float smooth(float a, float b, float x)
{
    x = unit_part((x - a) / (b - a));
    return x * x * (3 - 2 * x);
}

static light of(const float x[4])
{
    return (light){x[0], x[1], x[2], 0};
}

static float dot(light a, light b)
{
    const light c = a * b;
    return c[0] + c[1] + c[2];
}

static float linear(float x)
{
    const double y = (x + 0.055) / 1.055;
    return (float)(x <= 0.04045F ? x / 12.92 : y * y * bead_two_fifths(y));
}

void bead_stage_glow(double part, float out[3])
{
    const float f = (float)fmin(1, fmax(0, part));
    out[0] = 3.1f * f;
    out[1] = 1.62f * f * sqrtf(sqrtf(f));
    out[2] = 0.52f * f * f;
}

double bead_stage_shown(double x)
{
    const double t = BEAD_STAGE_TONE * fmax(0, x);
    return sqrt(t / sqrt(1 + t * t));
}

void bead_stage_base(const struct bead_stage *stage, float y, float out[3])
{
    const float part = smooth(-1.2f, 0.9f, bead_stage_up(stage, y));
    for (int c = 0; c < 3; c++)
        out[c] = stage->theme->floor[c] + part * (stage->theme->back[c] - stage->theme->floor[c]);
}

void bead_stage_floor_row(const struct bead_stage *s, int y, float *rgba)
{
    const float part = (float)(y % BEAD_STAGE_STEP) / BEAD_STAGE_STEP;
    const size_t wide = (size_t)s->grid_width;
    const float *from = s->grid + (size_t)(y / BEAD_STAGE_STEP) * BEAD_STAGE_CHANNELS * wide,
                *to = from + BEAD_STAGE_CHANNELS * wide;
    float base[4] = {0};
    bead_stage_base(s, (float)y + 0.5f, base);
    const light own = of(base);
    for (size_t i = 0; i < wide; i++) {
        const light a = {from[wide + i], from[2 * wide + i], from[3 * wide + i], 0};
        const light b = {to[wide + i], to[2 * wide + i], to[3 * wide + i], 0};
        const light c = own * (from[i] + part * (to[i] - from[i])) + a + part * (b - a);
        memcpy(rgba + 4 * i, &c, sizeof c);
    }
}

/* ---- materials ---- */

struct surface {
    light albedo;
    float gloss;
};

/* Bright colours are those of polished metals. */
static struct surface surface_of(const float colour[3])
{
    const light albedo = {linear(colour[0]), linear(colour[1]), linear(colour[2]), 0};
    return (struct surface){albedo, 0.19f + 0.44f * dot(albedo, (light){0.2126f, 0.7152f, 0.0722f, 0})};
}

/* Light of contacts on a material: dark ones take a little of its colour. */
static float tint_of(const float colour[3], int c)
{
    return fminf(1, 0.75f + 0.6f * linear(colour[c]));
}

/* ---- a bead ---- */

static const light lamp = {-0.406f, 0.767f, -0.496f, 0}, eye = {0, -BEAD_STAGE_SINE, BEAD_STAGE_COSINE, 0};

/* A polished bead mirrors the room: a lamp above, a strip of light at the right, a rim at the left. */
static light surroundings(light d, const struct bead_stage_theme *theme)
{
    const float up = 0.5f + 0.5f * d[1];
    const float box = 0.85f * smooth(0.50f, 0.74f, d[1]) * smooth(0.78f, 0.30f, fabsf(d[0] + 0.25f)) * smooth(-0.8f, -0.3f, -d[2]);
    const float strip = 0.60f * smooth(0.08f, 0.26f, d[1]) * smooth(0.62f, 0.34f, d[1]) * smooth(0.52f, 0.78f, d[0]);
    const float rim = 0.55f * smooth(-0.16f, 0.10f, d[1]) * smooth(0.42f, 0.12f, d[1]) * smooth(-0.55f, -0.85f, d[0]);
    const light room = (light){.012f, .014f, .020f, 0} * (1 - up) + (light){.15f, .17f, .21f, 0} * (up * up) +
                       (light){1.05f, 1.03f, .97f, 0} * box + (light){.40f, .50f, .68f, 0} * strip +
                       (light){.30f, .34f, .42f, 0} * rim;
    return room * theme->surroundings;
}

/* A ball at (x, y up) of its disc, the radius being 1; `near`: 1 with neighbours on both sides. */
static void ball_look(float x, float y, float near, const struct surface *of_ball, const struct bead_stage_theme *theme,
                      float out[])
{
    const float z = sqrtf(fmaxf(0, 1 - x * x - y * y)), ax = fabsf(x);
    const light n = {x, y * BEAD_STAGE_COSINE + z * BEAD_STAGE_SINE, y * BEAD_STAGE_SINE - z * BEAD_STAGE_COSINE, 0};
    const float inverse = 1 / sqrtf(5 - 4 * ax), behind = unit_part((2 * ax - 1) * inverse); /* the part that the neighbour hides */
    const float open =
        (1 - 0.60f * unit_part(0.5f - 0.5f * n[1]) * unit_part(1.2f - (n[1] + 1) * 0.5f)) * (1 - near * behind * inverse * inverse);
    float facing = unit_part((dot(n, lamp) + 0.25f) / 1.25f);
    facing *= facing;
    const light sky = of(theme->down) + (of(theme->up) - of(theme->down)) * (0.5f + 0.5f * n[1]);
    light c = of_ball->albedo * (sky * open + of(theme->key) * (facing * (1 - near * 0.5f * behind)));
    const light mirrored = eye + n * (2 * z), to_neighbour = (light){x < 0 ? -2 : 2, 0, 0, 0} - n;
    const float rim = (1 - z) * (1 - z), gloss = of_ball->gloss + 0.04f + 0.5f * rim * rim * (1 - z);
    const float along = dot(to_neighbour, mirrored), depth = along * along - (dot(to_neighbour, to_neighbour) - 1);
    const float hit = near * smooth(-0.05f, 0.15f, depth) * smooth(0, 0.2f, along);
    c += surroundings(mirrored, theme) * (gloss * (0.35f + 0.65f * open) * (1 - 0.7f * hit));
    c += (light){.26f, .29f, .34f, 0} * (gloss * 0.45f * hit);
    memcpy(out, &c, 3 * sizeof *out);
    out[BEAD_STAGE_FORM] = (0.62f + 0.38f * unit_part(n[1] * 0.7f + 0.6f)) * (1 - 0.22f * near * hit);
    out[BEAD_STAGE_COVER] = 1;
    out[BEAD_STAGE_RISE] = n[1];
}

/* Its image in the floor, which is added; `r` in units of the largest. It fades with the depth. */
static void mirror_look(float x, float y, float r, const struct surface *of_ball, const struct bead_stage_theme *theme, float out[])
{
    const float z = sqrtf(fmaxf(0, 1 - x * x - y * y)), depth = r * (1 - y * BEAD_STAGE_COSINE - z * BEAD_STAGE_SINE);
    const light n = {x, -(y * BEAD_STAGE_COSINE + z * BEAD_STAGE_SINE), y * BEAD_STAGE_SINE - z * BEAD_STAGE_COSINE, 0};
    const float fade = theme->mirror / (1 + depth * (0.85f + 0.5f * depth)) * smooth(0, 0.25f, z);
    const light c = of_ball->albedo * (of(theme->down) * 1.6f + of(theme->key) * (0.16f + 0.5f * unit_part(dot(n, lamp)))) * fade;
    memcpy(out, &c, 3 * sizeof *out);
    out[BEAD_STAGE_FORM] = 0.62f * fade;
    out[BEAD_STAGE_COVER] = 0;
    out[BEAD_STAGE_RISE] = n[1];
}

static float *bake_picture(const struct bead_stage *stage, const struct bead_stage_bake *b, enum bead_stage_picture picture)
{
    const int span = b->wide + 2 * BEAD_STAGE_PAD;
    const struct surface surface = surface_of(b->colour);
    float *p = calloc((size_t)b->high * BEAD_STAGE_PLANES * (size_t)span, sizeof *p);
    for (int y = 0; p && y < b->high; y++) {
        float *row = p + (size_t)y * BEAD_STAGE_PLANES * (size_t)span + BEAD_STAGE_PAD;
        for (int x = 0; x < b->wide; x++) {
            const float dx = (float)x + 0.5f - 0.5f * (float)b->wide, dy = 0.5f * (float)b->high - (float)y - 0.5f;
            const float distance = sqrtf(dx * dx + dy * dy), cover = unit_part(b->r + 0.5f - distance);
            const float scale = 1 / fmaxf(b->r, distance); /* a pixel on the edge has the look of the rim */
            float look[BEAD_STAGE_PLANES];
            if (picture == BEAD_STAGE_MIRROR)
                mirror_look(dx * scale, dy * scale, b->r / stage->unit, &surface, stage->theme, look);
            else
                ball_look(dx * scale, dy * scale, picture == BEAD_STAGE_BESIDE, &surface, stage->theme, look);
            for (int k = 0; k < BEAD_STAGE_RISE; k++)
                row[k * span + x] = look[k] * cover;
            row[BEAD_STAGE_RISE * span + x] = look[BEAD_STAGE_RISE];
        }
    }
    return p;
}

/* ---- what there is ---- */

enum bead_error bead_stage_open(struct bead_stage *s, struct bead_message *msg)
{
    s->grid_width = (s->width / BEAD_STAGE_CELL + 2 + BEAD_STAGE_PAD) / BEAD_STAGE_PAD * BEAD_STAGE_PAD;
    s->grid_rows = (s->height - 1) / BEAD_STAGE_STEP + 2;
    s->row_width = (s->width / BEAD_STAGE_PAD + 2) * BEAD_STAGE_PAD;
    s->beads = calloc(s->room, sizeof *s->beads);
    s->grid = calloc((size_t)s->grid_rows * BEAD_STAGE_CHANNELS * (size_t)s->grid_width, sizeof *s->grid);
    s->row = calloc(6 * (size_t)s->row_width + (size_t)s->grid_width, sizeof *s->row);
    if (s->beads && s->grid && s->row)
        return BEAD_OK;
    bead_stage_close(s);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a stage");
}

void bead_stage_close(struct bead_stage *s)
{
    for (size_t i = 0; i < s->bake_count; i++) {
        for (int k = 0; k < BEAD_STAGE_PICTURES; k++)
            free(s->bakes[i].picture[k]);
    }
    free(s->bakes);
    free(s->columns);
    free(s->beads);
    free(s->grid);
    free(s->row);
    s->bakes = NULL;
    s->bake_count = 0;
    s->columns = s->grid = s->row = NULL;
    s->beads = NULL;
}

/* Index of the pictures of this bead; bake_count if there is no memory. */
static size_t find_bake(struct bead_stage *s, const struct bead_stage_bead *bead)
{
    for (size_t i = 0; i < s->bake_count; i++) {
        if (s->bakes[i].r == bead->r && memcmp(s->bakes[i].colour, bead->colour, sizeof bead->colour) == 0)
            return i;
    }
    struct bead_stage_bake *grown = realloc(s->bakes, (s->bake_count + 1) * sizeof *grown);
    if (!grown)
        return s->bake_count;
    s->bakes = grown;
    grown[s->bake_count] =
        (struct bead_stage_bake){.r = bead->r, .wide = 2 * (int)ceilf(bead->r + 0.5f), .high = 2 * (int)ceilf(bead->r + 0.5f)};
    memcpy(grown[s->bake_count].colour, bead->colour, sizeof bead->colour);
    return s->bake_count++;
}

static bool bake_it(const struct bead_stage *s, struct bead_stage_bake *bake, bool mixed)
{
    for (int k = 0; k < BEAD_STAGE_PICTURES; k++) {
        if (!bake->picture[k] && (k != BEAD_STAGE_ALONE || mixed))
            bake->picture[k] = bake_picture(s, bake, (enum bead_stage_picture)k);
        if (!bake->picture[k] && (k != BEAD_STAGE_ALONE || mixed))
            return false;
    }
    return true;
}

/* Light on a ball at cosine c to its contact: ((1 + c) / 2)^4, which is within .02 of exp(-angle^2 / .98), and a hot spot. */
static float cap(float c)
{
    float k = 0.5f + 0.5f * c;
    k *= k;
    k *= k;
    float spot = k * k;
    spot *= spot;
    return 0.74f * k + 0.50f * spot * spot;
}

static void place_bead(const struct bead_stage *s, struct bead_stage_bead *b)
{
    const float left = b->x - 0.5f * (float)b->bake->wide, foot = bead_stage_foot(s), drop = BEAD_STAGE_COSINE * b->r;
    b->left = (int)floorf(left);
    b->part = left - (float)b->left;
    if (b->part > 0.98f) {
        b->part = 0;
        b->left++;
    }
    b->part = b->part < 0.02f ? 0 : b->part;
    b->top = (int)lrintf(foot - drop) - b->bake->high / 2;
    b->mirror_top = (int)lrintf(foot + drop) - b->bake->high / 2;
    b->lit = b->light[0][0] + b->light[1][0] + b->own[0] > 0.004f;
    b->tilted = b->lit && fabsf(b->tilt[0]) + fabsf(b->tilt[1]) > 0.02f;
}

static void fill_columns(struct bead_stage_bead *b)
{
    const int n = bead_stage_columns(b->bake);
    for (int k = 0; k < 3; k++)
        b->tint[k] = tint_of(b->colour, k);
    for (int x = 0; x < n; x++) {
        const float c = fminf(1, fmaxf(-1, ((float)(b->left + x) + 0.5f - b->x) / b->r));
        const float from_left = b->tilted ? 0 : cap(-c), from_right = b->tilted ? 0 : cap(c);
        for (int k = 0; k < 3; k++)
            b->columns[k * n + x] = b->tint[k] * (b->light[0][k] * from_left + b->light[1][k] * from_right + b->own[k]);
        b->columns[3 * n + x] = b->near[c >= 0];
    }
}

enum bead_error bead_stage_prepare(struct bead_stage *s, struct bead_message *msg)
{
    size_t needed = 0, at = 0;
    for (size_t i = 0; i < s->count; i++) {
        struct bead_stage_bead *b = &s->beads[i];
        const size_t bake = find_bake(s, b);
        b->mixed = b->near[0] < 1 || b->near[1] < 1;
        if (bake == s->bake_count || !bake_it(s, &s->bakes[bake], b->mixed))
            return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the look of beads");
        needed += 4 * (size_t)bead_stage_columns(&s->bakes[bake]);
    }
    if (needed > s->column_room) {
        free(s->columns);
        s->columns = calloc(needed, sizeof *s->columns);
        s->column_room = s->columns ? needed : 0;
        if (!s->columns)
            return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the light of contacts");
    }
    for (size_t i = 0; i < s->count; i++) {
        struct bead_stage_bead *b = &s->beads[i];
        b->bake = &s->bakes[find_bake(s, b)];
        b->columns = s->columns + at;
        at += 4 * (size_t)bead_stage_columns(b->bake);
        place_bead(s, b);
        fill_columns(b);
    }
    return BEAD_OK;
}
