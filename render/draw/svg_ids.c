/* Renumbers the names that cairo gives in SVG files, so that the same picture always has the same bytes. vector.c calls it. */
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

enum bead_error bead_svg_write(const char *text, size_t length, FILE *file, struct bead_message *msg)
{
    struct names names = {.count = 0};
    const char *from = text, *end = text + length;
    for (const char *at = text; at < end; at++) {
        size_t kind = *at == 's' || *at == 'i' ? name_length(text, at, end) : 0;
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
