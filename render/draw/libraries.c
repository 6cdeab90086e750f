/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One table for packagers: what is opened at run time and what for (beadreel --list libraries). Canvases and encoders open their
 * libraries by these rows. */
#include "render/draw/libraries.h"

#include <libavcodec/version.h>
#include <libavformat/version.h>
#include <libavutil/version.h>

#define TEXT(x)                TEXT_OF(x)
#define TEXT_OF(x)             #x
#define FILE_OF(name, version) "lib" name ".so." TEXT(version)

/* libav's structures change with the major versions: only those that this program was built with will do. */
static const struct bead_library_info libraries[BEAD_LIBRARIES] = {
    [BEAD_LIBRARY_OSMESA] = {{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "paints beads; without it EGL does"},
    [BEAD_LIBRARY_EGL] = {{"libEGL.so.1", "libEGL.so"},
                          "paints beads with Mesa's software renderer; without it the program itself does"},
    [BEAD_LIBRARY_AVUTIL] = {{FILE_OF("avutil", LIBAVUTIL_VERSION_MAJOR)}, "movies; without it there are none"},
    [BEAD_LIBRARY_AVCODEC] = {{FILE_OF("avcodec", LIBAVCODEC_VERSION_MAJOR)},
                              "encodes movies, with libx264 and libvpx; without it there are none"},
    [BEAD_LIBRARY_AVFORMAT] = {{FILE_OF("avformat", LIBAVFORMAT_VERSION_MAJOR)}, "writes movies; without it there are none"},
};

const struct bead_library_info *bead_library_info(size_t index)
{
    return index < BEAD_LIBRARIES ? &libraries[index] : NULL;
}
