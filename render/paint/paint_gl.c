/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Painting with OpenGL: the shaders of assets/shaders draw into the canvas's framebuffer, which is read back. */
#include <stdlib.h>

#include "render/paint/canvas_private.h"
#include "render/paint/gl.h"
#include "render/paint/stage_gl.h"
#include "sim/base/memory.h"

/* A program and the layout of its input: points, a vertex each, or squares, an instance each. */
struct brush {
    GLuint program, vertices;
    bool points;
};

/* Fragment shaders for marks. Software renderers run all branches of a shader for each pixel, so large marks have their own. */
enum { PLAIN, GLOW, MARK_BRUSHES };
static const char *const mark_shaders[MARK_BRUSHES] = {[PLAIN] = "mark", [GLOW] = "glow"};

struct bead_painter {
    struct bead_context *context;
    void *functions;             /* for bead_gl */
    GLuint texture, framebuffer; /* row 0 of the framebuffer is the top row of the picture */
    bool ready;                  /* the shaders exist; they are made at the first painting */
    int margin;                  /* px: added to the viewport on all sides, because OpenGL drops points with centres outside it */
    GLuint buffer;
    struct bead_stage_painter *stage;                     /* NULL: none painted yet */
    struct brush balls, large_balls, marks[MARK_BRUSHES]; /* large: too large for points */
};

/* One attribute of an instance. Canvases store pixels in the order of frames, with blue in OpenGL's red, so that reading them back
 * is a copy. Colours to draw have the same order (GL_BGRA). */
struct attribute {
    GLint numbers;
    GLenum type;
    GLboolean normalised;
    size_t offset;
};

static const struct attribute ball_attributes[] = {
    {3, GL_FLOAT, GL_FALSE, offsetof(struct bead_ball, x)},
    {2, GL_FLOAT, GL_FALSE, offsetof(struct bead_ball, left)},
    {GL_BGRA, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(struct bead_ball, rgba)},
    {0, 0, 0, 0},
};
static const struct attribute mark_attributes[] = {
    {4, GL_FLOAT, GL_FALSE, offsetof(struct bead_mark, box)},
    {4, GL_FLOAT, GL_FALSE, offsetof(struct bead_mark, shape)},
    {1, GL_FLOAT, GL_FALSE, offsetof(struct bead_mark, kind)},
    {GL_BGRA, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(struct bead_mark, rgba)},
    {0, 0, 0, 0},
};

static enum bead_error make_brush(struct bead_canvas *canvas, const char *vertex, const char *fragment, size_t stride,
                                  const struct attribute *attributes, struct brush *brush, struct bead_message *msg)
{
    const int margin = canvas->painter->margin;
    BEAD_TRY(bead_gl_program(vertex, fragment, NULL, &brush->program, msg));
    glUseProgram(brush->program);
    glUniform2f(glGetUniformLocation(brush->program, "size"), (GLfloat)(canvas->width + 2 * margin),
                (GLfloat)(canvas->height + 2 * margin));
    glUniform1f(glGetUniformLocation(brush->program, "margin"), (GLfloat)margin);
    glUniform1f(glGetUniformLocation(brush->program, "spread"), brush->points ? 0 : 1);
    glGenVertexArrays(1, &brush->vertices);
    glBindVertexArray(brush->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, canvas->painter->buffer);
    for (GLuint i = 0; attributes[i].numbers; i++) {
        const struct attribute *a = &attributes[i];
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, a->numbers, a->type, a->normalised, (GLsizei)stride, (const void *)(uintptr_t)a->offset);
        glVertexAttribDivisor(i, brush->points ? 0 : 1);
    }
    return bead_gl_check("preparing a shader", msg);
}

static void free_brush(struct brush *brush)
{
    if (brush->vertices)
        glDeleteVertexArrays(1, &brush->vertices);
    if (brush->program)
        glDeleteProgram(brush->program);
    *brush = (struct brush){0, 0, false};
}

static void free_brushes(struct bead_painter *p)
{
    free_brush(&p->balls);
    free_brush(&p->large_balls);
    for (int i = 0; i < MARK_BRUSHES; i++)
        free_brush(&p->marks[i]);
    if (p->buffer)
        glDeleteBuffers(1, &p->buffer);
    p->buffer = 0;
}

static enum bead_error make_brushes(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    glGenBuffers(1, &p->buffer);
    p->balls.points = true;
    enum bead_error err = make_brush(canvas, "ball", "ball", sizeof(struct bead_ball), ball_attributes, &p->balls, msg);
    if (!err)
        err = make_brush(canvas, "ball", "ball", sizeof(struct bead_ball), ball_attributes, &p->large_balls, msg);
    for (int i = 0; !err && i < MARK_BRUSHES; i++)
        err = make_brush(canvas, "mark", mark_shaders[i], sizeof(struct bead_mark), mark_attributes, &p->marks[i], msg);
    if (err)
        free_brushes(p);
    p->ready = !err;
    return err;
}

/* Make the canvas's context, and its OpenGL functions, current in this thread. */
static bool enter(const struct bead_canvas *canvas)
{
    bead_gl = canvas->painter->functions;
    return canvas->driver->context->use(canvas->painter->context);
}

/* Make the context current and bind the framebuffer. */
static enum bead_error use(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    if (!enter(canvas))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "the OpenGL context is lost");
    glBindFramebuffer(GL_FRAMEBUFFER, p->framebuffer);
    return p->ready ? BEAD_OK : make_brushes(canvas, msg);
}

static void describe(struct bead_canvas *canvas)
{
    const char *renderer = (const char *)glGetString(GL_RENDERER), *version = (const char *)glGetString(GL_VERSION);
    snprintf(canvas->description, sizeof canvas->description, "%s, %s, OpenGL %s", canvas->driver->info.name,
             renderer ? renderer : "unknown renderer", version ? version : "of unknown version");
    /* Only the name of "llvmpipe (LLVM 15.0.6, 256 bits)". */
    snprintf(canvas->credit, sizeof canvas->credit, "%s (%.*s)", canvas->driver->title, (int)strcspn(renderer ? renderer : "", " "),
             renderer ? renderer : "");
}

/* Half the size of the largest point; 0 if the viewport cannot be as wide. */
static int find_margin(const struct bead_canvas *canvas)
{
    GLfloat points[2] = {0, 0};
    GLint widest[2] = {0, 0};
    glGetFloatv(GL_POINT_SIZE_RANGE, points);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, widest);
    int margin = points[1] < 256 ? (int)(0.5F * points[1]) : 128;
    return canvas->width + 2 * margin <= widest[0] && canvas->height + 2 * margin <= widest[1] ? margin : 0;
}

static enum bead_error fill(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    BEAD_TRY(bead_gl_load(canvas->driver->context, &p->functions, msg));
    bead_gl = p->functions;
    describe(canvas);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (canvas->width > most || canvas->height > most)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a canvas of %d x %d pixels is too large; this OpenGL allows %d", canvas->width,
                         canvas->height, most);
    p->margin = find_margin(canvas);
    return bead_gl_target(canvas->width, canvas->height, NULL, 0, &p->texture, &p->framebuffer, msg);
}

static void gl_close(struct bead_canvas *canvas)
{
    struct bead_painter *p = canvas->painter;
    if (p->framebuffer && enter(canvas)) {
        free_brushes(p);
        glDeleteFramebuffers(1, &p->framebuffer);
        glDeleteTextures(1, &p->texture);
    }
    if (p->context)
        canvas->driver->context->close(p->context);
    bead_stage_gl_free(p->stage);
    free(p->context);
    free(p->functions);
    free(p);
    canvas->painter = NULL;
}

static enum bead_error gl_open(struct bead_canvas *canvas, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&canvas->painter, 1, msg, "drawing"));
    enum bead_error err = bead_gl_open(canvas->driver->context, &canvas->painter->context, msg);
    if (!err)
        err = fill(canvas, msg);
    if (err)
        gl_close(canvas);
    return err;
}

static enum bead_error gl_keep(struct bead_canvas *canvas, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                               struct bead_message *msg)
{
    BEAD_TRY(use(canvas, msg));
    const struct bead_rect *place = &backdrop->place;
    const void *pixels = frame->pixels + (size_t)place->y * frame->stride + (size_t)place->x * 4;
    return bead_gl_target(place->width, place->height, pixels, frame->stride, &backdrop->texture, &backdrop->framebuffer, msg);
}

static void gl_forget(struct bead_canvas *canvas, struct bead_backdrop *backdrop)
{
    if (!backdrop->framebuffer || !enter(canvas))
        return;
    glDeleteFramebuffers(1, &backdrop->framebuffer);
    glDeleteTextures(1, &backdrop->texture);
}

static enum bead_error gl_begin(struct bead_canvas *canvas, struct bead_message *msg)
{
    BEAD_TRY(use(canvas, msg));
    const struct bead_rect rect = canvas->rect;
    const int margin = canvas->painter->margin;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->backdrop->framebuffer);
    glBlitFramebuffer(rect.x, rect.y, rect.x + rect.width, rect.y + rect.height, rect.x, rect.y, rect.x + rect.width,
                      rect.y + rect.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->painter->framebuffer);
    glViewport(-margin, -margin, canvas->width + 2 * margin, canvas->height + 2 * margin);
    glScissor(rect.x, rect.y, rect.width, rect.height);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND); /* colours are premultiplied */
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    return bead_gl_check("drawing", msg);
}

static void paint(struct bead_canvas *canvas, const struct brush *brush, const void *data, size_t bytes, size_t count)
{
    glUseProgram(brush->program);
    glBindVertexArray(brush->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, canvas->painter->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * bytes), data, GL_STREAM_DRAW);
    if (brush->points)
        glDrawArraysInstanced(GL_POINTS, 0, (GLsizei)count, 1);
    else
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)count);
}

/* Points are faster: a square of two triangles is shaded twice along its diagonal. */
static const struct brush *ball_brush(const struct bead_painter *p, const struct bead_ball *ball)
{
    return ball->r + 1 < (float)p->margin ? &p->balls : &p->large_balls;
}

static void gl_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count)
{
    for (size_t i = 0, end; i < count; i = end) {
        const struct brush *brush = ball_brush(canvas->painter, &balls[i]);
        for (end = i + 1; end < count && ball_brush(canvas->painter, &balls[end]) == brush;)
            end++;
        paint(canvas, brush, balls + i, sizeof *balls, end - i);
    }
}

static int brush_of(const struct bead_mark *mark)
{
    return mark->kind == BEAD_MARK_GLOW ? GLOW : PLAIN;
}

static void gl_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count)
{
    for (size_t i = 0, end; i < count; i = end) {
        int brush = brush_of(&marks[i]);
        for (end = i + 1; end < count && brush_of(&marks[end]) == brush;)
            end++;
        paint(canvas, &canvas->painter->marks[brush], marks + i, sizeof *marks, end - i);
    }
}

/* Copies a rectangle of the canvas to this place of a frame. */
static void read_pixels(struct bead_rect rect, uint8_t *pixels, size_t stride, int x, int y)
{
    glPixelStorei(GL_PACK_ROW_LENGTH, (GLint)(stride / 4));
    glReadPixels(rect.x, rect.y, rect.width, rect.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels + (size_t)y * stride + (size_t)x * 4);
}

static enum bead_error gl_end(struct bead_canvas *canvas, struct bead_message *msg)
{
    const struct bead_rect *place = &canvas->backdrop->place, *rect = &canvas->rect;
    struct bead_frame *frame = canvas->frame;
    read_pixels(*rect, frame->pixels, frame->stride, place->x + rect->x, place->y + rect->y);
    return bead_gl_check("reading pixels", msg);
}

static enum bead_error gl_stage(struct bead_canvas *canvas, const struct bead_stage *stage, const struct bead_ground *ground,
                                struct bead_message *msg)
{
    const int size[2] = {canvas->width, canvas->height};
    const struct bead_rect *clip = &ground->clip;
    BEAD_TRY(use(canvas, msg));
    bead_pixel_kernels_find(NULL)->stage_floor(stage);
    BEAD_TRY(bead_stage_gl(&canvas->painter->stage, size, stage, clip->y, msg));
    read_pixels(*clip, ground->pixels, ground->stride, ground->origin[0] + clip->x, ground->origin[1] + clip->y);
    return bead_gl_check("reading pixels", msg);
}

const struct bead_painting bead_painting_gl = {
    .open = gl_open,
    .close = gl_close,
    .keep = gl_keep,
    .forget = gl_forget,
    .begin = gl_begin,
    .balls = gl_balls,
    .marks = gl_marks,
    .end = gl_end,
    .stage = gl_stage,
};
