/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runge-Kutta-Nystrom methods for u'' = a(u), from a tableau.
 *
 * A long chain is stepped in tiles that fit in the cache: each stage of a tile is shifted SKEW beads to the left of the stage
 * before, so that its right neighbours are known and the previous tile has computed the left ones. Results are equal to those of
 * whole stages, bit for bit. */
#include <math.h>

#include "sim/integrate/events.h"
#include "sim/integrate/stepper.h"
#include "sim/integrate/tableau.h"

enum { TILE = 512, SKEW = 8, LONG = 12288 };

/* Accelerations at the stages, for a sum with coefficients: the non-zero ones among scale * row[i], in order. */
struct terms {
    size_t count;
    double coefficient[BEAD_STAGES_MAX];
    const double *array[BEAD_STAGES_MAX];
};

static struct terms gather(const struct bead_stepper *s, const double *row, size_t count, double scale)
{
    const struct bead_tableau *t = s->method->tableau;
    struct terms terms = {.count = 0};
    for (size_t i = 0; i < count; i++) {
        if (row[i] == 0)
            continue;
        terms.coefficient[terms.count] = scale * row[i];
        terms.array[terms.count++] = i == 0 ? s->start.a : t->fsal && i + 1 == t->stages ? s->end.a : s->stage_a[i];
    }
    return terms;
}

/* y = base + scale v + the terms from `first` on, in a part. */
static void sum(const struct bead_stepper *s, struct bead_part part, double *y, const double *base, double scale, const double *v,
                const struct terms *terms, size_t first)
{
    const double *at[BEAD_STAGES_MAX];
    for (size_t i = first; i < terms->count; i++)
        at[i] = terms->array[i] + part.from;
    s->kernels->combine(part.to - part.from, y + part.from, base + part.from, scale, v + part.from, terms->count - first,
                        terms->coefficient + first, at + first);
}

/* Stage i of a part; the last stage is the end of the step. Displacements are needed for one more vector than forces. */
static void make_stage(struct bead_stepper *s, double h, size_t i, struct bead_part part)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages;
    const struct bead_part beads = {part.from, part.to + SKEW < s->span ? part.to + SKEW : s->span};
    struct terms terms;
    if (i < stages) {
        terms = gather(s, t->a + i * t->stages, i, h * h);
        sum(s, beads, s->y, s->start.u, t->c[i] * h, s->start.v, &terms, 0);
        bead_stepper_evaluate_part(s, s->y, NULL, s->stage_f[i], s->stage_a[i], part);
        return;
    }
    terms = gather(s, t->b, t->stages, h * h);
    sum(s, beads, s->end.u, s->start.u, h, s->start.v, &terms, 0);
    bead_stepper_evaluate_part(s, s->end.u, NULL, s->end.f, s->end.a, part);
    terms = gather(s, t->bp, t->stages, h);
    /* v has no drift: the first term takes its place. */
    sum(s, part, s->end.v, s->start.v, terms.coefficient[0], terms.array[0], &terms, 1);
}

void bead_step_nystrom(struct bead_stepper *s, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages, tile = s->span > LONG ? TILE : s->span + SKEW * stages;
    for (size_t p = s->first; p < s->span + SKEW * stages; p += tile) {
        for (size_t i = 1; i <= stages; i++) {
            /* a single tile is not skewed */
            const size_t shift = tile == TILE ? SKEW * i : 0, from = p > s->first + shift ? p - shift : s->first;
            const size_t end = p + tile > shift ? p + tile - shift : 0, to = end < s->span ? end : s->span;
            if (from < to)
                make_stage(s, h, i, (struct bead_part){from, to});
        }
    }
    s->evaluations += stages * (s->active - s->first);
}

/* Contacts this near to one that opens or closes are integrated again with it. */
enum { NEAR = 2 };

static double embedded_difference(const struct bead_stepper *s, const struct terms *terms, size_t bead)
{
    double sum = 0;
    for (size_t i = 0; i < terms->count; i++)
        sum += terms->coefficient[i] * terms->array[i][bead];
    return s->h * sum;
}

double bead_nystrom_error(const struct bead_stepper *s)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t *flagged = NULL;
    size_t count = 0, next = 0;
    double worst = 0;
    if (!t)
        return 0;
    const struct terms terms = gather(s, t->bpe, t->stages, 1);
    if (s->events)
        flagged = bead_events_flagged(s->events, &count);
    for (size_t j = s->first; j < s->active; j++) {
        while (next < count && flagged[next] + NEAR + 1 < j)
            next++;
        if (next < count && flagged[next] <= j + NEAR)
            continue;
        worst = fmax(worst, fabs(embedded_difference(s, &terms, j)));
    }
    return worst;
}
