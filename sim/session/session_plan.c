/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --plan: what a session will compute, what it skips, and why. */

#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/chain/chain_data.h"
#include "sim/equation/equation.h"
#include "sim/session/session_data.h"

/* Times as people write them: microseconds or milliseconds for beads, no unit for equations. */
struct words {
    char text[32];
};

static struct words time_words(const struct bead_session *s, double time, bool milli)
{
    struct words words;
    if (!*bead_chain_time_unit(s->chains[0]))
        snprintf(words.text, sizeof words.text, "%.6g", time);
    else if (milli || time >= 1e-3)
        snprintf(words.text, sizeof words.text, "%.6g ms", 1e3 * time);
    else
        snprintf(words.text, sizeof words.text, "%.4g us", 1e6 * time);
    return words;
}

static void plan_chain(const struct bead_session *s, size_t index, const struct bead_pace *pace, FILE *out)
{
    const struct bead_chain *c = s->chains[index];
    const char *name = bead_chain_name(c);
    const struct bead_system *system = bead_chain_spec(c)->system;
    fprintf(out, "chain %s%s%s%s%zu %s", name, *name ? ": " : "", system->label, *system->label ? ", " : "", bead_chain_beads(c),
            system->points);
    if (system->has_contacts)
        fprintf(out, ", %zu contacts", bead_chain_contacts(c));
    if (*bead_chain_spins(c))
        fprintf(out, ", M = %.4g", bead_chain_magnetism(c));
    fprintf(out, "; %s", pace->method);
    if (pace->why)
        fprintf(out, " (%s)", pace->why);
    fprintf(out, " with steps %s %s", pace->variable ? "from" : "of", time_words(s, pace->step, false).text);
    double end = fmin(s->end, s->needed);
    if (isfinite(end))
        fprintf(out, ", %s%.0f of them", pace->variable ? "at most about " : "", ceil(end / pace->step * (1 - 1e-9)));
    fprintf(out, "\n");
}

/* The least memory that long chains take, and whether a run would be refused for lack of it. */
static void plan_memory(const struct bead_session *s, FILE *out)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i < s->chain_count && !s->trajectory; i++)
        bytes += bead_chain_bytes(s->chains[i]);
    if (bytes <= BEAD_MEMORY_SMALL)
        return;
    const uint64_t left = bead_memory_left();
    fprintf(out, "memory: %.3g GB at least, for the beads", 1e-9 * (double)bytes);
    if (bytes > left)
        fprintf(out, "; only %.3g GB are free: a run would be refused", 1e-9 * (double)left);
    fprintf(out, "\n");
}

static void plan_time(const struct bead_session *s, FILE *out)
{
    if (s->trajectory)
        fprintf(out, "time: samples of a run of %s are read; nothing is simulated\n", time_words(s, s->end, true).text);
    else if (!isfinite(s->end))
        fprintf(out, "time: until the first pulse has passed the end; no output needs the end time in advance: no scouting run\n");
    else if (s->needed < s->end)
        fprintf(out, "time: stops at %s of %s: no output needs more\n", time_words(s, s->needed, true).text,
                time_words(s, s->end, true).text);
    else if (s->passage && s->extended)
        fprintf(out, "time: until %s, the latest that an output asks for\n", time_words(s, s->end, true).text);
    else if (s->passage)
        fprintf(out, "time: until the first pulse has passed the end, at %s (found by a scouting run without samples)\n",
                time_words(s, s->end, true).text);
    else
        fprintf(out, "time: %s as asked\n", time_words(s, s->end, true).text);
}

static const char *plan_fields(unsigned fields, char *text, size_t size)
{
    text[0] = '\0';
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        if (fields & BEAD_FIELD_BIT(f))
            bead_list_add(text, size, ", ", bead_field_info((enum bead_field)f)->name);
    }
    return text;
}

/* The source of samples at the trajectory's times; --only may leave the trajectory out. */
static const char *plan_sharing(const struct bead_session *s, const struct bead_made *m)
{
    if (!m->shared || s->trajectory)
        return "";
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].output == s->keeper && s->made[i].sink)
            return " (shared with the trajectory)";
    }
    return " (at the times of the trajectory that is skipped)";
}

static void plan_output(const struct bead_session *s, const struct bead_made *m, FILE *out)
{
    if (!m->sink) {
        fprintf(out, "output %s: skipped: %s\n", m->output->path,
                m->asked       ? "this program makes data only"
                : s->job.frame ? "not asked for (--frame)"
                               : "not asked for (--only)");
        return;
    }
    const struct bead_needs *n = &m->needs;
    uint64_t bytes;
    const char *beside = m->type->beside ? m->type->beside(m->sink, &bytes) : NULL;
    char fields[128];
    fprintf(out, "output %s: %s\n", m->path, n->why ? n->why : m->type->help);
    if (n->grid.every > 0 && n->fields) {
        struct bead_grid g = n->grid;
        char closer[80] = "";
        if (n->each > 1) {
            g.every *= (double)n->each;
            snprintf(closer, sizeof closer, ", and %zu times as many of the check run", n->each);
        }
        const size_t count = bead_grid_count(&g);
        fprintf(out, "  samples: %s of %s %zu to %zu, %zu time%s%s%s%s until %s%s%s\n",
                plan_fields(n->fields, fields, sizeof fields), bead_chain_spec(s->chains[0])->system->points, n->beads.first,
                n->beads.last, count, count == 1 ? "" : "s", g.times ? "" : " every ",
                g.times ? "" : time_words(s, g.every, false).text, g.widens ? " at first" : "", time_words(s, g.end, true).text,
                plan_sharing(s, m), closer);
    } else {
        fprintf(out, "  samples: none\n");
    }
    if (n->contact_peaks || n->bead_peaks)
        fprintf(out, "  maxima of every %s's force%s, found between steps\n", n->contact_peaks ? "contact" : "bead",
                s->passage ? " until the front reaches the end" : "");
    if (beside)
        fprintf(out, "  beside it: %s\n", beside);
    if (n->range)
        fprintf(out, "  a scouting run over the same samples finds the range of colours\n");
}

/* The outputs that ask for a comparison run, and its accuracy or step. */
static enum bead_error plan_comparison(const struct bead_session *s, FILE *out, struct bead_message *msg)
{
    const struct bead_simulate *asked = &s->source->simulate;
    const struct bead_play play = bead_session_play(s, "planning");
    size_t count = 0;
    bool samples = false;
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        samples |= m->sink && m->needs.comparison;
        if (m->sink && (m->needs.comparison || m->needs.uncertainty))
            fprintf(out, "%s %s of %s", count++ ? "," : "comparison run:", m->needs.comparison ? "trust" : "uncertainties",
                    m->path);
    }
    if (count == 0)
        return BEAD_OK;
    struct bead_pace pace;
    const double factor = bead_play_comparison_factor(&play, samples);
    BEAD_TRY(bead_run_kind_of(s->chains[0])->pace(s->chains[0], asked, factor, &pace, msg));
    fprintf(out, " needs all chains a second time, for comparison: ");
    if (!(asked->step > 0))
        fprintf(out, "accuracy %.3g instead of %.3g, ", factor * asked->accuracy, asked->accuracy);
    fprintf(out, "steps of %s%s\n", time_words(s, pace.step, false).text,
            !samples && factor > 1 && !(asked->step > 0) ? "; a third one if many peaks respond strongly" : "");
    return BEAD_OK;
}

/* The outputs that ask for a check run. */
static void plan_checks(const struct bead_session *s, FILE *out)
{
    const struct bead_play play = bead_session_play(s, "planning");
    const struct bead_equation *equation = bead_chain_spec(s->chains[0])->system->equation;
    size_t count = 0;
    for (size_t i = 0; i < s->made_count; i++) {
        if (s->made[i].sink && s->made[i].needs.checked)
            fprintf(out, "%s%s", count++ ? ", " : "check run: uncertainties of ", s->made[i].path);
    }
    if (count > 0 && equation && equation->by_grid)
        fprintf(out, ": all chains once more, on three quarters as many cells\n");
    else if (count > 0)
        fprintf(out, ": all chains once more, with %g of the %s\n", bead_play_check_factor(&play),
                s->source->simulate.step > 0 ? "step" : "tolerance");
}

/* The outputs that ask for derivatives, and the cost. */
static void plan_sensitivities(const struct bead_session *s, FILE *out)
{
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        if (m->sink && m->needs.sensitivities)
            fprintf(out, "sensitivities of %s: all chains once more, with steps for peaks to 2e-9, and back over them\n", m->path);
        if (m->sink && m->needs.deviation)
            fprintf(out, "deviations of %s: all chains once more, and back over the steps for each peak\n", m->path);
    }
}

/* The work that is skipped because no output needs it. */
static void plan_skips(const struct bead_session *s, FILE *out)
{
    bool file = false, graphics = false, samples = false;
    for (size_t i = 0; i < s->made_count; i++) {
        const struct bead_made *m = &s->made[i];
        if (!m->sink)
            continue;
        file = file || bead_output_type(m->output->kind)->stores_samples;
        graphics = graphics || bead_output_type(m->output->kind)->draws;
        samples = samples || (m->needs.grid.every > 0 && m->needs.fields);
    }
    if (!samples)
        fprintf(out, "skipped: samples (no output reads any)\n");
    if (!file)
        fprintf(out, "skipped: HDF5 (no trajectory output)\n");
    if (!graphics)
        fprintf(out, "skipped: drawing (no picture asked for)\n");
    const size_t target = bead_session_target(s);
    if (target > 0)
        fprintf(out, "skipped: beads too far behind the front to affect contact %zu: no output sees them\n", target);
    if (!s->trajectory && bead_chain_spec(s->chains[0])->system->has_striker)
        fprintf(out, "skipped: beads ahead of the front, until it comes (exactly at rest)%s\n",
                s->job.full_window ? ": computed all the same, as asked" : "");
}

enum bead_error bead_session_plan(const struct bead_session *s, FILE *out, struct bead_message *msg)
{
    if (s->sweep)
        return bead_session_plan_sweep(s, out, msg);
    for (size_t i = 0; i < s->chain_count; i++) {
        struct bead_pace pace;
        BEAD_TRY(bead_run_kind_of(s->chains[i])->pace(s->chains[i], &s->source->simulate, 1, &pace, msg));
        plan_chain(s, i, &pace, out);
    }
    for (size_t k = 0; k < s->source->fit.count; k++) {
        const struct bead_fit_key *key = &s->source->fit.keys[k];
        fprintf(out, "fit: %s = %.6g +- %.2g%s%s, from %zu measured values\n", key->path, key->value, key->error,
                *key->unit ? " " : "", key->unit, s->source->fit.points);
    }
    plan_memory(s, out);
    plan_time(s, out);
    if (s->exacting)
        fprintf(out, "accuracy: %.3g instead of the default, for %s\n", s->source->simulate.accuracy, s->exacting->path);
    for (size_t i = 0; i < s->made_count; i++)
        plan_output(s, &s->made[i], out);
    BEAD_TRY(plan_comparison(s, out, msg));
    plan_checks(s, out);
    plan_sensitivities(s, out);
    plan_skips(s, out);
    return BEAD_OK;
}
