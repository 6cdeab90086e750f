/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field along the chain at several times: a panel for each chain. */
#include <math.h>
#include <string.h>

#include "render/draw/words.h"
#include "render/plot/plot_private.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/measure/compacton.h"
#include "sim/measure/profile_times.h"

/* One unit and number of decimals for all times: as many as they need, up to five digits for the last. */
struct time_words {
    int exponent, decimals;
    const char *unit;
};

static struct time_words words_for(const double *times, size_t count, const char *unit)
{
    enum { MOST = 5 };
    const double last = times[count - 1]; /* they ascend */
    struct time_words words = {bead_prefix_exponent(last, unit), 0, unit};
    const double part = bead_power_of_ten(words.exponent), shown = last / part;
    const int whole = shown >= 1 ? (int)floor(log10(shown)) + 1 : 1;
    for (size_t m = 0; m < count; m++) {
        while (whole + words.decimals < MOST && fabs(remainder(times[m] / part, bead_power_of_ten(-words.decimals))) > 1e-7 * shown)
            words.decimals++;
    }
    return words;
}

static void plot_profiles_time_words(const struct time_words *words, double time, char *text, size_t size)
{
    char number[48];
    bead_number(time / bead_power_of_ten(words->exponent), words->decimals, number, sizeof number);
    const char *prefix = *words->unit ? bead_prefix_sign(words->exponent) : "";
    snprintf(text, size, "%.40s%s%s%s", number, *words->unit ? "\u00a0" : "", prefix, words->unit);
}

static bool has_fixed_ends(const struct bead_chain_spec *spec)
{
    return spec->system->has_masses && spec->equation.ends == BEAD_ENDS_FIXED;
}

/* The ends of the plot of a chain: the first and the last bead, or the domain of strings and waves. */
static void find_ends(const struct bead_plot_data *data, size_t c, double ends[2])
{
    const struct bead_chain_spec *spec = bead_chain_spec(data->context.chains[c]);
    const double *places = bead_profile_times_places(data->moments, c);
    const size_t count = bead_profile_times_values(data->moments, c);
    const bool beads = spec->system->has_contacts;
    const size_t cells = count + has_fixed_ends(spec);
    ends[0] = beads ? places[0] : spec->equation.low;
    ends[1] = beads ? places[count - 1] : ends[0] + (double)cells * bead_chain_axis(data->context.chains[c], false).spacing;
}

static void plot_profiles_make_axes(struct bead_plot_data *data)
{
    const struct bead_output *output = data->output;
    for (size_t p = 0; p < data->count; p++) {
        const size_t c = data->parts[p].chain;
        const struct bead_field_info *field = bead_chain_field(data->context.chains[c], output->shown.field);
        const struct bead_chain_axis along = bead_chain_axis(data->context.chains[c], field->of_contacts);
        double ends[2];
        find_ends(data, c, ends);
        data->panels[p].x = (struct bead_graph_axis){along.title, along.unit, ends[0], ends[1], BEAD_SCALE_LINEAR, false};
        data->panels[p].y = (struct bead_graph_axis){field->title,          field->unit,       output->plot.range[0],
                                                     output->plot.range[1], BEAD_SCALE_LINEAR, true};
    }
}

/* Points of a theory's curve. */
enum { POINTS = 121 };

static enum bead_error check_theory(const struct bead_plot_data *data, struct bead_message *msg)
{
    for (size_t p = 0; p < data->count && data->output->shown.theory; p++) {
        if (data->output->shown.field != BEAD_FIELD_CONTACT_FORCE ||
            !bead_compacton_is_of(data->context.chains[data->parts[p].chain]))
            return bead_output_wrong(data->output, msg,
                                     "theory: there is one for `field: contact-force` of equal Hertzian beads, without "
                                     "precompression, tilt, gaps or springs");
    }
    return BEAD_OK;
}

/* Adds a theory's curve over the pulse of moment `m`. */
static void add_theory(struct bead_plot_data *data, struct plot_panel *part, size_t m)
{
    const size_t moments = data->output->curves.profile_time_count;
    const struct bead_chain *chain = data->context.chains[part->chain];
    const double *places = bead_profile_times_places(data->moments, part->chain);
    double *x = part->values + 2 * POINTS * m;
    struct bead_compacton wave;
    if (!bead_compacton_find(chain, bead_profile_times_profile(data->moments, part->chain, m),
                             bead_profile_times_values(data->moments, part->chain), &wave))
        return;
    for (int i = 0; i < POINTS; i++) {
        const double n = wave.centre + 6. * i / (POINTS - 1) - 3;
        x[i] = places[0] + n * (places[1] - places[0]);
        x[POINTS + i] = bead_compacton_at(&wave, n);
    }
    char *label = part->labels[moments + m], speed[48];
    bead_number(wave.speed, 0, speed, sizeof speed);
    snprintf(label, sizeof *part->labels, "long waves, %s\u00a0beads/s", speed);
    plot_add(part, (struct bead_series){.x = x,
                                        .y = x + POINTS,
                                        .count = POINTS,
                                        .mark = BEAD_MARK_LINE,
                                        .colour = 5,
                                        .dash = BEAD_DASH_DOTTED,
                                        .label = m == 0 ? label : NULL});
}

/* Room for a chain's curves that reach the ends of its domain: places, then values at each moment. */
static size_t whole_room(const struct bead_plot_data *data)
{
    size_t most = 0;
    for (size_t c = 0; c < data->context.chain_count; c++) {
        const size_t values = bead_profile_times_values(data->moments, c);
        most = values > most && !bead_chain_spec(data->context.chains[c])->system->has_contacts ? values : most;
    }
    return most > 0 ? (most + 2) * (data->output->curves.profile_time_count + 1) : 0;
}

/* Continues curves to the ends of the domain: a string's fixed ends do not move; if ends are joined, the line from the last point
 * to the first crosses them. The points begin at `x` and `y`, each with room for two more. */
static void reach_ends(const struct bead_plot_data *data, size_t c, double *x, double *y, struct bead_series *series)
{
    const struct bead_chain_spec *spec = bead_chain_spec(data->context.chains[c]);
    const enum bead_field field = data->output->shown.field;
    const bool fixed = has_fixed_ends(spec);
    const size_t last = series->count - 1;
    double ends[2];
    find_ends(data, c, ends);
    const double before = series->x[0] - ends[0], after = ends[1] - series->x[last],
                 both = fixed ? 0 : (after * series->y[0] + before * series->y[last]) / (before + after);
    const bool moves = fixed && field != BEAD_FIELD_DISPLACEMENT && field != BEAD_FIELD_VELOCITY;
    const size_t from = before > 0 && !moves;
    x[0] = ends[0];
    y[0] = both;
    memcpy(x + from, series->x, series->count * sizeof *x);
    memcpy(y + from, series->y, series->count * sizeof *y);
    series->count += from;
    x[series->count] = ends[1];
    y[series->count] = both;
    series->count += !moves;
    series->x = x;
    series->y = y;
}

static enum bead_error plot_profiles_create(struct bead_plot_data *data, struct bead_message *msg)
{
    char time[48];
    data->apart[0] = true;
    const double *times = data->output->curves.profile_times;
    const size_t count = data->output->curves.profile_time_count;
    const bool theory = data->output->shown.theory;
    BEAD_TRY(bead_profile_times_create(data->output, &data->context, &data->moments, msg));
    BEAD_TRY(plot_reserve_chains(data, (theory ? 2 : 1) * count, theory ? 2 * POINTS * count : whole_room(data), msg));
    const struct time_words words = words_for(times, count, bead_chain_time_unit(data->context.chains[0]));
    for (size_t m = 0; m < count; m++) {
        plot_profiles_time_words(&words, times[m], time, sizeof time);
        snprintf(data->parts[0].labels[m], sizeof *data->parts[0].labels, "*t* = %s", time);
    }
    plot_profiles_make_axes(data);
    return BEAD_OK;
}

static void plot_profiles_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    *needs = bead_profile_times_needs(data->moments);
}

static enum bead_error plot_profiles_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_profile_times_feed(data->moments, sample, msg);
}

static enum bead_error plot_profiles_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *msg)
{
    const struct bead_output *output = data->output;
    BEAD_TRY(check_theory(data, msg));
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        const double *places = bead_profile_times_places(data->moments, part->chain);
        size_t count = bead_profile_times_values(data->moments, part->chain);
        for (size_t m = 0; m < output->curves.profile_time_count; m++) {
            struct bead_series *profile =
                plot_add(part, plot_line(places, bead_profile_times_profile(data->moments, part->chain, m), count,
                                         p == 0 ? part->labels[m] : NULL, m));
            if (!bead_chain_spec(data->context.chains[part->chain])->system->has_contacts)
                reach_ends(data, part->chain, part->values, part->values + (m + 1) * (count + 2), profile);
        }
        for (size_t m = 0; output->shown.theory && m < output->curves.profile_time_count; m++)
            add_theory(data, part, m);
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_profiles = {BEAD_SHOW_PROFILES, plot_profiles_create, plot_profiles_needs, plot_profiles_feed,
                                             plot_profiles_finish};
