/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The insides of a sweep, shared by the files of this room. */
#ifndef BEADREEL_SIM_SWEEP_SWEEP_DATA_H
#define BEADREEL_SIM_SWEEP_SWEEP_DATA_H

#include "beadreel/sweep.h"
#include "sim/base/settings.h"

/* What is kept of every bead where decay is measured, in the order of struct bead_sweep_configuration. */
enum sweep_profile { PROFILE_FORCE, PROFILE_ENERGY, PROFILE_LAST_FORCE, PROFILE_LAST_ENERGY, PROFILES };

/* Jobs are numbered through all panels; the first of each panel is its clean chain. */
struct sweep_panel {
    struct bead_sweep_panel shown;
    size_t first_job;
    char *spins;                   /* [jobs][cells] */
    struct bead_sweep_peak *peaks; /* [jobs][places] */
    double *profiles;              /* [jobs][PROFILES][beads]; NULL: not measured */
};

struct bead_sweep {
    const struct bead_scene *scene;
    struct bead_scene *own_scene; /* of a file; NULL: the caller's */
    struct sweep_panel *panels;
    size_t panel_count;
    size_t jobs;
    unsigned char *known; /* [jobs] */
    size_t part, parts;   /* 1, 1: all */
    char *version;
};

BEAD_CHECK static inline enum bead_error bead_sweep_settings_take(struct bead_sweep_settings *own,
                                                                  const struct bead_sweep_settings *given, struct bead_message *msg)
{
    return bead_settings_take(own, sizeof *own, BEAD_SETTINGS_UP_TO(struct bead_sweep_settings, threads), given,
                              "bead_sweep_settings", msg);
}

/* The panel that a job belongs to; *row gets its number in there (0: the clean chain). */
struct sweep_panel *bead_sweep_panel_of(const struct bead_sweep *sweep, size_t job, size_t *row);
/* Is the job in the sweep's part? */
bool bead_sweep_mine(const struct bead_sweep *sweep, size_t job);
/* The beads that a place is made of, in a chain of the panel. */
struct bead_span bead_sweep_place_span(const struct sweep_panel *panel, const struct bead_chain *chain, size_t place);
/* Everything but spins and results: for a file that has them. */
BEAD_CHECK enum bead_error bead_sweep_allocate(const struct bead_scene *scene, struct bead_sweep **sweep, struct bead_message *msg);
/* Numbers of 8 bytes that a job's results are. */
size_t bead_sweep_words(const struct sweep_panel *panel);

/* When to give up waiting for the front of a chain whose run ends at time `end`, s: never where that is finite. */
double bead_sweep_give_up(const struct bead_chain *chain, double end);
/* Step number `step` of a configuration's run. Errors: NUMBERS (also past `give_up`), STOPPED. */
struct bead_run;
BEAD_CHECK enum bead_error bead_sweep_step(const struct bead_sweep *sweep, struct bead_run *run, uint64_t step, double give_up,
                                           const volatile sig_atomic_t *stop, struct bead_message *msg);

/* Names and units of the datasets of profiles. */
struct sweep_profile_name {
    const char *name, *unit;
};
extern const struct sweep_profile_name bead_sweep_profiles[PROFILES];

/* Configurations known, by magnetism. */
struct sweep_entry {
    double magnetism;
    size_t index;
};
/* *count of them, to be freed with free(). NULL: out of memory. */
struct sweep_entry *bead_sweep_entries(const struct bead_sweep *sweep, size_t panel, size_t *count);
/* Number of entries from `first` on that are of one magnetism. */
size_t bead_sweep_alike(const struct sweep_entry *entries, size_t count, size_t first);

/* ---- journal: records with checksums, written one after the other ---- */
struct bead_sweep_journal;
/* Open a journal, or continue one, whose results are loaded. Errors: IO, USAGE (of another scene, or in use), MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_journal_open(struct bead_sweep *sweep, const char *path, struct bead_sweep_journal **journal,
                                                   struct bead_message *msg);
/* Add a job's results. Errors: IO. */
BEAD_CHECK enum bead_error bead_sweep_journal_add(struct bead_sweep_journal *journal, const struct bead_sweep *sweep, size_t job,
                                                  struct bead_message *msg);
void bead_sweep_journal_close(struct bead_sweep_journal *journal); /* the file stays */

#endif
