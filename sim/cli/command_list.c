/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists that need no graphics: ready scenes, materials, methods, laws, libraries, keys of scenes. */
#include "sim/cli/command_line.h"

#include <math.h>

#include "beadreel/law.h"
#include "beadreel/scene.h"
#include "sim/chain/chain_internal.h"
#include "sim/equation/equation.h"
#include "sim/hdf5/h5.h"
#include "sim/integrate/methods.h"
#include "sim/measure/measure.h"
#include "sim/scene/scene_internal.h"
#include "sim/statistics/statistics.h"

COMMAND_LISTS(command_list_scenes)
{
    struct bead_ready_scene *scenes;
    size_t count;
    BEAD_TRY(bead_scene_ready(&scenes, &count, msg));
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%-24s  %s\n", scenes[i].name, scenes[i].title);
    bead_scene_ready_free(scenes, count);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_materials)
{
    struct bead_scene *scene;
    BEAD_TRY(bead_scene_materials(&scene, msg));
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct bead_material *material = &scene->materials[i];
        char mass[32] = "for walls", radius[32] = "-", modulus[32];
        if (isfinite(material->mass))
            command_quantity(1e3 * material->mass, "g", mass, sizeof mass);
        if (isfinite(material->radius))
            command_quantity(material->radius, "m", radius, sizeof radius);
        fprintf(out, "%-16s  %-9s  radius %-8s  modulus %-8s  poisson %g\n", material->name, mass, radius,
                command_quantity(material->modulus, "Pa", modulus, sizeof modulus), material->poisson);
    }
    bead_scene_free(scene);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_methods)
{
    const struct bead_method_info *method;
    for (size_t i = 0; (method = bead_method_info(i)); i++)
        fprintf(out, "%-10s  order %d, %d force evaluation%s a step%s: %s\n", method->name, method->order, method->evaluations,
                method->evaluations == 1 ? "" : "s", method->damping ? ", damping" : "", method->description);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_equations)
{
    const struct bead_system *system;
    for (size_t i = 1; (system = bead_system_info(i)); i++) /* row 0 is that of beads */
        fprintf(out, "%-10s  %s\n", system->name, system->help);
    return BEAD_OK;
}

void command_list_opened(FILE *out, const struct bead_library_info *library)
{
    for (; library->purpose; library++)
        fprintf(out, "%-24s  %s\n", library->files[0], library->purpose);
}

COMMAND_LISTS(command_list_libraries)
{
    command_list_opened(out, bead_h5_libraries);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_laws)
{
    const struct bead_law *law;
    for (size_t i = 0; (law = bead_law_info(i)); i++)
        fprintf(out, "%-16s  %s\n", law->name, law->description);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_thresholds)
{
    const struct bead_threshold_info *info;
    for (size_t i = 0; (info = bead_threshold_info(i)); i++)
        fprintf(out, "%-14s  %s\n", info->name, info->formula);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_keys)
{
    bead_scene_help(out);
    return BEAD_OK;
}

COMMAND_LISTS(command_list_measures)
{
    const struct bead_measure_info *info;
    for (size_t i = 0; (info = bead_measure_info(i)); i++)
        fprintf(out, "%-26s  %-8s  %s\n", info->name, info->unit, info->help);
    return BEAD_OK;
}
