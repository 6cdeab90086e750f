/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes an OpenGL context with EGL, without a surface: the same software renderer for Mesa 25.1 and later, which lack OSMesa. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <string.h>

#include "render/paint/gl_context.h"

static const struct bead_library_info libraries[] = {
    {{"libEGL.so.1", "libEGL.so"},
     "paints beads with Mesa's software renderer; without it the program paints them itself",
     "libegl1"},
    {{NULL}, NULL, NULL},
};

/* Not constant: set once for the process. Calls of EGL go through this table (late.awk). */
void *bead_egl;

struct bead_context {
    EGLDisplay display;
    EGLContext egl;
    bool counted; /* the display counts its users: the last call of eglTerminate ends it */
};

/* Is the word in a blank-separated list? */
static bool lists(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; at && (at = strstr(at, word)); at += length) {
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    }
    return false;
}

static bool egl_use(struct bead_context *c)
{
    return (eglGetCurrentContext() == c->egl) ||
           (eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->egl));
}

static void egl_close(struct bead_context *c)
{
    if (c->egl != EGL_NO_CONTEXT) {
        if (eglGetCurrentContext() == c->egl)
            eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(c->display, c->egl);
    }
    if (c->display != EGL_NO_DISPLAY && c->counted)
        eglTerminate(c->display);
}

/* One display for the whole process. If EGL cannot count its users, it is never ended. */
static const char *open_display(struct bead_context *c)
{
    static const EGLAttrib counting[] = {EGL_TRACK_REFERENCES_KHR, EGL_TRUE, EGL_NONE};
    const char *can = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!lists(can, "EGL_MESA_platform_surfaceless"))
        return "EGL has no platform without surfaces";
    c->counted = lists(can, "EGL_KHR_display_reference");
    c->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, c->counted ? counting : NULL);
    if (c->display == EGL_NO_DISPLAY)
        return "EGL has no display";
    if (!eglInitialize(c->display, NULL, NULL)) {
        c->display = EGL_NO_DISPLAY;
        return "EGL cannot start its display";
    }
    const char *has = eglQueryString(c->display, EGL_EXTENSIONS);
    return lists(has, "EGL_KHR_no_config_context") && lists(has, "EGL_KHR_surfaceless_context")
               ? NULL
               : "EGL has no contexts without surfaces";
}

static const char *egl_open(struct bead_context *c)
{
    static const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const char *wrong = open_display(c);
    if (wrong)
        return wrong;
    if (!eglBindAPI(EGL_OPENGL_API))
        return "EGL has no OpenGL";
    c->egl = eglCreateContext(c->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    return c->egl != EGL_NO_CONTEXT && egl_use(c) ? NULL : "no OpenGL 3.3 core context";
}

static void *egl_function(const char *name)
{
    return (void *)eglGetProcAddress(name);
}

const struct bead_context_type bead_context_egl = {
    .libraries = libraries,
    .names = BEAD_LATE,
    .table = &bead_egl,
    .bytes = sizeof(struct bead_context),
    .open = egl_open,
    .use = egl_use,
    .function = egl_function,
    .close = egl_close,
};
