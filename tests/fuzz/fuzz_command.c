/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: command lines, a word a line. Accepted ones say what to do, and with which file. */
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "sim/cli/command_line.h"
#include "tests/fuzz/fuzz.h"

enum { WORDS = 32 };

static const char *const canvases[] = {"plain", NULL};
static const struct command_list lists[] = {{"scenes", command_list_scenes}, {"keys", command_list_keys}, {NULL, NULL}};
static const struct command_program program = {.name = "beadreel", .lists = lists, .canvases = canvases};

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = strndup((const char *)data, size), *rest = text, *words[WORDS + 1] = {"beadreel"};
    const char *settings[WORDS + 1], *only[WORDS + 1], *parts[WORDS + 1];
    char *looks[WORDS + 1];
    int count = 1;
    for (char *word; count < WORDS && (word = strsep(&rest, "\n"));)
        words[count++] = word;
    struct bead_message msg = {""};
    struct command command = {.program = &program, .settings = settings, .only = only, .parts = parts, .looks = looks};
    BEAD_DEFAULT(&command.job);
    optind = 0; /* getopt begins anew */
    const enum bead_error err = command_parse(&command, count, words, &msg);
    fuzz_result(err, &msg, !err);
    if (!err) {
        fuzz_accept(data, size);
        const bool runs = command.action == COMMAND_RUN || command.action == COMMAND_PLAN;
        fuzz_must(!runs || (command.job.input && *command.job.input), "what runs has a scene");
        fuzz_must(command.job.part <= command.job.parts, "part K of N");
        fuzz_must(command.job.threads >= 0 && command.job.threads <= 1024, "a number of threads");
    }
    for (size_t i = 0; i < command.job.look_count; i++)
        free(looks[i]);
    free(text);
    fuzz_leaks();
    return 0;
}
