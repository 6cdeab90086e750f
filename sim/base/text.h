/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text that may come from strangers, made fit for a terminal. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Any text for a message: one line, shortened; returns `shown`. */
const char *bead_text_show(const char *text, char *shown, size_t size);
/* Bytes of the character at `c` if a terminal would obey it rather than show it: a control character (C0, DEL, C1), or one that
 * turns the direction of the text or ends the line (U+061C, U+200E to U+200F, U+2028 to U+202E, U+2066 to U+2069). 0: it may be
 * shown. */
size_t bead_text_obeyed(const char *c);
/* Does UTF-8 text end with a different direction than it began with, so that the text after it is also turned? That is, does it
 * have an embedding, an override or an isolate that it does not close (Unicode Standard Annex 9)? */
bool bead_text_turns(const char *text);
