#include "render/paint.h"

#include <stdint.h>
#include <stdlib.h>

#include "render/canvas_private.h"

/* A program and the layout of its instances. */
struct brush {
    GLuint program, vertices;
};

/* Fragment shaders of marks. Software renderers run all branches of a shader for every pixel: what covers many has its own. */
enum { PLAIN, GLOW, ZOOM, MARK_BRUSHES };
static const char *const mark_shaders[MARK_BRUSHES] = {[PLAIN] = "mark", [GLOW] = "glow", [ZOOM] = "zoom"};

struct bead_painter {
    GLuint buffer;
    struct brush balls, marks[MARK_BRUSHES];
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

static enum bead_error make_brush(struct bead_canvas *canvas, const char *vertex, const char *fragment, GLuint buffer,
                                  size_t stride, const struct attribute *attributes, struct brush *brush, struct bead_message *msg)
{
    const struct bead_gl *gl = &canvas->gl;
    enum bead_error err = bead_gl_program(gl, vertex, fragment, &brush->program, msg);
    if (err)
        return err;
    gl->UseProgram(brush->program);
    gl->Uniform2f(gl->GetUniformLocation(brush->program, "size"), (GLfloat)canvas->width, (GLfloat)canvas->height);
    gl->GenVertexArrays(1, &brush->vertices);
    gl->BindVertexArray(brush->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
    for (GLuint i = 0; attributes[i].numbers; i++) {
        const struct attribute *a = &attributes[i];
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, a->numbers, a->type, a->normalised, (GLsizei)stride, (const void *)(uintptr_t)a->offset);
        gl->VertexAttribDivisor(i, 1);
    }
    return bead_gl_check(gl, "preparing a shader", msg);
}

static enum bead_error make_painter(struct bead_canvas *canvas, struct bead_message *msg)
{
    struct bead_painter *p = calloc(1, sizeof *p);
    if (!p)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for drawing");
    canvas->painter = p; /* freed with the canvas, also when half made */
    canvas->gl.GenBuffers(1, &p->buffer);
    enum bead_error err = make_brush(canvas, "ball", "ball", p->buffer, sizeof(struct bead_ball), ball_attributes, &p->balls, msg);
    for (int i = 0; !err && i < MARK_BRUSHES; i++)
        err = make_brush(canvas, "mark", mark_shaders[i], p->buffer, sizeof(struct bead_mark), mark_attributes, &p->marks[i], msg);
    return err;
}

static void free_brush(const struct brush *brush, const struct bead_gl *gl)
{
    gl->DeleteVertexArrays(1, &brush->vertices);
    if (brush->program)
        gl->DeleteProgram(brush->program);
}

void bead_painter_destroy(struct bead_painter *painter, const struct bead_gl *gl)
{
    if (!painter)
        return;
    free_brush(&painter->balls, gl);
    for (int i = 0; i < MARK_BRUSHES; i++)
        free_brush(&painter->marks[i], gl);
    gl->DeleteBuffers(1, &painter->buffer);
    free(painter);
}

static enum bead_error prepare(struct bead_canvas *canvas, struct bead_message *msg)
{
    if (!bead_canvas_gl(canvas))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "the OpenGL context is lost");
    return canvas->painter ? BEAD_OK : make_painter(canvas, msg);
}

enum bead_error bead_backdrop_set(struct bead_canvas *canvas, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                                  struct bead_rect rect, struct bead_message *msg)
{
    enum bead_error err = prepare(canvas, msg);
    if (err)
        return err;
    bead_backdrop_free(canvas, backdrop);
    const void *pixels = frame->pixels + (size_t)rect.y * frame->stride + (size_t)rect.x * 4;
    return bead_gl_target(&canvas->gl, rect.width, rect.height, pixels, frame->stride, &backdrop->texture, &backdrop->framebuffer,
                          msg);
}

void bead_backdrop_free(struct bead_canvas *canvas, struct bead_backdrop *backdrop)
{
    const struct bead_gl *gl = backdrop->framebuffer ? bead_canvas_gl(canvas) : NULL;
    if (gl) {
        gl->DeleteFramebuffers(1, &backdrop->framebuffer);
        gl->DeleteTextures(1, &backdrop->texture);
    }
    *backdrop = (struct bead_backdrop){0, 0};
}

enum bead_error bead_paint_begin(struct bead_canvas *canvas, const struct bead_backdrop *backdrop, struct bead_rect rect,
                                 struct bead_message *msg)
{
    enum bead_error err = prepare(canvas, msg);
    if (err)
        return err;
    const struct bead_gl *gl = &canvas->gl;
    gl->Disable(GL_SCISSOR_TEST);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, backdrop->framebuffer);
    gl->BlitFramebuffer(rect.x, rect.y, rect.x + rect.width, rect.y + rect.height, rect.x, rect.y, rect.x + rect.width,
                        rect.y + rect.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, canvas->framebuffer);
    gl->Viewport(0, 0, canvas->width, canvas->height);
    gl->Scissor(rect.x, rect.y, rect.width, rect.height);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Enable(GL_BLEND); /* colours are premultiplied */
    gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    return bead_gl_check(gl, "drawing", msg);
}

static void paint(struct bead_canvas *canvas, const struct brush *brush, const void *data, size_t bytes, size_t count)
{
    const struct bead_gl *gl = &canvas->gl;
    if (count == 0)
        return;
    gl->UseProgram(brush->program);
    gl->BindVertexArray(brush->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, canvas->painter->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * bytes), data, GL_STREAM_DRAW);
    gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)count);
}

void bead_paint_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count)
{
    paint(canvas, &canvas->painter->balls, balls, sizeof *balls, count);
}

static int brush_of(const struct bead_mark *mark)
{
    return mark->kind == BEAD_MARK_GLOW ? GLOW : mark->kind == BEAD_MARK_ZOOM ? ZOOM : PLAIN;
}

void bead_paint_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count)
{
    for (size_t i = 0, end; i < count; i = end) {
        int brush = brush_of(&marks[i]);
        for (end = i + 1; end < count && brush_of(&marks[end]) == brush;)
            end++;
        paint(canvas, &canvas->painter->marks[brush], marks + i, sizeof *marks, end - i);
    }
}
