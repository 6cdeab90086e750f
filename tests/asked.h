/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requested accuracy against the errors found: peaks of a chain's contacts and beads are compared with the chain's own references,
 * for tests and stress.
 *
 * The references are two runs of the corrected method with short steps, of different lengths; the finer one counts, and their
 * difference is its uncertainty. A disordered chain is chaotic behind the front: no method in double precision can reach the
 * requested accuracy for some maxima. They are found by measurement: all stiffnesses are changed by random parts of the size of the
 * requested accuracy; a peak that this changes by more than `chaotic` times as much is not predictable to that accuracy. */
#ifndef BEADREEL_TESTS_ASKED_H
#define BEADREEL_TESTS_ASKED_H

#include "sim/run/run.h"
#include "tests/problems.h"

/* Changes of a peak in units of the change of the stiffnesses: most contacts have 0.3 to 2. */
static const double chaotic = 10;
enum { SHAKES = 4 };

/* Contacts first, then beads. */
struct peaks {
    size_t contacts, count;
    struct bead_peak *peak; /* [count], the owner's to free */
    double end;             /* s */
};

/* Parts from -1 to 1, the same ones always. */
static inline double random_part(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

/* Peaks up to time `end` (s; 0: until the front has passed), of stiffnesses changed by random parts of `shake` (shake number
 * `draw`), with a tolerance `factor` times as large as asked (0: 1).
 */
static inline struct peaks find_peaks_of(const char *text, const char *simulate, double end, double shake, int draw, double factor)
{
    struct bead_message msg = {""};
    struct bead_run *run = NULL;
    struct bead_outcome outcome;
    struct built built = build(text, simulate);
    uint64_t state = 12345u + (uint64_t)draw;
    for (size_t k = 0; shake > 0 && k < built.chain->contacts; k++)
        built.chain->stiffness[k] *= 1 + shake * random_part(&state);
    struct bead_run_settings settings = {.chain = built.chain,
                                         .simulate = &built.scene->simulate,
                                         .kernels = bead_kernels_find(NULL),
                                         .end = end > 0 ? end : INFINITY,
                                         .passage = end > 0 ? BEAD_PASSAGE_NONE : BEAD_PASSAGE_OF_PULSE,
                                         .contact_peaks = true,
                                         .bead_peaks = true,
                                         .tolerance_factor = factor};
    enum bead_error err = bead_run_create(&settings, &run, &msg);
    while (!err && (end > 0 ? bead_run_time(run) < end : isnan(bead_run_over(run))))
        err = bead_run_step(run, &msg);
    struct peaks p = {built.chain->contacts, built.chain->contacts + built.chain->beads, NULL, end};
    p.peak = calloc(p.count, sizeof *p.peak);
    if (err || !p.peak)
        GIVE_UP("%s", err ? msg.text : "out of memory");
    p.end = end > 0 ? end : bead_run_over(run);
    bead_run_finish(run, p.end, &outcome);
    memcpy(p.peak, outcome.contact_peaks, p.contacts * sizeof *p.peak);
    memcpy(p.peak + p.contacts, outcome.bead_peaks, (p.count - p.contacts) * sizeof *p.peak);
    bead_run_destroy(run);
    release(&built);
    return p;
}

static inline struct peaks find_peaks(const char *text, const char *simulate, double end, double shake, int draw)
{
    return find_peaks_of(text, simulate, end, shake, draw, 0);
}

static inline struct peaks find_peaks_at(const char *text, const char *simulate, double factor)
{
    return find_peaks_of(text, simulate, 0, 0, 0, factor);
}

static inline bool is_peak(const struct bead_peak *peak)
{
    return !peak->open && !isnan(peak->time) && peak->value > 0;
}

/* Relative difference; 0 where one of them had not ended. */
static inline double difference(const struct bead_peak *a, const struct bead_peak *b)
{
    return is_peak(a) && is_peak(b) ? fabs(a->value / b->value - 1) : 0;
}

/* What came of asking. */
struct answer {
    double worst, worst_all; /* error, in units of the accuracy requested, of the predictable peaks, and of all */
    size_t index;            /* of that peak: contacts, then beads */
    size_t peaks, chaotic;   /* how many there are, and how many are not predictable */
    double known;            /* uncertainty of the predictable ones, in the same units */
};

struct asking {
    const char *text;
    double end;           /* s; 0: until the front has passed */
    double step;          /* s, of the references */
    struct peaks fine[2]; /* the references */
    double *change;       /* [peaks] work */
    bool shaken;          /* look for peaks that are not predictable; else all count */
};

static inline struct peaks fixed_peaks(const struct asking *a, double step, double shake, int draw)
{
    char simulate[64];
    snprintf(simulate, sizeof simulate, "method: rkn8, step: %.9g", step);
    return find_peaks(a->text, simulate, a->end, shake, draw);
}

static inline struct asking asking_start(const char *text, double end, double step, bool shaken)
{
    struct asking a = {.text = text, .end = end, .step = step, .shaken = shaken};
    a.fine[0] = fixed_peaks(&a, 0.7 * step, 0, 0);
    a.fine[1] = fixed_peaks(&a, step, 0, 0);
    a.change = calloc(a.fine[0].count, sizeof *a.change);
    if (!a.change)
        GIVE_UP("out of memory");
    return a;
}

static inline void asking_end(struct asking *a)
{
    free(a->fine[0].peak);
    free(a->fine[1].peak);
    free(a->change);
}

/* Largest change of each peak in units of that of the stiffnesses. */
static inline void shake(struct asking *a, double size)
{
    memset(a->change, 0, a->fine[0].count * sizeof *a->change);
    for (int i = 0; a->shaken && i < SHAKES; i++) {
        struct peaks shaken = fixed_peaks(a, 2 * a->step, size, i);
        for (size_t k = 0; k < shaken.count; k++)
            a->change[k] = fmax(a->change[k], difference(&shaken.peak[k], &a->fine[0].peak[k]) / size);
        free(shaken.peak);
    }
}

static inline struct answer ask(struct asking *a, double accuracy)
{
    char simulate[64];
    snprintf(simulate, sizeof simulate, "accuracy: %g", accuracy);
    struct peaks got = find_peaks(a->text, simulate, a->end, 0, 0);
    struct answer answer = {0};
    shake(a, accuracy);
    for (size_t k = 0; k < got.count; k++) {
        const struct bead_peak *exact = &a->fine[0].peak[k];
        double error = difference(&got.peak[k], exact) / accuracy;
        answer.peaks += is_peak(exact);
        answer.worst_all = fmax(answer.worst_all, error);
        if (a->change[k] > chaotic) {
            answer.chaotic++;
            continue;
        }
        answer.known = fmax(answer.known, difference(&a->fine[1].peak[k], exact) / accuracy);
        answer.index = error > answer.worst ? k : answer.index;
        answer.worst = fmax(answer.worst, error);
    }
    free(got.peak);
    return answer;
}

/* The chain of a row of tests/reference/fig7_cases.csv; false after the last and if it has more than `most` dimers. */
static inline bool read_disordered(FILE *file, size_t most, char *text, size_t size, size_t *dimers)
{
    char line[2048], bits[512];
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%zu,%*f,%511[01],", dimers, bits) != 2)
            continue;
        if (*dimers > most)
            return false;
        snprintf(text, size,
                 "chain: {beads: [{cell: [large-steel, aluminium], spins: \"%s\"}, {cell: [large-steel, aluminium], count: 15}]}\n",
                 bits);
        return true;
    }
    return false;
}

#endif
