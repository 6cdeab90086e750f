/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside of scenes, shared by sim/scene*.c: one reader and one option table for each structure. */
#pragma once

/* For rows: a plain number beyond the usual ones was hardly meant, and the likely units are suggested. Softer than rubber; a bead
 * of half a metre; lighter than foam, heavier than osmium. */
#define BEAD_USUAL_MODULUS .usual = {1e5, 1e13}, .likely = BEAD_LIKELY("GPa", "MPa")
#define BEAD_USUAL_RADIUS  .usual = {0, 0.25}, .likely = BEAD_LIKELY("mm")
#define BEAD_LIGHTEST      10.0 /* kg/m3 */
#define BEAD_HEAVIEST      25000.0

#include "beadreel/scene.h"
#include "sim/kinds/scene_facts.h"
#include "sim/options/options.h"

enum { BEAD_SCENE_CHAINS = 64 };

extern const struct bead_options bead_scene_options, bead_material_options, bead_tolerance_options, bead_chain_options,
    bead_striker_options, bead_starting_options, bead_segment_options, bead_damping_options, bead_wall_options, bead_cradle_options,
    bead_piecewise_options, bead_drive_options, bead_simulate_options, bead_soliton_options, bead_sweep_options,
    bead_sweep_measure_options, bead_over_options, bead_taper_options, bead_disorder_options;
/* The laws that have settings, the equations, and their starts: NULL after the last. */
const struct bead_options *bead_law_options(size_t index);
const struct bead_options *bead_equation_options(size_t index);
const struct bead_options *bead_start_options(size_t index);
/* All tables of scenes, and number `index` of those with a heading; NULL after the last. */
extern const struct bead_option_tables bead_scene_tables;
const struct bead_options *bead_scene_section(size_t index);

/* Readers of custom options, with the signature of bead_option.read; `settings` is the structure of the row. */
BEAD_OPTION_READER(bead_scene_read_materials);
BEAD_OPTION_READER(bead_scene_read_segments);
BEAD_OPTION_READER(bead_scene_read_sweep);
BEAD_OPTION_READER(bead_scene_read_sweeps);
void bead_scene_free_sweeps(struct bead_scene *scene);
/* The value of `over`: its keys, and how many chains they make. What was read before a failure is freed with the scene. */
BEAD_CHECK enum bead_error bead_scene_read_over(struct bead_reader *reader, const struct bead_at *at, struct bead_over *over,
                                                size_t *points);
void bead_scene_free_over(struct bead_over *over);
void bead_scene_free_segment(struct bead_segment *segment);
/* A material's name to a size_t at the option's offset. */
BEAD_OPTION_READER(bead_scene_read_material);

/* Fill one structure from the map at `at`; what was filled in before a failure is freed with the scene. */
BEAD_CHECK enum bead_error bead_scene_read_chain(struct bead_reader *reader, const struct bead_at *at,
                                                 struct bead_chain_spec *chain);
/* Makes the chains of the scene, of beads by default. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_scene_make_chains(const struct bead_reader *reader, size_t count);
/* Reads a chain with the key `equation`. */
BEAD_CHECK enum bead_error bead_scene_read_equation(struct bead_reader *reader, const struct bead_at *at,
                                                    struct bead_chain_spec *chain);
BEAD_CHECK enum bead_error bead_scene_read_simulate(struct bead_reader *reader, const struct bead_at *at);

/* Index of a material that has a radius and a mass (`bead`), or of any. */
BEAD_CHECK enum bead_error bead_scene_find_material(const struct bead_reader *reader, const struct bead_at *at, bool bead,
                                                    size_t *index);
/* Add the materials of assets/materials.yaml to the reader's scene. Errors: IO, SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_add_ready_materials(struct bead_reader *reader);

/* Names as people read them: "large steel" for "large-steel"; names with spaces or capitals stay as they are. To be freed; NULL:
 * out of memory. */
char *bead_words_of(const char *name);
/* Fills in the titles of chains and sweeps. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_scene_find_words(struct bead_reader *reader);

/* ---- a user's own settings and files, on their way into a scene ---- */

/* Is a value of `colormap` the name of a file of colours? */
bool bead_colours_are_file(const char *value);
/* Called before the document is read, with the ready materials in the reader's scene: adds settings of the user (the file `config`;
 * NULL: none) that the scene lacks, and replaces names of colour files by the colours. *changed: it did any of this. Errors: SCENE,
 * IO, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_take_own(struct bead_reader *reader, const char *config, bool *changed);

/* ---- beads that differ from their material: radius, mass and modulus of an entry of `beads`, or of the striker, taper, disorder;
 * the gaps before them, and springs that hold them ---- */

enum bead_varied {
    BEAD_VARIED_RADIUS,
    BEAD_VARIED_MASS,
    BEAD_VARIED_MODULUS,
    BEAD_VARIED_GAP,
    BEAD_VARIED_SPRING,
    BEAD_VARIED_COUNT
};

/* Random values: absolute, or factors. */
struct bead_distribution {
    enum { BEAD_ALWAYS, BEAD_UNIFORM, BEAD_NORMAL } kind;
    bool absolute;
    double low, high; /* uniform: limits; normal: `high` is the standard deviation, a factor */
};

/* The keys of an entry; those not given are zero, or NaN. */
struct bead_variation {
    double value[BEAD_VARIED_COUNT]; /* SI; NaN: as the material has it */
    double ratio;                    /* taper: of each radius to the one before; NaN: none */
    double ends[2];                  /* taper: radii of the first and the last bead, m; NaN: those of the materials */
    struct bead_distribution random[BEAD_VARIED_COUNT];
    size_t *materials; /* to draw from, one entry for each part; own; NULL: none */
    size_t material_count;
    size_t alike; /* number of neighbours that share a draw */
    bool shuffle; /* the beads of each cell are in random order */
    uint64_t seed;
};
extern const struct bead_variation bead_variation_none;

/* Paths name the elements of lists by their `name` or `sensor`, and outputs by their file. */
enum { BEAD_NAMINGS = BEAD_OUTPUT_KINDS + 3 };
void bead_scene_naming(const char *naming[BEAD_NAMINGS]);
/* The SI unit of a number with a unit; "" if it has none, or is not a number. */
const char *bead_scene_unit_of(const struct bead_reader *reader, const char *text);
BEAD_OPTION_READER(bead_scene_read_fit); /* after `outputs` */
void bead_scene_free_fit(struct bead_fit *fit);
BEAD_OPTION_READER(bead_scene_read_drive); /* a key of chains, after `beads` and `start` */

/* A key of entries of `beads`, at the variation's place in their structure. */
BEAD_OPTION_READER(bead_scene_read_taper);

/* The materials named in a list, "large-steel" or "2 ptfe" for two of them: *count *materials, which are the caller's. Errors:
 * SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_read_cell(struct bead_reader *reader, const struct bead_at *at, size_t **materials,
                                                size_t *count);

/* Rows of radius, mass and modulus; `at`: where the table's structure has a bead_variation. */
#define BEAD_VARIED_ROW(at, what, name, si, least, most, opened, words, sample, ...)                                        \
    {                                                                                                                       \
        .key = name, .type = BEAD_OPTION_NUMBER, .offset = (at) + offsetof(struct bead_variation, value[what]), .unit = si, \
        .low = least, .high = most, .open = opened, .help = words, .example = sample, __VA_ARGS__                           \
    }

/* Give `count` segments, left to right, their values: for the cell if all beads are alike, else for each bead. Errors: SCENE,
 * MEMORY. */
BEAD_CHECK enum bead_error bead_scene_vary_alike(const struct bead_reader *reader, const struct bead_at *at,
                                                 const struct bead_variation *variation, struct bead_segment *segments,
                                                 size_t count);
BEAD_CHECK enum bead_error bead_scene_vary_each(const struct bead_reader *reader, const struct bead_at *at,
                                                const struct bead_variation *variation, struct bead_segment *segments,
                                                size_t count);
