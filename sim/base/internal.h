/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For the project's own code. Marks functions of one library that the other, or a program, calls: exported for them alone. They are
 * no promise, and may change or go with any version; tests/reference/libbeadsim.internal and libbeadreel.internal list them. */
#pragma once

#include "beadreel/api.h"

#define BEAD_INTERNAL __attribute__((visibility("default")))

/* Before the declaration of a variable: `function` gets its address when it goes out of scope. `unused`, because clang ignores the
 * use by the cleanup. */
#define BEAD_LEFT_TO(function) __attribute__((cleanup(function), unused))
/* Defines such a function for pointers, from one that takes the pointer, which may be NULL. */
#define BEAD_LEAVES(name, type, destroy)   \
    static inline void name(type **object) \
    {                                      \
        destroy(*object);                  \
    }
