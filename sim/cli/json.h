/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes JSON (RFC 8259) to a stream, a value at a time; commas come by themselves. */
#pragma once

#include <stdbool.h>
#include <stdio.h>

struct json {
    FILE *out;
    bool more;  /* the next value follows another one */
    bool lines; /* a line for each value, for files that people compare */
    int depth;  /* of brackets that are open */
};

/* `key` is that of a value in an object, NULL in lists and at the top. */
void json_open(struct json *json, const char *key, char bracket);     /* '{' or '[' */
void json_close(struct json *json, const char *brackets);             /* one or several, from the inside: "}]}" */
void json_text(struct json *json, const char *key, const char *text); /* NULL: null; bytes that are no UTF-8 become U+FFFD */
void json_texts(struct json *json, const char *key, const char *const *texts); /* a list; `texts` ends with NULL */
void json_number(struct json *json, const char *key, double value);            /* shortest that reads back; NaN, infinite: null */
void json_flag(struct json *json, const char *key, bool value);
void json_null(struct json *json, const char *key);
