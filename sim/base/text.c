/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sim/base/text.h"

#include <string.h>

size_t bead_text_obeyed(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    if (*c < ' ' || *c == 127)
        return 1;
    if ((c[0] == 0xC2 && c[1] >= 0x80 && c[1] <= 0x9F) || (c[0] == 0xD8 && c[1] == 0x9C))
        return 2;
    const bool marks = c[0] == 0xE2 && c[1] == 0x80 && (c[2] == 0x8E || c[2] == 0x8F || (c[2] >= 0xA8 && c[2] <= 0xAE));
    return marks || (c[0] == 0xE2 && c[1] == 0x81 && c[2] >= 0xA6 && c[2] <= 0xA9) ? 3 : 0;
}

bool bead_text_turns(const char *text)
{
    enum { DEEPEST = 125 };     /* of UAX 9; deeper ones count for nothing there */
    bool isolates[DEEPEST + 1]; /* what is open, from the outermost on */
    size_t depth = 0;
    for (; *text && depth <= DEEPEST; text++) {
        const unsigned char *c = (const unsigned char *)text;
        const bool old = c[0] == 0xE2 && c[1] == 0x80 && c[2] >= 0xAA && c[2] <= 0xAE;
        const bool isolating = c[0] == 0xE2 && c[1] == 0x81 && c[2] >= 0xA6 && c[2] <= 0xA9;
        if (isolating && c[2] == 0xA9) { /* closes the innermost isolate, and all within */
            size_t outer = depth;
            while (outer > 0 && !isolates[outer - 1])
                outer--;
            depth = outer > 0 ? outer - 1 : depth;
        } else if (old && c[2] == 0xAC)
            depth -= depth > 0 && !isolates[depth - 1];
        else if (old || isolating)
            isolates[depth++] = isolating;
    }
    return depth > 0;
}

const char *bead_text_show(const char *text, char *shown, size_t size)
{
    size_t used = 0;
    for (size_t obeyed; *text && used + 4 < size; text += obeyed ? obeyed : 1) {
        obeyed = bead_text_obeyed(text);
        shown[used++] = obeyed ? ' ' : *text;
    }
    if (*text) {
        while (used > 0 && ((unsigned char)*text & 0xc0) == 0x80) /* not within a UTF-8 character */
            text--, used--;
        memcpy(shown + used, "...", 3);
        used += 3;
    }
    shown[used] = 0;
    return shown;
}
