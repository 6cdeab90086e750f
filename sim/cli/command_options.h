/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options as those who list them see them: help, man page, completion. */
#ifndef BEADREEL_SIM_CLI_COMMAND_OPTIONS_H
#define BEADREEL_SIM_CLI_COMMAND_OPTIONS_H

#include "sim/cli/command_line.h"

struct command_option {
    const char *name;
    char letter; /* 0: none */
    const char *argument;
    const char *help;         /* one line; %s: the words it takes */
    const char *const *words; /* the only values it takes, NULL-terminated; NULL: any, or as `apply` checks */
    enum bead_error (*apply)(struct command *command, const char *value, struct bead_message *msg);
    const char *separators; /* of what sets a key of the output -o: what stands between the values of a list; "": one value */
};

/* Row i of the table; NULL: there are no more. */
const struct command_option *command_option(size_t i);
/* Does this program have the option? One that does not draw has none for drawing. */
bool command_offers(const struct command_program *program, const struct command_option *row);
/* The only values that an option takes, at most COMMAND_MOST_WORDS of them; returns how many: 0 where any may be tried. */
enum { COMMAND_MOST_WORDS = 16 };
size_t command_words(const struct command_program *program, const struct command_option *row,
                     const char *words[COMMAND_MOST_WORDS]);

#endif
