/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens a session: from a job to its scene, its chains and the end of the run; session_sinks.c then makes the sinks. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "beadreel/sweep.h"
#include "sim/base/settings.h"
#include "sim/chain/chain_data.h"
#include "sim/output/trajectory_data.h"
#include "sim/session/session_data.h"

static enum bead_error create_chains(struct bead_session *s, struct bead_message *msg)
{
    s->chain_count = s->scene->chain_count;
    s->own_chains = calloc(s->chain_count, sizeof *s->own_chains);
    if (!s->own_chains)
        return bead_session_out_of_memory(msg);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->chain_count; i++)
        err = bead_chain_outline(s->scene, &s->scene->chains[i], &s->own_chains[i], msg);
    s->chains = (const struct bead_chain *const *)s->own_chains;
    return err;
}

enum bead_error bead_session_lay(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && s->own_chains && i < s->chain_count; i++)
        err = bead_chain_lay(s->own_chains[i], msg);
    return err;
}

/* The latest time that an output shows by its keys; 0: none is given. */
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

/* Without `until`, a scouting run finds when the pulse has passed if any output needs it before the run; times that an output asks
 * for extend the run. */
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
    enum bead_error err = bead_session_lay(s, msg);
    if (err)
        return err;
    struct bead_driver driver = bead_session_driver(s, "scouting the end");
    driver.hash = false;
    struct bead_passed passed;
    err = bead_drive_simulation(&driver, &s->counts, &passed, msg);
    double end = 0, asked_end = 0;
    for (size_t i = 0; !err && i < passed.count; i++)
        end = fmax(end, passed.outcomes[i].end);
    for (size_t i = 0; i < s->made_count; i++)
        asked_end = s->made[i].asked ? fmax(asked_end, asked_time(s->made[i].output)) : asked_end;
    bead_passed_free(&passed);
    s->end = fmax(end, asked_end);
    s->extended = asked_end > end;
    return err;
}

/* The scene, or where `-o` names a file, nothing but that. */
static enum bead_error load_scene(struct bead_session *s, struct bead_message *msg)
{
    static const struct bead_file_kind kinds[] = {{BEAD_OUTPUT_IMAGE, NULL},  {BEAD_OUTPUT_MOVIE, NULL},
                                                  {BEAD_OUTPUT_TABLE, NULL},  {BEAD_OUTPUT_TRAJECTORY, NULL},
                                                  {BEAD_OUTPUT_REPORT, NULL}, {BEAD_OUTPUT_KINDS, NULL}};
    char path[4096];
    struct bead_scene *plain = NULL;
    struct bead_settings settings = {0};
    enum bead_error err = bead_scene_find(s->job.input, path, sizeof path, msg);
    if (err)
        return err;
    if (!s->job.frame && !bead_session_names_file(s->job.output)) {
        if (s->job.look_count > 0)
            return bead_fail(msg, BEAD_ERROR_USAGE, "--%.*s: of which output? name it with -o FILE, or use --set outputs.N.%s",
                             (int)strcspn(s->job.looks[0], "="), s->job.looks[0], s->job.looks[0]);
        err = bead_session_settings_make(&s->job, 0, NULL, NULL, &settings, msg);
        if (!err)
            err = bead_scene_load(path, settings.all, settings.count, &s->scene, msg);
        bead_session_settings_free(&settings);
        return err;
    }
    err = bead_session_load_plain(s, path, &plain, msg);
    if (!err && s->job.frame)
        err = bead_session_frame_settings(s, plain, &settings, msg);
    else if (!err)
        err = bead_session_single_settings(s, plain, plain->sweep_count > 0 ? bead_sweep_file_kinds : kinds, &settings, msg);
    s->amid = s->job.frame != NULL;
    if (!err)
        err = bead_scene_load(path, settings.all, settings.count, &s->scene, msg);
    bead_session_settings_free(&settings);
    bead_scene_free(plain);
    s->job.output = NULL; /* the scene says where */
    return err;
}

static enum bead_error open_scene(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    if (s->job.configuration) {
        err = bead_session_load_configuration(s, msg);
    } else if (s->job.sheet) {
        err = bead_session_load_sheet(s, msg);
    } else {
        err = load_scene(s, msg);
    }
    if (err)
        return err;
    s->source = s->scene;
    if (s->scene->sweep_count > 0)
        return bead_session_open_sweep(s, msg);
    if (s->job.parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: %s has no sweep that could be parted", s->job.input);
    err = create_chains(s, msg);
    if (!err)
        err = bead_session_find_resolution(s, msg);
    if (!err)
        err = bead_session_list_outputs(s, msg);
    if (!err && s->single)
        err = bead_session_check_single(s, bead_session_single_made(s), msg);
    if (!err)
        err = find_end(s, msg);
    return err ? err : bead_session_create_sinks(s, msg);
}

/* A trajectory, a sweep's file, or a scene. */
static enum bead_error open_input(struct bead_session *s, struct bead_message *msg)
{
    if (s->job.configuration && s->job.sheet)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet shows many configurations, --configuration one: give one of the two");
    if (s->job.frame && (s->job.configuration || s->job.sheet))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--frame: has no effect with --%s", s->job.sheet ? "sheet" : "configuration");
    if (s->job.configuration || !bead_trajectory_is(s->job.input))
        return open_scene(s, msg);
    enum bead_error err = bead_trajectory_begin(s->job.input, &s->trajectory, msg);
    if (err)
        return err;
    if (!s->trajectory)
        return bead_session_open_sweep_file(s, msg);
    return s->job.sheet ? bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: %s is the trajectory of a single run", s->job.input)
                        : bead_session_open_trajectory(s, msg);
}

static enum bead_error begin(struct bead_session *s, const struct bead_job *given, struct bead_message *msg)
{
    enum bead_error err =
        bead_settings_take(&s->job, sizeof s->job, BEAD_SETTINGS_UP_TO(struct bead_job, sinks), given, "bead_job", msg);
    if (err)
        return err;
    const struct bead_job *job = &s->job;
    s->refinement = 1;
    s->kernels = bead_kernels_find(job->instructions);
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    s->threads = job->threads > 0 ? job->threads : cores > 1 ? (int)cores : 1;
    if (!s->kernels)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "--instructions %s: this machine has no such kernels; allowed are portable and, on x86-64, sse2, avx2, "
                         "avx512",
                         job->instructions);
    if (job->config && asprintf(&s->config, "--config=%s", job->config) < 0) {
        s->config = NULL;
        return bead_session_out_of_memory(msg);
    }
    s->job.config = s->config;
    if (!job->input)
        return bead_fail(msg, BEAD_ERROR_USAGE, "no scene given");
    return open_input(s, msg);
}

enum bead_error bead_session_open(const struct bead_job *job, struct bead_session **session, struct bead_message *msg)
{
    *session = NULL;
    struct bead_session *s = calloc(1, sizeof *s);
    if (!s)
        return bead_session_out_of_memory(msg);
    enum bead_error err = begin(s, job, msg);
    if (err == BEAD_ERROR_SCENE)
        bead_session_name_option(&s->job, msg);
    if (err)
        bead_session_close(s);
    else
        *session = s;
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
        free(s->made[i].poster);
    }
    free(s->made);
    free(s->frame_path);
    free(s->config);
    free(s->results);
    free(s->outcomes);
    bead_session_free_sensitivities(s);
    bead_passed_free(&s->passed);
    for (size_t i = 0; s->own_chains && i < s->chain_count; i++)
        bead_chain_destroy(s->own_chains[i]);
    free(s->own_chains);
    bead_trajectory_close(s->trajectory);
    bead_sweep_close(s->sweep);
    bead_scene_free(s->scene);
    free(s);
}
