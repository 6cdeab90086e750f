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

int bead_stack_divide(struct bead_stack *s, double room)
{
    bool limited[BEAD_STACK_VIEWS] = {false};
    for (bool again = true; again;) {
        double shares = 0, left = room;
        again = false;
        for (size_t v = 0; v < s->views; v++) {
            shares += limited[v] ? 0 : s->share[v];
            left -= limited[v] ? s->height[v] : 0;
        }
        for (size_t v = 0; v < s->views; v++) {
            double part = left * s->share[v] / shares;
            if (limited[v])
                continue;
            limited[v] = floor(part) > s->most[v];
            again = again || limited[v];
            s->height[v] = (int)floor(limited[v] ? s->most[v] : part);
        }
    }
    int used = 0;
    for (size_t v = 0; v < s->views; v++)
        used += s->height[v];
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
