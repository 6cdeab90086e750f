/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesa's off-screen interface: software rendering, no display, no window system. Gone from Mesa 25.1 on. */
#include <GL/glcorearb.h>
#include <stdlib.h>

#include "render/draw/libraries.h"
#include "render/paint/gl_context.h"

/* The context needs a default framebuffer, which nobody draws into: a canvas has its own. */
enum { IDLE_SIZE = 16 };

/* Of GL/osmesa.h what is used here, so that this program can be built where the header is gone; it changes no more. */
enum {
    OSMESA_BGRA = 0x1,
    OSMESA_FORMAT = 0x22,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37
};
typedef struct osmesa_context *OSMesaContext;
typedef void (*OSMESAproc)(void);

#define OSMESA_FUNCTIONS(X)                                                      \
    X(OSMesaContext, CreateContextAttribs, (const int *, OSMesaContext))         \
    X(void, DestroyContext, (OSMesaContext))                                     \
    X(GLboolean, MakeCurrent, (OSMesaContext, void *, GLenum, GLsizei, GLsizei)) \
    X(OSMesaContext, GetCurrentContext, (void))                                  \
    X(OSMESAproc, GetProcAddress, (const char *))

static const char *const names[] = {
#define OSMESA_NAME(result, name, arguments) "OSMesa" #name,
    OSMESA_FUNCTIONS(OSMESA_NAME)
#undef OSMESA_NAME
};
enum { FUNCTIONS = sizeof names / sizeof names[0] };

struct bead_context {
    union {
        struct {
#define OSMESA_MEMBER(result, name, arguments) result(*name) arguments;
            OSMESA_FUNCTIONS(OSMESA_MEMBER)
#undef OSMESA_MEMBER
        };
        void (*loaded[FUNCTIONS])(void);
    } call;
    OSMesaContext mesa;
    unsigned char idle[IDLE_SIZE * IDLE_SIZE * 4];
};

static bool osmesa_use(struct bead_context *c)
{
    return c->call.GetCurrentContext() == c->mesa || c->call.MakeCurrent(c->mesa, c->idle, GL_UNSIGNED_BYTE, IDLE_SIZE, IDLE_SIZE);
}

static void osmesa_close(struct bead_context *c)
{
    if (!c)
        return;
    if (c->mesa)
        c->call.DestroyContext(c->mesa);
    free(c);
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
    enum bead_error err = bead_library_load(bead_library_info(BEAD_LIBRARY_OSMESA)->files, names, FUNCTIONS, c->call.loaded, msg);
    if (!err)
        c->mesa = c->call.CreateContextAttribs(attributes, NULL);
    if (!err && (!c->mesa || !osmesa_use(c)))
        err =
            bead_fail(msg, BEAD_ERROR_GRAPHICS, "OSMesa gives no OpenGL 3.3 core context: is Mesa's software renderer installed?");
    if (err)
        osmesa_close(c);
    else
        *context = c;
    return err;
}

/* Mind that OSMesa returns something for any name, also for functions that there are not. */
static void *osmesa_function(struct bead_context *c, const char *name)
{
    return (void *)c->call.GetProcAddress(name);
}

const struct bead_context_type bead_context_osmesa = {
    .open = osmesa_open,
    .use = osmesa_use,
    .function = osmesa_function,
    .close = osmesa_close,
};
