#include "sim/equation/kdv_measures.h"

#include <math.h>
#include <stdio.h>

#include "sim/equation/kdv_start.h"

static const double pi = 3.14159265358979323846;

/* ---- integrals ---- */

/* Values of u into the scratch grid: const runs own no other. */
static const double *values(const struct bead_kdv *kdv)
{
    struct bead_spectral scratch = kdv->spectral;
    bead_spectral_to_grid(&scratch, kdv->end.u);
    for (size_t i = 0; i < scratch.points; i++)
        scratch.grid[i] += kdv->mean;
    return scratch.grid;
}

void bead_kdv_integrals(const struct bead_kdv *kdv, struct bead_kdv_integrals *to)
{
    const struct bead_equation_spec *spec = kdv->spec;
    const double *u = values(kdv);
    double cubes = 0, squares = 0, slopes = 0;
    size_t n = kdv->spectral.points;
    for (size_t i = 0; i < n; i++)
        cubes += u[i] * u[i] * u[i];
    for (size_t j = 1; j <= kdv->spectral.modes; j++) {
        double k = kdv->wave_number[j], size = kdv->end.u[j].re * kdv->end.u[j].re + kdv->end.u[j].im * kdv->end.u[j].im;
        squares += 2 * size;
        slopes += 2 * k * k * size;
    }
    squares += kdv->mean * kdv->mean;
    to->mass = spec->length * (kdv->mean + kdv->end.u[0].re);
    to->momentum = spec->length * squares;
    to->hamiltonian =
        spec->length * (spec->drift * squares / 2 + spec->nonlinearity * cubes / (6 * (double)n) - spec->dispersion * slopes / 2);
}

/* ---- the return of the first wave ---- */

static double watched(const struct bead_kdv_watch *w, const struct bead_kdv_state *s, double *rate)
{
    struct bead_complex u = s->u[w->mode], slope = s->slope[w->mode];
    *rate = 2 * (u.re * slope.re + u.im * slope.im); /* the linear part only turns it */
    return u.re * u.re + u.im * u.im;
}

void bead_kdv_watch_begin(struct bead_kdv_watch *w, const struct bead_kdv *kdv)
{
    *w = (struct bead_kdv_watch){.mode = kdv->spec->start == BEAD_START_COSINE ? kdv->spec->mode : 0};
    bead_kdv_integrals(kdv, &w->start);
    if (w->mode > kdv->spectral.modes)
        w->mode = 0;
    if (w->mode)
        w->first = w->before = watched(w, &kdv->end, &w->rate_before);
}

void bead_kdv_watch_step(struct bead_kdv_watch *w, const struct bead_kdv *kdv)
{
    if (!w->mode)
        return;
    double rate, h = kdv->end.t - kdv->start.t, e0 = w->before, r0 = h * w->rate_before;
    double e1 = watched(w, &kdv->end, &rate), r1 = h * rate;
    w->before = e1;
    w->rate_before = rate;
    w->away = w->away || e1 < 0.25 * w->first;
    if (!(w->away && r0 > 0 && r1 <= 0))
        return;
    /* The largest value of the cubic through values and rates at both ends. */
    double low = 0, high = 1, c2 = 3 * (e1 - e0) - 2 * r0 - r1, c3 = 2 * (e0 - e1) + r0 + r1;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *(r0 + middle * (2 * c2 + 3 * middle * c3) > 0 ? &low : &high) = middle;
    }
    double x = 0.5 * (low + high), peak = e0 + x * (r0 + x * (c2 + x * c3));
    if (peak > w->high) {
        w->high = peak;
        w->high_time = kdv->start.t + x * h;
    }
}

/* ---- solitons ---- */

struct crest {
    double at, height; /* at: from low */
};

static bool is_crest(const double *u, size_t points, size_t i)
{
    return u[i] > u[i ? i - 1 : points - 1] && u[i] >= u[i + 1 < points ? i + 1 : 0];
}

/* The crest at or beside a grid point, by Newton's method on the series. */
static struct crest refine(const struct bead_kdv *kdv, size_t point, double sign)
{
    double phase = 2 * pi * (double)point / (double)kdv->spectral.points, value[3], cell = 2 * pi / (double)kdv->spectral.points;
    for (int i = 0; i < 6; i++) {
        bead_spectral_at(kdv->end.u, kdv->spectral.modes, phase, value);
        double move = value[2] != 0 ? -value[1] / value[2] : 0;
        phase += fmin(fmax(move, -cell), cell);
    }
    bead_spectral_at(kdv->end.u, kdv->spectral.modes, phase, value);
    return (struct crest){phase * kdv->spec->length / (2 * pi), sign * (value[0] + kdv->mean)};
}

static double wrap(double x, double length)
{
    return x - length * round(x / length);
}

static size_t add_of_soliton(struct bead_measure *to, size_t n, size_t room, size_t soliton, const char *what, double value)
{
    char name[sizeof to->name];
    snprintf(name, sizeof name, "soliton %zu: %s", soliton + 1, what);
    return bead_measure_add(to, n, room, name, value);
}

/* The crest whose height is nearest the soliton's; those further off than a tenth are no soliton's, or in a collision. */
static bool find_soliton(const struct bead_kdv *kdv, const double *u, size_t i, struct crest *best)
{
    const struct bead_equation_spec *spec = kdv->spec;
    const double near = 0.1;
    double height = bead_kdv_soliton_amplitude(spec, spec->solitons[i].speed), sign = height > 0 ? 1 : -1, least = INFINITY;
    size_t n = kdv->spectral.points, found = 0;
    for (size_t p = 0; p < n; p++) {
        double here = fabs(u[p] - height);
        bool crest = sign > 0 ? is_crest(u, n, p) : u[p] < u[p ? p - 1 : n - 1] && u[p] <= u[p + 1 < n ? p + 1 : 0];
        if (crest && here < least) {
            least = here;
            found = p;
        }
    }
    if (least > 2 * near * fabs(height)) /* a crest between points looks lower */
        return false;
    *best = refine(kdv, found, 1);
    return fabs(best->height - height) <= near * fabs(height);
}

static size_t solitons(const struct bead_kdv *kdv, const double *u, struct bead_measure *to, size_t n, size_t room)
{
    const struct bead_equation_spec *spec = kdv->spec;
    struct crest crest;
    for (size_t i = 0; i < spec->soliton_count; i++) {
        if (!find_soliton(kdv, u, i, &crest))
            continue;
        double place = spec->low + crest.at - spec->length * floor(crest.at / spec->length);
        double free = spec->solitons[i].at + (spec->solitons[i].speed + spec->drift) * kdv->end.t;
        n = add_of_soliton(to, n, room, i, "place", place);
        n = add_of_soliton(to, n, room, i, "amplitude", crest.height);
        n = add_of_soliton(to, n, room, i, "shift from free motion", wrap(place - free, spec->length));
    }
    return n;
}

/* ---- all ---- */

static double relative(double now, double start)
{
    return start != 0 ? now / start - 1 : now;
}

size_t bead_kdv_measures(const struct bead_kdv_watch *w, const struct bead_kdv *kdv, struct bead_measure *to, size_t room)
{
    struct bead_kdv_integrals now;
    size_t n = 0, crests = 0;
    bead_kdv_integrals(kdv, &now);
    n = bead_measure_add(to, n, room, "mass", now.mass);
    n = bead_measure_add(to, n, room, "change of the mass", now.mass - w->start.mass);
    n = bead_measure_add(to, n, room, "momentum", now.momentum);
    n = bead_measure_add(to, n, room, "change of the momentum, relative", relative(now.momentum, w->start.momentum));
    n = bead_measure_add(to, n, room, "hamiltonian", now.hamiltonian);
    n = bead_measure_add(to, n, room, "change of the hamiltonian, relative", relative(now.hamiltonian, w->start.hamiltonian));
    n = bead_measure_add(to, n, room, "tail of the spectrum, relative", kdv->tail);
    const double *u = values(kdv);
    for (size_t i = 0; i < kdv->spectral.points; i++)
        crests += is_crest(u, kdv->spectral.points, i);
    if (kdv->spec->start == BEAD_START_SOLITONS)
        return solitons(kdv, u, to, n, room);
    n = bead_measure_add(to, n, room, "crests at the end", (double)crests);
    if (w->high > 0) {
        n = bead_measure_add(to, n, room, "recurrence time", w->high_time);
        n = bead_measure_add(to, n, room, "amplitude at recurrence, relative", sqrt(w->high / w->first));
    }
    return n;
}
