/* Runge-Kutta-Nystrom methods for u'' = a(u), from a tableau. */
#include "sim/stepper.h"
#include "sim/tableau.h"

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

static void sum(const struct bead_stepper *s, double *y, const double *base, double scale, const double *v,
                const struct terms *terms)
{
    s->kernels->combine(s->span, y, base, scale, v, terms->count, terms->coefficient, terms->array);
}

void bead_step_nystrom(struct bead_stepper *s, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    const double square = h * h;
    size_t stages = t->fsal ? t->stages - 1 : t->stages;
    struct terms terms;

    for (size_t i = 1; i < stages; i++) {
        gather(s, t->a + i * t->stages, i, square, &terms);
        sum(s, s->y, s->start.u, t->c[i] * h, s->start.v, &terms);
        bead_stepper_evaluate(s, s->y, NULL, s->stage_f[i], s->stage_a[i]);
    }
    gather(s, t->b, t->stages, square, &terms);
    sum(s, s->end.u, s->start.u, h, s->start.v, &terms);
    bead_stepper_evaluate(s, s->end.u, NULL, s->end.f, s->end.a);
    gather(s, t->bp, t->stages, h, &terms);
    for (size_t i = 0; i < terms.count; i++) {
        if (t->fsal && terms.array[i] == s->stage_a[t->stages - 1])
            terms.array[i] = s->end.a;
    }
    /* v has no drift of its own: the first term stands in for it. */
    s->kernels->combine(s->span, s->end.v, s->start.v, terms.coefficient[0], terms.array[0], terms.count - 1, terms.coefficient + 1,
                        terms.array + 1);
}
