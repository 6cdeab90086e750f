/* SPDX-License-Identifier: GPL-3.0-or-later */
/* "Did you mean": the nearest of some names. */
#ifndef BEADREEL_SIM_BASE_SUGGEST_H
#define BEADREEL_SIM_BASE_SUGGEST_H

#include <stddef.h>

/* A search for the name nearest to a word. */
struct bead_suggest {
    const char *word, *best; /* best: borrowed, NULL while none is near */
    size_t distance;
};

void bead_suggest_begin(struct bead_suggest *search, const char *word);
void bead_suggest_try(struct bead_suggest *search, const char *name);
/* "; did you mean `striker`?" or "" into `text`; returns text. */
const char *bead_suggest_text(const struct bead_suggest *search, char *text, size_t size);

#endif
