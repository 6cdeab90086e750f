/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows that the tables of several kinds of outputs share. */
#include <math.h>

#include "sim/kinds/outputs.h"

#define PLOT_SHOWS(SHOW)                                                                                                \
    SHOW("sensors", BEAD_SHOW_SENSORS), SHOW("peaks", BEAD_SHOW_PEAKS), SHOW("setup", BEAD_SHOW_SETUP),                 \
        SHOW("contact", BEAD_SHOW_CONTACT), SHOW("cell", BEAD_SHOW_CELL), SHOW("modes", BEAD_SHOW_MODES),               \
        SHOW("profiles", BEAD_SHOW_PROFILES), SHOW("bands", BEAD_SHOW_BANDS), SHOW("eigenmodes", BEAD_SHOW_EIGENMODES), \
        SHOW("energy", BEAD_SHOW_ENERGY), SHOW("spreading", BEAD_SHOW_SPREADING), BEAD_SPECTRA_SHOWS(SHOW)
static const char *const plot_shows[] = {PLOT_SHOWS(BEAD_WORD_OF), NULL};
static const unsigned plot_values[] = {PLOT_SHOWS(BEAD_VALUE_OF)};
static const char *const windows[] = {"hann", "none", NULL};
static const char *const energy_parts[] = {"form", "place", NULL};
static const char *const scales[] = {"linear", "sqrt", "log", NULL};
static const char *const normalisings[] = {"none", "first", "max", NULL};
static const char *const samplings[] = {"area", "max", NULL};
static const char *const styles[] = {"auto", "paper", "slide", "movie", NULL};
static const char *const themes[] = {"auto", "light", "dark", NULL};
static const char *const backgrounds[] = {"theme", "none", NULL};
static const char *const lights[] = {"contacts", "beads", "none", NULL};
static const char *const orientations[] = {"auto", "time-right", "time-down", "matrix", NULL};
#define FIELD_NAME(id, name, unit, title, place) name,
static const char *const fields[] = {BEAD_FIELDS(FIELD_NAME) NULL};

const struct bead_option_family bead_output_family = {"outputs", "outputs of kind"};

/* ---- shared: what of the chains ---- */

const struct bead_option bead_field_row[1] = {
    {"field", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(shown.field), .initial = "force", .choices = fields,
     .help = "the field to show; force is the bead force, the mean of the two contacts of a bead; compression, how far the beads "
             "of a contact overlap, damped or not; strain: of fput and shock"},
};
const struct bead_option bead_time_row[1] = {
    {"time", BEAD_OPTION_PAIR, BEAD_OF_OUTPUT(shown.time), BEAD_TIME_OF_MOTION, .initial = "auto", .word = "auto",
     .word_value = NAN, .help = "the span of time; auto: the whole run", .example = "[0.5 ms, auto]"},
};
const struct bead_option bead_beads_row[1] = {
    {"beads", BEAD_OPTION_CUSTOM, .initial = "all",
     .shape = "all, one number, last, [first, last] or first..last; 0 is the striker, auto the end",
     .like = "all|number|last|[2 number|last]", .read = bead_output_read_beads, .help = "which beads", .example = "[0, 40]"},
};
const struct bead_option bead_every_row[1] = {
    {"every", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(shown.every), .unit = "s", .of_motion = true, .initial = "auto", .low = 1e-12,
     .high = 1e3, .word = "auto",
     .help = "time between samples; auto: as short as the output needs; for spreading, whose laws are powers of time, only the "
             "first 64 samples are so close, then there are 32 more each time that the time since the first doubles",
     .example = "1 us"},
};
const struct bead_option bead_trust_row[1] = {
    {"trust", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(shown.trust), .initial = "false",
     .help = "compute twice, with different accuracies, and mark when the two start to differ by more than 1 % of the range of the "
             "picture"},
};

/* ---- shared: how it looks ---- */

const struct bead_option bead_page_rows[4] = {
    {"style", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(paper.style), .initial = "auto", .choices = styles,
     .help = "preset; paper: 8 pt STIX, 86 mm wide (178 mm for several chains side by side); slide: large type for a projector; "
             "movie: type and colours of movies; auto: paper where the size is a length, else screen"},
    {"dpi", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(paper.dpi), .initial = "600", .low = 10, .high = 4800,
     .help = "pixels per inch, where the size is a length, and for the raster in vector files", .example = "300"},
    {"size", BEAD_OPTION_CUSTOM, .initial = "auto",
     .shape = "[width, height], both in pixels (1 to 32768) or both lengths such as 86 mm; or auto", .like = "auto|[2 number]",
     .read = bead_output_read_size,
     .help = "size of the picture; auto: that of the style, else [1920, 1080], or [178 mm, 120 mm] in vector files (.pdf, .svg)",
     .example = "[178 mm, 75 mm]"},
    {"outlines", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(paper.outlines), .initial = "false",
     .help = "letters of .svg are outlines, the same everywhere; otherwise they are text, which can be searched and edited, in the "
             "fonts named, STIX or Lato, where they are installed"},
};
const struct bead_option bead_theme_rows[3] = {
    {"font", BEAD_OPTION_TEXT, BEAD_OF_OUTPUT(paper.font), .initial = "auto",
     .help = "family of all letters, one that is installed; auto: that of the style, STIX on paper, else Lato",
     .example = "DejaVu Sans"},
    {"theme", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(paper.theme), .initial = "auto", .choices = themes,
     .help = "colours of background and text; auto: dark for movies, else light"},
    {"background", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(paper.background), .initial = "theme", .choices = backgrounds,
     .help =
         "what is painted behind everything; none: nothing, so that the picture, with its panels, is transparent; letters and "
         "lines keep the colours of the theme. Stills of all formats can have none, and movies in webm, mov, apng, png and webp"},
};
const struct bead_option bead_caption_row[1] = {
    {"caption", BEAD_OPTION_TEXT, BEAD_OF_OUTPUT(still.caption),
     .help = "text below the picture; _x sets a subscript, ^{xy} a superscript, *x* italics, <b>x</b> bold",
     .example = "\"Peak force *F*_m of each contact\""},
};
const struct bead_option bead_colormap_row[1] = {
    {"colormap", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(colours.colormap), .initial = "auto", .shape = BEAD_COLORMAP_SHAPE,
     .like = "text", .read = bead_output_read_colormap,
     .help = "colour map, one of --list colormaps, reversed with _r; auto: zero looks like the page, with ember in light pictures, "
             "inferno in dark ones, and dawn and dusk for velocity, displacement and ranges about a static force",
     .example = "batlow"},
};
const struct bead_option bead_square_root_row[1] = {
    {"scale", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(colours.scale), .initial = "sqrt", .choices = scales,
     .help = "scale from values to colours"},
};
const struct bead_option bead_range_row[1] = {
    {"range", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(colours.range), .initial = "auto",
     .shape = "auto, or [low, high] in the unit of the field", .word = "auto", .word_value = NAN, .like = "auto|[2 number]",
     .read = bead_output_read_colour_range,
     .help = "values at the ends of the colour bar; auto: the range of the data, up to 1 % more for a round number; forces of a "
             "pressed "
             "chain whose contacts stay closed have linear colours about the static force; images leave "
             "out a short and narrow strike that would take more than half of it, and write its height beside the bar",
     .example = "[0, 45 N]"},
};
const struct bead_option bead_magnify_row[1] = {
    {"magnify", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(views.magnify), .initial = "auto", .low = 0, .high = 1e9, .open = BEAD_OPEN_LOW,
     .word = "auto", .help = "factor by which the views stage and beads enlarge displacements", .example = "1000"},
};
const struct bead_option bead_light_row[1] = {
    {"light", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(views.light), .initial = "contacts", .choices = lights,
     .help =
         "what lights up in the view stage. contacts: each contact by its force, brighter the larger it is; beads: whole beads, by "
         "the mean force of their contacts, or by the field where there are none; none: nothing"},
};
const struct bead_option bead_axes_row[1] = {
    {"axes", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(views.axes), .initial = "true",
     .help = "axes, labels and colour bar around the picture; false: only the views: a stage has fewer and larger beads, an image "
             "of spacetime alone has bead 0 in the top row (see orientation)"},
};
const struct bead_option bead_orientation_row[1] = {
    {"orientation", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(views.orientation), .initial = "auto", .choices = orientations,
     .help = "how space-time images lie. time-right: time to the right, bead 0 at the bottom; time-down: time down, bead 0 at the "
             "left; matrix: time to the right, bead 0 on top, only without axes; auto: in images time-right, but below beads or "
             "profile time-down, and with `axes: false` a spacetime alone as matrix; in movies and sheets always time-down"},
};

/* ---- images and movies ---- */

const struct bead_option bead_theory_row[1] = {
    {"theory", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(shown.theory), .initial = "false",
     .help = "over spacetime: a dashed line from the first bead, as fast as Nesterenko's solitary wave with the pulse's force, and "
             "its speed in words; for a striker's wave in equal Hertzian beads, or two kinds in turn, without precompression"},
};
/* Keys of images and of panels that are images. */
const struct bead_option bead_image_rows[3] = {
    {"sample", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(image.sampling), .initial = "area", .choices = samplings,
     .help = "what a pixel of spacetime shows; area: the mean of its samples; max: the sample furthest from 0, so that thin pulses "
             "keep their height"},
    {"views", BEAD_OPTION_CUSTOM, .initial = "[spacetime]", .shape = BEAD_VIEWS_LISTED "in a list", .like = "[text]",
     .read = bead_output_read_views, .help = "the views, from top to bottom", .example = "[beads, spacetime]"},
    {"at", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(image.at), BEAD_TIME_OF_MOTION, .initial = "auto", .word = "auto", .word_value = NAN,
     .help = "the time that views other than spacetime show; auto: the end", .example = "0.8 ms"},
};
/* ---- plots and tables ---- */

/* Keys of curves and of tables of their numbers. */
const struct bead_option bead_curves_rows[9] = {
    {"modes", BEAD_OPTION_COUNT, BEAD_OF_OUTPUT(curves.modes), .initial = "5", .low = 1, .high = BEAD_MODES,
     .help = "how many modes `show: modes` shows", .example = "4"},
    {"field", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(shown.field), .initial = "force", .choices = fields,
     .help = "the field that `show: profiles` shows, and that `show: sensors` and spectra show of beads; default for transfer and "
             "dispersion: velocity"},
    {"beads", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(curves.beads),
     .shape = "a number, last, 10..20, or a list of such; 0 is the striker", .like = "number|last|[number|last]",
     .read = bead_output_read_listed,
     .help = "with `show: sensors` and spectra, the beads whose `field` is shown, instead of those with a sensor; with `show: "
             "bead-peaks`, only these; with `show: energy`, beads past which the energy is shown, too",
     .example = "[20, 40]"},
    {"contacts", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(curves.contacts),
     .shape = "a number, last, 10..20, or a list of such; contact j is between beads j and j + 1, and bead 0 is the striker",
     .like = "number|last|[number|last]", .read = bead_output_read_listed,
     .help = "with `show: sensors`, the contacts whose force is shown over time, besides or instead of beads; with `show: peaks` "
             "of tables, only these; with `show: sensitivities`, those whose peaks are derived: by default both contacts of each "
             "bead with a sensor, or else the last contact whose force has had its maximum. Derivatives are good to 1e-6 of the "
             "largest of their kind where peaks are well-conditioned (laws with a power below 1.2: to 1e-4); none with damping. "
             "They take one more run, and about one for each contact",
     .example = "[40, last]"},
    {"at", BEAD_OPTION_CUSTOM, BEAD_TIME_OF_MOTION, .shape = "a list of times", .like = "number|[number]",
     .read = bead_output_read_profile_times,
     .help = "the times at which `show: profiles` shows the chain; one curve each, at most 12", .example = "[0.2 ms, 0.4 ms]"},
    {"parts", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(curves.parts), .initial = "form", .choices = energy_parts,
     .help = "the parts of `show: energy`. form: kinetic, of contacts, of the wall, of gravity, of springs, dissipated; place: of "
             "the front, that is of the first pulse up to where the contact force falls to a tenth; of what is behind it; "
             "reflected, that of beads that pass energy back; dissipated"},
    {"window", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(curves.window), .initial = "hann", .choices = windows,
     .help = "how spectra weight their samples: with Hann's window, for motion that goes on, or none, for pulses that end"},
    {"segment", BEAD_OPTION_NUMBER, BEAD_OF_OUTPUT(curves.segment), .unit = "s", .of_motion = true, .initial = "auto", .low = 0,
     .high = 1e12, .open = BEAD_OPEN_LOW, .word = "auto", .word_value = NAN,
     .help = "the length that spectra transform at once: lines are one or two over it wide. Half-overlapping segments are averaged "
             "by their squares (Welch); a spectrogram has a column for each, every eighth of its length. auto: all of `time`; in a "
             "spectrogram 2 sqrt(time / range of frequencies shown), which resolves as many times as frequencies",
     .example = "0.2 ms"},
    {"frequencies", BEAD_OPTION_PAIR, BEAD_OF_OUTPUT(curves.frequencies), .unit = "Hz", .initial = "auto", .low = 0, .high = 1e12,
     .word = "auto", .word_value = NAN,
     .help = "the frequencies that plots and tables of spectra show; auto: in plots up to the last with a thousandth of the "
             "largest amplitude, or beyond "
             "the highest band, in tables all up to half of the sampling rate",
     .example = "[0 Hz, 20 kHz]"},
};
/* Keys of plots and of panels that are plots. */
const struct bead_option bead_plot_rows[7] = {
    {"show", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(curves.show), .initial = "sensors", .choices = plot_shows, .values = plot_values,
     .help =
         "what to plot: the force at each sensor against time; the peak force of each contact, all chains in one plot (hollow "
         "where it was rising at the end, was larger later, or cannot be predicted; with bars of uncertainty from a "
         "hundredth on); the "
         "energies of modes against time; the energy against time, its parts stacked, those that fall below 0 as lines; spreading, "
         "second moment, participation and "
         "front of the energy with their power laws; profiles, a field along the chain at several "
         "times; bands, frequency against wave number "
         "of each repeated cell under its precompression; eigenmodes, participation against frequency of the small vibrations of "
         "each chain; " BEAD_SPECTRA_HELP "; or a schematic drawing of the "
         "experiment, of a contact or of the cells"},
    {"scale", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(plot.scale), .initial = "linear", .choices = scales,
     .help = "scale of the axis of peaks"},
    {"uncertainty", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(curves.uncertainty), .initial = "true",
     .help = "with `show: peaks`: how well they are known, from one or more other runs, as in tables; false: no such runs"},
    {"overlay", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(curves.overlay), .initial = "false",
     .help = "one panel for the curves of all chains, instead of one each; peaks always have one"},
    {"theory", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(shown.theory), .initial = "false",
     .help = "with `show: profiles` of `field: contact-force`: Nesterenko's solitary wave beside the highest pulse of each time, "
             "in chains of equal Hertzian beads without precompression, with the speed that follows from its force; with `show: "
             "spreading`: how the second moment grows where energy runs freely, as t^2, and where it diffuses, as t"},
    {"normalise", BEAD_OPTION_CHOICE, BEAD_OF_OUTPUT(plot.normalise), .initial = "none", .choices = normalisings,
     .help = "what the forces at sensors are divided by; first: the largest force at the first sensor of the same chain; max: the "
             "largest force at the same sensor"},
    {"range", BEAD_OPTION_CUSTOM, BEAD_OF_OUTPUT(plot.range), .initial = "auto",
     .shape = "auto, or [low, high] in N (plain numbers where forces are normalised)", .word = "auto", .word_value = NAN,
     .like = "auto|[2 number]", .read = bead_output_read_plot_range,
     .help = "ends of the axis of forces; auto: the range of the data", .example = "[0, 45 N]"},
};
const struct bead_option bead_measured_row[1] = {
    {"measured", BEAD_OPTION_CUSTOM, .shape = "a file of comma-separated values, or a list of some; see outputs.measured",
     .like = "text|outputs.measured|[outputs.measured]", .read = bead_output_read_measured,
     .help = "with `show: sensors`: measured curves, in the order of the computed ones, drawn over these, and in a panel below the "
             "differences, measured - computed",
     .example = "{file: scope.csv, columns: [time, force], time: 1 us, gain: 25 N}"},
};
