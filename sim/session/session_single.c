/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one output that `-o FILE` names, of a scene, a trajectory or a sweep's file, and what the command line says of it. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "beadreel/file.h"
#include "sim/scene/output_kinds.h"
#include "sim/session/session_data.h"

static const char *extension(const char *path)
{
    const char *dot = strrchr(bead_session_base_name(path), '.');
    return dot ? dot + 1 : "";
}

bool bead_session_names_file(const char *output)
{
    struct stat found;
    if (!output || !*bead_session_base_name(output) || (stat(output, &found) == 0 && S_ISDIR(found.st_mode)))
        return false;
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        if (bead_output_ends_like(bead_output_endings(kind), output))
            return true;
    }
    return false;
}

/* ---- which it is ---- */

/* Are files of this kind among `kinds`, or drawings? What a trajectory was made with does not make another one. */
static bool is_made(const struct bead_output *output, const struct bead_file_kind *kinds)
{
    while (kinds->kind != BEAD_OUTPUT_KINDS && kinds->kind != output->kind)
        kinds++;
    return kinds->kind != BEAD_OUTPUT_KINDS || !bead_output_type(output->kind)->stores_samples;
}

/* Has the kind all the keys that the job's options set? */
static bool takes_looks(const struct bead_job *job, const struct bead_output *output, bool sweep)
{
    const struct bead_output_type *type = bead_output_type(output->kind);
    bool all = true;
    for (size_t i = 0; i < job->look_count && all; i++) {
        char key[32];
        snprintf(key, sizeof key, "%.*s", (int)strcspn(job->looks[i], "="), job->looks[i]);
        all = bead_options_find(sweep ? type->sweep_options : type->options, key) != NULL;
    }
    return all;
}

/* How well an output of the scene fits the file: 3 by its name, 0 not at all. Of those with the right ending and the keys asked for
 * the first fits; where keys are asked for, pictures of waves rather than plots. */
static int rank(const struct bead_output *output, const struct bead_job *job, const struct bead_file_kind *kinds, bool sweep)
{
    if (!is_made(output, kinds))
        return 0;
    if (strcmp(bead_session_base_name(output->path), bead_session_base_name(job->output)) == 0)
        return 3;
    if (strcasecmp(extension(output->path), extension(job->output)) != 0 || !takes_looks(job, output, sweep))
        return 0;
    return 1 + (job->look_count > 0 && output->kind == kinds->kind);
}

static bool find(const struct bead_scene *scene, const struct bead_job *job, const struct bead_file_kind *kinds, size_t *index)
{
    int best = 0;
    for (size_t i = 0; i < scene->output_count; i++) {
        const int found = rank(&scene->outputs[i], job, kinds, scene->sweep_count > 0);
        if (found > best)
            *index = i;
        best = found > best ? found : best;
    }
    return best > 0;
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

/* ---- its settings ---- */

/* "--colormap:outputs.0.colormap=grey": an option as the setting that it stands for. */
static char *look_setting(const char *look, size_t index)
{
    char *setting = NULL;
    const int key = (int)strcspn(look, "=");
    return asprintf(&setting, "--%.*s:outputs.%zu.%s", key, look, index, look) < 0 ? NULL : setting;
}

enum bead_error bead_session_settings_make(const struct bead_job *job, size_t index, const char *outputs, const char *first,
                                           struct bead_settings *settings, struct bead_message *msg)
{
    const size_t most = job->setting_count + job->look_count + 3;
    *settings = (struct bead_settings){.all = calloc(most, sizeof *settings->all), .own = calloc(most, sizeof *settings->own)};
    bool good = settings->all && settings->own;
    if (good && job->config)
        settings->all[settings->count++] = job->config;
    if (good && first)
        settings->all[settings->count++] = first;
    if (good && outputs) {
        good = asprintf(&settings->own[0], "--output:outputs=%s", outputs) >= 0;
        settings->own_count += good;
    }
    for (size_t i = 0; i < job->look_count && good; i++) {
        good = (settings->own[settings->own_count] = look_setting(job->looks[i], index)) != NULL;
        settings->own_count += good;
    }
    for (size_t i = 0; i < settings->own_count; i++)
        settings->all[settings->count++] = settings->own[i];
    for (size_t i = 0; i < job->setting_count && good; i++)
        settings->all[settings->count++] = job->settings[i];
    if (good)
        return BEAD_OK;
    bead_session_settings_free(settings);
    return bead_session_out_of_memory(msg);
}

enum bead_error bead_session_load_plain(const struct bead_session *s, const char *path, struct bead_scene **scene,
                                        struct bead_message *msg)
{
    return bead_scene_load(path, &s->job.config, s->job.config != NULL, scene, msg);
}

void bead_session_settings_free(struct bead_settings *settings)
{
    for (size_t i = 0; i < settings->own_count; i++)
        free(settings->own[i]);
    free(settings->own);
    free(settings->all);
    *settings = (struct bead_settings){0};
}

enum bead_error bead_session_single_settings(struct bead_session *s, const struct bead_scene *scene,
                                             const struct bead_file_kind *kinds, struct bead_settings *settings,
                                             struct bead_message *msg)
{
    char *outputs = NULL;
    size_t index = SIZE_MAX;
    *settings = (struct bead_settings){0};
    s->single = s->job.output;
    if (s->job.only_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--only %s: has no effect, since -o names the one file to make: %s", s->job.only[0],
                         s->job.output);
    const bool found = scene && find(scene, &s->job, kinds, &index);
    if (found && s->job.setting_count == 0 && s->job.look_count == 0) {
        s->single_index = index; /* the scene stays as it is, as do the bytes of files that hold its text */
        return bead_session_settings_make(&s->job, 0, NULL, NULL, settings, msg);
    }
    enum bead_error err = found ? bead_scene_single_output(scene, index, &outputs, msg)
                                : bead_session_outputs_for(s->job.output, kinds, &outputs, msg);
    if (!err)
        err = bead_session_settings_make(&s->job, 0, outputs, NULL, settings, msg);
    free(outputs);
    return err;
}

/* The key that a setting ends with: "colormap" of `outputs.0.colormap=grey`, or of a look `colormap=grey`. */
static size_t setting_key(const char *setting, const char **key)
{
    const size_t length = strcspn(setting, "=");
    *key = setting;
    for (size_t i = 0; i < length; i++)
        *key = setting[i] == '.' ? setting + i + 1 : *key;
    return (size_t)(setting + length - *key);
}

/* Replaces what stands before "colormap: ..." in the message. */
static bool name_option(const char *setting, const char *option, size_t number, struct bead_message *msg)
{
    const char *key = NULL, *colon = strstr(msg->text, ": ");
    const size_t length = setting_key(setting, &key);
    if (!colon || strncmp(colon + 2, key, length) != 0 || strncmp(colon + 2 + length, ": ", 2) != 0)
        return false;
    struct bead_message named;
    bead_fail(&named, BEAD_ERROR_SCENE, "--%s:%zu:1: %s", option, number, colon + 2);
    *msg = named;
    return true;
}

void bead_session_name_option(const struct bead_job *job, struct bead_message *msg)
{
    bool named = !msg || strncmp(msg->text, "--", 2) == 0;
    for (size_t i = 0; i < job->look_count && !named; i++) {
        char option[32];
        snprintf(option, sizeof option, "%.*s", (int)strcspn(job->looks[i], "="), job->looks[i]);
        named = name_option(job->looks[i], option, 1, msg);
    }
    for (size_t i = 0; i < job->setting_count && !named; i++)
        named = strncmp(job->settings[i], "outputs.", 8) == 0 && name_option(job->settings[i], "set", i + 1, msg);
}

/* ---- where it goes ---- */

enum bead_error bead_session_check_single(const struct bead_session *s, const struct bead_made *m, struct bead_message *msg)
{
    if (!s->single || m->type || m->sweep_type)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "%s: this program does not make such files%s", m->output->path,
                     s->source->sweep_count > 0 ? " from a sweep" : "");
}

/* A poster goes beside the movie, wherever `-o FILE` puts that. */
enum bead_error bead_session_place_single(const struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    m->changed = *m->output;
    m->changed.path = (char *)(uintptr_t)s->single; /* read only; borrowed from the job */
    m->output = &m->changed;
    const char *path = m->changed.path, *poster = m->changed.movie.poster;
    size_t length = (size_t)(bead_session_base_name(path) - path);
    if (s->job.frame) {
        m->changed.movie.poster = NULL;
        return bead_session_read_frame(s, &m->frame, msg);
    }
    if (s->source->output_count != 1 && s->job.setting_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "-o names one file, but there are %zu outputs: give a directory",
                         s->source->output_count);
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
