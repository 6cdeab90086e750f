/* Mesa's off-screen interface: software rendering, no display, no window system. */
#include <GL/osmesa.h>
#include <stdlib.h>

#include "render/canvas_driver.h"

/* The context needs a default framebuffer, which nobody draws into: a canvas has its own. */
enum { IDLE_SIZE = 16 };

struct bead_context {
    OSMesaContext mesa;
    unsigned char idle[IDLE_SIZE * IDLE_SIZE * 4];
};

static bool osmesa_use(struct bead_context *context)
{
    return OSMesaGetCurrentContext() == context->mesa ||
           OSMesaMakeCurrent(context->mesa, context->idle, GL_UNSIGNED_BYTE, IDLE_SIZE, IDLE_SIZE);
}

static void osmesa_close(struct bead_context *context)
{
    if (!context)
        return;
    if (context->mesa)
        OSMesaDestroyContext(context->mesa);
    free(context);
}

static enum bead_error osmesa_open(struct bead_context **context, struct bead_message *msg)
{
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_BGRA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    *context = NULL;
    struct bead_context *c = calloc(1, sizeof *c);
    if (!c)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a graphics context");
    c->mesa = OSMesaCreateContextAttribs(attributes, NULL);
    if (!c->mesa || !osmesa_use(c)) {
        osmesa_close(c);
        return bead_fail(msg, BEAD_ERROR_GRAPHICS,
                         "OSMesa gives no OpenGL 3.3 core context: is Mesa's software renderer installed?");
    }
    *context = c;
    return BEAD_OK;
}

/* Mind that OSMesa returns something for any name, also for functions that there are not. */
static void *osmesa_function(const char *name)
{
    return (void *)OSMesaGetProcAddress(name);
}

const struct bead_canvas_driver bead_canvas_osmesa = {
    .info = {"osmesa", "Mesa's off-screen software renderer (OSMesa, llvmpipe)"},
    .open = osmesa_open,
    .use = osmesa_use,
    .function = osmesa_function,
    .close = osmesa_close,
};
