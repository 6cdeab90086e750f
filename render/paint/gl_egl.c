/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes an OpenGL context with EGL, without a surface: OSMesa's software renderer, for Mesa 25.1 and later, which lack OSMesa. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/libraries.h"
#include "render/paint/gl_context.h"

#define EGL_FUNCTIONS(X)                                                              \
    X(EGLDisplay, GetPlatformDisplay, (EGLenum, void *, const EGLAttrib *))           \
    X(EGLBoolean, Initialize, (EGLDisplay, EGLint *, EGLint *))                       \
    X(EGLBoolean, Terminate, (EGLDisplay))                                            \
    X(EGLBoolean, BindAPI, (EGLenum))                                                 \
    X(EGLContext, CreateContext, (EGLDisplay, EGLConfig, EGLContext, const EGLint *)) \
    X(EGLBoolean, DestroyContext, (EGLDisplay, EGLContext))                           \
    X(EGLBoolean, MakeCurrent, (EGLDisplay, EGLSurface, EGLSurface, EGLContext))      \
    X(EGLContext, GetCurrentContext, (void))                                          \
    X(const char *, QueryString, (EGLDisplay, EGLint))                                \
    X(__eglMustCastToProperFunctionPointerType, GetProcAddress, (const char *))

static const char *const names[] = {
#define EGL_NAME(result, name, arguments) "egl" #name,
    EGL_FUNCTIONS(EGL_NAME)
#undef EGL_NAME
};
enum { FUNCTIONS = sizeof names / sizeof names[0] };

struct bead_context {
    union {
        struct {
#define EGL_MEMBER(result, name, arguments) result(*name) arguments;
            EGL_FUNCTIONS(EGL_MEMBER)
#undef EGL_MEMBER
        };
        void (*loaded[FUNCTIONS])(void);
    } call;
    EGLDisplay display;
    EGLContext egl;
    bool counted; /* the display counts its users: the last one's Terminate ends it */
};

/* Is the word in a list separated by blanks? */
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
    return (c->call.GetCurrentContext() == c->egl) ||
           (c->call.BindAPI(EGL_OPENGL_API) && c->call.MakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->egl));
}

static void egl_close(struct bead_context *c)
{
    if (!c)
        return;
    if (c->egl != EGL_NO_CONTEXT) {
        if (c->call.GetCurrentContext() == c->egl)
            c->call.MakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        c->call.DestroyContext(c->display, c->egl);
    }
    if (c->display != EGL_NO_DISPLAY && c->counted)
        c->call.Terminate(c->display);
    free(c);
}

/* One display for the whole process, without counting users where EGL cannot: then it is never ended. */
static const char *open_display(struct bead_context *c)
{
    static const EGLAttrib counting[] = {EGL_TRACK_REFERENCES_KHR, EGL_TRUE, EGL_NONE};
    const char *can = c->call.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!lists(can, "EGL_MESA_platform_surfaceless"))
        return "it knows no platform without surfaces";
    c->counted = lists(can, "EGL_KHR_display_reference");
    c->display = c->call.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, c->counted ? counting : NULL);
    if (c->display == EGL_NO_DISPLAY)
        return "no display";
    if (!c->call.Initialize(c->display, NULL, NULL)) {
        c->display = EGL_NO_DISPLAY;
        return "its display does not start";
    }
    const char *has = c->call.QueryString(c->display, EGL_EXTENSIONS);
    return lists(has, "EGL_KHR_no_config_context") && lists(has, "EGL_KHR_surfaceless_context")
               ? NULL
               : "its display knows no contexts without surfaces";
}

static const char *open_context(struct bead_context *c)
{
    static const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const char *wrong = open_display(c);
    if (wrong)
        return wrong;
    if (!c->call.BindAPI(EGL_OPENGL_API))
        return "it knows no OpenGL";
    c->egl = c->call.CreateContext(c->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    return c->egl != EGL_NO_CONTEXT && egl_use(c) ? NULL : "no OpenGL 3.3 core context";
}

static enum bead_error egl_open(struct bead_context **context, struct bead_message *msg)
{
    *context = NULL;
    struct bead_context *c = calloc(1, sizeof *c);
    if (!c)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a graphics context");
    c->display = EGL_NO_DISPLAY;
    c->egl = EGL_NO_CONTEXT;
    enum bead_error err = bead_library_load(bead_library_info(BEAD_LIBRARY_EGL)->files, names, FUNCTIONS, c->call.loaded, msg);
    const char *wrong = err ? NULL : open_context(c);
    if (wrong)
        err = bead_fail(msg, BEAD_ERROR_GRAPHICS, "EGL: %s: are Mesa's EGL and software renderer installed?", wrong);
    if (err)
        egl_close(c);
    else
        *context = c;
    return err;
}

static void *egl_function(struct bead_context *c, const char *name)
{
    return (void *)c->call.GetProcAddress(name);
}

const struct bead_context_type bead_context_egl = {
    .open = egl_open,
    .use = egl_use,
    .function = egl_function,
    .close = egl_close,
};
