/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words about the horizon, from a full sentence to one word, as much as fits: below headings in stills, beside the time in movies.
 */

#include <math.h>

#include "render/draw/words.h"
#include "render/view/horizon.h"

/* In units of the label's size: the sample of the line before the words. */
static const double key_length = 1.6, key_gap = 0.5;

struct bead_trust bead_trust_make(const struct bead_chain *chain, double tolerance_factor)
{
    const struct bead_simulate *asked = &bead_chain_scene(chain)->simulate;
    bool steps = asked->step > 0;
    double first = steps ? asked->step : asked->accuracy;
    return (struct bead_trust){.until = INFINITY,
                               .chain = "",
                               .steps = steps,
                               .first = first,
                               .second = tolerance_factor * first,
                               .unit = bead_chain_time_unit(chain)};
}

/* Rounds down to three digits: never later than the horizon. */
static void trust_time_words(double time, const char *unit, char *text, size_t size)
{
    double shown = time / bead_power_of_ten(bead_prefix_exponent(time, unit));
    double digit = bead_power_of_ten(shown >= 100 ? 0 : shown >= 10 ? -1 : -2);
    bead_quantity(time > 0 ? floor(shown / digit * (1 + 1e-12)) * digit * (time / shown) : 0, unit, 3, text, size);
}

/* "1e-5" */
static void accuracy_words(double accuracy, char *text, size_t size)
{
    double exponent = floor(log10(accuracy) + 1e-9);
    snprintf(text, size, "%.2ge%.0f", accuracy / pow(10, exponent), exponent);
}

/* "of accuracy 1e-6 and 1e-5" */
static void runs_words(const struct bead_trust *trust, char *text, size_t size)
{
    char first[64] = "", second[64] = "";
    if (trust->steps) {
        bead_quantity(trust->first, trust->unit, 3, first, sizeof first);
        bead_quantity(trust->second, trust->unit, 3, second, sizeof second);
    } else {
        accuracy_words(trust->first, first, sizeof first);
        accuracy_words(trust->second, second, sizeof second);
    }
    snprintf(text, size, "%s %s and %s", trust->steps ? "with steps of" : "of accuracy", first, second);
}

enum { SHORTER = 4 };

/* The text after the verdict, from the full one (0) to none (SHORTER - 1); %s: the runs. */
static const char *const beyond[SHORTER] = {": beyond the line two runs %s differ by more than 1\u00a0% of the range",
                                            ": then runs %s differ by more than 1\u00a0%",
                                            ": then two runs differ by over 1\u00a0%", ""};
static const char *const at_once[SHORTER] = {": from the start two runs %s differ by more than 1\u00a0% of the range",
                                             ": runs %s differ by more than 1\u00a0%", ": two runs differ by over 1\u00a0%", ""};
static const char *const nowhere[SHORTER] = {": two runs %s nowhere differ by more than 1\u00a0% of the range",
                                             ": runs %s differ by less than 1\u00a0%", ": two runs differ by less than 1\u00a0%",
                                             ""};

void bead_trust_say(const struct bead_trust *trust, int shorter, char *markup, size_t size)
{
    char time[64] = "", runs[160], where[200] = "", name[120];
    bool throughout = !isfinite(trust->until), never = trust->until <= trust->from;
    const char *const *rest = throughout ? nowhere : never ? at_once : beyond, *at = strstr(rest[shorter], "%s");
    int before = at ? (int)(at - rest[shorter]) : 0;
    if (!throughout && !never)
        trust_time_words(trust->until, trust->unit, time, sizeof time);
    runs_words(trust, runs, sizeof runs);
    bead_text_escape(trust->chain, name, sizeof name);
    if (*name)
        snprintf(where, sizeof where, " (%s)", name);
    snprintf(markup, size, "%s%s%s%s%s%.*s%s%s", trust->bold ? "<b>" : "",
             throughout ? "predictable throughout"
             : never    ? "not predictable"
                        : "predictable until ",
             time, trust->bold ? "</b>" : "", where, before, rest[shorter], at ? runs : "", at ? at + 2 : rest[shorter]);
}

void bead_trust_draw(cairo_t *cr, const struct bead_look *look, const struct bead_trust *trust, struct bead_rect rect, bool right)
{
    struct bead_text_style style = {
        .family = look->family, .size = look->label, .colour = look->ink, .across = BEAD_ALIGN_START, .down = BEAD_ALIGN_MIDDLE};
    char markup[1024];
    double em = look->label, key = isfinite(trust->until) ? (key_length + key_gap) * em : 0, width = 0, height;
    for (int shorter = 0; shorter < SHORTER; shorter++) {
        bead_trust_say(trust, shorter, markup, sizeof markup);
        bead_text_size(cr, &style, markup, &width, &height);
        if (key + width <= rect.width)
            break;
    }
    if (key + width > rect.width) { /* the verdict is never left out, but set in smaller type */
        style.size *= rect.width / (key + width);
        key *= rect.width / (key + width);
        bead_text_size(cr, &style, markup, &width, &height);
    }
    double x = right ? rect.x + rect.width - key - width : rect.x, y = rect.y + 0.5 * rect.height;
    if (key > 0) {
        cairo_new_path(cr);
        cairo_move_to(cr, x, y);
        cairo_rel_line_to(cr, key_length / (key_length + key_gap) * key, 0);
        bead_horizon_stroke(cr, look);
    }
    bead_text_draw(cr, &style, x + key, y, markup);
}
