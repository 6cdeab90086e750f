/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equation `shock`: waves that steepen and break, by finite volumes and the Runge-Kutta method SSPRK(3,3) of C.-W. Shu and
 * S. Osher, J. Comput. Phys. 77, 439 (1988). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/equation/equation.h"
#include "sim/equation/shock_law.h"
#include "sim/equation/shock_watch.h"

struct bead_motion {
    struct bead_motion_settings settings;
    size_t cells, shown;  /* shown: cells of samples */
    double dx, smooth, h; /* h: the last step */
    struct bead_shock_state start, end, stage;
    struct bead_shock_watch watch;
    double *work, *faces; /* faces: displacements [shown + 1 + 2] */
    double *r, *v;        /* means over the cells shown */
    double mean_displacement, mean_velocity;
    uint64_t steps, evaluations;
    double *memory;
};

/* ---- meaning ---- */

static const enum bead_field fields[] = {BEAD_FIELD_STRAIN, BEAD_FIELD_VELOCITY, BEAD_FIELD_DISPLACEMENT, BEAD_FIELD_ENERGY,
                                         BEAD_FIELD_COUNT};

static const struct bead_field_info *field(enum bead_field field)
{
    static const struct bead_field_info infos[] = {
        [BEAD_FIELD_DISPLACEMENT] = {"displacement", "", "displacement u", 0},
        [BEAD_FIELD_VELOCITY] = {"velocity", "", "velocity", 0},
        [BEAD_FIELD_STRAIN] = {"strain", "", "strain", 0},
        [BEAD_FIELD_ENERGY] = {"energy", "", "energy density", 0},
    };
    return &infos[field];
}

/* "u_tt = 4 (1 + 0.5 u_x) u_xx", with subscripts. */
static void describe(const struct bead_chain_spec *chain, char *text, size_t size)
{
    const struct bead_equation_spec *spec = &chain->equation;
    char square[32] = "", factor[64] = "";
    if (spec->speed != 1)
        snprintf(square, sizeof square, "%.4g ", spec->speed * spec->speed);
    if (spec->epsilon != 0)
        snprintf(factor, sizeof factor, "(1 %s %.4g u\u2093) ", spec->epsilon < 0 ? "\u2212" : "+", fabs(spec->epsilon));
    snprintf(text, size, "u\u209c\u209c = %s%su\u2093\u2093", square, factor);
}

static const char *shock_check(const struct bead_equation_spec *spec, const char **key)
{
    double strongest = spec->epsilon * spec->amplitude;
    *key = "points";
    if (spec->start != BEAD_START_PULSE && spec->points && spec->points < 8 * spec->mode)
        return "must be at least 8 for each wave of the start";
    *key = "start";
    if (spec->start != BEAD_START_PULSE)
        strongest = -fabs(strongest);
    if (!(strongest > -1))
        return "asks for strains with 1 + epsilon u_x <= 0, where the equation has no waves: |epsilon amplitude| must be below 1";
    return NULL;
}

/* As many cells for a wave as its accuracy until it breaks requires, by the order of the method. */
static size_t count_cells(const struct bead_chain_spec *chain, double accuracy)
{
    const struct bead_equation_spec *spec = &chain->equation;
    const double in_a_wave = 64, least = 64, most = 1 << 17;
    if (spec->points)
        return spec->points;
    double waves = spec->start == BEAD_START_PULSE ? spec->length / (4 * spec->width) : (double)spec->mode;
    return (size_t)fmin(fmax(ceil(waves * in_a_wave * bead_pow(accuracy, -0.2)), least), most);
}

/* Values are means over the cells, shown at their centres. */
static void places(const struct bead_chain_spec *chain, size_t cells, double *first, double *spacing)
{
    *spacing = chain->equation.length / (double)cells;
    *first = chain->equation.low + 0.5 * *spacing;
}

/* ---- motion ---- */

/* Step, relative to the time in which waves cross a cell. From 0.65 on steps cause ripples behind a shock, 0.1 % of its height at
 * 0.8; the ripples at 0.6 are those of short steps. */
static const double courant = 0.6, courant_limit = 1, last_sliver = 1e-9;

/* Part of the energy that a smooth wave may lose: soon after breaking, it will then have lost about 5 % too much. */
static const double loss_limit = 2e-3;

/* INFINITY or NaN if the equation is no longer hyperbolic. */
static double fastest(const struct bead_motion *m, const struct bead_shock_state *s)
{
    double most = 0, least = INFINITY;
    for (size_t i = 0; i < m->cells; i++) {
        double square = 1 + m->settings.spec->epsilon * s->r[i];
        most = fmax(most, square);
        least = isfinite(square) ? fmin(least, square) : -INFINITY;
    }
    return least > 0 ? m->settings.spec->speed * sqrt(most) : INFINITY;
}

static void find_rates(struct bead_motion *m, struct bead_shock_state *s)
{
    bead_shock_rates(m->settings.spec, m->cells, m->dx, m->smooth, s->r, s->v, s->r_rate, s->v_rate, m->work);
    m->evaluations += m->cells;
}

/* to = x start + (1 - x) (from + h rate of from) */
static void combine(const struct bead_motion *m, double x, const struct bead_shock_state *from, struct bead_shock_state *to)
{
    const struct bead_shock_state *start = &m->start;
    for (size_t i = 0; i < m->cells; i++) {
        to->r[i] = x * start->r[i] + (1 - x) * (from->r[i] + m->h * from->r_rate[i]);
        to->v[i] = x * start->v[i] + (1 - x) * (from->v[i] + m->h * from->v_rate[i]);
    }
}

static void shock_destroy(struct bead_motion *m)
{
    if (!m)
        return;
    free(m->memory);
    free(m);
}

static enum bead_error allocate(struct bead_motion *m, struct bead_message *msg)
{
    size_t n = m->cells, ghosts = n + 2 * BEAD_SHOCK_GHOSTS;
    double *next = m->memory = calloc(12 * n + 6 * ghosts + 3 * m->shown + 3, sizeof(double));
    if (!next)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a grid of %zu cells", n);
    struct bead_shock_state *const states[] = {&m->start, &m->end, &m->stage};
    for (size_t i = 0; i < 3; i++, next += 4 * n)
        *states[i] = (struct bead_shock_state){0, next, next + n, next + 2 * n, next + 3 * n};
    m->work = next;
    m->faces = next + 6 * ghosts;
    m->r = m->shown == n ? m->stage.r : m->faces + m->shown + 3;
    m->v = m->shown == n ? m->stage.v : m->r + m->shown;
    return BEAD_OK;
}

static double longest(const struct bead_motion *m, const struct bead_shock_state *s)
{
    return m->settings.step > 0 ? m->settings.step : courant * m->dx / fastest(m, s);
}

/* The integral of the means over n cells of length 1 on a ring, from the left face of cell i on to x in it: the quintic through its
 * values at six faces. */
static double integral(const double *means, size_t n, size_t i, double x)
{
    const double a = means[(i + n - 2) % n], b = means[(i + n - 1) % n], c = means[i], d = means[(i + 1) % n],
                 e = means[(i + 2) % n], value[6] = {-a - b, -b, 0, c, c + d, c + d + e};
    double sum = 0;
    for (int k = 0; k < 6; k++) {
        double part = value[k];
        for (int l = 0; l < 6; l++)
            part *= l == k ? 1 : (x + 2 - l) / (k - l);
        sum += part;
    }
    return sum;
}

/* Means over the cells shown, to the fifth order, as from level to level in A. Harten, Comm. Pure Appl. Math. 48, 1305 (1995). */
static void divide_cells(const struct bead_motion *m, const double *from, double *to)
{
    const double length = (double)m->cells / (double)m->shown;
    double left = 0, sum = 0;
    size_t i = 0;
    for (size_t k = 0; k < m->shown && to != from; k++) {
        const double x = length * (double)(k + 1);
        for (; i + 1 < m->cells && (double)(i + 1) <= x; i++)
            sum += from[i];
        const double right = sum + integral(from, m->cells, i, x - (double)i);
        to[k] = (right - left) / length;
        left = right;
    }
}

/* Find the displacements of the faces of the cells shown, up to a constant; returns their mean. */
static double find_faces(const struct bead_motion *m, const double *r)
{
    const double dx = m->settings.spec->length / (double)m->shown;
    double u = 0, sum = 0;
    for (size_t i = 0; i < m->shown; i++) {
        m->faces[i + 1] = u;
        sum += u + 0.5 * dx * r[i];
        u += dx * r[i];
    }
    m->faces[m->shown + 1] = u;
    m->faces[0] = -dx * r[m->shown - 1];
    m->faces[m->shown + 2] = u + dx * r[0];
    return sum / (double)m->shown;
}

static enum bead_error shock_create(const struct bead_motion_settings *settings, struct bead_motion **motion,
                                    struct bead_message *msg)
{
    BEAD_TRY(bead_new(motion, 1, msg, "an equation"));
    struct bead_motion *m = *motion;
    m->settings = *settings;
    m->cells = settings->points;
    m->shown = settings->shown > 0 ? settings->shown : m->cells;
    m->dx = settings->spec->length / (double)m->cells;
    m->smooth = bead_shock_smooth(settings->spec, m->dx);
    BEAD_TRY(allocate(m, msg));
    double *scratch = m->work + 4 * (m->cells + 2 * BEAD_SHOCK_GHOSTS);
    bead_shock_start(settings->spec, m->cells, m->end.r, m->end.v);
    bead_shock_watch_begin(&m->watch, settings->spec, m->cells, scratch, &m->end);
    memcpy(m->stage.r, m->end.r, m->cells * sizeof *m->stage.r);
    divide_cells(m, m->stage.r, m->r);
    m->mean_displacement = find_faces(m, m->r);
    m->mean_velocity = m->watch.start.momentum / settings->spec->length;
    m->h = longest(m, &m->end);
    find_rates(m, &m->end);
    if (!(m->h * fastest(m, &m->end) <= courant_limit * m->dx))
        return bead_fail(msg, BEAD_ERROR_SCENE, "simulate.step: %.3g is too long for cells of %.3g: at most %.3g", m->h, m->dx,
                         courant_limit * m->dx / fastest(m, &m->end));
    return BEAD_OK;
}

/* The resolution: waves cross two cells or a five-hundredth of the domain. */
static void pace(const struct bead_motion *m, struct bead_pace *pace)
{
    double resolution = fmax(2 * m->dx, 0.002 * m->settings.spec->length) / fastest(m, &m->end);
    *pace = (struct bead_pace){"weno5-ssprk3", m->h, resolution, !(m->settings.step > 0), NULL};
}

static double time_of(const struct bead_motion *m)
{
    return m->end.t;
}

static enum bead_error shock_step(struct bead_motion *m, struct bead_message *msg)
{
    struct bead_shock_state old = m->start;
    m->start = m->end;
    m->end = old;
    m->h = longest(m, &m->start);
    m->end.t = m->start.t + m->h;
    if (m->end.t > m->settings.end - last_sliver * m->h) {
        m->end.t = m->settings.end;
        m->h = m->end.t - m->start.t;
    }
    combine(m, 0, &m->start, &m->stage);
    find_rates(m, &m->stage);
    combine(m, 0.75, &m->stage, &m->end);
    find_rates(m, &m->end);
    combine(m, 1. / 3, &m->end, &m->end);
    m->steps++;
    double speed = fastest(m, &m->end);
    if (!isfinite(speed))
        return bead_fail(msg, BEAD_ERROR_NUMBERS,
                         "at %.6g there are strains with 1 + epsilon u_x <= 0, where the equation has no waves", m->end.t);
    if (m->h * speed > courant_limit * m->dx)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "at %.6g steps of %.3g are too long for cells of %.3g: at most %.3g", m->end.t,
                         m->h, m->dx, courant_limit * m->dx / speed);
    find_rates(m, &m->end);
    bead_shock_watch_step(&m->watch, &m->end);
    const double lost = bead_shock_lost(&m->watch, m->end.t);
    if (lost > loss_limit)
        return bead_fail(
            msg, BEAD_ERROR_NUMBERS,
            "at %.6g, before the wave breaks, a grid of %zu points has lost %.2g of its energy, more than %.2g: it needs "
            "more points",
            m->end.t, m->cells, lost, loss_limit);
    return BEAD_OK;
}

/* ---- samples ---- */

/* The cubic through values and rates at both ends of the step. */
static void between(struct bead_motion *m, double t)
{
    const struct bead_shock_state *a = &m->start, *b = &m->end;
    double h = b->t - a->t, x = t >= b->t || !(h > 0) ? 1 : (t - a->t) / h, y = 1 - x;
    double va = y * y * (1 + 2 * x), vb = x * x * (1 + 2 * y), ra = h * x * y * y, rb = -h * x * x * y;
    for (size_t i = 0; i < m->cells; i++) {
        m->stage.r[i] = va * a->r[i] + vb * b->r[i] + ra * a->r_rate[i] + rb * b->r_rate[i];
        m->stage.v[i] = va * a->v[i] + vb * b->v[i] + ra * a->v_rate[i] + rb * b->v_rate[i];
    }
    divide_cells(m, m->stage.r, m->r);
    divide_cells(m, m->stage.v, m->v);
}

/* Displacements of the centres of cells, from those of faces; their mean moves with the mean velocity, which is conserved. */
static void displacements(const struct bead_motion *m, double t, double *u)
{
    double shift = m->mean_displacement + m->mean_velocity * t - find_faces(m, m->r);
    for (size_t i = 0; i < m->shown; i++) {
        const double *f = m->faces + i;
        u[i] = shift + (9 * (f[1] + f[2]) - f[0] - f[3]) / 16;
    }
}

static enum bead_error shock_sample(struct bead_motion *m, double t, unsigned wanted, double *const value[BEAD_FIELD_COUNT],
                                    struct bead_message *)
{
    size_t bytes = m->shown * sizeof(double);
    between(m, t);
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_STRAIN))
        memcpy(value[BEAD_FIELD_STRAIN], m->r, bytes);
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY))
        memcpy(value[BEAD_FIELD_VELOCITY], m->v, bytes);
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT))
        displacements(m, t, value[BEAD_FIELD_DISPLACEMENT]);
    if (wanted & BEAD_FIELD_BIT(BEAD_FIELD_ENERGY)) {
        for (size_t i = 0; i < m->shown; i++)
            value[BEAD_FIELD_ENERGY][i] = bead_shock_energy(m->settings.spec, m->r[i], m->v[i]);
    }
    return BEAD_OK;
}

static uint64_t evaluations(const struct bead_motion *m)
{
    return m->evaluations;
}

static const double *state(const struct bead_motion *m, size_t *count)
{
    *count = 2 * m->cells; /* v follows r */
    return m->end.r;
}

/* Shocks dissipate energy; only a gain of energy is an error. */
static double energy(const struct bead_motion *m)
{
    return m->watch.start.energy + m->watch.energy_gained;
}

static size_t measures(const struct bead_motion *m, struct bead_measure *to, size_t room)
{
    return bead_shock_measures(&m->watch, &m->end, to, room);
}

static const struct bead_equation equation = {
    .check = shock_check,
    .create = shock_create,
    .destroy = shock_destroy,
    .pace = pace,
    .time = time_of,
    .by_grid = true,
    .step = shock_step,
    .sample = shock_sample,
    .evaluations = evaluations,
    .state = state,
    .energy = energy,
    .measures = measures,
};

const struct bead_system bead_system_shock = {
    .name = "shock",
    .help =
        "u_tt = speed^2 u_xx (1 + epsilon u_x) on a ring: waves that break (the thesis's Appendix 2); values are means over the "
        "cells of the grid; the ripples in the 20 points behind a shock, up to 0.1 % of its height, are made by the scheme (WENO "
        "of "
        "fifth order)",
    .label = "shock",
    BEAD_EQUATION_WORDS,
    .equation = &equation,
    .fields = fields,
    .field = field,
    .describe = describe,
    .count = count_cells,
    .places = places,
};
