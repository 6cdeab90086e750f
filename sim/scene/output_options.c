/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of outputs, each with its table of keys: rows of its own and rows that several kinds share. What the values must be
 * like besides is checked in scene_output.c. */
#include <math.h>

#include "sim/scene/output_rows.h"

static const char *const plot_shows[] = {"sensors", "peaks", "setup", "contact", "cell", "modes", "profiles", NULL};
static const unsigned plot_values[] = {BEAD_SHOW_SENSORS, BEAD_SHOW_PEAKS, BEAD_SHOW_SETUP,   BEAD_SHOW_CONTACT,
                                       BEAD_SHOW_CELL,    BEAD_SHOW_MODES, BEAD_SHOW_PROFILES};
static const char *const sweep_plot_shows[] = {"median", "mean", "both", "decay", NULL};
static const char *const scales[] = {"linear", "sqrt", "log", NULL};
static const char *const normalisings[] = {"none", "first", "max", NULL};
static const char *const samplings[] = {"area", "max", NULL};
static const char *const styles[] = {"auto", "paper", "slide", "movie", NULL};
static const char *const themes[] = {"auto", "light", "dark", NULL};
static const char *const backgrounds[] = {"theme", "none", NULL};
#define FIELD_NAME(id, name, unit, title, place) name,
static const char *const fields[] = {BEAD_FIELDS(FIELD_NAME) NULL};

const char *const *bead_output_field_names(void)
{
    return fields;
}

/* ---- shared: what of the chains ---- */

const struct bead_option bead_field_row[1] = {
    {.key = "field",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(shown.field),
     .initial = "force",
     .choices = fields,
     .help = "the field to show; force is the bead force, the mean of the two contacts of a bead; strain: of fput and shock"},
};
const struct bead_option bead_time_row[1] = {
    {.key = "time",
     .type = BEAD_OPTION_PAIR,
     .offset = BEAD_OF_OUTPUT(shown.time),
     .unit = "s",
     .of_motion = true,
     .initial = "auto",
     .low = 0,
     .high = 1e6,
     .word = "auto",
     .word_value = NAN,
     .help = "the span of time; auto: the whole run",
     .example = "[0.5 ms, auto]"},
};
const struct bead_option bead_beads_row[1] = {
    {.key = "beads",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "all",
     .shape = "all, one number, or [first, last]; 0 is the striker",
     .help = "which beads",
     .example = "[0, 40]",
     .like = "all|number|[2 number]",
     .read = bead_output_read_beads},
};
const struct bead_option bead_every_row[1] = {
    {.key = "every",
     .offset = BEAD_OF_OUTPUT(shown.every),
     .unit = "s",
     .of_motion = true,
     .initial = "auto",
     .low = 1e-12,
     .high = 1e3,
     .word = "auto",
     .help = "time between samples; auto: as short as the output needs",
     .example = "1 us"},
};
const struct bead_option bead_trust_row[1] = {
    {.key = "trust",
     .type = BEAD_OPTION_FLAG,
     .offset = BEAD_OF_OUTPUT(shown.trust),
     .initial = "false",
     .help = "compute twice, to different accuracy, and mark when the two start to differ by more than 1 % of the range of the "
             "picture"},
};

/* ---- shared: how it looks ---- */

const struct bead_option bead_page_rows[4] = {
    {.key = "style",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(paper.style),
     .initial = "auto",
     .choices = styles,
     .help = "preset; paper: 8 pt STIX, 86 mm wide (178 mm for several chains side by side); slide: large type for a projector; "
             "movie: type and colours of movies; auto: paper where the size is a length, else screen"},
    {.key = "dpi",
     .offset = BEAD_OF_OUTPUT(paper.dpi),
     .initial = "600",
     .low = 10,
     .high = 4800,
     .help = "pixels per inch, where the size is a length, and for the raster in vector files",
     .example = "300"},
    {.key = "size",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "auto",
     .shape = "[width, height], both in pixels (1 to 32768) or both lengths such as 86 mm; or auto",
     .help = "size of the picture; auto: that of the style, else [1920, 1080], or [178 mm, 120 mm] in vector files (.pdf, .svg)",
     .example = "[178 mm, 75 mm]",
     .like = "auto|[2 number]",
     .read = bead_output_read_size},
    {.key = "outlines",
     .type = BEAD_OPTION_FLAG,
     .offset = BEAD_OF_OUTPUT(paper.outlines),
     .initial = "false",
     .help = "letters of .svg are outlines, the same everywhere; otherwise they are text, which can be searched and edited, in the "
             "fonts named, STIX or Lato, where they are installed"},
};
const struct bead_option bead_theme_rows[3] = {
    {.key = "font",
     .type = BEAD_OPTION_TEXT,
     .offset = BEAD_OF_OUTPUT(paper.font),
     .initial = "auto",
     .help = "family of all letters, one that is installed; auto: that of the style, STIX on paper, else Lato",
     .example = "DejaVu Sans"},
    {.key = "theme",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(paper.theme),
     .initial = "auto",
     .choices = themes,
     .help = "colours of background and text; auto: dark for movies, else light"},
    {.key = "background",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(paper.background),
     .initial = "theme",
     .choices = backgrounds,
     .help = "what is painted behind it all; none: nothing, the picture is transparent there, in the panels too, and letters and "
             "lines have the colours of the theme. Stills of all formats can have none, and movies in webm, mov, apng and png"},
};
const struct bead_option bead_caption_row[1] = {
    {.key = "caption",
     .type = BEAD_OPTION_TEXT,
     .offset = BEAD_OF_OUTPUT(still.caption),
     .help = "text below the picture; _x sets a subscript, ^{xy} a superscript, *x* italics",
     .example = "\"Peak force *F*_m of each contact\""},
};
const struct bead_option bead_colormap_row[1] = {
    {.key = "colormap",
     .type = BEAD_OPTION_CUSTOM,
     .offset = BEAD_OF_OUTPUT(colours.colormap),
     .initial = "auto",
     .shape = BEAD_COLORMAP_SHAPE,
     .like = "text",
     .read = bead_output_read_colormap,
     .help =
         "colour map, one of --list colormaps; auto: vik for velocity and displacement, inferno for dark pictures, else viridis",
     .example = "batlow"},
};
const struct bead_option bead_square_root_row[1] = {
    {.key = "scale",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(colours.scale),
     .initial = "sqrt",
     .choices = scales,
     .help = "scale from values to colours"},
};
const struct bead_option bead_range_row[1] = {
    {.key = "range",
     .type = BEAD_OPTION_CUSTOM,
     .offset = BEAD_OF_OUTPUT(colours.range),
     .initial = "auto",
     .shape = "auto, or [low, high] in the unit of the field",
     .word = "auto",
     .word_value = NAN,
     .help = "values at the ends of the colour bar; auto: the range of the data, up to 1 % more for a round number; images leave "
             "out a strike, short and narrow, that "
             "would "
             "take more than half of it, and say beside the bar how high it is",
     .example = "[0, 45 N]",
     .like = "auto|[2 number]",
     .read = bead_output_read_colour_range},
};
const struct bead_option bead_magnify_row[1] = {
    {.key = "magnify",
     .offset = BEAD_OF_OUTPUT(views.magnify),
     .initial = "auto",
     .low = 0,
     .high = 1e9,
     .open = BEAD_OPEN_LOW,
     .word = "auto",
     .help = "factor by which the view beads enlarges displacements",
     .example = "1000"},
};
const struct bead_option bead_axes_row[1] = {
    {.key = "axes",
     .type = BEAD_OPTION_FLAG,
     .offset = BEAD_OF_OUTPUT(views.axes),
     .initial = "true",
     .help = "axes, labels and colour bar around the picture; false: nothing but the views, and in an image of "
             "spacetime alone bead 0 in the top row (see orientation)"},
};
/* Of pictures with panels, and of the panels. */
static const struct bead_option panels_rows[] = {
    {.key = "panels",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a list of rows, each a list of panels such as [{field: force, chain: clean}, {show: peaks}]",
     .help = "several panels in one picture; a panel takes the keys of an image, or with `show` those of a plot, and `chain` and "
             "`title`; panels of one field share range and colour bar",
     .example = "[[{field: force, chain: clean}, {show: peaks}], [{field: velocity}]]",
     .like = "[[outputs.panel]]",
     .read = bead_output_read_panels},
    {.key = "letters",
     .type = BEAD_OPTION_FLAG,
     .offset = BEAD_OF_OUTPUT(still.letters),
     .initial = "true",
     .help = "(a), (b), ... at the panels"},
};
static const struct bead_option panel_rows[] = {
    {.key = "chain",
     .type = BEAD_OPTION_CUSTOM,
     .offset = BEAD_OF_OUTPUT(panel.chain),
     .initial = "all",
     .shape = "all, or the name of a chain",
     .help = "in panels: the chain whose waves are shown",
     .example = "clean",
     .like = "text",
     .read = bead_output_read_chain},
    {.key = "title",
     .type = BEAD_OPTION_TEXT,
     .offset = BEAD_OF_OUTPUT(panel.title),
     .help = "in panels: heading, instead of the name of the chain; set like `caption`",
     .example = "Peak forces"},
};

/* ---- images and movies ---- */

/* Of an image, be it a panel or not. */
static const struct bead_option image_rows[] = {
    {.key = "scale",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(colours.scale),
     .initial = "linear",
     .choices = scales,
     .help = "scale from values to colours"},
    {.key = "sample",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(image.sampling),
     .initial = "area",
     .choices = samplings,
     .help = "what a pixel of spacetime shows; area: the mean of its samples; max: the sample furthest from 0, so that thin pulses "
             "keep their height"},
    {.key = "views",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "[spacetime]",
     .shape = BEAD_VIEWS_LISTED "in a list",
     .help = "the views, from top to bottom",
     .example = "[beads, spacetime]",
     .like = "[text]",
     .read = bead_output_read_views},
    {.key = "at",
     .offset = BEAD_OF_OUTPUT(image.at),
     .unit = "s",
     .of_motion = true,
     .initial = "auto",
     .low = 0,
     .high = 1e6,
     .word = "auto",
     .word_value = NAN,
     .help = "the time that views other than spacetime show; auto: the end",
     .example = "0.8 ms"},
};
static const struct bead_option image_file[] = {
    BEAD_FILE_ROW("image", "FILE.png, .pdf or .svg", "force.png"),
};
static const struct bead_option_rows image_shared[] = {{BEAD_OPTIONS(bead_field_row)},       {BEAD_OPTIONS(bead_time_row)},
                                                       {BEAD_OPTIONS(bead_beads_row)},       {BEAD_OPTIONS(bead_every_row)},
                                                       {BEAD_OPTIONS(bead_colormap_row)},    {BEAD_OPTIONS(image_rows)},
                                                       {BEAD_OPTIONS(bead_range_row)},       {BEAD_OPTIONS(bead_magnify_row)},
                                                       {BEAD_OPTIONS(bead_trust_row)},       {BEAD_OPTIONS(bead_page_rows)},
                                                       {BEAD_OPTIONS(bead_theme_rows)},      {BEAD_OPTIONS(bead_axes_row)},
                                                       {BEAD_OPTIONS(bead_caption_row)},     {BEAD_OPTIONS(panels_rows)},
                                                       {BEAD_OPTIONS(bead_orientation_row)}, {NULL, 0}};
static const struct bead_options image_options = {"image", "a field over the chain and time, or a still of other views",
                                                  BEAD_OPTIONS(image_file), image_shared, &bead_output_family};
const struct bead_output_type bead_image_output = {.options = &image_options,
                                                   .checks = {bead_output_check_field, bead_output_check_still_views,
                                                              bead_output_check_times, bead_output_check_moment,
                                                              bead_output_check_trust, bead_output_check_panels},
                                                   .draws = true};

static const struct bead_option_rows image_panel_shared[] = {{BEAD_OPTIONS(bead_field_row)},
                                                             {BEAD_OPTIONS(bead_time_row)},
                                                             {BEAD_OPTIONS(bead_beads_row)},
                                                             {BEAD_OPTIONS(bead_every_row)},
                                                             {BEAD_OPTIONS(bead_colormap_row)},
                                                             {BEAD_OPTIONS(image_rows)},
                                                             {BEAD_OPTIONS(bead_range_row)},
                                                             {BEAD_OPTIONS(bead_magnify_row)},
                                                             {BEAD_OPTIONS(bead_trust_row)},
                                                             {BEAD_OPTIONS(bead_orientation_row)},
                                                             {NULL, 0}};
const struct bead_options bead_image_panel_options = {NULL, "a panel that is an image", BEAD_OPTIONS(panel_rows),
                                                      image_panel_shared, &bead_output_family};

/* ---- plots and tables ---- */

/* Of curves and of their numbers. */
const struct bead_option bead_curves_rows[3] = {
    {.key = "modes",
     .type = BEAD_OPTION_COUNT,
     .offset = BEAD_OF_OUTPUT(curves.modes),
     .initial = "5",
     .low = 1,
     .high = BEAD_MODES,
     .help = "how many modes `show: modes` shows",
     .example = "4"},
    {.key = "field",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(shown.field),
     .initial = "force",
     .choices = fields,
     .help = "the field that `show: profiles` shows"},
    {.key = "at",
     .type = BEAD_OPTION_CUSTOM,
     .unit = "s",
     .of_motion = true,
     .low = 0,
     .high = 1e6,
     .shape = "a list of times",
     .help = "the times at which `show: profiles` shows the chain; one curve each, at most 12",
     .example = "[0.2 ms, 0.4 ms]",
     .like = "number|[number]",
     .read = bead_output_read_profile_times},
};
/* Of a plot, be it a panel or not. */
static const struct bead_option plot_rows[] = {
    {.key = "show",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(curves.show),
     .initial = "sensors",
     .choices = plot_shows,
     .values = plot_values,
     .help = "what to plot: the force at each sensor against time; the peak force of each contact, all chains in one plot; the "
             "energies of modes against time; profiles, a field along the chain at several times; or a schematic drawing of the "
             "experiment, of a contact or of the cells"},
    {.key = "scale",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(plot.scale),
     .initial = "linear",
     .choices = scales,
     .help = "scale of the axis of peaks"},
    {.key = "normalise",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(plot.normalise),
     .initial = "none",
     .choices = normalisings,
     .help = "what the forces at sensors are divided by; first: the largest force at the first sensor of the same chain; max: the "
             "largest force at the same sensor"},
    {.key = "range",
     .type = BEAD_OPTION_CUSTOM,
     .offset = BEAD_OF_OUTPUT(plot.range),
     .initial = "auto",
     .shape = "auto, or [low, high] in N (plain numbers where forces are normalised)",
     .word = "auto",
     .word_value = NAN,
     .help = "ends of the axis of forces; auto: the range of the data",
     .example = "[0, 45 N]",
     .like = "auto|[2 number]",
     .read = bead_output_read_plot_range},
};
static const struct bead_option plot_file[] = {
    BEAD_FILE_ROW("plot", "FILE.png, .pdf or .svg", "[figure.pdf, figure.png]"),
    {.key = "contact",
     .type = BEAD_OPTION_COUNT,
     .offset = BEAD_OF_OUTPUT(plot.contact),
     .initial = "auto",
     .low = 0,
     .high = BEAD_SCENE_BEADS,
     .word = "auto",
     .word_value = BEAD_CONTACT_AUTO,
     .help = "the contact of the first chain that `show: contact` draws; contact j is between beads j and j + 1, and bead 0 is the "
             "striker",
     .example = "3"},
    {.key = "compression",
     .offset = BEAD_OF_OUTPUT(plot.compression),
     .initial = "0.2",
     .low = 0,
     .high = 0.6,
     .open = BEAD_OPEN_LOW,
     .help = "with `show: contact`: how far the smaller bead is flattened, as a fraction of its radius",
     .example = "0.1"},
};
static const struct bead_option_rows plot_shared[] = {{BEAD_OPTIONS(bead_curves_rows)}, {BEAD_OPTIONS(plot_rows)},
                                                      {BEAD_OPTIONS(bead_time_row)},    {BEAD_OPTIONS(bead_every_row)},
                                                      {BEAD_OPTIONS(bead_trust_row)},   {BEAD_OPTIONS(bead_page_rows)},
                                                      {BEAD_OPTIONS(bead_theme_rows)},  {BEAD_OPTIONS(bead_caption_row)},
                                                      {BEAD_OPTIONS(panels_rows)},      {NULL, 0}};
static const struct bead_options plot_options = {
    "plot", "curves of sensors against time, or of peaks along the chain; or a schematic drawing", BEAD_OPTIONS(plot_file),
    plot_shared, &bead_output_family};

static const struct bead_option_rows plot_panel_shared[] = {{BEAD_OPTIONS(bead_curves_rows)}, {BEAD_OPTIONS(plot_rows)},
                                                            {BEAD_OPTIONS(bead_time_row)},    {BEAD_OPTIONS(bead_every_row)},
                                                            {BEAD_OPTIONS(bead_trust_row)},   {NULL, 0}};
const struct bead_options bead_plot_panel_options = {NULL, "a panel that is a plot", BEAD_OPTIONS(panel_rows), plot_panel_shared,
                                                     &bead_output_family};
const struct bead_options bead_panel_options = {"outputs.panels",
                                                "a panel takes the keys of an image, or with `show` those of a plot, and these",
                                                BEAD_OPTIONS(panel_rows), NULL, NULL};

/* ---- of scenes with sweeps ---- */

static const struct bead_option sweep_rows[] = {
    BEAD_FILE_ROW("sweep", "FILE.h5", "sweep.h5"),
};
static const struct bead_options sweep_file_options = {"sweep", "spins and results of each configuration of a sweep",
                                                       BEAD_OPTIONS(sweep_rows), NULL, &bead_output_family};
const struct bead_output_type bead_sweep_output = {.sweep_options = &sweep_file_options, .stores_sweep = true};

static const struct bead_option sheet_rows[] = {
    BEAD_FILE_ROW("sheet", "FILE.png, .pdf or .svg", "sheet.png"),
    {.key = "configurations",
     .type = BEAD_OPTION_COUNT,
     .offset = BEAD_OF_OUTPUT(sheet.configurations),
     .initial = "auto",
     .low = 1,
     .high = 64,
     .word = "auto",
     .word_value = 0,
     .help = "pictures in a row; auto: as many as fit",
     .example = "6"},
    {.key = "magnetism",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "auto",
     .shape = "auto, a number, or a list of numbers from 0 to 1",
     .help = "magnetisms of the rows; auto: as many of the sweep's as fit",
     .example = "[1, 0.9, 0.5, 0]",
     .like = "auto|number|[number]",
     .read = bead_output_read_magnetism},
};
static const struct bead_option_rows sheet_shared[] = {{BEAD_OPTIONS(bead_field_row)},       {BEAD_OPTIONS(bead_colormap_row)},
                                                       {BEAD_OPTIONS(bead_square_root_row)}, {BEAD_OPTIONS(bead_range_row)},
                                                       {BEAD_OPTIONS(bead_orientation_row)}, {BEAD_OPTIONS(bead_page_rows)},
                                                       {BEAD_OPTIONS(bead_theme_rows)},      {NULL, 0}};
static const struct bead_options sheet_options = {
    "sheet", "contact sheet of a sweep: small space-time images of many configurations, in rows by magnetism; only these run",
    BEAD_OPTIONS(sheet_rows), sheet_shared, &bead_output_family};
const struct bead_output_type bead_sheet_output = {
    .sweep_options = &sheet_options, .check_sweep = bead_output_check_sheet, .draws = true};

const struct bead_option bead_threshold_row[1] = {
    {.key = "threshold",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "law",
     .shape = "a name of --list thresholds",
     .help = "how the threshold in magnetism is found",
     .example = "half",
     .like = "text",
     .read = bead_output_read_threshold},
};
static const struct bead_option sweep_plot_rows[] = {
    BEAD_FILE_ROW("plot", "FILE.png, .pdf or .svg", "[figure.pdf, figure.png]"),
    {.key = "show",
     .type = BEAD_OPTION_CHOICE,
     .offset = BEAD_OF_OUTPUT(sweep_curves.show),
     .initial = "both",
     .choices = sweep_plot_shows,
     .help = "force against magnetism, with median, mean, or both; or how peaks decay along the chain (measure: {decay: true}), "
             "without the last sixteenth of the random beads, whose largest force has not come when the front arrives at the end"},
    {.key = "range",
     .type = BEAD_OPTION_CUSTOM,
     .offset = BEAD_OF_OUTPUT(plot.range),
     .initial = "auto",
     .shape = "auto, or [low, high] in units of the clean chain's peak",
     .word = "auto",
     .word_value = NAN,
     .help = "ends of the axis of forces, and with `show: decay` of energies; auto: the range of the data",
     .example = "[0, 1.2]",
     .like = "auto|[2 number]",
     .read = bead_output_read_sweep_range},
};
static const struct bead_option_rows sweep_plot_shared[] = {{BEAD_OPTIONS(bead_threshold_row)},
                                                            {BEAD_OPTIONS(bead_page_rows)},
                                                            {BEAD_OPTIONS(bead_theme_rows)},
                                                            {BEAD_OPTIONS(bead_caption_row)},
                                                            {NULL, 0}};
static const struct bead_options sweep_plot_options = {"plot of a sweep", "force against magnetism, or peaks along the chain",
                                                       BEAD_OPTIONS(sweep_plot_rows), sweep_plot_shared, &bead_output_family};
const struct bead_output_type bead_plot_output = {.options = &plot_options,
                                                  .sweep_options = &sweep_plot_options,
                                                  .checks = {bead_output_check_times, bead_output_check_drawing,
                                                             bead_output_check_show, bead_output_check_trust,
                                                             bead_output_check_panels},
                                                  .check_sweep = bead_output_check_sweep_curves,
                                                  .shows = true,
                                                  .draws = true};
