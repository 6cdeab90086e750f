/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beads that differ from their material: radius, mass and modulus of an entry of `beads`, taper, disorder. */
#ifndef BEADREEL_SIM_SCENE_SCENE_VARY_H
#define BEADREEL_SIM_SCENE_SCENE_VARY_H

#include "sim/scene/scene_private.h"

enum bead_varied { BEAD_VARIED_RADIUS, BEAD_VARIED_MASS, BEAD_VARIED_MODULUS, BEAD_VARIED_COUNT };

/* Random values: of their own, or factors. */
struct bead_distribution {
    enum { BEAD_ALWAYS, BEAD_UNIFORM, BEAD_NORMAL } kind;
    bool absolute;
    double low, high; /* uniform; of normal ones `high` is the standard deviation, a factor */
};

/* What the keys of an entry say; zero but for NaNs: nothing. */
struct bead_variation {
    double value[BEAD_VARIED_COUNT]; /* SI; NaN: as the material has it */
    double ratio;                    /* taper: of a radius to the one before; NaN: none */
    double ends[2];                  /* taper: radii of the first and the last bead, m; NaN: those of the materials */
    struct bead_distribution random[BEAD_VARIED_COUNT];
    size_t *materials; /* to draw from, one entry for each part; own; NULL: none */
    size_t material_count;
    uint64_t seed;
};
extern const struct bead_variation bead_variation_none;

/* Keys of entries of `beads`, at the variation's place in their structure. */
enum bead_error bead_scene_read_taper(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                      void *settings);
enum bead_error bead_scene_read_disorder(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                         void *settings);

/* The names in a list, "large-steel" or "2 ptfe" for two of them, as materials: *materials is the caller's, of *count. Errors:
 * SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_read_cell(struct bead_reader *reader, const struct bead_at *at, size_t **materials,
                                                size_t *count);

/* Give `count` segments, left to right, their values: of the cell where all are alike, else of each bead. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_vary_alike(const struct bead_reader *reader, const struct bead_at *at,
                                                 const struct bead_variation *variation, struct bead_segment *segments,
                                                 size_t count);
BEAD_CHECK enum bead_error bead_scene_vary_each(const struct bead_reader *reader, const struct bead_at *at,
                                                const struct bead_variation *variation, struct bead_segment *segments,
                                                size_t count);

#endif
