/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `report`: its table of keys. */
#include "sim/kinds/outputs.h"

static const struct bead_option report_file[] = {
    BEAD_FILE_ROW("report", "FILE.html", "report.html"),
};
static const struct bead_option_rows report_shared[] = {
    {BEAD_OPTIONS(bead_field_row)},   {BEAD_OPTIONS(bead_time_row)},        {BEAD_OPTIONS(bead_beads_row)},
    {BEAD_OPTIONS(bead_every_row)},   {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
    {BEAD_OPTIONS(bead_magnify_row)}, {BEAD_OPTIONS(bead_colormap_row)},    {NULL, 0}};
static const struct bead_options report_options = {
    "report",
    "a page for browsers: one file, with the samples to play, peaks and measures with their uncertainty, pictures and scene",
    BEAD_OPTIONS(report_file), report_shared, &bead_output_family};

static const struct bead_option_rows sweep_report_shared[] = {
    {BEAD_OPTIONS(bead_field_row)},     {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
    {BEAD_OPTIONS(bead_threshold_row)}, {BEAD_OPTIONS(bead_colormap_row)},    {NULL, 0}};
static const struct bead_options sweep_report_options = {
    "report of a sweep", "a page for browsers: force against magnetism, and behind each point the image of its configuration",
    BEAD_OPTIONS(report_file), sweep_report_shared, &bead_output_family};

/* The points of the report are peaks. */
static BEAD_OUTPUT_CHECK(check_sweep_report)
{
    for (size_t i = 0; i < reader->scene->sweep_count; i++) {
        if (reader->scene->sweeps[i].over.key_count)
            return BEAD_WRONG_KEY(reader, at, "report", "shows points by magnetism, which a sweep over keys does not have");
        if (!reader->scene->sweeps[i].measures.peak)
            return BEAD_WRONG_KEY(reader, at, "report", "shows peaks, and a sweep here measures none (measure: {peak: none})");
    }
    return bead_output_check_field(reader, at, output);
}

const struct bead_output_type bead_report_output = {.options = &report_options,
                                                    .sweep_options = &sweep_report_options,
                                                    .checks = {bead_output_check_field, bead_output_check_times},
                                                    .check_sweep = check_sweep_report};
