/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runge-Kutta-Nystrom methods for u'' = a(u), from a tableau.
 *
 * A long chain goes through the stages in tiles that the cache holds: stage i of a tile lies SKEW beads further left for each
 * stage, so that its right neighbours are known and the previous tile has made the left ones. Results are bit for bit
 * those of whole stages. */
#include "sim/integrate/stepper.h"
#include "sim/integrate/tableau.h"

enum { TILE = 512, SKEW = 8, LONG = 12288 };

struct terms {
    size_t count;
    double coefficient[BEAD_STAGES_MAX];
    const double *array[BEAD_STAGES_MAX];
};

/* The non-zero ones among scale * row[j], in order. */
static void gather(const struct bead_stepper *s, const double *row, size_t count, double scale, struct terms *terms)
{
    terms->count = 0;
    for (size_t j = 0; j < count; j++) {
        if (row[j] == 0)
            continue;
        terms->coefficient[terms->count] = scale * row[j];
        terms->array[terms->count++] = j == 0 ? s->start.a : s->stage_a[j];
    }
}

/* y = base + scale v + terms first.., in a part. */
static void sum(const struct bead_stepper *s, struct bead_part part, double *y, const double *base, double scale, const double *v,
                const struct terms *terms, size_t first)
{
    const double *at[BEAD_STAGES_MAX];
    for (size_t i = first; i < terms->count; i++)
        at[i] = terms->array[i] + part.from;
    s->kernels->combine(part.to - part.from, y + part.from, base + part.from, scale, v + part.from, terms->count - first,
                        terms->coefficient + first, at + first);
}

/* Stage i of a part; the last one is the end of the step. Displacements are needed for one more vector than forces. */
static void make_stage(struct bead_stepper *s, double h, size_t i, struct bead_part part)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages;
    const struct bead_part beads = {part.from, part.to + SKEW < s->span ? part.to + SKEW : s->span};
    struct terms terms;
    if (i < stages) {
        gather(s, t->a + i * t->stages, i, h * h, &terms);
        sum(s, beads, s->y, s->start.u, t->c[i] * h, s->start.v, &terms, 0);
        bead_stepper_evaluate_part(s, s->y, NULL, s->stage_f[i], s->stage_a[i], part);
        return;
    }
    gather(s, t->b, t->stages, h * h, &terms);
    sum(s, beads, s->end.u, s->start.u, h, s->start.v, &terms, 0);
    bead_stepper_evaluate_part(s, s->end.u, NULL, s->end.f, s->end.a, part);
    gather(s, t->bp, t->stages, h, &terms);
    for (size_t j = 0; j < terms.count; j++) {
        if (t->fsal && terms.array[j] == s->stage_a[t->stages - 1])
            terms.array[j] = s->end.a;
    }
    /* v has no drift of its own: the first term stands in for it. */
    sum(s, part, s->end.v, s->start.v, terms.coefficient[0], terms.array[0], &terms, 1);
}

void bead_step_nystrom(struct bead_stepper *s, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages, tile = s->span > LONG ? TILE : s->span + SKEW * stages;
    for (size_t p = 0; p < s->span + SKEW * stages; p += tile) {
        for (size_t i = 1; i <= stages; i++) {
            /* One tile is not skewed. */
            const size_t shift = tile == TILE ? SKEW * i : 0, from = p > shift ? p - shift : 0;
            const size_t end = p + tile > shift ? p + tile - shift : 0, to = end < s->span ? end : s->span;
            if (from < to)
                make_stage(s, h, i, (struct bead_part){from, to});
        }
    }
    s->evaluations += stages * s->active;
}
