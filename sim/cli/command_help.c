/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of options in words: --help, man pages, completion of shells. */
#include <stdio.h>
#include <string.h>

#include "sim/base/suggest.h"
#include "sim/cli/command_line.h"

/* Help text of a row; --list names what this program can list. */
static const char *row_help(const struct command_program *program, const struct command_option *row, char *text, size_t size)
{
    const char *gap = strstr(row->help, "%s");
    if (!gap)
        return row->help;
    const char *words[COMMAND_MOST_WORDS];
    char names[160] = "";
    const size_t count = command_words(program, row, words);
    for (size_t i = 0; i < count; i++)
        bead_list_add(names, sizeof names, i + 1 < count ? ", " : " or ", words[i]);
    snprintf(text, size, "%.*s%s%s", (int)(gap - row->help), row->help, names, gap + 2);
    return text;
}

/* Behind an option, in lines that go on below each other. */
static void print_wrapped(const char *text, FILE *out)
{
    enum { INDENT = 26, WIDTH = 132 - INDENT };
    while (strlen(text) > WIDTH) {
        int length = WIDTH;
        while (length > 0 && text[length] != ' ')
            length--;
        if (length == 0)
            break;
        fprintf(out, "%.*s\n%*s", length, text, INDENT, "");
        text += length + 1;
    }
    fprintf(out, "%s\n", text);
}

/* The options for the file -o, in one paragraph. */
static void print_looks(FILE *out)
{
    char text[512] = "";
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        const size_t used = strlen(text);
        if (row->separators)
            snprintf(text + used, sizeof text - used, "%s--%s %s", used ? ", " : "", row->name, row->argument);
    }
    fputs("  of the file -o:         ", out);
    print_wrapped(text, out);
}

void command_print_help(const struct command_program *program, FILE *out)
{
    char text[256], left[64];
    fprintf(out, "%s - %s\n\n%s\nOptions:\n", program->name, program->purpose, program->usage);
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        char letter[8] = "    ";
        if (!command_offers(program, row) || row->separators)
            continue;
        if (row->letter)
            snprintf(letter, sizeof letter, "-%c, ", row->letter);
        snprintf(left, sizeof left, "%s--%s%s%s", letter, row->name, row->argument ? " " : "", row->argument ? row->argument : "");
        fprintf(out, "  %-22s  ", left);
        print_wrapped(row_help(program, row, text, sizeof text), out);
    }
    if (program->canvases)
        print_looks(out);
    fprintf(
        out,
        "\n%s\nExit status: 0: done; 1: the run failed; 2: the command line or the scene is wrong; 128+N: stopped by signal N.\n",
        program->examples);
}

/* The options as a man page has them. */
void command_print_man(const struct command_program *program, FILE *out)
{
    char text[256];
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        if (!command_offers(program, row))
            continue;
        fputs(".TP\n", out);
        if (row->letter)
            fprintf(out, "\\fB\\-%c\\fR, ", row->letter);
        fprintf(out, "\\fB\\-\\-%s\\fR", row->name);
        if (row->argument)
            fprintf(out, " \\fI%s\\fR", row->argument);
        fputc('\n', out);
        for (const char *c = row_help(program, row, text, sizeof text); *c; c++)
            fputs(*c == '-' ? "\\-" : *c == '\'' ? "\\(aq" : (char[]){*c, 0}, out);
        fputc('\n', out);
    }
}

/* For the completion of shells: a line for each option, "--name -n", its argument where it has one, the values it may have; a tab;
 * help. */
void command_print_words(const struct command_program *program, FILE *out)
{
    const char *words[COMMAND_MOST_WORDS];
    char text[256];
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        if (!command_offers(program, row))
            continue;
        fprintf(out, "--%s %c%c %s", row->name, row->letter ? '-' : '.', row->letter ? row->letter : '.',
                row->argument ? row->argument : ".");
        const size_t count = command_words(program, row, words);
        for (size_t w = 0; w < count; w++)
            fprintf(out, " %s", words[w]);
        fprintf(out, "\t%s\n", row_help(program, row, text, sizeof text));
    }
}

void command_print_version(const struct command_program *program, FILE *out)
{
    fprintf(out, "%s " BEADREEL_VERSION "\nLicence GPL-3.0-or-later: free software, without any warranty.\n", program->name);
}
