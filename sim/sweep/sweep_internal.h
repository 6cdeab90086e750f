/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps, for the project's own code only: single chains, journals, parts. */
#pragma once

#include "beadreel/sweep.h"
#include "sim/base/internal.h"
#include "sim/statistics/statistics.h"

BEAD_INTERNAL const struct bead_scene *bead_sweep_scene(const struct bead_sweep *sweep);
/* With `accuracy: statistical`, the smallest that a panel needed; 0: as asked. */
double bead_sweep_accuracy(const struct bead_sweep *sweep);
/* The chain of a configuration or of BEAD_SWEEP_CLEAN, of a scene made for it, not of the sweep's. The sweep must outlive it.
 * Errors: MEMORY, SCENE. */
struct bead_sweep_chain;
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_chain_create(const struct bead_sweep *sweep, size_t panel, size_t index,
                                                                 struct bead_sweep_chain **chain, struct bead_message *msg);
BEAD_INTERNAL const struct bead_chain *bead_sweep_chain_of(const struct bead_sweep_chain *chain);
BEAD_INTERNAL void bead_sweep_chain_destroy(struct bead_sweep_chain *chain);
BEAD_LEAVES(bead_sweep_chain_left, struct bead_sweep_chain, bead_sweep_chain_destroy)
BEAD_LEAVES(bead_sweep_left, struct bead_sweep, bead_sweep_close)
/* A scene of this one chain, without outputs, as a tree of the sweep's scene, for an override of the whole. Errors: SCENE, MEMORY.
 */
BEAD_CHECK enum bead_error bead_sweep_single(const struct bead_sweep *sweep, size_t panel, size_t index,
                                             const struct bead_node **scene, struct bead_message *msg);
/* Progress of the unfinished sweep whose journal is `path`. False: it is not a journal. */
struct bead_sweep_progress {
    size_t chains, done; /* of all parts; in this journal */
    size_t part, parts;
};
bool bead_sweep_journal_look(const char *path, struct bead_sweep_progress *progress);
/* One configuration to run and watch. */
struct bead_sweep_watch {
    size_t panel, index; /* a configuration, or BEAD_SWEEP_CLEAN */
    double end;          /* s; 0: when the front arrives */
    unsigned fields;     /* BEAD_FIELD_BITs of the samples at 0, every, ... <= end, of all beads */
    double every;        /* s */
    bool widens;         /* like the times of a bead_grid */
    bool finer;          /* at the tolerance of check runs */
    enum bead_error (*take)(void *context, const struct bead_sample *sample, struct bead_message *msg); /* NULL: no samples */
    void *context; /* one for each configuration: several threads call `take`, but only one for a configuration */
    /* Results: when the front arrived, s (NaN: not before the end); the peak force of the sweep's (first) place, N; participation
     * of energies at the arrival, beads, and the clean index (participation.h) */
    double arrival, force, participation, clean_index;
};
/* Run these; results are the same for any number of threads. Errors: MEMORY, NUMBERS, SCENE, USAGE, STOPPED, those of `take`. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_watch(const struct bead_sweep *sweep, struct bead_sweep_watch *watches,
                                                          size_t count, const struct bead_sweep_settings *settings,
                                                          struct bead_message *msg);
/* The time to which these, of which only panel and index are known, run to be compared: `until`, or the last arrival of a front,
 * which is found by running them. Errors: as above. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_end(const struct bead_sweep *sweep, struct bead_sweep_watch *watches,
                                                        size_t count, const struct bead_sweep_settings *settings, double *end,
                                                        struct bead_message *msg);
/* "sweep.h5" -> "sweep.2of4.h5", to be freed with free(). Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_part_path(const char *path, size_t part, size_t parts, char **name, struct bead_message *msg);
/* Is the file one of a sweep? Errors, of HDF5 files: MEMORY, IO, FORMAT, UNSUPPORTED. */
BEAD_CHECK enum bead_error bead_sweep_is(const char *path, bool *is, struct bead_message *msg);
/* The part that a file holds; 1 of 1 for all. */
void bead_sweep_part(const struct bead_sweep *sweep, size_t *part, size_t *parts);
/* Version of the program that made the results. */
const char *bead_sweep_version(const struct bead_sweep *sweep);
/* Geometric means of `values` [beads] over beads i, i + 1, ... of a random cell, up to the last random bead: fills *count of means
 * [beads]. */
BEAD_INTERNAL void bead_sweep_smooth(const struct bead_sweep *sweep, size_t panel, const double *values, double *means,
                                     size_t *count);
/* The relative uncertainty of the forces of a place, or of their times: the worst measured; NaN: none was. */
BEAD_INTERNAL double bead_sweep_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place);
double bead_sweep_time_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place);
/* That of the clean chain's force, by which forces are normalised. */
double bead_sweep_clean_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place);
/* The uncertainty of the threshold, found in this way, if forces are off by `part` of themselves, and the clean chain's by
 * `common`; NaN: there is none. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_threshold_uncertainty(const struct bead_sweep_statistics *statistics, const char *threshold,
                                                            double part, double common, double *uncertainty,
                                                            struct bead_message *msg);

/* The uncertainty of a mean over `all` chains, of which `known` were also run finer: the mean of their differences, which it sorts,
 * and how much that of all may differ from it. NaN: unknown. */
double bead_sweep_bound(double *differences, size_t known, size_t all);

/* Decay of peaks along the chain: geometric means over the configurations of a magnetism, and fits of these in units of the clean
 * chain's. */
struct bead_sweep_decay {
    double magnetism;
    size_t count;           /* configurations */
    double *force, *energy; /* [beads] N, J: geometric means of the peaks */
    /* From bead 10, where the wave has formed, to the bead where it has fallen to 1/e, or the last random bead. */
    struct bead_decay of_force, of_energy;
    double force_participation, energy_participation; /* of last_force, last_energy: means of the ratios, beads */
    /* Uncertainties of these, of force and of energy; NaN: not measured. */
    struct bead_decay_uncertainty {
        double *peaks; /* [beads] N, J */
        double length, exponent, participation;
    } uncertain[2];
};
/* Errors: MEMORY; NUMBERS if decay was not measured, or the clean chain is unknown. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_decays(const struct bead_sweep *sweep, size_t panel,
                                                           struct bead_sweep_decay **decays, size_t *count,
                                                           struct bead_message *msg);
BEAD_INTERNAL void bead_sweep_decays_free(struct bead_sweep_decay *decays, size_t count);
