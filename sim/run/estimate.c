/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates a step's error from the embedded method, for the outcome of a run. */
#include "sim/run/estimate.h"

#include <math.h>

#include "sim/integrate/events.h"
#include "sim/integrate/tableau.h"

/* Contacts this near to one that opens or closes are integrated again with it. */
enum { NEAR = 2 };

/* The accelerations that count, and how much. */
struct terms {
    size_t count;
    double coefficient[BEAD_STAGES_MAX];
    const double *array[BEAD_STAGES_MAX];
};

static struct terms gather(const struct bead_stepper *s, const struct bead_tableau *t)
{
    struct terms terms = {.count = 0};
    for (size_t i = 0; i < t->stages; i++) {
        const bool last = t->fsal && i + 1 == t->stages;
        if (t->bpe[i] == 0)
            continue;
        terms.coefficient[terms.count] = t->bpe[i];
        terms.array[terms.count++] = i == 0 ? s->start.a : last ? s->end.a : s->stage_a[i];
    }
    return terms;
}

static double difference(const struct bead_stepper *s, const struct terms *terms, size_t bead)
{
    double sum = 0;
    for (size_t i = 0; i < terms->count; i++)
        sum += terms->coefficient[i] * terms->array[i][bead];
    return s->h * sum;
}

double bead_estimate_embedded(const struct bead_stepper *s)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t *flagged = NULL;
    size_t count = 0, next = 0;
    double worst = 0;
    if (!t)
        return 0;
    const struct terms terms = gather(s, t);
    if (s->events)
        flagged = bead_events_flagged(s->events, &count);
    for (size_t j = 0; j < s->active; j++) {
        while (next < count && flagged[next] + NEAR + 1 < j)
            next++;
        if (next < count && flagged[next] <= j + NEAR)
            continue;
        worst = fmax(worst, fabs(difference(s, &terms, j)));
    }
    return worst;
}
