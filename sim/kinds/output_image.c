/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `image`: its table of keys. */
#include "sim/kinds/outputs.h"

static const struct bead_option image_file[] = {
    BEAD_FILE_ROW("image", BEAD_PICTURE_FILES, "force.png"),
};
static const struct bead_option_rows image_shared[] = {{BEAD_OPTIONS(bead_field_row)},
                                                       {BEAD_OPTIONS(bead_time_row)},
                                                       {BEAD_OPTIONS(bead_beads_row)},
                                                       {BEAD_OPTIONS(bead_every_row)},
                                                       {BEAD_OPTIONS(bead_colormap_row)},
                                                       {BEAD_OPTIONS(bead_image_rows)},
                                                       {BEAD_OPTIONS(bead_square_root_row)},
                                                       {BEAD_OPTIONS(bead_magnify_row)},
                                                       {BEAD_OPTIONS(bead_trust_row)},
                                                       {BEAD_OPTIONS(bead_page_rows)},
                                                       {BEAD_OPTIONS(bead_theme_rows)},
                                                       {BEAD_OPTIONS(bead_axes_row)},
                                                       {BEAD_OPTIONS(bead_caption_row)},
                                                       {BEAD_OPTIONS(bead_panels_rows)},
                                                       {BEAD_OPTIONS(bead_orientation_row)},
                                                       {BEAD_OPTIONS(bead_range_row)},
                                                       {BEAD_OPTIONS(bead_light_row)},
                                                       {BEAD_OPTIONS(bead_theory_row)},
                                                       {NULL, 0}};
static const struct bead_options image_options = {"image", "a field over the chain and time, or a still of other views",
                                                  BEAD_OPTIONS(image_file), image_shared, &bead_output_family};
/* ---- of sweeps ---- */

static const char *const sweep_shows[] = {"mean", "median", "deviation", "lower-quartile", "upper-quartile", NULL};
static const unsigned sweep_values[] = {BEAD_SWEEP_MEAN, BEAD_SWEEP_MEDIAN, BEAD_SWEEP_DEVIATION, BEAD_SWEEP_LOWER_QUARTILE,
                                        BEAD_SWEEP_UPPER_QUARTILE};
static const struct bead_option sweep_image_rows[] = {
    BEAD_FILE_ROW("image", BEAD_PICTURE_FILES, "mean.png"),
    {"show", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(sweep_curves.show), .initial = "mean", .choices = sweep_shows,
     .values = sweep_values,
     .help = "what is shown of all chains at each bead and time; deviation: the standard deviation; quartiles: the value that a "
             "quarter, or three quarters, of the chains are below"},
};
static const struct bead_option_rows sweep_image_shared[] = {
    {BEAD_OPTIONS(bead_field_row)},       {BEAD_OPTIONS(bead_time_row)},        {BEAD_OPTIONS(bead_beads_row)},
    {BEAD_OPTIONS(bead_colormap_row)},    {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
    {BEAD_OPTIONS(bead_orientation_row)}, {BEAD_OPTIONS(bead_page_rows)},       {BEAD_OPTIONS(bead_theme_rows)},
    {BEAD_OPTIONS(bead_axes_row)},        {BEAD_OPTIONS(bead_caption_row)},     {NULL, 0}};
static const struct bead_options sweep_image_options = {
    "image of a sweep", "mean of a field over all chains of a sweep, in space and time; each runs for it",
    BEAD_OPTIONS(sweep_image_rows), sweep_image_shared, &bead_output_family};

/* A mean over magnetisms would be meaningless. */
static BEAD_OUTPUT_CHECK(check_sweep_image)
{
    const struct bead_scene *scene = reader->scene;
    if (scene->sweep_count > 1 || scene->sweeps[0].group_count > 1)
        return BEAD_WRONG_KEY(reader, at, "image", "is the mean of all chains, but there are several %s: give one",
                              scene->sweep_count > 1 ? "sweeps" : "magnetisms");
    return bead_output_check_field(reader, at, output);
}

const struct bead_output_type bead_image_output = {
    .options = &image_options,
    .sweep_options = &sweep_image_options,
    .check_sweep = check_sweep_image,
    .only_in_scenes = true,
    .checks = {bead_output_check_field, bead_output_check_still_views, bead_output_check_times, bead_output_check_moment,
               bead_output_check_trust, bead_output_check_theory, bead_output_check_panels},
    .draws = true};
