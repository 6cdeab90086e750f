/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that several equations share. */
#include "sim/equation/equation.h"

/* Pulses and solitons keep the sign of their amplitude until they break up. */
bool bead_equation_field_signed(const struct bead_chain_spec *spec, enum bead_field field)
{
    const struct bead_equation_spec *e = &spec->equation;
    bool unknown = spec->system->fields ? field == BEAD_FIELD_STRAIN : field == e->variable;
    bool positive = (e->start == BEAD_START_SOLITONS && e->nonlinearity > 0) || (e->start == BEAD_START_PULSE && e->amplitude > 0);
    return field != BEAD_FIELD_ENERGY && !(unknown && positive);
}

double bead_step_extremum(double h, double e0, double r0, double e1, double r1, double *x)
{
    double low = 0, high = 1, c1 = h * r0, c2 = 3 * (e1 - e0) - h * (2 * r0 + r1), c3 = 2 * (e0 - e1) + h * (r0 + r1);
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high), slope = c1 + middle * (2 * c2 + 3 * middle * c3);
        *((slope > 0) == (r0 > 0) ? &low : &high) = middle;
    }
    *x = 0.5 * (low + high);
    return e0 + *x * (c1 + *x * (c2 + *x * c3));
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
