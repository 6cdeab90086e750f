/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the derivatives of peak forces: see sensitivity.h. */
#include "sim/run/sensitivity.h"

#include <stdlib.h>

#include "sim/adjoint/adjoint.h"
#include "sim/base/memory.h"
#include "sim/base/stop.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_data.h"
#include "sim/run/play.h"

/* Accuracy of the recorded run, which must be higher for derivatives than for peaks, and of the sweep backwards. Deviations need
 * two or three digits. */
struct care {
    double accuracy;
    struct bead_adjoint_care back;
};
static const struct care for_sensitivities = {2e-9, {1e-15, 1.6e-2}}, for_deviations = {1e-5, {1e-12, INFINITY}};
/* Peaks that share a sweep. */
enum { TOGETHER = 64 };

/* Records the chain's steps, up to the first one that ends after `until` and one more. */
static enum bead_error record_run(const struct bead_sensitivity_run *with, double accuracy, double until,
                                  struct bead_record *record, struct bead_message *msg)
{
    char method[] = "auto";
    struct bead_simulate simulate = with->chain->scene->simulate;
    simulate.method = method;
    simulate.step = 0;
    simulate.accuracy = accuracy;
    const struct bead_run_settings settings = {.chain = with->chain,
                                               .simulate = &simulate,
                                               .kernels = with->kernels,
                                               .end = INFINITY,
                                               .passage = BEAD_PASSAGE_OF_FRONT,
                                               .record = record};
    struct bead_runner runner;
    enum bead_error err = bead_runner_create(&settings, &runner, msg);
    for (int behind = 0; !err && behind < 2; behind++) {
        const struct bead_way way = {.until = nextafter(fmax(until, bead_run_time(runner.run)), INFINITY), .stop = with->stop};
        err = bead_play_run(&runner, &way, msg);
    }
    bead_runner_destroy(&runner);
    return err;
}

/* The force of one contact or the mean of two. */
static struct bead_adjoint adjoint_of(const struct bead_chain *chain, const struct bead_sensitive *s)
{
    struct bead_adjoint adjoint = {.weight = s->of_bead ? 0.5 : 1,
                                   .time = s->peak->time > 0 ? s->peak->time : 0,
                                   .at_maximum = s->peak->time > 0 && !s->peak->open};
    if (s->of_bead && s->index > 0)
        adjoint.contact[adjoint.contacts++] = s->index - 1;
    if (s->index < chain->contacts)
        adjoint.contact[adjoint.contacts++] = s->index;
    return adjoint;
}

/* Allocates three arrays of results and three for the sweep. */
static enum bead_error allocate(const struct bead_chain *chain, const struct bead_sensitive *of, struct bead_adjoint *adjoint,
                                struct bead_sensitivity *found, struct bead_message *msg)
{
    found->index = of->index;
    found->mass = calloc(3 * chain->beads, sizeof *found->mass);
    adjoint->stiffness = calloc(3 * chain->beads, sizeof(double));
    if (!found->mass || !adjoint->stiffness)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the sensitivities of %zu beads", chain->beads);
    found->radius = found->mass + chain->beads;
    found->modulus = found->radius + chain->beads;
    adjoint->static_force = adjoint->stiffness + chain->beads;
    adjoint->mass = adjoint->static_force + chain->beads;
    return BEAD_OK;
}

static void convert(const struct bead_chain *chain, const struct bead_adjoint *adjoint, struct bead_sensitivity *found)
{
    const struct bead_chain_raw_rates raw = {adjoint->stiffness, adjoint->static_force, adjoint->mass, adjoint->striker_force};
    struct bead_chain_rates rates = {found->mass, found->radius, found->modulus, 0};
    bead_chain_find_rates(chain, &raw, &rates);
    found->velocity = adjoint->velocity;
    found->wall_modulus = rates.wall_modulus;
}

static void forget(const struct bead_chain *chain, struct bead_sensitivity *found)
{
    for (size_t i = 0; i < 3 * chain->beads; i++)
        found->mass[i] = NAN; /* and the two arrays after it */
    found->velocity = found->wall_modulus = NAN;
}

static enum bead_error find_block(const struct bead_sensitivity_run *with, const struct bead_adjoint_care *care,
                                  const struct bead_record *record, const struct bead_sensitive *peaks, size_t count,
                                  struct bead_sensitivity *found, struct bead_message *msg)
{
    struct bead_adjoint adjoint[TOGETHER];
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < count; i++)
        adjoint[i] = adjoint_of(with->chain, &peaks[i]);
    for (size_t i = 0; !err && i < count; i++)
        err = allocate(with->chain, &peaks[i], &adjoint[i], &found[i], msg);
    if (!err)
        err = bead_adjoint_sweep(with->chain, record, with->kernels, care, adjoint, count, msg);
    for (size_t i = 0; i < count; i++) {
        if (!err)
            convert(with->chain, &adjoint[i], &found[i]);
        if (!err && with->passage && peaks[i].peak->open)
            forget(with->chain, &found[i]);
        free(adjoint[i].stiffness);
    }
    return err;
}

/* Takes the derivatives of a block of peaks, the first of which is number `first`. */
struct receiver {
    void (*take)(const struct receiver *receiver, size_t first, size_t count, struct bead_sensitivity *found);
    const struct care *care;
    const struct bead_chain *chain;
    struct bead_sensitivity *found;
    double *deviation; /* of peaks row[0], row[1], ... of a list that begins with `pairs` peaks and their rivals */
    bool *rivalled;    /* for the same peaks */
    const struct bead_sensitive *peaks;
    const size_t *row;
    size_t pairs;
};

static enum bead_error find_all(const struct bead_sensitivity_run *with, const struct bead_sensitive *peaks, size_t count,
                                const struct receiver *receiver, struct bead_message *msg)
{
    const double refinement = with->refinement > 0 ? with->refinement : 1;
    const double accuracy = fmin(with->accuracy, receiver->care->accuracy) * refinement;
    const struct bead_adjoint_care care = {receiver->care->back.negligible, receiver->care->back.heavy * refinement};
    struct bead_record record = {0};
    double until = 0;
    for (size_t i = 0; i < count; i++)
        until = fmax(until, peaks[i].peak->time); /* fmax ignores NaN */
    enum bead_error err = count > 0 ? record_run(with, accuracy, until, &record, msg) : BEAD_OK;
    for (size_t i = 0; !err && i < count; i += TOGETHER) {
        const size_t block = count - i < TOGETHER ? count - i : TOGETHER;
        struct bead_sensitivity found[TOGETHER] = {{0}};
        if (bead_stop_is_asked(with->stop))
            err = bead_fail(msg, BEAD_ERROR_STOPPED, "stopped before the sensitivities were found");
        else
            err = find_block(with, &care, &record, peaks + i, block, found, msg);
        if (!err)
            receiver->take(receiver, i, block, found);
        for (size_t b = 0; b < block; b++)
            bead_sensitivity_free(&found[b]);
    }
    bead_record_free(&record);
    return err;
}

static void keep(const struct receiver *r, size_t first, size_t count, struct bead_sensitivity *found)
{
    memcpy(r->found + first, found, count * sizeof *found);
    memset(found, 0, count * sizeof *found); /* the receiver owns their arrays now */
}

enum bead_error bead_sensitivities_find(const struct bead_sensitivity_run *with, const struct bead_sensitive *peaks, size_t count,
                                        struct bead_sensitivity *found, struct bead_message *msg)
{
    memset(found, 0, count * sizeof *found);
    return find_all(with, peaks, count,
                    &(struct receiver){.take = keep, .care = &for_sensitivities, .chain = with->chain, .found = found}, msg);
}

/* Covariance of two peaks. At constant density m is proportional to R^3. */
static double covariance(const struct bead_chain *c, const struct bead_sensitivity *a, const struct bead_sensitivity *b)
{
    const struct bead_material *materials = c->scene->materials;
    double sum = 0;
    for (size_t j = 0; j < c->beads; j++) {
        const struct bead_material *m = &materials[c->material[j]];
        const double radius = m->radius_tolerance * m->radius_tolerance, modulus = m->modulus_tolerance * m->modulus;
        sum += radius * (c->radius[j] * a->radius[j] + 3 * c->mass[j] * a->mass[j]) *
               (c->radius[j] * b->radius[j] + 3 * c->mass[j] * b->mass[j]);
        sum += modulus * modulus * a->modulus[j] * b->modulus[j];
    }
    if (c->spec->wall == BEAD_WALL_MATERIAL) {
        const struct bead_material *wall = &materials[c->spec->wall_material];
        const double by_wall = wall->modulus_tolerance * wall->modulus;
        sum += by_wall * by_wall * a->wall_modulus * b->wall_modulus;
    }
    return sum;
}

/* Standard deviation of the larger of two normal deviates of these means, variances and covariance: C. E. Clark, The greatest of a
 * finite set of random variables, Operations Research 9 (1961) 145. *close: either may be the larger. */
static double deviation_of_larger(const double mean[2], const double variance[2], double both, bool *close)
{
    const double apart = sqrt(fmax(variance[0] + variance[1] - 2 * both, 0)), middle = 0.5 * (mean[0] + mean[1]);
    *close = fabs(mean[0] - mean[1]) < 3 * apart;
    if (!*close)
        return sqrt(variance[mean[1] > mean[0]]);
    const double b = (mean[0] - mean[1]) / apart, density = bead_exp(-0.5 * b * b) / sqrt(2 * (double)bead_wide_pi);
    const double first = 0.5 * bead_erfc(-b / sqrt(2)), second = 0.5 * bead_erfc(b / sqrt(2));
    const double x = mean[0] - middle, y = mean[1] - middle, larger = x * first + y * second + apart * density;
    const double square = (x * x + variance[0]) * first + (y * y + variance[1]) * second + (x + y) * apart * density;
    return sqrt(fmax(square - larger * larger, 0));
}

/* Peaks with rivals come first, each followed by its rival, then those without. */
static void sum_up(const struct receiver *r, size_t first, size_t count, struct bead_sensitivity *found)
{
    for (size_t i = 0; i < count; i++) {
        const struct bead_sensitivity *own = &found[i];
        const size_t row = r->row[first + i];
        const bool is_rival = first + i < 2 * r->pairs && i % 2 == 1;
        const double variance = covariance(r->chain, own, own);
        if (!is_rival) {
            r->deviation[row] = sqrt(variance);
            continue;
        }
        const struct bead_sensitive *of = &r->peaks[first + i];
        const double mean[2] = {of[-1].peak->value, of->peak->value},
                     variances[2] = {r->deviation[row] * r->deviation[row], variance};
        r->deviation[row] = deviation_of_larger(mean, variances, covariance(r->chain, own, own - 1), &r->rivalled[row]);
    }
}

static bool has_rival(const struct bead_sensitive *s)
{
    return s->rival && s->rival->time > 0 && s->peak->time > 0 && !s->peak->open;
}

enum bead_error bead_deviations_find(const struct bead_sensitivity_run *with, const struct bead_sensitive *peaks, size_t count,
                                     double *deviation, bool *rivalled, struct bead_message *msg)
{
    BEAD_FREED struct bead_sensitive *list;
    BEAD_FREED size_t *row;
    size_t used = 0;
    BEAD_TRY(bead_new(&list, 2 * count, msg, "the deviations of %zu peaks", count));
    BEAD_TRY(bead_new(&row, 2 * count, msg, "the deviations of %zu peaks", count));
    struct receiver receiver = {
        .take = sum_up, .care = &for_deviations, .chain = with->chain, .deviation = deviation, .rivalled = rivalled};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++) {
            if (has_rival(&peaks[i]) != (pass == 0))
                continue;
            list[used] = peaks[i];
            row[used++] = i;
            if (pass > 0)
                continue;
            list[used] = peaks[i];
            list[used].peak = peaks[i].rival;
            row[used++] = i;
            receiver.pairs++;
        }
    }
    receiver.row = row;
    receiver.peaks = list;
    return find_all(with, list, used, &receiver, msg);
}

size_t bead_sensitive_contacts(const struct bead_chain *chain, const struct bead_peak *peaks, size_t *list)
{
    size_t count = 0, last = chain->contacts - 1;
    for (size_t i = 0; i < chain->sensor_count; i++) { /* from left to right */
        const size_t bead = chain->sensors[i].bead;
        for (size_t k = bead - 1; k <= bead && k < chain->contacts; k++) {
            if (count == 0 || list[count - 1] < k)
                list[count++] = k;
        }
    }
    if (count > 0)
        return count;
    while (last > 0 && (peaks[last].open || !(peaks[last].time > 0)))
        last--;
    list[0] = peaks[last].open || !(peaks[last].time > 0) ? chain->contacts - 1 : last;
    return 1;
}

void bead_sensitivity_free(struct bead_sensitivity *sensitivity)
{
    free(sensitivity->mass);
    *sensitivity = (struct bead_sensitivity){0};
}
