/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `show`: what plots and tables can show, and which keys go with what. */
#include <string.h>

#include "sim/scene/scene_output.h"

enum { PLOT = 1 << BEAD_OUTPUT_PLOT, TABLE = 1 << BEAD_OUTPUT_TABLE };

static const char no_contacts[] = "peaks are those of contacts between beads, which equations do not have",
                  whole_passage[] = "peaks are those of the first passage";

#define KEYS(...)         \
    (const char *const[]) \
    {                     \
        __VA_ARGS__, NULL \
    }
static const struct bead_show_type shows[BEAD_SHOW_COUNT] = {
    [BEAD_SHOW_SENSORS] = {.keys = KEYS("every", "time", "normalise"),
                           .why_not = "sensors have forces against time, on a linear axis",
                           .ends = PLOT | TABLE},
    [BEAD_SHOW_PEAKS] = {.keys = KEYS("scale"), .why_not = whole_passage, .not_of_equations = no_contacts, .ends = PLOT},
    [BEAD_SHOW_BEAD_PEAKS] = {.keys = KEYS("scale"), .why_not = whole_passage, .not_of_equations = no_contacts},
    [BEAD_SHOW_MEASURES] = {.keys = KEYS("every"), .why_not = "measures describe the whole run", .ends = TABLE, .own_times = true},
    [BEAD_SHOW_MODES] = {.keys = KEYS("every", "time", "modes", "scale"),
                         .why_not = "modes have energies over time",
                         .modes = true},
    [BEAD_SHOW_PROFILES] = {.keys = KEYS("field", "at"),
                            .why_not = "profiles have the times `at`",
                            .ends = PLOT | TABLE,
                            .of_field = true},
    [BEAD_SHOW_CHAIN] = {.keys = KEYS(NULL),
                         .why_not = "a chain at rest has no times",
                         .not_of_equations = "lists beads and contacts, which equations do not have"},
    [BEAD_SHOW_ENERGY] = {.keys = KEYS("every", "time"),
                          .why_not = "the energy budget is one of the whole chain over time",
                          .not_of_equations = "is the budget of beads and contacts, which equations do not have",
                          .ends = TABLE},
    [BEAD_SHOW_SENSITIVITIES] = {.keys = KEYS("contacts"),
                                 .why_not = "sensitivities are those of peaks",
                                 .not_of_equations = "has the derivatives of peaks of contacts, which equations do not have"},
    [BEAD_SHOW_SETUP] = {.drawing = true},
    [BEAD_SHOW_CONTACT] = {.drawing = true},
    [BEAD_SHOW_CELL] = {.drawing = true},
};

const struct bead_show_type *bead_output_show(const struct bead_output *output)
{
    return bead_output_type(output->kind)->shows ? &shows[output->curves.show] : NULL;
}

static bool takes(const struct bead_show_type *show, const char *key)
{
    for (const char *const *k = show->keys; *k; k++) {
        if (strcmp(*k, key) == 0)
            return true;
    }
    return false;
}

/* Keys that only some of them take. */
static enum bead_error check_keys(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    static const char *const keys[] = {"every", "time", "modes", "field", "at", "scale", "normalise", "contacts"};
    const struct bead_show_type *show = bead_output_show(output);
    const struct bead_option *row = bead_options_find(bead_output_type(output->kind)->options, "show");
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        struct bead_at where = bead_at_key(at, keys[k]);
        char homes[120] = "";
        bool plain = (strcmp(keys[k], "scale") == 0 && output->plot.scale == BEAD_SCALE_LINEAR) ||
                     (strcmp(keys[k], "normalise") == 0 && output->plot.normalise == BEAD_NORMALISE_NONE);
        if (where.node == at->node || takes(show, keys[k]) || plain)
            continue;
        for (size_t i = 0; row->choices[i]; i++) {
            size_t used = strlen(homes);
            if (shows[row->values[i]].keys && takes(&shows[row->values[i]], keys[k]))
                snprintf(homes + used, sizeof homes - used, "%s%s", used ? ", " : "", row->choices[i]);
        }
        return bead_wrong(reader, &where, "belongs to `show: %s`; %s", homes, show->why_not);
    }
    return BEAD_OK;
}

/* `at` must lie within the run. */
static enum bead_error check_moments(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "at");
    const char *unit = bead_scene_plain(reader->scene) ? "" : " s";
    double until = reader->scene->simulate.until;
    if (output->curves.profile_time_count == 0)
        return bead_wrong(reader, &where, "is missing: the times of the profiles, such as [0, %g]", *unit ? 1e-3 : 10);
    double last = output->curves.profile_times[output->curves.profile_time_count - 1];
    if (last > until)
        return bead_wrong(reader, &where, "goes to %g%s; must not be later than the end of the run at %g%s", last, unit, until,
                          unit);
    return BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_show)
{
    const struct bead_show_type *show = bead_output_show(output);
    struct bead_at where = bead_at_key(at, "show");
    if (bead_scene_plain(reader->scene) && show->not_of_equations)
        return bead_wrong(reader, &where, "%s", show->not_of_equations);
    if (show->drawing || output->still.panel_count > 0)
        return BEAD_OK;
    enum bead_error err = show->modes ? bead_output_need_modes(reader, &where) : BEAD_OK;
    if (!err && output->curves.show == BEAD_SHOW_SENSORS && !bead_scene_has_sensors(reader->scene))
        return bead_wrong(reader, &where, "shows sensors, but no bead of the chain has a `sensor`");
    if (!err)
        err = check_keys(reader, at, output);
    if (!err && show->of_field)
        err = bead_output_check_field(reader, at, output);
    return err || output->curves.show != BEAD_SHOW_PROFILES ? err : check_moments(reader, at, output);
}

/* A list of rising times. */
BEAD_OUTPUT_READER(bead_output_read_profile_times)
{
    struct bead_output *output = settings;
    struct bead_option number = *option;
    char shown[64];
    number.type = BEAD_OPTION_NUMBER;
    number.shape = NULL;
    if (at->node->kind != BEAD_NODE_LIST || at->node->count == 0 || at->node->count > BEAD_PROFILE_TIMES)
        return bead_wrong(reader, at, "is %s; must be a list of 1 to %d times", bead_node_show(at->node, shown, sizeof shown),
                          BEAD_PROFILE_TIMES);
    for (size_t i = 0; i < at->node->count; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        enum bead_error err = bead_read_number(reader, &element, &number, &output->curves.profile_times[i]);
        if (err)
            return err;
        if (i > 0 && !(output->curves.profile_times[i] > output->curves.profile_times[i - 1]))
            return bead_wrong(reader, &element, "is %g, not later than the one before; times must rise",
                              output->curves.profile_times[i]);
        output->curves.profile_time_count = i + 1;
    }
    return BEAD_OK;
}
