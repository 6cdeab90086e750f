/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of shock.c watches after every step: energy, variation, and the time at which the wave breaks. */
#include "sim/equation/shock_watch.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/equation/shock_law.h"

static const double pi = 3.14159265358979323846;

/* A front of F cells at the start has F s when it is as steep as 1 / s of the start; the steep part of it is narrower, some
 * F s^(3/2) (a cusp grows there). Where that is below these cells the grid has no more to tell. */
static const double cells_of_a_cusp = 20;

enum { GHOSTS = 2, LOOK_EVERY = 8 };

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

static double find_invariants(const struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    double variation = 0;
    for (size_t i = 0; i < w->cells; i++) {
        double g = bead_shock_g(w->spec, s->r[i]);
        w->right[i + GHOSTS] = s->v[i] - g;
        w->left[i + GHOSTS] = s->v[i] + g;
    }
    wrap(w->right, w->cells);
    wrap(w->left, w->cells);
    for (size_t i = GHOSTS; i < w->cells + GHOSTS; i++)
        variation += fabs(w->right[i + 1] - w->right[i]) + fabs(w->left[i + 1] - w->left[i]);
    return variation;
}

/* The factor k of the comment on characteristics below, where the invariants are v - g and v + g. */
static double steepening(const struct bead_equation_spec *spec, double right, double left)
{
    double c = spec->speed, a = c * bead_cbrt(1 + 0.75 * spec->epsilon * (left - right) / c);
    return c * c * fabs(spec->epsilon) / (4 * a * a * sqrt(a));
}

/* One family of characteristics, going `way` (+1, -1). */
struct family {
    const double *own, *other; /* invariants, from the first ghost on */
    int way;
};

static double steepening_at(const struct bead_shock_watch *w, struct family f, double own, double other)
{
    return f.way > 0 ? steepening(w->spec, own, other) : steepening(w->spec, other, own);
}

/* Mean of k on the way of the characteristic at cell i, which meets that many cells of the other family's waves. */
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

/* Time left until the first of a family of characteristics cross, and how many cells its steepest front has.
 *
 * Along a characteristic of the invariant w, z = sqrt(a) w_x obeys z' = k z^2 with k = c^2 e / (4 a^(5/2)): differentiate w_t +- a
 * w_x = 0 by x, and write a_x by both invariants; the other one's part is -(ln sqrt(a))' z and goes into the factor (P. D. Lax, J.
 * Math. Phys. 5, 611 (1964)). So z is infinite when the integral of k along the way is 1 / z. The own invariant is constant on that
 * way, the other is that of the waves it meets, here as they are now. In a simple wave that is exact. */
static double time_left(const struct bead_shock_watch *w, const struct bead_shock_state *s, struct family f, double *front)
{
    const struct bead_equation_spec *spec = w->spec;
    double steepest = 0, low = INFINITY, high = -INFINITY, sign = spec->epsilon < 0 ? -1 : 1, other = 0, most = 0, z = 0;
    size_t first = 0;
    for (size_t i = 0; i < w->cells; i++)
        other += f.other[i + GHOSTS] / (double)w->cells;
    for (size_t i = 0; i < w->cells; i++) {
        const double *q = f.own + i + GHOSTS;
        double slope = sign * (8 * (q[1] - q[-1]) - (q[2] - q[-2])) / (12 * w->dx);
        double here = slope * sqrt(bead_shock_speed(spec, s->r[i])), rate = here * steepening_at(w, f, q[0], other);
        steepest = fmax(steepest, slope);
        low = fmin(low, q[0]);
        high = fmax(high, q[0]);
        if (rate > most) {
            most = rate;
            z = here;
            first = i;
        }
    }
    *front = steepest > 0 ? (high - low) / (steepest * w->dx) : INFINITY;
    if (!(most > 0))
        return INFINITY;
    double left = 1 / most, speed = 2 * bead_shock_speed(spec, s->r[first]);
    for (int i = 0; i < 3; i++)
        left = 1 / (z * mean_steepening(w, f, first, fmax(left * speed / w->dx, 1)));
    return left;
}

static void look(struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    double front, other_front;
    struct family to_right = {w->right, w->left, 1}, to_left = {w->left, w->right, -1};
    if (w->broken)
        return;
    double left = time_left(w, s, to_right, &front), other = time_left(w, s, to_left, &other_front);
    if (other < left) {
        left = other;
        front = other_front;
    }
    w->front = s->t > 0 ? w->front : front;
    w->broken = front * sqrt(front / w->front) < cells_of_a_cusp && s->t > 0.5 * w->breaking;
    if (!w->broken)
        w->breaking = s->t + left;
}

void bead_shock_watch_begin(struct bead_shock_watch *w, const struct bead_equation_spec *spec, size_t cells, double *scratch,
                            const struct bead_shock_state *s)
{
    *w = (struct bead_shock_watch){.spec = spec, .cells = cells, .dx = spec->length / (double)cells, .breaking = INFINITY};
    w->right = scratch;
    w->left = scratch + cells + 2 * GHOSTS;
    find_totals(w, s, &w->start);
    w->energy = w->start.energy;
    w->variation_start = w->variation_most = find_invariants(w, s);
    look(w, s);
}

void bead_shock_watch_step(struct bead_shock_watch *w, const struct bead_shock_state *s)
{
    struct bead_shock_totals now;
    find_totals(w, s, &now);
    w->energy_gained += fmax(now.energy - w->energy, 0);
    w->energy = now.energy;
    w->variation_most = fmax(w->variation_most, find_invariants(w, s));
    if (++w->steps % LOOK_EVERY == 0)
        look(w, s);
}

double bead_shock_lost(const struct bead_shock_watch *w, double t)
{
    const double smooth = 0.75; /* of the time until it breaks */
    return t < smooth * w->breaking && w->start.energy > 0 ? 1 - w->energy / w->start.energy : 0;
}

/* Of a wave r = V sin(k x) that goes right: where a falling front meets itself first. */
static double closed_form(const struct bead_equation_spec *spec)
{
    double k = 2 * pi * (double)spec->mode / spec->length, a = fabs(spec->epsilon * spec->amplitude), s = (sqrt(1 - a * a) - 1) / a;
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
