/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesa's off-screen interface: software rendering without a display or window system. Mesa 25.1 and later lack it. */
#include "render/paint/gl_osmesa.h"

#include "render/paint/gl_context.h"

/* The context needs a default framebuffer, which stays unused: a canvas has its own. */
enum { IDLE_SIZE = 16 };

static const struct bead_library_info libraries[] = {
    {{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "paints beads; without it EGL is used", "libosmesa6"},
    {{NULL}, NULL, NULL},
};

/* Not constant: set once for the process. Calls of OSMesa go through this table (late.awk). */
void *bead_osmesa;

struct bead_context {
    OSMesaContext mesa;
    unsigned char idle[IDLE_SIZE * IDLE_SIZE * 4];
};

static bool osmesa_use(struct bead_context *c)
{
    return OSMesaGetCurrentContext() == c->mesa || OSMesaMakeCurrent(c->mesa, c->idle, GL_UNSIGNED_BYTE, IDLE_SIZE, IDLE_SIZE);
}

static void osmesa_close(struct bead_context *c)
{
    if (c->mesa)
        OSMesaDestroyContext(c->mesa);
}

static const char *osmesa_open(struct bead_context *c)
{
    static const int attributes[][2] = {{OSMESA_FORMAT, OSMESA_BGRA},
                                        {OSMESA_PROFILE, OSMESA_CORE_PROFILE},
                                        {OSMESA_CONTEXT_MAJOR_VERSION, 3},
                                        {OSMESA_CONTEXT_MINOR_VERSION, 3},
                                        {0, 0}};
    c->mesa = OSMesaCreateContextAttribs(attributes[0], NULL);
    return c->mesa && osmesa_use(c) ? NULL : "no OpenGL 3.3 core context";
}

/* Beware: OSMesa does not return NULL for unknown names. */
static void *osmesa_function(const char *name)
{
    return (void *)OSMesaGetProcAddress(name);
}

const struct bead_context_type bead_context_osmesa = {
    .libraries = libraries,
    .names = BEAD_LATE,
    .table = &bead_osmesa,
    .bytes = sizeof(struct bead_context),
    .open = osmesa_open,
    .use = osmesa_use,
    .function = osmesa_function,
    .close = osmesa_close,
};
