/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A session's life. Opening goes from a job to its scene, its chains and the end of the run; session_sinks.c then makes the sinks.
 */
#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/base/memory.h"
#include "sim/base/settings.h"
#include "sim/chain/chain_data.h"
#include "sim/session/session_data.h"
#include "sim/trajectory/trajectory_data.h"

static enum bead_error create_chains(struct bead_session *s, struct bead_message *msg)
{
    s->chain_count = s->scene->chain_count;
    BEAD_TRY(bead_new(&s->own_chains, s->chain_count, msg, "a session"));
    for (size_t i = 0; i < s->chain_count; i++)
        BEAD_TRY(bead_chain_outline(s->scene, &s->scene->chains[i], &s->own_chains[i], msg));
    s->chains = (const struct bead_chain *const *)s->own_chains;
    return BEAD_OK;
}

/* The latest time that the keys of an output name; 0: none. */
static double asked_time(const struct bead_output *output)
{
    double last = 0;
    const double times[] = {output->shown.time[0], output->shown.time[1], output->image.at};
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++)
        last = fmax(last, times[i]); /* NaN: not given */
    for (size_t i = 0; i < output->curves.profile_time_count; i++)
        last = fmax(last, output->curves.profile_times[i]);
    for (size_t i = 0; i < output->still.panel_count; i++)
        last = fmax(last, asked_time(&output->still.panels[i]));
    return last;
}

/* Without `until`, a scouting run finds when the pulse has passed, if an output must know that before the run; times that an output
 * asks for extend the run. */
static enum bead_error find_end(struct bead_session *s, struct bead_message *msg)
{
    s->end = s->source->simulate.until;
    s->passage = isnan(s->end);
    if (!s->passage)
        return BEAD_OK;
    s->end = INFINITY;
    bool asked = false;
    for (size_t i = 0; i < s->made_count; i++)
        asked = asked || (s->made[i].asked && s->made[i].type && bead_output_needs_end(s->made[i].output));
    if (!asked)
        return BEAD_OK;
    BEAD_TRY(bead_session_lay(s, msg));
    struct bead_play play = bead_session_play(s, "scouting the end");
    play.hash = false;
    play.counts = &s->counts;
    BEAD_LEFT_TO(bead_played_free) struct bead_played played;
    enum bead_error err = bead_play(&play, &played, msg);
    double end = 0, asked_end = 0;
    bead_session_find_lost(s, &played);
    for (size_t i = 0; !err && i < played.count; i++) {
        if (!played.runs[i].kind->is_lost(played.runs[i].run))
            end = fmax(end, played.outcomes[i].end);
    }
    for (size_t i = 0; i < s->made_count; i++)
        asked_end = s->made[i].asked ? fmax(asked_end, asked_time(s->made[i].output)) : asked_end;
    s->end = fmax(end, asked_end);
    s->extended = asked_end > end;
    return err;
}

/* If the scene gives no accuracy, the outputs to be made may ask for one. */
static void find_accuracy(struct bead_session *s)
{
    struct bead_simulate *simulate = &s->scene->simulate;
    for (size_t i = 0; i < s->made_count && !simulate->accuracy_given; i++) {
        const struct bead_made *m = &s->made[i];
        const double wish = m->asked && m->type && m->type->accuracy ? m->type->accuracy(m->output) : 0;
        if (!(wish > 0 && wish < simulate->accuracy))
            continue;
        simulate->accuracy = wish;
        s->exacting = m->output;
    }
}

static enum bead_error open_scene(struct bead_session *s, struct bead_message *msg)
{
    BEAD_TRY(bead_session_load(s, msg));
    if (s->scene->fit.count > 0)
        BEAD_TRY(bead_session_fit(s, msg));
    s->source = s->scene;
    if (s->scene->sweep_count > 0)
        return bead_session_open_sweep(s, msg);
    if (s->job.parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: %s has no sweep to divide", s->job.input);
    BEAD_TRY(create_chains(s, msg));
    BEAD_TRY(bead_session_list_outputs(s, msg));
    find_accuracy(s);
    bead_session_doubt(s);
    BEAD_TRY(bead_session_find_resolution(s, msg));
    BEAD_TRY(find_end(s, msg));
    return bead_session_create_sinks(s, msg);
}

/* Options that exclude each other, or need a file's name. */
static enum bead_error check_job(const struct bead_job *job, struct bead_message *msg)
{
    if (job->configuration && job->sheet)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet shows many configurations, --configuration one: give one of the two");
    if (job->still && strcmp(job->still, "poster") != 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--still: there is no `%s`; must be poster", job->still);
    if (job->frame && (job->configuration || job->sheet))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--frame: has no effect with --%s", job->sheet ? "sheet" : "configuration");
    if (job->sheet && job->parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: there is no part of a sheet; leave --shard out");
    if (job->sheet && !job->output)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: say where it goes with -o FILE (png, pdf, svg)");
    if (job->configuration && !job->output)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "--configuration: say what to make of it with -o FILE (mp4, png, pdf, h5, csv, ...)");
    return BEAD_OK;
}

/* Only trajectories are shown together. */
static enum bead_error check_alone(const struct bead_job *job, struct bead_message *msg)
{
    if (job->other_count > 0 && access(job->input, F_OK) != 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", job->input, strerror(errno));
    if (job->other_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "one file at a time: `%s` and `%s`; only trajectories are shown together",
                         job->input, job->others[0]);
    return job->difference ? bead_fail(msg, BEAD_ERROR_USAGE, "--diff: needs two trajectories, as in --diff a.h5 b.h5 -o diff.png")
                           : BEAD_OK;
}

/* A trajectory, a sweep's file, or a scene. */
static enum bead_error open_input(struct bead_session *s, struct bead_message *msg)
{
    const bool hdf5 = bead_trajectory_is(s->job.input);
    if (hdf5)
        BEAD_TRY(bead_trajectory_begin(s->job.input, s->job.own, &s->trajectory, msg));
    if (!s->trajectory || s->job.configuration)
        BEAD_TRY(check_alone(&s->job, msg));
    if (!s->trajectory)
        return hdf5 && !s->job.configuration ? bead_session_open_sweep_file(s, msg) : open_scene(s, msg);
    return s->job.sheet ? bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: %s is the trajectory of a single run", s->job.input)
                        : bead_session_open_trajectory(s, msg);
}

static enum bead_error begin(struct bead_session *s, const struct bead_job *given, struct bead_message *msg)
{
    BEAD_TRY(bead_settings_take(&s->job, sizeof s->job, BEAD_SETTINGS_UP_TO(struct bead_job, sinks), given, "bead_job", msg));
    const struct bead_job *job = &s->job;
    s->kernels = bead_kernels_find(job->instructions);
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    s->threads = job->threads > 0 ? job->threads : cores > 1 ? (int)cores : 1;
    if (!s->kernels)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "--instructions %s: this machine has no such kernels; allowed are portable and, on x86-64, sse2, avx2, "
                         "avx512",
                         job->instructions);
    if (!job->input)
        return bead_fail(msg, BEAD_ERROR_USAGE, "no scene given");
    if (job->still && !job->frame)
        s->job.frame = "peak";
    BEAD_TRY(check_job(job, msg));
    return open_input(s, msg);
}

enum bead_error bead_session_open(const struct bead_job *job, struct bead_session **session, struct bead_message *msg)
{
    *session = NULL;
    struct bead_session *s;
    BEAD_TRY(bead_new(&s, 1, msg, "a session"));
    enum bead_error err = begin(s, job, msg);
    if (err)
        bead_session_close(s);
    else
        *session = s;
    return err;
}

enum bead_error bead_session_run(struct bead_session *s, struct bead_message *msg)
{
    if (s->begun)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: a session runs once, and this one has: open another", s->job.input);
    s->begun = true;
    BEAD_TRY(bead_new(&s->results, 2 * s->made_count, msg, "a session")); /* each with a second file, at most */
    const enum bead_error err = s->sweep ? bead_session_run_sweep(s, msg) : bead_session_run_single(s, msg);
    bead_session_release(s);
    return err;
}

void bead_session_close(struct bead_session *s)
{
    if (!s)
        return;
    for (size_t i = 0; s->made && i < s->made_count; i++) {
        if (s->made[i].sink)
            s->made[i].type->destroy(s->made[i].sink);
        free(s->made[i].path);
        free(s->made[i].part);
        free(s->made[i].beside);
    }
    free(s->made);
    free(s->frame_path);
    free(s->results);
    free(s->outcomes);
    bead_session_free_sensitivities(s);
    bead_played_free(&s->played);
    for (size_t i = 0; s->own_chains && i < s->chain_count; i++)
        bead_chain_destroy(s->own_chains[i]);
    free(s->own_chains);
    bead_session_part(s);
    free(s->bounds);
    bead_trajectory_close(s->trajectory);
    bead_sweep_close(s->sweep);
    bead_scene_free(s->scene);
    free(s);
}
