/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Facts about the chains of a scene, before they are made. */
#include "sim/kinds/scene_facts.h"

size_t bead_scene_count_beads(const struct bead_chain_spec *chain)
{
    return bead_system_beads.count(chain, 0) - 1;
}

size_t bead_scene_last_bead(const struct bead_scene *scene, size_t chain)
{
    const struct bead_chain_spec *spec = &scene->chains[chain];
    return spec->system->count(spec, scene->simulate.accuracy) - 1;
}

unsigned bead_scene_fields(const struct bead_scene *scene)
{
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1;
    for (size_t i = 0; i < scene->chain_count; i++)
        fields &= bead_system_fields(&scene->chains[i]);
    return fields;
}

bool bead_chain_spec_has_sensor(const struct bead_chain_spec *chain, const char *name)
{
    for (size_t s = 0; s < chain->segment_count; s++) {
        const char *sensor = chain->segments[s].sensor;
        if (sensor && (!name || strcmp(sensor, name) == 0))
            return true;
    }
    return false;
}

bool bead_scene_has_sensors(const struct bead_scene *scene, size_t chain)
{
    for (size_t c = 0; c < scene->chain_count; c++) {
        if ((chain == SIZE_MAX || c == chain) && bead_chain_spec_has_sensor(&scene->chains[c], NULL))
            return true;
    }
    return false;
}

bool bead_scene_has_beads(const struct bead_scene *scene)
{
    bool all = true;
    for (size_t i = 0; i < scene->chain_count; i++)
        all = all && scene->chains[i].system->has_masses;
    return all;
}

bool bead_scene_has_modes(const struct bead_scene *scene)
{
    bool all = true;
    for (size_t i = 0; i < scene->chain_count; i++)
        all = all && scene->chains[i].system->modes;
    return all;
}

bool bead_scene_tolerances(const struct bead_scene *scene)
{
    bool any = false;
    for (size_t i = 0; i < scene->material_count; i++)
        any = any || scene->materials[i].radius_tolerance > 0 || scene->materials[i].modulus_tolerance > 0;
    return any;
}

bool bead_scene_has_any(const struct bead_scene *scene, const struct bead_chain_spec *chain, size_t offset)
{
    bool any = false;
    for (size_t s = 0; s < chain->segment_count; s++) {
        const struct bead_segment *segment = &chain->segments[s];
        const size_t *of = segment->each ? segment->each : segment->cell;
        for (size_t i = 0; i < segment->cell_beads * (segment->each ? segment->count : 1); i++)
            any = any || *(const double *)(const void *)((const char *)&scene->materials[of[i]] + offset) > 0;
    }
    return any;
}

bool bead_scene_has_springs(const struct bead_scene *scene, const struct bead_chain_spec *chain)
{
    return chain->cradle > 0 || (chain->segments && scene->materials[chain->striker_material].spring > 0) ||
           bead_scene_has_any(scene, chain, offsetof(struct bead_material, spring));
}
