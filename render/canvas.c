#include "beadreel/canvas.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/canvas_private.h"
#include "render/paint.h"

/* In the order of trying. */
static const struct bead_canvas_driver *const drivers[] = {&bead_canvas_osmesa, &bead_canvas_egl};
enum { DRIVERS = sizeof drivers / sizeof drivers[0] };

const struct bead_canvas_backend *bead_canvas_backend_info(size_t index)
{
    return index < DRIVERS ? &drivers[index]->info : NULL;
}

void bead_canvas_prepare(void)
{
    /* Mesa reads this when the first context is made. Rasterising in the calling thread leaves the other cores to simulation and
     * encoder; the pixels are the same for any number. */
    setenv("LP_NUM_THREADS", "0", 0);
    /* Graphics cards round as they like; the same pixels everywhere come from the software renderer only. */
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
}

const struct bead_gl *bead_canvas_gl(struct bead_canvas *canvas)
{
    if (!canvas->driver->use(canvas->context))
        return NULL;
    canvas->gl.BindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    return &canvas->gl;
}

static void describe(struct bead_canvas *canvas)
{
    const char *renderer = (const char *)canvas->gl.GetString(GL_RENDERER);
    const char *version = (const char *)canvas->gl.GetString(GL_VERSION);
    snprintf(canvas->description, sizeof canvas->description, "%s, %s, OpenGL %s", canvas->driver->info.name,
             renderer ? renderer : "unknown renderer", version ? version : "of unknown version");
}

static enum bead_error fill(struct bead_canvas *canvas, struct bead_message *msg)
{
    enum bead_error err = bead_gl_load(&canvas->gl, canvas, msg);
    if (err)
        return err;
    describe(canvas);
    GLint most = 0;
    canvas->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (canvas->width > most || canvas->height > most)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a canvas of %d x %d pixels is too large: this OpenGL allows %d", canvas->width,
                         canvas->height, most);
    return bead_gl_target(&canvas->gl, canvas->width, canvas->height, NULL, 0, &canvas->texture, &canvas->framebuffer, msg);
}

static enum bead_error open_with(const struct bead_canvas_driver *driver, int width, int height, struct bead_canvas **canvas,
                                 struct bead_message *msg)
{
    struct bead_canvas *c = calloc(1, sizeof *c);
    if (!c)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a canvas");
    c->driver = driver;
    c->width = width;
    c->height = height;
    enum bead_error err = driver->open(&c->context, msg);
    if (!err)
        err = fill(c, msg);
    if (err)
        bead_canvas_destroy(c);
    else
        *canvas = c;
    return err;
}

enum bead_error bead_canvas_create(const char *backend, int width, int height, struct bead_canvas **canvas,
                                   struct bead_message *msg)
{
    *canvas = NULL;
    if (width < 1 || height < 1)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a canvas of %d x %d pixels: both must be at least 1", width, height);
    bead_canvas_prepare();
    enum bead_error err = BEAD_OK;
    struct bead_message first = {""};
    for (size_t i = 0; i < DRIVERS && !*canvas; i++) {
        if (backend && strcmp(backend, drivers[i]->info.name) != 0)
            continue;
        enum bead_error failed = open_with(drivers[i], width, height, canvas, err ? msg : &first);
        err = err ? err : failed;
    }
    if (*canvas)
        return BEAD_OK;
    if (!err)
        return bead_fail(msg, BEAD_ERROR_USAGE, "there is no canvas `%s`; there are osmesa and egl", backend);
    return bead_fail(msg, err, "%s", first.text); /* of the one to be preferred */
}

const char *bead_canvas_describe(const struct bead_canvas *canvas)
{
    return canvas->description;
}

void *bead_canvas_function(const struct bead_canvas *canvas, const char *name)
{
    return canvas->driver->function(canvas->context, name);
}

enum bead_error bead_canvas_read(struct bead_canvas *canvas, struct bead_rect source, struct bead_frame *frame, int x, int y,
                                 struct bead_message *msg)
{
    if (source.width <= 0 || source.height <= 0)
        return BEAD_OK;
    if (source.x < 0 || source.y < 0 || source.width > canvas->width - source.x || source.height > canvas->height - source.y ||
        x < 0 || y < 0 || source.width > frame->width - x || source.height > frame->height - y)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "reading %d x %d pixels at %d, %d: outside of canvas or frame", source.width,
                         source.height, source.x, source.y);
    const struct bead_gl *gl = bead_canvas_gl(canvas);
    if (!gl)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "the OpenGL context is lost");
    gl->PixelStorei(GL_PACK_ROW_LENGTH, (GLint)(frame->stride / 4));
    gl->ReadPixels(source.x, source.y, source.width, source.height, GL_RGBA, GL_UNSIGNED_BYTE,
                   frame->pixels + (size_t)y * frame->stride + (size_t)x * 4);
    return bead_gl_check(gl, "reading pixels", msg);
}

void bead_canvas_destroy(struct bead_canvas *canvas)
{
    if (!canvas)
        return;
    if (canvas->framebuffer && canvas->driver->use(canvas->context)) {
        bead_painter_destroy(canvas->painter, &canvas->gl);
        canvas->gl.DeleteFramebuffers(1, &canvas->framebuffer);
        canvas->gl.DeleteTextures(1, &canvas->texture);
    }
    canvas->driver->close(canvas->context);
    free(canvas);
}
