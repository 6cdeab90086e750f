/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text in files of pictures, films and pages about how they were made: "beadreel 0.1.0, scene:", and the scene from the next
 * line on. One table (origin.c) has for each format who writes this, and how to find it again. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "beadreel/api.h"
#include "beadreel/error.h"

#define BEAD_ORIGIN_HEAD "beadreel " BEADREEL_VERSION ", scene:\n"

/* The whole text, to be freed: words that describe the picture (NULL or "": none), then the origin. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_origin_text(const char *description, const char *scene, char **text, struct bead_message *msg);

/* Does a file with this name get its text from bead_origin_put, and not from the library that writes it? */
bool bead_origin_is_put(const char *path);
/* Puts the text into a finished file, whose format follows from the ending of `path`. Errors: IO, MEMORY. */
BEAD_CHECK enum bead_error bead_origin_put(const char *path, int descriptor, const char *text, struct bead_message *msg);

/* Writes the text of an EPS file, which is ASCII with lines of at most 255 characters, as comments. */
void bead_origin_write_eps(const char *scene, FILE *file);
/* Writes the text for HTML and XML: with names for their own characters. */
void bead_origin_escape(const char *text, FILE *file);

/* The scene of a file, which may be a stranger's, to be freed; NULL: it has none, or its format cannot have one. `version`: of the
 * program that wrote it, "" if the file does not say. The search runs in the sandbox. Errors: as of bead_sandbox_ask. */
BEAD_CHECK enum bead_error bead_origin_read(const char *path, char **scene, char *version, size_t size, struct bead_message *msg);

/* As above, from the bytes of a file. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_origin_find(const char *path, const void *bytes, size_t length, char **scene, char *version,
                                            size_t size, struct bead_message *msg);
/* The endings of row `index` of the table: ".jpg, .jpeg"; NULL after the last. */
const char *bead_origin_endings(size_t index);
