/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a session: a scouting run if one is needed, the run itself, and the end of every sink. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/run/behind.h"
#include "sim/session/session_data.h"
#include "sim/session/session_internal.h"

/* Widens the output's range by a sample of a scouting run. */
static enum bead_error widen_range(const struct bead_consumer *c, const struct bead_sample *sample, struct bead_message *msg)
{
    struct bead_made *m = c->context;
    const double *value = sample->field[c->needs.range_field];
    if (!value)
        return BEAD_OK;
    size_t last = c->needs.beads.last < sample->active ? c->needs.beads.last + 1 : sample->active;
    for (size_t j = c->needs.beads.first; j < last; j++) {
        m->range.low = value[j] < m->range.low ? value[j] : m->range.low;
        m->range.high = value[j] > m->range.high ? value[j] : m->range.high;
    }
    return m->type->scout ? m->type->scout(m->sink, sample, msg) : BEAD_OK;
}

/* Finds the range of a field by a run, for sinks that must know it before they begin. */
static enum bead_error scout(struct bead_session *s, struct bead_consumer *consumers, struct bead_message *msg)
{
    struct bead_play p = bead_session_play(s, "scouting ranges");
    size_t count = 0;
    double needed = 0;
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        if (!m->sink || !m->needs.range)
            continue;
        struct bead_consumer *c = &consumers[count++];
        *c = (struct bead_consumer){.needs = m->needs, .take = widen_range, .context = m};
        c->needs.fields = BEAD_FIELD_BIT(m->needs.range_field);
        c->needs.contact_peaks = c->needs.bead_peaks = c->needs.uncertainty = false;
        c->needs.comparison = 0;
        c->needs.checked = false;
        needed = fmax(needed, m->needs.until);
    }
    if (count == 0)
        return BEAD_OK;
    p.consumers = consumers;
    p.consumer_count = count;
    p.needed = needed;
    p.hash = false;
    p.counts = &s->counts;
    BEAD_LEFT_TO(bead_played_free) struct bead_played played;
    return bead_play(&p, &played, msg);
}

static enum bead_error give_to_sink(const struct bead_consumer *consumer, const struct bead_sample *sample,
                                    struct bead_message *msg)
{
    const struct bead_made *made = consumer->context;
    return made->type->sample(made->sink, sample, msg);
}

static enum bead_error session_begin(struct bead_session *s, struct bead_consumer *consumers, size_t *count,
                                     struct bead_message *msg)
{
    *count = 0;
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        if (!m->sink)
            continue;
        BEAD_TRY(m->type->begin(m->sink, m->range, msg));
        bead_session_ask_needs(s, m);
        consumers[(*count)++] =
            (struct bead_consumer){.needs = m->needs, .exact = m->output == s->keeper, .take = give_to_sink, .context = m};
    }
    if (s->strained) /* to judge the model, without uncertainties */
        consumers[(*count)++] = (struct bead_consumer){.needs = {.contact_peaks = true}};
    return BEAD_OK;
}

size_t bead_session_target(const struct bead_session *s)
{
    size_t first = SIZE_MAX;
    if (!s->passage || isfinite(s->end) || s->trajectory || s->job.full_window)
        return 0;
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_needs *n = &s->made[i].needs;
        const bool peaks = n->contact_peaks || n->bead_peaks;
        if (!s->made[i].sink)
            continue;
        if (!peaks || n->fields || n->states || n->budget || n->range || n->deviation || n->sensitivities)
            return 0;
        first = n->beads.first < first ? n->beads.first : first;
    }
    for (size_t i = 0; i < s->chain_count; i++) {
        if (bead_behind_refusal(s->chains[i]))
            return 0;
    }
    return first < SIZE_MAX ? first : 0;
}

/* The run, and another if a sink only found at its end which samples it needs. */
static enum bead_error play_passes(struct bead_session *s, struct bead_play *p, struct bead_message *msg)
{
    bool again;
    enum bead_error err = BEAD_OK;
    do {
        p->needed = s->needed = bead_session_latest(s);
        p->target = bead_session_target(s);
        const struct bead_span seen = {p->target, SIZE_MAX};
        p->peak_span = p->target > 0 && !s->strained ? &seen : NULL;
        size_t behind = BEAD_PLAY_ALIKE;
        err = bead_play_cut(p, &behind, &s->played, msg);
        again = false;
        for (size_t i = 0; !err && i < p->consumer_count; i++) {
            struct bead_made *m = p->consumers[i].context;
            if (!m)
                continue;
            err = m->type->again ? m->type->again(m->sink, &again, msg) : BEAD_OK;
            bead_session_ask_needs(s, m);
            p->consumers[i].needs = m->needs;
        }
        if (again)
            bead_played_free(&s->played);
    } while (again);
    return err;
}

/* The outcomes that sinks get at the end: from the pass, or stored in the trajectory. */
static enum bead_error collect_outcomes(struct bead_session *s, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&s->outcomes, s->chain_count, msg, "outcomes"));
    for (size_t i = 0; i < s->chain_count; i++) {
        size_t number = i;
        const struct bead_trajectory *file = s->trajectory ? bead_session_file_of(s, &number) : NULL;
        if (file)
            BEAD_TRY(bead_trajectory_outcome(file, number, &s->outcomes[i], msg));
        else
            s->outcomes[i] = s->played.outcomes[i];
    }
    return BEAD_OK;
}

static void add_result(struct bead_session *s, const struct bead_made *m, const char *path)
{
    struct bead_result *r = &s->results[s->result_count++];
    *r = (struct bead_result){.path = path,
                              .bytes = m->bytes,
                              .makers = m->type->makers ? m->type->makers(m->sink) : NULL,
                              .name = m->name,
                              .kind = m->type->one_frame ? m->type->name : bead_output_kind_name(m->output)};
    if (m->type->result)
        m->type->result(m->sink, &r->bytes, &r->items);
}

/* The run was stopped: finished files of earlier runs stay, and so do readable parts. */
static enum bead_error session_stop(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    if (!m->type->stop)
        return BEAD_OK;
    BEAD_TRY(m->type->stop(m->sink, s->outcomes, msg));
    BEAD_TRY(bead_file_part_name(m->path, &m->part, msg));
    m->ended = true;
    add_result(s, m, m->part);
    return BEAD_OK;
}

static enum bead_error write_sweep(const struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    const struct bead_sweep_settings settings = bead_session_sweep_settings(s);
    const struct bead_run_context context = bead_session_sweep_context(s, &settings);
    return m->type->write(m->output, &context, m->path, &m->bytes, msg);
}

enum bead_error bead_session_finish(struct bead_session *s, struct bead_made *m, struct bead_message *msg)
{
    BEAD_TRY(m->type->write ? write_sweep(s, m, msg) : m->type->end(m->sink, s->outcomes, msg));
    m->ended = true;
    if (m->bytes == 0) /* the sink does not count them */
        m->bytes = bead_file_bytes(m->path);
    bead_session_release_output(m);
    return BEAD_OK;
}

static void add_results(struct bead_session *s, const struct bead_made *m)
{
    uint64_t bytes = 0;
    add_result(s, m, m->path);
    const char *beside = m->type->beside ? m->type->beside(m->sink, &bytes) : NULL;
    struct bead_result second = {.path = beside, .bytes = bytes, .items = 1};
    second.name = bead_output_second(m->output, &second.kind);
    if (beside && bytes > 0)
        s->results[s->result_count++] = second;
}

/* A sink that cannot leave a part does not prevent others from leaving theirs. */
static enum bead_error stop_all(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error worst = BEAD_OK;
    for (size_t i = 0; i < s->made_count; i++) {
        struct bead_made *m = &s->made[i];
        enum bead_error err = m->sink && !m->ended ? session_stop(s, m, msg) : BEAD_OK;
        worst = worst ? worst : err;
    }
    return worst;
}

/* Posters and long tables take a while after everything is computed. */
static void tell_writing(const struct bead_session *s, const struct bead_made *m)
{
    char what[300];
    const struct bead_progress progress = {.what = what, .time = NAN};
    snprintf(what, sizeof what, "writing %.280s", m->output->path);
    if (s->job.progress)
        s->job.progress(s->job.progress_context, &progress);
}

/* Sinks that work in the background are finished last; results are listed in the order of the scene. Signals may arrive here too:
 * finished files stay. */
enum bead_error bead_session_finish_all(struct bead_session *s, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (int background = 0; background < 2; background++) {
        for (size_t i = 0; !err && i < s->made_count; i++) {
            struct bead_made *m = &s->made[i];
            if (!bead_session_makes(m) || m->ended || m->type->background != background)
                continue;
            if (!background)
                tell_writing(s, m);
            err = bead_session_finish(s, m, msg);
        }
    }
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].ended)
            add_results(s, &s->made[i]);
    }
    struct bead_message unused;
    if (err == BEAD_ERROR_STOPPED)
        (void)stop_all(s, &unused); /* parts that cannot be read are removed */
    return err;
}

void bead_session_find_lost(struct bead_session *s, const struct bead_played *played)
{
    struct bead_message first = {""};
    size_t lost = 0;
    for (size_t i = 0; s->passage && i < played->count; i++) {
        const struct bead_runner *runner = &played->runs[i];
        if (runner->kind->is_lost(runner->run) && lost++ == 0)
            (void)bead_play_lost(runner, &first);
    }
    if (lost > 0)
        snprintf(s->warning[SESSION_LOST], sizeof s->warning[SESSION_LOST], "%.500s%s: its results end there", first.text,
                 lost > 1 ? " (and others like it)" : "");
}

static enum bead_error session_end(struct bead_session *s, bool stopped, struct bead_message *msg)
{
    BEAD_TRY(collect_outcomes(s, msg));
    return stopped ? stop_all(s, msg) : bead_session_finish_all(s, msg);
}

/* Is there a movie? Its frames take most of the time. */
static bool draws_frames(const struct bead_session *s)
{
    bool any = false;
    for (size_t i = 0; i < s->made_count; i++)
        any = any || (s->made[i].sink && s->made[i].type->background);
    return any;
}

static enum bead_error session_run(struct bead_session *s, struct bead_consumer *consumers, struct bead_message *msg)
{
    BEAD_TRY(bead_session_lay(s, msg));
    if (!s->trajectory)
        BEAD_TRY(bead_file_make_directory(s->job.output, msg));
    BEAD_TRY(bead_session_claim(s, msg));
    if (!s->trajectory)
        BEAD_TRY(bead_session_verify(s, msg));
    BEAD_TRY(scout(s, consumers, msg)); /* if stopped there, no sink has begun */
    struct bead_play p = bead_session_play(s, s->trajectory || draws_frames(s) ? "drawing" : "simulating");
    enum bead_error err = session_begin(s, consumers, &p.consumer_count, msg);
    p.consumers = consumers;
    p.counts = &s->counts;
    if (!err)
        err = play_passes(s, &p, msg);
    if (!err && !s->trajectory)
        err = bead_session_find_sensitivities(s, msg);
    if (err && err != BEAD_ERROR_STOPPED)
        return err;
    if (!s->trajectory) {
        bead_session_judge(s, s->chains, s->played.outcomes, s->played.count);
        bead_session_find_lost(s, &s->played);
    }
    if (s->passage && !s->trajectory && !err && !isfinite(s->end))
        s->end = s->played.end;
    struct bead_message unused;
    enum bead_error closing = session_end(s, err != BEAD_OK, err ? &unused : msg);
    return err ? err : closing;
}

enum bead_error bead_session_run_single(struct bead_session *s, struct bead_message *msg)
{
    BEAD_FREED struct bead_consumer *consumers = NULL;
    BEAD_TRY(bead_new(&consumers, s->made_count + 1, msg, "outputs"));
    enum bead_error err = session_run(s, consumers, msg);
    /* Destroys unfinished sinks, which removes their files. */
    for (size_t i = 0; err && i < s->made_count; i++) {
        if (s->made[i].sink && !s->made[i].ended) {
            s->made[i].type->destroy(s->made[i].sink);
            s->made[i].sink = NULL;
        }
    }
    return err;
}

size_t bead_session_results(const struct bead_session *s, const struct bead_result **results)
{
    *results = s->results;
    return s->result_count;
}

const char *bead_session_text(const struct bead_session *s)
{
    return s->source->text;
}

const char *bead_session_time_unit(const struct bead_session *s)
{
    return s->sweep ? "s" : bead_chain_time_unit(s->chains[0]);
}

const struct bead_counts *bead_session_counts(const struct bead_session *s)
{
    return &s->counts;
}

const struct bead_chain *const *bead_session_chains(const struct bead_session *s, size_t *count)
{
    *count = s->chain_count;
    return s->chains;
}

const struct bead_outcome *bead_session_outcomes(const struct bead_session *s, size_t *chain_count)
{
    *chain_count = s->outcomes ? s->chain_count : 0;
    return s->outcomes;
}
