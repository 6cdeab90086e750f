/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of a sweep over keys: results against one key, averaged over seeds, one curve for each combination of the other keys. */
#pragma once

#include "beadreel/sweep.h"
#include "sim/base/internal.h"

/* The results of a curve's configurations with one value of the key along the axis. */
struct bead_sweep_point {
    size_t value;                    /* number of that value of the key */
    double x;                        /* the value, in the key's unit; `value` if it is not a number */
    struct bead_summary summary;     /* N, or in the measure's unit */
    struct bead_summary uncertainty; /* of the mean, ends and quantiles: errors of values may be alike; NaN: unknown */
};
struct bead_sweep_curve {
    char name[200];                  /* "count 20": the values of the other keys; "" if there are none */
    struct bead_sweep_point *points; /* by rising x */
    size_t count;
    double slope, slope_error; /* of ln y against ln x, by least squares; NaN with fewer than three points, or points not above 0 */
    double slope_uncertainty;  /* from those of the points, all off in the worst directions */
    double offset;             /* ln y at ln x = 0 */
};
struct bead_sweep_curves {
    size_t key; /* along the axis */
    struct bead_sweep_curve *curves;
    size_t count;
};
/* A key in words: the last part of its path, with `whose` also its owner, "striker velocity", and as many more parts as distinguish
 * it from the other keys. */
BEAD_INTERNAL void bead_over_key_name(const struct bead_over *over, size_t key, bool whose, char *text, size_t size);
/* The number of the curve of configuration `index`, which has the same values of all keys except seeds and `key`, the one along the
 * axis (SIZE_MAX: none); and these values in words. */
BEAD_INTERNAL size_t bead_sweep_curve_of(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key);
BEAD_INTERNAL void bead_sweep_curve_name(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key, char name[200]);
/* A measure of each configuration, NaN if there is none, and its uncertainty: from its own check run, or, if it has none, the worst
 * relative one of all. */
struct bead_sweep_values {
    double *value, *uncertainty; /* [configurations] */
};
/* `values`: NULL: the peak forces at a place. `against`: a key's path; "": the first that is not a seed. To be freed even after an
 * error. Errors: USAGE (no such key), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_curves_find(const struct bead_sweep *sweep, size_t panel, size_t place,
                                                                const struct bead_sweep_values *values, const char *against,
                                                                struct bead_sweep_curves *curves, struct bead_message *msg);
/* Is there what the outputs show of the sweep: keys, measures, places, for means in space equal lengths? So that a lack is told
 * before chains run, which may take hours. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_asked_check(const struct bead_sweep *sweep, const struct bead_output *const *outputs,
                                                  size_t count, struct bead_message *msg);
/* The unit of a measure of chains. Errors: USAGE (there is none with this name). */
BEAD_CHECK enum bead_error bead_sweep_measure_unit(const char *name, const char **unit, struct bead_message *msg);
/* Runs all chains of the first panel for that measure. The values are to be freed even after an error. Errors: USAGE, MEMORY, those
 * of runs. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_measured(const struct bead_sweep *sweep, const char *name,
                                                             const struct bead_sweep_settings *settings,
                                                             struct bead_sweep_values *values, const char **unit,
                                                             struct bead_message *msg);
BEAD_INTERNAL void bead_sweep_values_free(struct bead_sweep_values *values);
BEAD_INTERNAL void bead_sweep_curves_free(struct bead_sweep_curves *curves);
