/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists that need no graphics: ready scenes, materials, methods, laws, libraries, keys of scenes; and the
 * user's own settings. */
#include "sim/cli/command_line.h"

#include <math.h>

#include "beadreel/law.h"
#include "beadreel/scene.h"
#include "sim/base/json.h"
#include "sim/base/suggest.h"
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

/* The user's own settings: found for commands that run or describe a scene, and listed by --info. */

/* Only a program that draws checks the canvas. */
static enum bead_error check_canvas(const struct command *command, struct bead_message *msg)
{
    const struct bead_config *c = command->config;
    char all[160] = "";
    for (const char *const *canvas = command->program->canvases; c->canvas && canvas && *canvas; canvas++) {
        if (strcmp(*canvas, c->canvas) == 0)
            return BEAD_OK;
        bead_list_add(all, sizeof all, ", ", *canvas);
    }
    return !*all ? BEAD_OK
                 : bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: canvas: is `%.40s`; must be one of %s", c->path,
                             c->canvas_place.line, c->canvas_place.column, c->canvas, all);
}

enum bead_error command_load_config(struct command *command, struct bead_message *msg)
{
    char path[PATH_MAX];
    const bool asked = command->action == COMMAND_RUN || command->action == COMMAND_PLAN || command->action == COMMAND_INFO;
    if (!asked || command->no_config || !bead_config_find(path, sizeof path))
        return BEAD_OK;
    BEAD_TRY(bead_config_load(path, &command->config, msg));
    command->job.config = command->config->path;
    if (!command->job.canvas)
        command->job.canvas = command->config->canvas;
    return check_canvas(command, msg);
}

struct bead_overrides command_overrides(const struct command *command)
{
    const struct bead_job *job = &command->job;
    return (struct bead_overrides){.settings = job->settings, .setting_count = job->setting_count, .config = job->config};
}

/* The settings that have one value, in the order of the manual. */
static const char *value_of(const struct bead_config *c, size_t index, const char **key)
{
    const char *const keys[] = {"style", "font", "canvas", "materials"}, *const values[] = {c->style, c->font, c->canvas,
                                                                                            c->materials};
    *key = index < sizeof keys / sizeof *keys ? keys[index] : NULL;
    return *key ? values[index] : NULL;
}

void command_print_config(FILE *out, const struct bead_config *c)
{
    const char *key = NULL;
    if (!c)
        return;
    fprintf(out, "your settings: %s\n", c->path);
    for (size_t i = 0; value_of(c, i, &key) || key; i++) {
        if (value_of(c, i, &key))
            fprintf(out, "  %s: %s\n", key, value_of(c, i, &key));
    }
    for (size_t i = 0; i < c->colormap_count; i++)
        fprintf(out, "  colour map %s: %s\n", c->colormaps[i].name, c->colormaps[i].file);
}

void command_write_config(struct bead_json *json, const struct bead_config *c)
{
    const char *key = NULL;
    if (!c)
        return;
    bead_json_open(json, "config", '{');
    bead_json_text(json, "path", c->path);
    for (size_t i = 0; value_of(c, i, &key) || key; i++)
        bead_json_text(json, key, value_of(c, i, &key));
    bead_json_open(json, "colormaps", '{');
    for (size_t i = 0; i < c->colormap_count; i++)
        bead_json_text(json, c->colormaps[i].name, c->colormaps[i].file);
    bead_json_close(json, "}}");
}
