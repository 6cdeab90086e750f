/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL functions by name, shaders from the assets, framebuffers: for paint_gl.c. */
#include "render/paint/gl.h"

#include <stdio.h>
#include <stdlib.h>

#include "sim/base/assets.h"

_Thread_local void *bead_gl;

enum bead_error bead_gl_open(const struct bead_context_type *type, struct bead_context **context, struct bead_message *msg)
{
    BEAD_TRY(bead_library_load(type->libraries, type->names, type->table, msg));
    *context = calloc(1, type->bytes);
    if (!*context)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a graphics context");
    const char *wrong = type->open(*context);
    return wrong ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s: %s: is Mesa's software renderer installed?", type->libraries->files[0],
                             wrong)
                 : BEAD_OK;
}

enum bead_error bead_gl_load(const struct bead_context_type *type, void **table, struct bead_message *msg)
{
    size_t count = 0;
    for (const char *name = BEAD_LATE; *name; name += strlen(name) + 1)
        count++;
    void **at = *table = calloc(count, sizeof *at);
    if (!at)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for OpenGL");
    for (const char *name = BEAD_LATE; *name; name += strlen(name) + 1) {
        *at = type->function(name);
        if (!*at++)
            return bead_fail(msg, BEAD_ERROR_GRAPHICS, "OpenGL lacks the function %s", name);
    }
    return BEAD_OK;
}

/* `defines` follow the first line, which has the version. */
static enum bead_error compile(const char *asset, GLenum kind, const char *defines, GLuint *shader, struct bead_message *msg)
{
    char *text = NULL;
    size_t length = 0;
    *shader = 0;
    BEAD_TRY(bead_asset_read(asset, &text, &length, msg));
    *shader = glCreateShader(kind);
    const GLint first = (GLint)strcspn(text, "\n") + (strchr(text, '\n') != NULL);
    const GLchar *const source[3] = {text, defines ? defines : "", text + first};
    const GLint lengths[3] = {first, -1, -1};
    glShaderSource(*shader, 3, source, lengths);
    glCompileShader(*shader);
    free(text);
    GLint good = 0;
    glGetShaderiv(*shader, GL_COMPILE_STATUS, &good);
    if (good)
        return BEAD_OK;
    char log[512] = "";
    glGetShaderInfoLog(*shader, sizeof log, NULL, log);
    glDeleteShader(*shader);
    *shader = 0;
    return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s does not compile: %s", asset, log);
}

enum bead_error bead_gl_program(const char *vertex, const char *fragment, const char *defines, GLuint *program,
                                struct bead_message *msg)
{
    static const struct {
        const char *extension;
        GLenum kind;
    } stages[2] = {{"vert", GL_VERTEX_SHADER}, {"frag", GL_FRAGMENT_SHADER}};
    const char *const names[2] = {vertex, fragment};
    GLint good = 0;
    enum bead_error err = BEAD_OK;
    *program = glCreateProgram();
    for (int i = 0; !err && i < 2; i++) {
        char asset[64];
        GLuint shader;
        snprintf(asset, sizeof asset, "shaders/%s.%s", names[i], stages[i].extension);
        err = compile(asset, stages[i].kind, defines, &shader, msg);
        if (!err) {
            glAttachShader(*program, shader);
            glDeleteShader(shader); /* it lives as long as the program */
        }
    }
    if (!err) {
        glLinkProgram(*program);
        glGetProgramiv(*program, GL_LINK_STATUS, &good);
    }
    if (!err && !good) {
        char log[512] = "";
        glGetProgramInfoLog(*program, sizeof log, NULL, log);
        err = bead_fail(msg, BEAD_ERROR_GRAPHICS, "shaders/%s does not link: %s", fragment, log);
    }
    if (err) {
        glDeleteProgram(*program);
        *program = 0;
    }
    return err;
}

enum bead_error bead_gl_target(int width, int height, const void *pixels, size_t stride, GLuint *texture, GLuint *framebuffer,
                               struct bead_message *msg)
{
    glGenTextures(1, texture);
    glBindTexture(GL_TEXTURE_2D, *texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, (GLint)(stride / 4));
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glGenFramebuffers(1, framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, *framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *texture, 0);
    GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "OpenGL has no framebuffer of %d x %d pixels (status 0x%x)", width, height,
                         status);
    return bead_gl_check("making a framebuffer", msg);
}

enum bead_error bead_gl_check(const char *doing, struct bead_message *msg)
{
    GLenum error = glGetError();
    if (error == GL_NO_ERROR)
        return BEAD_OK;
    return bead_fail(msg, error == GL_OUT_OF_MEMORY ? BEAD_ERROR_MEMORY : BEAD_ERROR_GRAPHICS, "OpenGL error 0x%x while %s", error,
                     doing);
}
