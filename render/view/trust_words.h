/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One line of text about the horizon of a picture. */
#ifndef BEADREEL_RENDER_VIEW_TRUST_WORDS_H
#define BEADREEL_RENDER_VIEW_TRUST_WORDS_H

#include <cairo.h>
#include <stdbool.h>

#include "beadreel/look.h"
#include "beadreel/sink.h"

/* What the line says. */
struct bead_trust {
    double from;          /* s: where the picture begins */
    double until;         /* s: the horizon; INFINITY: none */
    const char *chain;    /* whose horizon it is, where there are several; "" */
    bool bold;            /* the verdict in bold type */
    bool steps;           /* the runs differ by their steps, not their accuracy */
    double first, second; /* s, or relative */
    const char *unit;     /* of times */
};

/* The two runs of a scene. */
struct bead_trust bead_trust_make(const struct bead_chain *chain, double tolerance_factor);
/* Draws as much of it as fits into `rect`, aligned left or right. */
void bead_trust_draw(cairo_t *cr, const struct bead_look *look, const struct bead_trust *trust, struct bead_rect rect, bool right);
/* Its markup: from all of it (0) to the verdict alone (3). */
void bead_trust_say(const struct bead_trust *trust, int shorter, char *markup, size_t size);

#endif
