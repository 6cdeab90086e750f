/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Readers of the keys of outputs that are more than a number, a word or a choice. */
#ifndef BEADREEL_SIM_SCENE_SCENE_OUTPUT_H
#define BEADREEL_SIM_SCENE_SCENE_OUTPUT_H

#include "sim/scene/output_kinds.h"
#include "sim/scene/scene_private.h"

/* Names of fields in the order of enum bead_field, NULL-terminated. */
const char *const *bead_output_field_names(void);

#define BEAD_OUTPUT_READER(name) \
    enum bead_error name(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option, void *settings)
BEAD_OUTPUT_READER(bead_output_read_path);
BEAD_OUTPUT_READER(bead_output_read_fields);
BEAD_OUTPUT_READER(bead_output_read_xdmf);
BEAD_OUTPUT_READER(bead_output_read_beads);
BEAD_OUTPUT_READER(bead_output_read_size);
BEAD_OUTPUT_READER(bead_output_read_colormap);
BEAD_OUTPUT_READER(bead_output_read_frame_size);
BEAD_OUTPUT_READER(bead_output_read_colour_range);
BEAD_OUTPUT_READER(bead_output_read_plot_range);
BEAD_OUTPUT_READER(bead_output_read_sweep_range);
BEAD_OUTPUT_READER(bead_output_read_views);
BEAD_OUTPUT_READER(bead_output_read_chain);
BEAD_OUTPUT_READER(bead_output_read_panels);
BEAD_OUTPUT_READER(bead_output_read_captions);
BEAD_OUTPUT_READER(bead_output_read_speeds);
BEAD_OUTPUT_READER(bead_output_read_from);
BEAD_OUTPUT_READER(bead_output_read_until);
BEAD_OUTPUT_READER(bead_output_read_card);
BEAD_OUTPUT_READER(bead_output_read_sound);
BEAD_OUTPUT_READER(bead_output_read_poster);
BEAD_OUTPUT_READER(bead_output_read_profile_times);
BEAD_OUTPUT_READER(bead_output_read_contacts);
BEAD_OUTPUT_READER(bead_output_read_threshold);
BEAD_OUTPUT_READER(bead_output_read_magnetism);

/* Checks of the table of kinds (output_kinds.h), in several files. */
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_times);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_moment);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_views);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_still_views);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_drawing);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_field);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_field_list);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_xdmf);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_trust);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_show);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_sensitivities);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_panels);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_movie);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_sheet);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_sweep_curves);
/* Does output `index`, of a kind known already, go with the scene's sweeps, or with none? */
BEAD_CHECK enum bead_error bead_output_check_sweep(const struct bead_reader *reader, const struct bead_at *at, size_t index);
/* Do all chains have modes? */
BEAD_CHECK enum bead_error bead_output_need_modes(const struct bead_reader *reader, const struct bead_at *where);
/* Is the size one that can be drawn? */
BEAD_CHECK enum bead_error bead_output_check_size(const struct bead_reader *reader, const struct bead_at *at,
                                                  const struct bead_paper *paper);

/* An output that names several files, {plot: [a.pdf, a.png], ...}, is as many outputs: how many (0: its list is empty), and the
 * entry for one of them (NULL: no memory). */
size_t bead_output_files(const struct bead_node *entry);
struct bead_node *bead_output_entry(const struct bead_reader *reader, struct bead_node *entry, size_t file);

/* Settings of which a kind has no key. */
extern const struct bead_output bead_output_automatic;
/* The settings of an output or panel, which begins as bead_output_automatic, with its kind and place; and their checks. */
BEAD_CHECK enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at,
                                                     const struct bead_options *options, struct bead_output *output);
/* All that an output, or a panel, holds. */
void bead_output_free(struct bead_output *output);

/* What the keys of movies have filled in. */
void bead_output_free_movie(struct bead_output *output);

#endif
