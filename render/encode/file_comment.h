/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comments in files whose muxers in libavformat write none: GIF and APNG. */
#ifndef BEADREEL_RENDER_ENCODE_FILE_COMMENT_H
#define BEADREEL_RENDER_ENCODE_FILE_COMMENT_H

#include "beadreel/error.h"

/* Puts the text (UTF-8) before the end of a finished file. Errors: IO (also where the file does not end as such files do). */
BEAD_CHECK enum bead_error bead_comment_gif(int descriptor, const char *text, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_comment_png(int descriptor, const char *text, struct bead_message *msg);

#endif
