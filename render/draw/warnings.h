/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings of the libraries that draw: GLib, Pango, cairo.
 *
 * They warn and go on where a font cannot be opened, say, and the picture then has boxes for letters. A picture that was warned of
 * is an error instead:
 *
 *   bead_warnings_watch();   ... draw, in this thread ...   err = bead_warnings_check(msg);
 *
 * GLib has one default handler of messages in a process; it is replaced once, for good, and hands on what is no warning. */
#ifndef BEADREEL_RENDER_DRAW_WARNINGS_H
#define BEADREEL_RENDER_DRAW_WARNINGS_H

#include "beadreel/error.h"

/* From now on warnings in this thread count; those of before are forgotten. */
void bead_warnings_watch(void);
/* Errors: GRAPHICS (with the first warning since). */
BEAD_CHECK enum bead_error bead_warnings_check(struct bead_message *msg);

#endif
