/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outputs of a session: those of its scene that are asked for, and where their files go. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/kinds/scene_facts.h"
#include "sim/session/session_data.h"
#include "sim/session/session_internal.h"

/* Claims of a session on the files it is going to write: if two runs share a file, the second is refused at its start. */

enum bead_error bead_session_spare_inputs(const struct bead_session *s, const char *file, struct bead_message *msg)
{
    bool same = bead_file_same(file, s->job.input);
    for (size_t i = 0; i < s->job.other_count; i++)
        same = same || bead_file_same(file, s->job.others[i]);
    const char *part;
    for (size_t i = 0; (part = bead_yaml_part(s->source->tree, i)); i++)
        same = same || bead_file_same(file, part);
    return same ? bead_fail(msg, BEAD_ERROR_USAGE, "%s: would replace what it is made of; give another name or directory with -o",
                            file)
                : BEAD_OK;
}

static enum bead_error claim(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    if (bead_session_makes(m) && m->path)
        BEAD_TRY(bead_session_spare_inputs(s, m->path, msg));
    /* The unfinished file of a sweep's results is a journal, which locks itself. */
    if (bead_session_holds_sweep(m) || !bead_session_makes(m))
        return BEAD_OK;
    uint64_t bytes;
    const char *beside = m->sink && m->type->beside ? m->type->beside(m->sink, &bytes) : NULL;
    const char *const files[2] = {m->path, beside};
    for (int i = 0; i < 2 && files[i]; i++) {
        BEAD_TRY(bead_session_spare_inputs(s, files[i], msg));
        BEAD_TRY(bead_file_make_parents(files[i], msg));
        BEAD_TRY(bead_file_claim(files[i], &m->claims[i], msg));
        const char *claimed_by = bead_file_claimed_by(m->claims[i]);
        if (claimed_by && !*s->warning[SESSION_NO_LOCKS])
            snprintf(s->warning[SESSION_NO_LOCKS], sizeof s->warning[SESSION_NO_LOCKS],
                     "this file system has no locks: until the end, files such as %.400s keep other runs away", claimed_by);
    }
    return BEAD_OK;
}

/* A scene may come from a stranger: files that it names stay in the output directory, unless the job allows more. Errors: SCENE. */
static enum bead_error session_check_inside(const struct bead_session *s, const struct bead_output *output, const char *path,
                                            struct bead_message *msg)
{
    if (s->job.allow_outside || !path)
        return BEAD_OK;
    const bool inside = bead_file_is_inside(path);
    if (inside && bead_file_stays_beneath(s->job.output ? s->job.output : ".", path))
        return BEAD_OK;
    return bead_output_wrong(output, msg,
                             "outputs: `%s` leaves the output directory%s; a scene may do so only with --allow-outside", path,
                             inside ? " by a symbolic link" : "");
}

enum bead_error bead_session_claim(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < s->made_count && !err; i++)
        err = claim(s, &s->made[i], msg);
    if (err)
        bead_session_release(s);
    return err;
}

void bead_session_release_output(struct bead_made *m)
{
    for (int c = 0; c < 2; c++) {
        bead_file_release(m->claims[c], c == 0 && m->part != NULL);
        m->claims[c] = NULL;
    }
}

void bead_session_abandon(const struct bead_session *s)
{
    for (size_t i = 0; i < 2 * s->made_count; i++)
        bead_file_abandon(s->made[i / 2].claims[i % 2]);
}

void bead_session_release(struct bead_session *s)
{
    for (size_t i = 0; s->made && i < s->made_count; i++)
        bead_session_release_output(&s->made[i]);
}

const struct bead_sink_type *bead_session_find_type(const struct bead_job *job, const struct bead_output *output, bool of_sweep)
{
    if (output->own)
        return output->own;
    for (const struct bead_sink_type *const *const *list = job->sinks; list && *list; list++) {
        for (const struct bead_sink_type *const *type = *list; *type; type++) {
            const bool fits = !(*type)->write == !of_sweep && (job->frame || !(*type)->one_frame);
            if ((*type)->kind == output->kind && fits)
                return *type;
        }
    }
    return NULL;
}

/* Does the name match: `beads.mp4`, `movies/beads.mp4` or `beads` for movies/beads.mp4? */
static bool is_named(const struct bead_output *output, const char *name)
{
    const char *base = bead_session_base_name(output->path), *dot = strrchr(base, '.');
    size_t stem = dot ? (size_t)(dot - base) : strlen(base);
    return strcmp(name, output->path) == 0 || strcmp(name, base) == 0 || (strlen(name) == stem && strncmp(name, base, stem) == 0);
}

static enum bead_error check_names(const struct bead_session *s, struct bead_message *msg)
{
    for (size_t i = 0; i < s->job.only_count; i++) {
        size_t found = 0;
        char names[512] = "";
        for (size_t o = 0; o < s->source->output_count; o++) {
            const struct bead_output *output = &s->source->outputs[o];
            found += is_named(output, s->job.only[i]);
            bead_list_add(names, sizeof names, ", ", output->path);
        }
        if (found == 0)
            return bead_fail(msg, BEAD_ERROR_USAGE, "--only %s: no output has this name; there are %s", s->job.only[i], names);
    }
    return BEAD_OK;
}

bool bead_session_is_asked(const struct bead_session *s, const struct bead_output *output)
{
    for (size_t i = 0; i < s->job.only_count; i++) {
        if (is_named(output, s->job.only[i]))
            return true;
    }
    return s->job.only_count == 0;
}

const struct bead_output *bead_session_keeper(const struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->output_count; i++) {
        if (bead_output_type(scene->outputs[i].kind)->stores_samples)
            return &scene->outputs[i];
    }
    return NULL;
}

/* ---- where the one output goes that -o or a frame names ---- */

/* "50%", "50 %": a part of the film. */
static bool read_part(const char *text, double *part)
{
    char *end = NULL;
    *part = strtod(text, &end) / 100;
    return end != text && strcmp(end + strspn(end, " "), "%") == 0;
}

static enum bead_error read_frame(const struct bead_session *s, struct bead_frame_asked *frame, struct bead_message *msg)
{
    const char *text = s->job.frame, *unit = bead_chain_time_unit(s->chains[0]);
    *frame = (struct bead_frame_asked){text, NAN, NAN, s->job.still};
    if (strcmp(text, "peak") == 0 || read_part(text, &frame->part))
        return BEAD_OK;
    frame->part = NAN;
    struct bead_units *units = bead_units_create();
    char why[160] = "";
    if (!units)
        return bead_session_out_of_memory(msg);
    enum bead_error err = bead_units_read(units, text, *unit ? unit : NULL, &frame->time, why, sizeof why);
    bead_units_free(units);
    return err ? bead_fail(msg, BEAD_ERROR_USAGE,
                           "--frame: %s; give a time such as 2.1ms, a part of the film such as 50%%, or peak", why)
               : BEAD_OK;
}

/* Leaves only the beads of a film. */
static enum bead_error bare_beads(const struct bead_scene *scene, struct bead_output *output, struct bead_message *msg)
{
    if (!bead_scene_has_beads(scene))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--still poster: %s has no beads to show", scene->file);
    output->views.kinds[0] = BEAD_VIEW_STAGE;
    output->views.count = 1;
    output->views.axes = output->shown.trust = output->movie.race = false;
    output->movie.layout = BEAD_LAYOUT_AUTO;
    output->movie.note_count = 0;
    output->movie.inset = BEAD_INSET_NONE;
    return BEAD_OK;
}

/* A poster, or slides, go beside the movie, wherever `-o FILE` puts it. */
static enum bead_error place_single(const struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    if (!m->type)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: this program does not make such files%s", s->single,
                         s->source->sweep_count > 0 ? " from a sweep" : "");
    m->changed = *m->output;
    m->changed.path = (char *)(uintptr_t)s->single; /* read only; borrowed from the job */
    m->output = &m->changed;
    char **beside = m->changed.movie.slides && *m->changed.movie.slides ? &m->changed.movie.slides : &m->changed.movie.poster;
    const char *path = m->changed.path;
    size_t length = (size_t)(bead_session_base_name(path) - path);
    if (s->job.frame) {
        m->changed.movie.poster = m->changed.movie.slides = NULL;
        if (s->job.still)
            BEAD_TRY(bare_beads(s->source, &m->changed, msg));
        return read_frame(s, &m->frame, msg);
    }
    const size_t count = s->source->output_count - (s->trajectory && bead_session_keeper(s->source) != NULL);
    if (count != 1 && s->job.setting_count > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "-o names one file, but there are %zu outputs: give a directory", count);
    if (!*beside || !**beside || length == 0)
        return BEAD_OK;
    char *directory = strndup(path, length);
    if (!directory)
        return bead_session_out_of_memory(msg);
    enum bead_error err = bead_file_join(directory, *beside, &m->beside, msg);
    free(directory);
    *beside = m->beside;
    return err;
}

/* ---- the list ---- */

/* A file that -o names is not the scene's, and may be anywhere. */
static enum bead_error place(const struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    const bool single = s->single && m == &s->made[s->amid ? s->single_index : 0];
    m->asked = s->single ? single : bead_session_is_asked(s, m->output);
    if (!single)
        BEAD_TRY(session_check_inside(s, m->output, m->output->path, msg));
    BEAD_TRY(session_check_inside(s, m->output, m->output->movie.poster, msg));
    BEAD_TRY(session_check_inside(s, m->output, m->output->movie.slides, msg));
    return single ? place_single(s, m, msg) : BEAD_OK;
}

enum bead_error bead_session_list_outputs(struct bead_session *s, struct bead_message *msg)
{
    const bool alone = s->single && !s->amid;
    BEAD_TRY(check_names(s, msg));
    BEAD_TRY(bead_new(&s->made, s->source->output_count, msg, "a session"));
    s->made_count = alone ? 1 : s->source->output_count;
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        m->output = &s->source->outputs[alone ? s->single_index : i];
        m->name = m->output->path;
        if (!s->sweep_read || !bead_session_holds_sweep(m)) /* else that file exists */
            m->type = bead_session_find_type(&s->job, m->output, s->source->sweep_count > 0);
        BEAD_TRY(place(s, m, msg));
        if (bead_output_type(m->output->kind)->stores_samples && !s->keeper)
            s->keeper = m->output;
    }
    return BEAD_OK;
}

/* ---- what is made, and what cannot be ---- */

bool bead_session_planned(const struct bead_session *s, size_t index, struct bead_planned *planned)
{
    if (index >= s->made_count)
        return false;
    const struct bead_made *m = &s->made[index];
    *planned = (struct bead_planned){.name = m->name, .kind = bead_output_kind_name(m->output), .made = bead_session_makes(m)};
    planned->path = planned->made ? m->path : NULL;
    return true;
}

const char *bead_session_skipped(const struct bead_session *session, size_t index)
{
    for (size_t i = 0; i < session->made_count; i++) {
        const struct bead_made *made = &session->made[i];
        if (made->asked && !made->type && index-- == 0)
            return made->output->path;
    }
    return NULL;
}
