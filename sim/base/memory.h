/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is there room for what is about to be made? Where arrays are only touched later, the system ends the program instead of refusing
 * them. */
#ifndef BEADREEL_SIM_BASE_MEMORY_H
#define BEADREEL_SIM_BASE_MEMORY_H

#include <stdint.h>

#include "beadreel/error.h"

/* Bytes; less is not worth asking for. */
enum { BEAD_MEMORY_SMALL = 64 << 20 };

/* Bytes that this process may still take: of the machine's memory and swap, and of its own limit (ulimit -v). UINT64_MAX: not
 * known. */
uint64_t bead_memory_left(void);
/* `what` is the beginning of the message: "chain.yaml:3:1: chain: 100 beads". Up to BEAD_MEMORY_SMALL nothing is checked. Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error bead_memory_check(uint64_t bytes, const char *what, struct bead_message *msg);

#endif
