/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The user's own settings: found for commands that run or describe a scene, and listed by --info. */
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "beadreel/scene.h"
#include "sim/base/json.h"
#include "sim/base/suggest.h"
#include "sim/cli/command_line.h"
#include "sim/scene/scene_internal.h"

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
