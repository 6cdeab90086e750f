/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notes the largest forces in the parts of a run: see heights.h. */
#include "sim/run/heights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct bead_heights {
    size_t beads;
    bool of_beads;
    double length; /* s: of a part; 0: no step yet */
    float *part;   /* [BEAD_HEIGHT_PARTS][2: contacts, beads][beads], or [BEAD_HEIGHT_PARTS][beads], N */
};

static float *row(const struct bead_heights *h, size_t part, bool of_beads)
{
    return h->part + ((h->of_beads ? 2 : 1) * part + of_beads) * h->beads;
}

enum bead_error bead_heights_create(const struct bead_stepper *stepper, bool of_beads, struct bead_heights **heights,
                                    struct bead_message *msg)
{
    const size_t beads = stepper->beads;
    struct bead_heights *h = *heights = calloc(1, sizeof *h);
    if (h)
        *h = (struct bead_heights){beads, of_beads, 0, calloc((of_beads ? 2 : 1) * BEAD_HEIGHT_PARTS * beads, sizeof *h->part)};
    if (h && h->part)
        return BEAD_OK;
    bead_heights_destroy(h);
    *heights = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the heights of %zu beads", beads);
}

void bead_heights_destroy(struct bead_heights *heights)
{
    if (heights)
        free(heights->part);
    free(heights);
}

/* Joins parts in pairs. */
static void lengthen(struct bead_heights *h)
{
    const size_t size = (h->of_beads ? 2 : 1) * h->beads, half = BEAD_HEIGHT_PARTS / 2;
    for (size_t p = 0; p < half; p++) {
        float *to = row(h, p, false), *from = row(h, 2 * p, false);
        for (size_t i = 0; i < size; i++)
            to[i] = from[i] > from[size + i] ? from[i] : from[size + i];
    }
    memset(row(h, half, false), 0, half * size * sizeof *h->part);
    h->length *= 2;
}

/* Notes forces of contacts first..n-1. */
static void note_contacts(const struct bead_stepper *s, size_t n, float *restrict height)
{
    const double *restrict f = s->end.f, *restrict still = s->chain->static_force;
    for (size_t k = s->first; k < n; k++) {
        const float force = (float)(f[k] + still[k]);
        height[k] = force > height[k] ? force : height[k];
    }
}

/* Notes forces of beads first..n-1. */
static void note_beads(const struct bead_stepper *s, size_t n, float *height)
{
    for (size_t j = s->first; j < n; j++)
        height[j] = fmaxf(height[j], (float)bead_stepper_bead_force(s, &s->end, j));
}

void bead_heights_step(struct bead_heights *h, const struct bead_stepper *s)
{
    if (!(h->length > 0))
        h->length = s->h;
    while (s->t1 >= BEAD_HEIGHT_PARTS * h->length)
        lengthen(h);
    const size_t part = (size_t)(s->t1 / h->length);
    note_contacts(s, bead_stepper_contacts(s), row(h, part, false));
    if (h->of_beads)
        note_beads(s, s->active < s->beads ? s->active : s->beads, row(h, part, true));
}

double bead_heights_after(const struct bead_heights *h, bool of_bead, size_t index, double time, double not_before)
{
    double highest = 0;
    if (!(h->length > 0) || !(time < BEAD_HEIGHT_PARTS * h->length))
        return 0;
    size_t part = (size_t)(time / h->length);
    if ((double)part * h->length < not_before)
        part++;
    for (; part < BEAD_HEIGHT_PARTS; part++)
        highest = fmax(highest, row(h, part, of_bead)[index]);
    return highest;
}
