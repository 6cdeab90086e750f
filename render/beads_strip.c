/* More beads than pixels: each column of the row shows the mean colour of the beads in it, over the background where they leave
 * gaps. */
#include <math.h>
#include <string.h>

#include "render/beads.h"

struct column {
    double cover, rgb[3];
};

/* The part of bead `i` (a block as wide as its diameter) in column x. */
static void add_bead(const struct bead_view *v, size_t i, int x, double left, double right, struct column *column)
{
    double part = fmin(right, x + 1.0) - fmax(left, x);
    if (part <= 0)
        return;
    column->cover += part;
    for (int c = 0; c < 3; c++)
        column->rgb[c] += part * v->colour[i][c];
}

static void paint_pixel(uint8_t *pixel, const uint8_t *behind, const struct column *column)
{
    double cover = fmin(column->cover, 1), scale = column->cover > 0 ? cover / column->cover : 0;
    for (int c = 0; c < 3; c++)
        pixel[c] = (uint8_t)lround((1 - cover) * behind[c] + scale * column->rgb[2 - c]);
    pixel[3] = 255;
}

/* True where column x of the frame looks different now. */
static bool paint_column(const struct bead_view *v, int x, const struct column *column, struct bead_frame *frame,
                         const struct bead_frame *background)
{
    int top = v->area.y + v->row.rect.y, bottom = top + v->row.rect.height;
    bool changed = false;
    for (int y = top; y < bottom; y++) {
        size_t at = (size_t)y * frame->stride + 4 * (size_t)x;
        uint8_t pixel[4];
        paint_pixel(pixel, background->pixels + at, column);
        changed = changed || memcmp(pixel, frame->pixels + at, 3) != 0;
        memcpy(frame->pixels + at, pixel, 4);
    }
    return changed;
}

void bead_beads_strip(struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                      struct bead_changes *changes)
{
    int from = frame->width, to = -1;
    size_t next = 0;
    int left = v->plot.x, right = v->plot.x + v->plot.width;
    for (int x = left; x < right; x++) {
        struct column column = {0, {0, 0, 0}};
        double local = x - v->area.x;
        for (size_t i = next; i < v->count; i++) {
            double middle = bead_window_x(&v->row, v->position[i] + v->shift[i]), r = v->radius[i] * v->row.scale;
            if (middle - r > local + 1)
                break;
            if (i == next && middle + r < local)
                next++;
            add_bead(v, i, (int)local, middle - r, middle + r, &column);
        }
        if (paint_column(v, x, &column, frame, background)) {
            from = x < from ? x : from;
            to = x;
        }
    }
    if (to >= from)
        bead_changes_add(changes, (struct bead_rect){from, v->area.y + v->row.rect.y, to - from + 1, v->row.rect.height});
}
