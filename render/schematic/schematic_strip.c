/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of beads: grows them, and finds the place of each bead. */
#include "render/schematic/schematic_strip.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

static bool add_one(struct bead_strip *strip, struct bead_strip_bead bead)
{
    strip->failed |= !bead_memory_grow((void **)&strip->beads, &strip->room, strip->count + 1, sizeof bead);
    if (!strip->failed)
        strip->beads[strip->count++] = bead;
    return !strip->failed;
}

bool bead_strip_add_gap(struct bead_strip *strip, size_t mark)
{
    return add_one(strip, (struct bead_strip_bead){.left_out = true, .mark = mark});
}

bool bead_strip_add(struct bead_strip *strip, const size_t *material, ptrdiff_t step, size_t count, size_t lead, size_t tail,
                    size_t mark)
{
    bool whole = count <= lead + tail + 1, added = true;
    for (size_t i = 0; i < count && added; i++) {
        added = add_one(strip, (struct bead_strip_bead){.material = material[(ptrdiff_t)i * step], .mark = mark});
        if (added && !whole && i + 1 == lead) {
            added = bead_strip_add_gap(strip, mark);
            i = count - tail - 1;
        }
    }
    return added;
}

void bead_strip_free(struct bead_strip *strip)
{
    free(strip->beads);
    *strip = (struct bead_strip){0};
}

double bead_strip_width(const struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap)
{
    double width = 0;
    for (size_t i = 0; i < strip->count; i++)
        width += strip->beads[i].left_out ? gap : 2 * scale * scene->materials[strip->beads[i].material].radius;
    return width;
}

void bead_strip_place(struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap, double x)
{
    for (size_t i = 0; i < strip->count; i++) {
        struct bead_strip_bead *b = &strip->beads[i];
        b->r = b->left_out ? gap / 2 : scale * scene->materials[b->material].radius;
        b->x = x + b->r;
        x += 2 * b->r;
    }
}

bool bead_strip_extent(const struct bead_strip *strip, size_t mark, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < strip->count; i++) {
        const struct bead_strip_bead *b = &strip->beads[i];
        if (b->mark == mark) {
            *low = fmin(*low, b->x - b->r);
            *high = fmax(*high, b->x + b->r);
        }
    }
    return *low < *high;
}
