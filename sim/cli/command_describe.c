/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --plan and --info as one JSON object, for programs. The man page documents the keys. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "beadreel/sweep.h"
#include "sim/base/json.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/drive.h"
#include "sim/chain/system.h"
#include "sim/chain/validity.h"
#include "sim/cli/command_line.h"
#include "sim/kinds/output_kinds.h"
#include "sim/session/session_internal.h"
#include "sim/sweep/sweep_internal.h"

static void write_chain(struct bead_json *json, const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const struct bead_system *system = spec->system;
    const struct bead_material *materials = bead_chain_scene(chain)->materials;
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "name", bead_chain_name(chain));
    bead_json_text(json, "equation", *system->label ? system->label : NULL);
    bead_json_number(json, system->points, (double)bead_chain_beads(chain));
    if (system->has_contacts) {
        bead_json_number(json, "contacts", (double)bead_chain_contacts(chain));
        bead_json_text(json, "striker", materials[spec->striker_material].name);
        bead_json_number(json, "velocity_m_s", spec->striker_velocity);
        command_write_beads(json, chain);
        const struct bead_validity most = bead_validity_bound(chain);
        bead_json_number(json, "energy_J", bead_is_driven(spec) ? NAN : bead_chain_energy(chain));
        bead_json_number(json, "strike_bar_speed", most.strike > 0 ? most.strike : NAN);
        bead_json_number(json, "compression_radius_most", most.compression > 0 ? most.compression : NAN);
        bead_json_number(json, "pressure_yield_most", most.pressure > 0 ? most.pressure : NAN);
        bead_json_text(json, "wall",
                       spec->absorbs                   ? "absorbing"
                       : spec->wall == BEAD_WALL_NONE  ? "none"
                       : spec->wall == BEAD_WALL_RIGID ? "rigid"
                                                       : materials[spec->wall_material].name);
        bead_json_text(json, "spins", bead_chain_spins(chain));
        bead_json_number(json, "magnetism", *bead_chain_spins(chain) ? bead_chain_magnetism(chain) : NAN);
        bead_chain_write_sensors(json, chain);
    }
    bead_json_close(json, "}");
}

static void write_chains(struct bead_json *json, const struct bead_chain *const *chains, size_t count)
{
    bead_json_open(json, "chains", '[');
    for (size_t i = 0; i < count; i++)
        write_chain(json, chains[i]);
    bead_json_close(json, "]");
}

static void write_outputs(struct bead_json *json, const struct bead_scene *scene)
{
    bead_json_open(json, "outputs", '[');
    for (size_t i = 0; i < scene->output_count; i++) {
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "name", scene->outputs[i].path);
        bead_json_text(json, "kind", bead_output_kind_name(&scene->outputs[i]));
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
}

static void describe_begin(struct bead_json *json, const char *file, const char *kind, const struct bead_scene *scene)
{
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "file", file);
    bead_json_text(json, "kind", kind);
    if (!scene)
        return;
    bead_json_text(json, "title", scene->title);
    bead_json_number(json, "until_s", scene->simulate.until);
    bead_json_number(json, "accuracy", scene->simulate.accuracy);
    write_outputs(json, scene);
}

static void end(struct bead_json *json)
{
    bead_json_close(json, "}");
    fputc('\n', json->out);
}

/* Adds the user's own settings, if there are any. */
static void end_with(struct bead_json *json, const struct bead_config *config)
{
    command_write_config(json, config);
    end(json);
}

static enum bead_error write_scene(FILE *out, const struct bead_scene *scene, const struct bead_config *config,
                                   struct bead_message *msg)
{
    struct bead_json json = {.out = out};
    enum bead_error err = BEAD_OK;
    describe_begin(&json, scene->file, scene->sweep_count > 0 ? "scene of a sweep" : "scene", scene);
    bead_json_open(&json, "chains", '[');
    for (size_t i = 0; i < scene->chain_count && !err; i++) {
        struct bead_chain *chain = NULL;
        err = bead_chain_outline(scene, &scene->chains[i], &chain, msg);
        if (!err)
            write_chain(&json, chain);
        bead_chain_destroy(chain);
    }
    bead_json_close(&json, "]");
    end_with(&json, config);
    return err;
}

/* All of it, or nothing. */
enum bead_error command_describe_scene(FILE *out, const struct bead_scene *scene, const struct bead_config *config,
                                       struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    enum bead_error err =
        memory ? write_scene(memory, scene, config, msg) : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a description");
    if (memory && fclose(memory) != 0 && !err)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a description");
    if (!err)
        fputs(text, out);
    return err;
}

void command_describe_journal(FILE *out, const char *file, const struct bead_sweep_progress *progress)
{
    struct bead_json json = {.out = out};
    describe_begin(&json, file, "journal of a sweep", NULL);
    bead_json_number(&json, "chains", (double)progress->chains);
    bead_json_number(&json, "known", (double)progress->done);
    bead_json_number(&json, "part", (double)progress->part);
    bead_json_number(&json, "parts", (double)progress->parts);
    end(&json);
}

enum bead_error command_describe_trajectory(FILE *out, const char *file, struct bead_trajectory *trajectory,
                                            const struct bead_config *config, struct bead_message *msg)
{
    struct bead_json json = {.out = out};
    size_t count = 0, samples = bead_grid_count(bead_trajectory_grid(trajectory));
    const struct bead_chain *const *chains = bead_trajectory_chains(trajectory, &count);
    const struct bead_grid *grid = bead_trajectory_grid(trajectory);
    const struct bead_span beads = bead_trajectory_beads(trajectory);
    BEAD_FREED struct bead_outcome *outcomes = calloc(count, sizeof *outcomes);
    BEAD_TRY(outcomes ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for outcomes"));
    for (size_t i = 0; i < count; i++)
        BEAD_TRY(bead_trajectory_outcome(trajectory, i, &outcomes[i], msg));
    describe_begin(&json, file, bead_trajectory_complete(trajectory) ? "trajectory" : "part of a trajectory",
                   bead_trajectory_scene(trajectory));
    write_chains(&json, chains, count);
    bead_json_open(&json, "samples", '{');
    bead_json_number(&json, "count", (double)samples);
    bead_json_number(&json, "start_s", samples ? grid->start : NAN);
    bead_json_number(&json, "every_s", samples ? grid->every : NAN);
    bead_json_number(&json, "end_s", samples ? bead_grid_time(grid, samples - 1) : NAN);
    bead_json_number(&json, "first_bead", (double)beads.first);
    bead_json_number(&json, "last_bead", beads.last == SIZE_MAX ? NAN : (double)beads.last);
    bead_json_open(&json, "fields", '[');
    for (int field = 0; field < BEAD_FIELD_COUNT; field++) {
        if (bead_trajectory_fields(trajectory) & BEAD_FIELD_BIT(field))
            bead_json_text(&json, NULL, bead_field_info((enum bead_field)field)->name);
    }
    bead_json_close(&json, "]}");
    command_write_runs(&json, chains, outcomes, count);
    end_with(&json, config);
    return BEAD_OK;
}

void command_describe_sweep(FILE *out, const char *file, const struct bead_sweep *sweep, const struct bead_config *config)
{
    struct bead_json json = {.out = out};
    size_t known = 0, all = bead_sweep_count(sweep, &known), part = 0, parts = 0;
    bead_sweep_part(sweep, &part, &parts);
    describe_begin(&json, file, "sweep", bead_sweep_scene(sweep));
    bead_json_number(&json, "chains", (double)all);
    bead_json_number(&json, "known", (double)known);
    bead_json_number(&json, "part", (double)part);
    bead_json_number(&json, "parts", (double)parts);
    bead_json_text(&json, "version", bead_sweep_version(sweep));
    end_with(&json, config);
}

/* Writes the lines of the plan, which are for people, unchanged. */
static void write_lines(struct bead_json *json, char *text)
{
    char *rest = NULL;
    bead_json_open(json, "lines", '[');
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
        bead_json_text(json, NULL, line);
    bead_json_close(json, "]");
}

enum bead_error command_describe_plan(FILE *out, const struct bead_session *session, struct bead_message *msg)
{
    struct bead_json json = {.out = out};
    BEAD_FREED char *text = NULL;
    size_t size = 0, count = 0;
    FILE *lines = open_memstream(&text, &size);
    if (!lines)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the plan");
    enum bead_error err = bead_session_plan(session, lines, msg);
    if (fclose(lines) != 0 && !err)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the plan");
    const struct bead_chain *const *chains = bead_session_chains(session, &count);
    struct bead_planned planned;
    if (!err) {
        bead_json_open(&json, NULL, '{');
        write_chains(&json, chains, count);
        bead_json_open(&json, "outputs", '[');
        for (size_t i = 0; bead_session_planned(session, i, &planned); i++) {
            bead_json_open(&json, NULL, '{');
            bead_json_text(&json, "name", planned.name);
            bead_json_text(&json, "path", planned.path);
            bead_json_text(&json, "kind", planned.kind);
            bead_json_flag(&json, "made", planned.made);
            bead_json_close(&json, "}");
        }
        bead_json_close(&json, "]");
        write_lines(&json, text);
        end(&json);
    }
    return err;
}
