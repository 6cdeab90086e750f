/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Canvases: the table of back ends, and the choice of one. Views paint on a canvas through paint.c. */
#include "render/paint/canvas.h"

#include <stdlib.h>
#include <unistd.h>

#include "render/paint/canvas_private.h"
#include "render/paint/gl_context.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"

/* Without a name, the first that works is used. */
static const struct bead_canvas_driver drivers[] = {
    {{"osmesa", "Mesa's off-screen software renderer (llvmpipe)"}, "OSMesa", &bead_painting_gl, &bead_context_osmesa},
    {{"egl", "the same renderer through EGL, for Mesa 25.1 and later"}, "EGL", &bead_painting_gl, &bead_context_egl},
    {{"plain", "this program's own painter: the fastest, on any machine"}, "the plain canvas", &bead_painting_plain, NULL},
};
enum { DRIVERS = sizeof drivers / sizeof drivers[0], MANY_CORES = 4 };

const struct bead_canvas_backend *bead_canvas_backend_info(size_t index)
{
    return index < DRIVERS ? &drivers[index].info : NULL;
}

static const struct bead_canvas_driver *find(const char *name)
{
    for (size_t i = 0; i < DRIVERS; i++) {
        if (strcmp(name, drivers[i].info.name) == 0)
            return &drivers[i];
    }
    return NULL;
}

void bead_canvas_prepare(const char *backend)
{
    const struct bead_canvas_driver *driver = backend ? find(backend) : &drivers[0];
    if (!driver || !driver->context)
        return;
    /* Mesa reads this when the first context is made. With few cores the calling thread rasterises, which leaves the others to the
     * simulation and the encoder. The pixels do not depend on the number. */
    setenv("LP_NUM_THREADS", sysconf(_SC_NPROCESSORS_ONLN) < MANY_CORES ? "0" : "2", 0);
    /* Graphics cards round differently: only the software renderer gives the same pixels everywhere. */
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
}

static enum bead_error fail_unknown(const char *backend, struct bead_message *msg)
{
    char names[128] = "";
    for (size_t i = 0; i < DRIVERS; i++)
        bead_list_add(names, sizeof names, ", ", drivers[i].info.name);
    return bead_fail(msg, BEAD_ERROR_USAGE, "there is no canvas `%s`; allowed are %s", backend, names);
}

static enum bead_error open_driver(const struct bead_canvas_driver *driver, int width, int height, struct bead_canvas **canvas,
                                   struct bead_message *msg)
{
    struct bead_canvas *c;
    if (driver->context && !bead_memory_ample())
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s needs 4 GiB of free addresses (ulimit -v); --canvas plain does without",
                         driver->title);
    BEAD_TRY(bead_new(&c, 1, msg, "a canvas"));
    c->driver = driver;
    c->width = width;
    c->height = height;
    enum bead_error err = driver->painting->open(c, msg);
    if (err)
        free(c);
    else
        *canvas = c;
    return err;
}

enum bead_error bead_canvas_create(const char *backend, int width, int height, struct bead_canvas **canvas,
                                   struct bead_message *msg)
{
    *canvas = NULL;
    if (width < 1 || height < 1)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a canvas of %d x %d pixels; both must be at least 1", width, height);
    const struct bead_canvas_driver *named = backend ? find(backend) : NULL;
    if (backend && !named)
        return fail_unknown(backend, msg);
    bead_canvas_prepare(backend);
    if (named)
        return open_driver(named, width, height, canvas, msg);
    enum bead_error err = BEAD_ERROR_GRAPHICS;
    for (size_t i = 0; err == BEAD_ERROR_GRAPHICS && i < DRIVERS; i++)
        err = open_driver(&drivers[i], width, height, canvas, msg);
    return err;
}

const char *bead_canvas_describe(const struct bead_canvas *canvas)
{
    return canvas->description;
}

const char *bead_canvas_painter(const struct bead_canvas *canvas)
{
    return canvas->credit;
}

void bead_canvas_destroy(struct bead_canvas *canvas)
{
    if (!canvas)
        return;
    canvas->driver->painting->close(canvas);
    free(canvas);
}
