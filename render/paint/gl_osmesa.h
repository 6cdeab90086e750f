/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of GL/osmesa.h in use, for builds without this header, which no longer changes. */
#pragma once

#include <GL/glcorearb.h>

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

OSMesaContext OSMesaCreateContextAttribs(const int *attributes, OSMesaContext shared);
void OSMesaDestroyContext(OSMesaContext context);
GLboolean OSMesaMakeCurrent(OSMesaContext context, void *pixels, GLenum type, GLsizei width, GLsizei height);
OSMesaContext OSMesaGetCurrentContext(void);
OSMESAproc OSMesaGetProcAddress(const char *name);
