/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watches a run of shock.c after every step: energy, variation, and the time at which the wave breaks. */
#include "sim/equation/shock_watch.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/equation/shock_law.h"

/* A front of F cells at the start has F s cells when it is 1 / s times as steep; its steepest part is narrower, about F s^(3/2)
 * cells (a cusp grows there). Below this many cells the grid can no longer resolve it. */
static const double cells_of_a_cusp = 20;

enum { GHOSTS = BEAD_SHOCK_GHOSTS, LOOK_EVERY = 8 };

static void find_totals(const struct bead_shock_watch *w, const struct bead_shock_state *s, struct bead_shock_totals *to)
{
    double mass = 0, momentum = 0, energy = 0;
    for (size_t i = 0; i < w->cells; i++) {
        mass += s->r[i];
        momentum += s->v[i];
        energy += bead_shock_energy(w->spec, s->r[i], s->v[i]);
    }
    *to = (struct bead_shock_totals){w->dx * mass, w->dx * momentum, w->dx * energy};
}

static void wrap(double *w, size_t n)
{
    for (size_t i = 0; i < GHOSTS; i++) {
        w[i] = w[n + i];
        w[n + GHOSTS + i] = w[GHOSTS + i];
    }
}

static void set_invariants(const struct bead_shock_watch *w, size_t i, double r, double v)
{
    const double g = bead_shock_g(w->spec, r);
    w->right[i + GHOSTS] = v - g;
    w->left[i + GHOSTS] = v + g;
}

/* Invariants of the means over the cells, and their total variation. */
static double find_variation(const struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    double variation = 0;
    for (size_t i = 0; i < w->cells; i++)
        set_invariants(w, i, s->r[i], s->v[i]);
    wrap(w->right, w->cells);
    wrap(w->left, w->cells);
    for (size_t i = GHOSTS; i < w->cells + GHOSTS; i++)
        variation += fabs(w->right[i + 1] - w->right[i]) + fabs(w->left[i + 1] - w->left[i]);
    return variation;
}

/* The value at the centre of cell i from the means over five cells, to the sixth order. */
static double centre(const double *mean, size_t i, size_t n)
{
    const double before = mean[i > 0 ? i - 1 : n - 1], after = mean[i + 1 < n ? i + 1 : 0];
    const double far = mean[i > 1 ? i - 2 : i + n - 2] + mean[i + 2 < n ? i + 2 : i + 2 - n];
    return (9 * far - 116 * (before + after) + 2134 * mean[i]) / 1920;
}

/* Invariants at the centres of the cells. A mean would flatten the steepest place by a part of the order dx^2. */
static void find_invariants(const struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    for (size_t i = 0; i < w->cells; i++)
        set_invariants(w, i, centre(s->r, i, w->cells), centre(s->v, i, w->cells));
    wrap(w->right, w->cells);
    wrap(w->left, w->cells);
}

/* The factor k of the comment on characteristics below; `right` and `left` are the invariants v - g and v + g. */
static double speed_of(const struct bead_equation_spec *spec, double right, double left)
{
    return spec->speed * bead_cbrt(1 + 0.75 * spec->epsilon * (left - right) / spec->speed);
}

static double steepening(const struct bead_equation_spec *spec, double right, double left)
{
    double c = spec->speed, a = speed_of(spec, right, left);
    return c * c * fabs(spec->epsilon) / (4 * a * a * sqrt(a));
}

/* The place where a family steepens fastest. */
struct steepest {
    size_t cell;
    double rate, z, error; /* error: of z */
};

struct time_left {
    double time, front, error;
};

/* One family of characteristics, going `way` (+1, -1). */
struct family {
    const double *own, *other; /* invariants, from the first ghost on */
    int way;
};

static double steepening_at(const struct bead_shock_watch *w, struct family f, double own, double other)
{
    return f.way > 0 ? steepening(w->spec, own, other) : steepening(w->spec, other, own);
}

/* Mean of k along the characteristic from cell i, which meets `cells` cells of the other family's waves. */
static double mean_steepening(const struct bead_shock_watch *w, struct family f, size_t i, double cells)
{
    double n = (double)w->cells, rounds = floor(cells / n), rest = cells - rounds * n, all = 0, part = 0;
    size_t j = i;
    for (size_t m = 0; m < w->cells; m++) {
        double k = steepening_at(w, f, f.own[i + GHOSTS], f.other[j + GHOSTS]);
        all += k;
        part += k * fmin(fmax(rest - (double)m, 0), 1);
        j = f.way > 0 ? (j + 1 == w->cells ? 0 : j + 1) : (j ? j - 1 : w->cells - 1);
    }
    return (rounds * all + part) / cells;
}

/* z at cell i (see below), by differences of the sixth order. *error: how much those of the second order differ: far more than the
 * error of this difference, but the grid has also smeared the front. */
static double steepness(const struct bead_shock_watch *w, struct family f, size_t i, double *error)
{
    const double *q = f.own + i + GHOSTS, sign = w->spec->epsilon < 0 ? -1 : 1;
    const double one = q[1] - q[-1], two = q[2] - q[-2], three = q[3] - q[-3];
    const double root = sqrt(speed_of(w->spec, w->right[i + GHOSTS], w->left[i + GHOSTS]));
    const double slope = sign * (45 * one - 9 * two + three) / (60 * w->dx);
    *error = root * fabs(slope - sign * one / (2 * w->dx));
    return root * slope;
}

/* The steepest place of a family, by its rate z k: the vertex of the parabola through three cells, to the third order. */
static struct steepest find_steepest(const struct bead_shock_watch *w, struct family f)
{
    struct steepest most = {.rate = 0};
    double other = 0, error;
    for (size_t i = 0; i < w->cells; i++)
        other += f.other[i + GHOSTS] / (double)w->cells;
    for (size_t i = 0; i < w->cells; i++) {
        const double z = steepness(w, f, i, &error), rate = z * steepening_at(w, f, f.own[i + GHOSTS], other);
        if (rate > most.rate)
            most = (struct steepest){i, rate, z, error};
    }
    double at[3] = {0, most.rate, 0};
    for (size_t i = 0; i < 3 && most.rate > 0; i += 2) {
        const size_t cell = (most.cell + w->cells + i - 1) % w->cells;
        at[i] = steepness(w, f, cell, &error) * steepening_at(w, f, f.own[cell + GHOSTS], other);
    }
    const double bend = 2 * at[1] - at[0] - at[2], difference = at[2] - at[0];
    if (bend > 0)
        most.z *= 1 + 0.125 * difference * difference / (bend * most.rate);
    return most;
}

/* Time until the first characteristics of a family cross, the number of cells of its steepest front, and the error that differences
 * leave in this time.
 *
 * Along a characteristic of the invariant w, z = sqrt(a) w_x obeys z' = k z^2 with k = c^2 e / (4 a^(5/2)): differentiate w_t +- a
 * w_x = 0 by x, and write a_x by both invariants; the other one's part is -(ln sqrt(a))' z and goes into the factor (P. D. Lax, J.
 * Math. Phys. 5, 611 (1964)). So z is infinite when the integral of k along the way is 1 / z. The own invariant is constant along
 * the way; the other is taken from the waves on the way in their present state. This is exact in a simple wave. */
static struct time_left time_left(const struct bead_shock_watch *w, struct family f)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < w->cells; i++) {
        low = fmin(low, f.own[i + GHOSTS]);
        high = fmax(high, f.own[i + GHOSTS]);
    }
    const struct steepest most = find_steepest(w, f);
    if (!(most.rate > 0))
        return (struct time_left){INFINITY, INFINITY, 0};
    const double speed = speed_of(w->spec, w->right[most.cell + GHOSTS], w->left[most.cell + GHOSTS]);
    double left = 1 / most.rate;
    for (int i = 0; i < 3; i++)
        left = 1 / (most.z * mean_steepening(w, f, most.cell, fmax(left * 2 * speed / w->dx, 1)));
    return (struct time_left){left, (high - low) * sqrt(speed) / (most.z * w->dx), left * most.error / most.z};
}

/* Far from breaking, the waves in between may still change the time; close to it, the grid does not resolve the front. A new time
 * that differs from the last by less than its error is no better. */
static void look(struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    const struct family to_right = {w->right, w->left, 1}, to_left = {w->left, w->right, -1};
    if (w->broken)
        return;
    find_invariants(w, s);
    const struct time_left a = time_left(w, to_right), b = time_left(w, to_left), left = b.time < a.time ? b : a;
    w->front = s->t > 0 ? w->front : left.front;
    w->broken = left.front * sqrt(left.front / w->front) < cells_of_a_cusp && s->t > 0.5 * w->breaking;
    if (!w->broken && !(fabs(s->t + left.time - w->breaking) <= left.error))
        w->breaking = s->t + left.time;
}

void bead_shock_watch_begin(struct bead_shock_watch *w, const struct bead_equation_spec *spec, size_t cells, double *scratch,
                            const struct bead_shock_state *s)
{
    *w = (struct bead_shock_watch){.spec = spec, .cells = cells, .dx = spec->length / (double)cells, .breaking = INFINITY};
    w->right = scratch;
    w->left = scratch + cells + 2 * GHOSTS;
    find_totals(w, s, &w->start);
    w->energy = w->start.energy;
    w->variation_start = w->variation_most = find_variation(w, s);
    look(w, s);
}

void bead_shock_watch_step(struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    struct bead_shock_totals now;
    find_totals(w, s, &now);
    w->energy_gained += fmax(now.energy - w->energy, 0);
    w->energy = now.energy;
    w->variation_most = fmax(w->variation_most, find_variation(w, s));
    if (++w->steps % LOOK_EVERY == 0)
        look(w, s);
}

double bead_shock_lost(const struct bead_shock_watch *w, double t)
{
    const double smooth = 0.75; /* as a part of the time until it breaks */
    return t < smooth * w->breaking && w->start.energy > 0 ? 1 - w->energy / w->start.energy : 0;
}

/* The breaking time of a wave r = V sin(k x) that runs right: when its falling front first overtakes itself. */
static double closed_form(const struct bead_equation_spec *spec)
{
    double k = 2 * M_PI * (double)spec->mode / spec->length, a = fabs(spec->epsilon * spec->amplitude),
           s = (sqrt(1 - a * a) - 1) / a;
    return 2 / (spec->speed * a * k) * sqrt((1 + a * s) / (1 - s * s));
}

size_t bead_shock_measures(const struct bead_shock_watch *w, const struct bead_shock_state *s, struct bead_measure *to, size_t room)
{
    struct bead_shock_totals now;
    size_t n = 0;
    find_totals(w, s, &now);
    n = bead_measure_add(to, n, room, "change of the integral of the strain", now.mass - w->start.mass);
    n = bead_measure_add(to, n, room, "change of the momentum", now.momentum - w->start.momentum);
    n = bead_measure_add(to, n, room, "energy", now.energy);
    n = bead_measure_add(to, n, room, "change of the energy, relative", w->start.energy > 0 ? now.energy / w->start.energy - 1 : 0);
    n = bead_measure_add(to, n, room, "energy out of nothing, relative",
                         w->start.energy > 0 ? w->energy_gained / w->start.energy : 0);
    n = bead_measure_add(to, n, room, "largest total variation, relative",
                         w->variation_start > 0 ? w->variation_most / w->variation_start : 1);
    if (isfinite(w->breaking))
        n = bead_measure_add(to, n, room, w->broken ? "breaking time" : "breaking time, extrapolated", w->breaking);
    if (w->spec->start == BEAD_START_SIMPLE_WAVE && w->spec->epsilon * w->spec->amplitude != 0)
        n = bead_measure_add(to, n, room, "breaking time, closed form", closed_form(w->spec));
    return n;
}
