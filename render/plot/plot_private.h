/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Data common to all kinds of plots, and the table of functions that each kind fills in. */
#pragma once

#include "render/plot/plot_data.h"
#include "render/view/sensor_curves.h"
#include "sim/measure/recorded.h"
#include "sim/measure/spectra.h"
#include "sim/measure/spreading.h"
#include "sim/statistics/statistics.h"

/* Memory of a plot, which is freed with it. */
struct plot_store {
    struct plot_block *last;
};
/* Makes *pointer a cleared array of `count` elements. Errors: MEMORY. */
#define plot_new(store, pointer, count, msg) plot_allocate((store), (pointer), (count), sizeof **(pointer), (msg))
BEAD_CHECK enum bead_error plot_allocate(struct plot_store *store, void *pointer, size_t count, size_t size,
                                         struct bead_message *msg);
void plot_store_free(struct plot_store *store);

/* Texts of a panel besides the labels of its series: titles of axes, words at rulers. */
enum { PLOT_TEXTS = 3 };
typedef char plot_text[300];

/* A panel's data. */
struct plot_panel {
    struct bead_panel *shown;
    size_t chain;
    struct bead_curves curves, differences; /* of sensors; differences from the comparison run if requested */
    struct bead_recorded recorded;          /* of sensors with measured data */
    struct bead_series *series;
    double *values;
    plot_text *labels;
    size_t texts;                     /* used of these, where they are taken one after the other */
    size_t taken;                     /* samples, for numbers against time */
    struct bead_ruler ruler, *rulers; /* one, or all of them */
    struct bead_spectral spectral;    /* of spectra; its values, those of any image, are freed with the panel */
    struct bead_graph_image image;
    char title[768];
};

struct bead_plot_data {
    struct plot_store store;
    const struct bead_output *output;
    struct bead_run_context context;
    size_t chain; /* SIZE_MAX: all */
    double time[2];
    struct bead_grid grid;
    double *sample;                     /* of one time, [sensors]; for numbers against time: the times */
    size_t numbers;                     /* at each of these times */
    struct bead_energy_front *fronts;   /* [chains], of energies */
    struct bead_spreading *spreading;   /* [panels] */
    struct bead_profile_times *moments; /* of profiles */
    struct bead_spectra *spectra;
    struct plot_panel *parts;
    struct bead_panel *panels;
    struct bead_series *overlaid; /* of all panels, in the first; NULL: each has its own */
    plot_text *overlaid_labels;
    size_t count;
    bool residuals; /* there are twice as many panels and parts: the second half has differences from measured values */
    bool apart[2];  /* along x and y each panel has its own range */
    char why[96], axis_title[384];
};

struct plot_kind {
    enum bead_show show;
    enum bead_error (*create)(struct bead_plot_data *data, struct bead_message *msg);
    void (*needs)(const struct bead_plot_data *data, struct bead_needs *needs); /* other than the times; NULL: no samples */
    enum bead_error (*feed)(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg); /* or NULL */
    enum bead_error (*finish)(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg);
};

/* Allocates panels, with their titles. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_reserve(struct bead_plot_data *data, size_t panels, struct bead_message *msg);
/* Allocates series, texts and values for panel `p`, which has none yet. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_reserve_series(struct bead_plot_data *data, size_t p, size_t series, size_t values,
                                               struct bead_message *msg);
/* Adds a series, for which there is room. */
struct bead_series *plot_add(struct plot_panel *part, struct bead_series series);
/* Adds one of `count` points with this many columns of numbers of its own, the next of the panel's values: x, y unless it has them,
 * others. Returns them. */
double *plot_add_numbers(struct plot_panel *part, struct bead_series series, size_t count, size_t columns);
/* The one added last. */
struct bead_series *plot_last(const struct plot_panel *part);
/* The next of the panel's texts. */
char *plot_next_text(struct plot_panel *part);
/* Allocates a panel, titled with the chain's name, for each chain shown. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_reserve_chains(struct bead_plot_data *data, size_t series, size_t values, struct bead_message *msg);
/* Numbers against time, which is along x. Chooses the times, and reserves room for this many numbers and a zero at each time, and
 * for twice as many series, with two more values each. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error plot_times_create(struct bead_plot_data *data, size_t numbers, const char *what,
                                             struct bead_message *msg);
/* The panel that needs this sample; NULL: none. Samples may come more often than asked for, for other panels of a figure. */
struct plot_panel *plot_times_take(struct bead_plot_data *data, const struct bead_sample *sample);
/* Adds the numbers of that sample. */
void plot_times_add(const struct bead_plot_data *data, struct plot_panel *part, const double *numbers);
/* The number of measured curves beside a panel's: with an overlay, beside the first chain's. */
size_t plot_measured_count(const struct bead_plot_data *data, const struct plot_panel *part);
/* Adds them to panel `p`, and their differences from the computed ones to the panel below. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_measured_add(struct bead_plot_data *data, size_t p, struct bead_message *msg);
/* Adds the points of a curve, times a factor. */
void plot_add_curve(struct plot_panel *part, struct bead_series series, const struct bead_curves *curves, size_t k, double factor);
/* Does a plot, or a panel of one chain, show this chain, and does the chain have one of the places shown, if any? */
bool plot_shows(const struct bead_plot_data *data, size_t chain);
/* Name and magnetism of chain `number`, in the markup of graphs. */
void plot_heading(const struct bead_plot_data *data, size_t number, char *text, size_t size);
/* Adds the bands of a cell, against wave number in units of pi by cell, as a series that is broken between them, with
 * PLOT_BAND_VALUES numbers for each bead of the cell. */
enum { PLOT_BAND_POINTS = 202, PLOT_BAND_VALUES = 2 * PLOT_BAND_POINTS };
struct bead_series *plot_add_bands(struct plot_panel *part, const struct bead_medium *medium);
/* Sets colour, dashes and marks that distinguish curve `index` from the others, also in greyscale. */
void plot_tell_apart(struct bead_series *series, size_t index);
/* Line `index`, distinguishable from the others. */
struct bead_series plot_line(const double *x, const double *y, size_t count, const char *label, size_t index);
/* The bar of a value with this uncertainty; NaN: marks would hide it, or it is unknown. */
double plot_bar(double value, double uncertainty);
/* The bar of a mean: its standard error, and the uncertainty of the values if visible; 0: none. Errors of chains may be alike, so
 * the mean's uncertainty is no smaller than theirs. */
double plot_bar_of_mean(const struct bead_summary *mean, double uncertainty);

/* ---- spectra: spectral_axes.c ---- */

/* What is shown of a chain, or as a curve. */
struct plot_spectrum {
    const struct bead_spectral *found;
    const struct bead_medium *medium; /* NULL: there is none */
};

extern const struct bead_graph_axis plot_wave_numbers;
/* The largest value of all, and the range of frequencies, Hz: as asked, else from 0 on. Errors: SCENE (the range is empty). */
BEAD_CHECK enum bead_error plot_spectral_ranges(const struct bead_output *output, const struct plot_spectrum *all, size_t count,
                                                double *largest, double range[2], struct bead_message *msg);
/* The axis of amplitudes, ratios or (`show: sensors`) values, of which the largest is known, or 0; its title is data->axis_title.
 */
struct bead_graph_axis plot_spectral_axis(struct bead_plot_data *data, const struct bead_field_info *field, double largest);
/* Amplitudes, which become decibels of the largest, as the colours of panel `p`, with the title of that axis; */
void plot_spectral_colours(struct bead_plot_data *data, size_t p, const struct bead_spectral *spectral, double largest);
/* with the exact bands over them. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_spectral_image(struct bead_plot_data *data, size_t p, const struct plot_spectrum *spectrum,
                                               double largest, struct bead_message *msg);
