/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equation `fput`, a row of systems.c with the string of fput_string.h: modes, and the return of the first one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/base/wide.h"
#include "sim/equation/equation.h"
#include "sim/equation/fput_string.h"

/* Follows the energy of a mode: its smallest value, and its largest after it was below half of that at the start. */
struct returns {
    double before, rate_before;  /* energy and its rate at the last step's start */
    double start, low, low_time; /* energies and times */
    double high, high_time;      /* 0: it has not returned yet */
    bool away;                   /* it was below half */
};

struct bead_motion {
    struct bead_motion_settings settings;
    struct bead_string_stepper stepper;
    double h;
    uint64_t steps; /* of h, without those to kinks */
    double *u, *v;  /* [points] between steps */
    double *shape;  /* [points] of the mode at the start, normalised; NULL: another start */
    double omega2;  /* of this mode */
    struct returns returns;
    double energy_start, momentum_start, energy_error;
};

/* ---- meaning ---- */

static const enum bead_field fields[] = {BEAD_FIELD_DISPLACEMENT, BEAD_FIELD_VELOCITY, BEAD_FIELD_STRAIN, BEAD_FIELD_ENERGY,
                                         BEAD_FIELD_COUNT};

static const struct bead_field_info *field(enum bead_field field)
{
    static const struct bead_field_info infos[] = {
        [BEAD_FIELD_DISPLACEMENT] = {"displacement", "", "displacement", 0},
        [BEAD_FIELD_VELOCITY] = {"velocity", "", "velocity", 0},
        [BEAD_FIELD_STRAIN] = {"strain", "", "strain", 0}, /* of a mass: the mean of its two springs */
        [BEAD_FIELD_ENERGY] = {"energy", "", "energy", 0},
    };
    return &infos[field];
}

static bool fixed(const struct bead_equation_spec *spec)
{
    return spec->ends == BEAD_ENDS_FIXED;
}

static size_t highest_mode(const struct bead_equation_spec *spec)
{
    return fixed(spec) ? spec->points : spec->points / 2;
}

static const char *fput_check(const struct bead_equation_spec *spec, const char **key)
{
    *key = "points";
    if (spec->ends == BEAD_ENDS_PERIODIC && spec->points < 3)
        return "must be 3 or more for a ring";
    *key = "start";
    if (spec->start == BEAD_START_MODE && spec->mode > highest_mode(spec))
        return "asks for a mode that the string does not have: N moving masses have N modes, a ring N / 2";
    /* The force has its maximum where dT/dr = 0; beyond it a spring tears or folds. */
    double r = spec->amplitude;
    if (spec->start == BEAD_START_PULSE && !(bead_string_slope(spec, bead_string_branch(spec, r), r) > 0))
        return "asks for strains at which a spring with this force has no positive stiffness";
    return NULL;
}

static void describe(const struct bead_chain_spec *chain, char *text, size_t size)
{
    const struct bead_equation_spec *spec = &chain->equation;
    char alpha[48] = "", beta[48] = "", beyond[80] = "";
    if (spec->alpha != 0)
        snprintf(alpha, sizeof alpha, " %s %.4g r\u00b2", spec->alpha < 0 ? "\u2212" : "+", fabs(spec->alpha));
    if (spec->beta != 0)
        snprintf(beta, sizeof beta, " %s %.4g r\u00b3", spec->beta < 0 ? "\u2212" : "+", fabs(spec->beta));
    if (spec->piecewise.beyond > 0)
        snprintf(beyond, sizeof beyond, ", stiffness %.4g beyond |r| = %.4g", spec->piecewise.stiffness, spec->piecewise.beyond);
    snprintf(text, size, "%zu masses, T = r%s%s%s", spec->points, alpha, beta, beyond);
}

static size_t count_masses(const struct bead_chain_spec *chain, double)
{
    return chain->equation.points;
}

static void places(const struct bead_chain_spec *chain, size_t, double *first, double *spacing)
{
    *first = bead_string_first(&chain->equation);
    *spacing = 1;
}

/* ---- modes ---- */

/* Phase difference of mode k between neighbours: k pi / (N + 1) between walls, 2 k pi / N on a ring. */
static bead_wide phase(const struct bead_equation_spec *spec, size_t k)
{
    size_t n = spec->points;
    return fixed(spec) ? bead_wide_pi * k / (n + 1) : 2 * bead_wide_pi * k / n;
}

static double omega_squared(const struct bead_equation_spec *spec, size_t k)
{
    double s = 2 * (double)bead_wide_sin(phase(spec, k) / 2);
    return s * s;
}

/* Factor of the square of a mode's coordinate, which makes the basis orthonormal. */
static double norm(const struct bead_equation_spec *spec, size_t k)
{
    size_t n = spec->points;
    return fixed(spec) ? 2 / (double)(n + 1) : (2 * k == n ? 1 : 2) / (double)n;
}

/* Energy of mode k: between walls that of a standing wave, on a ring that of the sine and cosine waves together. */
static double mode_energy(const struct bead_equation_spec *spec, size_t k, const double *u, const double *v)
{
    const struct bead_pair turn = bead_wide_pair(phase(spec, k));
    double us = 0, uc = 0, vs = 0, vc = 0;
    for (size_t j = 0; j < spec->points; j++) {
        double c, s;
        bead_turn_to(bead_pair_times(turn, (double)(fixed(spec) ? j + 1 : j)), &c, &s);
        us += u[j] * s;
        vs += v[j] * s;
        uc += u[j] * c;
        vc += v[j] * c;
    }
    double w2 = omega_squared(spec, k), energy = vs * vs + w2 * us * us;
    if (!fixed(spec))
        energy += vc * vc + w2 * uc * uc;
    return 0.5 * norm(spec, k) * energy;
}

static void modes(const struct bead_chain_spec *chain, size_t, const double *const value[BEAD_FIELD_COUNT], size_t count,
                  double *energy)
{
    const struct bead_equation_spec *spec = &chain->equation;
    for (size_t k = 1; k <= count; k++)
        energy[k - 1] =
            k <= highest_mode(spec) ? mode_energy(spec, k, value[BEAD_FIELD_DISPLACEMENT], value[BEAD_FIELD_VELOCITY]) : 0;
}

/* The largest strain at the start. Springs that soften when pressed (alpha alone) make solitons of stretched ones, and what is
 * pressed spreads. Otherwise pressed ones, too, may become a soliton: in the limit of long waves as high as 2 max - min of the
 * start, thrice its strain (P. D. Lax and C. D. Levermore, Communications on Pure and Applied Mathematics 36, 253 (1983)). */
static double approach(const struct bead_chain_spec *chain)
{
    const struct bead_equation_spec *spec = &chain->equation;
    const bool spreads = spec->alpha >= 0 && spec->beta == 0 && spec->piecewise.beyond == 0;
    const double start = spec->start == BEAD_START_MODE ? sqrt(omega_squared(spec, spec->mode)) : 1;
    return (spreads ? 1 : 3) * start * fabs(spec->amplitude);
}

/* ---- the return of the first mode ---- */

/* Energy of the mode at the start, and its rate. */
static double watched(const struct bead_motion *m, const struct bead_string_state *at, double *rate)
{
    double q = 0, p = 0, a = 0;
    for (size_t j = 0; j < m->settings.points; j++) {
        q += m->shape[j] * at->u[j];
        p += m->shape[j] * at->v[j];
        a += m->shape[j] * at->a[j];
    }
    *rate = p * (a + m->omega2 * q);
    return 0.5 * (p * p + m->omega2 * q * q);
}

static void watch(struct bead_motion *m)
{
    struct returns *r = &m->returns;
    const struct bead_string_state *from = &m->stepper.start, *to = &m->stepper.end;
    double rate, x, energy = watched(m, to, &rate), h = to->t - from->t, before = r->before, rate_before = r->rate_before;
    r->before = energy;
    r->rate_before = rate;
    r->away = r->away || energy < 0.5 * r->start;
    if ((rate_before > 0) == (rate > 0))
        return;
    double peak = bead_step_extremum(h, before, rate_before, energy, rate, &x), time = from->t + x * h;
    if (rate_before > 0 && r->away && peak > r->high) {
        r->high = peak;
        r->high_time = time;
    } else if (rate_before <= 0 && peak < r->low) {
        r->low = peak;
        r->low_time = time;
    }
}

static enum bead_error begin_watch(struct bead_motion *m, struct bead_message *msg)
{
    const struct bead_equation_spec *spec = m->settings.spec;
    if (spec->start != BEAD_START_MODE)
        return BEAD_OK;
    m->shape = calloc(m->settings.points, sizeof(double));
    if (!m->shape)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a string of %zu masses", m->settings.points);
    double root = sqrt(norm(spec, spec->mode));
    for (size_t j = 0; j < m->settings.points; j++)
        m->shape[j] = root * (double)bead_wide_sin(phase(spec, spec->mode) * (j + fixed(spec)));
    m->omega2 = omega_squared(spec, spec->mode);
    m->returns.start = m->returns.low = m->returns.before = watched(m, &m->stepper.end, &m->returns.rate_before);
    return BEAD_OK;
}

/* ---- motion ---- */

/* Steps for an accuracy: after the time t the phases of the fastest waves (omega = 2) are wrong by C (omega h)^order omega t. The
 * constants were measured on linear strings. Steps are never longer than `longest` / omega. */
static const struct step_law {
    const char *method;
    double error, longest;
} step_laws[] = {
    {"rkn12", 2e-14, 1.5}, {"rkn8-plain", 2.5e-8, 1.2}, {"rkn8", 2.5e-8, 1.2},  {"rkn6", 2e-6, 1},
    {"pefrl", 6e-5, 1},    {"vefrl", 1e-3, 1},          {"verlet", 1. / 24, 1}, {"rk4", 1. / 120, 1},
};
static const char *const methods[] = {"rkn12", "rkn8-plain", "rkn8", "rkn6", "pefrl", "vefrl", "verlet", "rk4", NULL};

/* The largest frequency of small vibrations about the start, with any spring beyond its kink. */
static double fastest(const struct bead_string *s, const double *u)
{
    const double stiffer = s->spec->piecewise.beyond > 0 ? fmax(s->spec->piecewise.stiffness - 1, 0) : 0;
    double most = 1;
    for (size_t j = 0; j < s->springs; j++) {
        double r = bead_string_strain(s, u, j);
        most = fmax(most, 1 + 2 * fabs(s->spec->alpha * r) + 3 * fabs(s->spec->beta) * r * r);
    }
    return 2 * sqrt(most + stiffer);
}

static enum bead_error choose_step(struct bead_motion *m, struct bead_message *msg)
{
    const struct bead_motion_settings *s = &m->settings;
    const struct bead_method_info *info = &m->stepper.method->info;
    double omega = fastest(&m->stepper.string, m->stepper.end.u);
    const struct step_law *law = step_laws;
    while (strcmp(law->method, info->name) != 0)
        law++;
    /* Polynomials of degree 7 interpolate between steps. */
    double longest = (s->part > 0 ? s->part : 1) * fmin(law->longest, bead_pow(s->accuracy * 40320 * 256, 1. / 8)),
           turns = omega * (isfinite(s->end) ? s->end : 1e4);
    m->h = s->step > 0 ? s->step : fmin(bead_pow(s->accuracy / (law->error * turns), 1.0 / info->order), longest) / omega;
    if (m->h * 2 > info->theta_max)
        return bead_fail(msg, BEAD_ERROR_SCENE, "simulate.step: %.3g is too long for `%s` to be stable: at most %.3g", m->h,
                         info->name, info->theta_max / 2);
    return BEAD_OK;
}

static void fput_destroy(struct bead_motion *m)
{
    if (!m)
        return;
    bead_string_destroy(&m->stepper);
    free(m->u);
    free(m->shape);
    free(m);
}

static double momentum(const struct bead_motion *m)
{
    double sum = 0;
    for (size_t j = 0; j < m->settings.points; j++)
        sum += m->stepper.end.v[j];
    return sum;
}

static double energy(const struct bead_motion *m)
{
    return bead_string_energy(&m->stepper.string, m->stepper.end.u, m->stepper.end.v);
}

static enum bead_error fput_create(const struct bead_motion_settings *settings, struct bead_motion **motion,
                                   struct bead_message *msg)
{
    const char *name = strcmp(settings->method, "auto") == 0 ? "rkn12" : settings->method;
    const struct bead_method *method = bead_method_row(name);
    size_t n = settings->points;
    *motion = NULL;
    if (!method)
        return bead_fail(msg, BEAD_ERROR_SCENE, "simulate.method: there is no method `%s`", name);
    BEAD_TRY(bead_new(motion, 1, msg, "an equation"));
    struct bead_motion *m = *motion;
    BEAD_TRY(bead_new(&m->u, 2 * n, msg, "a string of %zu masses", n));
    m->settings = *settings;
    m->v = m->u + n;
    BEAD_TRY(bead_string_create(settings->spec, method, &m->stepper, msg));
    bead_string_start(&m->stepper.string, m->stepper.end.u, m->stepper.end.v);
    bead_string_begin(&m->stepper);
    m->energy_start = energy(m);
    m->momentum_start = momentum(m);
    BEAD_TRY(choose_step(m, msg));
    return begin_watch(m, msg);
}

static void pace(const struct bead_motion *m, struct bead_pace *pace)
{
    /* About six samples in a period of the fastest wave. */
    *pace =
        (struct bead_pace){m->stepper.method->info.name, m->h, 1 / fastest(&m->stepper.string, m->stepper.start.u), false, NULL};
}

static double time_of(const struct bead_motion *m)
{
    return m->stepper.end.t;
}

/* Steps between checks of the energy, and the relative error beyond which the results mean nothing. */
enum { CHECK_EVERY = 16 };
static const double energy_limit = 0.1, last_sliver = 1e-9;

static enum bead_error check_energy(struct bead_motion *m, struct bead_message *msg)
{
    double error = fabs(energy(m) - m->energy_start) / (m->energy_start > 0 ? m->energy_start : 1);
    m->energy_error = fmax(m->energy_error, error);
    if (error <= energy_limit)
        return BEAD_OK;
    return bead_fail(
        msg, BEAD_ERROR_NUMBERS,
        "at %.6g the energy of the string has a relative error of %.3g: a spring has torn (alpha, beta or the amplitude is too "
        "large), or steps of %.3g are too long for `%s`",
        m->stepper.end.t, bead_told_error(error), m->h, m->stepper.method->info.name);
}

static enum bead_error fput_step(struct bead_motion *m, struct bead_message *msg)
{
    struct bead_string_stepper *s = &m->stepper;
    double t = (double)(m->steps + 1) * m->h, h = m->h, end = m->settings.end;
    if (t > end - last_sliver * m->h) { /* the last step, or one that misses the end only by rounding */
        t = end;
        h = end - s->end.t;
    } else if (s->end.t != (double)m->steps * m->h) { /* the last one ended at a kink */
        h = t - s->end.t;
    }
    m->steps += bead_string_step(s, h, t);
    if (m->shape)
        watch(m);
    return s->steps % CHECK_EVERY == 0 || s->end.t >= end ? check_energy(m, msg) : BEAD_OK;
}

static enum bead_error fput_sample(struct bead_motion *m, double t, unsigned wanted, double *const value[BEAD_FIELD_COUNT],
                                   struct bead_message *)
{
    const struct bead_string *s = &m->stepper.string;
    size_t n = s->masses;
    bead_string_between(&m->stepper, t, m->u, m->v);
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT))
        memcpy(value[BEAD_FIELD_DISPLACEMENT], m->u, n * sizeof(double));
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY))
        memcpy(value[BEAD_FIELD_VELOCITY], m->v, n * sizeof(double));
    if (!(wanted & (BEAD_FIELD_BIT(BEAD_FIELD_STRAIN) | BEAD_FIELD_BIT(BEAD_FIELD_ENERGY))))
        return BEAD_OK;
    double left = bead_string_strain(s, m->u, 0);
    for (size_t j = 0; j < n; j++) {
        double right = bead_string_strain(s, m->u, j + 1 < s->springs ? j + 1 : 0);
        if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_STRAIN))
            value[BEAD_FIELD_STRAIN][j] = 0.5 * (left + right);
        if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_ENERGY))
            value[BEAD_FIELD_ENERGY][j] =
                0.5 * m->v[j] * m->v[j] + 0.5 * (bead_string_spring_energy(s, left) + bead_string_spring_energy(s, right));
        left = right;
    }
    return BEAD_OK;
}

static uint64_t evaluations(const struct bead_motion *m)
{
    return m->stepper.evaluations;
}

/* u and v are adjacent in memory. */
static const double *state(const struct bead_motion *m, size_t *count)
{
    memcpy(m->u, m->stepper.end.u, m->settings.points * sizeof(double));
    memcpy(m->v, m->stepper.end.v, m->settings.points * sizeof(double));
    *count = 2 * m->settings.points;
    return m->u;
}

static size_t measures(const struct bead_motion *m, struct bead_measure *to, size_t room)
{
    const struct bead_equation_spec *spec = m->settings.spec;
    const struct returns *r = &m->returns;
    size_t n = 0;
    n = bead_measure_add(to, n, room, "energy", m->energy_start);
    n = bead_measure_add(to, n, room, "largest error of the energy, relative", m->energy_error);
    if (spec->ends == BEAD_ENDS_PERIODIC)
        n = bead_measure_add(to, n, room, "momentum", m->momentum_start);
    if (spec->ends == BEAD_ENDS_PERIODIC)
        n = bead_measure_add(to, n, room, "change of the momentum", momentum(m) - m->momentum_start);
    if (!m->shape)
        return n;
    double period = (double)(2 * bead_wide_pi) / sqrt(m->omega2);
    char name[48];
    snprintf(name, sizeof name, "period of linear mode %zu", spec->mode);
    n = bead_measure_add(to, n, room, name, period);
    if (!(r->start > 0))
        return n; /* at rest */
    n = bead_measure_add(to, n, room, "smallest energy of the mode, relative", r->low / r->start);
    n = bead_measure_add(to, n, room, "time of the smallest energy", r->low_time);
    if (r->high > 0) {
        n = bead_measure_add(to, n, room, "recurrence time", r->high_time);
        n = bead_measure_add(to, n, room, "recurrence time in periods", r->high_time / period);
        n = bead_measure_add(to, n, room, "energy of the mode at recurrence, relative", r->high / r->start);
    }
    return n;
}

static const struct bead_equation equation = {
    .methods = methods,
    .check = fput_check,
    .create = fput_create,
    .destroy = fput_destroy,
    .pace = pace,
    .time = time_of,
    .step = fput_step,
    .sample = fput_sample,
    .evaluations = evaluations,
    .state = state,
    .energy = energy,
    .measures = measures,
};

const struct bead_system bead_system_fput = {
    .name = "fput",
    .help = "springs of Fermi, Pasta, Ulam and Tsingou between unit masses (the thesis's Eq. 5)",
    .label = "fput",
    BEAD_EQUATION_WORDS,
    .has_masses = true,
    .equation = &equation,
    .fields = fields,
    .field = field,
    .describe = describe,
    .count = count_masses,
    .places = places,
    .approach = approach,
    .mode_fields = BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY),
    .mode_title = "energy of the mode",
    .modes = modes,
};
