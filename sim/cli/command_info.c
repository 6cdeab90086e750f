/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --info: describes a scene, a trajectory or a sweep's file. --verify: is such a file whole? */
#include "sim/cli/command_line.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "beadreel/sweep.h"
#include "beadreel/trajectory.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/drive.h"
#include "sim/chain/system.h"
#include "sim/chain/validity.h"
#include "sim/hdf5/h5.h"
#include "sim/kinds/output_kinds.h"
#include "sim/kinds/scene_facts.h"
#include "sim/measure/measure.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/trajectory/trajectory_data.h"

enum { MOST_STARTS = 8 };
#define SHOWN 72 /* longer spin strings are cut */

static void print_wall(FILE *out, const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    if (spec->wall == BEAD_WALL_MATERIAL)
        fprintf(out, ", wall %s", bead_chain_scene(chain)->materials[spec->wall_material].name);
    else if (spec->absorbs && chain->end.exponent == 1)
        fprintf(out, ", absorbing end of %.4g kg/s", chain->end.coefficient);
    else if (spec->absorbs)
        fprintf(out, ", absorbing end of %.4g N (s/m)^%.3g", chain->end.coefficient, chain->end.exponent);
    else
        fprintf(out, ", %s", spec->wall == BEAD_WALL_RIGID ? "rigid wall" : "free end");
}

/* Beads that are not at rest at first. */
static void print_starts(FILE *out, const struct bead_chain_spec *spec)
{
    char speed[32], place[32];
    for (size_t i = 0; i < spec->start_count && i < MOST_STARTS; i++)
        fprintf(out, "  bead %zu starts at %s, displaced by %s\n", spec->starts[i].bead,
                command_quantity(spec->starts[i].velocity, "m/s", speed, sizeof speed),
                command_quantity(spec->starts[i].displacement, "m", place, sizeof place));
    if (spec->start_count > MOST_STARTS)
        fprintf(out, "  ... and %zu beads more\n", spec->start_count - MOST_STARTS);
}

static void print_drive(FILE *out, const struct bead_drive *drive)
{
    static const char *const waves[] = {"", "a sine", "a chirp", "noise", "a measured wave"};
    const enum bead_wave wave = drive->displacement ? drive->displacement : drive->force;
    char amplitude[32], from[32], to[32], ramp[32];
    if (!wave)
        return;
    fprintf(out, "  bead %zu driven: its %s is %s of %s", drive->bead, drive->displacement ? "displacement" : "load", waves[wave],
            command_quantity(drive->amplitude, drive->displacement ? "m" : "N", amplitude, sizeof amplitude));
    if (wave != BEAD_WAVE_POINTS)
        fprintf(out, ", %s", command_quantity(drive->frequency, "Hz", from, sizeof from));
    if (wave == BEAD_WAVE_CHIRP)
        fprintf(out, " to %s", command_quantity(drive->to, "Hz", to, sizeof to));
    if (drive->ramp > 0)
        fprintf(out, ", rising for %s", command_quantity(drive->ramp, "s", ramp, sizeof ramp));
    fputc('\n', out);
}

static void print_options(FILE *out, const struct bead_chain_spec *spec)
{
    char text[32];
    if (spec->gap > 0)
        fprintf(out, "  gaps of %s\n", command_quantity(spec->gap, "m", text, sizeof text));
    if (spec->cradle > 0)
        fprintf(out, "  pendulums of %s\n", command_quantity(spec->cradle, "m", text, sizeof text));
    if (spec->precompression > 0)
        fprintf(out, "  precompression %s\n", command_quantity(spec->precompression, "N", text, sizeof text));
    if (spec->tilt > 0)
        fprintf(out, "  tilt %.4g deg\n", spec->tilt * 180 / 3.14159265358979323846);
    if (spec->damping_coefficient > 0)
        fprintf(out, spec->damping_compression > 0 ? "  damping %.4g N (s/m)^%.3g / m^%.3g\n" : "  damping %.4g N (s/m)^%.3g\n",
                spec->damping_coefficient, spec->damping_exponent, spec->damping_compression);
}

/* Prints how close the chain comes to the limits of the model, at the most that the striker's energy allows. */
static void print_validity(FILE *out, const struct bead_chain *chain)
{
    const struct bead_validity most = bead_validity_bound(chain);
    if (most.strike > 0)
        fprintf(out, "  strike at %.3g of the bar speed", most.strike);
    const bool bound = most.compression > 0 && isfinite(most.compression);
    if (bound)
        fprintf(out, "%scompression at most %.3g of the radius", most.strike > 0 ? "; " : "  ", most.compression);
    if (bound && most.pressure > 0)
        fprintf(out, ", pressure at most %.3g of the yield strength", most.pressure);
    if (most.strike > 0 || bound)
        fprintf(out, "\n");
}

/* Print the equation's own keys, as given in the scene. */
static void print_equation(FILE *out, const struct bead_chain *chain, size_t index)
{
    const struct bead_chain_axis along = bead_chain_axis(chain, false);
    const char *name = bead_chain_name(chain);
    char number[24];
    snprintf(number, sizeof number, "%zu", index);
    fprintf(out, "chain %s: equation %s, %zu points from x = %.6g, %.6g apart\n", *name ? name : number,
            bead_chain_spec(chain)->system->label, bead_chain_beads(chain), along.first, along.spacing);
}

static void print_chain(FILE *out, const struct bead_chain *chain, size_t index)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    if (!spec->system->has_contacts) {
        print_equation(out, chain, index);
        return;
    }
    const char *name = bead_chain_name(chain), *spins = bead_chain_spins(chain);
    char number[24], velocity[32], text[32];
    snprintf(number, sizeof number, "%zu", index);
    fprintf(out, "chain %s: striker and %zu beads, %zu contacts", *name ? name : number, bead_chain_beads(chain) - 1,
            bead_chain_contacts(chain));
    print_wall(out, chain);
    fprintf(out, "\n  striker %s at %s", bead_chain_scene(chain)->materials[spec->striker_material].name,
            command_quantity(spec->striker_velocity, "m/s", velocity, sizeof velocity));
    if (!bead_is_driven(spec))
        fprintf(out, ", energy %s", command_quantity(bead_chain_energy(chain), "J", text, sizeof text));
    fputc('\n', out);
    print_starts(out, spec);
    print_drive(out, &spec->drive);
    command_print_beads(out, chain);
    print_options(out, spec);
    print_validity(out, chain);
    if (*spins)
        fprintf(out, "  spins %.*s%s (%zu), M = %.4g\n", SHOWN, spins, strlen(spins) > SHOWN ? "..." : "", strlen(spins),
                bead_chain_magnetism(chain));
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "  sensor %s on bead %zu\n", sensors[i].name, sensors[i].bead);
}

/* Prints what the sweep varies; `beads` is the number of the last bead. */
static void print_sweep_spec(FILE *out, const struct bead_sweep_spec *spec, size_t beads)
{
    size_t configurations = 0;
    for (size_t g = 0; g < spec->group_count; g++)
        configurations += spec->groups[g].configurations;
    fprintf(out, "sweep %s%s%zu configurations of striker and %zu beads", spec->name, *spec->name ? ": " : "", configurations,
            beads);
    if (spec->over.key_count == 0)
        fprintf(out, ", %zu random cells, seed %llu", spec->cells, (unsigned long long)spec->seed);
    fputc('\n', out);
    for (size_t k = 0; k < spec->over.key_count; k++)
        fprintf(out, "  over %zu values of %s\n", spec->over.keys[k].count, spec->over.keys[k].path);
    if (spec->spins)
        fprintf(out, "  spins as given\n");
    else if (!spec->own_magnetism && spec->over.key_count == 0)
        fprintf(out, "  magnetism: %zu from %.4g to %.4g\n", spec->group_count, spec->groups[0].magnetism,
                spec->groups[spec->group_count - 1].magnetism);
}

static void print_outputs(FILE *out, const struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->output_count; i++)
        fprintf(out, "output %zu: %s %s\n", i, bead_output_kind_name(&scene->outputs[i]), scene->outputs[i].path);
}

static void print_head(FILE *out, const char *path, const char *kind, const struct bead_scene *scene)
{
    fprintf(out, "%s: %s\n", path, kind);
    if (*scene->title)
        fprintf(out, "title: %s\n", scene->title);
}

static enum bead_error scene_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    char path[PATH_MAX], until[32], step[32];
    const char *unit = "s";
    BEAD_LEFT_TO(bead_scene_left) struct bead_scene *scene = NULL;
    const struct bead_overrides overrides = command_overrides(command);
    BEAD_TRY(bead_scene_find(command->job.input, path, sizeof path, msg));
    BEAD_TRY(bead_scene_load(path, &overrides, &scene, msg));
    if (scene->doubts)
        command_warn(command->program, scene->doubts);
    if (command->json)
        return command_describe_scene(out, scene, command->config, msg);
    print_head(out, path, scene->sweep_count > 0 ? "scene of a sweep" : "scene", scene);
    for (size_t i = 0; i < scene->sweep_count; i++)
        print_sweep_spec(out, &scene->sweeps[i], bead_scene_last_bead(scene, scene->sweeps[i].chain));
    for (size_t i = 0; i < scene->chain_count; i++) {
        struct bead_chain *chain;
        BEAD_TRY(bead_chain_outline(scene, &scene->chains[i], &chain, msg));
        print_chain(out, chain, i);
        unit = bead_chain_time_unit(chain);
        bead_chain_destroy(chain);
    }
    const struct bead_simulate *simulate = &scene->simulate;
    fprintf(out, "until %s, accuracy %.3g, method %s",
            isfinite(simulate->until) ? command_quantity(simulate->until, unit, until, sizeof until) : "the front is through",
            simulate->accuracy, simulate->method);
    if (simulate->step > 0)
        fprintf(out, ", step %s", command_quantity(simulate->step, unit, step, sizeof step));
    fputc('\n', out);
    print_outputs(out, scene);
    return BEAD_OK;
}

static void print_outcome(FILE *out, size_t index, const char *unit, const struct bead_outcome *outcome)
{
    char text[32], step[32];
    if (!isfinite(outcome->end)) { /* only samples were written */
        fprintf(out, "run of chain %zu: killed: nothing but its samples is known\n", index);
        return;
    }
    fprintf(out, "run of chain %zu: %s, step %s, %llu steps to %s\n", index, outcome->method ? outcome->method : "?",
            command_quantity(outcome->step, unit, step, sizeof step), (unsigned long long)outcome->steps,
            command_quantity(outcome->end, unit, text, sizeof text));
    if (isfinite(outcome->front_arrival))
        fprintf(out, "  front arrived at the end at %s\n", command_quantity(outcome->front_arrival, unit, text, sizeof text));
    if (isfinite(outcome->energy_error))
        fprintf(out, "  errors seen: energy %.2g", outcome->energy_error);
    if (isfinite(outcome->embedded_error))
        fprintf(out, ", embedded method %.2g", outcome->embedded_error);
    if (isfinite(outcome->event_error))
        fprintf(out, ", contact events %.2g", outcome->event_error);
    fputc('\n', out);
    if (outcome->worst_force > 0)
        fprintf(out, "  least certain peak: %s %.0f, %.6g N to %.2g N\n", isnan(outcome->worst_bead) ? "contact" : "bead",
                isnan(outcome->worst_bead) ? outcome->worst_contact : outcome->worst_bead, outcome->worst_force,
                outcome->worst_uncertainty);
}

static void print_samples(FILE *out, const struct bead_trajectory *trajectory, const struct bead_chain *chain)
{
    const char *unit = bead_chain_time_unit(chain), *beads_word = bead_chain_spec(chain)->system->points;
    const struct bead_grid *grid = bead_trajectory_grid(trajectory);
    struct bead_span beads = bead_trajectory_beads(trajectory);
    char start[32], every[32], end[32];
    size_t count = bead_grid_count(grid);
    unsigned fields = bead_trajectory_fields(trajectory);
    fprintf(out, "samples: %zu", count);
    if (count > 0)
        fprintf(out, ", every %s from %s to %s", command_quantity(grid->every, unit, every, sizeof every),
                command_quantity(grid->start, unit, start, sizeof start),
                command_quantity(bead_grid_time(grid, count - 1), unit, end, sizeof end));
    if (beads.last == SIZE_MAX)
        fprintf(out, ", all %s\nfields:", beads_word);
    else
        fprintf(out, ", %s %zu to %zu\nfields:", beads_word, beads.first, beads.last);
    for (int field = 0; field < BEAD_FIELD_COUNT; field++) {
        const struct bead_field_info *info =
            fields & BEAD_FIELD_BIT(field) ? bead_chain_field(chain, (enum bead_field)field) : NULL;
        if (info)
            fprintf(out, *info->unit ? " %s (%s)" : " %s", bead_field_info((enum bead_field)field)->name, info->unit);
    }
    fputc('\n', out);
}

/* ---- measures of a stored run, from its samples ---- */

enum { MOST_MEASURES = 128 };
/* Files with more values than this are not read through for --info. */
static const double most_values = 5e7;

static enum bead_error feed(struct bead_trajectory *trajectory, size_t chain, size_t samples, struct bead_measures *measures,
                            struct bead_message *msg)
{
    for (size_t i = 0; i < samples; i++) {
        struct bead_sample sample = {.chain = chain, .index = i};
        BEAD_TRY(bead_trajectory_read(trajectory, i, chain, BEAD_MEASURE_FIELDS, &sample, msg));
        BEAD_TRY(bead_measures_feed(measures, &sample, msg));
    }
    return BEAD_OK;
}

static void print_measures(FILE *out, size_t chain, const struct bead_measure *found, size_t count)
{
    char text[48];
    fprintf(out, "measures of chain %zu, from these samples:\n", chain);
    for (size_t i = 0; i < count && i < MOST_MEASURES; i++) {
        bool prefixed = found[i].unit[0] && !found[i].unit[1] && found[i].unit[0] != '1'; /* s, m, N, J */
        const char *note = found[i].note;
        if (isnan(found[i].value))
            fprintf(out, "  %-27s %s\n", found[i].name, note);
        else if (prefixed)
            fprintf(out, "  %-27s %s%s%s\n", found[i].name, command_quantity(found[i].value, found[i].unit, text, sizeof text),
                    *note ? ", " : "", note);
        else
            fprintf(out, "  %-27s %.6g%s%s%s%s\n", found[i].name, found[i].value, *found[i].unit ? " " : "", found[i].unit,
                    *note ? ", " : "", note);
    }
}

/* The measures of a chain's samples, if these have the fields needed and are not too many. */
static enum bead_error describe_measures(FILE *out, struct bead_trajectory *trajectory, size_t chain,
                                         const struct bead_outcome *outcome, struct bead_message *msg)
{
    size_t chains, samples = bead_grid_count(bead_trajectory_grid(trajectory));
    const struct bead_chain *of = bead_trajectory_chains(trajectory, &chains)[chain];
    struct bead_span beads = bead_trajectory_beads(trajectory);
    struct bead_measure found[MOST_MEASURES];
    struct bead_measures *measures = NULL;
    bool there = (bead_trajectory_fields(trajectory) & BEAD_MEASURE_FIELDS) == BEAD_MEASURE_FIELDS && beads.first == 0 &&
                 beads.last >= bead_chain_beads(of) - 1;
    if (!there || !bead_chain_spec(of)->system->has_contacts || (double)samples * (double)bead_chain_beads(of) > most_values)
        return BEAD_OK;
    enum bead_error err = bead_measures_create(of, false, &measures, msg);
    if (!err)
        err = feed(trajectory, chain, samples, measures, msg);
    if (!err)
        print_measures(out, chain, found, bead_measures_read(measures, outcome, found, MOST_MEASURES));
    bead_measures_destroy(measures);
    return err;
}

BEAD_LEAVES(trajectory_left, struct bead_trajectory, bead_trajectory_close)

static enum bead_error trajectory_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    const struct bead_overrides overrides = command_overrides(command);
    BEAD_LEFT_TO(trajectory_left) struct bead_trajectory *trajectory = NULL;
    BEAD_TRY(bead_trajectory_open(command->job.input, &overrides, &trajectory, msg));
    if (command->json)
        return command_describe_trajectory(out, command->job.input, trajectory, command->config, msg);
    size_t count = 0;
    const struct bead_chain *const *chains = bead_trajectory_chains(trajectory, &count);
    const char *kind = bead_trajectory_complete(trajectory) ? "trajectory" : "trajectory of a run that was stopped or killed";
    print_head(out, command->job.input, kind, bead_trajectory_scene(trajectory));
    for (size_t i = 0; i < count; i++)
        print_chain(out, chains[i], i);
    print_samples(out, trajectory, chains[0]);
    for (size_t i = 0; i < count; i++) {
        struct bead_outcome outcome;
        BEAD_TRY(bead_trajectory_outcome(trajectory, i, &outcome, msg));
        print_outcome(out, i, bead_chain_time_unit(chains[i]), &outcome);
        BEAD_TRY(describe_measures(out, trajectory, i, &outcome, msg));
    }
    return BEAD_OK;
}

static void print_sweep(FILE *out, const struct bead_sweep *sweep, size_t index)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, index);
    const struct bead_sweep_spec *spec = panel->spec;
    print_sweep_spec(out, spec, panel->beads - 1);
    for (size_t place = 0; place < panel->places; place++) {
        struct bead_sweep_configuration clean;
        char force[32];
        if (bead_sweep_configuration(sweep, index, BEAD_SWEEP_CLEAN, &clean))
            fprintf(out, "  %s: %s %s\n", bead_sweep_place(sweep, index, place),
                    command_quantity(clean.peaks[place].force, "N", force, sizeof force),
                    spec->over.key_count ? "in the scene as it is" : "with all cells up");
    }
    if (spec->measures.decay)
        fprintf(out, "  peaks of force and energy of every bead\n");
}

static enum bead_error sweep_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    const struct bead_overrides overrides = command_overrides(command);
    BEAD_LEFT_TO(bead_sweep_left) struct bead_sweep *sweep = NULL;
    BEAD_TRY(bead_sweep_open(command->job.input, &overrides, &sweep, msg));
    size_t part = 0, parts = 0, known = 0, all = bead_sweep_count(sweep, &known);
    if (command->json) {
        command_describe_sweep(out, command->job.input, sweep, command->config);
        return BEAD_OK;
    }
    print_head(out, command->job.input, "sweep", bead_sweep_scene(sweep));
    for (size_t i = 0; i < bead_sweep_panels(sweep); i++)
        print_sweep(out, sweep, i);
    bead_sweep_part(sweep, &part, &parts);
    if (parts > 1)
        fprintf(out, "part %zu of %zu: %zu of %zu chains\n", part, parts, known, all);
    fprintf(out, "computed by version %s\n", bead_sweep_version(sweep));
    print_outputs(out, bead_sweep_scene(sweep));
    return BEAD_OK;
}

static void print_journal(FILE *out, const char *path, const struct bead_sweep_progress *progress)
{
    fprintf(out, "%s: journal of an unfinished sweep\n%zu of %zu chains are done", path, progress->done, progress->chains);
    if (progress->parts > 1)
        fprintf(out, ", of part %zu of %zu", progress->part, progress->parts);
    fprintf(out, "; the command that began it goes on from here\n");
}

static enum bead_error file_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    bool of_sweep;
    BEAD_TRY(bead_sweep_is(command->job.input, &of_sweep, msg));
    if (of_sweep)
        return sweep_info(command, out, msg);
    return bead_trajectory_is(command->job.input) ? trajectory_info(command, out, msg) : scene_info(command, out, msg);
}

static enum bead_error print_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    struct bead_sweep_progress progress;
    if (bead_sweep_journal_look(command->job.input, &progress)) {
        (command->json ? command_describe_journal : print_journal)(out, command->job.input, &progress);
        return BEAD_OK;
    }
    enum bead_error err = file_info(command, out, msg);
    if (!err && !command->json)
        command_print_config(out, command->config);
    return err;
}

/* The file may come from anybody: its texts are held and shown without control characters. */
enum bead_error command_info(const struct command *command, FILE *out, struct bead_message *msg)
{
    struct command_held held;
    if (command->json)
        return print_info(command, out, msg);
    BEAD_TRY(command_hold(&held, msg));
    return command_let_go(&held, out, print_info(command, held.file, msg), msg);
}

enum bead_error command_verify(const struct command *command, struct bead_message *msg)
{
    uint64_t bytes;
    BEAD_TRY(bead_h5_verify(command->job.input, &bytes, msg));
    command_print(stdout, "%s: whole: %llu bytes as they were written\n", command->job.input, (unsigned long long)bytes);
    return BEAD_OK;
}
