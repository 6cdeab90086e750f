/* Which outputs a session has: those of its scene that are asked for, or the one that `-o FILE` names. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/file.h"
#include "sim/scene/output_kinds.h"
#include "sim/session/session_data.h"

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

const struct bead_sink_type *bead_session_find_type(const struct bead_job *job, const struct bead_output *output)
{
    for (const struct bead_sink_type *const *const *list = job->sinks; list && *list; list++) {
        for (const struct bead_sink_type *const *type = *list; *type; type++) {
            if ((*type)->kind == output->kind)
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

enum bead_error bead_session_list_outputs(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = check_names(s, msg);
    if (err)
        return err;
    s->made = calloc(s->source->output_count + 1, sizeof *s->made);
    if (!s->made)
        return bead_session_out_of_memory(msg);
    s->made_count = s->source->output_count;
    for (size_t i = 0; i < s->made_count && !err; i++) {
        struct bead_made *m = &s->made[i];
        m->output = &s->source->outputs[i];
        if (!s->job.sheet && !s->job.configuration) /* whose path is that of -o */
            err = bead_session_check_inside(s, m->output, m->output->path, msg);
        if (!err)
            err = bead_session_check_inside(s, m->output, m->output->movie.poster, msg);
        m->type = bead_session_find_type(&s->job, m->output);
        m->asked = is_asked(s, m->output);
        if (bead_output_type(m->output->kind)->stores_samples && !s->keeper)
            s->keeper = m->output;
    }
    return err;
}

/* ---- what cannot be made ---- */

bool bead_session_holds_sweep(const struct bead_made *made)
{
    return bead_output_type(made->output->kind)->stores_sweep;
}

const char *bead_session_skipped(const struct bead_session *session, size_t index)
{
    for (size_t i = 0; i < session->made_count; i++) {
        const struct bead_made *made = &session->made[i];
        bool results = session->sweep && bead_session_holds_sweep(made); /* which every program makes */
        if (made->asked && !made->type && !made->sweep_type && !results && index-- == 0)
            return made->output->path;
    }
    return NULL;
}

/* ---- one file ---- */

const struct bead_output *bead_session_find_again(const struct bead_scene *scene, const char *file)
{
    const struct bead_output *found = NULL;
    for (size_t i = 0; i < scene->output_count; i++) {
        const struct bead_output *output = &scene->outputs[i];
        if (bead_output_type(output->kind)->stores_samples)
            continue;
        if (strcmp(base_name(output->path), base_name(file)) == 0)
            return output;
        if (!found && strcasecmp(extension(output->path), extension(file)) == 0)
            found = output;
    }
    return found;
}

/* A poster goes beside the movie, wherever `-o FILE` puts that. */
static enum bead_error place_poster(struct bead_made *m, struct bead_message *msg)
{
    const char *path = m->changed.path, *poster = m->changed.movie.poster;
    size_t length = (size_t)(base_name(path) - path);
    if (!poster || !*poster || length == 0)
        return BEAD_OK;
    char *directory = strndup(path, length);
    if (!directory)
        return bead_session_out_of_memory(msg);
    enum bead_error err = bead_file_join(directory, poster, &m->poster, msg);
    free(directory);
    m->changed.movie.poster = m->poster;
    return err;
}

enum bead_error bead_session_take_again(struct bead_session *s, const char *from, size_t *index, struct bead_message *msg)
{
    const struct bead_output *again = bead_session_find_again(s->source, s->job.output);
    if (!again)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: cannot draw this from a %s", s->job.output, from);
    s->made = calloc(1, sizeof *s->made);
    if (!s->made)
        return bead_session_out_of_memory(msg);
    s->made_count = 1;
    s->made->changed = *again;
    s->made->changed.path = (char *)(uintptr_t)s->job.output; /* read only; borrowed from the job */
    s->made->output = &s->made->changed;
    s->made->asked = true;
    *index = (size_t)(again - s->source->outputs);
    enum bead_error err = bead_session_check_inside(s, again, again->movie.poster, msg);
    return err ? err : place_poster(s->made, msg);
}

static enum bead_error no_kind(const char *file, const struct bead_file_kind *kinds, struct bead_message *msg)
{
    char names[160] = "";
    for (size_t used = 0; kinds->kind != BEAD_OUTPUT_KINDS && used < sizeof names; kinds++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", bead_output_endings(kinds->kind));
    return bead_fail(msg, BEAD_ERROR_USAGE, "--output: `%s` ends like none of %s", file, names);
}

enum bead_error bead_session_outputs_for(const char *file, const struct bead_file_kind *kinds, char **outputs,
                                         struct bead_message *msg)
{
    const struct bead_file_kind *kind = kinds;
    *outputs = NULL;
    while (kind->kind != BEAD_OUTPUT_KINDS && !bead_output_ends_like(bead_output_endings(kind->kind), file))
        kind++;
    if (kind->kind == BEAD_OUTPUT_KINDS)
        return no_kind(file, kinds, msg);
    char *quoted = calloc(2 * strlen(file) + 1, 1), *to = quoted;
    for (const char *from = file; quoted && *from; from++) {
        if (*from == '"' || *from == '\\')
            *to++ = '\\';
        *to++ = *from;
    }
    int length =
        quoted ? asprintf(outputs, "[{%s: \"%s\"%s}]", bead_output_key(kind->kind), quoted, kind->more ? kind->more : "") : -1;
    free(quoted);
    if (length >= 0)
        return BEAD_OK;
    *outputs = NULL; /* undefined after a failure */
    return bead_session_out_of_memory(msg);
}

enum bead_error bead_session_settings_make(const struct bead_job *job, const char *outputs, const char *first,
                                           struct bead_settings *settings, struct bead_message *msg)
{
    *settings = (struct bead_settings){.all = calloc(job->setting_count + 2, sizeof *settings->all)};
    if (!settings->all || asprintf(&settings->outputs, "outputs=%s", outputs) < 0) {
        free(settings->all);
        *settings = (struct bead_settings){0};
        return bead_session_out_of_memory(msg);
    }
    if (first)
        settings->all[settings->count++] = first;
    settings->all[settings->count++] = settings->outputs;
    for (size_t i = 0; i < job->setting_count; i++)
        settings->all[settings->count++] = job->settings[i];
    return BEAD_OK;
}

void bead_session_settings_free(struct bead_settings *settings)
{
    free(settings->outputs);
    free(settings->all);
}
