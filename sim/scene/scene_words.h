/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names as people read them. */
#ifndef BEADREEL_SIM_SCENE_SCENE_WORDS_H
#define BEADREEL_SIM_SCENE_SCENE_WORDS_H

#include "sim/scene/options.h"

/* "large steel" of "large-steel"; names that have spaces or capitals stay as they are. To be freed; NULL: out of memory. */
char *bead_words_of(const char *name);
/* Fills in the titles of chains and sweeps. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_scene_find_words(struct bead_reader *reader);

#endif
