/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heights of a stack of plots: what headings and axes leave is divided among the views. Layouts of stills and movies start here. */
#include "render/view/stack.h"

#include <math.h>
#include <stdbool.h>

/* From the bottom of what is above to the top of a plot. A heading takes the room above the first plot anyway. */
static double above_plot(const struct bead_stack *s, size_t row, size_t view)
{
    double reach = ceil(s->reach[row * s->views + view].above);
    return view > 0 ? reach + s->between_views : fmax(s->heading, reach);
}

double bead_stack_fixed(const struct bead_stack *s)
{
    double height = (double)(s->rows - 1) * s->between_rows;
    for (size_t i = 0; i < s->rows * s->views; i++)
        height += above_plot(s, i / s->views, i % s->views) + ceil(s->reach[i].below);
    return height;
}

/* What remains of the room, and of the shares, for the views without a height of their own. */
static double remaining(const struct bead_stack *s, const bool *settled, double room, double *shares)
{
    *shares = 0;
    for (size_t v = 0; v < s->views; v++) {
        *shares += settled[v] ? 0 : s->share[v];
        room -= settled[v] ? s->height[v] : 0;
    }
    return fmax(0, room);
}

/* Gives the views that would get less than is promised, or else those that would get more than they can use, that much: true if
 * there was one. */
static bool settle(struct bead_stack *s, bool *settled, double room, bool promises)
{
    double shares, left = remaining(s, settled, room, &shares);
    bool any = false;
    for (size_t v = 0; v < s->views; v++) {
        double part = left * s->share[v] / shares;
        if (settled[v] || (promises ? part >= s->least[v] : floor(part) <= s->most[v]))
            continue;
        settled[v] = any = true;
        s->height[v] = (int)(promises ? ceil(s->least[v]) : floor(s->most[v]));
    }
    return any;
}

int bead_stack_divide(struct bead_stack *s, double room)
{
    bool settled[BEAD_STACK_VIEWS] = {false};
    while (settle(s, settled, room, true) || settle(s, settled, room, false))
        ;
    double shares, left = remaining(s, settled, room, &shares);
    int used = 0;
    for (size_t v = 0; v < s->views; v++) {
        s->height[v] = settled[v] ? s->height[v] : (int)floor(left * s->share[v] / shares);
        used += s->height[v];
    }
    return used;
}

double bead_stack_row(const struct bead_stack *s, size_t row, double y, struct bead_stack_places *places)
{
    places->heading = (int)y;
    for (size_t v = 0; v < s->views; v++) {
        y += above_plot(s, row, v);
        places->plot[v] = (int)y;
        y += s->height[v] + ceil(s->reach[row * s->views + v].below);
    }
    return y;
}
