/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs one chain: steps under control of energy and accuracy, samples, peaks and front. play.c steps it. */
#include "sim/run/run.h"

#include <stdlib.h>

#include "sim/adjoint/record.h"
#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/drive.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/events.h"
#include "sim/integrate/stepper.h"
#include "sim/run/behind.h"
#include "sim/run/budget.h"
#include "sim/run/front.h"
#include "sim/run/heights.h"
#include "sim/run/peaks.h"
#include "sim/run/step_control.h"

/* Largest error of a velocity from one contact that opens or closes, in units of accuracy times the striker's velocity. */
static const double event_part = 0.25;

/* With damping, steps are as long as the tolerance of each event allows. Each contact closes and opens at least once, and the
 * errors of n events, with either sign, add up to sqrt(n) times one. A chain whose contacts hardly touch amplifies them; comparison
 * runs find that (tests/errors/grazing.yaml). */
static double events_sum(const struct bead_chain *chain)
{
    return sqrt(2 * (double)chain->contacts);
}

/* Steps between updates of the contacts' speeds, which set the tolerance of their events: few enough that no contact turns
 * unnoticed in between. */
enum { WEIGH_EVERY = 2 };
/* Steps between checks of the energy, and steps after which a sample needs another check; its largest error relative to the
 * input. */
enum { CHECK_EVERY = 64, CHECK_SAMPLES = 8 };
static const double energy_limit = 1e-2;
/* Each small step in a stiff spring loses a little energy. Steps become shorter when this multiple of the requested accuracy is
 * lost, and again each time the loss has doubled. */
static const double drift_part = 2;
/* A step that would miss the end of the run by no more than this part of itself ends there. */
static const double last_sliver = 1e-6;
/* If damping requires steps below this part of the usual length, even at the limit of stability, the run would take unreasonably
 * long. */
static const double shortest = 1e-3;

struct bead_run {
    struct bead_run_settings settings;
    struct bead_stepping stepping;
    struct bead_stepper *stepper;
    struct bead_step_control control;
    struct bead_dense dense;
    struct bead_front front;
    struct bead_passing passing;
    struct bead_behind behind;
    double given_up; /* s: the passage ended here, without the front; NaN: it did not */
    bool hopeless;   /* the front will never arrive */
    double energy_start, momentum_start, energy_error, embedded_error, event_error, input; /* input: J, unit of energy errors */
    struct bead_peaks *contact_peaks, *bead_peaks;
    struct bead_heights *heights;
    double *state_memory, *u, *v, *f; /* samples: state between steps */
    double *field[BEAD_FIELD_COUNT];
    double *arrived, *final;   /* [2][beads] u, v when the front arrives and at the end; NULL: not requested */
    double work[2];            /* J, of the drive until the start and the end of the step */
    double lost[2];            /* J, to damping and an absorbing end until the start and the end of the step */
    double absorbed;           /* J, by an absorbing end */
    struct bead_budget budget; /* of the last sample */
    double *budget_beads;      /* the arrays it points to; NULL: not requested */
    double drift_bound;        /* of the energy error, beyond which steps become shorter */
    uint64_t checked;          /* step of the last energy check */
    uint64_t hash;
};

static enum bead_error allocate(struct bead_run *run, struct bead_message *msg)
{
    size_t beads = run->settings.chain->beads, stride = beads + 16;
    run->state_memory = calloc(stride * (3 + BEAD_FIELD_COUNT), sizeof(double));
    if (!run->state_memory)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the samples of %zu beads", beads);
    double *at = run->state_memory + 8;
    double **array[3] = {&run->u, &run->v, &run->f};
    for (size_t i = 0; i < 3; i++, at += stride)
        *array[i] = at;
    for (size_t i = 0; i < BEAD_FIELD_COUNT; i++, at += stride)
        run->field[i] = at;
    if (run->settings.budget)
        BEAD_TRY(bead_new(&run->budget_beads, 3 * (beads + 1), msg, "the energies of %zu beads", beads));
    if (!run->settings.states)
        return BEAD_OK;
    BEAD_TRY(bead_new(&run->arrived, 4 * beads, msg, "two states of %zu beads", beads));
    run->final = run->arrived + 2 * beads;
    return BEAD_OK;
}

static enum bead_error create_peaks(struct bead_run *r, bool of_beads, struct bead_peaks **peaks, struct bead_message *msg)
{
    const struct bead_run_settings *settings = &r->settings;
    const struct bead_span span = settings->peak_span ? *settings->peak_span : (struct bead_span){0, SIZE_MAX};
    BEAD_TRY(bead_peaks_create(r->stepper, of_beads, span, peaks, msg));
    if (settings->rivals)
        BEAD_TRY(bead_peaks_keep_rivals(*peaks, r->stepper, msg));
    return settings->peaks_apart > 0 ? bead_peaks_keep_second(*peaks, r->stepper, settings->peaks_apart, msg) : BEAD_OK;
}

enum bead_error bead_run_create(const struct bead_run_settings *settings, struct bead_run **run, struct bead_message *msg)
{
    *run = NULL;
    struct bead_run *r;
    BEAD_TRY(bead_new(&r, 1, msg, "a run"));
    r->settings = *settings;
    r->front.arrival = r->given_up = NAN;
    r->passing.time = NAN;
    if (settings->passage == BEAD_PASSAGE_OF_PULSE)
        bead_passing_begin(&r->passing, settings->chain);
    const double tolerance_factor = settings->tolerance_factor > 0 ? settings->tolerance_factor : 1;
    enum bead_error err = bead_run_stepping(settings->chain, settings->simulate, tolerance_factor, &r->stepping, msg);
    if (!err)
        err = bead_stepper_create(settings->chain, r->stepping.method, settings->kernels, settings->full_window, &r->stepper, msg);
    if (!err)
        err = bead_dense_create(r->stepper, &r->dense, msg);
    if (!err)
        err = allocate(r, msg);
    if (!err && settings->contact_peaks)
        err = create_peaks(r, false, &r->contact_peaks, msg);
    if (!err && settings->bead_peaks)
        err = create_peaks(r, true, &r->bead_peaks, msg);
    if (!err && settings->heights)
        err = bead_heights_create(r->stepper, settings->bead_peaks, &r->heights, msg);
    if (err) {
        bead_run_destroy(r);
        return err;
    }
    if (!(settings->simulate->step > 0))
        r->stepper->event_tolerance = event_part * r->stepping.accuracy * settings->chain->speed /
                                      (bead_stepper_damped(r->stepper) ? events_sum(settings->chain) : 1);
    if (settings->passage && settings->target > 0 && !bead_behind_refusal(settings->chain) && r->stepping.method->tableau)
        r->behind = (struct bead_behind){.widening = settings->widening, .target = settings->target};
    r->control = bead_step_control_start(r->stepper, r->stepping.theta, r->stepping.omega);
    r->drift_bound = drift_part * tolerance_factor * settings->simulate->accuracy;
    r->energy_start = bead_stepper_energy(r->stepper, &r->stepper->end);
    r->momentum_start = bead_stepper_momentum(r->stepper, &r->stepper->end);
    r->input = bead_chain_energy(settings->chain);
    *run = r;
    return BEAD_OK;
}

void bead_run_destroy(struct bead_run *run)
{
    if (!run)
        return;
    bead_peaks_destroy(run->contact_peaks);
    bead_peaks_destroy(run->bead_peaks);
    bead_heights_destroy(run->heights);
    bead_dense_destroy(&run->dense);
    bead_stepper_destroy(run->stepper);
    free(run->state_memory);
    free(run->budget_beads);
    free(run->arrived); /* and run->final */
    free(run);
}

double bead_run_time(const struct bead_run *run)
{
    return run->stepper->t1;
}

const struct bead_peak *bead_run_bead_peaks(const struct bead_run *run)
{
    return run->bead_peaks ? bead_peaks_found(run->bead_peaks) : NULL;
}

const struct bead_peak *bead_run_rivals(const struct bead_run *run, bool of_beads)
{
    const struct bead_peaks *peaks = of_beads ? run->bead_peaks : run->contact_peaks;
    return peaks ? bead_peaks_rivals(peaks) : NULL;
}

const struct bead_peak *bead_run_second_peaks(const struct bead_run *run, bool of_beads)
{
    const struct bead_peaks *peaks = of_beads ? run->bead_peaks : run->contact_peaks;
    return peaks ? bead_peaks_second(peaks) : NULL;
}

const struct bead_heights *bead_run_heights(const struct bead_run *run)
{
    return run->heights;
}

double bead_run_arrival(const struct bead_run *run)
{
    return run->front.arrival;
}

bool bead_run_cut_short(const struct bead_run *run)
{
    return run->behind.reached;
}

void bead_run_give_up(struct bead_run *run)
{
    run->given_up = run->stepper->t1;
}

bool bead_run_is_lost(const struct bead_run *run)
{
    return run->hopeless || !isnan(run->given_up);
}

double bead_run_over(const struct bead_run *run)
{
    if (!isnan(run->given_up))
        return run->given_up;
    if (run->behind.reached) /* the run must be repeated from here on */
        return run->stepper->t1;
    return run->settings.passage == BEAD_PASSAGE_OF_FRONT ? run->front.arrival : run->passing.time;
}

struct bead_run_work bead_run_work(const struct bead_run *run)
{
    return (struct bead_run_work){run->stepper->steps, run->stepper->evaluations, run->hash};
}

/* Hashes every bit of the state except zeros (beads at rest), to be equal with and without a window. */
static void hash_state(struct bead_run *run)
{
    const struct bead_stepper *s = run->stepper;
    for (size_t j = 0; j < s->active; j++) {
        uint64_t word[2];
        memcpy(&word[0], &s->end.u[j], sizeof word[0]);
        memcpy(&word[1], &s->end.v[j], sizeof word[1]);
        for (int i = 0; i < 2; i++) {
            if (word[i] << 1 == 0) /* zero, with either sign */
                continue;
            uint64_t h = (word[i] ^ (s->steps * 0x9e3779b97f4a7c15u)) + (2 * j + (uint64_t)i) * 0xc2b2ae3d27d4eb4fu;
            h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9u;
            run->hash += (h ^ (h >> 29)) * 0x94d049bb133111ebu;
        }
    }
}

/* Energy error relative to the input; a loss to damping is no error. */
static double energy_off(const struct bead_run *run)
{
    const struct bead_stepper *s = run->stepper;
    double change = bead_stepper_energy(s, &s->end) - run->energy_start - run->work[1];
    if (bead_stepper_damped(s) && change < 0)
        return 0;
    return run->input > 0 ? fabs(change) / run->input : fabs(change);
}

/* A contact whose force no longer opposes its compression or extension, which no step length can help; if there is none, the number
 * of contacts. */
static size_t collapsed(const struct bead_run *run)
{
    const struct bead_stepper *s = run->stepper;
    for (size_t k = 0; k < s->chain->contacts; k++) {
        const double d = bead_stepper_compression(s, &s->end, k);
        if (d * s->chain->law->force(s->chain->stiffness[k], s->table.law, d) < 0)
            return k;
    }
    return s->chain->contacts;
}

/* If the energy diverges, the results are meaningless. */
static enum bead_error check_energy(struct bead_run *run, double error, struct bead_message *msg)
{
    const struct bead_stepper *s = run->stepper;
    run->checked = s->steps;
    if (error <= energy_limit)
        return BEAD_OK;
    const struct bead_chain *c = s->chain;
    const char *name = bead_chain_name(c), *space = *name ? " " : "";
    const size_t gone = collapsed(run);
    char at[128];
    if (gone < c->contacts)
        return bead_fail(
            msg, BEAD_ERROR_NUMBERS,
            "%schain%s%s: by %.6g s the spring of contact %zu has collapsed: beyond a compression of 1 / alpha the force of "
            "`%s` attracts more and more; give a smaller alpha or a slower striker (a smaller accuracy does not help)",
            bead_chain_place(c, "chain", at, sizeof at), space, name, s->t1, gone, c->law->name);
    const char *advice =
        run->stepping.variable ? "give a smaller simulate.accuracy" : "give a shorter simulate.step or leave it out";
    return bead_fail(
        msg, BEAD_ERROR_NUMBERS,
        "%schain%s%s: at %.6g s the energy is off by %.3g of the energy put in: steps of %.3g s are too long for `%s`; %s",
        bead_chain_place(c, "chain", at, sizeof at), space, name, s->t1, bead_told_error(error),
        run->stepping.variable ? s->h : run->stepping.step, s->method->info.name, advice);
}

/* Before a state leaves the run. */
static enum bead_error check_state(struct bead_run *run, struct bead_message *msg)
{
    return run->stepper->steps >= run->checked + CHECK_SAMPLES ? check_energy(run, energy_off(run), msg) : BEAD_OK;
}

/* Errors are recorded at fixed steps, so that the reported ones do not depend on the outputs. */
static bool is_noted(const struct bead_run *run)
{
    return run->stepper->steps % CHECK_EVERY == 0 || run->stepper->t1 >= run->settings.end;
}

static void keep_errors(struct bead_run *run, double energy)
{
    run->energy_error = fmax(run->energy_error, energy);
    run->embedded_error = fmax(run->embedded_error, bead_nystrom_error(run->stepper));
}

static enum bead_error note_errors(struct bead_run *run, struct bead_message *msg)
{
    const double error = energy_off(run);
    keep_errors(run, error);
    if (run->stepping.variable && error > run->drift_bound) {
        bead_step_control_shorten(&run->control);
        run->drift_bound = 2 * error;
    }
    return check_energy(run, error, msg);
}

static double next_step(struct bead_run *run)
{
    struct bead_stepper *s = run->stepper;
    if (!run->stepping.variable)
        return run->stepping.step;
    const double h = bead_step_control_next(&run->control, s);
    if (s->steps % WEIGH_EVERY == 0)
        bead_events_weigh(s->events, s);
    return bead_stepper_damped(s) ? bead_step_control_damped(&run->control, s, h) : h;
}

/* Makes one step of the chosen length, or a shorter one that ends with the run. */
static enum bead_error advance(struct bead_run *run, struct bead_message *msg)
{
    struct bead_stepper *s = run->stepper;
    double h = next_step(run);
    if (bead_stepper_damped(s) && run->stepping.variable) {
        char at[128];
        if (h * s->method->info.theta_max < shortest * run->stepping.step * run->control.theta)
            return bead_fail(msg, BEAD_ERROR_NUMBERS,
                             "%schain%s%s: at %.6g s velocities decay so fast that steps of %.2g s would be needed: the damping is "
                             "too strong for these masses; give a smaller chain.damping.coefficient",
                             bead_chain_place(s->chain, "chain.damping.coefficient", at, sizeof at),
                             *bead_chain_name(s->chain) ? " " : "", bead_chain_name(s->chain), s->t1, h);
        h = bead_step_control_graded(&run->control, s, h);
    }
    if (s->driven != SIZE_MAX) { /* steps end where the drive is not smooth */
        const double stop = fmin(bead_drive_break(s->chain, s->t1), run->settings.end > s->t1 ? run->settings.end : INFINITY);
        bead_stepper_advance(s, s->t1 + h > stop - last_sliver * h ? stop : s->t1 + h);
        return BEAD_OK;
    }
    double t = (double)(s->steps + 1) * h;
    if (run->stepping.variable || bead_stepper_damped(s)) /* with damping, steps end where contacts close */
        t = s->t1 + h;
    /* If the passage ends the run, steps keep their length: they must not depend on whether the end was known in advance. */
    double end = run->settings.passage ? INFINITY : run->settings.end;
    if (t > end + last_sliver * h && s->t1 < end)
        bead_stepper_advance(s, end);
    else if (t > end - last_sliver * h && s->t1 < end)
        bead_stepper_advance_by(s, h, end); /* equal except for rounding */
    else
        bead_stepper_advance_by(s, h, t);
    return BEAD_OK;
}

/* Stores displacements, then velocities, at time t in the last step. */
static void keep_state(struct bead_run *run, double t, double *kept)
{
    const size_t beads = run->stepper->beads;
    bead_dense_state(&run->dense, run->stepper, t, run->u, run->v);
    memcpy(kept, run->u, beads * sizeof *kept);
    memcpy(kept + beads, run->v, beads * sizeof *kept);
}

/* If a passage ends the run, peaks count until the front arrives; forces that are still rising then are followed until it is over.
 */
static void look_for_peaks(struct bead_run *run)
{
    const struct bead_stepper *s = run->stepper;
    double limit = run->settings.end, over = limit;
    if (run->settings.passage == BEAD_PASSAGE_OF_PULSE)
        bead_passing_watch(&run->passing, &run->front, s);
    if (run->settings.passage && !isnan(run->front.arrival)) {
        limit = run->front.arrival;
        over = isnan(bead_run_over(run)) ? INFINITY : bead_run_over(run);
    }
    if (run->contact_peaks)
        bead_peaks_step(run->contact_peaks, s, limit, over);
    if (run->bead_peaks)
        bead_peaks_step(run->bead_peaks, s, limit, over);
    if (run->heights && !(s->t1 > limit))
        bead_heights_step(run->heights, s);
}

/* True if a wanted peak lies in the last step. */
static bool has_peak(const struct bead_run *run)
{
    const struct bead_stepper *s = run->stepper;
    bool any = false;
    for (size_t j = run->settings.target; j < s->active && !any; j++)
        any = (run->bead_peaks && bead_peaks_found(run->bead_peaks)[j].time >= s->t0) ||
              (run->contact_peaks && j < s->chain->contacts && bead_peaks_found(run->contact_peaks)[j].time >= s->t0);
    return any;
}

/* Drops beads that no longer matter, with their energy. */
static void drop_behind(struct bead_run *run)
{
    if (run->behind.widening > 0)
        run->energy_start -= bead_behind_step(&run->behind, run->stepper, run->front.largest_force, has_peak(run));
}

enum bead_error bead_run_step(struct bead_run *run, struct bead_message *msg)
{
    struct bead_stepper *s = run->stepper;
    BEAD_TRY(advance(run, msg));
    run->event_error = fmax(run->event_error, s->event_change);
    if (run->settings.record) {
        enum bead_error kept = bead_record_add(run->settings.record, s, msg);
        if (kept)
            return kept;
    }
    const bool coming = isnan(run->front.arrival);
    BEAD_TRY(bead_front_watch(&run->front, s, msg));
    enum bead_error err = BEAD_OK;
    if (run->arrived && coming && !isnan(run->front.arrival)) {
        keep_state(run, run->front.arrival, run->arrived);
        err = check_state(run, msg);
    }
    if (err)
        return err;
    run->work[0] = run->work[1];
    run->work[1] += bead_drive_work(s, &run->dense, 1);
    run->input = fmax(run->input, fabs(run->work[1]));
    run->lost[0] = run->lost[1];
    const double absorbed = bead_absorption(s);
    run->absorbed += absorbed;
    if (run->settings.budget)
        run->lost[1] += bead_dissipation(s) + absorbed;
    look_for_peaks(run);
    drop_behind(run);
    if (run->settings.hash)
        hash_state(run);
    if (!is_noted(run))
        return BEAD_OK;
    run->hopeless = run->settings.passage && bead_front_is_lost(&run->front, s);
    return note_errors(run, msg);
}

/* Forces of contacts first..last in the interpolated state, including their static part. */
static void sample_forces(struct bead_run *run, size_t first, size_t last)
{
    const struct bead_stepper *s = run->stepper;
    const struct bead_chain *c = s->chain;
    struct bead_contact_table part = s->table;
    part.stiffness += first;
    part.static_compression += first;
    part.static_force += first;
    part.closed = s->was_closed && s->steps > 0 ? s->was_closed + first : part.closed ? part.closed + first : NULL;
    s->force(last - first + 1, &part, run->u + first, run->v + first, run->f + first);
    double *out = run->field[BEAD_FIELD_CONTACT_FORCE];
    for (size_t k = first; k <= last; k++)
        out[k] = run->f[k] + c->static_force[k];
}

static void sample_energy(struct bead_run *run, size_t first, size_t last)
{
    const struct bead_chain *c = run->settings.chain;
    for (size_t j = first; j <= last; j++) {
        double energy = 0.5 * c->mass[j] * (run->v[j] * run->v[j]) + bead_chain_spring_energy(c, j, run->u[j]);
        for (size_t k = j > 0 ? j - 1 : 0; k <= j && k < c->contacts; k++) {
            double d0 = c->static_compression[k], d = d0 + (run->u[k] - run->u[k + 1]), a = c->stiffness[k];
            energy += bead_chain_share(c, k) *
                      (c->law->energy(a, &c->spec->law, d) - c->law->energy(a, &c->spec->law, d0) - c->static_force[k] * (d - d0));
        }
        run->field[BEAD_FIELD_ENERGY][j] = energy;
    }
}

enum bead_error bead_run_sample(struct bead_run *run, double t, unsigned fields, struct bead_span span, struct bead_sample *sample,
                                struct bead_message *msg)
{
    const struct bead_stepper *s = run->stepper;
    const struct bead_chain *c = s->chain;
    if (!(t >= s->t0 && t <= s->t1))
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "a sample at %.9g s lies outside the step from %.9g to %.9g s", t, s->t0, s->t1);
    BEAD_TRY(check_state(run, msg));
    size_t last = span.last < c->beads ? span.last : c->beads - 1, first = span.first < last ? span.first : last;
    sample->time = t;
    if (run->settings.budget) {
        sample->budget = &run->budget;
        const double x = s->h > 0 ? fmin((t - s->t0) / s->h, 1) : 0,
                     part = bead_stepper_damped(s) ? 0 : bead_drive_work(s, &run->dense, x), work = run->work[0] + part;
        BEAD_TRY(bead_budget_find(s, t, run->lost[0], s->steps > 0 ? work : 0, run->budget_beads, &run->budget, msg));
    }
    /* Beads under static compression carry a force even at rest, so all are active. */
    sample->active = c->static_force[0] > 0 || c->static_force[c->contacts - 1] > 0 ? c->beads : s->active;
    if (last >= sample->active)
        last = sample->active - 1; /* the others are at rest: still zero */
    first = first < last ? first : last;
    bead_dense_state(&run->dense, s, t, run->u, run->v);
    if (bead_between_failed(run->dense.between))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contacts that open or close");
    if (fields & (BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE)))
        sample_forces(run, first > 0 ? first - 1 : 0, last);
    const double *f = run->field[BEAD_FIELD_CONTACT_FORCE];
    for (size_t j = first; (fields & BEAD_FIELD_BIT(BEAD_FIELD_FORCE)) && j <= last; j++)
        run->field[BEAD_FIELD_FORCE][j] = 0.5 * ((j > 0 ? f[j - 1] : 0) + f[j]);
    if (fields & BEAD_FIELD_BIT(BEAD_FIELD_COMPRESSION))
        bead_derive_compressions(c, run->u, first, last, run->field[BEAD_FIELD_COMPRESSION]);
    if (fields & BEAD_FIELD_BIT(BEAD_FIELD_ENERGY))
        sample_energy(run, first, last);
    for (size_t i = 0; i < BEAD_FIELD_COUNT; i++)
        sample->field[i] = fields & BEAD_FIELD_BIT(i) ? run->field[i] : NULL;
    if (fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT))
        sample->field[BEAD_FIELD_DISPLACEMENT] = run->u;
    if (fields & BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY))
        sample->field[BEAD_FIELD_VELOCITY] = run->v;
    return BEAD_OK;
}

static struct bead_moment moment(const struct bead_run *run, double time, const double *kept)
{
    return (struct bead_moment){time, kept, kept + run->stepper->beads};
}

void bead_run_finish(struct bead_run *run, double end, struct bead_outcome *outcome)
{
    const struct bead_stepper *s = run->stepper;
    double speed = s->chain->speed;
    if (!is_noted(run))
        keep_errors(run, energy_off(run));
    *outcome = (struct bead_outcome){
        .end = end,
        .front_arrival = run->front.arrival,
        .method = run->stepping.method->info.name,
        .step = run->stepping.step,
        .steps = s->steps,
        .evaluations = s->evaluations,
        .energy_start = run->energy_start,
        .energy_end = bead_stepper_energy(s, &s->end),
        .momentum_start = run->momentum_start,
        .momentum_end = bead_stepper_momentum(s, &s->end),
        .energy_error = run->energy_error,
        .embedded_error = s->method->tableau && s->method->tableau->bpe && speed > 0 ? run->embedded_error / speed : NAN,
        .event_error = s->events && speed > 0 ? run->event_error / speed : NAN,
        .contact_peaks = run->contact_peaks ? bead_peaks_found(run->contact_peaks) : NULL,
        .bead_peaks = run->bead_peaks ? bead_peaks_found(run->bead_peaks) : NULL,
        .absorbed = s->chain->spec->absorbs ? run->absorbed : NAN,
        .worst_contact = NAN,
        .worst_bead = NAN,
        .worst_force = NAN,
        .worst_uncertainty = NAN,
    };
    if (run->arrived && !isnan(run->front.arrival))
        outcome->arrived = moment(run, run->front.arrival, run->arrived);
    if (!run->final || !(end >= s->t0 && end <= s->t1))
        return;
    keep_state(run, end, run->final);
    outcome->final = moment(run, end, run->final);
}
