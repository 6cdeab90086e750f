/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of equations, in which scenes and runs look theirs up. */
#include "sim/equation/equation.h"

#include <stdio.h>
#include <string.h>

static const struct bead_equation *const equations[] = {&bead_equation_fput, &bead_equation_kdv, &bead_equation_shock, NULL};

const struct bead_equation *bead_equation_info(size_t index)
{
    return index < sizeof equations / sizeof *equations ? equations[index] : NULL;
}

const struct bead_equation *bead_equation_find(const char *name)
{
    for (size_t i = 0; equations[i]; i++) {
        if (strcmp(equations[i]->system.name, name) == 0)
            return equations[i];
    }
    return NULL;
}

size_t bead_measure_add(struct bead_measure *measures, size_t count, size_t room, const char *name, double value)
{
    if (count < room) {
        snprintf(measures[count].name, sizeof measures[count].name, "%s", name);
        measures[count].unit = "";
        measures[count].value = value;
        *measures[count].note = '\0';
    }
    return count + 1;
}
