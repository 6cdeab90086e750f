/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with units: "0.443 m/s", "193 GPa", "1.5". */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"

/* Is the text a number without a unit? */
bool bead_units_bare(const char *text);

/* The known units. The tables of UDUNITS-2 are read only when a unit is not one of the usual ones. */
struct bead_units;

struct bead_units *bead_units_create(void); /* NULL: out of memory */
void bead_units_free(struct bead_units *units);

/* Read `text` as a number in the SI unit `si` (NULL: a number without a unit). A number without a unit is in `si`.
 * Decimal prefixes move the decimal point before the conversion, so that "4.76 mm" is 4.76e-3 to the last bit.
 * On failure `why` gives the reason: "`3 N` is not in a unit of m/s". Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_units_read(struct bead_units *units, const char *text, const char *si, double *value, char *why,
                                           size_t size);
