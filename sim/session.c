/* Sessions, first half: from a job to chains, sinks and needs. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "beadreel/file.h"
#include "beadreel/sweep.h"
#include "sim/run_kinds.h"
#include "sim/session_data.h"
#include "sim/trajectory_data.h"

/* Pictures take the trajectory's samples when they come at least this often, in units of the spacing that shows every
 * oscillation; then the file draws the same picture again. */
static const double coarsest = 8;

void bead_job_default(struct bead_job *job)
{
    *job = (struct bead_job){.threads = 0};
}

enum bead_error bead_session_out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a session");
}

bool bead_output_needs_end(const struct bead_output *output)
{
    bool timed = output->show == BEAD_SHOW_SENSORS || output->show == BEAD_SHOW_PROFILES;
    if (output->kind == BEAD_OUTPUT_PLOT)
        return timed || output->show == BEAD_SHOW_PEAKS;
    return output->kind != BEAD_OUTPUT_TABLE || timed || output->show == BEAD_SHOW_MEASURES;
}

static enum bead_error create_chains(struct bead_session *s, struct bead_message *msg)
{
    s->chain_count = s->scene->chain_count;
    s->own_chains = calloc(s->chain_count, sizeof *s->own_chains);
    if (!s->own_chains)
        return bead_session_out_of_memory(msg);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->chain_count; i++)
        err = bead_chain_create(s->scene, i, &s->own_chains[i], msg);
    s->chains = (const struct bead_chain *const *)s->own_chains;
    return err;
}

enum bead_error bead_session_find_resolution(struct bead_session *s, struct bead_message *msg)
{
    s->resolution = INFINITY;
    for (size_t i = 0; i < s->chain_count; i++) {
        struct bead_pace pace;
        enum bead_error err = bead_run_kind_of(s->chains[i])->pace(s->chains[i], 1, &pace, msg);
        if (err)
            return err;
        s->resolution = fmin(s->resolution, pace.resolution);
    }
    s->twin = bead_run_twin_of(s->chains, s->chain_count);
    return BEAD_OK;
}

struct bead_play bead_session_play(const struct bead_session *s, const char *what)
{
    return (struct bead_play){.chains = s->chains,
                              .chain_count = s->chain_count,
                              .end = s->end,
                              .needed = s->end,
                              .passage = s->passage,
                              .full_window = s->job.full_window,
                              .hash = s->job.hash,
                              .threads = s->threads,
                              .twin = s->twin,
                              .kernels = s->kernels,
                              .what = what,
                              .stop = s->job.stop,
                              .progress = s->job.progress,
                              .progress_context = s->job.progress_context};
}

/* Without `until` somebody must go ahead and see when the last front arrives, unless nobody asks beforehand. */
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
    struct bead_play play = bead_session_play(s, "scouting the end");
    play.hash = false;
    struct bead_passed passed;
    enum bead_error err = bead_play_simulation(&play, &s->counts, &passed, msg);
    double end = 0;
    for (size_t i = 0; !err && i < passed.count; i++)
        end = fmax(end, passed.outcomes[i].front_arrival);
    bead_passed_free(&passed);
    s->end = end;
    return err;
}

/* What can be had of the trajectory: its fields, and forces from displacements of all beads. */
static unsigned kept_fields(const struct bead_session *s)
{
    const struct bead_output *k = s->keeper;
    bool all = k->fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) && k->beads.first == 0 && k->beads.last == SIZE_MAX;
    for (size_t i = 0; i < s->chain_count; i++)
        all = all && !(bead_chain_spec(s->chains[i])->damping_coefficient > 0) && !bead_chain_spec(s->chains[i])->equation.name;
    return all ? k->fields | BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) : k->fields;
}

/* What an output reads of samples. */
static unsigned fields_of(const struct bead_session *s, const struct bead_output *output)
{
    bool shows = output->kind == BEAD_OUTPUT_TABLE || output->kind == BEAD_OUTPUT_PLOT;
    bool modes = shows && output->show == BEAD_SHOW_MODES;
    unsigned fields = shows && output->show != BEAD_SHOW_PROFILES ? 0 : BEAD_FIELD_BIT(output->field);
    for (size_t i = 0; i < output->view_count; i++)
        modes = modes || output->views[i] == BEAD_VIEW_MODES;
    for (size_t c = 0; modes && c < s->chain_count; c++)
        fields |= bead_chain_mode_fields(s->chains[c]);
    return fields ? fields : BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
}

static bool covers(const struct bead_session *s, const struct bead_output *output)
{
    const struct bead_output *k = s->keeper;
    if (output->kind == BEAD_OUTPUT_TABLE && output->show == BEAD_SHOW_MEASURES)
        return false; /* no interval is close enough, but its own */
    unsigned needs = fields_of(s, output);
    double from = isnan(output->time[0]) ? 0 : output->time[0], to = isnan(output->time[1]) ? s->end : output->time[1];
    return k && (kept_fields(s) & needs) == needs && k->beads.first <= output->beads.first && k->beads.last >= output->beads.last &&
           s->native.start <= from && s->native.end >= fmin(to, s->end) * (1 - 1e-9) && s->native.every <= coarsest * s->resolution;
}

enum bead_error bead_session_create_sink(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    m->shared = s->trajectory || (m->output != s->keeper && m->output->every == 0 && covers(s, m->output));
    struct bead_stage stage = {.scene = s->source,
                               .chains = s->chains,
                               .chain_count = s->chain_count,
                               .end = s->end,
                               .native = m->shared ? s->native : (struct bead_grid){0, 0, 0},
                               .resolution = s->resolution,
                               .twin = s->twin,
                               .threads = s->threads,
                               .canvas = s->job.canvas,
                               .directory = s->trajectory || !s->job.output ? "." : s->job.output};
    enum bead_error err = m->type->create(m->output, &stage, &m->sink, msg);
    if (err)
        return err;
    m->type->needs(m->sink, &m->needs);
    size_t last = 0;
    for (size_t i = 0; i < s->chain_count; i++)
        last = bead_chain_beads(s->chains[i]) > last ? bead_chain_beads(s->chains[i]) : last;
    m->needs.beads.last = m->needs.beads.last < last ? m->needs.beads.last : last - 1;
    m->shared = m->shared && s->native.every > 0 && m->needs.grid.every == s->native.every;
    return bead_file_join(stage.directory, m->output->path, &m->path, msg);
}

/* The trajectory output goes first: its samples are the pictures' too. */
static enum bead_error create_sinks(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        bool clock = isfinite(s->end); /* else nothing asked for samples its times */
        if (m->output != s->keeper || !m->type || (!m->asked && !clock))
            continue;
        err = bead_session_create_sink(s, m, msg);
        s->native = m->needs.grid;
        if (!m->asked && !err) { /* excluded, but pictures keep its clock: the same with and without it */
            m->type->destroy(m->sink);
            m->sink = NULL;
        }
    }
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        if (m->output != s->keeper && m->asked && m->type)
            err = bead_session_create_sink(s, m, msg);
    }
    s->needed = 0;
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].sink)
            s->needed = fmax(s->needed, s->made[i].needs.until);
    }
    return err;
}

static enum bead_error open_scene(struct bead_session *s, struct bead_message *msg)
{
    char path[4096];
    enum bead_error err = BEAD_OK;
    if (s->job.configuration) {
        err = bead_session_load_configuration(s, msg);
    } else if (s->job.sheet) {
        err = bead_session_load_sheet(s, msg);
    } else {
        err = bead_scene_find(s->job.input, path, sizeof path, msg);
        if (!err)
            err = bead_scene_load(path, s->job.settings, s->job.setting_count, &s->scene, msg);
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
    if (!err)
        err = find_end(s, msg);
    return err ? err : create_sinks(s, msg);
}

/* A trajectory, a sweep's file, or a scene. */
static enum bead_error open_input(struct bead_session *s, struct bead_message *msg)
{
    if (s->job.configuration && s->job.sheet)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet shows many configurations, --configuration one: give one of the two");
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

enum bead_error bead_session_open(const struct bead_job *job, struct bead_session **session, struct bead_message *msg)
{
    *session = NULL;
    struct bead_session *s = calloc(1, sizeof *s);
    if (!s)
        return bead_session_out_of_memory(msg);
    s->job = *job;
    s->kernels = bead_kernels_find(job->instructions);
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    s->threads = job->threads > 0 ? job->threads : cores > 1 ? (int)cores : 1;
    enum bead_error err = BEAD_OK;
    if (!s->kernels)
        err = bead_fail(msg, BEAD_ERROR_USAGE,
                        "--instructions %s: this machine has no such kernels; allowed are sse2, avx2, avx512", job->instructions);
    else if (!job->input)
        err = bead_fail(msg, BEAD_ERROR_USAGE, "no scene given");
    else
        err = open_input(s, msg);
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
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].sink)
            s->made[i].type->destroy(s->made[i].sink);
        free(s->made[i].path);
    }
    free(s->made);
    free(s->results);
    free(s->outcomes);
    bead_passed_free(&s->passed);
    for (size_t i = 0; s->own_chains && i < s->chain_count; i++)
        bead_chain_destroy(s->own_chains[i]);
    free(s->own_chains);
    bead_trajectory_close(s->trajectory);
    bead_sweep_close(s->sweep);
    bead_scene_free(s->scene);
    free(s);
}
