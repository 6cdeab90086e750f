/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings of GLib, Pango and cairo become errors: they would only warn if, say, a font cannot be opened, and draw boxes for
 * letters.
 *
 *   bead_warnings_watch();   ... draw, in this thread ...   err = bead_warnings_check(msg);
 *
 * GLib has one default handler of messages per process; it is replaced once, for good, by one that passes on all but warnings. */
#pragma once

#include "beadreel/error.h"

/* Forgets earlier warnings in this thread and watches for new ones. */
void bead_warnings_watch(void);
/* Errors: GRAPHICS (with the first warning since). */
BEAD_CHECK enum bead_error bead_warnings_check(struct bead_message *msg);
