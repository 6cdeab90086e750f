/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `image`: its table of keys. */
#include "sim/kinds/outputs.h"

static const struct bead_option image_file[] = {
    BEAD_FILE_ROW("image", "FILE.png, .pdf or .svg", "force.png"),
};
static const struct bead_option_rows image_shared[] = {
    {BEAD_OPTIONS(bead_field_row)},       {BEAD_OPTIONS(bead_time_row)},     {BEAD_OPTIONS(bead_beads_row)},
    {BEAD_OPTIONS(bead_every_row)},       {BEAD_OPTIONS(bead_colormap_row)}, {BEAD_OPTIONS(bead_image_rows)},
    {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_magnify_row)},  {BEAD_OPTIONS(bead_trust_row)},
    {BEAD_OPTIONS(bead_page_rows)},       {BEAD_OPTIONS(bead_theme_rows)},   {BEAD_OPTIONS(bead_axes_row)},
    {BEAD_OPTIONS(bead_caption_row)},     {BEAD_OPTIONS(bead_panels_rows)},  {BEAD_OPTIONS(bead_orientation_row)},
    {BEAD_OPTIONS(bead_range_row)},       {BEAD_OPTIONS(bead_light_row)},    {NULL, 0}};
static const struct bead_options image_options = {"image", "a field over the chain and time, or a still of other views",
                                                  BEAD_OPTIONS(image_file), image_shared, &bead_output_family};
const struct bead_output_type bead_image_output = {.options = &image_options,
                                                   .checks = {bead_output_check_field, bead_output_check_still_views,
                                                              bead_output_check_times, bead_output_check_moment,
                                                              bead_output_check_trust, bead_output_check_panels},
                                                   .draws = true};
