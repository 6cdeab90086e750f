/* Readers of the keys of outputs that are more than a number, a word or a choice. */
#ifndef BEADREEL_SIM_SCENE_SCENE_OUTPUT_H
#define BEADREEL_SIM_SCENE_SCENE_OUTPUT_H

#include "sim/scene/scene_private.h"

/* Bits of forms: kinds, plots and tables of sweeps, and the same in vector files. */
enum { BEAD_OUTPUT_SWEEP_PLOT = BEAD_OUTPUT_KINDS, BEAD_OUTPUT_SWEEP_TABLE, BEAD_OUTPUT_VECTOR };

/* Names of fields in the order of enum bead_field, NULL-terminated. */
const char *const *bead_output_field_names(void);

#define BEAD_OUTPUT_READER(name) \
    enum bead_error name(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option, void *settings)
BEAD_OUTPUT_READER(bead_output_read_path);
BEAD_OUTPUT_READER(bead_output_read_fields);
BEAD_OUTPUT_READER(bead_output_read_beads);
BEAD_OUTPUT_READER(bead_output_read_size);
BEAD_OUTPUT_READER(bead_output_read_range);
BEAD_OUTPUT_READER(bead_output_read_sweep_range);
BEAD_OUTPUT_READER(bead_output_read_views);
BEAD_OUTPUT_READER(bead_output_read_chain);
BEAD_OUTPUT_READER(bead_output_read_panels);
BEAD_OUTPUT_READER(bead_output_read_captions);
BEAD_OUTPUT_READER(bead_output_read_card);
BEAD_OUTPUT_READER(bead_output_read_poster);
BEAD_OUTPUT_READER(bead_output_read_profile_times);
/* Does output `index`, of a kind known already, go with the scene's sweeps, or with none? And what it shows? */
BEAD_CHECK enum bead_error bead_output_check_sweep(const struct bead_reader *reader, const struct bead_at *at, size_t index);
BEAD_CHECK enum bead_error bead_output_check_sweep_shown(const struct bead_reader *reader, const struct bead_at *at,
                                                         const struct bead_output *output);
BEAD_OUTPUT_READER(bead_output_read_threshold);
BEAD_OUTPUT_READER(bead_output_read_magnetism);

/* `show` of plots and tables, and the keys that go with it (scene_show.c). */
BEAD_CHECK enum bead_error bead_output_check_show(const struct bead_reader *reader, const struct bead_at *at,
                                                  const struct bead_output *output);
/* How many files an entry of `outputs` names (0: an empty list), and the entry for one of them; NULL: no memory (scene_files.c). */
size_t bead_output_files(const struct bead_node *entry);
struct bead_node *bead_output_of_file(const struct bead_reader *reader, struct bead_node *entry, size_t file);
/* Forms of panels, behind those of outputs. */
enum { BEAD_FORM_IMAGE_PANEL = 1 << 2 * BEAD_OUTPUT_VECTOR, BEAD_FORM_PLOT_PANEL = 2 << 2 * BEAD_OUTPUT_VECTOR };

/* The settings of an output or panel, all but its path, size and place. */
BEAD_CHECK enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at, unsigned form,
                                                     struct bead_output *output);
/* What an output with panels must fit together in. */
BEAD_CHECK enum bead_error bead_output_check_panels(const struct bead_reader *reader, const struct bead_at *at,
                                                    const struct bead_output *output);
/* All that an output, or a panel, holds. */
void bead_output_free(struct bead_output *output);

/* What the keys of one movie must fit together in. */
BEAD_CHECK enum bead_error bead_output_check_movie(const struct bead_reader *reader, const struct bead_at *at,
                                                   const struct bead_output *output);
/* What the keys above have filled in. */
void bead_output_free_movie(struct bead_output *output);

#endif
