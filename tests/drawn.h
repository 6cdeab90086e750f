/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random chains, each with its own references: are peaks as accurate as requested, or as their uncertainties say? For tests and
 * stress.
 *
 * Materials from .5 to 600 GPa, radii from 1 to 20 mm, 10 to 150 beads, strikers from .01 to 10 m/s; ordered or not, some with a
 * wall, precompression, a slope or damping. The difference of two references with different steps is the uncertainty of the peaks.
 * How strongly a peak responds is measured as in tests/asked.h. */
#ifndef BEADREEL_TESTS_DRAWN_H
#define BEADREEL_TESTS_DRAWN_H

#include "beadreel/play.h"
#include "sim/base/random.h"
#include "sim/chain/chain_internal.h"
#include "tests/asked.h"

enum { DRAWN_TEXT = 6000 };

struct drawing {
    uint64_t seed, index;
};

static inline double draw_part(struct drawing *d)
{
    return (double)(bead_draw(d->seed, 0, d->index++) >> 11) * 0x1p-53;
}

/* Evenly in the logarithm. */
static inline double draw_between(struct drawing *d, double low, double high)
{
    return low * pow(high / low, draw_part(d));
}

static inline size_t draw_below(struct drawing *d, size_t count)
{
    return (size_t)(draw_part(d) * (double)count);
}

/* Returns whether it has damping. `most`: beads. */
static inline bool draw_chain(uint64_t seed, double most, char text[DRAWN_TEXT])
{
    struct drawing d = {seed, 0};
    const size_t materials = 1 + draw_below(&d, 3);
    size_t used = (size_t)snprintf(text, DRAWN_TEXT, "materials: {");
    for (size_t m = 0; m < materials; m++) {
        const double density = draw_between(&d, 1000, 12000), modulus = draw_between(&d, 0.5, 600),
                     poisson = 0.05 + 0.4 * draw_part(&d);
        used += (size_t)snprintf(text + used, DRAWN_TEXT - used,
                                 "%sm%zu: {density: %.5g, modulus: %.5g GPa, poisson: %.3f, radius: %.5g mm}", m > 0 ? ",\n  " : "",
                                 m, density, modulus, poisson, draw_between(&d, 1, 20));
    }
    const size_t beads = (size_t)draw_between(&d, 10, most), striker = draw_below(&d, materials);
    const bool ordered = draw_below(&d, 3) == 0, pressed = draw_below(&d, 5) == 0, sloping = !pressed && draw_below(&d, 6) == 0;
    const bool damped = draw_below(&d, 8) == 0;
    static const char *const walls[] = {"none", "rigid", "m0", "brass"};
    const char *wall = walls[draw_below(&d, 4)];
    used += (size_t)snprintf(text + used, DRAWN_TEXT - used, "}\nchain: {striker: {bead: m%zu, velocity: %.5g m/s}, wall: %s",
                             striker, draw_between(&d, 0.01, 10), (pressed || sloping) && *wall == 'n' ? "rigid" : wall);
    if (pressed)
        used += (size_t)snprintf(text + used, DRAWN_TEXT - used, ", precompression: %.4g N", draw_between(&d, 1e-3, 30));
    if (sloping)
        used += (size_t)snprintf(text + used, DRAWN_TEXT - used, ", tilt: %.3g deg", 1 + 29 * draw_part(&d));
    if (damped)
        used += (size_t)snprintf(text + used, DRAWN_TEXT - used, ", damping: {coefficient: %.3g, exponent: %.3g}",
                                 draw_between(&d, 0.01, 10), 1 + draw_part(&d));
    used += (size_t)snprintf(text + used, DRAWN_TEXT - used, ",\n  beads: [");
    for (size_t j = 0; j < beads; j++)
        used += (size_t)snprintf(text + used, DRAWN_TEXT - used, "%s{bead: m%zu}", j > 0 ? ", " : "",
                                 ordered ? j % materials : draw_below(&d, materials));
    snprintf(text + used, DRAWN_TEXT - used, "]}\n");
    return damped;
}

/* A chain, its peaks as exact as possible, and how strongly each responds. */
struct drawn {
    char text[DRAWN_TEXT];
    bool damped;
    struct peaks fine, other; /* the references */
    double omega;             /* rad/s */
};

/* Fixed steps of the corrected method; with damping, which it cannot have, a lower tolerance, as steps end where contacts close. */
static inline struct peaks drawn_reference(const struct drawn *d, double length)
{
    char simulate[64];
    if (d->damped)
        snprintf(simulate, sizeof simulate, "accuracy: %.9g", 3e-9 * pow(length, 3));
    else
        snprintf(simulate, sizeof simulate, "method: rkn8, step: %.9g", length * 0.06 / d->omega);
    return find_peaks(d->text, simulate, 0, 0, 0);
}

static inline struct drawn drawn_make(uint64_t seed, double most)
{
    struct drawn d;
    d.damped = draw_chain(seed, most, d.text);
    struct built built = build(d.text, "accuracy: 1e-6");
    d.omega = bead_chain_omega(built.chain, bead_chain_energy(built.chain));
    release(&built);
    d.fine = drawn_reference(&d, 1);
    d.other = drawn_reference(&d, 1.4);
    return d;
}

static inline void drawn_end(struct drawn *d)
{
    free(d->fine.peak);
    free(d->other.peak);
}

/* What came of asking. */
struct kept {
    double error, of_uncertainty; /* largest error in units of the accuracy requested; of the larger of that and the uncertainty,
                                   * for peaks called predictable */
    double hidden;                /* largest uncertainty of a peak that is not ill-conditioned, of the larger of error and asked */
    double ill;                   /* largest response of a peak to a change of the stiffnesses by the accuracy requested */
    size_t index;                 /* of the worst peak */
};

static inline struct peaks find_coarse(const char *text, double accuracy, double factor)
{
    char simulate[64];
    snprintf(simulate, sizeof simulate, "accuracy: %g", accuracy);
    return find_peaks_at(text, simulate, factor);
}

/* How strongly the peaks respond to changes of the stiffnesses of the size of `accuracy`, in units of that. With damping, responses
 * hardly depend on the size, and larger ones cost less. */
static inline void drawn_answers(const struct drawn *d, double accuracy, double *answer)
{
    const double size = d->damped ? 1e-4 : accuracy;
    char simulate[64];
    if (d->damped)
        snprintf(simulate, sizeof simulate, "accuracy: 1e-5");
    else
        snprintf(simulate, sizeof simulate, "method: rkn8, step: %.9g", 0.1 / d->omega);
    struct peaks still = find_peaks(d->text, simulate, 0, 0, 0);
    for (int i = 0; i < SHAKES; i++) {
        struct peaks shaken = find_peaks(d->text, simulate, 0, size, i);
        for (size_t k = 0; k < still.count; k++)
            answer[k] = fmax(answer[k], difference(&shaken.peak[k], &still.peak[k]) / size);
        free(shaken.peak);
    }
    free(still.peak);
}

/* The uncertainties u that a run with this accuracy says, and which peaks it says are not predictable. */
static inline void drawn_compare(const struct drawn *d, double accuracy, double *u, bool *lost)
{
    struct bead_message msg = {""};
    struct built built = build(d->text, "accuracy: 1e-6");
    struct bead_player_settings settings;
    struct bead_player *player = NULL;
    const struct bead_outcome *outcome = NULL;
    BEAD_DEFAULT(&settings);
    settings.chain = built.chain;
    settings.accuracy = accuracy;
    settings.contact_peaks = settings.bead_peaks = settings.uncertainty = true;
    if (bead_player_create(&settings, &player, &msg) || bead_player_until(player, INFINITY, &msg) ||
        bead_player_finish(player, &outcome, &msg))
        GIVE_UP("%s", msg.text);
    const size_t contacts = d->fine.contacts;
    for (size_t k = 0; k < d->fine.count; k++) {
        u[k] = k < contacts ? outcome->contact_uncertainty[k] : outcome->bead_uncertainty[k - contacts];
        lost[k] = (k < contacts ? &outcome->contact_peaks[k] : &outcome->bead_peaks[k - contacts])->unpredictable;
    }
    bead_player_destroy(player);
    release(&built);
}

static inline struct kept drawn_ask(const struct drawn *d, double accuracy)
{
    struct kept kept = {0};
    struct peaks got = find_coarse(d->text, accuracy, 0);
    double *u = calloc(got.count, sizeof *u), *answer = calloc(got.count, sizeof *answer);
    bool *lost = calloc(got.count, sizeof *lost);
    if (!u || !answer || !lost)
        GIVE_UP("out of memory");
    drawn_compare(d, accuracy, u, lost);
    drawn_answers(d, accuracy, answer);
    for (size_t k = 0; k < got.count; k++) {
        const struct bead_peak *exact = &d->fine.peak[k];
        const double error = difference(&got.peak[k], exact) / accuracy, known = difference(&d->other.peak[k], exact) / accuracy;
        const double said = exact->value > 0 ? u[k] / (accuracy * exact->value) : 0;
        if (error > kept.error) {
            kept.error = error;
            kept.index = k;
        }
        kept.of_uncertainty = lost[k] ? kept.of_uncertainty : fmax(kept.of_uncertainty, (error - known) / fmax(1, said));
        kept.ill = fmax(kept.ill, answer[k]);
        if (answer[k] < chaotic)
            kept.hidden = fmax(kept.hidden, said / fmax(error, 1));
    }
    free(u);
    free(lost);
    free(answer);
    free(got.peak);
    return kept;
}

#endif
