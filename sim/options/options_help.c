/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help texts and man pages from option tables. */
#include <string.h>

#include "sim/options/options.h"

/* The values that a row allows, pairs included. */
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
    const size_t used = strlen(text);
    if (row->required)
        snprintf(text + used, size - used, "; required");
    else if (default_words(row))
        snprintf(text + used, size - used, "; default %s", default_words(row));
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

void bead_options_help(const struct bead_options *options, FILE *out)
{
    const struct bead_option *row;
    char words[400];
    fprintf(out, "%s: %s\n", bead_options_heading(options, words, sizeof words), options->help);
    for (size_t i = 0; (row = bead_options_row(options, i)); i++) {
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
        man_row(row, out);
}
