/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chapters of movies, in containers that have them. */
#ifndef BEADREEL_RENDER_ENCODE_CHAPTERS_H
#define BEADREEL_RENDER_ENCODE_CHAPTERS_H

#include "render/encode/libav.h"
#include "render/encode/movie_private.h"

/* Those of the settings, into a format whose header is not written yet: they last until the next begins, the last one until
 * settings->length. Returns libav's number of an error. */
int bead_chapters_add(const struct bead_av *av, AVFormatContext *format, const struct bead_movie_settings *settings);

#endif
