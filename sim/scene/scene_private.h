/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside of scenes, shared by sim/scene*.c: one reader and one option table for each structure. */
#ifndef BEADREEL_SIM_SCENE_SCENE_PRIVATE_H
#define BEADREEL_SIM_SCENE_SCENE_PRIVATE_H

#include "beadreel/scene.h"
#include "sim/scene/options.h"

enum { BEAD_SCENE_CHAINS = 64, BEAD_SCENE_OUTPUTS = 1000, BEAD_SCENE_BEADS = 100000000 };

extern const struct bead_options bead_scene_options, bead_material_options, bead_tolerance_options, bead_chain_options,
    bead_striker_options, bead_segment_options, bead_damping_options, bead_simulate_options, bead_start_mode_options,
    bead_start_pulse_options, bead_start_cosine_options, bead_start_wave_options, bead_start_solitons_options, bead_soliton_options,
    bead_caption_options, bead_speed_options, bead_card_options, bead_sweep_options, bead_sweep_measure_options, bead_taper_options,
    bead_disorder_options;
extern const struct bead_option_family bead_equation_family, bead_law_family;
/* Table number `index` of those with a heading; NULL behind the last. */
const struct bead_options *bead_scene_section(size_t index);

/* Readers of custom options, with the signature of bead_option.read; `settings` is the structure of the row. */
enum bead_error bead_scene_read_materials(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                          void *settings);
enum bead_error bead_scene_read_segments(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                         void *settings);
enum bead_error bead_scene_read_sweep(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                      void *settings);
enum bead_error bead_scene_read_sweeps(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                       void *settings);
void bead_scene_free_sweeps(struct bead_scene *scene);
/* The sweep's groups, of the map at `at` and the random cells of its chain, which has been read. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_read_groups(const struct bead_reader *reader, const struct bead_at *at,
                                                  struct bead_sweep_spec *sweep);
/* A material's name to a size_t at the option's offset. */
enum bead_error bead_scene_read_material(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                         void *settings);

/* Fill one structure from the map at `at`; what was filled in before a failure is freed with the scene. */
BEAD_CHECK enum bead_error bead_scene_read_chain(struct bead_reader *reader, const struct bead_at *at,
                                                 struct bead_chain_spec *chain);
/* The same of a chain with the key `equation`. */
BEAD_CHECK enum bead_error bead_scene_read_equation(struct bead_reader *reader, const struct bead_at *at,
                                                    struct bead_chain_spec *chain);
BEAD_CHECK enum bead_error bead_scene_read_simulate(struct bead_reader *reader, const struct bead_at *at);
BEAD_CHECK enum bead_error bead_scene_read_outputs(struct bead_reader *reader, const struct bead_at *at);

/* Index of a material that has a radius and a mass (`bead`), or of any. */
BEAD_CHECK enum bead_error bead_scene_find_material(const struct bead_reader *reader, const struct bead_at *at, bool bead,
                                                    size_t *index);
/* Add the materials of assets/materials.yaml to the reader's scene. Errors: IO, SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_add_ready_materials(struct bead_reader *reader);

/* Where a key belongs that stands elsewhere: "outputs.N.colormap" into `text`; false: it is in none of the large sections. */
bool bead_scene_key_home(const char *key, char *text, size_t size);
/* Beads of a chain without its striker. */
size_t bead_scene_count_beads(const struct bead_chain_spec *chain);
/* Number of the last bead, or point, of a chain; `simulate` must have been read. */
size_t bead_scene_last_bead(const struct bead_scene *scene, size_t chain);
/* BEAD_FIELD_BITs of the fields that all chains of the scene have. */
unsigned bead_scene_fields(const struct bead_scene *scene);
/* Does any chain of the scene have a sensor? */
bool bead_scene_has_sensors(const struct bead_scene *scene);

/* ---- a user's own settings and files, on their way into a scene ---- */

/* The whole of a file, but no more than a scene may have: it could be a device. To be freed. Errors: IO, SCENE (too long), MEMORY.
 */
BEAD_CHECK enum bead_error bead_text_read(const char *path, char **text, size_t *length, struct bead_message *msg);

/* Is a value of `colormap` the name of a file of colours? */
bool bead_colours_are_file(const char *value);
/* Before the document is read, and with the ready materials in the reader's scene: adds what the user's settings (the file
 * `config`; NULL: none) have and the scene lacks, and writes the colours of files in place of their names. *changed: there was
 * something. Errors: SCENE, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_take_own(struct bead_reader *reader, const char *config, bool *changed);

#endif
