/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: the fewest digits that read back as the same double. */
#ifndef BEADREEL_SIM_BASE_NUMBER_H
#define BEADREEL_SIM_BASE_NUMBER_H

#include <stdio.h>

enum { BEAD_NUMBER_ROOM = 40 };

/* As %g writes it, "1e-06", "0.1", "nan", "-inf"; the decimal point is that of the locale in use. */
void bead_number_text(char text[BEAD_NUMBER_ROOM], double value);
void bead_write_number(FILE *file, double value);

#endif
