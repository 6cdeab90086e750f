/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens a trajectory as a session that draws it again. */
#include <stdlib.h>

#include "sim/base/suggest.h"
#include "sim/measure/sink_grid.h"
#include "sim/session/session_data.h"
#include "sim/trajectory/trajectory_data.h"

/* A stored run cannot change: settings may only change how it is shown. */
static enum bead_error check_settings(const struct bead_session *s, struct bead_message *msg)
{
    static const char *const shown[] = {"title", "colour", "label", "name"};
    for (size_t i = 0; i < s->job.setting_count; i++) {
        const char *setting = s->job.settings[i];
        const int length = (int)strcspn(setting, "=");
        char path[200];
        snprintf(path, sizeof path, "%.*s", length, setting);
        const char *dot = strrchr(path, '.'), *key = dot ? dot + 1 : path;
        bool good = strncmp(path, "outputs", 7) == 0;
        for (size_t k = 0; k < sizeof shown / sizeof *shown; k++)
            good = good || strcmp(key, shown[k]) == 0;
        if (!good)
            return bead_fail(msg, BEAD_ERROR_USAGE,
                             "--set:%zu:1: %s: has no effect: %s was computed without this setting; run the scene again", i + 1,
                             path, s->job.input);
    }
    return BEAD_OK;
}

/* A requested time range must lie within the file. */
static enum bead_error check_time(const struct bead_session *s, const struct bead_output *output, struct bead_message *msg)
{
    static const double rounding = 1e-9;
    const double *asked = output->shown.time, start = s->native.start, end = s->end;
    const char *unit = bead_chain_time_unit(s->chains[0]);
    char from[32], to[32], begins[32], ends[32];
    if (!(asked[0] < start - rounding * end) && !(asked[1] > end * (1 + rounding)))
        return BEAD_OK;
    bead_time_text(isnan(asked[0]) ? start : asked[0], unit, from, sizeof from);
    bead_time_text(isnan(asked[1]) ? end : asked[1], unit, to, sizeof to);
    bead_time_text(start, unit, begins, sizeof begins);
    bead_time_text(end, unit, ends, sizeof ends);
    return bead_output_wrong(output, msg, "time: is from %s to %s, but %s goes from %s to %s only", from, to, s->job.input, begins,
                             ends);
}

static enum bead_error check_span(const struct bead_trajectory *t, struct bead_span wanted, struct bead_message *msg)
{
    return wanted.first <= t->span.last && wanted.last >= t->span.first && wanted.first <= wanted.last
               ? BEAD_OK
               : bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s holds beads %zu to %zu only", t->path, t->span.first, t->span.last);
}

/* Limits an output to beads that all files hold. */
static enum bead_error limit_to_files(struct bead_session *s, struct bead_output *output, struct bead_message *msg)
{
    struct bead_span *beads = &output->shown.beads;
    const struct bead_trajectory *t;
    for (size_t i = 0; (t = bead_session_file(s, i)); i++) {
        BEAD_TRY(check_span(t, *beads, msg));
        beads->first = beads->first < t->span.first ? t->span.first : beads->first;
        beads->last = beads->last > t->span.last ? t->span.last : beads->last;
    }
    BEAD_TRY(check_time(s, output, msg));
    if (!(output->shown.time[0] >= s->native.start))
        output->shown.time[0] = s->native.start;
    return BEAD_OK;
}

/* The file must hold the beads that an output needs, up to the end of its chains: no file has values beyond. */
static enum bead_error check_beads(const struct bead_trajectory *t, const struct bead_made *m, struct bead_message *msg)
{
    const struct bead_span *held = &t->span, *needed = &m->needs.beads;
    for (size_t c = 0; c < t->chain_count; c++) {
        const size_t end = bead_chain_beads(t->chains[c]) - 1, last = needed->last < end ? needed->last : end;
        if (m->needs.fields && needed->first <= last && (needed->first < held->first || last > held->last))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s needs beads %zu to %zu, but %s holds beads %zu to %zu only",
                             m->output->path, needed->first, last, t->path, held->first, held->last);
    }
    return BEAD_OK;
}

/* Reports everything that a file lacks at once, so that one more run is enough. Films show beads, which need displacements; their
 * curves and images do not. */
static enum bead_error say_missing(const struct bead_trajectory *t, const struct bead_made *m, unsigned missing,
                                   struct bead_message *msg)
{
    const bool one = (missing & (missing - 1)) == 0;
    const bool of_beads = missing & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) && m->output->kind == BEAD_OUTPUT_MOVIE;
    char names[160] = "";
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        if (missing & BEAD_FIELD_BIT(f))
            bead_list_add(names, sizeof names, ", ", bead_field_info((enum bead_field)f)->name);
    }
    return bead_fail(msg, BEAD_ERROR_UNSUPPORTED,
                     "%s needs the field%s `%s`, which %s does not hold: add %s to `fields` and run again%s", m->output->path,
                     one ? "" : "s", names, t->path, one ? "it" : "them",
                     of_beads ? ", or draw without beads: --set outputs.0.views='[profile, spacetime]'" : "");
}

static enum bead_error check_stored(const struct bead_session *s, const struct bead_made *m, struct bead_message *msg)
{
    const struct bead_trajectory *t;
    if (m->needs.contact_peaks || m->needs.bead_peaks)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: peaks are found while simulating, not from samples: run the scene",
                         m->output->path);
    if (m->needs.budget)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: the energy budget is kept by a run: no trajectory has it",
                         m->output->path);
    if (m->needs.comparison)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED,
                         "%s: `trust` compares two runs, and a trajectory holds one: run the scene, or draw without it: "
                         "--set outputs.0.trust=false",
                         m->output->path);
    for (size_t i = 0; (t = bead_session_file(s, i)); i++) {
        const unsigned missing = m->needs.fields & ~bead_trajectory_fields(t);
        BEAD_TRY(missing ? say_missing(t, m, missing, msg) : check_beads(t, m, msg));
    }
    return BEAD_OK;
}

/* The stored sample at `time`, which must be the time of one. */
static enum bead_error read_stored(const struct bead_stored *stored, double time, unsigned fields, struct bead_sample *sample,
                                   struct bead_message *msg)
{
    const size_t chain = sample->chain;
    const struct bead_grid *grid = bead_trajectory_grid(stored->context);
    const double place = grid->every > 0 ? (time - grid->start) / grid->every : 0, nearest = floor(place + 0.5);
    if (nearest < 0 || fabs(place - nearest) > 1e-3)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the trajectory has no sample at %.9g s", time);
    enum bead_error err = bead_trajectory_read(stored->context, (size_t)nearest, chain, fields, sample, msg);
    sample->chain = chain;
    return err;
}

static struct bead_stored stored_samples(struct bead_trajectory *trajectory)
{
    const struct bead_grid *grid = bead_trajectory_grid(trajectory);
    const size_t count = bead_grid_count(grid); /* fewer than asked for if its run was stopped */
    const double last = count > 0 ? bead_grid_time(grid, count - 1) + 1e-6 * grid->every : -INFINITY;
    return (struct bead_stored){.read = read_stored, .context = trajectory, .last = last};
}

enum bead_error bead_session_open_trajectory(struct bead_session *s, struct bead_message *msg)
{
    struct bead_scene *changed = NULL;
    if (!s->job.output && !s->job.frame)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s is a trajectory: say what to draw with -o FILE (png, pdf, svg, mp4, ...)",
                         s->job.input);
    if (s->job.parts > 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: %s has no sweep to divide", s->job.input);
    BEAD_TRY(check_settings(s, msg));
    const enum bead_source_kind source = s->job.difference        ? BEAD_OF_DIFFERENCE
                                         : s->job.other_count > 0 ? BEAD_OF_TRAJECTORIES
                                                                  : BEAD_OF_TRAJECTORY;
    BEAD_TRY(bead_session_open_others(s, msg));
    const struct bead_scene *stored = bead_trajectory_scene(s->trajectory);
    size_t only = SIZE_MAX;
    BEAD_TRY(s->job.configuration ? bead_session_choose_chain(s, stored, source, &only, &changed, msg)
                                  : bead_session_choose(s, stored, source, NULL, &changed, msg));
    BEAD_TRY(bead_trajectory_settle(s->trajectory, changed, only, msg));
    s->source = bead_trajectory_scene(s->trajectory);
    s->chains = bead_trajectory_chains(s->trajectory, &s->chain_count);
    s->end = s->needed = s->trajectory->end;
    s->native = *bead_trajectory_grid(s->trajectory);
    s->stored = stored_samples(s->trajectory);
    BEAD_TRY(bead_session_join(s, msg));
    BEAD_TRY(bead_session_bound(s, msg));
    BEAD_TRY(bead_session_list_outputs(s, msg));
    struct bead_made *m = s->made;
    if (source == BEAD_OF_TRAJECTORIES)
        m->changed.curves.overlay = true;
    BEAD_TRY(bead_session_find_resolution(s, msg));
    BEAD_TRY(limit_to_files(s, &m->changed, msg));
    BEAD_TRY(bead_session_create_sink(s, m, msg));
    return check_stored(s, m, msg);
}
