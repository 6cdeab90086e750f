/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: which chain to strike, and which pictures to make.
 *
 *   struct bead_scene *scene;
 *   err = bead_scene_load(path, NULL, &scene, &msg);
 *   ... read it, make chains from it (chain.h), run it (session.h) ...
 *   bead_scene_free(scene);
 *
 * A scene is plain data, checked and with every default filled in; it does not change after loading. All numbers are SI. The keys,
 * units, defaults, ranges and help of the settings below are in one table for each structure (options.h), which makes parser, help
 * and error messages. */
#ifndef BEADREEL_SCENE_H
#define BEADREEL_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/kinds.h"
#include "beadreel/sample.h"

BEAD_BEGIN

/* A place in the scene's text, counted from 1; for messages `file:line:column: key: ...`. */
struct bead_place {
    size_t line, column;
};
/* The scene's text as a tree; each node knows its place. */
struct bead_yaml;
struct bead_node;

struct bead_material {
    char *name;
    char *label;    /* what pictures call it */
    double mass;    /* kg, of one bead; if not given, from density and radius; NaN for walls only */
    double radius;  /* m; NaN if the material is for walls only */
    double modulus; /* Pa, Young's */
    double poisson;
    double yield;     /* Pa, yield strength; 0: not known */
    double colour[3]; /* sRGB 0..1, how beads of it are drawn */
    /* Standard deviations of its beads, as parts of the value; 0: all beads are alike. Their density is the material's. */
    double radius_tolerance, modulus_tolerance;
    double gap;    /* m: free space to the left of each of its beads, except the first of the chain */
    double spring; /* N/m: of a spring that holds each of its beads in place */
    size_t of;     /* the material that it is a variant of, or itself */
    bool own;      /* the scene's or the user's own, with the name of a ready one */
};

enum bead_spins { BEAD_SPINS_UP, BEAD_SPINS_DOWN, BEAD_SPINS_DIGITS, BEAD_SPINS_RANDOM };

/* One entry of `beads`: `count` cells of the same beads. Spin 1 ("up") is the cell as written, 0 reversed. */
struct bead_segment {
    size_t *cell;      /* material indices, left to right */
    size_t cell_beads; /* >= 1 */
    size_t *each;      /* [count * cell_beads] materials of the cells as written, where they differ; NULL: all are `cell` */
    size_t count;      /* cells, >= 1 */
    enum bead_spins spins;
    bool spins_given; /* the scene has `spins`: these cells count for the magnetism of the chain */
    char *digits;     /* BEAD_SPINS_DIGITS: '0' and '1', one a cell */
    double magnetism; /* BEAD_SPINS_RANDOM: rounded to the nearest that `count` allows, majority up */
    uint64_t seed;
    char *sensor; /* name of the sensor on this (single) bead, or NULL */
    struct bead_place place;
};

enum bead_wall { BEAD_WALL_NONE, BEAD_WALL_RIGID, BEAD_WALL_MATERIAL };

struct bead_law; /* law.h */

/* A pair force and the numbers that its row needs. */
struct bead_law_spec {
    const struct bead_law *row; /* NULL: the system has no contacts */
    double power, coefficient;  /* of power: the exponent, and the force at a compression of 1 m, N/m^power */
    double alpha, stiffness;    /* of fpu-alpha: 1/m, N/m */
};

/* The numbers of an equation, without units. */
enum bead_ends { BEAD_ENDS_FIXED, BEAD_ENDS_PERIODIC };
enum bead_start_kind { BEAD_START_MODE, BEAD_START_PULSE, BEAD_START_SOLITONS, BEAD_START_COSINE, BEAD_START_SIMPLE_WAVE };
enum bead_moving { BEAD_MOVING_REST, BEAD_MOVING_RIGHT, BEAD_MOVING_LEFT };
enum { BEAD_SOLITONS = 8 };

struct bead_soliton {
    double speed, at; /* its centre at t = 0 */
};

/* Added to the force of a spring: where it is stretched or compressed by more than `beyond`, its linear part has this stiffness. */
struct bead_piecewise {
    double stiffness, beyond; /* beyond: 0: nowhere */
};

struct bead_equation_spec {
    size_t points;      /* fput: moving masses; kdv, shock: grid points, 0: chosen from the accuracy */
    double low, length; /* the domain: low <= x < low + length; fput: the left end's place, or the first mass's of a ring */
    enum bead_ends ends;
    double alpha, beta;                     /* fput: force of a spring stretched by r: r + alpha r^2 + beta r^3 */
    struct bead_piecewise piecewise;        /* fput */
    double drift, nonlinearity, dispersion; /* kdv: u_t + drift u_x + nonlinearity u u_x + dispersion u_xxx = 0 */
    double speed, epsilon;                  /* shock: u_tt = speed^2 u_xx (1 + epsilon u_x) */
    enum bead_field variable;               /* kdv: the field that the unknown is shown as */
    enum bead_start_kind start;
    size_t mode;                 /* number of the mode (mode), or of waves in the domain (cosine, simple wave) */
    double amplitude, width, at; /* of modes, pulses, waves; a pulse is amplitude sech^2((x - at) / width) */
    enum bead_moving moving;     /* fput, shock: the pulse is in the strain, and goes both ways or one */
    struct bead_soliton solitons[BEAD_SOLITONS];
    size_t soliton_count;
};

struct bead_system; /* system.h */

/* The state at time 0 of a bead that is not at rest. */
struct bead_start {
    size_t bead;
    double velocity, displacement; /* m/s, m */
};

/* A bead that is driven: one of the two waves is given. */
enum bead_wave { BEAD_WAVE_NONE, BEAD_WAVE_SINE, BEAD_WAVE_CHIRP, BEAD_WAVE_NOISE, BEAD_WAVE_POINTS };
/* A point of a measured wave: forces are straight between two, displacements a cubic spline. */
struct bead_wave_point {
    double time, value; /* s; in units of the amplitude */
    double bend;        /* second derivative, 1/s^2 */
};
struct bead_drive {
    size_t bead;
    enum bead_wave displacement, force;
    double amplitude;     /* m or N */
    double frequency, to; /* Hz; to: of chirps, at the end of the run */
    double ramp;          /* s */
    uint64_t seed;
    struct bead_wave_point *points; /* BEAD_WAVE_POINTS: [point_count], two or more, at rising times */
    size_t point_count;
};

struct bead_chain_spec {
    const struct bead_system *system; /* what it is; never NULL */
    char *name;                       /* "" for a single unnamed chain */
    char *title;                      /* the same as pictures show it: words for an identifier */
    char *label;                      /* a line under the name, or "" */
    /* For beads: */
    size_t striker_material;
    double striker_velocity;   /* m/s */
    struct bead_start *starts; /* besides bead 0's velocity, the striker's: by rising numbers of beads */
    size_t start_count;
    struct bead_drive drive; /* zeros: nothing is driven */
    struct bead_segment *segments;
    size_t segment_count;
    enum bead_wall wall;
    size_t wall_material; /* BEAD_WALL_MATERIAL */
    bool absorbs;         /* BEAD_WALL_NONE: a dashpot holds the last bead */
    double impedance;     /* kg/s: force over velocity of the dashpot; NaN: the chain's impedance */
    struct bead_law_spec law;
    double precompression;      /* N, >= 0: static force in every contact */
    double gap;                 /* m, >= 0: free space between every two beads behind the striker, besides the gaps of materials */
    double tilt;                /* rad, >= 0: the wall end is the lower one */
    double cradle;              /* m: the beads are pendulums of this length; 0: they are not */
    double damping_coefficient; /* N (s/m)^exponent */
    double damping_exponent;
    double damping_compression; /* exponent of the compression, in m, that multiplies the damping; 0: it does not depend on it */
    /* For the other systems: */
    struct bead_equation_spec equation;
    const struct bead_node *node; /* its place in the scene; NULL: made without a scene */
};

/* Beads in sweeps whose chains may differ in length. */
#define BEAD_LAST   SIZE_MAX
#define BEAD_MIDDLE 0

/* Measurements of every chain of a sweep. */
struct bead_sweep_measures {
    bool peak;       /* the largest bead force, first passage, over `beads`, or at each of `sensors` if there are any */
    size_t beads[2]; /* counted from the last random bead: 3, 5 are the third to the fifth behind it; or BEAD_LAST, BEAD_MIDDLE */
    char **sensors;  /* names */
    size_t sensor_count;
    bool decay; /* peaks of every bead's force and energy */
};

/* A key of the scene that a sweep gives other values. */
struct bead_over_key {
    char *path;    /* "chain.striker.velocity" */
    char *unit;    /* SI, of the values; "" where they have none */
    char **text;   /* [count] values as written in scenes */
    double *value; /* [count] in this unit; NaN: not a number */
    size_t count;
    bool seed;  /* values are averaged over: the path ends in `seed` */
    int digits; /* of values between two ends, in names: enough to distinguish them, four or more; 0: as written */
};
enum bead_combine { BEAD_COMBINE_GRID, BEAD_COMBINE_PAIRS };
struct bead_over {
    struct bead_over_key *keys; /* the last one changes first; with `pairs` all change together */
    size_t key_count;           /* 0: the sweep is over spins */
    enum bead_combine combine;
};

/* Configurations with the same statistics: `up` of the random cells are up. */
struct bead_sweep_group {
    double magnetism; /* of the chain: bead_chain_magnetism; NaN where spins are given one by one */
    size_t up;
    size_t configurations;
};

/* Many chains that differ in the spins of their random cells, or in the values of any keys. Chain `chain` of the scene is the
 * pattern; its cells with `spins: random` are the random ones, left to right. Over keys: `cells` is 0, and there is one group. */
struct bead_sweep_spec {
    char *name;  /* "" for a single unnamed sweep */
    char *title; /* the same as pictures show it */
    size_t chain;
    size_t cells;                    /* random cells */
    size_t asked;                    /* the scene's `cells`; 0: the pattern is the scene's own chain */
    size_t fixed;                    /* cells behind them, where `cells` is given */
    size_t last;                     /* the last random bead */
    bool own_magnetism;              /* every segment has its own: one group */
    struct bead_sweep_group *groups; /* by rising magnetism; given spins in their order */
    size_t group_count;
    char **spins;          /* [group_count], one digit a random cell, where the scene gives them; else NULL */
    size_t configurations; /* of each group; one if there is only one way to arrange the spins */
    uint64_t seed;
    bool whole; /* do not drop beads behind the front */
    struct bead_over over;
    struct bead_sweep_measures measures;
};

struct bead_simulate {
    double until;        /* s; NaN: until the first pulse has passed the end of the chain */
    double accuracy;     /* relative error wanted in first-passage peak forces */
    bool accuracy_given; /* else outputs may ask for more (sink.h) */
    bool statistical; /* of sweeps: errors of a hundredth of the standard error are enough; accuracy is then for everything else */
    char *method;     /* "auto" or a name from methods.h */
    double step;      /* s; 0: chosen from accuracy */
    bool verify;      /* accuracy as a guarantee: shorter steps until two runs agree to within it */
};

enum bead_show {
    BEAD_SHOW_SENSORS,
    BEAD_SHOW_PEAKS,
    BEAD_SHOW_BEAD_PEAKS,
    BEAD_SHOW_MEASURES,
    BEAD_SHOW_SETUP,
    BEAD_SHOW_CONTACT,
    BEAD_SHOW_CELL,
    BEAD_SHOW_MODES,
    BEAD_SHOW_PROFILES,
    BEAD_SHOW_CHAIN,
    BEAD_SHOW_ENERGY,
    BEAD_SHOW_SENSITIVITIES,
    BEAD_SHOW_EXTREMES,
    BEAD_SHOW_SPREADING,
    BEAD_SHOW_BANDS,
    BEAD_SHOW_EIGENMODES,
    BEAD_SHOW_SPECTRUM,
    BEAD_SHOW_SPECTROGRAM,
    BEAD_SHOW_TRANSFER,
    BEAD_SHOW_DISPERSION,
    BEAD_SHOW_FIT,
    BEAD_SHOW_COUNT
};
enum bead_taper { BEAD_WINDOW_HANN, BEAD_WINDOW_NONE };
enum { BEAD_CONTACT_AUTO = 1000000000, BEAD_MODES = 64, BEAD_PROFILE_TIMES = 12 };
/* Contents of plots and tables of sweeps: force against magnetism, forces of every configuration, peaks along the chain. */
enum bead_sweep_show {
    BEAD_SWEEP_MEDIAN,
    BEAD_SWEEP_MEAN,
    BEAD_SWEEP_BOTH,
    BEAD_SWEEP_DECAY,
    BEAD_SWEEP_MAGNETISM,
    BEAD_SWEEP_CONFIGURATIONS,
    BEAD_SWEEP_DEVIATION, /* of images, and the next two */
    BEAD_SWEEP_LOWER_QUARTILE,
    BEAD_SWEEP_UPPER_QUARTILE,
    BEAD_SWEEP_SPREADING, /* of sweeps over keys: runs the chains itself */
    BEAD_SWEEP_PLANE,     /* by two quantities: cells and magnetism, or two keys */
    BEAD_SWEEP_SENSORS,   /* of sweeps over keys, as are the next three: curves of the bead_show of that name, of chains that are
                           * run for them */
    BEAD_SWEEP_SPECTRUM,
    BEAD_SWEEP_TRANSFER,
    BEAD_SWEEP_DISPERSION
};
enum bead_parts { BEAD_PARTS_BY_FORM, BEAD_PARTS_BY_PLACE };
enum bead_scale { BEAD_SCALE_LINEAR, BEAD_SCALE_SQRT, BEAD_SCALE_LOG };
enum bead_normalise { BEAD_NORMALISE_NONE, BEAD_NORMALISE_FIRST, BEAD_NORMALISE_MAX };
enum bead_sampling { BEAD_SAMPLING_AREA, BEAD_SAMPLING_MAX };
enum bead_quality { BEAD_QUALITY_DRAFT, BEAD_QUALITY_STANDARD, BEAD_QUALITY_HIGH, BEAD_QUALITY_LOSSLESS };
enum bead_codec_asked { BEAD_CODEC_AUTO /* the container's usual one */, BEAD_CODEC_AV1 };
enum bead_style { BEAD_STYLE_AUTO, BEAD_STYLE_PAPER, BEAD_STYLE_SLIDE, BEAD_STYLE_MOVIE };
enum bead_theme { BEAD_THEME_AUTO, BEAD_THEME_LIGHT, BEAD_THEME_DARK };
enum bead_background { BEAD_BACKGROUND_THEME, BEAD_BACKGROUND_NONE };
enum bead_follow { BEAD_FOLLOW_ALL, BEAD_FOLLOW_FRONT };
enum bead_inset { BEAD_INSET_NONE, BEAD_INSET_CELL };
enum bead_layout {
    BEAD_LAYOUT_AUTO,
    BEAD_LAYOUT_STACKED,
    BEAD_LAYOUT_COLUMNS,
    BEAD_LAYOUT_GRID,
    BEAD_LAYOUT_OVERLAY,
    BEAD_LAYOUT_BESIDE,
    BEAD_LAYOUT_IMAGES, /* the best of those above */
    BEAD_LAYOUT_STAGE
};
enum bead_profile_of { BEAD_PROFILE_BEAD, BEAD_PROFILE_CELL }; /* the profile of a movie: of each bead, or over cells */
enum bead_type { BEAD_TYPE_NORMAL, BEAD_TYPE_LARGE };
enum bead_subtitles_of { BEAD_SUBTITLES_CAPTIONS, BEAD_SUBTITLES_WORDS };

/* ---- outputs: groups of settings that several kinds share ---- */

/* The part of the chains that is shown or stored. */
struct bead_shown {
    enum bead_field field;
    struct bead_span beads; /* {0, SIZE_MAX}: all */
    double time[2];         /* s; NaN: start or end of the run */
    double every;           /* s between samples; 0: as the output needs */
    bool trust;             /* mark when two runs of different accuracy begin to differ: image, movie, plot */
    bool theory;            /* the front that theory predicts, in space-time images; the solitary wave beside profiles */
};

/* Which way space-time images lie. Automatic: in images time to the right, but down below views of a moment, and bare pixels as a
 * matrix; in movies and sheets time down. */
enum bead_orientation {
    BEAD_ORIENTATION_AUTO,
    BEAD_TIME_RIGHT, /* time to the right, bead 0 at the bottom */
    BEAD_TIME_DOWN,  /* time down, bead 0 at the left */
    BEAD_MATRIX      /* time to the right, bead 0 on top, as in Octave's imagesc; only for pictures without axes */
};

/* Things that light up on the stage by their force: contacts, or whole beads. */
enum bead_light { BEAD_LIGHT_CONTACTS, BEAD_LIGHT_BEADS, BEAD_LIGHT_NONE };

/* Views of an image or a movie, from top to bottom. */
enum { BEAD_MOST_VIEWS = 8 };
struct bead_views_asked {
    unsigned kinds[BEAD_MOST_VIEWS];         /* a bead_view_kind; those of `own` count from BEAD_VIEW_KINDS on */
    const struct bead_view_type *const *own; /* as in bead_own; NULL: none */
    size_t count;                            /* 0 for kinds without the key `views`, such as plots, which draw curves */
    bool axes;                               /* false: bare pixels */
    double magnify;                          /* factor on displacements; 0: automatic */
    enum bead_orientation orientation;
    enum bead_light light;
};

/* From values to colours: image, movie, sheet. */
struct bead_colours_asked {
    char *colormap; /* NULL or "auto": automatic */
    enum bead_scale scale;
    double range[2]; /* SI; NaN: automatic */
};

/* Size and style of a picture or of a movie's frames. */
struct bead_paper {
    double size[2]; /* pixels, or metres where size_is_length */
    bool size_is_length;
    double dpi; /* for sizes in metres, and for rasters in vector files */
    enum bead_style style;
    enum bead_theme theme;
    enum bead_background background; /* what is painted behind everything */
    bool outlines;                   /* letters of SVG are outlines, not text */
    char *font;                      /* family of all letters; "auto": the style's */
};

/* Pictures, image and plot, of one or several panels. */
struct bead_still_asked {
    char *caption;              /* text below, or NULL */
    struct bead_output *panels; /* row by row: each an image or a plot without a path; NULL: none */
    size_t panel_count;
    bool letters; /* (a), (b), ... at the panels */
};

/* Of an output that is a panel. */
struct bead_panel_asked {
    size_t row;   /* from 0 */
    size_t chain; /* number of the only chain shown; SIZE_MAX: all */
    char *title;  /* or NULL */
};

/* Numbers of beads or contacts, rising. */
struct bead_listed {
    size_t *all; /* NULL: none are listed; BEAD_LAST: of each chain, if these differ */
    size_t count;
};

/* A measured curve at one place: rising times, s, and values, in the unit of the output's field. */
struct bead_measured {
    struct bead_wave_point *points;
    size_t count;
};

/* Curves and their numbers: plot, table. */
struct bead_curves_asked {
    enum bead_show show;
    size_t modes;                             /* how many, `show: modes` */
    double profile_times[BEAD_PROFILE_TIMES]; /* s, rising: `show: profiles` */
    size_t profile_time_count;
    bool uncertainty;         /* tables: with columns for it */
    struct bead_listed beads; /* that have curves or rows; none: curves for the beads with sensors, rows for all beads */
    struct bead_listed
        contacts; /* the same; for `show: sensitivities`, none: those of the beads with sensors, or the last with a maximum */
    bool overlay; /* the curves of all chains share one panel */
    enum bead_parts parts;          /* of the energy */
    enum bead_taper window;         /* of spectra */
    double segment;                 /* s: length of a transformed stretch; NaN: automatic */
    double frequencies[2];          /* Hz, range shown; NaN: automatic */
    struct bead_measured *measured; /* [measured_count], beside the curves of the first places */
    size_t measured_count;
};

/* Contents of plots and tables of sweeps. */
struct bead_sweep_curves_asked {
    enum bead_sweep_show show;
    char *threshold; /* the way to find the threshold: a name of statistics.h */
    char *against;   /* of sweeps over keys: the one along the axis; "": the first that is not a seed */
    char *measure;   /* of sweeps over keys: what is shown; "": peak forces */
};

/* ---- outputs: settings of one kind ---- */

struct bead_trajectory_asked {
    unsigned fields; /* BEAD_FIELD_BITs */
    char *xdmf;      /* file beside it, with which ParaView opens it, as `path`; NULL: none */
};

struct bead_image_asked {
    enum bead_sampling sampling; /* what a pixel shows of its samples: their mean or the largest */
    double at;                   /* s; time of a still with views other than spacetime; NaN: end */
};

/* A text that a movie shows while something happens. */
struct bead_caption {
    double at;      /* s of the motion: when it begins */
    double until;   /* s of the motion; NaN: not given */
    double lasting; /* s of the film; NaN: not given. Neither given: until the next caption; the last one as long as it takes to
                       read */
    double pause;   /* s of the film: how long the motion pauses when the caption appears */
    char *text;
};
/* A text that a movie ties to a thing on the stage. */
enum bead_note_of { BEAD_NOTE_FRONT, BEAD_NOTE_WALL, BEAD_NOTE_BEAD, BEAD_NOTE_CONTACT };
struct bead_note {
    struct bead_caption said; /* no pause */
    enum bead_note_of of;
    size_t number; /* of the bead, or of the contact behind bead `number` */
    size_t chain;  /* SIZE_MAX: all */
    bool arrow;
};
/* A point of the curve of speed. */
struct bead_speed {
    double at;     /* s of the motion */
    double factor; /* s of the motion per s of the film, > 0 */
};

/* The title card, shown before the motion. */
struct bead_card {
    double lasting; /* s of the film; 0: no card */
    char *text;     /* below the title, or "" */
};

/* The sound of a movie: a force, slowed like the picture. */
enum bead_sound_of { BEAD_SOUND_OFF, BEAD_SOUND_WALL, BEAD_SOUND_CONTACT, BEAD_SOUND_SENSOR };
struct bead_sound_asked {
    enum bead_sound_of of;
    size_t contact; /* BEAD_SOUND_CONTACT */
    char *sensor;   /* BEAD_SOUND_SENSOR: its name; else NULL */
};

struct bead_movie_asked {
    double fps, duration; /* 1/s, s; duration of the film, not of the motion */
    enum bead_quality quality;
    enum bead_layout layout;       /* arrangement of chains and views */
    enum bead_type type;           /* size of letters */
    struct bead_caption *captions; /* by rising times */
    size_t caption_count;
    struct bead_note *notes; /* as listed */
    size_t note_count;
    bool race;             /* of two chains: say at the leading front by how much it leads */
    enum bead_inset inset; /* a drawing beside the curve below a stage */
    double *stops;         /* s of the motion, rising: chapters, and where slides wait */
    size_t stop_count;
    char *slides;              /* an HTML file that plays the film from stop to stop, relative to the output directory; "": none */
    struct bead_speed *speeds; /* by rising times; NULL: constant, from `duration` */
    size_t speed_count;
    struct bead_card card;
    struct bead_sound_asked sound;
    enum bead_follow follow; /* what beads and profile show: all beads, or a window that moves with the front */
    size_t window;           /* beads in it */
    char *poster;            /* a PNG file of one frame, relative to the output directory; "": none */
    double poster_at;        /* s of the motion; NaN: where there is most to see */
    size_t modes;            /* how many the view `modes` shows */
    enum bead_profile_of profile;
    double strobe; /* s of the motion between samples, between which pictures blend; 0: every picture has its own sample */
    enum bead_codec_asked codec;
    enum bead_subtitles_of subtitles; /* WORDS: if there are no captions, what happens */
};

struct bead_plot_asked {
    enum bead_scale scale;         /* axis of the peaks */
    double range[2];               /* ends of the axis of forces; NaN: automatic */
    enum bead_normalise normalise; /* of sensors */
    size_t contact;     /* `show: contact`: its number; BEAD_CONTACT_AUTO: the first between beads of the chain, if it has one */
    double compression; /* `show: contact`: of the smaller bead, as a part of its radius */
};

struct bead_sheet_asked {
    size_t configurations; /* the most of each magnetism; 0: as many as fit */
    double *magnetism;     /* the rows, as asked; NULL: as many as fit */
    size_t magnetism_count;
};

/* One file of `outputs`. A key that does not belong to the kind is an error in the scene; settings of other kinds are zero, and
 * shared settings without a key in the kind are automatic: all beads, all times, ... */
struct bead_output {
    enum bead_output_kind kind;
    const struct bead_sink_type *own; /* the sink that makes it; NULL: one of the library's kinds */
    char *path;                       /* as written; relative to the output directory; NULL: a panel */
    const char *file;                 /* of the scene, for messages */
    const struct bead_node *node;     /* its entry there; NULL: made without a scene */
    size_t entry;                     /* number of the entry in the list; an entry may name several files */
    struct bead_shown shown;
    struct bead_views_asked views;
    struct bead_colours_asked colours;
    struct bead_paper paper;
    struct bead_still_asked still;
    struct bead_panel_asked panel;
    struct bead_curves_asked curves;
    struct bead_sweep_curves_asked sweep_curves;
    struct bead_trajectory_asked trajectory;
    struct bead_image_asked image;
    struct bead_movie_asked movie;
    struct bead_plot_asked plot;
    struct bead_sheet_asked sheet;
};

/* Parts that a program adds to the library's own: lists that end with NULL, or NULL. Scenes find the parts by their names. All must
 * outlive the scenes. */
struct bead_own {
    const struct bead_law *const *laws;        /* law.h */
    const struct bead_view_type *const *views; /* view.h */
    const struct bead_sink_type *const *sinks; /* sink.h: of outputs whose key is the sink's name */
};

/* A number of the scene that is fitted to measured curves. */
struct bead_fit_key {
    char *path, *unit;   /* "chain.striker.velocity", "m/s" */
    double first, value; /* as in the scene; as found */
    double error;        /* standard error of `value` */
};
enum { BEAD_FIT_KEYS = 8 };
struct bead_fit {
    struct bead_fit_key *keys;
    size_t count;
    size_t points; /* how many were compared; 0: not yet */
    double rms;    /* of their residuals, in the unit of the field */
};

struct bead_scene {
    char *file;             /* name for messages */
    struct bead_own own;    /* as given on loading */
    struct bead_yaml *tree; /* the file with the settings of the command line applied */
    char *text;             /* the whole YAML as run, settings of the command line applied (a copy that parses to this scene) */
    char *title;            /* "" where none */
    char *author;           /* "" where none */
    struct bead_material *materials;
    size_t material_count;
    struct bead_chain_spec *chains;
    size_t chain_count;
    struct bead_sweep_spec *sweeps; /* NULL: the chains are run, each once */
    size_t sweep_count;
    uint64_t fingerprint; /* of everything that the sweeps' results depend on; 0 if there are none */
    struct bead_simulate simulate;
    struct bead_output *outputs;
    size_t output_count;
    struct bead_fit fit;
    char *doubts; /* numbers without a unit that are hardly meant, a line each, for warnings; NULL: none */
};

/* A change of a scene: the value goes where the path leads, before the scene is read. */
struct bead_override {
    const char *origin;      /* what messages call the value's place: "--set". It ends, as does `path`, at a `=` */
    const char *path;        /* "chain.striker.velocity"; elements of lists by number or name; `+` appends one; "": the whole */
    const char *below;       /* where the path begins, "outputs.3"; NULL: at the top */
    struct bead_place place; /* of the value: number of the option, column in it */
    const char *value;       /* in YAML */
    const struct bead_node *node; /* instead of `value`: copied */
};
/* All changes of a scene, each laid over the result of the ones before. NULL or zeros: none. */
struct bead_overrides {
    const struct bead_override *all;
    size_t count;
    const char *const *settings; /* of --set, applied last: "simulate.step=0.1 us", "outputs.0.size=[640, 360]" */
    size_t setting_count;
    const char *config; /* file of the user's own settings, which fill in whatever else is left open: bead_config. NULL: none */
    const struct bead_own *own;    /* what the program adds; NULL: nothing, or the additions of the scene that is changed */
    const char *name;              /* of a loaded scene, in messages and in its files; NULL: its path */
    struct bead_chain_spec *shown; /* chains for the outputs to show, from several runs; NULL: the scene's own */
    size_t shown_count;
};

/* Load a scene from a file. On success *scene belongs to the caller; on failure it is NULL and the message reads
 * `file:line:column: key: what is wrong and what is allowed`, or `--set:number:column: ...`. Errors: SCENE, IO, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_scene_load(const char *path, const struct bead_overrides *overrides,
                                                    struct bead_scene **scene, struct bead_message *msg);
/* Reads a scene from memory; messages call it `name`. */
BEAD_API BEAD_CHECK enum bead_error bead_scene_parse(const char *name, const char *text, size_t length,
                                                     const struct bead_overrides *overrides, struct bead_scene **scene,
                                                     struct bead_message *msg);
BEAD_API void bead_scene_free(struct bead_scene *scene);

/* Reports an error of an output found after its scene was read: by its sink, or against a trajectory. Fails with
 * `file:line:column: KEY: ...`, or with the option that gave the key: `--size:1:1: size: ...`. The message begins with the key, as
 * in "size: leaves no room"; where the output does not give that key, the place is the output's. Errors: SCENE. */
BEAD_API enum bead_error bead_output_wrong(const struct bead_output *output, struct bead_message *msg, const char *format, ...)
    BEAD_PRINTF(3, 4);

/* Find a ready scene ("clean-vs-delocalised", "thesis/fig5", or "fig5" where only one folder has it) or keep the path of a file
 * that exists: fills `path` (size bytes). A name that is neither is an error that suggests the nearest. Errors: USAGE, IO, MEMORY.
 */
BEAD_API BEAD_CHECK enum bead_error bead_scene_find(const char *name, char *path, size_t size, struct bead_message *msg);

/* The ready scenes, by name; `title` is "" where the scene has none. To be freed with bead_scene_ready_free. Errors: IO, MEMORY. */
struct bead_ready_scene {
    char *name; /* "thesis/fig5" */
    char *title;
};
BEAD_API BEAD_CHECK enum bead_error bead_scene_ready(struct bead_ready_scene **scenes, size_t *count, struct bead_message *msg);
BEAD_API void bead_scene_ready_free(struct bead_ready_scene *scenes, size_t count);

BEAD_END

#endif
