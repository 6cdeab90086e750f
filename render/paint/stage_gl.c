/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "render/paint/stage_gl.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

/* Shaders. Beads and their images: without light of contacts; with it; moved by a part of a pixel, too; with contacts that are not
 * level, too. INNER: where a bead hides the floor. */
/* clang-format off */
enum kind {
    FLOOR, WALL,
    MIRROR, MIRROR_LIT, MIRROR_MOVED, MIRROR_TILTED,
    BALL, BALL_LIT, BALL_MOVED, BALL_TILTED,
    INNER, INNER_LIT, INNER_MOVED, BALL_AND_MIRROR, ALONE, KINDS
};
/* clang-format on */
#define OF_BALL   "#define BALL\n"
#define OF_MIRROR "#define MIRROR\n"
#define OF_INNER  OF_BALL "#define INNER\n"
#define LIT       "#define LIT\n"
#define MOVED     "#define MOVED\n"
#define TILTED    "#define TILTED\n"
static const char *const defines[KINDS] = {[FLOOR] = "",
                                           [WALL] = "#define WALL\n",
                                           [MIRROR] = OF_MIRROR,
                                           [MIRROR_LIT] = OF_MIRROR LIT,
                                           [MIRROR_MOVED] = OF_MIRROR LIT MOVED,
                                           [MIRROR_TILTED] = OF_MIRROR LIT MOVED TILTED,
                                           [BALL] = OF_BALL,
                                           [BALL_LIT] = OF_BALL LIT,
                                           [BALL_MOVED] = OF_BALL LIT MOVED,
                                           [BALL_TILTED] = OF_BALL LIT MOVED TILTED,
                                           [INNER] = OF_INNER,
                                           [INNER_LIT] = OF_INNER LIT,
                                           [INNER_MOVED] = OF_INNER LIT MOVED,
                                           [BALL_AND_MIRROR] = OF_BALL OF_MIRROR LIT MOVED TILTED,
                                           [ALONE] = OF_BALL OF_MIRROR "#define ALONE\n" LIT MOVED TILTED};
/* Units of textures. */
enum { GROUND, FIRST_PICTURE };

/* As in stage.vert. */
struct rectangle {
    float box[4], disc[4], rows[4], planes[4], sides[4], left[3], right[3], own[3];
};
static const int numbers[] = {4, 4, 4, 4, 4, 3, 3, 3};

struct bead_stage_painter {
    GLuint program[KINDS], vertices, buffer, ground;
    int ground_size[2];
    float *light; /* of the floor */
    struct rectangle *rectangles;
    size_t room;
};

void bead_stage_gl_free(struct bead_stage_painter *p)
{
    if (!p)
        return;
    free(p->light);
    free(p->rectangles);
    free(p);
}

static enum bead_error use_program(struct bead_stage_painter *p, enum kind kind, const int size[2], const struct bead_stage *stage,
                                   struct bead_message *msg)
{
    static const char *const samplers[] = {"ground", "beside", "alone", "image"};
    GLuint *program = &p->program[kind];
    if (!*program) {
        BEAD_TRY(bead_gl_program("stage", "stage", defines[kind], program, msg));
        glUseProgram(*program);
        for (int i = 0; i < 4; i++)
            glUniform1i(glGetUniformLocation(*program, samplers[i]), i);
    }
    glUseProgram(*program);
    glUniform2f(glGetUniformLocation(*program, "size"), (GLfloat)size[0], (GLfloat)size[1]);
    glUniform3f(glGetUniformLocation(*program, "rows_of_it"), stage->centre, stage->unit, bead_stage_foot(stage));
    return BEAD_OK;
}

static GLuint make_texture(int width, int height, const float *rgba)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_RECTANGLE, texture);
    glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, rgba);
    return texture;
}

/* Empty columns at each side of a picture. */
enum { BESIDE_PICTURE = 2 };

static enum bead_error upload_picture(const struct bead_stage_bake *bake, int picture, GLuint *texture, struct bead_message *msg)
{
    const int wide = bake->wide + 2 * BESIDE_PICTURE;
    BEAD_FREED float *rgba = NULL;
    BEAD_TRY(bead_new(&rgba, 4 * (size_t)wide * (size_t)bake->high, msg, "the look of beads"));
    for (int y = 0; y < bake->high; y++)
        for (int k = 0; k < 4; k++)
            for (int x = 0; x < bake->wide; x++)
                rgba[4 * ((size_t)y * (size_t)wide + (size_t)(x + BESIDE_PICTURE)) + (size_t)k] =
                    bead_stage_row(bake, (enum bead_stage_picture)picture, y, k)[x];
    *texture = make_texture(wide, bake->high, rgba);
    return BEAD_OK;
}

static enum bead_error bind_pictures(struct bead_stage_bake *bake, struct bead_message *msg)
{
    for (int k = 0; k < BEAD_STAGE_PICTURES; k++) {
        glActiveTexture((GLenum)(GL_TEXTURE0 + FIRST_PICTURE + k));
        if (bake->picture[k] && !bake->texture[k])
            BEAD_TRY(upload_picture(bake, k, &bake->texture[k], msg));
        glBindTexture(GL_TEXTURE_RECTANGLE, bake->texture[k]);
    }
    return BEAD_OK;
}

/* The floor's light in each row, every 8 pixels. */
static enum bead_error upload_floor(struct bead_stage_painter *p, const struct bead_stage *s, int skip, struct bead_message *msg)
{
    const size_t width = (size_t)s->grid_width, numbers_of_all = 4 * width * (size_t)s->height;
    if (p->ground_size[0] != s->grid_width || p->ground_size[1] != s->height) {
        free(p->light);
        p->light = NULL;
        BEAD_TRY(bead_new(&p->light, numbers_of_all, msg, "a floor"));
        if (p->ground)
            glDeleteTextures(1, &p->ground);
        glActiveTexture(GL_TEXTURE0 + GROUND);
        p->ground = make_texture(s->grid_width, s->height, NULL);
        p->ground_size[0] = s->grid_width;
        p->ground_size[1] = s->height;
    }
    for (int y = skip; y < s->height; y++)
        bead_stage_floor_row(s, y, p->light + 4 * width * (size_t)y);
    glActiveTexture(GL_TEXTURE0 + GROUND);
    glBindTexture(GL_TEXTURE_RECTANGLE, p->ground);
    glTexSubImage2D(GL_TEXTURE_RECTANGLE, 0, 0, skip, s->grid_width, s->height - skip, GL_RGBA, GL_FLOAT,
                    p->light + 4 * width * (size_t)skip);
    return BEAD_OK;
}

/* ---- rectangles ---- */

static void draw(struct bead_stage_painter *p, size_t count)
{
    glBindBuffer(GL_ARRAY_BUFFER, p->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *p->rectangles), p->rectangles, GL_STREAM_DRAW);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)count);
}

static size_t add_box(struct rectangle *r, float left, float top, float right, float bottom)
{
    const float box[4] = {left, top, right, bottom};
    memcpy(r->box, box, sizeof box);
    return right > left && bottom > top;
}

/* Columns between a bead's contacts, in any row; if it has none, those of its picture. */
static void columns_of(const struct bead_stage *s, const struct bead_stage_bead *b, float *from, float *to)
{
    const float high = 2.1f * s->unit, left = (float)b->left, right = (float)(b->left + b->bake->wide + 1);
    const float first = isfinite(b->edge[0]) ? ceilf(b->edge[0] - 0.5f - high * fabsf(b->slope[0])) : left;
    const float last = isfinite(b->edge[1]) ? ceilf(b->edge[1] - 0.5f + high * fabsf(b->slope[1])) : right;
    *from = fmaxf(0, first);
    *to = fminf((float)s->width, last);
}

static size_t floor_boxes(struct rectangle *r, const struct bead_stage *s, float skip)
{
    const float bottom = (float)s->height;
    float at = 0, from, to;
    size_t n = 0;
    for (size_t i = 0; i < s->count; i++) {
        const struct bead_stage_bead *b = &s->beads[i];
        columns_of(s, b, &from, &to);
        if (to <= from)
            continue;
        n += add_box(&r[n], at, skip, from, bottom);
        n += add_box(&r[n], from, skip, to, (float)b->top);
        n += add_box(&r[n], from, (float)(b->mirror_top + b->bake->high), to, bottom);
        at = fmaxf(at, fminf(to, floorf(b->edge[1] - 2.1f * s->unit * fabsf(b->slope[1]))));
    }
    n += add_box(&r[n], at, skip, (float)s->width, bottom);
    return n;
}

static bool is_level(const struct bead_stage_bead *b)
{
    return b->slope[0] == 0 && b->slope[1] == 0 && !b->tilted;
}

/* The kind of shader, of these and the three that follow, that a bead needs. */
static enum kind kind_of(const struct bead_stage_bead *b, enum kind least)
{
    return least + (!is_level(b) ? 3 : b->part > 0 ? 2 : b->lit);
}

/* Half the side of the square in a level bead whose pixels it covers wholly, also where it has moved by a part of a pixel; 0: too
 * small to be worth four rectangles around it. 8 pixels are chosen, not measured: the picture does not depend on them. */
static float inner_of(const struct bead_stage_bead *b)
{
    const float half = floorf((b->r - 1.5f) * (float)M_SQRT1_2);
    return half < 8 || b->mixed || !is_level(b) ? 0 : half;
}

/* The rows of a bead that a kind of shader paints: above its image in the floor, below the bead itself, where both overlap, or the
 * whole bead if its neighbours are not beside it. */
static bool rows_of(const struct bead_stage_bead *b, enum kind kind, float *first, float *last)
{
    const float top = (float)b->top, image = (float)b->mirror_top, high = (float)b->bake->high;
    const bool inner = inner_of(b) > 0 && kind == kind_of(b, INNER);
    *first = image;
    *last = top + high;
    if (kind == kind_of(b, MIRROR)) {
        *first = top + high;
        *last = image + high;
    } else if (inner || (kind == kind_of(b, BALL) && !b->mixed)) {
        *first = top;
        *last = image;
    } else if (kind == ALONE && b->mixed) {
        *first = top;
    } else {
        return kind == BALL_AND_MIRROR && !b->mixed;
    }
    return true;
}

/* Adds what of a bead's rectangle is in its inner square, or around it. */
static size_t split_box(struct rectangle *r, const struct bead_stage_bead *b, enum kind kind, const float box[4])
{
    const float half = inner_of(b), x = (float)(b->left + b->bake->wide / 2), y = (float)(b->top + b->bake->high / 2);
    const float left = fmaxf(box[0], x - half), right = fminf(box[2], x + half);
    const float top = fmaxf(box[1], y - half), bottom = fminf(box[3], y + half);
    const float around[][4] = {
        {box[0], box[1], box[2], top}, {box[0], top, left, bottom}, {right, top, box[2], bottom}, {box[0], bottom, box[2], box[3]}};
    const struct rectangle whole = *r;
    size_t n = 0;
    if (half > 0 && kind == kind_of(b, INNER))
        return add_box(r, left, top, right, bottom);
    if (half == 0 || kind != kind_of(b, BALL) || left >= right || top >= bottom)
        return add_box(r, box[0], box[1], box[2], box[3]);
    for (int k = 0; k < 4; k++) {
        r[n] = whole;
        n += add_box(&r[n], around[k][0], around[k][1], around[k][2], around[k][3]);
    }
    return n;
}

/* At most four. */
static size_t bead_boxes(struct rectangle *r, const struct bead_stage *s, const struct bead_stage_bead *b, enum kind kind,
                         float skip)
{
    float from, to, first, last;
    if (!rows_of(b, kind, &first, &last))
        return 0;
    columns_of(s, b, &from, &to);
    *r = (struct rectangle){.disc = {b->x, b->r, (float)b->left, b->part},
                            .rows = {(float)b->top, (float)b->mirror_top, (float)b->bake->wide, (float)b->bake->high},
                            .planes = {fmaxf(b->edge[0], -1e6f), b->slope[0], fminf(b->edge[1], 1e6f), b->slope[1]},
                            .sides = {b->near[0], b->near[1], b->tilted ? b->tilt[0] : 0, b->tilted ? b->tilt[1] : 0}};
    for (int c = 0; c < 3; c++) {
        r->left[c] = b->light[0][c] * b->tint[c];
        r->right[c] = b->light[1][c] * b->tint[c];
        r->own[c] = b->own[c] * b->tint[c];
    }
    return split_box(r, b, kind, (const float[4]){from, fmaxf(skip, first), to, fminf((float)s->height, last)});
}

static enum bead_error paint_beads(struct bead_stage_painter *p, enum kind kind, const int size[2], const struct bead_stage *s,
                                   float skip, struct bead_message *msg)
{
    bool used = false;
    for (size_t k = 0; k < s->bake_count; k++) {
        size_t n = 0;
        for (size_t i = 0; i < s->count; i++) {
            if (s->beads[i].bake == &s->bakes[k])
                n += bead_boxes(&p->rectangles[n], s, &s->beads[i], kind, skip);
        }
        if (n == 0)
            continue;
        if (!used)
            BEAD_TRY(use_program(p, kind, size, s, msg));
        used = true;
        BEAD_TRY(bind_pictures(&s->bakes[k], msg));
        draw(p, n);
    }
    return BEAD_OK;
}

static enum bead_error paint_wall(struct bead_stage_painter *p, const int size[2], const struct bead_stage *s, float skip,
                                  struct bead_message *msg)
{
    const struct bead_stage_wall *w = &s->wall;
    struct rectangle *r = p->rectangles;
    *r = (struct rectangle){.disc = {w->x}};
    memcpy(r->right, w->light, sizeof r->right);
    memcpy(r->own, w->colour, sizeof r->own);
    r->sides[0] = s->theme->mirror;
    /* Rows as in the plain painter: those whose middle is from 1.2 above the centre to as far below the floor. */
    const float top = ceilf(s->centre - 1.2f * s->unit - 0.5f), foot = bead_stage_foot(s);
    const float bottom = fminf((float)s->height, floorf(foot + (1.2f + BEAD_STAGE_COSINE) * s->unit - 0.5f) + 1);
    const float left = fmaxf(0, ceilf(w->x - 0.5f)), right = fminf(floorf(w->x + w->width), (float)s->width);
    if (w->width <= 0 || !add_box(r, left, fmaxf(skip, top), right, bottom))
        return BEAD_OK;
    BEAD_TRY(use_program(p, WALL, size, s, msg));
    draw(p, 1);
    return BEAD_OK;
}

static enum bead_error open_painter(struct bead_stage_painter **painter, size_t count, struct bead_message *msg)
{
    struct bead_stage_painter *p = *painter;
    BEAD_TRY(p ? BEAD_OK : bead_new(painter, 1, msg, "a stage"));
    p = *painter;
    if (!p->buffer) {
        glGenBuffers(1, &p->buffer);
        glGenVertexArrays(1, &p->vertices);
    }
    glBindVertexArray(p->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, p->buffer);
    size_t offset = 0;
    for (GLuint i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, numbers[i], GL_FLOAT, GL_FALSE, sizeof(struct rectangle), (const void *)(uintptr_t)offset);
        glVertexAttribDivisor(i, 1);
        offset += (size_t)numbers[i] * sizeof(float);
    }
    if (count <= p->room)
        return BEAD_OK;
    free(p->rectangles);
    p->rectangles = NULL;
    p->room = count;
    return bead_new(&p->rectangles, count, msg, "a stage");
}

enum bead_error bead_stage_gl(struct bead_stage_painter **painter, const int size[2], const struct bead_stage *s, int skip,
                              struct bead_message *msg)
{
    BEAD_TRY(open_painter(painter, 4 * s->room + 2, msg));
    struct bead_stage_painter *p = *painter;
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, size[0], size[1]);
    BEAD_TRY(upload_floor(p, s, skip, msg));
    BEAD_TRY(use_program(p, FLOOR, size, s, msg));
    draw(p, floor_boxes(p->rectangles, s, (float)skip));
    for (enum kind kind = MIRROR; kind < KINDS; kind++)
        BEAD_TRY(paint_beads(p, kind, size, s, (float)skip, msg));
    BEAD_TRY(paint_wall(p, size, s, (float)skip, msg));
    glActiveTexture(GL_TEXTURE0);
    return bead_gl_check("painting a stage", msg);
}
