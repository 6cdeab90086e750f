/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The meaning of a chain's numbers: fields, units, times and places, of beads and of equations alike. Tables and views ask here. */
#include <stdio.h>

#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"

/* Beads have no strain: springs have lengths, beads only touch. */
static const unsigned fields_of_beads = (BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1) & ~BEAD_FIELD_BIT(BEAD_FIELD_STRAIN);

unsigned bead_system_fields(const struct bead_equation_spec *spec)
{
    const struct bead_system *system = spec->system;
    unsigned fields = 0;
    if (!system)
        return fields_of_beads;
    if (!system->fields)
        return BEAD_FIELD_BIT(spec->variable);
    for (const enum bead_field *field = system->fields; *field < BEAD_FIELD_COUNT; field++)
        fields |= BEAD_FIELD_BIT(*field);
    return fields;
}

enum bead_field bead_system_shown(const struct bead_equation_spec *spec)
{
    const struct bead_system *system = spec->system;
    return !system ? BEAD_FIELD_FORCE : system->fields ? system->fields[0] : spec->variable;
}

unsigned bead_chain_fields(const struct bead_chain *chain)
{
    return bead_system_fields(&chain->spec->equation);
}

const struct bead_field_info *bead_chain_field(const struct bead_chain *chain, enum bead_field field)
{
    if (!(bead_chain_fields(chain) & BEAD_FIELD_BIT(field)))
        return NULL;
    return chain->system ? chain->system->field(&chain->spec->equation, field) : bead_field_info(field);
}

/* Pulses and solitons keep the sign of their amplitude until they break up. */
static bool one_sided(const struct bead_equation_spec *spec, enum bead_field field)
{
    const struct bead_system *system = spec->system;
    bool unknown = system->fields ? field == BEAD_FIELD_STRAIN : field == spec->variable;
    bool positive = spec->start == BEAD_START_SOLITONS || (spec->start == BEAD_START_PULSE && spec->amplitude > 0);
    return field == BEAD_FIELD_ENERGY || (unknown && positive);
}

bool bead_chain_signed(const struct bead_chain *chain, enum bead_field field)
{
    if (chain->system)
        return !one_sided(&chain->spec->equation, field);
    return field == BEAD_FIELD_VELOCITY || field == BEAD_FIELD_DISPLACEMENT;
}

const double *bead_chain_colour(const struct bead_chain *chain, size_t bead)
{
    static const double grey[] = {0.62, 0.67, 0.74};
    return chain->system ? grey : chain->scene->materials[chain->material[bead]].colour;
}

void bead_chain_describe(const struct bead_chain *chain, char *text, size_t size)
{
    text[0] = 0;
    if (chain->system && chain->system->describe)
        chain->system->describe(&chain->spec->equation, text, size);
    else if (chain->system)
        snprintf(text, size, "%s", chain->system->name);
}

unsigned bead_chain_mode_fields(const struct bead_chain *chain)
{
    if (!chain->system || !chain->system->modes)
        return 0;
    return chain->system->fields ? chain->system->mode_fields : BEAD_FIELD_BIT(chain->spec->equation.variable);
}

const char *bead_chain_mode_title(const struct bead_chain *chain)
{
    return chain->system && chain->system->mode_title ? chain->system->mode_title : "energy of the mode";
}

void bead_chain_mode_energies(const struct bead_chain *chain, const double *const field[BEAD_FIELD_COUNT], size_t count,
                              double *energy)
{
    chain->system->modes(&chain->spec->equation, chain->beads, field, count, energy);
}

const char *bead_chain_time_unit(const struct bead_chain *chain)
{
    return chain->system ? "" : "s";
}

struct bead_chain_axis bead_chain_axis(const struct bead_chain *chain, bool of_contacts)
{
    struct bead_chain_axis along = {of_contacts ? "contact" : "bead", "1", 0, 1};
    if (chain->system) {
        along = (struct bead_chain_axis){"x", "", 0, 1};
        chain->system->places(&chain->spec->equation, chain->beads, &along.first, &along.spacing);
    }
    return along;
}
