/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of output that only sweeps have, results and contact sheets, and the parts shared by plots, tables and reports of
 * sweeps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/chain/spins.h"
#include "sim/kinds/outputs.h"
#include "sim/statistics/statistics.h"

/* ---- shared ---- */

/* A plane needs two axes: numbers of cells and magnetisms, or two keys that are numbers. */
static BEAD_OUTPUT_CHECK(check_plane)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_sweep_spec *first = scene->sweeps;
    size_t keys = 0, numbers = 0, cells = 0, several = 0;
    for (size_t k = 0; k < first->over.key_count; k++) {
        const struct bead_over_key *key = &first->over.keys[k];
        bool all = key->count > 1 && !key->seed;
        for (size_t i = 0; i < key->count; i++)
            all = all && !isnan(key->value[i]);
        keys += !key->seed || strcmp(key->path, output->sweep_curves.against) == 0;
        numbers += all;
    }
    for (size_t i = 0; i < scene->sweep_count; i++) {
        cells += i == 0 || scene->sweeps[i].cells != first->cells;
        several += scene->sweeps[i].group_count > 1;
    }
    if (first->over.key_count > 0 ? keys == 2 && numbers == 2 && first->over.combine == BEAD_COMBINE_GRID
                                  : cells > 1 && several > 0)
        return BEAD_OK;
    return BEAD_WRONG_KEY(reader, at, "show",
                          first->over.key_count > 0
                              ? "is plane, by two keys: `over` must be a grid of two keys with several numbers each, and any seeds"
                              : "is plane, by number of cells and magnetism: it needs `sweeps` with different `cells`");
}

enum bead_show bead_sweep_lines(enum bead_sweep_show show)
{
    static const enum bead_show lines[] = {[BEAD_SWEEP_SENSORS] = BEAD_SHOW_SENSORS,
                                           [BEAD_SWEEP_SPECTRUM] = BEAD_SHOW_SPECTRUM,
                                           [BEAD_SWEEP_TRANSFER] = BEAD_SHOW_TRANSFER,
                                           [BEAD_SWEEP_DISPERSION] = BEAD_SHOW_DISPERSION};
    return show >= BEAD_SWEEP_SENSORS ? lines[show] : BEAD_SHOW_COUNT;
}

bool bead_sweep_runs_own(const struct bead_sweep_curves_asked *asked)
{
    return asked->show == BEAD_SWEEP_SPREADING || bead_sweep_lines(asked->show) != BEAD_SHOW_COUNT ||
           (asked->measure && *asked->measure);
}

/* Does one of the sweeps have what numbers and their statistics show? */
static enum bead_error check_numbers(const struct bead_reader *reader, const struct bead_at *at, const struct bead_output *output,
                                     const struct bead_sweep_spec *sweep)
{
    const struct bead_sweep_curves_asked *asked = &output->sweep_curves;
    const bool keys = sweep->over.key_count, decay = asked->show == BEAD_SWEEP_DECAY,
               spreading = asked->show == BEAD_SWEEP_SPREADING, plot = output->kind == BEAD_OUTPUT_PLOT;
    if (!keys && *asked->against && !(plot && !decay && bead_order_named(asked->against) < BEAD_ORDERS))
        return BEAD_WRONG_KEY(reader, at, "against",
                              "is given, but the sweep is over spins; plots of their peaks can be against `domain length`, "
                              "`spin correlation` or `spin correlation at 2`");
    if (!keys && output->plot.scale != BEAD_SCALE_LINEAR)
        return BEAD_WRONG_KEY(reader, at, "scale", "is given, but the sweep is over spins, whose axes are linear");
    if (keys && decay)
        return BEAD_WRONG_KEY(reader, at, "show", "decay is fitted for each magnetism, which a sweep over keys does not have");
    if (*asked->measure && (!keys || spreading || asked->show == BEAD_SWEEP_CONFIGURATIONS))
        return BEAD_WRONG_KEY(reader, at, "measure", "is given, but means of a measure are those of a sweep over keys");
    if (spreading && !(keys && reader->scene->sweep_count == 1))
        return BEAD_WRONG_KEY(reader, at, "show",
                              "spreading is averaged over the seeds of one sweep over keys: `sweep: {over: ...}`");
    if (spreading && isnan(reader->scene->simulate.until))
        return BEAD_WRONG_KEY(reader, at, "show",
                              "is spreading, of chains that run as long as each other: give `simulate: {until: ...}`");
    if (!spreading && output->kind == BEAD_OUTPUT_TABLE && !output->curves.uncertainty)
        return BEAD_WRONG_KEY(reader, at, "uncertainty", "is false, but a sweep measures that of peaks as it runs");
    if (decay && !sweep->measures.decay)
        return BEAD_WRONG_KEY(reader, at, "show", "decay is not measured; must have `measure: {decay: true}` in every sweep");
    if (!decay && !spreading && !sweep->measures.peak)
        return BEAD_WRONG_KEY(reader, at, "show", "peaks are not measured (measure: {peak: none}); must be decay");
    return BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_sweep_curves)
{
    static const char *const of_lines[] = {"field", "beads", "contacts", "every", "time", "window", "segment", "frequencies", NULL};
    const struct bead_scene *scene = reader->scene;
    const enum bead_sweep_show show = output->sweep_curves.show;
    if (output->shown.theory && show != BEAD_SWEEP_SPREADING)
        return BEAD_WRONG_KEY(reader, at, "theory", "belongs to `show: spreading`");
    if (bead_sweep_lines(show) != BEAD_SHOW_COUNT && !(scene->sweep_count == 1 && scene->sweeps[0].over.key_count))
        return BEAD_WRONG_KEY(reader, at, "show", "has curves of the chains of one sweep over keys: `sweep: {over: ...}`");
    if (bead_sweep_lines(show) != BEAD_SHOW_COUNT)
        return bead_output_check_lines(reader, at, output);
    BEAD_TRY(bead_without(reader, at, of_lines, "belongs to `show: sensors`, `spectrum`, `transfer` or `dispersion`"));
    if (output->kind == BEAD_OUTPUT_PLOT && show == BEAD_SWEEP_PLANE)
        BEAD_TRY(check_plane(reader, at, output));
    if (show == BEAD_SWEEP_DECAY && output->plot.range[0] <= 0)
        return BEAD_WRONG_KEY(reader, at, "range", "begins at %g; must be above 0: the axes of decay are logarithmic",
                              output->plot.range[0]);
    for (size_t i = 0; i < scene->sweep_count; i++)
        BEAD_TRY(check_numbers(reader, at, output, &scene->sweeps[i]));
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_threshold)
{
    const char *names[BEAD_CHOICES + 1] = {NULL};
    char **threshold = &((struct bead_output *)settings)->sweep_curves.threshold;
    const struct bead_threshold_info *info;
    unsigned found = 0;
    for (size_t i = 0; i < BEAD_CHOICES && (info = bead_threshold_info(i)); i++)
        names[i] = info->name;
    BEAD_TRY(bead_read_choice(reader, at, names, &found));
    free(*threshold);
    *threshold = strdup(names[found]);
    return *threshold ? BEAD_OK : bead_no_memory(reader);
}

const struct bead_option bead_threshold_row[1] = {
    {"threshold", BEAD_OPTION_CUSTOM, .initial = "law", .shape = "a name of --list thresholds", .like = "text",
     .read = read_threshold, .help = "how the threshold in magnetism is found", .example = "half"},
};

const struct bead_option bead_against_row[2] = {
    {"against", BEAD_OPTION_TEXT, BEAD_OF_OUTPUT(sweep_curves.against), .initial = "",
     .help = "of sweeps `over` keys: the key along the axis; default: the first that is not a seed. Seeds are averaged over, and "
             "each combination of the others has its own curve. Of plots over spins: `domain length`, `spin correlation` or `spin "
             "correlation at 2` (--list measures), a point for each configuration, instead of magnetism",
     .example = "chain.striker.velocity"},
    {"measure", BEAD_OPTION_TEXT, BEAD_OF_OUTPUT(sweep_curves.measure), .initial = "",
     .help = "of sweeps `over` keys: one of --list measures instead of the peak force, of chains that are run for it as `show: "
             "measures` runs one",
     .example = "front speed"},
};

/* ---- their results ---- */

static const struct bead_option sweep_rows[] = {
    BEAD_FILE_ROW("sweep", "FILE.h5", "sweep.h5"),
};
static const struct bead_options sweep_file_options = {"sweep", "spins and results of each configuration of a sweep",
                                                       BEAD_OPTIONS(sweep_rows), NULL, &bead_output_family};
const struct bead_output_type bead_sweep_output = {.sweep_options = &sweep_file_options, .stores_sweep = true};

/* ---- the sheet ---- */

/* Cells are whole numbers, so magnetisms asked for may be this far off. */
static const double sheet_near = 0.05;

static BEAD_OPTION_READER(read_magnetism)
{
    static const struct bead_option number = {.low = 0, .high = 1};
    struct bead_output *output = settings;
    bool one = at->node->kind == BEAD_NODE_SCALAR;
    size_t count = one ? 1 : at->node->count;
    if (one && strcmp(at->node->text, "auto") == 0)
        return BEAD_OK;
    if (at->node->kind == BEAD_NODE_MAP || count == 0)
        return bead_must_be(reader, at, option->shape);
    BEAD_TRY(bead_new(&output->sheet.magnetism, count, reader->msg, "an output"));
    for (size_t i = 0; i < count; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(bead_read_number(reader, &element, &number, &output->sheet.magnetism[i]));
    }
    output->sheet.magnetism_count = count;
    return BEAD_OK;
}

static const struct bead_option sheet_rows[] = {
    BEAD_FILE_ROW("sheet", BEAD_PICTURE_FILES, "sheet.png"),
    {"configurations", BEAD_OPTION_COUNT, BEAD_OF_OUTPUT(sheet.configurations), .initial = "auto", .low = 1, .high = 64,
     .word = "auto", .word_value = 0, .help = "pictures in a row; auto: as many as fit", .example = "6"},
    {"magnetism", BEAD_OPTION_CUSTOM, .initial = "auto", .shape = "auto, a number, or a list of numbers from 0 to 1",
     .like = "auto|number|[number]", .read = read_magnetism, .help = "magnetisms of the rows; auto: as many of the sweep's as fit",
     .example = "[1, 0.9, 0.5, 0]"},
};
static const struct bead_option_rows sheet_shared[] = {{BEAD_OPTIONS(bead_field_row)},       {BEAD_OPTIONS(bead_colormap_row)},
                                                       {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
                                                       {BEAD_OPTIONS(bead_orientation_row)}, {BEAD_OPTIONS(bead_page_rows)},
                                                       {BEAD_OPTIONS(bead_theme_rows)},      {NULL, 0}};
static const struct bead_options sheet_options = {"sheet",
                                                  "contact sheet of a sweep: small space-time images of many configurations, in "
                                                  "rows by magnetism, or with the values of the last "
                                                  "key `over` in each row; only these run",
                                                  BEAD_OPTIONS(sheet_rows), sheet_shared, &bead_output_family};

/* A row of a sheet must be a magnetism of one of the sweeps. */
static BEAD_OUTPUT_CHECK(check_sheet)
{
    BEAD_TRY(bead_output_check_field(reader, at, output));
    struct bead_at list = bead_at_key(at, "magnetism");
    for (size_t i = 0; i < output->sheet.magnetism_count; i++) {
        double nearest = INFINITY;
        for (size_t s = 0; s < reader->scene->sweep_count; s++) {
            for (size_t g = 0; g < reader->scene->sweeps[s].group_count; g++) {
                double m = reader->scene->sweeps[s].groups[g].magnetism;
                if (fabs(m - output->sheet.magnetism[i]) < fabs(nearest - output->sheet.magnetism[i]))
                    nearest = m;
            }
        }
        struct bead_at element = bead_at_item(&list, i);
        if (!isfinite(nearest))
            return bead_wrong(reader, &list, "is given, but the sweep has no magnetisms to choose from");
        if (fabs(nearest - output->sheet.magnetism[i]) > sheet_near)
            return bead_wrong(reader, &element, "is %g; the nearest of the sweep is %.4g", output->sheet.magnetism[i], nearest);
    }
    return BEAD_OK;
}

const struct bead_output_type bead_sheet_output = {
    .sweep_options = &sheet_options, .check_sweep = check_sheet, .draws = true, .shows_configurations = true};
