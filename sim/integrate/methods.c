/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of methods: one row each, with its step in units of 1/omega. Scenes name them, the stepper uses them. */
#include "sim/integrate/methods.h"

#include <string.h>

#include "sim/integrate/stepper.h"
#include "sim/integrate/tableau.h"

/* The thetas were measured on disordered chains (tests/bench), theta_max in tests/stress. */
static const struct bead_method methods[] = {
    {.info = {"rk4", "classical Runge-Kutta 4, the thesis's method (its Appendix 1)", 4, 4, true, false, 0.04, 3, 0.5, 2.8},
     .step = bead_step_rk4},
    {.info = {"verlet", "velocity Verlet, symplectic (Swope et al. 1982)", 2, 1, false, false, 0.004, 2, 0.5, 2.0},
     .step = bead_step_composition,
     .composition = &bead_composition_verlet},
    {.info = {"pefrl", "position extended Forest-Ruth like, symplectic (Omelyan, Mryglod, Folk 2002)", 4, 5, false, false, 0.05, 3,
              0.5, 2.5},
     .step = bead_step_composition,
     .composition = &bead_composition_pefrl},
    {.info = {"vefrl", "velocity extended Forest-Ruth like, symplectic (Omelyan, Mryglod, Folk 2002)", 4, 4, false, false, 0.04, 3,
              0.5, 2.5},
     .step = bead_step_composition,
     .composition = &bead_composition_vefrl},
    {.info = {"rkn6", "Runge-Kutta-Nystrom RKN6(4)6FM (Dormand, El-Mikkawy, Prince 1987)", 6, 5, false, true, 0.1, 3, 1, 2.5},
     .step = bead_step_nystrom,
     .tableau = &bead_tableau_rkn6},
    {.info = {"rkn8", "RKN8(6)9FM with contacts that open or close integrated again: the default", 8, 8, false, true, 0.95, 8.5,
              2.2, 2.5},
     .step = bead_step_nystrom,
     .tableau = &bead_tableau_rkn8,
     .events = true},
    {.info = {"rkn8-plain", "Runge-Kutta-Nystrom RKN8(6)9FM (Dormand, El-Mikkawy, Prince 1987)", 8, 8, false, true, 0.16, 3, 1.6,
              2.5},
     .step = bead_step_nystrom,
     .tableau = &bead_tableau_rkn8},
    {.info = {"rkn12", "Runge-Kutta-Nystrom RKN12(10)17M (Dormand, El-Mikkawy, Prince 1987)", 12, 17, false, true, 0.2, 3, 1.6,
              2.5},
     .step = bead_step_nystrom,
     .tableau = &bead_tableau_rkn12},
};

static const size_t method_count = sizeof methods / sizeof *methods;

const struct bead_method *bead_method_row(const char *name)
{
    for (size_t i = 0; i < method_count; i++) {
        if (strcmp(name, methods[i].info.name) == 0)
            return &methods[i];
    }
    return NULL;
}

const struct bead_method_info *bead_method_info(size_t index)
{
    return index < method_count ? &methods[index].info : NULL;
}

const struct bead_method_info *bead_method_find(const char *name)
{
    const struct bead_method *row = bead_method_row(name);
    return row ? &row->info : NULL;
}
