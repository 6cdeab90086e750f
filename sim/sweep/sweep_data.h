/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private parts of a sweep, shared by the files of this room. */
#pragma once

#include <pthread.h>

#include "beadreel/sweep.h"
#include "sim/run/play.h"

/* Profiles along the chain, kept if decay is measured, in the order of struct bead_sweep_configuration; then those of a finer run,
 * 0 if there was none. */
enum sweep_profile {
    PROFILE_FORCE,
    PROFILE_ENERGY,
    PROFILE_LAST_FORCE,
    PROFILE_LAST_ENERGY,
    PROFILES_OF_RUN,
    PROFILES = 2 * PROFILES_OF_RUN
};
/* 64-bit words of a peak in a journal. */
enum { PEAK_WORDS = sizeof(struct bead_sweep_peak) / sizeof(uint64_t) };

/* Jobs are numbered across panels; the first of each panel is its clean chain. */
struct sweep_panel {
    struct bead_sweep_panel shown;
    size_t first_job;
    char *spins;                   /* [jobs][cells] */
    struct bead_sweep_peak *peaks; /* [jobs][places] */
    double *profiles;              /* [jobs][PROFILES][beads]; NULL: not measured */
    size_t first_try;              /* of bead_play_cut */
    double accuracy;               /* needed for the means; 0: as asked */
};

struct bead_sweep {
    const struct bead_scene *scene;
    struct bead_scene *own_scene; /* read from a file; NULL: the caller's */
    struct bead_scene *plain;     /* over keys: the scene without the sweep, from which each chain's is made; NULL: over spins */
    pthread_mutex_t making;       /* while a chain's scene is made: the library that reads units is not thread-safe */
    struct sweep_panel *panels;
    size_t panel_count;
    size_t jobs;
    unsigned char *known;    /* [jobs] */
    size_t lost, first_lost; /* chains without results (the front did not pass, or the run diverged); the job of the first */
    struct bead_message why; /* the message about it */
    size_t part, parts;      /* 1, 1: the whole sweep */
    char *version;
};

/* The panel of a job; sets *row to its number within the panel (0: the clean chain). */
struct sweep_panel *bead_sweep_panel_of(const struct bead_sweep *sweep, size_t job, size_t *row);
/* Is the panel's sweep over keys? */
static inline bool bead_sweep_is_over(const struct sweep_panel *panel)
{
    return panel->shown.spec->over.key_count > 0;
}
/* True if the job is in the sweep's part. */
bool bead_sweep_mine(const struct bead_sweep *sweep, size_t job);
/* The beads of a place in a chain of the panel. */
struct bead_span bead_sweep_place_span(const struct sweep_panel *panel, const struct bead_chain *chain, size_t place);
/* Fails if the chain is too short for them. */
BEAD_CHECK enum bead_error bead_sweep_check_places(const struct sweep_panel *panel, const struct bead_chain *chain, size_t index,
                                                   struct bead_message *msg);
/* Over keys: calls `visit` with the outlines of chains that have each value of each key, only the ends of long lists, to find what
 * is wrong before the first chain runs. Errors: MEMORY, SCENE, those of `visit`. */
typedef enum bead_error bead_sweep_visit(void *context, const struct bead_chain *chain, size_t index, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_sweep_try(const struct bead_sweep *sweep, bead_sweep_visit *visit, void *context,
                                          struct bead_message *msg);
/* Why all beads of a panel's chain are kept until its run ends; NULL: those far behind the front are dropped, see behind.h. */
const char *bead_sweep_refusal(const struct sweep_panel *panel, const struct bead_chain *chain);
/* Creates a sweep without spins and results, to read them from a file. */
BEAD_CHECK enum bead_error bead_sweep_allocate(const struct bead_scene *scene, struct bead_sweep **sweep, struct bead_message *msg);
/* Replaces the scene to show other outputs; takes it even after an error. Errors: USAGE (it would change the results). */
BEAD_CHECK enum bead_error bead_sweep_show(struct bead_sweep *sweep, struct bead_scene *scene, struct bead_message *msg);
/* Size of a job's results in words of 8 bytes. */
size_t bead_sweep_words(const struct sweep_panel *panel);

/* ---- playing: a generator of chains, each played by itself, on all threads ---- */
struct sweep_generator {
    const struct bead_sweep *sweep;
    const struct bead_sweep_settings *settings; /* after bead_sweep_settings_take */
    const char *what;                           /* for progress */
    size_t count, done_before;                  /* chains to play, and chains already known */
    /* Finds the panel of chain `index` and its number there; NULL: those of `panel`, from `first` on. */
    size_t panel, first;
    void (*find)(void *context, size_t index, size_t *panel, size_t *configuration);
    /* Plays it; `play` lacks only consumers and their needs. */
    enum bead_error (*play)(void *context, size_t index, const struct bead_play *play, struct bead_message *msg);
    void *context;
    uint64_t played; /* out: chains played */
};
/* Results do not depend on the threads. Errors: MEMORY, SCENE, those of `play`. */
BEAD_CHECK enum bead_error bead_sweep_play(struct sweep_generator *generator, struct bead_message *msg);
/* Checks and copies a caller's settings; in *own, threads 0 becomes the number of cores. Errors: USAGE. */
BEAD_CHECK enum bead_error bead_sweep_settings_take(struct bead_sweep_settings *own, const struct bead_sweep_settings *given,
                                                    struct bead_message *msg);

/* The datasets of peaks, whose numbers are finite and at least 0. */
struct sweep_peak_column {
    const char *name, *unit; /* NULL: a whole number, a uint32_t, else a double */
    size_t offset;           /* in a bead_sweep_peak */
    const char *wrong;       /* about a number that is not */
    bool unknown;            /* NaN is allowed */
    bool optional;           /* older files have none */
};
enum { PEAK_COLUMNS = 6, PEAK_BEAD = 4, PEAK_OPEN = 5 };
extern const struct sweep_peak_column bead_sweep_peak_columns[PEAK_COLUMNS];

/* Names and units of the datasets of profiles. */
struct sweep_profile_name {
    const char *name, *unit;
};
extern const struct sweep_profile_name bead_sweep_profiles[PROFILES];

/* A known configuration. */
struct sweep_entry {
    double magnetism;
    size_t index;
};
/* All of a panel, *count, in order of magnetism; to be freed with free(). Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_entries(const struct bead_sweep *sweep, size_t panel, struct sweep_entry **entries,
                                              size_t *count, struct bead_message *msg);
/* Number of entries from `first` on with equal magnetism. */
size_t bead_sweep_alike(const struct sweep_entry *entries, size_t count, size_t first);

/* ---- journal: a sequence of records with checksums ---- */
struct bead_sweep_journal;
/* Begins a journal, or continues one and loads its results. Errors: IO, USAGE (of another scene, or in use), MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_journal_open(struct bead_sweep *sweep, const char *path, struct bead_sweep_journal **journal,
                                                   struct bead_message *msg);
/* Adds a job's results. Errors: IO. */
BEAD_CHECK enum bead_error bead_sweep_journal_add(struct bead_sweep_journal *journal, const struct bead_sweep *sweep, size_t job,
                                                  struct bead_message *msg);
void bead_sweep_journal_close(struct bead_sweep_journal *journal); /* keeps the file unless it has no results */
