/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equation `kdv`, a row of systems.c with the solver of kdv_solver.h: settings, integrals, recurrence and measures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/equation/equation.h"
#include "sim/equation/kdv_solitons.h"
#include "sim/equation/kdv_solver.h"

/* Conserved: the integrals of u, u^2 and drift u^2 / 2 + a u^3 / 6 - b u_x^2 / 2. */
struct integrals {
    double mass, momentum, hamiltonian;
};

/* Follows |mode|^2: its largest value after it was below a quarter of that at the start. */
struct watch {
    struct integrals start;
    size_t mode; /* 0: none */
    double first, before, rate_before, high, high_time;
    bool away;
};

struct bead_motion {
    struct bead_kdv kdv;
    struct watch watch;
    struct bead_kdv_solitons solitons;
};

/* ---- meaning ---- */

/* The unknown is shown as the field that the scene names, by default as u. */
static const struct bead_field_info *field(enum bead_field field)
{
    static const struct bead_field_info infos[] = {
#define BEAD_KDV_FIELD(id, name, unit, title, place) {name, "", BEAD_FIELD_##id == BEAD_FIELD_DISPLACEMENT ? "u" : title, 0},
        BEAD_FIELDS(BEAD_KDV_FIELD)
#undef BEAD_KDV_FIELD
    };
    return &infos[field];
}

static const char *kdv_check(const struct bead_equation_spec *spec, const char **key)
{
    *key = "variable";
    if (bead_field_info(spec->variable)->of_contacts)
        return "must be a field of points, not of contacts";
    *key = "points";
    if (spec->start == BEAD_START_COSINE && spec->points && 3 * spec->mode + 1 > spec->points)
        return "must be more than 3 for each wave of the start";
    *key = "dispersion";
    if (spec->dispersion == 0 && spec->nonlinearity != 0)
        return "must not be 0 with a nonlinearity: the wave would break";
    if (spec->start != BEAD_START_SOLITONS)
        return NULL;
    if (!(spec->dispersion > 0))
        return "must be above 0 for solitons of these speeds";
    *key = "nonlinearity";
    if (spec->nonlinearity == 0)
        return "must not be 0 for solitons";
    *key = "start";
    for (size_t i = 0; i < spec->soliton_count; i++) {
        if (!(spec->solitons[i].at >= spec->low && spec->solitons[i].at < spec->low + spec->length))
            return "has a soliton outside the domain: must be low <= at < low + length";
    }
    return NULL;
}

/* " + 6 u" before a derivative; nothing if the coefficient is 0. */
static void add_term(char *text, size_t size, double coefficient, const char *factor)
{
    size_t used = strlen(text);
    const char *sign = coefficient < 0 ? "\u2212" : "+";
    if (coefficient != 0 && fabs(coefficient) == 1)
        snprintf(text + used, size - used, " %s %s", sign, factor);
    else if (coefficient != 0)
        snprintf(text + used, size - used, " %s %.4g %s", sign, fabs(coefficient), factor);
}

static void describe(const struct bead_chain_spec *chain, char *text, size_t size)
{
    const struct bead_equation_spec *spec = &chain->equation;
    snprintf(text, size, "u\u209c");
    add_term(text, size, spec->drift, "u\u2093");
    add_term(text, size, spec->nonlinearity, "u u\u2093");
    add_term(text, size, spec->dispersion, "u\u2093\u2093\u2093");
    snprintf(text + strlen(text), size - strlen(text), " = 0");
}

static size_t count_points(const struct bead_chain_spec *chain, double accuracy)
{
    return bead_kdv_points(&chain->equation, accuracy);
}

static void places(const struct bead_chain_spec *chain, size_t points, double *first, double *spacing)
{
    *first = chain->equation.low;
    *spacing = chain->equation.length / (double)points;
}

/* ---- integrals ---- */

/* The mean of u^2, and of u_x^2 if it is wanted. */
static double mean_square(const struct bead_kdv *kdv, double *slopes)
{
    double squares = 0;
    for (size_t j = 1; j <= kdv->spectral.modes; j++) {
        double k = kdv->wave_number[j], size = kdv->end.u[j].re * kdv->end.u[j].re + kdv->end.u[j].im * kdv->end.u[j].im;
        squares += 2 * size;
        if (slopes)
            *slopes += 2 * k * k * size;
    }
    return squares + kdv->mean * kdv->mean;
}

static void find_integrals(const struct bead_kdv *kdv, struct integrals *to)
{
    const struct bead_equation_spec *spec = kdv->spec;
    const double *u = bead_kdv_grid(kdv, kdv->end.u);
    double cubes = 0, slopes = 0;
    size_t n = kdv->spectral.points;
    for (size_t i = 0; i < n; i++)
        cubes += u[i] * u[i] * u[i];
    const double squares = mean_square(kdv, &slopes);
    to->mass = spec->length * (kdv->mean + kdv->end.u[0].re);
    to->momentum = spec->length * squares;
    to->hamiltonian =
        spec->length * (spec->drift * squares / 2 + spec->nonlinearity * cubes / (6 * (double)n) - spec->dispersion * slopes / 2);
}

/* ---- the return of the first wave ---- */

static double watched(const struct watch *w, const struct bead_kdv_state *s, double *rate)
{
    struct bead_complex u = s->u[w->mode], slope = s->slope[w->mode];
    *rate = 2 * (u.re * slope.re + u.im * slope.im); /* the linear part only turns its phase */
    return u.re * u.re + u.im * u.im;
}

static void watch_begin(struct watch *w, const struct bead_kdv *kdv)
{
    *w = (struct watch){.mode = kdv->spec->start == BEAD_START_COSINE ? kdv->spec->mode : 0};
    find_integrals(kdv, &w->start);
    if (w->mode > kdv->spectral.modes)
        w->mode = 0;
    if (w->mode)
        w->first = w->before = watched(w, &kdv->end, &w->rate_before);
}

static void watch_step(struct watch *w, const struct bead_kdv *kdv)
{
    if (!w->mode)
        return;
    double rate, x, h = kdv->end.t - kdv->start.t, before = w->before, rate_before = w->rate_before;
    double now = watched(w, &kdv->end, &rate);
    w->before = now;
    w->rate_before = rate;
    w->away = w->away || now < 0.25 * w->first;
    if (!(w->away && rate_before > 0 && rate <= 0))
        return;
    double peak = bead_step_extremum(h, before, rate_before, now, rate, &x);
    if (peak > w->high) {
        w->high = peak;
        w->high_time = kdv->start.t + x * h;
    }
}

/* ---- measures ---- */

static double relative(double now, double start)
{
    return start != 0 ? now / start - 1 : now;
}

static size_t measures(const struct bead_motion *m, struct bead_measure *to, size_t room)
{
    const struct watch *w = &m->watch;
    const struct bead_kdv *kdv = &m->kdv;
    struct integrals now;
    size_t n = 0, crests = 0;
    find_integrals(kdv, &now);
    n = bead_measure_add(to, n, room, "mass", now.mass);
    n = bead_measure_add(to, n, room, "change of the mass", now.mass - w->start.mass);
    n = bead_measure_add(to, n, room, "momentum", now.momentum);
    n = bead_measure_add(to, n, room, "change of the momentum, relative", relative(now.momentum, w->start.momentum));
    n = bead_measure_add(to, n, room, "hamiltonian", now.hamiltonian);
    n = bead_measure_add(to, n, room, "change of the hamiltonian, relative", relative(now.hamiltonian, w->start.hamiltonian));
    n = bead_measure_add(to, n, room, "tail of the spectrum, relative", kdv->tail);
    const double *u = bead_kdv_grid(kdv, kdv->end.u);
    for (size_t i = 0; i < kdv->spectral.points; i++)
        crests += bead_kdv_is_crest(u, kdv->spectral.points, i);
    if (kdv->spec->start == BEAD_START_SOLITONS)
        return bead_kdv_soliton_measures(&m->solitons, kdv, to, n, room);
    n = bead_measure_add(to, n, room, "crests at the end", (double)crests);
    if (w->high > 0) {
        n = bead_measure_add(to, n, room, "recurrence time", w->high_time);
        n = bead_measure_add(to, n, room, "amplitude at recurrence, relative", sqrt(w->high / w->first));
    }
    return n;
}

/* ---- a motion ---- */

static void kdv_destroy(struct bead_motion *m)
{
    if (!m)
        return;
    bead_kdv_destroy(&m->kdv);
    free(m);
}

static enum bead_error kdv_create(const struct bead_motion_settings *settings, struct bead_motion **motion,
                                  struct bead_message *msg)
{
    BEAD_TRY(bead_new(motion, 1, msg, "an equation"));
    struct bead_motion *m = *motion;
    BEAD_TRY(bead_kdv_create(settings, &m->kdv, msg));
    watch_begin(&m->watch, &m->kdv);
    bead_kdv_solitons_begin(&m->solitons, settings->spec);
    return BEAD_OK;
}

/* The resolution: a quarter of the time in which the fastest wave passes over the narrowest feature. */
static void pace(const struct bead_motion *m, struct bead_pace *pace)
{
    const struct bead_equation_spec *spec = m->kdv.spec;
    double sharp = fmax(bead_kdv_sharpest(spec), 2 * 3.14 / spec->length),
           speed = fabs(spec->nonlinearity) * bead_kdv_highest(spec);
    speed += fabs(spec->drift) + fabs(spec->dispersion) * sharp * sharp;
    *pace = (struct bead_pace){"etdrk4", m->kdv.h, 0.25 / (sharp * speed), !m->kdv.fixed, NULL};
}

static double time_of(const struct bead_motion *m)
{
    return m->kdv.end.t;
}

static enum bead_error kdv_step(struct bead_motion *m, struct bead_message *msg)
{
    BEAD_TRY(bead_kdv_step(&m->kdv, msg));
    watch_step(&m->watch, &m->kdv);
    if (m->kdv.spec->start == BEAD_START_SOLITONS)
        bead_kdv_solitons_watch(&m->solitons, &m->kdv);
    return BEAD_OK;
}

static enum bead_error kdv_sample(struct bead_motion *m, double t, unsigned wanted, double *const value[BEAD_FIELD_COUNT],
                                  struct bead_message *)
{
    enum bead_field shown = m->kdv.spec->variable;
    if (!(wanted & BEAD_FIELD_BIT(shown)))
        return BEAD_OK;
    bead_kdv_values(&m->kdv, t);
    memcpy(value[shown], m->kdv.spectral.grid, m->kdv.spectral.points * sizeof(double));
    return BEAD_OK;
}

static uint64_t evaluations(const struct bead_motion *m)
{
    return m->kdv.evaluations * m->kdv.spectral.points;
}

static const double *state(const struct bead_motion *m, size_t *count)
{
    *count = 2 * (m->kdv.spectral.modes + 1);
    return &m->kdv.end.u[0].re;
}

static double energy(const struct bead_motion *m)
{
    return m->kdv.spec->length * mean_square(&m->kdv, NULL);
}

/* The share of mode k of the Fourier series in the mean of u^2; the mean of u is not a mode. */
static double mode_energy(const double *u, size_t points, size_t k)
{
    const struct bead_pair turn = bead_wide_pair(2 * bead_wide_pi * k / points);
    double sum_c = 0, sum_s = 0;
    for (size_t i = 0; i < points; i++) {
        double c, s;
        bead_turn_to(bead_pair_times(turn, (double)i), &c, &s);
        sum_c += u[i] * c;
        sum_s += u[i] * s;
    }
    double n = (double)points;
    return (2 * k == points ? 1 : 2) * (sum_c * sum_c + sum_s * sum_s) / (n * n);
}

static void modes(const struct bead_chain_spec *chain, size_t points, const double *const value[BEAD_FIELD_COUNT], size_t count,
                  double *energy)
{
    for (size_t k = 1; k <= count; k++)
        energy[k - 1] = 2 * k <= points ? mode_energy(value[chain->equation.variable], points, k) : 0;
}

static const struct bead_equation equation = {
    .check = kdv_check,
    .create = kdv_create,
    .destroy = kdv_destroy,
    .pace = pace,
    .time = time_of,
    .step = kdv_step,
    .sample = kdv_sample,
    .evaluations = evaluations,
    .state = state,
    .energy = energy,
    .measures = measures,
};

const struct bead_system bead_system_kdv = {
    .name = "kdv",
    .help = "u_t + drift u_x + nonlinearity u u_x + dispersion u_xxx = 0, of Korteweg and de Vries, on a ring (the thesis's Eq. 1 "
            "and 12)",
    .label = "kdv",
    BEAD_EQUATION_WORDS,
    .equation = &equation,
    .field = field,
    .describe = describe,
    .count = count_points,
    .places = places,
    .mode_title = "mean square of the mode",
    .modes = modes,
};
