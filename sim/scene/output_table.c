/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables: their keys, of single runs and of sweeps. */
#include "sim/scene/output_rows.h"

static const char *const table_shows[] = {"sensors",  "peaks", "bead-peaks", "measures",      "modes",
                                          "profiles", "chain", "energy",     "sensitivities", NULL};
static const unsigned table_values[] = {BEAD_SHOW_SENSORS,  BEAD_SHOW_PEAKS,  BEAD_SHOW_BEAD_PEAKS,
                                        BEAD_SHOW_MEASURES, BEAD_SHOW_MODES,  BEAD_SHOW_PROFILES,
                                        BEAD_SHOW_CHAIN,    BEAD_SHOW_ENERGY, BEAD_SHOW_SENSITIVITIES};
static const char *const sweep_table_shows[] = {"magnetism", "configurations", "decay", NULL};
static const unsigned sweep_table_values[] = {BEAD_SWEEP_MAGNETISM, BEAD_SWEEP_CONFIGURATIONS, BEAD_SWEEP_DECAY};

static const struct bead_option table_rows[] = {
    BEAD_FILE_ROW("table", "FILE.csv", "peaks.csv"),
    {.key = "show",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(curves.show),
     .initial = "peaks",
     .choices = table_shows,
     .values = table_values,
     .help =
         "what to list: the force at each sensor; the peak of each contact or of each bead; measures of the run (--list measures); "
         "the energies of modes; profiles, a field along the chain at several times; the beads and contacts of the chain; the "
         "energy "
         "budget; or sensitivities, the derivatives of the peaks of `contacts` by the mass (N/kg), radius (N/m) and modulus (N/Pa) "
         "of "
         "every bead, the two others kept, and by the velocity of the striker (N s/m)"},
    {.key = "contacts",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a number or a list of numbers; contact j is between beads j and j + 1, and bead 0 is the striker",
     .help = "the contacts of `show: sensitivities`; without it both contacts of each bead with a sensor, or else the last contact "
             "whose force has had its maximum. Derivatives are good to 1e-6 of the largest of their kind where peaks are "
             "well-conditioned "
             "(laws with a power below 1.2: to 1e-4); none with damping. A run more, and about one for each contact",
     .example = "[40, 57]",
     .like = "number|[number]",
     .read = bead_output_read_contacts},
    {.key = "uncertainty",
     .type = BEAD_OPTION_FLAG,
     .offset = BEAD_OF_OUTPUT(curves.uncertainty),
     .initial = "true",
     .help = "tables of peaks: a column that says how well each is known, from a second, coarser run; false: no such run"},
};
static const struct bead_option_rows table_shared[] = {
    {BEAD_OPTIONS(bead_curves_rows)}, {BEAD_OPTIONS(bead_time_row)}, {BEAD_OPTIONS(bead_every_row)}, {NULL, 0}};
static const struct bead_options table_options = {"table", "numbers, as CSV", BEAD_OPTIONS(table_rows), table_shared,
                                                  &bead_output_family};

static const struct bead_option sweep_table_rows[] = {
    BEAD_FILE_ROW("table", "FILE.csv", "peaks.csv"),
    {.key = "show",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(sweep_curves.show),
     .initial = "magnetism",
     .choices = sweep_table_shows,
     .values = sweep_table_values,
     .help = "statistics of each magnetism, results of each configuration, or mean peaks along the chain"},
};
static const struct bead_option_rows sweep_table_shared[] = {{BEAD_OPTIONS(bead_threshold_row)}, {NULL, 0}};
static const struct bead_options sweep_table_options = {"table of a sweep", "numbers of a sweep, as CSV",
                                                        BEAD_OPTIONS(sweep_table_rows), sweep_table_shared, &bead_output_family};
const struct bead_output_type bead_table_output = {
    .options = &table_options,
    .sweep_options = &sweep_table_options,
    .checks = {bead_output_check_times, bead_output_check_show, bead_output_check_sensitivities},
    .check_sweep = bead_output_check_sweep_curves,
    .shows = true};
