/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One line of text about the horizon of a picture. */
#pragma once

#include <cairo.h>
#include <stdbool.h>

#include "beadreel/sink.h"
#include "render/draw/axis.h"

/* The words of the line. */
struct bead_trust {
    double from;          /* s: beginning of the picture */
    double until;         /* s: the horizon; INFINITY: none */
    const char *chain;    /* name of the horizon's chain if there are several, else "" */
    bool bold;            /* the verdict in bold type */
    bool steps;           /* the runs differ by their steps, not their accuracy */
    double first, second; /* s, or relative */
    const char *unit;     /* of times */
};

/* The two runs of a scene. */
struct bead_trust bead_trust_make(const struct bead_chain *chain, double tolerance_factor);
/* Draws as many words as fit into `rect`, aligned left or right. */
void bead_trust_draw(cairo_t *cr, const struct bead_look *look, const struct bead_trust *trust, struct bead_rect rect, bool right);
/* The markup of the line, from all words (0) to the verdict alone (3). */
void bead_trust_say(const struct bead_trust *trust, int shorter, char *markup, size_t size);
