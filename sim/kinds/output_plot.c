/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `plot`: its tables of keys, of single runs and of sweeps. */
#include <math.h>

#include "sim/kinds/outputs.h"

static const char *const sweep_scales[] = {"linear", "log", NULL};
static const unsigned sweep_scale_values[] = {BEAD_SCALE_LINEAR, BEAD_SCALE_LOG};
static const char *const sweep_plot_shows[] = {"median",  "mean",     "both",     "decay",      "spreading", "plane",
                                               "sensors", "spectrum", "transfer", "dispersion", NULL};
static const unsigned sweep_plot_values[] = {BEAD_SWEEP_MEDIAN,    BEAD_SWEEP_MEAN,      BEAD_SWEEP_BOTH,    BEAD_SWEEP_DECAY,
                                             BEAD_SWEEP_SPREADING, BEAD_SWEEP_PLANE,     BEAD_SWEEP_SENSORS, BEAD_SWEEP_SPECTRUM,
                                             BEAD_SWEEP_TRANSFER,  BEAD_SWEEP_DISPERSION};

static const struct bead_option plot_file[] = {
    BEAD_FILE_ROW("plot", BEAD_PICTURE_FILES, "[figure.pdf, figure.png]"),
    {"contact", BEAD_OPTION_COUNT, BEAD_OF_OUTPUT(plot.contact), .initial = "auto", .low = 0, .high = BEAD_SCENE_BEADS,
     .word = "auto", .word_value = BEAD_CONTACT_AUTO,
     .help = "the contact of the first chain that `show: contact` draws; contact j is between beads j and j + 1, and bead 0 is the "
             "striker",
     .example = "3"},
    {"compression", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(plot.compression), .initial = "0.2", .low = 0, .high = 0.6,
     .open = BEAD_OPEN_LOW, .help = "with `show: contact`: how far the smaller bead is flattened, as a fraction of its radius",
     .example = "0.1"},
};
static const struct bead_option_rows plot_shared[] = {{BEAD_OPTIONS(bead_curves_rows)},
                                                      {BEAD_OPTIONS(bead_plot_rows)},
                                                      {BEAD_OPTIONS(bead_measured_row)},
                                                      {BEAD_OPTIONS(bead_time_row)},
                                                      {BEAD_OPTIONS(bead_every_row)},
                                                      {BEAD_OPTIONS(bead_trust_row)},
                                                      {BEAD_OPTIONS(bead_page_rows)},
                                                      {BEAD_OPTIONS(bead_theme_rows)},
                                                      {BEAD_OPTIONS(bead_caption_row)},
                                                      {BEAD_OPTIONS(bead_panels_rows)},
                                                      {NULL, 0}};
static const struct bead_options plot_options = {
    "plot", "curves of sensors against time, or of peaks along the chain; or a schematic drawing", BEAD_OPTIONS(plot_file),
    plot_shared, &bead_output_family};

static BEAD_OUTPUT_CHECK(check_show)
{
    return bead_output_check_show(reader, at, output, &plot_options);
}

/* ---- of sweeps ---- */

static const struct bead_option sweep_plot_rows[] = {
    BEAD_FILE_ROW("plot", BEAD_PICTURE_FILES, "[figure.pdf, figure.png]"),
    {"show", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(sweep_curves.show), .initial = "both", .choices = sweep_plot_shows,
     .values = sweep_plot_values,
     .help =
         "force against magnetism, with median, mean, or both; or how peaks decay along the chain (measure: {decay: true}), "
         "without the last sixteenth of the random beads, whose largest force is yet to come when the front arrives at the end. Of "
         "sweeps over keys: force against a key, with mean and standard error, median and quartiles, or both; or spreading, how "
         "far energy has spread in time, averaged over seeds. plane, colours of the mean: over several `sweeps`, by number of "
         "random cells and magnetism, with the threshold; over two keys, by both. " BEAD_SWEEP_LINES_HELP},
    {"scale", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(plot.scale), .initial = "linear", .choices = sweep_scales,
     .values = sweep_scale_values,
     .help = "of sweeps over keys: the scale of both axes, with `show: spectrum` and `transfer` that of amplitudes; log: also the "
             "power law fitted to each curve against a key, with its slope in the legend"},
    {"range", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(plot.range), .initial = "auto",
     .shape = "auto, or [low, high] in units of the clean chain's peak, in N over keys", .word = "auto", .word_value = NAN,
     .like = "auto|[2 number]", .read = bead_output_read_sweep_range,
     .help = "ends of the axis of forces, and with `show: decay` of energies; auto: the range of the data", .example = "[0, 1.2]"},
    {"theory", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(shown.theory), .initial = "false",
     .help = "with `show: spreading`: how the second moment grows where energy runs freely, as t^2, and where it diffuses, as t"},
};
static const struct bead_option_rows sweep_plot_shared[] = {{BEAD_OPTIONS(bead_threshold_row)},
                                                            {BEAD_OPTIONS(bead_against_row)},
                                                            {BEAD_OPTIONS(bead_page_rows)},
                                                            {BEAD_OPTIONS(bead_theme_rows)},
                                                            {BEAD_OPTIONS(bead_caption_row)},
                                                            BEAD_SWEEP_LINES_ROWS,
                                                            {NULL, 0}};
static const struct bead_options sweep_plot_options = {"plot of a sweep", "force against magnetism, or peaks along the chain",
                                                       BEAD_OPTIONS(sweep_plot_rows), sweep_plot_shared, &bead_output_family};
const struct bead_output_type bead_plot_output = {.options = &plot_options,
                                                  .sweep_options = &sweep_plot_options,
                                                  .checks = {bead_output_check_times, bead_output_check_drawing, check_show,
                                                             bead_output_check_plot_trust, bead_output_check_panels},
                                                  .check_sweep = bead_output_check_sweep_curves,
                                                  .shows = true,
                                                  .draws = true};
