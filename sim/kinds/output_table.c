/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `table`: its tables of keys, of single runs and of sweeps. */
#include "sim/kinds/outputs.h"
#include "sim/kinds/scene_facts.h"

#define TABLE_SHOWS(SHOW)                                                                                                 \
    SHOW("sensors", BEAD_SHOW_SENSORS), SHOW("peaks", BEAD_SHOW_PEAKS), SHOW("bead-peaks", BEAD_SHOW_BEAD_PEAKS),         \
        SHOW("measures", BEAD_SHOW_MEASURES), SHOW("modes", BEAD_SHOW_MODES), SHOW("profiles", BEAD_SHOW_PROFILES),       \
        SHOW("chain", BEAD_SHOW_CHAIN), SHOW("energy", BEAD_SHOW_ENERGY), SHOW("sensitivities", BEAD_SHOW_SENSITIVITIES), \
        SHOW("extremes", BEAD_SHOW_EXTREMES), SHOW("spreading", BEAD_SHOW_SPREADING), SHOW("bands", BEAD_SHOW_BANDS),     \
        SHOW("eigenmodes", BEAD_SHOW_EIGENMODES), BEAD_SPECTRA_SHOWS(SHOW), SHOW("fit", BEAD_SHOW_FIT)
static const char *const table_shows[] = {TABLE_SHOWS(BEAD_WORD_OF), NULL};
static const unsigned table_values[] = {TABLE_SHOWS(BEAD_VALUE_OF)};
#define SWEEP_TABLE_SHOWS(SHOW)                                                                                              \
    SHOW("magnetism", BEAD_SWEEP_MAGNETISM), SHOW("statistics", BEAD_SWEEP_MAGNETISM),                                       \
        SHOW("configurations", BEAD_SWEEP_CONFIGURATIONS), SHOW("decay", BEAD_SWEEP_DECAY),                                  \
        SHOW("spreading", BEAD_SWEEP_SPREADING), SHOW("sensors", BEAD_SWEEP_SENSORS), SHOW("spectrum", BEAD_SWEEP_SPECTRUM), \
        SHOW("transfer", BEAD_SWEEP_TRANSFER), SHOW("dispersion", BEAD_SWEEP_DISPERSION)
static const char *const sweep_table_shows[] = {SWEEP_TABLE_SHOWS(BEAD_WORD_OF), NULL};
static const unsigned sweep_table_values[] = {SWEEP_TABLE_SHOWS(BEAD_VALUE_OF)};

static const struct bead_option table_rows[] = {
    BEAD_FILE_ROW("table", "FILE.csv", "peaks.csv"),
    {"show", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(curves.show), .initial = "peaks", .choices = table_shows, .values = table_values,
     .help =
         "what to list: the force at each sensor; the peak of each contact or of each bead (where `until: auto` ends the run, the "
         "largest before the wave reaches the end of the chain: state `exceeded` says that a later force of this run is larger; "
         "`invalid`, that the contact is compressed by more than a tenth "
         "of a radius, or struck at more than a tenth of the bar speed, where Hertz's law does not hold); "
         "measures of the run (--list measures); the energies of modes; profiles, a field along the chain at several times; the "
         "beads and contacts of the "
         "chain; the energy budget; extremes, the value of `field` furthest from 0 over time, and where; spreading, second moment "
         "and participation of the energies with their exponents; bands, those of each repeated cell under its precompression, and "
         "the gaps between them; eigenmodes, frequency, participation and localisation length of each small vibration of the "
         "chain; " BEAD_SPECTRA_HELP ", and the strongest line of each; "
         "fit, the numbers that `fit` has found, with their standard errors; "
         "or sensitivities, the "
         "derivatives of the peaks of `contacts` by the mass (N/kg), radius "
         "(N/m) and modulus (N/Pa) of every bead, the two others kept, and by the velocity of the striker (N s/m)"},
    {"uncertainty", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(curves.uncertainty), .initial = "true",
     .help =
         "tables of peaks: columns that say how well each and its time are known, from a second, coarser run, and where many peaks "
         "respond strongly to errors, from a third, finer one; a peak that is not known to a tenth has the state `unpredictable`, "
         "and so do those that come later and are not known as well as asked, and all that a later maximum may overtake. Tables of "
         "sensors, measures, modes, the energy, extremes, profiles, spreading, spectra and sensitivities: columns with five times "
         "the difference to a run with a hundredth of the tolerance (equations: a tenth, and at most half of the longest step; "
         "shock: three quarters as many cells; a given step: half of it), against time the largest so far, of extremes that of the "
         "size, of profiles, spectra and sensitivities that of the worst place, frequency or bead; a measure of a motion that the "
         "two runs do not share has the note `unpredictable`. Of a trajectory with `uncertainty`, tables of sensors, extremes and "
         "profiles have what it says about their field; of other numbers from a trajectory nothing is known (nan). false: no such "
         "runs"},
};
static const struct bead_option_rows table_shared[] = {
    {BEAD_OPTIONS(bead_curves_rows)}, {BEAD_OPTIONS(bead_time_row)}, {BEAD_OPTIONS(bead_every_row)}, {NULL, 0}};
static const struct bead_options table_options = {"table", "numbers, as CSV", BEAD_OPTIONS(table_rows), table_shared,
                                                  &bead_output_family};

static BEAD_OUTPUT_CHECK(check_show)
{
    return bead_output_check_show(reader, at, output, &table_options);
}

/* A damped contact's force jumps as it closes, and later derivatives would jump with it. Springs are not in the equations of the
 * derivatives. */
static enum bead_error check_derivatives(const struct bead_reader *reader, const struct bead_at *at, const char *key,
                                         const char *what)
{
    const struct bead_scene *scene = reader->scene;
    for (size_t c = 0; c < scene->chain_count; c++) {
        const struct bead_chain_spec *chain = &scene->chains[c];
        const char *name = chain->name ? chain->name : "";
        const bool damped = chain->damping_coefficient > 0;
        const char *why = damped                                 ? "it has `damping`, whose forces jump when contacts close"
                          : chain->absorbs                       ? "its end absorbs"
                          : chain->drive.amplitude > 0           ? "it has a `drive`"
                          : bead_scene_has_springs(scene, chain) ? "springs, or a cradle, hold its beads"
                                                                 : NULL;
        if (why)
            return BEAD_WRONG_KEY(reader, at, key, "%s %s for chain%s%s: %s", what, damped ? "do not exist" : "are not known",
                                  *name ? " " : "", name, why);
    }
    return BEAD_OK;
}

static BEAD_OUTPUT_CHECK(check_sensitivities)
{
    const enum bead_show show = output->curves.show;
    const bool peaks = show == BEAD_SHOW_PEAKS || show == BEAD_SHOW_BEAD_PEAKS;
    if (show == BEAD_SHOW_SENSITIVITIES)
        return check_derivatives(reader, at, "show", "sensitivities");
    return peaks && bead_scene_tolerances(reader->scene) ? check_derivatives(reader, at, show == BEAD_SHOW_PEAKS ? "table" : "show",
                                                                             "the deviations of peaks that follow from `tolerance`")
                                                         : BEAD_OK;
}

/* ---- of sweeps ---- */

static const struct bead_option sweep_table_rows[] = {
    BEAD_FILE_ROW("table", "FILE.csv", "peaks.csv"),
    {"show", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(sweep_curves.show), .initial = "magnetism", .choices = sweep_table_shows,
     .values = sweep_table_values,
     .help =
         "magnetism or statistics: those of each magnetism, or over keys of each value along the axis; results of each "
         "configuration; mean peaks along the chain; or, over keys, spreading, how far energy has spread at the times "
         "of such a table of one chain in chains that are run for it, averaged over seeds, and the exponents of the window "
         "from 7 % of the time to its end "
         "with their standard errors. Forces, their times, ratios and slopes have an `uncertainty`: a finer run measures that of "
         "the first of "
         "every 64 chains, over keys of at least five, and of all with more than 600 beads; the others, and means, are uncertain "
         "by the worst of these. Of spreading, one of 64 chains of each curve is measured, at least five, and the mean is "
         "uncertain by their mean and by how much that of all may differ from it; so are curves of chains, each by its worst row, "
         "and decay, of each magnetism. A measure of a "
         "chain that is not run twice is as uncertain, in parts of itself, as the worst. " BEAD_SWEEP_LINES_HELP},
    {"uncertainty", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(curves.uncertainty), .initial = "true",
     .help = "with `show: spreading`, or curves of chains: how well the numbers are known, from second runs of some chains; false: "
             "no such runs"},
};
static const struct bead_option_rows sweep_table_shared[] = {
    {BEAD_OPTIONS(bead_threshold_row)}, {BEAD_OPTIONS(bead_against_row)}, BEAD_SWEEP_LINES_ROWS, {NULL, 0}};
static const struct bead_options sweep_table_options = {"table of a sweep", "numbers of a sweep, as CSV",
                                                        BEAD_OPTIONS(sweep_table_rows), sweep_table_shared, &bead_output_family};
const struct bead_output_type bead_table_output = {.options = &table_options,
                                                   .sweep_options = &sweep_table_options,
                                                   .checks = {bead_output_check_times, check_show, check_sensitivities},
                                                   .check_sweep = bead_output_check_sweep_curves,
                                                   .shows = true,
                                                   /* Sweeps measure peaks of bead forces. */
                                                   .shown_of = {[BEAD_OF_CONFIGURATION] = "bead-peaks",
                                                                [BEAD_OF_TRAJECTORY] = "sensors",
                                                                [BEAD_OF_TRAJECTORIES] = "sensors",
                                                                [BEAD_OF_DIFFERENCE] = "extremes"}};
