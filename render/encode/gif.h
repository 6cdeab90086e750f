/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GIF files, made of a lossless movie that has grown meanwhile. */
#ifndef BEADREEL_RENDER_ENCODE_GIF_H
#define BEADREEL_RENDER_ENCODE_GIF_H

#include "render/encode/libav.h"

/* From the descriptor of an APNG file into that of an empty file; `frames` of them in all, of `frame_time` s. Returns 0 or libav's
 * negative number. */
int bead_gif_make(const struct bead_av *av, int from, int to, AVRational frame_time, int64_t frames);

#endif
