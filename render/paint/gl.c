/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL functions by name, shaders from the assets, framebuffers. paint_gl.c draws with them. */
#include "render/paint/gl.h"

#include <stdio.h>
#include <stdlib.h>

#include "beadreel/assets.h"

enum bead_error bead_gl_load(struct bead_gl *gl, const struct bead_context_type *type, struct bead_context *context,
                             struct bead_message *msg)
{
    const char *missing = NULL;
#define BEAD_GL_LOAD(pointer, name)                          \
    gl->name = (pointer)type->function(context, "gl" #name); \
    if (!gl->name)                                           \
        missing = "gl" #name;
    BEAD_GL_FUNCTIONS(BEAD_GL_LOAD)
#undef BEAD_GL_LOAD
    return missing ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "OpenGL lacks the function %s", missing) : BEAD_OK;
}

static enum bead_error compile(const struct bead_gl *gl, const char *asset, GLenum kind, GLuint *shader, struct bead_message *msg)
{
    char *text = NULL;
    size_t length = 0;
    *shader = 0;
    enum bead_error err = bead_asset_read(asset, &text, &length, msg);
    if (err)
        return err;
    *shader = gl->CreateShader(kind);
    const GLchar *source = text;
    gl->ShaderSource(*shader, 1, &source, NULL);
    gl->CompileShader(*shader);
    free(text);
    GLint good = 0;
    gl->GetShaderiv(*shader, GL_COMPILE_STATUS, &good);
    if (good)
        return BEAD_OK;
    char log[512] = "";
    gl->GetShaderInfoLog(*shader, sizeof log, NULL, log);
    gl->DeleteShader(*shader);
    *shader = 0;
    return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s does not compile: %s", asset, log);
}

enum bead_error bead_gl_program(const struct bead_gl *gl, const char *vertex, const char *fragment, GLuint *program,
                                struct bead_message *msg)
{
    static const struct {
        const char *extension;
        GLenum kind;
    } stages[2] = {{"vert", GL_VERTEX_SHADER}, {"frag", GL_FRAGMENT_SHADER}};
    const char *const names[2] = {vertex, fragment};
    GLint good = 0;
    enum bead_error err = BEAD_OK;
    *program = gl->CreateProgram();
    for (int i = 0; !err && i < 2; i++) {
        char asset[64];
        GLuint shader;
        snprintf(asset, sizeof asset, "shaders/%s.%s", names[i], stages[i].extension);
        err = compile(gl, asset, stages[i].kind, &shader, msg);
        if (!err) {
            gl->AttachShader(*program, shader);
            gl->DeleteShader(shader); /* lives on as long as the program */
        }
    }
    if (!err) {
        gl->LinkProgram(*program);
        gl->GetProgramiv(*program, GL_LINK_STATUS, &good);
    }
    if (!err && !good) {
        char log[512] = "";
        gl->GetProgramInfoLog(*program, sizeof log, NULL, log);
        err = bead_fail(msg, BEAD_ERROR_GRAPHICS, "shaders/%s does not link: %s", fragment, log);
    }
    if (err) {
        gl->DeleteProgram(*program);
        *program = 0;
    }
    return err;
}

enum bead_error bead_gl_target(const struct bead_gl *gl, int width, int height, const void *pixels, size_t stride, GLuint *texture,
                               GLuint *framebuffer, struct bead_message *msg)
{
    gl->GenTextures(1, texture);
    gl->BindTexture(GL_TEXTURE_2D, *texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, (GLint)(stride / 4));
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl->GenFramebuffers(1, framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, *framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *texture, 0);
    GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "OpenGL gives no framebuffer of %d x %d pixels (status 0x%x)", width, height,
                         status);
    return bead_gl_check(gl, "making a framebuffer", msg);
}

enum bead_error bead_gl_check(const struct bead_gl *gl, const char *doing, struct bead_message *msg)
{
    GLenum error = gl->GetError();
    if (error == GL_NO_ERROR)
        return BEAD_OK;
    return bead_fail(msg, error == GL_OUT_OF_MEMORY ? BEAD_ERROR_MEMORY : BEAD_ERROR_GRAPHICS, "OpenGL error 0x%x while %s", error,
                     doing);
}
