/* What the numbers of a chain mean: fields, times and places, of beads and of equations. */
#include <stdio.h>

#include "sim/chain/chain_data.h"
#include "sim/equation/equation.h"
#include "sim/scene/scene_private.h"

/* Of beads there is no strain: springs have lengths, beads only touch. */
static const unsigned fields_of_beads = (BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1) & ~BEAD_FIELD_BIT(BEAD_FIELD_STRAIN);

unsigned bead_equation_fields(const struct bead_equation_spec *spec)
{
    const struct bead_equation *equation = spec->name ? bead_equation_find(spec->name) : NULL;
    unsigned fields = 0;
    if (!equation)
        return fields_of_beads;
    if (!equation->fields)
        return BEAD_FIELD_BIT(spec->variable);
    for (const enum bead_field *field = equation->fields; *field < BEAD_FIELD_COUNT; field++)
        fields |= BEAD_FIELD_BIT(*field);
    return fields;
}

enum bead_field bead_equation_shown(const struct bead_equation_spec *spec)
{
    const struct bead_equation *equation = spec->name ? bead_equation_find(spec->name) : NULL;
    return !equation ? BEAD_FIELD_FORCE : equation->fields ? equation->fields[0] : spec->variable;
}

unsigned bead_chain_fields(const struct bead_chain *chain)
{
    return bead_equation_fields(&chain->spec->equation);
}

const struct bead_field_info *bead_chain_field(const struct bead_chain *chain, enum bead_field field)
{
    if (!(bead_chain_fields(chain) & BEAD_FIELD_BIT(field)))
        return NULL;
    return chain->equation ? chain->equation->field(&chain->spec->equation, field) : bead_field_info(field);
}

/* Pulses and solitons have the sign of their amplitude as long as they keep together. */
static bool one_sided(const struct bead_equation_spec *spec, enum bead_field field)
{
    const struct bead_equation *equation = bead_equation_find(spec->name);
    bool unknown = equation->fields ? field == BEAD_FIELD_STRAIN : field == spec->variable;
    bool positive = spec->start == BEAD_START_SOLITONS || (spec->start == BEAD_START_PULSE && spec->amplitude > 0);
    return field == BEAD_FIELD_ENERGY || (unknown && positive);
}

bool bead_chain_signed(const struct bead_chain *chain, enum bead_field field)
{
    if (chain->equation)
        return !one_sided(&chain->spec->equation, field);
    return field == BEAD_FIELD_VELOCITY || field == BEAD_FIELD_DISPLACEMENT;
}

const double *bead_chain_colour(const struct bead_chain *chain, size_t bead)
{
    static const double grey[] = {0.62, 0.67, 0.74};
    return chain->equation ? grey : chain->scene->materials[chain->material[bead]].colour;
}

void bead_chain_describe(const struct bead_chain *chain, char *text, size_t size)
{
    text[0] = 0;
    if (chain->equation && chain->equation->describe)
        chain->equation->describe(&chain->spec->equation, text, size);
    else if (chain->equation)
        snprintf(text, size, "%s", chain->equation->name);
}

unsigned bead_chain_mode_fields(const struct bead_chain *chain)
{
    if (!chain->equation || !chain->equation->modes)
        return 0;
    return chain->equation->fields ? chain->equation->mode_fields : BEAD_FIELD_BIT(chain->spec->equation.variable);
}

const char *bead_chain_mode_title(const struct bead_chain *chain)
{
    return chain->equation && chain->equation->mode_title ? chain->equation->mode_title : "energy of the mode";
}

void bead_chain_mode_energies(const struct bead_chain *chain, const double *const field[BEAD_FIELD_COUNT], size_t count,
                              double *energy)
{
    chain->equation->modes(&chain->spec->equation, chain->beads, field, count, energy);
}

const char *bead_chain_time_unit(const struct bead_chain *chain)
{
    return chain->equation ? "" : "s";
}

struct bead_along bead_chain_along(const struct bead_chain *chain, bool of_contacts)
{
    struct bead_along along = {of_contacts ? "contact" : "bead", "1", 0, 1};
    if (chain->equation) {
        along = (struct bead_along){"x", "", 0, 1};
        chain->equation->places(&chain->spec->equation, chain->beads, &along.first, &along.spacing);
    }
    return along;
}

unsigned bead_scene_fields(const struct bead_scene *scene)
{
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1;
    for (size_t i = 0; i < scene->chain_count; i++)
        fields &= bead_equation_fields(&scene->chains[i].equation);
    return fields;
}
