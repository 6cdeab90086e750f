/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which outputs a session has: those of its scene that are asked for. */
#include <stdlib.h>
#include <string.h>

#include "sim/scene/output_kinds.h"
#include "sim/session/session_data.h"

const char *bead_session_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const struct bead_sink_type *bead_session_find_type(const struct bead_job *job, const struct bead_output *output)
{
    for (const struct bead_sink_type *const *const *list = job->sinks; list && *list; list++) {
        for (const struct bead_sink_type *const *type = *list; *type; type++) {
            if ((*type)->kind == output->kind && (job->frame || !(*type)->one_frame))
                return *type;
        }
    }
    return NULL;
}

bool bead_session_is_named(const struct bead_output *output, const char *name)
{
    const char *base = bead_session_base_name(output->path), *dot = strrchr(base, '.');
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
            found += bead_session_is_named(output, s->job.only[i]);
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
        if (bead_session_is_named(output, s->job.only[i]))
            return true;
    }
    return s->job.only_count == 0;
}

struct bead_made *bead_session_single_made(const struct bead_session *s)
{
    return &s->made[s->amid ? s->single_index : 0];
}

/* What -o names instead is not the scene's. */
static enum bead_error place(const struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    const bool single = s->single && m == bead_session_single_made(s);
    enum bead_error err = single ? BEAD_OK : bead_session_check_inside(s, m->output, m->output->path, msg);
    if (!err)
        err = bead_session_check_inside(s, m->output, m->output->movie.poster, msg);
    if (!err && single)
        err = bead_session_place_single(s, m, msg);
    m->asked = s->single ? single : is_asked(s, m->output);
    return err;
}

enum bead_error bead_session_list_outputs(struct bead_session *s, struct bead_message *msg)
{
    const bool alone = s->single && !s->amid;
    enum bead_error err = check_names(s, msg);
    if (err)
        return err;
    s->made = calloc(s->source->output_count + 1, sizeof *s->made);
    if (!s->made)
        return bead_session_out_of_memory(msg);
    s->made_count = alone ? 1 : s->source->output_count;
    for (size_t i = 0; i < s->made_count && !err; i++) {
        struct bead_made *m = &s->made[i];
        m->output = &s->source->outputs[alone ? s->single_index : i];
        err = place(s, m, msg);
        m->type = bead_session_find_type(&s->job, m->output);
        if (bead_output_type(m->output->kind)->stores_samples && !s->keeper)
            s->keeper = m->output;
    }
    return err;
}

/* ---- what is made, and what cannot be ---- */

bool bead_session_planned(const struct bead_session *s, size_t index, struct bead_planned *planned)
{
    if (index >= s->made_count)
        return false;
    const struct bead_made *m = &s->made[index];
    const bool results = s->sweep && bead_session_holds_sweep(m);
    *planned = (struct bead_planned){.name = m->output->path,
                                     .kind = bead_output_key(m->output->kind),
                                     .made = m->asked && (m->sink || m->sweep_type || results)};
    planned->path = planned->made ? m->path : NULL;
    return true;
}

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
