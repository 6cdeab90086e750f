/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names: membership in a list, the nearest one ("did you mean"), and lists of them in messages. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Is the name one of `names`, which end with NULL? */
static inline bool bead_is_one_of(const char *name, const char *const *names)
{
    while (*names && strcmp(name, *names) != 0)
        names++;
    return *names;
}

/* A search for the name nearest to a word. */
struct bead_suggest {
    const char *word, *best; /* best: borrowed, NULL while none is near */
    size_t distance;
};

void bead_suggest_begin(struct bead_suggest *search, const char *word);
void bead_suggest_try(struct bead_suggest *search, const char *name);
/* "; did you mean `striker`?" or "" into `text`; returns text. */
const char *bead_suggest_text(const struct bead_suggest *search, char *text, size_t size);

/* Append a name to a list, after `between` (", " or " or ") unless it is the first; a name that does not fit is left out. */
static inline void bead_list_add(char *list, size_t size, const char *between, const char *name)
{
    const size_t used = strlen(list), gap = used ? strlen(between) : 0, length = strlen(name);
    if (used + gap + length >= size)
        return;
    memcpy(list + used, between, gap);
    memcpy(list + used + gap, name, length + 1);
}
