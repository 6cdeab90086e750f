/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the sinks of a session and decides which samples each takes: its own, or the trajectory output's. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/view_kinds.h"
#include "sim/session/session_data.h"

/* Pictures use the trajectory's samples if their spacing is at most this, in units of the spacing that shows every oscillation; the
 * same picture can then be drawn from the file. */
static const double coarsest = 8;

enum bead_error bead_session_out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a session");
}

enum bead_error bead_session_lay(struct bead_session *s, struct bead_message *msg)
{
    for (size_t i = 0; s->own_chains && i < s->chain_count; i++)
        BEAD_TRY(bead_chain_lay(s->own_chains[i], msg));
    return BEAD_OK;
}

bool bead_output_needs_end(const struct bead_output *output)
{
    const struct bead_show_type *show = bead_output_show(output);
    return !show || show->ends >> output->kind & 1;
}

enum bead_error bead_session_find_resolution(struct bead_session *s, struct bead_message *msg)
{
    s->resolution = INFINITY;
    for (size_t i = 0; i < s->chain_count; i++) {
        struct bead_pace pace;
        BEAD_TRY(bead_run_kind_of(s->chains[i])->pace(s->chains[i], &s->source->simulate, 1, &pace, msg));
        s->resolution = fmin(s->resolution, pace.resolution);
    }
    s->tolerance_factor = bead_run_tolerance_factor(s->chains, s->chain_count, &s->source->simulate);
    return BEAD_OK;
}

struct bead_play bead_session_play(const struct bead_session *s, const char *what)
{
    return (struct bead_play){.chains = s->chains,
                              .chain_count = s->chain_count,
                              .stored = s->trajectory ? &s->stored : NULL,
                              .simulate = s->verified.accuracy > 0 ? &s->verified : &s->source->simulate,
                              .end = s->end,
                              .needed = s->end,
                              .passage = s->passage ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE,
                              .full_window = s->job.full_window,
                              .hash = s->job.hash,
                              .threads = s->threads,
                              .refinement = 1,
                              .tolerance_factor = s->tolerance_factor,
                              .kernels = s->kernels,
                              .what = what,
                              .stop = s->job.stop,
                              .progress = s->job.progress,
                              .progress_context = s->job.progress_context};
}

struct bead_sweep_settings bead_session_sweep_settings(const struct bead_session *s)
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

struct bead_run_context bead_session_sweep_context(const struct bead_session *s, const struct bead_sweep_settings *settings)
{
    return (struct bead_run_context){.scene = s->source,
                                     .threads = s->threads,
                                     .canvas = s->job.canvas,
                                     .stop = s->job.stop,
                                     .claimed = true,
                                     .sweep = s->sweep,
                                     .sweep_settings = settings};
}

/* The fields that a trajectory output gives: those stored, and those that follow from displacements of all beads. */
static unsigned kept_fields(const struct bead_session *s)
{
    const struct bead_output *k = s->keeper;
    const bool all = k->trajectory.fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) && k->shown.beads.first == 0 &&
                     k->shown.beads.last == SIZE_MAX;
    return k->trajectory.fields | (all ? bead_chains_derivable((const struct bead_chain *const *)s->chains, s->chain_count) : 0);
}

static unsigned fields_of(const struct bead_session *s, const struct bead_output *output)
{
    const struct bead_show_type *show = bead_output_show(output);
    bool modes = (show && show->modes) || bead_views_any(&output->views, BEAD_SHOWS_MODES);
    unsigned fields = show && !show->of_field ? 0 : BEAD_FIELD_BIT(output->shown.field);
    for (size_t c = 0; modes && c < s->chain_count; c++)
        fields |= bead_chain_mode_fields(s->chains[c]);
    if (output->curves.contacts.all && !bead_field_info(output->shown.field)->of_contacts)
        fields |= BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE);
    return fields ? fields : BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
}

static bool covers(const struct bead_session *s, const struct bead_output *output)
{
    const struct bead_output *k = s->keeper;
    const struct bead_show_type *show = bead_output_show(output);
    if (show && show->own_times)
        return false;
    unsigned needs = fields_of(s, output);
    double from = isnan(output->shown.time[0]) ? 0 : output->shown.time[0],
           to = isnan(output->shown.time[1]) ? s->end : output->shown.time[1];
    return k && (kept_fields(s) & needs) == needs && k->shown.beads.first <= output->shown.beads.first &&
           k->shown.beads.last >= output->shown.beads.last && s->native.start <= from &&
           s->native.end >= fmin(to, s->end) * (1 - 1e-9) && s->native.every <= coarsest * s->resolution;
}

static bool is_made(const void *asker, const struct bead_output *output)
{
    const struct bead_session *s = asker;
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].output == output)
            return s->made[i].ended;
    }
    return false;
}

void bead_session_ask_needs(const struct bead_session *s, struct bead_made *m)
{
    size_t last = 0;
    m->type->needs(m->sink, &m->needs);
    for (size_t i = 0; i < s->chain_count; i++)
        last = bead_chain_beads(s->chains[i]) > last ? bead_chain_beads(s->chains[i]) : last;
    m->needs.beads.last = m->needs.beads.last < last ? m->needs.beads.last : last - 1;
    if (m->needs.until == 0 && (m->needs.contact_peaks || m->needs.bead_peaks || m->needs.states))
        m->needs.until = INFINITY;
}

double bead_session_latest(const struct bead_session *s)
{
    double latest = 0;
    for (size_t i = 0; i < s->made_count; i++)
        latest = s->made[i].sink ? fmax(latest, s->made[i].needs.until) : latest;
    return latest;
}

enum bead_error bead_session_create_sink(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    m->shared = s->trajectory || (m->output != s->keeper && m->output->shown.every == 0 && covers(s, m->output));
    struct bead_run_context context = {.scene = s->source,
                                       .chains = s->chains,
                                       .chain_count = s->chain_count,
                                       .end = s->end,
                                       .native = m->shared ? s->native : (struct bead_grid){.every = 0},
                                       .resolution = s->resolution,
                                       .tolerance_factor = s->tolerance_factor,
                                       .threads = s->threads,
                                       .canvas = s->job.canvas,
                                       .stop = s->job.stop,
                                       .replayed = s->trajectory != NULL,
                                       .difference = s->joined && s->job.difference,
                                       .bounds = s->bounds,
                                       .is_made = is_made,
                                       .asker = s,
                                       .claimed = true,
                                       .frame = m->frame.text ? &m->frame : NULL,
                                       .directory = s->trajectory || !s->job.output ? "." : s->job.output};
    if (m->type->looks_at_beads && m->type->looks_at_beads(m->output, &context))
        BEAD_TRY(bead_session_lay(s, msg));
    BEAD_TRY(m->type->create(m->output, &context, &m->sink, msg));
    bead_session_ask_needs(s, m);
    m->shared = m->shared && s->native.every > 0 && !m->needs.grid.times && m->needs.grid.every == s->native.every;
    return bead_file_join(context.directory, m->output->path, &m->path, msg);
}

/* The trajectory output is created first, since pictures use its samples if they can. */
enum bead_error bead_session_create_sinks(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        bool clock = isfinite(s->end); /* else no output has set sample times */
        if (m->output != s->keeper || !m->type || (!m->asked && !clock))
            continue;
        err = bead_session_create_sink(s, m, msg);
        s->native = m->needs.grid;
        if (!m->asked &&
            !err) { /* --only leaves it out, but pictures keep its sample times, so that they look the same with and without it */
            m->type->destroy(m->sink);
            m->sink = NULL;
        }
    }
    for (size_t i = 0; !err && i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        if (m->output != s->keeper && m->asked && m->type)
            err = bead_session_create_sink(s, m, msg);
    }
    s->needed = bead_session_latest(s);
    return err;
}
