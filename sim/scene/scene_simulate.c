/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `simulate`: until when and how well. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/methods.h"
#include "sim/base/suggest.h"
#include "sim/equation/equation.h"
#include "sim/scene/scene_private.h"

#define SIMULATE(member) offsetof(struct bead_simulate, member)

static enum bead_error read_method(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                   void *settings)
{
    struct bead_simulate *simulate = settings;
    const struct bead_method_info *method;
    struct bead_suggest search;
    const char *text = NULL;
    char all[200] = "auto", shown[64], near[96];
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &text);
    if (err)
        return err;
    bool known = strcmp(text, "auto") == 0;
    bead_suggest_begin(&search, text);
    bead_suggest_try(&search, "auto");
    for (size_t i = 0; (method = bead_method_info(i)); i++) {
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, ", %s", method->name);
        known = known || strcmp(text, method->name) == 0;
        bead_suggest_try(&search, method->name);
    }
    if (!known)
        return bead_wrong(reader, at, "is %s; must be one of %s%s", bead_node_show(at->node, shown, sizeof shown), all,
                          bead_suggest_text(&search, near, sizeof near));
    simulate->method = strdup(text);
    return simulate->method ? BEAD_OK : bead_no_memory(reader);
}

static const struct bead_option rows[] = {
    {.key = "until",
     .offset = SIMULATE(until),
     .unit = "s",
     .initial = "auto",
     .low = 0,
     .high = 1e6,
     .open = BEAD_OPEN_LOW,
     .word = "auto",
     .word_value = NAN,
     .of_motion = true,
     .help =
         "end of the run; auto: when the first pulse has passed the last contact and the last sensor, or later if an output asks "
         "for a later time; in sweeps when the front reaches the end of the chain",
     .example = "2.8 ms"},
    {.key = "accuracy",
     .offset = SIMULATE(accuracy),
     .initial = "1e-6",
     .low = 1e-14,
     .high = 0.1,
     .help =
         "requested relative error of first-passage peak forces; the step follows from it; 1e-10 if not given and a table shows "
         "the energy",
     .example = "1e-8"},
    {.key = "method",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "auto",
     .shape = "auto or a method of --list methods",
     .help = "integrator",
     .example = "rk4",
     .like = "text",
     .read = read_method},
    {.key = "step",
     .offset = SIMULATE(step),
     .unit = "s",
     .of_motion = true,
     .initial = "auto",
     .low = 1e-15,
     .high = 1e3,
     .word = "auto",
     .help = "time step; auto: follows from accuracy",
     .example = "0.1 us"},
    {.key = "verify",
     .type = BEAD_OPTION_FLAG,
     .offset = SIMULATE(verify),
     .initial = "false",
     .help =
         "accuracy as a guarantee: runs with a tenth of the tolerance, and a tenth of that, until two agree about every peak of "
         "contacts and beads to what was asked. Peaks for which they never do are told at the end, with how well they are known; "
         "all "
         "results are written, and the exit status is 1",
     .example = "true"},
};
const struct bead_options bead_simulate_options = {"simulate", "how long and how exactly to compute", BEAD_OPTIONS(rows), NULL,
                                                   NULL};

/* Equations have methods of their own, and no front that ends a run. */
static enum bead_error check_equations(const struct bead_reader *reader, const struct bead_at *at)
{
    const struct bead_simulate *simulate = &reader->scene->simulate;
    struct bead_at until = bead_at_key(at, "until"), method = bead_at_key(at, "method");
    if (isnan(simulate->until))
        return bead_wrong(reader, &until, "is missing: an equation has no end of its own; must be a time, such as 100");
    for (size_t i = 0; i < reader->scene->chain_count && strcmp(simulate->method, "auto") != 0; i++) {
        const struct bead_equation *equation = bead_equation_find(reader->scene->chains[i].equation.name);
        char all[160] = "auto";
        bool known = false;
        for (const char *const *name = equation->methods; name && *name; name++) {
            size_t used = strlen(all);
            snprintf(all + used, sizeof all - used, ", %s", *name);
            known = known || strcmp(*name, simulate->method) == 0;
        }
        if (!known)
            return bead_wrong(reader, &method, "`%s` does not solve the equation %s; must be %s%s", simulate->method,
                              equation->system.name, equation->methods ? "one of " : "", all);
    }
    return BEAD_OK;
}

enum bead_error bead_scene_read_simulate(struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_simulate *simulate = &reader->scene->simulate;
    enum bead_error err = bead_options_read(reader, at, &bead_simulate_options, simulate);
    if (err)
        return err;
    struct bead_at step = bead_at_key(at, "step");
    if (reader->faults && reader->faults->count > 0)
        return BEAD_OK; /* of the chains: nothing to check against */
    err = bead_scene_plain(reader->scene) ? check_equations(reader, at) : BEAD_OK;
    if (err)
        return err;
    struct bead_at verify = bead_at_key(at, "verify");
    if (simulate->verify && simulate->step > 0)
        return bead_wrong(reader, &verify, "chooses the steps itself; must not stand beside `step`");
    if (simulate->verify && bead_scene_plain(reader->scene))
        return bead_wrong(reader, &verify, "is about the peaks of contacts and beads, which equations do not have");
    for (size_t i = 0; i < reader->scene->chain_count; i++) {
        const struct bead_method_info *method = bead_method_find(simulate->method);
        struct bead_at where = bead_at_key(at, "method");
        if (method && !method->damping && reader->scene->chains[i].damping_coefficient > 0)
            return bead_wrong(reader, &where, "`%s` is for forces without damping; must be auto or rk4 here", method->name);
    }
    /* NaN until: not known yet. */
    if (simulate->step > 0 && simulate->until / simulate->step > 1e12)
        return bead_wrong(reader, &step, "gives %.3g steps; must be at least %.3g s for this `until`",
                          simulate->until / simulate->step, simulate->until / 1e12);
    return BEAD_OK;
}
