/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ways to OpenGL that fail. An EGL of this program's own keeps an account of displays and contexts, and each of its calls fails
 * once; OSMesa's functions are missing one by one, and each question for errors is answered with one. The reason is told, and
 * nothing is left open. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/paint/gl.h"
#include "render/paint/paint.h"
#include "tests/missing.h"

/* ---- an EGL that fails ---- */

#define DISPLAY ((EGLDisplay)0x10)
#define CONTEXT ((EGLContext)0x20)
#define OTHER   ((EGLContext)0x30)

static struct {
    const char *words, *display_words; /* extensions */
    int calls, failing;                /* so far; the one that fails */
    const char *failed;                /* its name */
    bool found;                        /* the display */
    int references, contexts;          /* to be ended */
    EGLContext current;
} egl;

static bool egl_fails(const char *name)
{
    const bool fails = egl.calls++ == egl.failing;
    egl.failed = fails ? name : egl.failed;
    return fails;
}

static const char *query(EGLDisplay display, EGLint name)
{
    assert_int_equal(name, EGL_EXTENSIONS);
    assert_true(display == EGL_NO_DISPLAY || (display == DISPLAY && egl.references == 1));
    if (egl_fails(display ? "query of a display" : "query"))
        return NULL;
    return display ? egl.display_words : egl.words;
}

static EGLDisplay find_display(EGLenum platform, void *native, const EGLAttrib *attributes)
{
    assert_true(platform == EGL_PLATFORM_SURFACELESS_MESA && !native);
    if (strstr(egl.words, "KHR_display_reference"))
        assert_true(attributes[0] == EGL_TRACK_REFERENCES_KHR && attributes[1] == EGL_TRUE && attributes[2] == EGL_NONE);
    else
        assert_null(attributes);
    return egl_fails("display") ? EGL_NO_DISPLAY : DISPLAY;
}

static EGLBoolean initialise(EGLDisplay display, EGLint *major, EGLint *minor)
{
    assert_true(display == DISPLAY && !major && !minor);
    if (egl_fails("initialise"))
        return EGL_FALSE;
    egl.references++;
    return EGL_TRUE;
}

static EGLBoolean bind(EGLenum api)
{
    assert_int_equal(api, EGL_OPENGL_API);
    return !egl_fails("bind");
}

static EGLContext create(EGLDisplay display, EGLConfig config, EGLContext shared, const EGLint *attributes)
{
    static const EGLint wanted[][2] = {{EGL_CONTEXT_MAJOR_VERSION, 3},
                                       {EGL_CONTEXT_MINOR_VERSION, 3},
                                       {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT}};
    size_t found = 0;
    assert_true(display == DISPLAY && config == EGL_NO_CONFIG_KHR && shared == EGL_NO_CONTEXT);
    for (; attributes[0] != EGL_NONE; attributes += 2) {
        for (size_t i = 0; i < 3; i++)
            found += attributes[0] == wanted[i][0] && attributes[1] == wanted[i][1];
    }
    assert_int_equal(found, 3);
    if (egl_fails("create"))
        return EGL_NO_CONTEXT;
    egl.contexts++;
    return CONTEXT;
}

static EGLBoolean make_current(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context)
{
    assert_true(display == DISPLAY && draw == EGL_NO_SURFACE && read == EGL_NO_SURFACE);
    if (context != EGL_NO_CONTEXT && egl_fails("make current"))
        return EGL_FALSE;
    egl.current = context;
    return EGL_TRUE;
}

static EGLContext current(void)
{
    return egl.current;
}

static EGLBoolean destroy(EGLDisplay display, EGLContext context)
{
    assert_true(display == DISPLAY && context == CONTEXT && egl.contexts == 1 && egl.references == 1 && egl.current != CONTEXT);
    egl.contexts--;
    return EGL_TRUE;
}

static EGLBoolean terminate(EGLDisplay display)
{
    assert_true(display == DISPLAY && egl.contexts == 0 && egl.references == 1);
    egl.references--;
    return EGL_TRUE;
}

static __eglMustCastToProperFunctionPointerType address(const char *name)
{
    return strcmp(name, "glFinish") == 0 ? (__eglMustCastToProperFunctionPointerType)current : NULL;
}

/* Puts these functions where those of the library would be. */
static void be_egl(void)
{
    static const struct {
        const char *name;
        void *function;
    } functions[] = {{"eglQueryString", (void *)query},         {"eglGetPlatformDisplay", (void *)find_display},
                     {"eglInitialize", (void *)initialise},     {"eglBindAPI", (void *)bind},
                     {"eglCreateContext", (void *)create},      {"eglMakeCurrent", (void *)make_current},
                     {"eglGetCurrentContext", (void *)current}, {"eglDestroyContext", (void *)destroy},
                     {"eglTerminate", (void *)terminate},       {"eglGetProcAddress", (void *)address}};
    enum { FUNCTIONS = sizeof functions / sizeof *functions };
    static void *table[FUNCTIONS];
    size_t count = 0;
    for (const char *name = bead_context_egl.names; *name; name += strlen(name) + 1, count++) {
        for (size_t i = 0; i < FUNCTIONS; i++) {
            if (strcmp(name, functions[i].name) == 0)
                table[count] = functions[i].function;
        }
        assert_non_null(table[count]);
    }
    *bead_context_egl.table = table;
}

#define SURFACELESS "EGL_MESA_platform_surfaceless"
#define COUNTED     "EGL_KHR_display_reference"
#define CONTEXTS    "EGL_KHR_no_config_context EGL_KHR_surfaceless_context"

/* Opens and closes a context; returns the reason why not. */
static const char *open_and_close(const char *words, const char *display_words, int failing)
{
    const struct bead_context_type *type = &bead_context_egl;
    struct bead_context *context = calloc(1, type->bytes);
    memset(&egl, 0, sizeof egl);
    egl.words = words, egl.display_words = display_words, egl.failing = failing;
    assert_non_null(context);
    const char *wrong = type->open(context);
    assert_true(wrong || (egl.current == CONTEXT && egl.contexts == 1 && egl.references == 1));
    if (!wrong) { /* it is made current only where it is not */
        const int before = egl.calls;
        assert_true(type->use(context) && egl.calls == before);
        egl.current = OTHER, egl.failing = -1;
        assert_true(type->use(context) && egl.current == CONTEXT);
        for (int k = 0; k < 2; k++) {
            egl.current = OTHER;
            egl.failing = egl.calls + k;
            assert_false(type->use(context));
        }
        assert_true(type->function("glFinish") == (void *)current && !type->function("glStart"));
        egl.current = failing % 2 ? OTHER : CONTEXT;
    }
    const EGLContext was = egl.current;
    type->close(context);
    assert_true(egl.current == (was == OTHER ? OTHER : EGL_NO_CONTEXT));
    free(context);
    return wrong;
}

static void each_call_of_egl_fails_once(void **)
{
    static const char *const counted[] = {SURFACELESS, SURFACELESS " " COUNTED, COUNTED " EGL_EXT_any " SURFACELESS};
    static const char *const reasons[][2] = {{"query", "EGL has no platform without surfaces"},
                                             {"display", "EGL has no display"},
                                             {"initialise", "EGL cannot start its display"},
                                             {"query of a display", "EGL has no contexts without surfaces"},
                                             {"bind", "EGL has no OpenGL"},
                                             {"create", "no OpenGL 3.3 core context"},
                                             {"make current", "no OpenGL 3.3 core context"}};
    enum { REASONS = sizeof reasons / sizeof *reasons };
    be_egl();
    for (size_t w = 0; w < sizeof counted / sizeof *counted; w++) {
        for (int failing = 0; failing <= 2 * REASONS; failing++) {
            const char *wrong = open_and_close(counted[w], CONTEXTS, failing);
            bool told = failing > REASONS && !wrong;
            for (size_t i = 0; wrong && i < REASONS; i++)
                told = told || (strcmp(wrong, reasons[i][1]) == 0 && strcmp(egl.failed, reasons[i][0]) == 0);
            told = told || (wrong && strcmp(wrong, reasons[REASONS - 1][1]) == 0 && strcmp(egl.failed, "bind") == 0);
            if (!told)
                fail_msg("%s, call %d: '%s' fails: '%s'", counted[w], failing, egl.failed, wrong);
            assert_int_equal(egl.contexts, 0); /* a display that does not count its users is never ended */
            assert_int_equal(egl.references, !strstr(counted[w], COUNTED) && strcmp(wrong ? egl.failed : "", "query") != 0 &&
                                                 strcmp(wrong ? egl.failed : "", "display") != 0 &&
                                                 strcmp(wrong ? egl.failed : "", "initialise") != 0);
        }
    }
}

/* Extensions are whole words of their lists. */
static void words_of_egl_are_whole(void **)
{
    static const struct {
        const char *words, *display_words;
        bool good;
    } lists[] = {{SURFACELESS, CONTEXTS, true},
                 {"EGL_EXT_a " SURFACELESS " EGL_EXT_b", "EGL_EXT_c " CONTEXTS " EGL_EXT_d", true},
                 {SURFACELESS "_x X" SURFACELESS " " SURFACELESS, CONTEXTS, true},
                 {SURFACELESS "_x", CONTEXTS, false},
                 {"X" SURFACELESS, CONTEXTS, false},
                 {"", CONTEXTS, false},
                 {SURFACELESS, "EGL_KHR_no_config_context", false},
                 {SURFACELESS, "EGL_KHR_surfaceless_context", false},
                 {SURFACELESS, "EGL_KHR_surfaceless_context_x EGL_KHR_no_config_context", false}};
    be_egl();
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        const char *wrong = open_and_close(lists[i].words, lists[i].display_words, -1);
        if (!wrong != lists[i].good)
            fail_msg("'%s' and '%s': %s", lists[i].words, lists[i].display_words, wrong);
    }
}

/* ---- OpenGL that fails ---- */

static struct {
    int names, missing;  /* functions asked for; the one that there is not */
    int checks, failing; /* calls that tell of errors; the one that does */
    GLenum error;
    const char *failed;
} gl;
static GLenum (*next_error)(void);
static GLenum (*next_status)(GLenum target);
static void (*next_shader)(GLuint shader, GLenum name, GLint *value);
static void (*next_program)(GLuint program, GLenum name, GLint *value);

static bool gl_fails(const char *name)
{
    const bool fails = gl.checks++ == gl.failing;
    gl.failed = fails ? name : gl.failed;
    return fails;
}

static GLenum error(void)
{
    const GLenum found = next_error();
    return gl_fails("error") ? gl.error : found;
}

static GLenum status(GLenum target)
{
    return gl_fails("status") ? GL_FRAMEBUFFER_UNSUPPORTED : next_status(target);
}

static void shader_value(GLuint shader, GLenum name, GLint *value)
{
    next_shader(shader, name, value);
    *value = gl_fails("shader") ? GL_FALSE : *value;
}

static void program_value(GLuint program, GLenum name, GLint *value)
{
    next_program(program, name, value);
    *value = gl_fails("program") ? GL_FALSE : *value;
}

static void *function_of(const char *name)
{
    static const struct {
        const char *name;
        void *function, **next;
    } own[] = {{"glGetError", (void *)error, (void **)&next_error},
               {"glCheckFramebufferStatus", (void *)status, (void **)&next_status},
               {"glGetShaderiv", (void *)shader_value, (void **)&next_shader},
               {"glGetProgramiv", (void *)program_value, (void **)&next_program}};
    void *found = bead_context_osmesa.function(name);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        if (strcmp(name, own[i].name) == 0) {
            *own[i].next = found;
            found = own[i].function;
        }
    }
    const bool missing = gl.names++ == gl.missing;
    gl.failed = missing ? name : gl.failed;
    return missing ? NULL : found;
}

enum bead_error __real_bead_gl_load(const struct bead_context_type *type, void **table, struct bead_message *msg);
enum bead_error __wrap_bead_gl_load(const struct bead_context_type *type, void **table, struct bead_message *msg);

enum bead_error __wrap_bead_gl_load(const struct bead_context_type *type, void **table, struct bead_message *msg)
{
    struct bead_context_type own = *type;
    own.function = function_of;
    return __real_bead_gl_load(&own, table, msg);
}

enum { WIDTH = 64, HEIGHT = 48 };
static const struct bead_rect whole = {0, 0, WIDTH, HEIGHT};

static enum bead_error paint(struct bead_canvas *canvas, struct bead_frame *frame, struct bead_backdrop *backdrop,
                             struct bead_message *msg)
{
    static const struct bead_ball balls[] = {{20, 20, 5, 0, 60, {200, 120, 40, 255}}, {30, 20, 900, -1000, 1000, {9, 9, 9, 255}}};
    static const struct bead_mark marks[] = {{{10, 10, 40, 30}, {5, 1, 3, 4}, BEAD_MARK_BOX, {1, 2, 3, 255}},
                                             {{10, 10, 40, 30}, {5, 1, 3, 4}, BEAD_MARK_GLOW, {1, 2, 3, 255}}};
    BEAD_TRY(bead_paint_begin(canvas, backdrop, frame, whole, msg));
    bead_paint_balls(canvas, balls, 2);
    bead_paint_marks(canvas, marks, 2);
    return bead_paint_end(canvas, msg);
}

/* Beads and marks before a backdrop, twice: the second time nothing has to be made. */
static enum bead_error paint_all(struct bead_message *msg)
{
    struct bead_canvas *canvas;
    struct bead_frame frame;
    struct bead_backdrop *backdrop = NULL;
    BEAD_TRY(bead_canvas_create("osmesa", WIDTH, HEIGHT, &canvas, msg));
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    enum bead_error err = bead_backdrop_create(canvas, &frame, whole, &backdrop, msg);
    for (int i = 0; i < 2 && !err; i++)
        err = paint(canvas, &frame, backdrop, msg);
    bead_backdrop_destroy(canvas, backdrop);
    bead_canvas_destroy(canvas);
    bead_frame_free(&frame);
    return err;
}

static void each_error_of_opengl_is_told(void **)
{
    static const struct {
        const char *call;
        GLenum error;
        enum bead_error err;
        const char *says;
    } told[] = {{"error", GL_OUT_OF_MEMORY, BEAD_ERROR_MEMORY, "OpenGL error 0x505 while "},
                {"error", GL_INVALID_OPERATION, BEAD_ERROR_GRAPHICS, "OpenGL error 0x502 while "},
                {"status", GL_INVALID_OPERATION, BEAD_ERROR_GRAPHICS, "(status 0x8cdd)"},
                {"shader", GL_INVALID_OPERATION, BEAD_ERROR_GRAPHICS, " does not compile: "},
                {"program", GL_INVALID_OPERATION, BEAD_ERROR_GRAPHICS, " does not link: "}};
    struct bead_message msg = {""};
    gl.missing = gl.failing = -1;
    if (paint_all(&msg))
        skip_without("OSMesa (libosmesa6)");
    for (int failing = 0;; failing++) {
        memset(&gl, 0, sizeof gl);
        gl.missing = -1, gl.failing = failing, gl.error = failing % 2 ? GL_INVALID_OPERATION : GL_OUT_OF_MEMORY;
        const enum bead_error err = paint_all(&msg);
        if (!gl.failed) {
            assert_true(failing > 20 && err == BEAD_OK);
            break;
        }
        bool found = false;
        for (size_t i = 0; i < sizeof told / sizeof *told; i++)
            found = found || (strcmp(gl.failed, told[i].call) == 0 && err == told[i].err && strstr(msg.text, told[i].says) &&
                              (i > 1 || gl.error == told[i].error));
        if (!found)
            fail_msg("call %d, %s: error %d, '%s'", failing, gl.failed, (int)err, msg.text);
    }
}

static void each_function_of_opengl_is_needed(void **)
{
    struct bead_message msg = {""};
    gl.missing = gl.failing = -1;
    if (paint_all(&msg))
        skip_without("OSMesa (libosmesa6)");
    for (int missing = 0;; missing++) {
        memset(&gl, 0, sizeof gl);
        gl.missing = missing, gl.failing = -1;
        const enum bead_error err = paint_all(&msg);
        if (!gl.failed) {
            assert_true(missing > 40 && err == BEAD_OK);
            break;
        }
        assert_int_equal(err, BEAD_ERROR_GRAPHICS);
        assert_true(strstr(msg.text, "OpenGL lacks the function ") && strstr(msg.text, gl.failed));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_error_of_opengl_is_told),
        cmocka_unit_test(each_function_of_opengl_is_needed),
        cmocka_unit_test(each_call_of_egl_fails_once),
        cmocka_unit_test(words_of_egl_are_whole),
    };
    return cmocka_run_group_tests_name("OpenGL that fails", tests, NULL, NULL);
}
