/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One row of an option table: where it is, and in words what its value may be. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/suggest.h"
#include "sim/options/options.h"

const struct bead_option *bead_options_row(const struct bead_options *options, size_t index)
{
    if (index < options->count)
        return &options->rows[index];
    index -= options->count;
    for (const struct bead_option_rows *shared = options->shared; shared && shared->rows; shared++) {
        if (index < shared->count)
            return &shared->rows[index];
        index -= shared->count;
    }
    return NULL;
}

const struct bead_option *bead_options_find(const struct bead_options *options, const char *key)
{
    const struct bead_option *row;
    for (size_t i = 0; (row = bead_options_row(options, i)) && strcmp(row->key, key) != 0;)
        i++;
    return row;
}

const char *bead_options_heading(const struct bead_options *options, char *text, size_t size)
{
    if (options->family)
        snprintf(text, size, "%s (%s)", options->family->section, options->name);
    else
        snprintf(text, size, "%s", options->name);
    return text;
}

/* A limit in few characters: "1e12", "100000000" of counts. */
static void limit_words(const struct bead_option *option, double limit, char *text, size_t size)
{
    snprintf(text, size, option->type == BEAD_OPTION_COUNT ? "%.0f" : "%.6g", limit);
    char *plus = strstr(text, "e+");
    if (plus)
        snprintf(plus + 1, size - (size_t)(plus + 1 - text), "%ld", strtol(plus + 2, NULL, 10));
}

bool bead_option_is_bounded(const struct bead_option *option)
{
    return option->type == BEAD_OPTION_COUNT || option->low != 0 || option->high != 0 || option->open;
}

/* "from 0 to 90", "above 0, at most 1", "": the range in words. */
static void range_words(const struct bead_option *option, char *text, size_t size)
{
    bool low_open = option->open & BEAD_OPEN_LOW, high_open = option->open & BEAD_OPEN_HIGH;
    char low[32], high[32];
    text[0] = 0;
    if (!bead_option_is_bounded(option))
        return;
    limit_words(option, option->low, low, sizeof low);
    limit_words(option, option->high, high, sizeof high);
    if (low_open)
        snprintf(text, size, "above %s, %s %s", low, high_open ? "below" : "at most", high);
    else
        snprintf(text, size, "from %s to %s%s", low, high_open ? "below " : "", high);
}

static void number_words(const struct bead_option *option, char *text, size_t size)
{
    char range[120];
    range_words(option, range, sizeof range);
    if (option->shape)
        snprintf(text, size, "%s", option->shape);
    else if (option->type == BEAD_OPTION_COUNT)
        snprintf(text, size, "a whole number %s", range);
    else if (option->unit)
        snprintf(text, size, "%s%s%s", *range ? range : "a number in", " ", option->unit);
    else
        snprintf(text, size, "%s%s", *range ? "a number " : "a number", range);
    if (option->word)
        bead_list_add(text, size, " or ", option->word);
}

const char *bead_option_allowed(const struct bead_option *option, char *text, size_t size)
{
    static const char *const words[] = {[BEAD_OPTION_SEED] = "a whole number",
                                        [BEAD_OPTION_FLAG] = "true or false",
                                        [BEAD_OPTION_TEXT] = "a text",
                                        [BEAD_OPTION_MAP] = "a map",
                                        [BEAD_OPTION_CUSTOM] = ""};
    text[0] = 0;
    if (option->type == BEAD_OPTION_CHOICE) {
        for (size_t i = 0; option->choices[i]; i++)
            bead_list_add(text, size, option->choices[i + 1] ? ", " : " or ", option->choices[i]);
    } else if (!words[option->type]) {
        number_words(option, text, size);
    } else {
        const bool shaped = option->type == BEAD_OPTION_CUSTOM && option->shape;
        snprintf(text, size, "%s", shaped ? option->shape : words[option->type]);
    }
    return text;
}
