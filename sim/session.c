/* Sessions, first half: from a job to chains, sinks and needs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "beadreel/file.h"
#include "beadreel/sweep.h"
#include "beadreel/trajectory.h"
#include "sim/run_kinds.h"
#include "sim/session_data.h"

/* Pictures take the trajectory's samples when they come at least this often, in units of the spacing that shows every
 * oscillation; then the file draws the same picture again. */
static const double coarsest = 8;

void bead_job_default(struct bead_job *job)
{
    *job = (struct bead_job){.threads = 0};
}

static enum bead_error out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a session");
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const char *extension(const char *path)
{
    const char *dot = strrchr(base_name(path), '.');
    return dot ? dot + 1 : "";
}

bool bead_output_needs_end(const struct bead_output *output)
{
    bool timed = output->show == BEAD_SHOW_SENSORS || output->show == BEAD_SHOW_PROFILES;
    if (output->kind == BEAD_OUTPUT_PLOT)
        return timed || output->show == BEAD_SHOW_PEAKS;
    return output->kind != BEAD_OUTPUT_TABLE || timed || output->show == BEAD_SHOW_MEASURES;
}

bool bead_session_has_extension(const char *const *extensions, const char *path)
{
    if (!extensions)
        return true;
    for (const char *const *e = extensions; *e; e++) {
        if (strcasecmp(*e, extension(path)) == 0)
            return true;
    }
    return false;
}

static const struct bead_sink_type *find_type(const struct bead_job *job, const struct bead_output *output)
{
    for (const struct bead_sink_type *const *const *list = job->sinks; list && *list; list++) {
        for (const struct bead_sink_type *const *type = *list; *type; type++) {
            if ((*type)->kind == output->kind && bead_session_has_extension((*type)->extensions, output->path))
                return *type;
        }
    }
    return NULL;
}

/* `beads.mp4`, `movies/beads.mp4` and `beads` all name the output movies/beads.mp4. */
static bool is_named(const struct bead_output *output, const char *name)
{
    const char *base = base_name(output->path), *dot = strrchr(base, '.');
    size_t stem = dot ? (size_t)(dot - base) : strlen(base);
    return strcmp(name, output->path) == 0 || strcmp(name, base) == 0 || (strlen(name) == stem && strncmp(name, base, stem) == 0);
}

static enum bead_error check_names(const struct bead_session *s, struct bead_message *msg)
{
    for (size_t i = 0; i < s->job.only_count; i++) {
        size_t found = 0, used = 0;
        char names[512] = "";
        for (size_t o = 0; o < s->source->output_count; o++) {
            const struct bead_output *output = &s->source->outputs[o];
            found += is_named(output, s->job.only[i]);
            if (used + strlen(output->path) + 3 < sizeof names)
                used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", output->path);
        }
        if (found == 0)
            return bead_fail(msg, BEAD_ERROR_USAGE, "--only %s: no output has this name; there are %s", s->job.only[i], names);
    }
    return BEAD_OK;
}

static bool is_asked(const struct bead_session *s, const struct bead_output *output)
{
    for (size_t i = 0; i < s->job.only_count; i++) {
        if (is_named(output, s->job.only[i]))
            return true;
    }
    return s->job.only_count == 0;
}

static enum bead_error create_chains(struct bead_session *s, struct bead_message *msg)
{
    s->chain_count = s->scene->chain_count;
    s->own_chains = calloc(s->chain_count, sizeof *s->own_chains);
    if (!s->own_chains)
        return out_of_memory(msg);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->chain_count; i++)
        err = bead_chain_create(s->scene, i, &s->own_chains[i], msg);
    s->chains = (const struct bead_chain *const *)s->own_chains;
    return err;
}

/* The fastest chain says how often a picture must look. */
static enum bead_error find_resolution(struct bead_session *s, struct bead_message *msg)
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

/* The trajectory output goes first: its samples are the pictures' too. */
static enum bead_error create_sink(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
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

static enum bead_error create_sinks(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        bool clock = isfinite(s->end); /* else nothing asked for samples its times */
        if (m->output != s->keeper || !m->type || (!m->asked && !clock))
            continue;
        err = create_sink(s, m, msg);
        s->native = m->needs.grid;
        if (!m->asked && !err) { /* excluded, but pictures keep its clock: the same with and without it */
            m->type->destroy(m->sink);
            m->sink = NULL;
        }
    }
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        if (m->output != s->keeper && m->asked && m->type)
            err = create_sink(s, m, msg);
    }
    s->needed = 0;
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].sink)
            s->needed = fmax(s->needed, s->made[i].needs.until);
    }
    return err;
}

enum bead_error bead_session_list_outputs(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = check_names(s, msg);
    if (err)
        return err;
    s->made_count = s->source->output_count;
    s->made = calloc(s->made_count + 1, sizeof *s->made);
    if (!s->made)
        return out_of_memory(msg);
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        m->output = &s->source->outputs[i];
        m->type = find_type(&s->job, m->output);
        m->asked = is_asked(s, m->output);
        if (m->output->kind == BEAD_OUTPUT_TRAJECTORY && !s->keeper)
            s->keeper = m->output;
    }
    return BEAD_OK;
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
        err = find_resolution(s, msg);
    if (!err)
        err = bead_session_list_outputs(s, msg);
    if (!err)
        err = find_end(s, msg);
    return err ? err : create_sinks(s, msg);
}

/* Which output of the stored scene does `-o file` draw again: the one of that name, else the first of that kind. */
const struct bead_output *bead_session_find_again(const struct bead_scene *scene, const char *file)
{
    const struct bead_output *found = NULL;
    for (size_t i = 0; i < scene->output_count; i++) {
        const struct bead_output *output = &scene->outputs[i];
        if (output->kind == BEAD_OUTPUT_TRAJECTORY)
            continue;
        if (strcmp(base_name(output->path), base_name(file)) == 0)
            return output;
        if (!found && strcasecmp(extension(output->path), extension(file)) == 0)
            found = output;
    }
    return found;
}

static const char *kind_of(const char *file)
{
    static const char *const ends[] = {"mp4", "mkv", "webm", "gif", "apng", "csv", "png", "pdf", "svg"};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        if (strcasecmp(ends[i], extension(file)) == 0)
            return i < 5 ? "movie" : i < 6 ? "table" : "image";
    return NULL;
}

static enum bead_error open_again(struct bead_session *s, const char *const *settings, size_t count, struct bead_message *msg)
{
    bead_trajectory_close(s->trajectory);
    return bead_trajectory_open(s->job.input, settings, count, &s->trajectory, msg);
}

/* The file's scene has no such output: its defaults then, with the user's settings on top. */
static enum bead_error open_with_default(struct bead_session *s, struct bead_message *msg)
{
    size_t count = s->job.setting_count;
    const char *kind = kind_of(s->job.output);
    char *outputs = NULL;
    if (!kind)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "--output: `%s` ends like none of .png, .pdf, .svg, .mp4, .mkv, .webm, .gif, .apng, .csv", s->job.output);
    const char **settings = calloc(count + 1, sizeof *settings);
    int length = asprintf(&outputs, "outputs=[{%s: \"%s\"%s}]", kind, base_name(s->job.output),
                          strcmp(kind, "table") == 0 ? ", show: sensors" : "");
    enum bead_error err = settings && length > 0 ? BEAD_OK : out_of_memory(msg);
    if (!err) {
        settings[0] = outputs;
        for (size_t i = 0; i < count; i++)
            settings[i + 1] = s->job.settings[i];
        err = open_again(s, settings, count + 1, msg);
    }
    free(settings);
    if (length > 0)
        free(outputs);
    return err;
}

/* Only what the file holds. */
static enum bead_error limit_to_file(struct bead_session *s, struct bead_output *output, struct bead_message *msg)
{
    struct bead_span beads = bead_trajectory_beads(s->trajectory);
    if (output->beads.first > beads.last || output->beads.last < beads.first)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s holds beads %zu to %zu only", s->job.input, beads.first, beads.last);
    output->beads.first = output->beads.first < beads.first ? beads.first : output->beads.first;
    output->beads.last = output->beads.last > beads.last ? beads.last : output->beads.last;
    if (!(output->time[0] >= s->native.start))
        output->time[0] = s->native.start;
    return BEAD_OK;
}

/* `index`: of the output in the file's scene. */
static enum bead_error check_stored(const struct bead_session *s, const struct bead_made *m, size_t index, struct bead_message *msg)
{
    unsigned missing = m->needs.fields & ~bead_trajectory_fields(s->trajectory);
    if (m->needs.contact_peaks || m->needs.bead_peaks)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: peaks are found while simulating, not from samples: run the scene",
                         m->output->path);
    if (m->needs.twin)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED,
                         "%s: `trust` compares two runs, and a trajectory holds one: run the scene, or draw without it: "
                         "--set outputs.%zu.trust=false",
                         m->output->path, index);
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        if (missing & BEAD_FIELD_BIT(f))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED,
                             "%s needs the field `%s`, which %s does not hold: add it to `fields` and run again", m->output->path,
                             bead_field_info((enum bead_field)f)->name, s->job.input);
    }
    return BEAD_OK;
}

static enum bead_error open_trajectory(struct bead_session *s, struct bead_message *msg)
{
    if (!s->job.output)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s is a trajectory: say what to draw with -o FILE (png, pdf, svg, mp4, ...)",
                         s->job.input);
    /* As stored first: which output is meant decides what the user's settings are about. */
    enum bead_error err = bead_trajectory_open(s->job.input, NULL, 0, &s->trajectory, msg);
    if (!err && !bead_session_find_again(bead_trajectory_scene(s->trajectory), s->job.output))
        err = open_with_default(s, msg);
    else if (!err && s->job.setting_count > 0)
        err = open_again(s, s->job.settings, s->job.setting_count, msg);
    if (err)
        return err;
    s->source = bead_trajectory_scene(s->trajectory);
    s->chains = bead_trajectory_chains(s->trajectory, &s->chain_count);
    s->end = s->needed = bead_trajectory_end(s->trajectory);
    s->native = *bead_trajectory_grid(s->trajectory);
    const struct bead_output *again = bead_session_find_again(s->source, s->job.output);
    s->made = calloc(1, sizeof *s->made);
    if (!s->made || !again)
        return again ? out_of_memory(msg)
                     : bead_fail(msg, BEAD_ERROR_USAGE, "%s: cannot draw this from a trajectory", s->job.output);
    s->made_count = 1;
    struct bead_made *m = s->made;
    m->changed = *again;
    m->changed.path = (char *)(uintptr_t)s->job.output; /* read only; borrowed from the job */
    m->output = &m->changed;
    m->asked = true;
    m->type = find_type(&s->job, m->output);
    if (!m->type)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: this program does not make such files", s->job.output);
    err = find_resolution(s, msg);
    if (!err)
        err = limit_to_file(s, &m->changed, msg);
    if (!err)
        err = create_sink(s, m, msg);
    return err ? err : check_stored(s, m, (size_t)(again - s->source->outputs), msg);
}

/* A trajectory, a sweep's file, or a scene. */
static enum bead_error open_input(struct bead_session *s, struct bead_message *msg)
{
    bool sweep = bead_sweep_is(s->job.input);
    if (s->job.configuration && s->job.sheet)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--sheet shows many configurations, --configuration one: give one of the two");
    if (sweep && !s->job.configuration)
        return bead_session_open_sweep_file(s, msg);
    if (!sweep && !s->job.configuration && bead_trajectory_is(s->job.input))
        return s->job.sheet ? bead_fail(msg, BEAD_ERROR_USAGE, "--sheet: %s is the trajectory of a single run", s->job.input)
                            : open_trajectory(s, msg);
    return open_scene(s, msg);
}

enum bead_error bead_session_open(const struct bead_job *job, struct bead_session **session, struct bead_message *msg)
{
    *session = NULL;
    struct bead_session *s = calloc(1, sizeof *s);
    if (!s)
        return out_of_memory(msg);
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
