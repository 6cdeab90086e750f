/* `show`: what plots and tables can show, and which keys go with what. */
#include <string.h>

#include "sim/equation/equation.h"
#include "sim/scene/scene_output.h"

enum { PLOT = 1 << BEAD_OUTPUT_PLOT, TABLE = 1 << BEAD_OUTPUT_TABLE };

/* One row a value of `show` (but drawings, which have keys of their own): kinds of outputs that show it; the keys besides those of
 * all that it takes. */
static const struct show {
    const char *name;
    unsigned kinds;
    const char *const *keys;
    const char *why_not; /* it takes no others */
} shows[] = {
    [BEAD_SHOW_SENSORS] = {"sensors", PLOT | TABLE, (const char *const[]){"every", "time", "normalise", NULL},
                           "the axis of sensors is linear"},
    [BEAD_SHOW_PEAKS] = {"peaks", PLOT | TABLE, (const char *const[]){"scale", NULL}, "peaks are those of the whole first passage"},
    [BEAD_SHOW_BEAD_PEAKS] = {"bead-peaks", TABLE, (const char *const[]){"scale", NULL},
                              "peaks are those of the whole first passage"},
    [BEAD_SHOW_MEASURES] = {"measures", TABLE, (const char *const[]){"every", NULL}, "measures are those of the whole run"},
    [BEAD_SHOW_MODES] = {"modes", PLOT | TABLE, (const char *const[]){"every", "time", "modes", "scale", NULL},
                         "modes have energies over time"},
    [BEAD_SHOW_PROFILES] = {"profiles", PLOT | TABLE, (const char *const[]){"field", "at", NULL},
                            "profiles are those of the times `at`"},
    [BEAD_SHOW_CHAIN] = {"chain", TABLE, (const char *const[]){NULL}, "a chain at rest has no times"},
};
enum { SHOWS = sizeof shows / sizeof *shows };

static bool takes(const struct show *show, const char *key)
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
    static const char *const keys[] = {"every", "time", "modes", "field", "at", "scale", "normalise"};
    const struct show *show = &shows[output->show];
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        struct bead_at where = bead_at_key(at, keys[k]);
        char homes[120] = "";
        bool plain = (strcmp(keys[k], "scale") == 0 && output->scale == BEAD_SCALE_LINEAR) ||
                     (strcmp(keys[k], "normalise") == 0 && output->normalise == BEAD_NORMALISE_NONE);
        if (where.node == at->node || takes(show, keys[k]) || plain)
            continue;
        for (size_t i = 0; i < SHOWS; i++) {
            size_t used = strlen(homes);
            if (shows[i].name && (shows[i].kinds & 1u << output->kind) && takes(&shows[i], keys[k]))
                snprintf(homes + used, sizeof homes - used, "%s%s", used ? ", " : "", shows[i].name);
        }
        return bead_wrong(reader, &where, "belongs to `show: %s`; %s", homes, show->why_not);
    }
    return BEAD_OK;
}

static bool has_modes(const struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->chain_count; i++) {
        const char *name = scene->chains[i].equation.name;
        if (!name || !bead_equation_find(name)->system.modes)
            return false;
    }
    return true;
}

static enum bead_error check_modes(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at views = bead_at_key(at, "views"), show = bead_at_key(at, "show");
    bool shown = output->kind == BEAD_OUTPUT_PLOT || output->kind == BEAD_OUTPUT_TABLE ? output->show == BEAD_SHOW_MODES : false;
    bool viewed = bead_views_any(output->views, output->view_count, BEAD_SHOWS_MODES);
    if (viewed && output->kind == BEAD_OUTPUT_IMAGE)
        return bead_wrong(reader, &views, "modes are a view of movies; {plot: FILE, show: modes} has their energies over time");
    if ((shown || viewed) && !has_modes(reader->scene))
        return bead_wrong(reader, shown ? &show : &views, "modes are those of equations, such as fput; %s",
                          reader->scene->chain_count > 1 ? "not all chains here have some" : "this chain has none");
    return BEAD_OK;
}

/* `at` must lie within the run. */
static enum bead_error check_moments(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "at");
    const char *unit = bead_scene_plain(reader->scene) ? "" : " s";
    double until = reader->scene->simulate.until;
    if (output->profile_time_count == 0)
        return bead_wrong(reader, &where, "is missing: the times of the profiles, such as [0, %g]", *unit ? 1e-3 : 10);
    double last = output->moments[output->profile_time_count - 1];
    if (last > until)
        return bead_wrong(reader, &where, "goes to %g%s; must not be later than the end of the run at %g%s", last, unit, until,
                          unit);
    return BEAD_OK;
}

enum bead_error bead_output_check_show(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "show");
    enum bead_error err = check_modes(reader, at, output);
    if (err || (output->kind != BEAD_OUTPUT_TABLE && output->kind != BEAD_OUTPUT_PLOT))
        return err;
    if (output->show == BEAD_SHOW_SENSORS && !bead_scene_has_sensors(reader->scene))
        return bead_wrong(reader, &where, "shows sensors, but no bead of the chain has a `sensor`");
    err = check_keys(reader, at, output);
    return err || output->show != BEAD_SHOW_PROFILES ? err : check_moments(reader, at, output);
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
        enum bead_error err = bead_read_number(reader, &element, &number, &output->moments[i]);
        if (err)
            return err;
        if (i > 0 && !(output->moments[i] > output->moments[i - 1]))
            return bead_wrong(reader, &element, "is %g, not later than the one before; times must rise", output->moments[i]);
        output->profile_time_count = i + 1;
    }
    return BEAD_OK;
}
