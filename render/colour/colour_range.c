/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the range of colours of a picture, and its colour map, from the output's settings and the values shown. */
#include "render/colour/colour_range.h"
#include "sim/chain/chain_internal.h"

#include <math.h>

/* A logarithmic scale without a given lower end begins at this part of the largest value. */
static const double log_span = 1e-4;
/* An event is left out if the typical values are below this part of it; the range then ends at this multiple of them. */
static const double hides = 0.5, headroom = 1.05;
/* Values of one sign may include smaller ones of the other, up to this part of the largest, from errors or small waves. */
static const double ripple = 0.05;
/* Samples seldom hit a maximum: from this part of a round number, the range ends at the number. */
static const double nearly = 0.99;
/* Waves that move forces by less than this part of the static one have colours from 0: chosen, as labels of seven digits and more
 * have no room. */
static const double still = 1e-6;

/* The next one-digit number (1, 2, ... 10 times a power of ten) if `size` is nearly that: the bar then ends with a labelled tick.
 */
static double rounded(double size)
{
    if (!(size > 0) || !isfinite(size))
        return size;
    double unit = pow(10, floor(log10(size))), above = ceil(size / unit) * unit;
    return isfinite(above) && size > nearly * above ? above : size;
}

static void automatic(enum bead_scale scale, bool is_signed, double least, double largest, double *low, double *high)
{
    double size = fmax(fabs(least), fabs(largest));
    if (!(least <= largest) || !(size > 0)) {
        *low = 0;
        *high = 1;
    } else if (is_signed || fmin(-least, largest) > ripple * size) {
        *high = rounded(size);
        *low = -*high;
    } else {
        *low = 0 - rounded(fmax(0, -least));
        *high = rounded(fmax(0, largest));
    }
    if (scale == BEAD_SCALE_LOG) {
        *high = *high > 0 ? *high : 1;
        *low = log_span * *high;
    }
}

/* The largest magnitude of an event that hides the rest; 0: none. */
static double find_hidden(const struct bead_colours_asked *asked, const struct bead_shown_values *values)
{
    double size = fmax(fabs(values->least), fabs(values->largest));
    bool given = !isnan(asked->range[0]) || !isnan(asked->range[1]);
    return !given && values->typical > 0 && values->typical < hides * size ? fmax(size, values->peak) : 0;
}

double bead_colour_range_rest(const struct bead_chain *const *chains, size_t count, enum bead_field field)
{
    const double rest = count > 0 ? bead_chain_spec(chains[0])->precompression : 0;
    for (size_t i = 0; i < count; i++) {
        if (bead_chain_spec(chains[i])->precompression != rest || bead_chain_spec(chains[i])->tilt != 0)
            return 0;
    }
    return field == BEAD_FIELD_FORCE || field == BEAD_FIELD_CONTACT_FORCE ? rest : 0;
}

bool bead_colour_range_signed(const struct bead_output *output, const struct bead_chain *chain)
{
    return bead_chain_signed(chain, output->shown.field) && output->sweep_curves.show != BEAD_SWEEP_DEVIATION;
}

/* As wide to both sides, if the contacts stay closed. */
static bool find_about_rest(const struct bead_colours_asked *asked, const struct bead_shown_values *values,
                            struct bead_colour_range *range)
{
    const double rest = values->rest, away = values->away;
    if (!isnan(asked->range[0]) || !isnan(asked->range[1]) || asked->scale == BEAD_SCALE_LOG || !(away > still * rest) ||
        !(away < rest))
        return false;
    const bool hidden = values->usually_away > still * rest && values->usually_away < hides * away;
    const double half = hidden ? headroom * values->usually_away : away, slack = 1e-9 * half;
    *range = (struct bead_colour_range){.low = rest - half,
                                        .high = rest + half,
                                        .over = values->largest > rest + half + slack,
                                        .under = values->least < rest - half - slack,
                                        .hidden = hidden ? fmax(values->largest, values->peak) : 0,
                                        .rest = rest};
    return true;
}

struct bead_colours bead_colour_range_colours(const struct bead_output *output, const struct bead_colour_range *range,
                                              const struct bead_colormap *map)
{
    return (struct bead_colours){map, range->rest > 0 ? BEAD_SCALE_LINEAR : output->colours.scale, range->low, range->high,
                                 range->rest};
}

struct bead_colour_range bead_colour_range_find(const struct bead_colours_asked *asked, bool is_signed,
                                                const struct bead_shown_values *values)
{
    const double least = values->least, largest = values->largest;
    struct bead_colour_range range = {.high = 1, .hidden = find_hidden(asked, values)};
    if (find_about_rest(asked, values, &range))
        return range;
    const double most = range.hidden > 0 ? headroom * values->typical : INFINITY;
    automatic(asked->scale, is_signed, fmax(least, -most), fmin(largest, most), &range.low, &range.high);
    bool low_given = !isnan(asked->range[0]), high_given = !isnan(asked->range[1]);
    range.high = high_given ? asked->range[1] : range.high;
    if (low_given)
        range.low = asked->range[0];
    else if (high_given && asked->scale == BEAD_SCALE_LOG)
        range.low = log_span * range.high;
    if (!(range.high > range.low)) { /* all values lie beyond the requested end */
        double size = fmax(fabs(range.low), 1e-12);
        range.high = high_given ? range.high : range.low + size;
        range.low = high_given ? range.high - size : range.low;
    }
    double slack = 1e-9 * (range.high - range.low);
    range.over = largest > range.high + slack;
    range.under = least < range.low - (asked->scale == BEAD_SCALE_LOG ? 0 : slack);
    return range;
}

void bead_colour_range_ends(const struct bead_output *output, const struct bead_chain *chain, const struct bead_colour_range *found,
                            bool *over, bool *under)
{
    bool both = bead_colour_range_signed(output, chain) || found->low > 0;
    bool given = !isnan(output->colours.range[0]) && !isnan(output->colours.range[1]);
    *over = given || found->over;
    *under = given ? both && output->colours.scale != BEAD_SCALE_LOG : found->under;
}

static bool has_own_map(const struct bead_output *output)
{
    return output->colours.colormap && strcmp(output->colours.colormap, "auto") != 0;
}

static enum bead_error load_map(const struct bead_output *output, const char *name, struct bead_colormap *map,
                                struct bead_message *msg)
{
    struct bead_message why = {""};
    const enum bead_error err = bead_colormap_load(name, map, &why);
    if (err == BEAD_ERROR_SCENE)
        return bead_output_wrong(output, msg, "colormap: %.500s", why.text);
    return err ? bead_fail(msg, err, "%s", why.text) : BEAD_OK;
}

enum bead_error bead_colour_range_check(const struct bead_output *output, struct bead_message *msg)
{
    struct bead_colormap map;
    return has_own_map(output) ? load_map(output, output->colours.colormap, &map, msg) : BEAD_OK;
}

enum bead_error bead_colour_range_map(const struct bead_output *output, const struct bead_chain *chain, bool dark, bool about_rest,
                                      struct bead_colormap *map, struct bead_message *msg)
{
    static const char *const own[2][2] = {{"ember", "inferno"}, {"dawn", "dusk"}}; /* zero looks like the page */
    const bool signs = about_rest || (bead_colour_range_signed(output, chain) && !(output->colours.range[0] >= 0));
    return load_map(output, has_own_map(output) ? output->colours.colormap : own[signs][dark], map, msg);
}
