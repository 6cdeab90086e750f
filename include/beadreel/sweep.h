/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps: many chains that differ in the spins of their random cells, and their results.
 *
 *   err = bead_sweep_create(scene, &sweep, &msg);                 or    err = bead_sweep_open("sweep.h5", ..., &sweep, &msg);
 *   err = bead_sweep_run(sweep, &settings, &msg);
 *   for (size_t p = 0; p < bead_sweep_panels(sweep); p++)
 *       for (size_t c = 0; c < bead_sweep_panel(sweep, p)->configurations; c++)
 *           if (bead_sweep_configuration(sweep, p, c, &configuration))
 *               ... spins, magnetism, peaks ...
 *   bead_sweep_close(sweep);
 *
 * A panel is one sweep of the scene. Configurations are in the order of rising magnetism. Spins are draws of Philox4x32-10 under
 * the sweep's seed, stream (number up) 2^32 + (number within the magnetism): more configurations or magnetisms leave the earlier
 * ones as they are. Results depend only on the sweep: not on threads, on what else is in the scene, or on where a run was stopped
 * and resumed.
 *
 * In the file (HDF5; SI): /scene, the scene's text; for panel p the group /sweeps/p with the attributes name and seed and
 *   configuration [n]     number within the panel, from 0
 *   spins [n][cells]      1 up, 0 reversed, of the random cells
 *   magnetism [n]         M of the chain; over keys: value [n][key], NaN where it is no number, of the keys `key` [keys]
 *   place [places]        "peak", or the sensors' names
 *   peak_force [n][place] N, peak_time [n][place] s, peak_uncertainty [n][place] N, peak_time_uncertainty [n][place] s (older files
 *                         have none), peak_bead [n][place], peak_open [n][place]
 *   bead [beads], bead_force, last_force [n][bead] N, bead_energy, last_energy [n][bead] J      where decay is measured
 * finer_bead_force ... the same from runs of a sample of them with a hundredth of the tolerance; 0: none
 * reference_... the same for the chain with all random cells up */
#ifndef BEADREEL_SWEEP_H
#define BEADREEL_SWEEP_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/scene.h"
#include "beadreel/session.h"

BEAD_BEGIN

struct bead_summary {
    size_t count;
    double mean, deviation;   /* deviation of the sample, with count - 1; NaN below two values */
    double standard_error;    /* of the mean: deviation / sqrt(count) */
    double low, high, median; /* quantiles by linear interpolation between the sorted values ((count - 1) q) */
    double quartile[2];       /* 1/4, 3/4 */
};

/* The two regimes: F = plateau below the threshold, exp(-rate (1 - M^2)) above it. The number of domains of reversed cells grows as
 * 1 - M^2, and each takes away the same part of the wave. */
struct bead_threshold {
    double plateau, plateau_error; /* mean over all M <= 0.2 of the means */
    double rate, rate_error;
    double critical, critical_error; /* M_c; NaN where there is none */
    double low, high;                /* M that the law was fitted to */
};

struct bead_sweep;

struct bead_sweep_panel {
    const char *name; /* "" for a single unnamed sweep */
    const struct bead_sweep_spec *spec;
    size_t configurations;
    size_t places; /* results of each: 1, or one a sensor; 0 where no peak is measured */
    size_t beads;  /* of its chains, with the striker */
};

struct bead_sweep_peak {
    double force;            /* N: largest bead force of the first passage */
    double time;             /* s; NaN where the wave never arrived */
    double uncertainty;      /* N: measured by a finer run, for one in 64 chains; 0: not measured */
    double time_uncertainty; /* s: measured the same way; NaN: not known */
    uint32_t bead;           /* where */
    uint32_t open;           /* 1: at the end of the run a force there was still rising, and the highest so far */
};

struct bead_sweep_configuration {
    const char *spins;                   /* [cells] '0' and '1', not terminated */
    double magnetism;                    /* NaN: over keys */
    const struct bead_sweep_peak *peaks; /* [places] */
    /* [beads], where decay is measured, else NULL. Peak forces of the first passage, N; the energy of the front, J: that of the
     * bead and the four on either side, at the moment of its peak force. */
    const double *bead_force, *bead_energy;
    const double *last_force, *last_energy; /* [beads] N, J: of each bead when the front has reached the end */
};

/* Instead of a configuration's number: all random cells up; over keys: the scene as it is. */
#define BEAD_SWEEP_CLEAN ((size_t)-1)

/* The scene must outlive the sweep. Errors: MEMORY, USAGE (the scene has no sweep). */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_create(const struct bead_scene *scene, struct bead_sweep **sweep,
                                                      struct bead_message *msg);
BEAD_API void bead_sweep_close(struct bead_sweep *sweep);

BEAD_API size_t bead_sweep_panels(const struct bead_sweep *sweep);
BEAD_API const struct bead_sweep_panel *bead_sweep_panel(const struct bead_sweep *sweep, size_t panel);
/* Name of a place: "peak" or a sensor's. */
BEAD_API const char *bead_sweep_place(const struct bead_sweep *sweep, size_t panel, size_t place);
/* In a sweep over keys: number of the value of key `key` that a configuration has. */
BEAD_API size_t bead_sweep_value(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key);
/* One configuration, or BEAD_SWEEP_CLEAN; false: its results are not known (yet, or not in this part), peaks and profiles are NULL,
 * or there is no such configuration. Borrowed from the sweep. */
BEAD_API bool bead_sweep_configuration(const struct bead_sweep *sweep, size_t panel, size_t index,
                                       struct bead_sweep_configuration *configuration);
/* Number of configurations (and reference chains), and of those that are known. */
BEAD_API size_t bead_sweep_count(const struct bead_sweep *sweep, size_t *known);

struct bead_sweep_settings {
    size_t size;              /* of this structure: BEAD_DEFAULT */
    int threads;              /* 0: all cores */
    const char *instructions; /* as in bead_job */
    const char *journal;      /* file of results so far, to resume from; NULL: none */
    size_t part, parts;       /* only part 1..parts; 0, 0: all */
    const volatile sig_atomic_t *stop;
    void (*progress)(void *context, const struct bead_progress *progress);
    void *progress_context;
};
/* Compute what is not known. Results in the journal are taken from there; an incomplete last record is ignored. A journal of
 * another scene, version or part is refused. *computed gets how many chains were computed now; may be NULL. Errors: MEMORY,
 * NUMBERS, SCENE, USAGE (journal), IO, STOPPED. */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_run(struct bead_sweep *sweep, const struct bead_sweep_settings *settings,
                                                   uint64_t *computed, struct bead_message *msg);

/* Write what is known to `path`, whole or not at all. Errors: IO, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_write(const struct bead_sweep *sweep, const char *path, struct bead_message *msg);
/* Read one; overrides change the outputs of its scene. Everything in the file is checked. The sweep has its own scene. Errors: IO,
 * FORMAT, MEMORY, SCENE, USAGE (an override of what was computed). */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_open(const char *path, const struct bead_overrides *overrides,
                                                    struct bead_sweep **sweep, struct bead_message *msg);
/* Merge parts, in any order; all must be there, once each, from the same scene and version. Errors: those of open; USAGE. */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_merge(const char *const *paths, size_t count, struct bead_sweep **sweep,
                                                     struct bead_message *msg);

/* Statistics of one magnetism at one place, normalised by the clean chain's force. */
struct bead_sweep_row {
    double magnetism;
    size_t first, count; /* values first..first+count-1 are of this magnetism */
    struct bead_summary summary;
};
struct bead_sweep_statistics {
    double clean; /* N: force at this place without disorder */
    struct bead_sweep_row *rows;
    size_t row_count;
    double *values;  /* normalised forces, row by row */
    size_t *indices; /* and their configurations */
    struct bead_threshold threshold;
    bool has_threshold;
};
/* Statistics of the configurations known; fills *statistics, to be freed with bead_sweep_statistics_free. `threshold`: the way to
 * find it, a name of --list thresholds; NULL: the first. Errors: MEMORY; USAGE (no such name); NUMBERS where the clean chain is not
 * known. */
BEAD_API BEAD_CHECK enum bead_error bead_sweep_statistics(const struct bead_sweep *sweep, size_t panel, size_t place,
                                                          const char *threshold, struct bead_sweep_statistics *statistics,
                                                          struct bead_message *msg);
BEAD_API void bead_sweep_statistics_free(struct bead_sweep_statistics *statistics);

BEAD_END

#endif
