/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `simulate`: how long, and how accurately. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/suggest.h"
#include "sim/equation/equation.h"
#include "sim/integrate/methods.h"
#include "sim/scene/scene_private.h"

#define SIMULATE(member) offsetof(struct bead_simulate, member)

static BEAD_OPTION_READER(read_method)
{
    const char *names[BEAD_CHOICES + 1] = {"auto"};
    struct bead_simulate *simulate = settings;
    const struct bead_method_info *method;
    unsigned found = 0;
    for (size_t i = 0; i + 1 < BEAD_CHOICES && (method = bead_method_info(i)); i++)
        names[i + 1] = method->name;
    BEAD_TRY(bead_read_choice(reader, at, names, &found));
    simulate->method = strdup(names[found]);
    return simulate->method ? BEAD_OK : bead_no_memory(reader);
}

static BEAD_OPTION_READER(read_accuracy)
{
    static const struct bead_option number = {
        .initial = "1e-6", .low = 1e-14, .high = 0.1, .shape = "from 1e-14 to 0.1, or statistical"};
    struct bead_simulate *simulate = settings;
    simulate->statistical = at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, "statistical") == 0;
    simulate->accuracy = 1e-6;
    return simulate->statistical ? BEAD_OK : bead_read_number(reader, at, &number, &simulate->accuracy);
}

static const struct bead_option rows[] = {
    {"until", BEAD_OPTION_NUMBER, SIMULATE(until), BEAD_TIME_OF_MOTION, .initial = "auto", .open = BEAD_OPEN_LOW, .word = "auto",
     .word_value = NAN,
     .help = "end of the run; auto: when the first pulse has passed the last contact and the last sensor, or later if an output "
             "asks for a later time; in sweeps when the front reaches the end of the chain",
     .example = "2.8 ms"},
    {"accuracy", BEAD_OPTION_CUSTOM, .initial = "1e-6", .shape = "from 1e-14 to 0.1, or statistical", .like = "number|statistical",
     .read = read_accuracy,
     .help = "requested relative error of first-passage peak forces; the step follows from it; by default 1e-11 if a table of the "
             "energy is made. statistical: for sweeps of random cells, errors of a hundredth of the standard error of the means, "
             "found with a few of the chains and reported at the end",
     .example = "1e-8"},
    {"method", BEAD_OPTION_CUSTOM, .initial = "auto", .shape = "auto or a method of --list methods", .like = "text",
     .read = read_method, .help = "integrator", .example = "rk4"},
    {"step", BEAD_OPTION_NUMBER, SIMULATE(step), .unit = "s", .usual = {0, 1e-3}, .likely = BEAD_LIKELY("us"), .of_motion = true,
     .initial = "auto", .low = 1e-15, .high = 1e3, .word = "auto", .help = "time step; auto: follows from accuracy",
     .example = "0.1 us"},
    {"verify", BEAD_OPTION_FLAG, SIMULATE(verify), .initial = "false",
     .help = "accuracy as a guarantee: repeats the run with a tenth of the tolerance, and a tenth of that, until two runs agree "
             "about every peak of contacts and beads as well as asked. Peaks on which they never agree are listed at the end, with "
             "how well they are known; all results are written, and the exit status is 1",
     .example = "true"},
};
const struct bead_options bead_simulate_options = {"simulate", "how long and how exactly to compute", BEAD_OPTIONS(rows), NULL,
                                                   NULL};

/* Equations have methods of their own, and no front that ends a run. */
static enum bead_error check_equations(const struct bead_reader *reader, const struct bead_at *at)
{
    const struct bead_simulate *simulate = &reader->scene->simulate;
    if (isnan(simulate->until))
        return BEAD_WRONG_KEY(reader, at, "until", "is missing: an equation has no end of its own; must be a time, such as 100");
    for (size_t i = 0; i < reader->scene->chain_count && strcmp(simulate->method, "auto") != 0; i++) {
        const struct bead_system *system = reader->scene->chains[i].system;
        char all[160] = "auto";
        bool known = false;
        for (const char *const *name = system->equation->methods; name && *name; name++) {
            bead_list_add(all, sizeof all, ", ", *name);
            known = known || strcmp(*name, simulate->method) == 0;
        }
        if (!known)
            return BEAD_WRONG_KEY(reader, at, "method", "`%s` does not solve the equation %s; must be %s%s", simulate->method,
                                  system->name, system->equation->methods ? "one of " : "", all);
    }
    return BEAD_OK;
}

enum bead_error bead_scene_read_simulate(struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_simulate *simulate = &reader->scene->simulate;
    BEAD_TRY(bead_options_read(reader, at, &bead_simulate_options, simulate));
    simulate->accuracy_given = bead_given(at, "accuracy");
    if (reader->faults && reader->faults->count > 0)
        return BEAD_OK; /* in the chains, so there is nothing to check against */
    BEAD_TRY(bead_scene_system(reader->scene)->equation ? check_equations(reader, at) : BEAD_OK);
    if (simulate->statistical && (reader->scene->sweep_count == 0 || simulate->step > 0))
        return BEAD_WRONG_KEY(reader, at, "accuracy",
                              "`statistical` is for sweeps without a `step`; must be from 1e-14 to 0.1 here");
    if (simulate->verify && simulate->step > 0)
        return BEAD_WRONG_KEY(reader, at, "verify", "chooses the steps itself; cannot be combined with `step`");
    if (simulate->verify && !bead_scene_system(reader->scene)->has_contacts)
        return BEAD_WRONG_KEY(reader, at, "verify", "is about the peaks of contacts and beads, which equations do not have");
    for (size_t i = 0; i < reader->scene->chain_count; i++) {
        const struct bead_method_info *method = bead_method_find(simulate->method);
        if (method && !method->damping && reader->scene->chains[i].damping_coefficient > 0)
            return BEAD_WRONG_KEY(reader, at, "method", "`%s` is for forces without damping; must be auto, rk8 or rk4 here",
                                  method->name);
    }
    /* NaN until: not known yet. */
    if (simulate->step > 0 && simulate->until / simulate->step > 1e12)
        return BEAD_WRONG_KEY(reader, at, "step", "gives %.3g steps; must be at least %.3g s for this `until`",
                              simulate->until / simulate->step, simulate->until / 1e12);
    return BEAD_OK;
}
