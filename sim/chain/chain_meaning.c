/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The meaning of a chain's numbers, for all systems: fields, units, times and places. Tables and views ask here. */
#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"

unsigned bead_system_fields(const struct bead_chain_spec *spec)
{
    unsigned fields = 0;
    if (!spec->system->fields)
        return BEAD_FIELD_BIT(spec->equation.variable);
    for (const enum bead_field *field = spec->system->fields; *field < BEAD_FIELD_COUNT; field++)
        fields |= BEAD_FIELD_BIT(*field);
    return fields;
}

enum bead_field bead_system_shown(const struct bead_chain_spec *spec)
{
    return spec->system->fields ? spec->system->fields[0] : spec->equation.variable;
}

unsigned bead_chain_fields(const struct bead_chain *chain)
{
    return bead_system_fields(chain->spec);
}

const struct bead_field_info *bead_chain_field(const struct bead_chain *chain, enum bead_field field)
{
    return bead_chain_fields(chain) & BEAD_FIELD_BIT(field) ? chain->spec->system->field(field) : NULL;
}

bool bead_chain_signed(const struct bead_chain *chain, enum bead_field field)
{
    return chain->spec->system->field_signed(chain->spec, field);
}

const double *bead_chain_colour(const struct bead_chain *chain, size_t bead)
{
    static const double grey[] = {0.62, 0.67, 0.74};
    return chain->spec->system->has_contacts ? chain->scene->materials[chain->material[bead]].colour : grey;
}

void bead_chain_describe(const struct bead_chain *chain, char *text, size_t size)
{
    chain->spec->system->describe(chain->spec, text, size);
}

unsigned bead_chain_mode_fields(const struct bead_chain *chain)
{
    const struct bead_system *system = chain->spec->system;
    if (!system->modes)
        return 0;
    return system->fields ? system->mode_fields : BEAD_FIELD_BIT(chain->spec->equation.variable);
}

const char *bead_chain_mode_title(const struct bead_chain *chain)
{
    return chain->spec->system->mode_title;
}

void bead_chain_mode_energies(const struct bead_chain *chain, const double *const field[BEAD_FIELD_COUNT], size_t count,
                              double *energy)
{
    chain->spec->system->modes(chain->spec, chain->beads, field, count, energy);
}

const char *bead_chain_time_unit(const struct bead_chain *chain)
{
    return chain->spec->system->time_unit;
}

struct bead_chain_axis bead_chain_axis(const struct bead_chain *chain, bool of_contacts)
{
    const struct bead_system *system = chain->spec->system;
    struct bead_chain_axis along = {.title = of_contacts && system->has_contacts ? "contact" : system->axis,
                                    .unit = system->axis_unit};
    system->places(chain->spec, chain->beads, &along.first, &along.spacing);
    return along;
}

/* Do its contacts' forces depend on displacements only? */
static bool forces_follow(const struct bead_chain *chain)
{
    return chain->spec->system->has_contacts && !(chain->spec->damping_coefficient > 0);
}

unsigned bead_chains_derivable(const struct bead_chain *const *chains, size_t count)
{
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE);
    bool contacts = true;
    for (size_t c = 0; c < count; c++) {
        contacts = contacts && chains[c]->spec->system->has_contacts;
        fields = forces_follow(chains[c]) ? fields : 0;
    }
    return contacts ? fields | BEAD_FIELD_BIT(BEAD_FIELD_COMPRESSION) : 0;
}
