/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The few OpenGL functions that drawing needs, loaded by name; no GL library is linked for them. */
#ifndef BEADREEL_RENDER_PAINT_GL_H
#define BEADREEL_RENDER_PAINT_GL_H

#include <GL/glcorearb.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "render/paint/gl_context.h"

#define BEAD_GL_FUNCTIONS(X)                                     \
    X(PFNGLATTACHSHADERPROC, AttachShader)                       \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                           \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                         \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
    X(PFNGLBLENDFUNCPROC, BlendFunc)                             \
    X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                 \
    X(PFNGLBUFFERDATAPROC, BufferData)                           \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
    X(PFNGLCLEARPROC, Clear)                                     \
    X(PFNGLCLEARCOLORPROC, ClearColor)                           \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                     \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
    X(PFNGLCREATESHADERPROC, CreateShader)                       \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
    X(PFNGLDELETESHADERPROC, DeleteShader)                       \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
    X(PFNGLDISABLEPROC, Disable)                                 \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)         \
    X(PFNGLENABLEPROC, Enable)                                   \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) \
    X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)       \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                           \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
    X(PFNGLGENTEXTURESPROC, GenTextures)                         \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
    X(PFNGLGETERRORPROC, GetError)                               \
    X(PFNGLGETFLOATVPROC, GetFloatv)                             \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)               \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                         \
    X(PFNGLGETSTRINGPROC, GetString)                             \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
    X(PFNGLREADPIXELSPROC, ReadPixels)                           \
    X(PFNGLSCISSORPROC, Scissor)                                 \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri)                     \
    X(PFNGLUNIFORM1FPROC, Uniform1f)                             \
    X(PFNGLUNIFORM2FPROC, Uniform2f)                             \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                           \
    X(PFNGLVERTEXATTRIBDIVISORPROC, VertexAttribDivisor)         \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)         \
    X(PFNGLVIEWPORTPROC, Viewport)

struct bead_gl {
#define BEAD_GL_MEMBER(type, name) type name;
    BEAD_GL_FUNCTIONS(BEAD_GL_MEMBER)
#undef BEAD_GL_MEMBER
};

/* Fill `gl` from a context. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_gl_load(struct bead_gl *gl, const struct bead_context_type *type, struct bead_context *context,
                                        struct bead_message *msg);
/* Compile and link shaders/`vertex`.vert and shaders/`fragment`.frag of the assets. Errors: IO, MEMORY, GRAPHICS (with the
 * compiler's words). */
BEAD_CHECK enum bead_error bead_gl_program(const struct bead_gl *gl, const char *vertex, const char *fragment, GLuint *program,
                                           struct bead_message *msg);
/* A texture of that size, RGBA8, with an own framebuffer object; `pixels` (B G R X rows, NULL: undefined) of `stride` bytes a row.
 * Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_gl_target(const struct bead_gl *gl, int width, int height, const void *pixels, size_t stride,
                                          GLuint *texture, GLuint *framebuffer, struct bead_message *msg);
/* What went wrong since the last time asked, if anything; `doing` for the message. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_gl_check(const struct bead_gl *gl, const char *doing, struct bead_message *msg);

#endif
