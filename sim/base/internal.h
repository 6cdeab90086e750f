/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Marks functions of one library that the other, or a program, calls: exported for them alone. They are no promise, and may change
 * or go with any version; tests/reference/libbeadsim.internal and libbeadreel.internal list them. */
#pragma once

#include "beadreel/api.h"

#define BEAD_INTERNAL __attribute__((visibility("default")))
