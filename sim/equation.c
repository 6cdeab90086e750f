#include "sim/equation.h"

#include <string.h>

static const struct bead_equation *const equations[] = {&bead_equation_fput, &bead_equation_kdv, &bead_equation_shock, NULL};

const struct bead_equation *bead_equation_info(size_t index)
{
    return index < sizeof equations / sizeof *equations ? equations[index] : NULL;
}

const struct bead_equation *bead_equation_find(const char *name)
{
    for (size_t i = 0; equations[i]; i++) {
        if (strcmp(equations[i]->name, name) == 0)
            return equations[i];
    }
    return NULL;
}
