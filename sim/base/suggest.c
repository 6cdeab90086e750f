/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the name nearest to a mistyped word, for messages. */
#include "sim/base/suggest.h"

#include <ctype.h>
#include <stdio.h>

enum { LONGEST = 48 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Damerau-Levenshtein distance (adjacent swaps count once), case ignored. */
static size_t distance(const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b), d[LONGEST + 1][LONGEST + 1];
    if (n > LONGEST || m > LONGEST)
        return LONGEST;
    for (size_t i = 0; i <= n; i++) {
        for (size_t j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            int p = tolower((unsigned char)a[i - 1]), q = tolower((unsigned char)b[j - 1]);
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (p != q));
            if (i > 1 && j > 1 && p == tolower((unsigned char)b[j - 2]) && q == tolower((unsigned char)a[i - 2]))
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[n][m];
}

void bead_suggest_begin(struct bead_suggest *search, const char *word)
{
    /* A third of the letters may be wrong. */
    *search = (struct bead_suggest){word, NULL, strlen(word) / 3 + 2};
}

void bead_suggest_try(struct bead_suggest *search, const char *name)
{
    size_t found = distance(search->word, name);
    if (found < search->distance && found < strlen(name)) {
        search->distance = found;
        search->best = name;
    }
}

const char *bead_suggest_text(const struct bead_suggest *search, char *text, size_t size)
{
    text[0] = 0;
    if (search->best)
        snprintf(text, size, "; did you mean `%s`?", search->best);
    return text;
}
