/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Painting with OpenGL: the shaders of assets/shaders, into a framebuffer of the canvas's own, which is read back. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/paint/canvas_private.h"
#include "render/paint/gl.h"

/* A program and the layout of what it draws: points, a vertex each, or squares, an instance each. */
struct brush {
    GLuint program, vertices;
    bool points;
};

/* Fragment shaders of marks. Software renderers run all branches of a shader for every pixel: what covers many has its own. */
enum { PLAIN, GLOW, MARK_BRUSHES };
static const char *const mark_shaders[MARK_BRUSHES] = {[PLAIN] = "mark", [GLOW] = "glow"};

struct bead_painter {
    struct bead_context *context;
    struct bead_gl gl;
    GLuint texture, framebuffer; /* row 0 of the framebuffer is the top row of the picture */
    bool ready;                  /* the shaders are there; made when first painted */
    int margin; /* px: OpenGL drops points whose centre is not in the viewport, which is wider by this on all sides */
    GLuint buffer;
    struct brush balls, large_balls, marks[MARK_BRUSHES]; /* large: larger than points can be */
};

/* One attribute of an instance. Canvases keep their pixels as frames do, blue first, in what OpenGL takes for red: read back, they
 * are copied as they are. So the colours of what is drawn change their order too (GL_BGRA). */
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
    const struct bead_gl *gl = &canvas->painter->gl;
    const int margin = canvas->painter->margin;
    enum bead_error err = bead_gl_program(gl, vertex, fragment, &brush->program, msg);
    if (err)
        return err;
    gl->UseProgram(brush->program);
    gl->Uniform2f(gl->GetUniformLocation(brush->program, "size"), (GLfloat)(canvas->width + 2 * margin),
                  (GLfloat)(canvas->height + 2 * margin));
    gl->Uniform1f(gl->GetUniformLocation(brush->program, "margin"), (GLfloat)margin);
    gl->Uniform1f(gl->GetUniformLocation(brush->program, "spread"), brush->points ? 0 : 1);
    gl->GenVertexArrays(1, &brush->vertices);
    gl->BindVertexArray(brush->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, canvas->painter->buffer);
    for (GLuint i = 0; attributes[i].numbers; i++) {
        const struct attribute *a = &attributes[i];
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, a->numbers, a->type, a->normalised, (GLsizei)stride, (const void *)(uintptr_t)a->offset);
        gl->VertexAttribDivisor(i, brush->points ? 0 : 1);
    }
    return bead_gl_check(gl, "preparing a shader", msg);
}

static void free_brush(const struct bead_gl *gl, struct brush *brush)
{
    if (brush->vertices)
        gl->DeleteVertexArrays(1, &brush->vertices);
    if (brush->program)
        gl->DeleteProgram(brush->program);
    *brush = (struct brush){0, 0, false};
}

static void free_brushes(struct bead_painter *p)
{
    free_brush(&p->gl, &p->balls);
    free_brush(&p->gl, &p->large_balls);
    for (int i = 0; i < MARK_BRUSHES; i++)
        free_brush(&p->gl, &p->marks[i]);
    if (p->buffer)
        p->gl.DeleteBuffers(1, &p->buffer);
    p->buffer = 0;
}

static enum bead_error make_brushes(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    p->gl.GenBuffers(1, &p->buffer);
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

/* Our context is current and our framebuffer bound, or it says why not. */
static enum bead_error use(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    if (!canvas->driver->context->use(p->context))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "the OpenGL context is lost");
    p->gl.BindFramebuffer(GL_FRAMEBUFFER, p->framebuffer);
    return p->ready ? BEAD_OK : make_brushes(canvas, msg);
}

static void describe(struct bead_canvas *canvas, const struct bead_gl *gl)
{
    const char *renderer = (const char *)gl->GetString(GL_RENDERER), *version = (const char *)gl->GetString(GL_VERSION);
    snprintf(canvas->description, sizeof canvas->description, "%s, %s, OpenGL %s", canvas->driver->info.name,
             renderer ? renderer : "unknown renderer", version ? version : "of unknown version");
    /* "llvmpipe (LLVM 15.0.6, 256 bits)": the name alone. */
    snprintf(canvas->credit, sizeof canvas->credit, "%s (%.*s)", canvas->driver->title, (int)strcspn(renderer ? renderer : "", " "),
             renderer ? renderer : "");
}

/* Half of the largest point; 0 where the viewport cannot be so wide. */
static int find_margin(const struct bead_canvas *canvas)
{
    const struct bead_gl *gl = &canvas->painter->gl;
    GLfloat points[2] = {0, 0};
    GLint widest[2] = {0, 0};
    gl->GetFloatv(GL_POINT_SIZE_RANGE, points);
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, widest);
    int margin = points[1] < 256 ? (int)(0.5F * points[1]) : 128;
    return canvas->width + 2 * margin <= widest[0] && canvas->height + 2 * margin <= widest[1] ? margin : 0;
}

static enum bead_error fill(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = canvas->painter;
    enum bead_error err = bead_gl_load(&p->gl, canvas->driver->context, p->context, msg);
    if (err)
        return err;
    describe(canvas, &p->gl);
    GLint most = 0;
    p->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (canvas->width > most || canvas->height > most)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a canvas of %d x %d pixels is too large: this OpenGL allows %d", canvas->width,
                         canvas->height, most);
    p->margin = find_margin(canvas);
    return bead_gl_target(&p->gl, canvas->width, canvas->height, NULL, 0, &p->texture, &p->framebuffer, msg);
}

static void gl_close(struct bead_canvas *canvas)
{
    struct bead_painter *p = canvas->painter;
    const struct bead_context_type *type = canvas->driver->context;
    if (p->framebuffer && type->use(p->context)) {
        free_brushes(p);
        p->gl.DeleteFramebuffers(1, &p->framebuffer);
        p->gl.DeleteTextures(1, &p->texture);
    }
    type->close(p->context);
    free(p);
    canvas->painter = NULL;
}

static enum bead_error gl_open(struct bead_canvas *canvas, struct bead_message *msg)
{
    canvas->painter = calloc(1, sizeof *canvas->painter);
    if (!canvas->painter)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for drawing");
    enum bead_error err = canvas->driver->context->open(&canvas->painter->context, msg);
    if (!err)
        err = fill(canvas, msg);
    if (err)
        gl_close(canvas);
    return err;
}

static enum bead_error gl_keep(struct bead_canvas *canvas, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                               struct bead_message *msg)
{
    enum bead_error err = use(canvas, msg);
    if (err)
        return err;
    const struct bead_rect *place = &backdrop->place;
    const void *pixels = frame->pixels + (size_t)place->y * frame->stride + (size_t)place->x * 4;
    return bead_gl_target(&canvas->painter->gl, place->width, place->height, pixels, frame->stride, &backdrop->texture,
                          &backdrop->framebuffer, msg);
}

static void gl_forget(struct bead_canvas *canvas, struct bead_backdrop *backdrop)
{
    const struct bead_gl *gl = &canvas->painter->gl;
    if (!backdrop->framebuffer || !canvas->driver->context->use(canvas->painter->context))
        return;
    gl->DeleteFramebuffers(1, &backdrop->framebuffer);
    gl->DeleteTextures(1, &backdrop->texture);
}

static enum bead_error gl_begin(struct bead_canvas *canvas, struct bead_message *msg)
{
    enum bead_error err = use(canvas, msg);
    if (err)
        return err;
    const struct bead_gl *gl = &canvas->painter->gl;
    const struct bead_rect rect = canvas->rect;
    const int margin = canvas->painter->margin;
    gl->Disable(GL_SCISSOR_TEST);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, canvas->backdrop->framebuffer);
    gl->BlitFramebuffer(rect.x, rect.y, rect.x + rect.width, rect.y + rect.height, rect.x, rect.y, rect.x + rect.width,
                        rect.y + rect.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, canvas->painter->framebuffer);
    gl->Viewport(-margin, -margin, canvas->width + 2 * margin, canvas->height + 2 * margin);
    gl->Scissor(rect.x, rect.y, rect.width, rect.height);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Enable(GL_PROGRAM_POINT_SIZE);
    gl->Enable(GL_BLEND); /* colours are premultiplied */
    gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    return bead_gl_check(gl, "drawing", msg);
}

static void paint(struct bead_canvas *canvas, const struct brush *brush, const void *data, size_t bytes, size_t count)
{
    const struct bead_gl *gl = &canvas->painter->gl;
    gl->UseProgram(brush->program);
    gl->BindVertexArray(brush->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, canvas->painter->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * bytes), data, GL_STREAM_DRAW);
    if (brush->points)
        gl->DrawArraysInstanced(GL_POINTS, 0, (GLsizei)count, 1);
    else
        gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)count);
}

/* A square of two triangles is shaded twice along its diagonal, a point is not. */
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

static enum bead_error gl_end(struct bead_canvas *canvas, struct bead_message *msg)
{
    const struct bead_gl *gl = &canvas->painter->gl;
    const struct bead_rect *place = &canvas->backdrop->place, *rect = &canvas->rect;
    struct bead_frame *frame = canvas->frame;
    gl->PixelStorei(GL_PACK_ROW_LENGTH, (GLint)(frame->stride / 4));
    gl->ReadPixels(rect->x, rect->y, rect->width, rect->height, GL_RGBA, GL_UNSIGNED_BYTE,
                   frame->pixels + (size_t)(place->y + rect->y) * frame->stride + (size_t)(place->x + rect->x) * 4);
    return bead_gl_check(gl, "reading pixels", msg);
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
};
