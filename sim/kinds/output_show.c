/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `show`: what plots and tables can show, and the keys for each. */
#include <string.h>

#include "beadreel/law.h"
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"

enum { PLOT = 1 << BEAD_OUTPUT_PLOT, TABLE = 1 << BEAD_OUTPUT_TABLE };

static const char no_contacts[] = "peaks are those of contacts between beads, which equations do not have",
                  whole_passage[] = "peaks are those of the first passage", of_frequencies[] = "spectra have an axis of frequency";

#define SPECTRA "window", "segment", "frequencies"
#define KEYS(...)         \
    (const char *const[]) \
    {                     \
        __VA_ARGS__, NULL \
    }
static const struct bead_show_type shows[BEAD_SHOW_COUNT] = {
    [BEAD_SHOW_SENSORS] = {.keys = KEYS("every", "time", "normalise", "field", "beads", "contacts", "overlay", "measured"),
                           .why_not = "sensors have curves over time, on a linear axis",
                           .ends = PLOT | TABLE,
                           .of_field = true,
                           .of_places = true},
    [BEAD_SHOW_PEAKS] = {.keys = KEYS("scale", "contacts", "overlay"),
                         .why_not = whole_passage,
                         .without_contacts = no_contacts,
                         .ends = PLOT,
                         .of_run = true},
    [BEAD_SHOW_BEAD_PEAKS] = {.keys = KEYS("scale", "beads"),
                              .why_not = whole_passage,
                              .without_contacts = no_contacts,
                              .of_run = true},
    [BEAD_SHOW_MEASURES] = {.keys = KEYS("every"), .why_not = "measures describe the whole run", .ends = TABLE, .own_times = true},
    [BEAD_SHOW_MODES] = {.keys = KEYS("every", "time", "modes", "scale"),
                         .why_not = "modes have energies over time",
                         .modes = true},
    [BEAD_SHOW_PROFILES] = {.keys = KEYS("field", "at", "overlay", "theory"),
                            .why_not = "profiles have the times `at`",
                            .ends = PLOT | TABLE,
                            .of_field = true},
    [BEAD_SHOW_CHAIN] = {.keys = KEYS(NULL),
                         .why_not = "a chain at rest has no times",
                         .without_contacts = "lists beads and contacts, which equations do not have"},
    [BEAD_SHOW_ENERGY] = {.keys = KEYS("every", "time", "parts", "beads"),
                          .why_not = "the energy budget is for the whole chain over time",
                          .without_contacts = "needs beads and contacts, which equations do not have",
                          .ends = PLOT | TABLE,
                          .of_run = true},
    [BEAD_SHOW_SENSITIVITIES] = {.keys = KEYS("contacts"),
                                 .why_not = "sensitivities are for peaks",
                                 .without_contacts = "needs peaks of contacts, which equations do not have",
                                 .of_run = true},
    [BEAD_SHOW_EXTREMES] = {.keys = KEYS("every", "time", "field"),
                            .why_not = "extremes are for all beads over time",
                            .ends = TABLE,
                            .of_field = true},
    [BEAD_SHOW_SPREADING] = {.keys = KEYS("every", "time", "theory"),
                             .why_not = "spreading is about the energies of all beads over time",
                             .without_contacts = "needs energies of beads, which equations do not have",
                             .ends = PLOT | TABLE,
                             .own_times = true,
                             .of_powers = true},
    [BEAD_SHOW_BANDS] = {.keys = KEYS(NULL),
                         .why_not = "bands describe a chain at rest",
                         .without_contacts = "needs cells of beads, which equations do not have",
                         .vibrations = true},
    [BEAD_SHOW_EIGENMODES] = {.keys = KEYS("scale"),
                              .why_not = "eigenmodes describe a chain at rest",
                              .without_contacts = "needs beads; for an equation use `show: modes`",
                              .vibrations = true},
    [BEAD_SHOW_SPECTRUM] = {.keys = KEYS("every", "time", "field", "beads", "contacts", "overlay", "scale", SPECTRA),
                            .why_not = of_frequencies,
                            .ends = PLOT | TABLE,
                            .of_field = true,
                            .of_places = true},
    [BEAD_SHOW_SPECTROGRAM] = {.keys = KEYS("every", "time", "field", "beads", "contacts", SPECTRA),
                               .why_not = of_frequencies,
                               .ends = PLOT | TABLE,
                               .of_field = true,
                               .of_places = true},
    [BEAD_SHOW_TRANSFER] = {.keys = KEYS("every", "time", "field", "beads", "contacts", "overlay", "scale", SPECTRA),
                            .why_not = of_frequencies,
                            .without_contacts = "needs driven beads, which equations do not have",
                            .ends = PLOT | TABLE,
                            .of_field = true,
                            .of_places = true,
                            .of_motion = true},
    [BEAD_SHOW_DISPERSION] = {.keys = KEYS("every", "time", "field", SPECTRA),
                              .why_not = "a dispersion takes all beads of the cells that a chain repeats",
                              .without_contacts = "needs beads; an equation has its own dispersion",
                              .ends = PLOT | TABLE,
                              .of_field = true,
                              .of_motion = true},
    [BEAD_SHOW_FIT] = {.keys = KEYS(NULL), .why_not = "a fit has numbers, not curves", .of_run = true},
    [BEAD_SHOW_SETUP] = {.drawing = true},
    [BEAD_SHOW_CONTACT] = {.drawing = true},
    [BEAD_SHOW_CELL] = {.drawing = true},
};

const struct bead_show_type *bead_show_type(enum bead_show show)
{
    return &shows[show];
}

/* Keys that only some of them take; for sweeps `row` is NULL. */
static enum bead_error check_keys(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output,
                                  const struct bead_option *row)
{
    static const char *const keys[] = {"every",    "time",  "modes",   "field", "at",     "scale",    "normalise",
                                       "contacts", "beads", "overlay", "parts", "theory", "measured", SPECTRA};
    const struct bead_show_type *show = &shows[output->curves.show];
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        char homes[120] = "";
        bool plain = (strcmp(keys[k], "scale") == 0 && output->plot.scale == BEAD_SCALE_LINEAR) ||
                     (strcmp(keys[k], "normalise") == 0 && output->plot.normalise == BEAD_NORMALISE_NONE);
        if (!bead_given(at, keys[k]) || bead_is_one_of(keys[k], show->keys) || plain)
            continue;
        for (size_t i = 0; row && row->choices[i]; i++) {
            if (shows[row->values[i]].keys && bead_is_one_of(keys[k], shows[row->values[i]].keys))
                bead_list_add(homes, sizeof homes, ", ", row->choices[i]);
        }
        return row ? BEAD_WRONG_KEY(reader, at, keys[k], "belongs to `show: %s`; %s", homes, show->why_not)
                   : BEAD_WRONG_KEY(reader, at, keys[k], "does not belong to this `show`; %s", show->why_not);
    }
    return BEAD_OK;
}

/* `at` must lie within the run. */
static enum bead_error check_moments(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    const char *unit = bead_scene_seconds(reader->scene);
    double until = reader->scene->simulate.until;
    if (output->curves.profile_time_count == 0)
        return BEAD_WRONG_KEY(reader, at, "at", "is missing: the times of the profiles, such as [0, %g]", *unit ? 1e-3 : 10);
    double last = output->curves.profile_times[output->curves.profile_time_count - 1];
    if (last > until)
        return BEAD_WRONG_KEY(reader, at, "at", "goes to %g%s; must not be later than the end of the run at %g%s", last, unit,
                              until, unit);
    return BEAD_OK;
}

/* The places listed must have the quantity shown. */
static enum bead_error check_listed(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_curves_asked *curves = &output->curves;
    const struct bead_show_type *show = &shows[curves->show];
    const bool of_contacts = bead_field_info(output->shown.field)->of_contacts;
    if (curves->show == BEAD_SHOW_SPECTROGRAM && curves->beads.count + curves->contacts.count > 1)
        return BEAD_WRONG_KEY(reader, at, "beads", "are several places; a spectrogram shows one");
    for (size_t i = 0; i < 2 && !show->of_places; i++) {
        const struct bead_listed *listed = i ? &curves->contacts : &curves->beads;
        if (listed->count > 0 && listed->all[listed->count - 1] == BEAD_LAST)
            return BEAD_WRONG_KEY(reader, at, i ? "contacts" : "beads",
                                  "has last, which is not the same in all chains; must be numbers here");
    }
    if (!show->of_places)
        return BEAD_OK;
    if (curves->contacts.count > 0 && !bead_scene_system(scene)->has_contacts)
        return BEAD_WRONG_KEY(reader, at, "contacts", "are between beads, which equations do not have");
    if (of_contacts && !(curves->beads.count == 0 && curves->contacts.count > 0))
        return BEAD_WRONG_KEY(reader, at, "field", "is one of contacts: say which `contacts`, instead of beads or sensors");
    if (!of_contacts && output->shown.field != BEAD_FIELD_FORCE && curves->contacts.count > 0)
        return BEAD_WRONG_KEY(reader, at, "field", "belongs to beads, but contacts, which have forces, would share its axis");
    return BEAD_OK;
}

/* Without listed places, there must be a sensor. */
static enum bead_error check_places(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output)
{
    const struct bead_curves_asked *curves = &output->curves;
    if (!shows[curves->show].of_places || curves->beads.all || curves->contacts.all ||
        bead_scene_has_sensors(reader->scene, SIZE_MAX))
        return BEAD_OK;
    return BEAD_WRONG_KEY(reader, at, "show",
                          "shows sensors, but no bead of the chain has a `sensor`; give one, or say which `beads`");
}

/* Small vibrations need springs, and bands a cell that is repeated. */
static enum bead_error check_vibrations(const struct bead_reader *reader, const struct bead_at *at, enum bead_show show)
{
    const struct bead_scene *scene = reader->scene;
    for (size_t c = 0; c < scene->chain_count; c++) {
        const struct bead_chain_spec *chain = &scene->chains[c];
        const bool pressed = chain->precompression > 0 || (show == BEAD_SHOW_EIGENMODES && chain->tilt > 0);
        bool repeats = show == BEAD_SHOW_EIGENMODES;
        for (size_t s = 0; s < chain->segment_count; s++)
            repeats = repeats || (chain->segments[s].count > 1 && !chain->segments[s].each);
        if (chain->law.row->one_sided && !pressed)
            return BEAD_WRONG_KEY(reader, at, "show",
                                  "has small vibrations, of contacts that stay closed: the chain needs a `precompression`");
        if (!repeats)
            return BEAD_WRONG_KEY(reader, at, "show",
                                  "has the bands of cells that a chain repeats, but no two cells follow each "
                                  "other alike; modes of any chain are `show: eigenmodes`");
    }
    return BEAD_OK;
}

enum bead_error bead_output_check_show(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output,
                                       const struct bead_options *options)
{
    const struct bead_show_type *show = &shows[output->curves.show];
    if (!bead_scene_system(reader->scene)->has_contacts && show->without_contacts)
        return BEAD_WRONG_KEY(reader, at, "show", "%s", show->without_contacts);
    if (show->drawing || output->still.panel_count > 0)
        return BEAD_OK;
    BEAD_TRY(show->modes ? bead_output_need_modes(reader, at, "show") : BEAD_OK);
    BEAD_TRY(check_places(reader, at, output));
    if (output->curves.show == BEAD_SHOW_FIT && !bead_given(at->up->up, "fit"))
        return BEAD_WRONG_KEY(reader, at, "show", "lists what a fit has found, but there is no `fit`: the keys to find");
    BEAD_TRY(show->vibrations ? check_vibrations(reader, at, output->curves.show) : BEAD_OK);
    BEAD_TRY(check_listed(reader, at, output));
    BEAD_TRY(check_keys(reader, at, output, bead_options_find(options, "show")));
    BEAD_TRY(show->of_field ? bead_output_check_field(reader, at, output) : BEAD_OK);
    return output->curves.show == BEAD_SHOW_PROFILES ? check_moments(reader, at, output) : BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_lines)
{
    static const char *const of_peaks[] = {"against", "measure", "threshold", NULL};
    BEAD_TRY(bead_without(reader, at, of_peaks, "belongs to peaks and measures, which are numbers, not curves"));
    BEAD_TRY(check_places(reader, at, output));
    BEAD_TRY(check_listed(reader, at, output));
    BEAD_TRY(check_keys(reader, at, output, NULL));
    BEAD_TRY(bead_output_check_times(reader, at, output));
    return bead_output_check_field(reader, at, output);
}

static bool has_cells(const struct bead_scene *scene)
{
    for (size_t c = 0; c < scene->chain_count; c++) {
        for (size_t s = 0; s < scene->chains[c].segment_count; s++) {
            if (scene->chains[c].segments[s].cell_beads > 1)
                return true;
        }
    }
    return false;
}

/* Schematic drawings are of beads, and need no run. */
BEAD_OUTPUT_CHECK(bead_output_check_drawing)
{
    static const char *const of_runs[] = {"every", "time", "scale", "trust",    "normalise", "range", "modes",
                                          "field", "at",   "beads", "contacts", "overlay",   "parts", NULL},
                             *const of_contacts[] = {"contact", "compression", NULL};
    const struct bead_scene *scene = reader->scene;
    const bool drawing = shows[output->curves.show].drawing;
    if (output->curves.show != BEAD_SHOW_CONTACT)
        BEAD_TRY(bead_without(reader, at, of_contacts, "belongs to `show: contact`"));
    if (drawing)
        BEAD_TRY(
            bead_without(reader, at, of_runs, "belongs to `show: sensors` or `show: peaks`; nothing is computed for a drawing"));
    for (size_t c = 0; c < scene->chain_count && drawing; c++) {
        if (!scene->chains[c].system->has_contacts)
            return BEAD_WRONG_KEY(reader, at, "show", "draws beads, but there are none in `%s`", scene->chains[c].system->name);
    }
    if (output->curves.show == BEAD_SHOW_CELL && !has_cells(scene))
        return BEAD_WRONG_KEY(reader, at, "show", "draws cells, but no chain has a `cell` of two or more beads");
    if (output->curves.show != BEAD_SHOW_CONTACT || output->plot.contact == BEAD_CONTACT_AUTO)
        return BEAD_OK;
    size_t last = bead_scene_count_beads(&scene->chains[0]) - (scene->chains[0].wall == BEAD_WALL_NONE);
    return output->plot.contact <= last
               ? BEAD_OK
               : BEAD_WRONG_KEY(reader, at, "contact", "is %zu, but the last contact is %zu", output->plot.contact, last);
}

/* `trust` needs an axis of time. */
BEAD_OUTPUT_CHECK(bead_output_check_plot_trust)
{
    if (output->shown.trust && output->curves.overlay)
        return BEAD_WRONG_KEY(reader, at, "trust", "is set, but with `overlay` it has no panel for each chain");
    return !output->shown.trust || output->curves.show == BEAD_SHOW_SENSORS
               ? BEAD_OK
               : BEAD_WRONG_KEY(reader, at, "trust",
                                "is set, but peaks of the first passage have no axis of time; it belongs to `show: sensors`");
}

/* A list of rising times. */
BEAD_OPTION_READER(bead_output_read_profile_times)
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
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(bead_read_number(reader, &element, &number, &output->curves.profile_times[i]));
        if (i > 0 && !(output->curves.profile_times[i] > output->curves.profile_times[i - 1]))
            return bead_wrong(reader, &element, "is %g, not later than the one before; times must rise",
                              output->curves.profile_times[i]);
        output->curves.profile_time_count = i + 1;
    }
    return BEAD_OK;
}
