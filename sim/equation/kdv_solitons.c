/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds and follows solitons: see kdv_solitons.h. */
#include "sim/equation/kdv_solitons.h"

#include <math.h>

/* A crest whose height differs by more than this part from the soliton's is a different one, or in a collision. */
static const double near = 0.1;
/* Between two looks the fastest soliton moves by this part of the narrowest one's width. */
static const double look_part = 0.5;
/* How much a distance of the whole ring counts, relative to a height off by `near`: heights distinguish solitons, places only those
 * of equal height. */
static const double place_weight = 0.01;

bool bead_kdv_is_crest(const double *u, size_t points, size_t i)
{
    return u[i] > u[i ? i - 1 : points - 1] && u[i] >= u[i + 1 < points ? i + 1 : 0];
}

static bool is_trough(const double *u, size_t points, size_t i)
{
    return u[i] < u[i ? i - 1 : points - 1] && u[i] <= u[i + 1 < points ? i + 1 : 0];
}

static double wrap(double x, double length)
{
    return x - length * round(x / length);
}

/* Positive for all solitons of a scene, or negative for all. */
static double height_of(const struct bead_equation_spec *spec, size_t i)
{
    return bead_kdv_soliton_amplitude(spec, spec->solitons[i].speed);
}

static double speed_of(const struct bead_equation_spec *spec, size_t i)
{
    return spec->solitons[i].speed + spec->drift;
}

/* The crest at or beside a grid point, by Newton's method on the series. */
static struct bead_kdv_crest refine(const struct bead_kdv *kdv, size_t point)
{
    double phase = 2 * M_PI * (double)point / (double)kdv->spectral.points, value[3],
           cell = 2 * M_PI / (double)kdv->spectral.points;
    for (int i = 0; i < 6; i++) {
        bead_spectral_at(kdv->end.u, kdv->spectral.modes, phase, value);
        double move = value[2] != 0 ? -value[1] / value[2] : 0;
        phase += fmin(fmax(move, -cell), cell);
    }
    bead_spectral_at(kdv->end.u, kdv->spectral.modes, phase, value);
    return (struct bead_kdv_crest){kdv->spec->low + phase * kdv->spec->length / (2 * M_PI), value[0] + kdv->mean};
}

/* The unlikeness of soliton i to a crest of this height, at this distance from the expected place. INFINITY: not the same. */
static double unlike(const struct bead_equation_spec *spec, size_t i, double height, double distance, double tolerance)
{
    const double off = (height - height_of(spec, i)) / (tolerance * fabs(height_of(spec, i))), part = distance / spec->length;
    return fabs(off) <= 1 ? off * off + place_weight * part * part : INFINITY;
}

/* Crests to consider. */
enum { MOST_CRESTS = 4 * BEAD_SOLITONS };

/* Find crests that may be solitons. A crest between grid points looks lower, hence twice the tolerance. */
static size_t find_crests(const struct bead_kdv *kdv, struct bead_kdv_crest *crests)
{
    const struct bead_equation_spec *spec = kdv->spec;
    const double *u = bead_kdv_grid(kdv, kdv->end.u);
    const size_t n = kdv->spectral.points;
    size_t count = 0;
    for (size_t p = 0; p < n && count < MOST_CRESTS; p++) {
        bool like = false;
        for (size_t i = 0; i < spec->soliton_count; i++)
            like = like || isfinite(unlike(spec, i, u[p], 0, 2 * near));
        if (like && (height_of(spec, 0) > 0 ? bead_kdv_is_crest(u, n, p) : is_trough(u, n, p)))
            crests[count++] = refine(kdv, p);
    }
    return count;
}

/* Find each soliton at the present time, assigning the most alike pairs of soliton and crest first, and each crest only once. Bit i
 * of the result: soliton i was seen. */
static unsigned follow(struct bead_kdv_solitons *s, const struct bead_kdv *kdv)
{
    const struct bead_equation_spec *spec = kdv->spec;
    struct bead_kdv_crest crests[MOST_CRESTS];
    const size_t count = find_crests(kdv, crests);
    bool taken[MOST_CRESTS] = {false};
    unsigned seen = 0;
    for (;;) {
        double least = INFINITY;
        size_t soliton = 0, crest = 0;
        for (size_t i = 0; i < spec->soliton_count; i++) {
            const double here = s->seen[i].crest.at + speed_of(spec, i) * (kdv->end.t - s->seen[i].t);
            for (size_t c = 0; c < count && !(seen & 1u << i); c++) {
                double found =
                    taken[c] ? INFINITY : unlike(spec, i, crests[c].height, wrap(crests[c].at - here, spec->length), near);
                if (found < least) {
                    least = found;
                    soliton = i;
                    crest = c;
                }
            }
        }
        if (isinf(least))
            return seen;
        const double here = s->seen[soliton].crest.at + speed_of(spec, soliton) * (kdv->end.t - s->seen[soliton].t);
        s->seen[soliton].crest.at = here + wrap(crests[crest].at - here, spec->length);
        s->seen[soliton].crest.height = crests[crest].height;
        s->seen[soliton].t = kdv->end.t;
        taken[crest] = true;
        seen |= 1u << soliton;
    }
}

void bead_kdv_solitons_begin(struct bead_kdv_solitons *s, const struct bead_equation_spec *spec)
{
    *s = (struct bead_kdv_solitons){.next = 0};
    for (size_t i = 0; i < spec->soliton_count; i++)
        s->seen[i].crest = (struct bead_kdv_crest){spec->solitons[i].at, height_of(spec, i)};
}

void bead_kdv_solitons_watch(struct bead_kdv_solitons *s, const struct bead_kdv *kdv)
{
    double fastest = 0;
    if (kdv->end.t < s->next)
        return;
    follow(s, kdv);
    for (size_t i = 0; i < kdv->spec->soliton_count; i++)
        fastest = fmax(fastest, fabs(speed_of(kdv->spec, i)));
    s->next = fastest > 0 ? kdv->end.t + look_part / (bead_kdv_sharpest(kdv->spec) * fastest) : INFINITY;
}

static size_t add(struct bead_measure *to, size_t n, size_t room, size_t soliton, const char *what, double value)
{
    char name[sizeof to->name];
    snprintf(name, sizeof name, "soliton %d: %s", (int)soliton + 1, what);
    return bead_measure_add(to, n, room, name, value);
}

size_t bead_kdv_soliton_measures(const struct bead_kdv_solitons *solitons, const struct bead_kdv *kdv, struct bead_measure *to,
                                 size_t n, size_t room)
{
    const struct bead_equation_spec *spec = kdv->spec;
    struct bead_kdv_solitons now = *solitons;
    const unsigned seen = follow(&now, kdv);
    for (size_t i = 0; i < spec->soliton_count; i++) {
        if (!(seen & 1u << i))
            continue;
        const double at = now.seen[i].crest.at, from = at - spec->low;
        n = add(to, n, room, i, "place", spec->low + from - spec->length * floor(from / spec->length));
        n = add(to, n, room, i, "amplitude", now.seen[i].crest.height);
        n = add(to, n, room, i, "shift from free motion", at - (spec->solitons[i].at + speed_of(spec, i) * kdv->end.t));
    }
    return n;
}
