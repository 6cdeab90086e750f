/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON as text: see json.h. */
#include "sim/base/json.h"

#include <math.h>

#include "sim/base/number.h"

/* Bytes of the UTF-8 character at `c`; 0: invalid, as are overlong forms, surrogates and numbers beyond U+10FFFF. */
static size_t character(const unsigned char *c)
{
    static const struct {
        unsigned char first[2], second[2];
        size_t bytes;
    } forms[] = {{{0x20, 0x7F}, {0, 0}, 1},       {{0xC2, 0xDF}, {0x80, 0xBF}, 2}, {{0xE0, 0xE0}, {0xA0, 0xBF}, 3},
                 {{0xE1, 0xEC}, {0x80, 0xBF}, 3}, {{0xED, 0xED}, {0x80, 0x9F}, 3}, {{0xEE, 0xEF}, {0x80, 0xBF}, 3},
                 {{0xF0, 0xF0}, {0x90, 0xBF}, 4}, {{0xF1, 0xF3}, {0x80, 0xBF}, 4}, {{0xF4, 0xF4}, {0x80, 0x8F}, 4}};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        size_t n = forms[i].bytes, good = 1;
        if (c[0] < forms[i].first[0] || c[0] > forms[i].first[1])
            continue;
        if (n > 1)
            good += c[1] >= forms[i].second[0] && c[1] <= forms[i].second[1];
        while (good > 1 && good < n && (c[good] & 0xC0) == 0x80)
            good++;
        return good == n ? n : 0;
    }
    return 0;
}

static void quote(const struct bead_json *json, const char *text)
{
    FILE *out = json->out;
    fputc('"', out);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t bytes = character(c);
        if (*c < ' ' || *c == '"' || *c == '\\' || *c == 0x7F || (json->html && strchr("<>&", *c)))
            fprintf(out, "\\u%04x", *c);
        else if (bytes == 0)
            fputs("\\ufffd", out);
        else
            fwrite(c, 1, bytes, out);
        c += bytes ? bytes : 1;
    }
    fputc('"', out);
}

static void new_line(const struct bead_json *json)
{
    if (json->lines)
        fprintf(json->out, "\n%*s", json->depth, "");
}

FILE *bead_json_key(struct bead_json *json, const char *key)
{
    if (json->more)
        fputs(json->lines ? "," : ", ", json->out);
    if (json->depth > 0)
        new_line(json);
    json->more = true;
    if (key) {
        quote(json, key);
        fputs(": ", json->out);
    }
    return json->out;
}

void bead_json_open(struct bead_json *json, const char *key, char bracket)
{
    bead_json_key(json, key);
    fputc(bracket, json->out);
    json->more = false;
    json->depth++;
}

void bead_json_close(struct bead_json *json, const char *brackets)
{
    for (; *brackets; brackets++) {
        json->depth--;
        if (json->more)
            new_line(json);
        fputc(*brackets, json->out);
        json->more = true;
    }
}

void bead_json_text(struct bead_json *json, const char *key, const char *text)
{
    if (!text) {
        bead_json_null(json, key);
        return;
    }
    bead_json_key(json, key);
    quote(json, text);
}

void bead_json_texts(struct bead_json *json, const char *key, const char *const *texts)
{
    bead_json_open(json, key, '[');
    for (; *texts; texts++)
        bead_json_text(json, NULL, *texts);
    bead_json_close(json, "]");
}

void bead_json_number(struct bead_json *json, const char *key, double value)
{
    if (!isfinite(value)) {
        bead_json_null(json, key);
        return;
    }
    bead_json_key(json, key);
    if (json->digits)
        fprintf(json->out, "%.*g", json->digits, value);
    else
        bead_write_number(json->out, value);
}

void bead_json_numbers(struct bead_json *json, const char *key, const double *values, size_t count)
{
    bead_json_open(json, key, '[');
    for (size_t i = 0; i < count; i++)
        bead_json_number(json, NULL, values[i]);
    bead_json_close(json, "]");
}

void bead_json_flag(struct bead_json *json, const char *key, bool value)
{
    bead_json_key(json, key);
    fputs(value ? "true" : "false", json->out);
}

void bead_json_null(struct bead_json *json, const char *key)
{
    bead_json_key(json, key);
    fputs("null", json->out);
}
