/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the option tables say about themselves. */
#include <string.h>

#include "sim/scene/options.h"

static void add(char *text, size_t size, const char *more)
{
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s", more);
}

/* A limit in few characters: "1e12", "100000000" of counts. */
static void limit_words(const struct bead_option *option, double limit, char *text, size_t size)
{
    snprintf(text, size, option->type == BEAD_OPTION_COUNT ? "%.0f" : "%.6g", limit);
    char *plus = strstr(text, "e+");
    if (plus)
        memmove(plus + 1, plus + (plus[2] == '0' ? 3 : 2), strlen(plus + 2) + 1 - (plus[2] == '0'));
}

/* "from 0 to 90", "above 0, at most 1", "": the range in words. */
static void range_words(const struct bead_option *option, char *text, size_t size)
{
    bool low_open = option->open & BEAD_OPEN_LOW, high_open = option->open & BEAD_OPEN_HIGH;
    char low[32], high[32];
    text[0] = 0;
    if (option->low == 0 && option->high == 0 && !option->open)
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
    if (option->word) {
        add(text, size, " or ");
        add(text, size, option->word);
    }
}

const char *bead_option_allowed(const struct bead_option *option, char *text, size_t size)
{
    text[0] = 0;
    switch (option->type) {
    case BEAD_OPTION_NUMBER:
    case BEAD_OPTION_PAIR:
    case BEAD_OPTION_COUNT:
        number_words(option, text, size);
        break;
    case BEAD_OPTION_SEED:
        add(text, size, "a whole number");
        break;
    case BEAD_OPTION_FLAG:
        add(text, size, "true or false");
        break;
    case BEAD_OPTION_TEXT:
        add(text, size, "a text");
        break;
    case BEAD_OPTION_CHOICE:
        for (size_t i = 0; option->choices[i]; i++) {
            add(text, size, i == 0 ? "" : option->choices[i + 1] ? ", " : " or ");
            add(text, size, option->choices[i]);
        }
        break;
    case BEAD_OPTION_CUSTOM:
        add(text, size, option->shape ? option->shape : "");
        break;
    }
    return text;
}

/* What may stand for the value, pairs included. */
static void value_words(const struct bead_option *row, char *text, size_t size)
{
    const char *pair = row->type == BEAD_OPTION_PAIR ? "[a, b], each " : "";
    snprintf(text, size, "%s", pair);
    bead_option_allowed(row, text + strlen(pair), size - strlen(pair));
}

/* NULL: none worth mentioning. */
static const char *default_words(const struct bead_option *row)
{
    return !row->required && row->initial && *row->initial && strcmp(row->initial, "{}") != 0 ? row->initial : NULL;
}

/* "(from 0 to 10 N; default 0 N)". */
static void describe(const struct bead_option *row, char *text, size_t size)
{
    value_words(row, text, size);
    if (row->required) {
        add(text, size, "; required");
    } else if (default_words(row)) {
        add(text, size, "; default ");
        add(text, size, default_words(row));
    }
}

/* A value that is not the default: the row's own, or one that follows from its type. NULL: none. */
static const char *example_words(const struct bead_option *row)
{
    if (row->example)
        return row->example;
    if (row->type == BEAD_OPTION_FLAG)
        return row->initial && strcmp(row->initial, "true") == 0 ? "false" : "true";
    if (row->type == BEAD_OPTION_CHOICE)
        return row->initial && strcmp(row->initial, row->choices[0]) == 0 && row->choices[1] ? row->choices[1] : row->choices[0];
    return NULL;
}

static bool hidden(const struct bead_option *row)
{
    return row->type == BEAD_OPTION_CUSTOM && !row->shape;
}

const char *bead_options_heading(const struct bead_options *options, char *text, size_t size)
{
    if (options->family)
        snprintf(text, size, "%s (%s)", options->family->section, options->name);
    else
        snprintf(text, size, "%s", options->name);
    return text;
}

void bead_options_help(const struct bead_options *options, FILE *out)
{
    const struct bead_option *row;
    char words[400];
    fprintf(out, "%s: %s\n", bead_options_heading(options, words, sizeof words), options->help);
    for (size_t i = 0; (row = bead_options_row(options, i)); i++) {
        if (hidden(row))
            continue;
        describe(row, words, sizeof words);
        fprintf(out, "  %-15s %s\n  %-15s   (%s)\n", row->key, row->help, "", words);
    }
}

static void man_text(const char *text, FILE *out)
{
    for (const char *c = text; *c; c++) {
        if (*c == '-')
            fputs("\\-", out);
        else if (*c == '\'')
            fputs("\\(aq", out);
        else if (*c == '\\')
            fputs("\\e", out);
        else
            fputc(*c, out);
    }
}

/* "Value: from 0 to 10 N. Default: 0 N. Example: force: 1 N." */
static void man_row(const struct bead_option *row, FILE *out)
{
    char words[400];
    fputs(".TP\n.B ", out);
    man_text(row->key, out);
    fputc('\n', out);
    man_text(row->help, out);
    value_words(row, words, sizeof words);
    fputs(".\n.br\nValue: ", out);
    man_text(words, out);
    if (row->required)
        fputs(". Required", out);
    if (default_words(row)) {
        fputs(". Default: ", out);
        man_text(default_words(row), out);
    }
    if (example_words(row)) {
        fputs(". Example: \\fB", out);
        man_text(row->key, out);
        fputs(": ", out);
        man_text(example_words(row), out);
        fputs("\\fR", out);
    }
    fputs(".\n", out);
}

void bead_options_man(const struct bead_options *options, FILE *out)
{
    const struct bead_option *row;
    char words[100];
    fputs(".SS ", out);
    man_text(bead_options_heading(options, words, sizeof words), out);
    fputc('\n', out);
    man_text(options->help, out);
    fputs(".\n", out);
    for (size_t i = 0; (row = bead_options_row(options, i)); i++)
        if (!hidden(row))
            man_row(row, out);
}
