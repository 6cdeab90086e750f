/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Validity: where the model, elastic spheres that touch in small circles, ends.
 *
 * A contact must be small beside the radii, a strike slow beside the speed of sound in a bar, and the beads must stay elastic: two
 * spheres begin to yield below the surface when the pressure p0 in the centre of their contact is 1.6 times the yield strength,
 * which changes forces little, and are fully plastic, so that no elastic law holds, when its mean over the contact, 2/3 p0, is 3
 * times that (D. Tabor, The Hardness of Metals, 1951; K. L. Johnson, Contact Mechanics, 1985, chapters 4, 6 and 11). */
#pragma once

#include "beadreel/chain.h"
#include "beadreel/sink.h"

/* Limits of the model: parts of the radius and of the bar speed; p0 in units of the yield strength. */
#define BEAD_DEEPEST 0.1
#define BEAD_FASTEST 0.1
#define BEAD_HARDEST (1.5 * 3)

/* The largest values in a chain. 0: unknown, because the law is not one of spheres or no yield strength is given. */
struct bead_validity {
    double strike;           /* speed of the striker / smaller bar speed sqrt(E / density), of its material and the first bead's */
    double compression;      /* of a contact / its smaller radius */
    double pressure;         /* p0 in the centre of a contact / its smaller yield strength */
    size_t deepest, hardest; /* the contacts of these two */
};

/* Before anything moves: the strike, and the static compression. */
struct bead_validity bead_validity_begin(const struct bead_chain *chain);
/* Bounds: each contact alone holds all the energy that is put in; a drive may put in any. */
struct bead_validity bead_validity_bound(const struct bead_chain *chain);
/* Include the compression d of a contact, m; or the largest forces of all contacts. */
void bead_validity_add(struct bead_validity *validity, const struct bead_chain *chain, size_t contact, double d);
void bead_validity_add_peaks(struct bead_validity *validity, const struct bead_chain *chain, const struct bead_peak *peaks);
/* Is the force of this contact beyond Hertz's law: is it too deep, or the strike too fast? */
bool bead_validity_beyond(const struct bead_chain *chain, size_t contact, double force);
/* Does the model fail anywhere in the chain? */
bool bead_validity_fails(const struct bead_validity *validity);
/* Writes where it fails and by how much, "" if nowhere. Returns text. */
const char *bead_validity_words(const struct bead_validity *validity, char *text, size_t size);
