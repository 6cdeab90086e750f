/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finishes SVG files: puts title, description and words into them, and renumbers the names that cairo gives, so that the same
 * picture always has the same bytes. vector.c calls it. */
#include "render/draw/svg_ids.h"

#include <ctype.h>
#include <string.h>

enum { MOST_NAMES = 1024 };

struct names {
    unsigned long long number[MOST_NAMES];
    size_t count;
};

static const char *const kinds[] = {"surface", "image", "source-"}; /* the last by cairo 1.18 */

/* Length of a kind's name at `at` if a digit follows and it is a name: id="surface604", "#surface604", url(#image607). */
static size_t name_length(const char *begin, const char *at, const char *end)
{
    if (at - begin < 2 || !(at[-1] == '#' || (at[-1] == '"' && at[-2] == '=')))
        return 0;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        size_t length = strlen(kinds[k]);
        if ((size_t)(end - at) > length && memcmp(at, kinds[k], length) == 0 && isdigit((unsigned char)at[length]))
            return length;
    }
    return 0;
}

/* From 1, in order of first appearance; 0: too many. */
static size_t new_number(struct names *names, unsigned long long number)
{
    size_t i = 0;
    while (i < names->count && names->number[i] != number)
        i++;
    if (i == MOST_NAMES)
        return 0;
    if (i == names->count)
        names->number[names->count++] = number;
    return i + 1;
}

static void put_escaped(FILE *file, const char *text)
{
    for (; *text; text++) {
        const char *escaped = *text == '&' ? "&amp;" : *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : NULL;
        if (escaped)
            fputs(escaped, file);
        else
            fputc(*text, file);
    }
}

static void put_element(FILE *file, const char *name, const char *text)
{
    if (!text || !*text)
        return;
    fprintf(file, "<%s>", name);
    put_escaped(file, text);
    fprintf(file, "</%s>\n", name);
}

/* Behind the root's tag: what readers of a screen are told. Returns where the drawing goes on. */
static const char *put_head(const struct bead_svg_parts *svg, FILE *file)
{
    const char *root = memmem(svg->text, svg->length, "<svg ", 5), *end = svg->text + svg->length;
    const char *body = root ? memchr(root, '>', (size_t)(end - root)) : NULL;
    if (!body)
        return svg->text;
    fwrite(svg->text, 1, (size_t)(body - svg->text), file);
    fputs(" role=\"img\">\n", file);
    put_element(file, "title", svg->title);
    put_element(file, "desc", svg->description);
    return body + 1 + (body[1] == '\n');
}

/* Copies the drawing from `from` to `end`, with its names counted anew. */
static enum bead_error put_body(const char *from, const char *end, FILE *file, struct bead_message *msg)
{
    struct names names = {.count = 0};
    const char *begin = from;
    for (const char *at = from; at < end; at++) {
        size_t kind = *at == 's' || *at == 'i' ? name_length(begin, at, end) : 0;
        if (kind == 0)
            continue;
        unsigned long long number = 0;
        fwrite(from, 1, (size_t)(at + kind - from), file);
        for (from = at + kind; from < end && isdigit((unsigned char)*from); from++)
            number = 10 * number + (unsigned long long)(*from - '0');
        size_t now = new_number(&names, number);
        if (now == 0)
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "an SVG file has at most %d images", MOST_NAMES);
        fprintf(file, "%zu", now);
        at = from - 1;
    }
    fwrite(from, 1, (size_t)(end - from), file);
    return BEAD_OK;
}

enum bead_error bead_svg_write(const struct bead_svg_parts *svg, FILE *file, struct bead_message *msg)
{
    static const char tail[] = "</svg>";
    const char *end = svg->text + svg->length, *last = end;
    while (last > svg->text && strncmp(last, tail, sizeof tail - 1) != 0)
        last--;
    last = last > svg->text ? last : end;
    enum bead_error err = put_body(put_head(svg, file), last, file, msg);
    fwrite(svg->words, 1, svg->words_length, file);
    fwrite(last, 1, (size_t)(end - last), file);
    return err;
}
