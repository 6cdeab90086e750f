/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sessions of sweeps: compute many chains, or read their results from a file, and write tables and plots of them. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "beadreel/file.h"
#include "beadreel/sweep.h"
#include "sim/base/h5.h"
#include "sim/integrate/stepper.h"
#include "sim/run/run.h"
#include "sim/scene/output_kinds.h"
#include "sim/session/session_data.h"

static const struct bead_sweep_sink *find_sink(const struct bead_job *job, const struct bead_output *output)
{
    for (const struct bead_sweep_sink *const *const *list = job->sweep_sinks; list && *list; list++) {
        for (const struct bead_sweep_sink *const *sink = *list; *sink; sink++) {
            if ((*sink)->kind == output->kind)
                return *sink;
        }
    }
    return NULL;
}

/* ---- opening ---- */

static enum bead_error find_path(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    char *whole = NULL;
    enum bead_error err = bead_file_join(s->job.output ? s->job.output : ".", m->output->path, &whole, msg);
    if (err || s->job.parts == 0 || !bead_session_holds_sweep(m)) {
        m->path = whole;
        return err;
    }
    err = bead_sweep_part_path(whole, s->job.part, s->job.parts, &m->path, msg);
    free(whole);
    return err;
}

enum bead_error bead_session_open_sweep(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = bead_session_list_outputs(s, msg);
    bool file = false;
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        bool results = bead_session_holds_sweep(m);
        m->type = NULL;
        m->asked = m->asked && (results || s->job.parts == 0); /* a part has no statistics */
        m->sweep_type = results ? NULL : find_sink(&s->job, m->output);
        file = file || (results && m->asked);
        err = find_path(s, m, msg);
        if (!err)
            err = results ? BEAD_OK : bead_session_check_single(s, m, msg);
    }
    if (!err && s->job.parts > 0 && !file)
        err = bead_fail(msg, BEAD_ERROR_USAGE, "--shard: the scene has no output {sweep: FILE.h5} for the part's results");
    return err ? err : bead_sweep_create(s->scene, &s->sweep, msg);
}

const struct bead_file_kind bead_sweep_file_kinds[] = {{BEAD_OUTPUT_PLOT, NULL},
                                                       {BEAD_OUTPUT_TABLE, NULL},
                                                       {BEAD_OUTPUT_SWEEP, NULL},
                                                       {BEAD_OUTPUT_REPORT, NULL},
                                                       {BEAD_OUTPUT_KINDS, NULL}};
static const struct bead_file_kind sheet_kinds[] = {{BEAD_OUTPUT_SHEET, NULL}, {BEAD_OUTPUT_KINDS, NULL}};

/* More configurations than sheets have room for. */
#define OF_CHAIN "sweep={magnetism: all, configurations: 64}"

/* Load the scene with nothing but a sheet; `sweep` is one of its chain where it has none; NULL. */
static enum bead_error load_sheet(struct bead_session *s, const char *path, const char *outputs, const char *sweep,
                                  struct bead_message *msg)
{
    struct bead_settings settings;
    enum bead_error err = bead_session_settings_make(&s->job, 0, outputs, sweep, &settings, msg);
    if (!err)
        err = bead_scene_load(path, settings.all, settings.count, &s->scene, msg);
    bead_session_settings_free(&settings);
    return err;
}

enum bead_error bead_session_load_sheet(struct bead_session *s, struct bead_message *msg)
{
    char path[4096], *outputs = NULL;
    struct bead_scene *plain = NULL;
    if (!s->job.output)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: say where it goes with -o FILE (png, pdf, svg)");
    if (s->job.parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: there is no part of a sheet; leave --shard out");
    enum bead_error err = bead_session_outputs_for(s->job.output, sheet_kinds, &outputs, msg);
    if (!err)
        err = bead_scene_find(s->job.input, path, sizeof path, msg);
    if (!err)
        err = bead_session_load_plain(s, path, &plain, msg);
    if (!err && plain->sweep_count == 0 && (plain->chain_count != 1 || plain->chains[0].equation.name))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: %s has neither a sweep nor one chain of beads", path);
    if (!err)
        err = load_sheet(s, path, outputs, plain->sweep_count > 0 ? NULL : OF_CHAIN, msg);
    s->single = s->job.output;
    s->job.output = NULL; /* the scene says where */
    bead_scene_free(plain);
    free(outputs);
    return err;
}

enum bead_error bead_session_open_sweep_file(struct bead_session *s, struct bead_message *msg)
{
    if (!s->job.output)
        return bead_fail(
            msg, BEAD_ERROR_USAGE,
            "%s is the file of a sweep: say what to draw with -o FILE (png, pdf, svg, csv), or which chain of it to run "
            "with --configuration N -o FILE",
            s->job.input);
    if (s->job.parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: %s is computed already", s->job.input);
    enum bead_error err = bead_sweep_open(s->job.input, NULL, 0, &s->sweep, msg);
    if (err)
        return err;
    struct bead_settings settings;
    err = bead_session_single_settings(s, s->job.sheet ? NULL : bead_sweep_scene(s->sweep),
                                       s->job.sheet ? sheet_kinds : bead_sweep_file_kinds, &settings, msg);
    if (!err) {
        bead_sweep_close(s->sweep);
        err = bead_sweep_open(s->job.input, settings.all, settings.count, &s->sweep, msg);
    }
    bead_session_settings_free(&settings);
    if (err)
        return err;
    s->sweep_read = true;
    s->source = bead_sweep_scene(s->sweep);
    err = bead_session_list_outputs(s, msg);
    if (err)
        return err;
    struct bead_made *m = s->made;
    m->type = NULL;
    m->sweep_type = find_sink(&s->job, m->output);
    err = bead_session_check_single(s, m, msg);
    return err ? err : bead_file_join(".", m->output->path, &m->path, msg);
}

/* "17" or "NAME:17". */
static enum bead_error find_configuration(const struct bead_sweep *sweep, const char *asked, size_t *panel, size_t *index,
                                          struct bead_message *msg)
{
    const char *colon = strrchr(asked, ':'), *digits = colon ? colon + 1 : asked;
    size_t panels = bead_sweep_panels(sweep);
    char *end = NULL;
    errno = 0;
    unsigned long long number = strtoull(digits, &end, 10);
    *panel = 0;
    for (size_t p = 0; colon && p < panels; p++) {
        const char *name = bead_sweep_panel(sweep, p)->name;
        if (strlen(name) == (size_t)(colon - asked) && strncmp(name, asked, strlen(name)) == 0)
            *panel = p + 1;
    }
    if (colon && *panel == 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: no sweep has this name; there is %s%s", asked,
                         bead_sweep_panel(sweep, 0)->name, panels > 1 ? ", and others" : "");
    if (!colon && panels > 1)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: there are %zu sweeps; say which, as in %s:%s", asked, panels,
                         bead_sweep_panel(sweep, 0)->name, asked);
    *panel -= *panel > 0;
    size_t count = bead_sweep_panel(sweep, *panel)->configurations;
    if (*digits < '0' || *digits > '9' || *end || errno || number >= count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: must be a number from 0 to %zu", asked, count - 1);
    *index = (size_t)number;
    return BEAD_OK;
}

/* The sweep of a file, or that of a scene, which then stays as long. A scene of one random chain has the sweep that its sheet
 * shows.
 */
static enum bead_error open_configurations(const struct bead_session *s, struct bead_scene **scene, struct bead_sweep **sweep,
                                           struct bead_message *msg)
{
    const char *const sheet_settings[] = {OF_CHAIN, "outputs=[{sheet: sheet.png}]", s->job.config};
    char path[4096];
    if (bead_sweep_is(s->job.input))
        return bead_sweep_open(s->job.input, NULL, 0, sweep, msg);
    if (bead_trajectory_is(s->job.input) && bead_h5_load(msg))
        return BEAD_ERROR_UNSUPPORTED;
    if (bead_trajectory_is(s->job.input))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration: %s is the trajectory of a single run", s->job.input);
    enum bead_error err = bead_scene_find(s->job.input, path, sizeof path, msg);
    if (!err)
        err = bead_session_load_plain(s, path, scene, msg);
    if (!err && (*scene)->sweep_count == 0) {
        if ((*scene)->chain_count != 1 || (*scene)->chains[0].equation.name)
            return bead_fail(msg, BEAD_ERROR_USAGE, "--configuration: %s has neither a sweep nor one chain of beads", path);
        bead_scene_free(*scene);
        *scene = NULL;
        err = bead_scene_load(path, sheet_settings, s->job.config ? 3 : 2, scene, msg);
    }
    return err ? err : bead_sweep_create(*scene, sweep, msg);
}

enum bead_error bead_session_load_configuration(struct bead_session *s, struct bead_message *msg)
{
    /* The peaks that sweeps measure are those of bead forces. */
    static const struct bead_file_kind kinds[] = {
        {BEAD_OUTPUT_IMAGE, NULL},      {BEAD_OUTPUT_MOVIE, NULL},  {BEAD_OUTPUT_TABLE, ", show: bead-peaks"},
        {BEAD_OUTPUT_TRAJECTORY, NULL}, {BEAD_OUTPUT_REPORT, NULL}, {BEAD_OUTPUT_KINDS, NULL}};
    struct bead_sweep *sweep = NULL;
    struct bead_scene *scene = NULL;
    char *outputs = NULL, *text = NULL;
    size_t panel = 0, index = 0;
    if (!s->job.output)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "--configuration: say what to make of it with -o FILE (mp4, png, pdf, h5, csv, ...)");
    enum bead_error err = bead_session_outputs_for(s->job.output, kinds, &outputs, msg);
    if (!err)
        err = open_configurations(s, &scene, &sweep, msg);
    if (!err)
        err = find_configuration(sweep, s->job.configuration, &panel, &index, msg);
    struct bead_sweep_configuration found;
    if (!err && !scene && !bead_sweep_configuration(sweep, panel, index, &found)) {
        size_t part, parts;
        bead_sweep_part(sweep, &part, &parts);
        err = bead_fail(msg, BEAD_ERROR_USAGE, "--configuration %s: is not in %s, which is part %zu of %zu", s->job.configuration,
                        s->job.input, part, parts);
    }
    if (!err)
        err = bead_sweep_single(sweep, panel, index, outputs, &text, msg);
    struct bead_settings settings = {0};
    if (!err)
        err = bead_session_settings_make(&s->job, 0, NULL, NULL, &settings, msg);
    if (!err)
        err = bead_scene_parse(s->job.input, text, strlen(text), settings.all, settings.count, &s->scene, msg);
    bead_session_settings_free(&settings);
    s->single = s->job.output;
    s->job.output = NULL; /* the scene says where */
    free(outputs);
    free(text);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
    return err;
}

/* ---- running ---- */

static struct bead_sweep_settings settings_of(const struct bead_session *s)
{
    return (struct bead_sweep_settings){.size = sizeof(struct bead_sweep_settings),
                                        .threads = s->threads,
                                        .instructions = s->job.instructions,
                                        .part = s->job.part,
                                        .parts = s->job.parts,
                                        .stop = s->job.stop,
                                        .progress = s->job.progress,
                                        .progress_context = s->job.progress_context};
}

/* Does an output show results of the sweep? Sheets run what they show themselves. */
static bool needs_results(const struct bead_session *s)
{
    bool needs = false;
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        needs =
            needs ||
            (m->asked && (bead_session_holds_sweep(m) || (m->sweep_type && (!m->sweep_type->run || m->sweep_type->needs_results))));
    }
    return needs;
}

/* Does an output run what it shows? */
static bool runs_chains(const struct bead_session *s)
{
    bool runs = false;
    for (size_t i = 0; i < s->made_count; i++)
        runs = runs || (s->made[i].asked && s->made[i].sweep_type && s->made[i].sweep_type->run);
    return runs;
}

static enum bead_error compute(struct bead_session *s, const char *results, const char *journal, struct bead_message *msg)
{
    struct bead_sweep_settings settings = settings_of(s);
    settings.journal = journal;
    enum bead_error err = bead_sweep_run(s->sweep, &settings, &s->counts.chains, msg);
    return !err && results ? bead_sweep_write(s->sweep, results, msg) : err;
}

static enum bead_error write_output(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    struct bead_result *r = &s->results[s->result_count];
    bool results = bead_session_holds_sweep(m) && !s->sweep_read;
    if (!m->asked || (!results && !m->sweep_type))
        return BEAD_OK;
    *r = (struct bead_result){.path = m->path, .name = m->output->path, .kind = bead_output_key(m->output->kind)};
    const struct bead_sweep_settings settings = settings_of(s);
    enum bead_error err = BEAD_OK;
    if (!results && m->sweep_type->run)
        err = m->sweep_type->run(m->output, s->sweep, &settings, m->path, &r->bytes, msg);
    else if (!results)
        err = m->sweep_type->write(m->output, s->sweep, m->path, &r->bytes, msg);
    if (!err && r->bytes == 0)
        r->bytes = bead_file_bytes(m->path);
    s->result_count += !err;
    return err;
}

enum bead_error bead_session_run_sweep(struct bead_session *s, struct bead_message *msg)
{
    const char *results = NULL;
    char *journal = NULL;
    s->results = calloc(s->made_count + 1, sizeof *s->results);
    if (!s->results)
        return bead_session_out_of_memory(msg);
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].asked && bead_session_holds_sweep(&s->made[i]) && !s->sweep_read)
            results = s->made[i].path;
    }
    enum bead_error err = s->sweep_read ? BEAD_OK : bead_file_make_directory(s->job.output, msg);
    if (!err)
        err = bead_session_claim(s, msg);
    if (!err && results)
        err = bead_h5_load(msg); /* which a run of hours must not find missing at its end */
    if (!err && results)
        err = bead_file_part_name(results, &journal, msg);
    if (!err && !s->sweep_read && needs_results(s))
        err = compute(s, results, journal, msg);
    for (size_t i = 0; !err && i < s->made_count; i++)
        err = write_output(s, &s->made[i], msg);
    /* Only now: if a plot fails or the run is stopped, the same command does not compute the chains again. */
    if (!err && journal)
        bead_file_discard(journal);
    bead_session_release(s);
    free(journal);
    return err;
}

const struct bead_sweep *bead_session_sweep(const struct bead_session *s)
{
    return s->sweep;
}

/* ---- planning ---- */

static void plan_measures(const struct bead_sweep_panel *panel, FILE *out)
{
    const struct bead_sweep_measures *measures = &panel->spec->measures;
    if (panel->places > 0 && measures->sensor_count == 0)
        fprintf(out, "  measured: largest force of beads %zu to %zu\n", panel->spec->last + measures->beads[0],
                panel->spec->last + measures->beads[1]);
    for (size_t i = 0; i < measures->sensor_count && panel->places; i++)
        fprintf(out, "  measured: largest force at sensor %s\n", measures->sensors[i]);
    if (measures->decay)
        fprintf(out, "  measured: peaks of the force and energy of every bead\n");
}

static enum bead_error plan_panel(const struct bead_session *s, size_t index, FILE *out, struct bead_message *msg)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(s->sweep, index);
    const struct bead_sweep_spec *spec = panel->spec;
    struct bead_sweep_chain *chain = NULL;
    struct bead_stepping stepping;
    enum bead_error err = bead_sweep_chain_create(s->sweep, index, BEAD_SWEEP_CLEAN, &chain, msg);
    if (!err)
        err = bead_run_stepping(bead_sweep_chain_of(chain), &s->source->simulate, &stepping, msg);
    if (!err) {
        fprintf(out, "sweep %s%s%zu configurations of %zu beads", panel->name, *panel->name ? ": " : "", panel->configurations,
                panel->beads);
        if (spec->spins)
            fprintf(out, ", as given");
        else if (!spec->own_magnetism)
            fprintf(out, ", %zu magnetisms from %.4g to %.4g", spec->group_count, spec->groups[0].magnetism,
                    spec->groups[spec->group_count - 1].magnetism);
        fprintf(out, ", and the one with all of %zu random cells up; %s with steps %s %.4g us\n", spec->cells,
                stepping.method->info.name, stepping.variable ? "from" : "of", 1e6 * stepping.step);
        plan_measures(panel, out);
    }
    bead_sweep_chain_destroy(chain);
    return err;
}

enum bead_error bead_session_plan_sweep(const struct bead_session *s, FILE *out, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t p = 0; p < bead_sweep_panels(s->sweep) && !err; p++)
        err = plan_panel(s, p, out, msg);
    if (err)
        return err;
    if (s->sweep_read)
        fprintf(out, "results are read; nothing is simulated%s\n", runs_chains(s) ? " but what a sheet or report shows" : "");
    else if (!needs_results(s))
        fprintf(out, "of these, only those that a sheet shows\n");
    else if (isnan(s->source->simulate.until))
        fprintf(out, "time: each chain until its front reaches the end\n");
    else
        fprintf(out, "time: each chain to %.6g ms as asked\n", 1e3 * s->source->simulate.until);
    if (s->job.parts > 0)
        fprintf(out, "of these, part %zu of %zu\n", s->job.part, s->job.parts);
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        bool results = bead_session_holds_sweep(m) && !s->sweep_read;
        if (!m->asked)
            fprintf(out, "output %s: skipped: %s\n", m->output->path,
                    s->job.parts > 0 ? "a part has no statistics" : "not asked for (--only)");
        else if (results)
            fprintf(out, "output %s: spins and results of every configuration; kept as they come in %s.part\n", m->path, m->path);
        else
            fprintf(out, "output %s: %s\n", m->path,
                    m->sweep_type ? m->sweep_type->why(m->output) : "skipped: this program makes data only");
    }
    if (!s->sweep_read)
        fprintf(out, "skipped: samples, contact forces and all peaks that are not measured; beads ahead of the front\n");
    return BEAD_OK;
}
