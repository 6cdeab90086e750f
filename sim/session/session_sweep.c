/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sessions of sweeps: compute many chains, or read their results from a file, and write tables and plots of them. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/hdf5/h5.h"
#include "sim/integrate/stepper.h"
#include "sim/session/session_data.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

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

/* What outputs cannot show is told before chains run. */
static enum bead_error check_outputs(const struct bead_session *s, struct bead_message *msg)
{
    const struct bead_sweep_settings settings = bead_session_sweep_settings(s);
    const struct bead_run_context context = bead_session_sweep_context(s, &settings);
    BEAD_FREED const struct bead_output **outputs = NULL;
    size_t count = 0;
    BEAD_TRY(bead_new(&outputs, s->made_count, msg, "a session"));
    for (size_t i = 0; i < s->made_count; i++) {
        if (bead_session_makes(&s->made[i]))
            outputs[count++] = s->made[i].output;
    }
    BEAD_TRY(bead_sweep_asked_check(s->sweep, outputs, count, msg)); /* together: it makes outlines of chains */
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        if (bead_session_makes(m) && m->type->check)
            BEAD_TRY(m->type->check(m->output, &context, msg));
    }
    return BEAD_OK;
}

enum bead_error bead_session_open_sweep(struct bead_session *s, struct bead_message *msg)
{
    BEAD_TRY(bead_session_list_outputs(s, msg));
    bool file = false;
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        bool results = bead_session_holds_sweep(m);
        m->asked = m->asked && (results || s->job.parts == 0); /* a part has no statistics */
        file = file || (results && m->asked);
        BEAD_TRY(find_path(s, m, msg));
    }
    if (s->job.parts > 0 && !file)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: the scene has no output {sweep: FILE.h5} for the part's results");
    BEAD_TRY(bead_sweep_create(s->scene, &s->sweep, msg));
    return check_outputs(s, msg);
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
    BEAD_TRY(bead_sweep_open(s->job.input, &(struct bead_overrides){.own = s->job.own}, &s->sweep, msg));
    struct bead_scene *changed = NULL;
    BEAD_TRY(s->job.sheet ? bead_session_choose_sheet(s, bead_sweep_scene(s->sweep), &changed, msg)
                          : bead_session_choose(s, bead_sweep_scene(s->sweep), BEAD_OF_SWEEP, NULL, &changed, msg));
    BEAD_TRY(bead_sweep_show(s->sweep, changed, msg));
    s->sweep_read = true;
    s->source = bead_sweep_scene(s->sweep);
    BEAD_TRY(bead_session_list_outputs(s, msg));
    BEAD_TRY(check_outputs(s, msg));
    return bead_file_join(".", s->made->output->path, &s->made->path, msg);
}

/* ---- running ---- */

/* Does an output show results of the sweep? Sheets run their chains themselves. */
static bool needs_results(const struct bead_session *s)
{
    bool needs = false;
    for (size_t i = 0; i < s->made_count; i++)
        needs = needs || (bead_session_makes(&s->made[i]) && !s->made[i].type->without_results &&
                          !bead_sweep_runs_own(&s->made[i].output->sweep_curves));
    return needs;
}

/* Does an output run its chains itself? */
static bool runs_chains(const struct bead_session *s)
{
    bool runs = false;
    for (size_t i = 0; i < s->made_count; i++)
        runs = runs || (bead_session_makes(&s->made[i]) &&
                        (s->made[i].type->runs_chains || bead_sweep_runs_own(&s->made[i].output->sweep_curves)));
    return runs;
}

static enum bead_error compute(struct bead_session *s, const char *journal, struct bead_message *msg)
{
    struct bead_sweep_settings settings = bead_session_sweep_settings(s);
    settings.journal = journal;
    enum bead_error err = bead_sweep_run(s->sweep, &settings, &s->counts.chains, msg);
    if (s->sweep->lost > 0)
        snprintf(s->warning[SESSION_LOST], sizeof s->warning[SESSION_LOST], "%.480s; %zu of %zu chains have no results",
                 s->sweep->why.text, s->sweep->lost, s->sweep->jobs);
    return err;
}

/* The file of all results is written before others that might fail, but not if the run was stopped: it is the last file of a
 * sweep's part, and whoever finds it may assume that nothing is left to do. */
static enum bead_error judge_and_keep(struct bead_session *s, struct bead_made *results, struct bead_message *msg)
{
    const enum bead_error judged = bead_session_judge_sweep(s, msg);
    if (results && judged != BEAD_ERROR_STOPPED)
        BEAD_TRY(bead_session_finish(s, results, msg));
    return judged;
}

/* Peaks that the end of the run has cut may be off by more than any column says. */
static void find_rising(struct bead_session *s)
{
    size_t rising = 0, all = 0;
    for (size_t p = 0; p < bead_sweep_panels(s->sweep); p++) {
        const struct bead_sweep_panel *panel = bead_sweep_panel(s->sweep, p);
        struct bead_sweep_configuration found;
        for (size_t i = 0; i < panel->configurations; i++) {
            bool open = false;
            if (!bead_sweep_configuration(s->sweep, p, i, &found))
                continue;
            for (size_t k = 0; k < panel->places; k++)
                open = open || found.peaks[k].open;
            rising += open;
            all++;
        }
    }
    if (rising > 0)
        snprintf(s->warning[SESSION_RISING], sizeof s->warning[SESSION_RISING],
                 "sweep: in %zu of %zu chains a measured force was still rising when the run ended, so its peak may be larger than "
                 "said: "
                 "measure beads that are farther from the end, or give a later simulate.until",
                 rising, all);
}

enum bead_error bead_session_run_sweep(struct bead_session *s, struct bead_message *msg)
{
    struct bead_made *results = NULL;
    BEAD_FREED char *journal = NULL;
    for (size_t i = 0; i < s->made_count; i++) {
        if (bead_session_makes(&s->made[i]) && bead_session_holds_sweep(&s->made[i]))
            results = &s->made[i];
    }
    if (!s->sweep_read)
        BEAD_TRY(bead_file_make_directory(s->job.output, msg));
    BEAD_TRY(bead_session_claim(s, msg));
    if (results) {
        BEAD_TRY(bead_h5_load(msg)); /* or a run of hours might fail at its end */
        BEAD_TRY(bead_file_part_name(results->path, &journal, msg));
    }
    if (!s->sweep_read && needs_results(s))
        BEAD_TRY(compute(s, journal, msg));
    if (!s->sweep_read)
        BEAD_TRY(judge_and_keep(s, results, msg));
    if (needs_results(s))
        find_rising(s);
    BEAD_TRY(bead_session_finish_all(s, msg));
    /* Only now: if a plot fails or the run is stopped, the same command need not compute the chains again. */
    if (journal)
        bead_file_discard(journal);
    return BEAD_OK;
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
    BEAD_LEFT_TO(bead_sweep_chain_left) struct bead_sweep_chain *chain = NULL;
    struct bead_stepping stepping;
    BEAD_TRY(bead_sweep_chain_create(s->sweep, index, BEAD_SWEEP_CLEAN, &chain, msg));
    BEAD_TRY(bead_run_stepping(bead_sweep_chain_of(chain), &s->source->simulate, 1, &stepping, msg));
    fprintf(out, "sweep %s%s%zu configurations of %zu beads", panel->name, *panel->name ? ": " : "", panel->configurations,
            panel->beads);
    for (size_t k = 0; k < spec->over.key_count; k++)
        fprintf(out, "%s %zu of %s",
                k == 0                                     ? ", over"
                : spec->over.combine == BEAD_COMBINE_PAIRS ? " with"
                                                           : " by",
                spec->over.keys[k].count, spec->over.keys[k].path);
    if (spec->spins)
        fprintf(out, ", as given");
    else if (!spec->own_magnetism && !spec->over.key_count)
        fprintf(out, ", %zu magnetisms from %.4g to %.4g", spec->group_count, spec->groups[0].magnetism,
                spec->groups[spec->group_count - 1].magnetism);
    if (spec->over.key_count)
        fprintf(out, ", and the scene as it is; ");
    else
        fprintf(out, ", and the one with all of %zu random cells up; ", spec->cells);
    fprintf(out, "%s with steps %s %.4g us\n", stepping.method->info.name, stepping.variable ? "from" : "of", 1e6 * stepping.step);
    plan_measures(panel, out);
    const char *kept = bead_sweep_refusal(&s->sweep->panels[index], bead_sweep_chain_of(chain));
    if (kept)
        fprintf(out, "  all beads are kept: %s\n", kept);
    else
        fprintf(out,
                "  beads further behind the front than any measured peak can see are dropped; every 64th chain also runs whole\n");
    return BEAD_OK;
}

enum bead_error bead_session_plan_sweep(const struct bead_session *s, FILE *out, struct bead_message *msg)
{
    for (size_t p = 0; p < bead_sweep_panels(s->sweep); p++)
        BEAD_TRY(plan_panel(s, p, out, msg));
    if (s->sweep_read)
        fprintf(out, "results are read; nothing is simulated%s\n", runs_chains(s) ? " but what a sheet or report shows" : "");
    else if (!needs_results(s))
        fprintf(out, "of these, only those that outputs show\n");
    else if (isnan(s->source->simulate.until))
        fprintf(out, "time: each chain until its front reaches the end\n");
    else
        fprintf(out, "time: each chain to %.6g ms as asked\n", 1e3 * s->source->simulate.until);
    if (s->job.parts > 0)
        fprintf(out, "of these, part %zu of %zu\n", s->job.part, s->job.parts);
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        if (!m->asked)
            fprintf(out, "output %s: skipped: %s\n", m->output->path,
                    s->job.parts > 0 ? "a part has no statistics" : "not asked for (--only)");
        else
            fprintf(out, "output %s: %s\n", m->path, m->type ? m->type->why(m->output) : "skipped: this program makes data only");
    }
    if (!s->sweep_read)
        fprintf(out, "skipped: samples, contact forces and all peaks that are not measured; beads ahead of the front\n");
    return BEAD_OK;
}
