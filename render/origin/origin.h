/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of pictures, films and pages say about how they were made: "beadreel 0.1.0, scene:", and the scene from the next
 * line on. One table (origin.c) says for each format who writes this, and how it is found again. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "beadreel/api.h"
#include "beadreel/error.h"

#define BEAD_ORIGIN_HEAD "beadreel " BEADREEL_VERSION ", scene:\n"

/* The whole text, to be freed: the words that describe what is seen (NULL or "": none), then the origin. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_origin_text(const char *description, const char *scene, char **text, struct bead_message *msg);

/* Does a file of this name get its text by bead_origin_put, and not from the library that writes it? */
bool bead_origin_is_put(const char *path);
/* Puts the text into a finished file, whose format the ending of `path` tells. Errors: IO, MEMORY. */
BEAD_CHECK enum bead_error bead_origin_put(const char *path, int descriptor, const char *text, struct bead_message *msg);

/* Writes the text of an EPS file, which is ASCII with lines of at most 255 characters, as comments. */
void bead_origin_write_eps(const char *scene, FILE *file);
/* Writes the text for HTML and XML: with names for their own characters. */
void bead_origin_escape(const char *text, FILE *file);

/* The scene of a file, which may be a stranger's, to be freed; NULL: it has none, or is of no format that can have one. `version`:
 * of the program that wrote it, "" where the file does not say. It is sought in the sandbox. Errors: as of bead_sandbox_ask. */
BEAD_CHECK enum bead_error bead_origin_read(const char *path, char **scene, char *version, size_t size, struct bead_message *msg);

/* As above, from the bytes of a file. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_origin_find(const char *path, const void *bytes, size_t length, char **scene, char *version,
                                            size_t size, struct bead_message *msg);
/* The endings of row `index` of the table: ".jpg, .jpeg"; NULL after the last. */
const char *bead_origin_endings(size_t index);
