/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes JSON (RFC 8259) to a stream, a value at a time; commas are automatic. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "sim/base/internal.h"

struct bead_json {
    FILE *out;
    bool more;  /* the next value follows another one */
    bool lines; /* a line for each value, for files that people compare */
    bool html;  /* within <script>: no text has a `<` that could end it */
    int depth;  /* of brackets that are open */
    int digits; /* of numbers; 0: the fewest that read back as the same double */
};

/* `key`: of a value in an object, NULL in lists and at the top. */
BEAD_INTERNAL void bead_json_open(struct bead_json *json, const char *key, char bracket); /* '{' or '[' */
BEAD_INTERNAL void bead_json_close(struct bead_json *json, const char *brackets); /* one or several, from the inside: "}]}" */
BEAD_INTERNAL FILE *bead_json_key(struct bead_json *json,
                                  const char *key); /* the caller writes the value, as JSON, to the stream */
/* NULL: null; bytes that are not UTF-8 become U+FFFD. */
BEAD_INTERNAL void bead_json_text(struct bead_json *json, const char *key, const char *text);
void bead_json_texts(struct bead_json *json, const char *key, const char *const *texts);    /* a list; `texts` ends with NULL */
BEAD_INTERNAL void bead_json_number(struct bead_json *json, const char *key, double value); /* NaN, infinite: null */
BEAD_INTERNAL void bead_json_numbers(struct bead_json *json, const char *key, const double *values, size_t count);
BEAD_INTERNAL void bead_json_flag(struct bead_json *json, const char *key, bool value);
void bead_json_null(struct bead_json *json, const char *key);
