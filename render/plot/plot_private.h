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

/* A panel's data. */
struct plot_panel {
    size_t chain;
    struct bead_curves curves, differences; /* of sensors; differences from the comparison run if requested */
    struct bead_recorded recorded;          /* of sensors with measured data */
    struct bead_series *series;
    double *values;
    char (*labels)[256];
    size_t taken;                     /* samples, for numbers against time */
    struct bead_ruler ruler, *rulers; /* one, or all of them */
    struct bead_spectral spectral;    /* of spectra */
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
    char (*overlaid_labels)[300];
    size_t count;
    bool residuals; /* there are twice as many panels and parts: the second half has differences from measured values */
    char why[96], axis_title[384];
};

struct plot_kind {
    enum bead_show show;
    bool share_x; /* one range along x for all panels */
    enum bead_error (*create)(struct bead_plot_data *data, struct bead_message *msg);
    void (*needs)(const struct bead_plot_data *data, struct bead_needs *needs); /* other than the times; NULL: no samples */
    enum bead_error (*feed)(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg); /* or NULL */
    enum bead_error (*finish)(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg);
};

/* Allocates panels, with their titles. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_reserve(struct bead_plot_data *data, size_t panels, struct bead_message *msg);
/* Allocates series, their labels and values in panel `p`. Errors: MEMORY. */
BEAD_CHECK enum bead_error plot_reserve_series(struct bead_plot_data *data, size_t p, size_t series, size_t values,
                                               struct bead_message *msg);
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
/* Fills the last series of panel `p` with them, and those of the panel below with their differences from the computed ones. Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error plot_measured_fill(struct bead_plot_data *data, size_t p, double *values, struct bead_message *msg);
/* Adds the points of a curve, and gives the series the memory that they need. Returns the rest. */
double *plot_curve_points(const struct bead_curves *curves, size_t k, double factor, double *at, struct bead_series *series);
/* Does a plot, or a panel of one chain, show this chain, and does the chain have one of the places shown, if any? */
bool plot_shows(const struct bead_plot_data *data, size_t chain);
/* Name and magnetism of chain `number`, in the markup of graphs. */
void plot_heading(const struct bead_plot_data *data, size_t number, char *text, size_t size);
/* The bands of a cell, against wave number in units of pi by cell, as a series that is broken between them. `at`: room for
 * PLOT_BAND_VALUES numbers for each bead of the cell. */
enum { PLOT_BAND_POINTS = 202, PLOT_BAND_VALUES = 2 * PLOT_BAND_POINTS };
struct bead_series plot_bands_of(const struct bead_medium *medium, double *at);
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

/* The largest value of a spectrum. */
double plot_spectral_largest(const struct bead_spectral *spectral);
/* The top of the highest band, Hz; 0: nothing presses the contacts, so at rest they are not stiff; or NULL: there is no medium. */
double plot_spectral_top(const struct bead_medium *medium);
/* The end of its automatic axis of frequencies, Hz: beyond the highest band of its medium if it has any, else at the last amplitude
 * that is not small compared with the largest; a transfer shows all. */
double plot_spectral_reach(const struct bead_output *output, const struct bead_spectral *spectral, const struct bead_medium *medium,
                           double largest);
/* The range of frequencies, Hz: as asked, else from 0 to `reach`. Errors: SCENE (it is empty). */
BEAD_CHECK enum bead_error plot_spectral_frequencies(const struct bead_output *output, double reach, double range[2],
                                                     struct bead_message *msg);
/* The lower end of the axis of amplitudes; NaN: it follows from the data. */
double plot_spectral_low(const struct bead_output *output, double largest);
/* Amplitudes, converted to decibels of the largest, as colours; the exact bands over them, as in plot_bands_of. */
struct bead_graph_image plot_spectral_image(struct bead_spectral *spectral, double largest, const char *title);
struct bead_series plot_exact_bands(const struct bead_medium *medium, double *at);
