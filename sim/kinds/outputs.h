/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of the kinds of outputs: rows, readers and checks shared by their tables, and the list of outputs. */
#pragma once

#include "sim/kinds/output_kinds.h"
#include "sim/kinds/scene_facts.h"

/* ---- rows ---- */

#define BEAD_OF_OUTPUT(member) offsetof(struct bead_output, member)

/* The first row of a kind: its key has the file as its value. */
#define BEAD_FILE_ROW(name, files, sample)                                                                                         \
    {                                                                                                                              \
        .key = name, .type = BEAD_OPTION_CUSTOM, .required = true, .shape = files, .example = sample,                              \
        .help = "name of the file, or a list of names for the same contents", .like = "text|[text]", .read = bead_output_read_path \
    }

/* The formats of stills. */
#define BEAD_PICTURE_FILES "FILE.png, .pdf, .svg, .eps, .jpg, .jpeg, .tif, .tiff, .webp or .avif"

/* The words of a choice with their values, in one list of pairs, from which follow its `choices` and `values`. */
#define BEAD_WORD_OF(word, value)  word
#define BEAD_VALUE_OF(word, value) value

/* `show` of spectra, in plots and tables. */
#define BEAD_SPECTRA_SHOWS(SHOW)                                                                                            \
    SHOW("spectrum", BEAD_SHOW_SPECTRUM), SHOW("spectrogram", BEAD_SHOW_SPECTROGRAM), SHOW("transfer", BEAD_SHOW_TRANSFER), \
        SHOW("dispersion", BEAD_SHOW_DISPERSION)
#define BEAD_SPECTRA_HELP                                                                                                          \
    "spectrum, amplitude against frequency of the curves that sensors have, whose squares add up to twice the mean square (times " \
    "3/2 with Hann's window); spectrogram, that of one curve over time; transfer, the ratio of each curve to that of the driven "  \
    "bead; dispersion, amplitude against wave number and frequency of all beads of the cells that a chain repeats, with their "    \
    "exact bands"

/* Keys, and help, of curves of the chains of a sweep. */
#define BEAD_SWEEP_LINES_ROWS                                                            \
    {bead_curves_rows + 1, 3}, {bead_curves_rows + 6, 3}, {BEAD_OPTIONS(bead_time_row)}, \
    {                                                                                    \
        BEAD_OPTIONS(bead_every_row)                                                     \
    }
#define BEAD_SWEEP_LINES_HELP                                                                                                    \
    "Over keys also sensors, spectrum, transfer and dispersion, as of a single chain, of chains that are run for them: a curve " \
    "for "                                                                                                                       \
    "each combination of values, the mean over seeds with its standard error (of amplitudes, where there are any), and the "     \
    "number "                                                                                                                    \
    "of chains; without `until` to the time at which the last front arrives"

/* The names of all views, for the shape of a value: "beads, profile, ". */
#define BEAD_VIEW_LISTED(ID, view, ...) #view ", "
#define BEAD_VIEWS_LISTED               BEAD_VIEWS(BEAD_VIEW_LISTED)

/* Rows that kinds share. What of the chains: */
extern const struct bead_option bead_field_row[1], bead_time_row[1], bead_beads_row[1], bead_every_row[1], bead_trust_row[1],
    bead_theory_row[1];
/* Curves and tables of their numbers; sweeps: */
extern const struct bead_option bead_curves_rows[9], bead_plot_rows[7], bead_threshold_row[1], bead_against_row[2],
    bead_measured_row[1];
/* Images and panels that are images; pictures with panels: */
extern const struct bead_option bead_image_rows[3], bead_panels_rows[2];
/* Appearance: style, dpi, size; colours of the paper; text below; and of values as colours. */
#define BEAD_COLORMAP_SHAPE "a name, a text file such as mine.txt, or colours such as \"#000000 #ff8000 #ffffff\""
extern const struct bead_option bead_page_rows[4], bead_theme_rows[3], bead_caption_row[1], bead_colormap_row[1],
    bead_square_root_row[1], bead_range_row[1], bead_magnify_row[1], bead_light_row[1], bead_axes_row[1], bead_orientation_row[1];

/* ---- readers of values that are more than a number, a word or a choice ---- */

BEAD_OPTION_READER(bead_output_read_path);
BEAD_OPTION_READER(bead_output_read_fields);
BEAD_OPTION_READER(bead_output_read_beads);
BEAD_OPTION_READER(bead_output_read_listed);
/* The number of a bead or a contact that some chain has, or `last`. */
BEAD_CHECK enum bead_error bead_output_read_place(const struct bead_reader *reader, const struct bead_at *at, bool contact,
                                                  size_t *index);
BEAD_OPTION_READER(bead_output_read_measured);
BEAD_OPTION_READER(bead_output_read_size);
BEAD_OPTION_READER(bead_output_read_colormap);
BEAD_OPTION_READER(bead_output_read_frame_size);
BEAD_OPTION_READER(bead_output_read_colour_range);
BEAD_OPTION_READER(bead_output_read_plot_range);
BEAD_OPTION_READER(bead_output_read_sweep_range);
BEAD_OPTION_READER(bead_output_read_views);
BEAD_OPTION_READER(bead_output_read_captions);
BEAD_OPTION_READER(bead_output_read_notes);
BEAD_OPTION_READER(bead_output_read_stops);
BEAD_OPTION_READER(bead_output_read_speeds);
BEAD_OPTION_READER(bead_output_read_card);
BEAD_OPTION_READER(bead_output_read_profile_times);

/* The chain of this name; SIZE_MAX: "all". Errors: SCENE. */
BEAD_CHECK enum bead_error bead_output_find_chain(struct bead_reader *reader, const struct bead_at *at, const char *shape,
                                                  size_t *chain);

/* ---- checks, for the types of kinds ---- */

BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_times);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_moment);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_views);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_still_views);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_drawing);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_field);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_field_list);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_theory);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_trust);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_sweep_curves);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_plot_trust);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_panels);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_captions);
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_notes);
/* Is a caption or a note that was just read valid? */
BEAD_CHECK enum bead_error bead_output_check_said(struct bead_reader *reader, const struct bead_at *at,
                                                  const struct bead_caption *said);
/* Notes have all but the last, `pause`. */
extern const struct bead_option bead_caption_rows[5];
/* Checks that the keys go with `show`, by its row in the table that was read. */
BEAD_CHECK enum bead_error bead_output_check_show(const struct bead_reader *reader, const struct bead_at *at,
                                                  const struct bead_output *output, const struct bead_options *options);
/* The same for curves of the chains of a sweep. */
BEAD_CHECK BEAD_OUTPUT_CHECK(bead_output_check_lines);
/* Do all chains have modes, as the value of a key requires? */
BEAD_CHECK enum bead_error bead_output_need_modes(const struct bead_reader *reader, const struct bead_at *at, const char *key);
/* Can the size be drawn? */
BEAD_CHECK enum bead_error bead_output_check_size(const struct bead_reader *reader, const struct bead_at *at,
                                                  const struct bead_paper *paper);

/* The value of `outputs`. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_read_outputs(struct bead_reader *reader, const struct bead_at *at);

/* Traits shared by all outputs of a program's own sinks; their settings, by the table that the sink makes from it. */
extern const struct bead_output_type bead_own_output;
/* Is every sink complete, with a name that is not a kind's? Errors: USAGE. */
BEAD_CHECK enum bead_error bead_output_check_own(const struct bead_own *own, struct bead_message *msg);

/* Settings for which a kind has no key. */
extern const struct bead_output bead_output_automatic;
/* The settings of an output or panel, which begins as bead_output_automatic, with its kind and place, by the tables and checks of
 * `type`. */
BEAD_CHECK enum bead_error bead_output_read_settings(struct bead_reader *reader, const struct bead_at *at,
                                                     const struct bead_output_type *type, struct bead_output *output);
/* All that an output, or a panel, holds. */
void bead_output_free(struct bead_output *output);

/* Frees the settings of movies. */
void bead_output_free_movie(struct bead_output *output);
