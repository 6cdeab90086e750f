/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Labels that move with the camera, below profiles and above rows of beads: masks shifted by parts of a pixel. */
#include "render/stage/moving_labels.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

static const double steps_per_pixel = 16;
/* In units of the tick font's size; the first three as for axes that do not move. */
static const double tick_length = 0.38, label_gap = 0.3, digit_height = 0.7, fade = 1, apart = 0.5, pointer = 0.3,
                    digit_width = 0.6;

/* The coverage mask of one label's text, drawn when it is first visible. */
struct mask {
    cairo_surface_t *surface; /* A8; NULL: not yet */
    int width, height;
    double text; /* px: width of the text */
};

struct label {
    double place, width; /* m; px reserved for it */
    char markup[200];
    struct bead_rgb colour;
    enum bead_label_sign sign;
    struct mask mask;
};

struct bead_moving_labels {
    struct bead_look look;
    struct bead_rect strip;
    double scale;
    struct label *label;
    size_t count, room;
    double shown; /* m: left edge */
    bool drawn;
};

enum bead_error bead_moving_labels_create(const struct bead_look *look, struct bead_rect strip, double scale,
                                          struct bead_moving_labels **labels, struct bead_message *msg)
{
    BEAD_TRY(bead_new(labels, 1, msg, "labels"));
    struct bead_moving_labels *l = *labels;
    l->look = *look;
    l->strip = strip;
    l->scale = scale;
    return BEAD_OK;
}

void bead_moving_labels_destroy(struct bead_moving_labels *l)
{
    if (!l)
        return;
    for (size_t i = 0; i < l->count; i++)
        cairo_surface_destroy(l->label[i].mask.surface);
    free(l->label);
    free(l);
}

static struct bead_text_style labels_style_of(const struct bead_moving_labels *l)
{
    return (struct bead_text_style){.family = l->look.family,
                                    .size = l->look.tick,
                                    .colour = {1, 1, 1},
                                    .across = BEAD_ALIGN_START,
                                    .down = BEAD_ALIGN_BASELINE};
}

static bool is_free(const struct bead_moving_labels *l, size_t count, double place, double width)
{
    for (size_t i = 0; i < count; i++) {
        double distance = fabs(place - l->label[i].place) * l->scale;
        if (distance < 0.5 * (width + l->label[i].width) + apart * l->look.tick)
            return false;
    }
    return true;
}

/* Adds a label unless one of the first `before` labels is in the way. */
static enum bead_error labels_add(struct bead_moving_labels *l, size_t before, double place, double width, const char *markup,
                                  struct bead_rgb colour, enum bead_label_sign sign, struct bead_message *msg)
{
    if (!is_free(l, before, place, width))
        return BEAD_OK;
    if (!bead_memory_grow((void **)&l->label, &l->room, l->count + 1, sizeof *l->label))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for labels");
    struct label *label = &l->label[l->count++];
    *label = (struct label){.place = place, .width = width, .colour = colour, .sign = sign};
    snprintf(label->markup, sizeof label->markup, "%s", markup);
    return BEAD_OK;
}

enum bead_error bead_moving_labels_add(struct bead_moving_labels *l, double place, const char *markup, struct bead_rgb colour,
                                       enum bead_label_sign sign, struct bead_message *msg)
{
    struct bead_text_style style = labels_style_of(l);
    double width, height;
    bead_text_size(NULL, &style, markup, &width, &height);
    return labels_add(l, l->count, place, width, markup, colour, sign, msg);
}

enum bead_error bead_moving_labels_count(struct bead_moving_labels *l, const double *place, size_t first, size_t count,
                                         double width, enum bead_label_sign sign, struct bead_message *msg)
{
    struct bead_axis axis;
    double spacing = count > 1 ? (place[count - 1] - place[0]) / (double)(count - 1) : width;
    double beads = spacing > 0 ? width / spacing : 1, high = (double)(first + count);
    /* The last number is the widest and sets the step, as on an axis. */
    bead_axis_make(&axis, high - beads, high, "", BEAD_SCALE_LINEAR, l->strip.width, l->look.tick, true);
    size_t step = axis.count > 1 ? (size_t)lround(axis.ticks[1].value - axis.ticks[0].value) : (size_t)ceil(beads),
           names = l->count;
    step = step > 0 ? step : 1;
    for (size_t bead = (first + step - 1) / step * step; bead < first + count; bead += step) {
        char number[32];
        int digits = snprintf(number, sizeof number, "%zu", bead);
        BEAD_TRY(labels_add(l, names, place[bead - first], digit_width * l->look.tick * digits, number,
                            sign == BEAD_LABEL_TICK ? l->look.ink : l->look.faint, sign, msg));
    }
    return BEAD_OK;
}

static enum bead_error make_mask(const struct bead_moving_labels *l, struct label *label, struct bead_message *msg)
{
    struct mask *m = &label->mask;
    struct bead_text_style style = labels_style_of(l);
    double height;
    bead_text_size(NULL, &style, label->markup, &m->text, &height);
    m->width = (int)ceil(m->text) + 2;
    m->height = (int)ceil(1.3 * l->look.tick);
    m->surface = cairo_image_surface_create(CAIRO_FORMAT_A8, m->width, m->height);
    cairo_t *cr = cairo_create(m->surface);
    bead_text_draw(cr, &style, 1, round(l->look.tick), label->markup);
    cairo_status_t status = cairo_status(cr);
    cairo_destroy(cr);
    cairo_surface_flush(m->surface);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "label of an axis: %s", cairo_status_to_string(status)) : BEAD_OK;
}

/* Blends a colour over one pixel of the strip. */
static void blend(const struct bead_moving_labels *l, struct bead_frame *frame, int x, int y, struct bead_rgb colour, double alpha)
{
    if (alpha <= 0 || x < 0 || y < 0 || x >= l->strip.width || y >= l->strip.height)
        return;
    uint8_t *p = frame->pixels + (size_t)(l->strip.y + y) * frame->stride + 4 * (size_t)(l->strip.x + x);
    const double bgra[4] = {colour.b, colour.g, colour.r, 1};
    for (int c = 0; c < 4; c++)
        p[c] = (uint8_t)lround(p[c] + alpha * (255 * bgra[c] - p[c]));
}

/* Draws the mask shifted to x by linear interpolation; row y of the strip is its top. */
static void draw_mask(const struct bead_moving_labels *l, const struct label *label, double x, int y, double alpha,
                      struct bead_frame *frame)
{
    const struct mask *m = &label->mask;
    const unsigned char *data = cairo_image_surface_get_data(m->surface);
    int stride = cairo_image_surface_get_stride(m->surface), whole = (int)floor(x);
    double part = x - whole;
    for (int row = 0; row < m->height; row++) {
        const unsigned char *line = data + (ptrdiff_t)row * stride;
        for (int i = 0; i <= m->width; i++) {
            double here = i < m->width ? line[i] : 0, left = i > 0 ? line[i - 1] : 0;
            blend(l, frame, whole + i, y + row, label->colour, alpha * ((1 - part) * here + part * left) / 255);
        }
    }
}

/* Draws a line downwards, or a triangle that points down, with its middle at x. */
static void draw_sign(const struct bead_moving_labels *l, enum bead_label_sign sign, double x, double alpha, struct bead_rgb colour,
                      struct bead_frame *frame)
{
    double em = l->look.tick, height = sign == BEAD_LABEL_TICK ? round(tick_length * em) : round(1.3 * pointer * em);
    int top = sign == BEAD_LABEL_TICK ? 0 : l->strip.height - (int)height;
    for (int y = 0; y < (int)height; y++) {
        double half = sign == BEAD_LABEL_TICK ? 0.5 * l->look.line : pointer * em * (1 - (y + 0.5) / height);
        for (int i = (int)floor(x - half); i <= (int)floor(x + half); i++)
            blend(l, frame, i, top + y, colour, alpha * fmax(0, fmin(i + 1, x + half) - fmax(i, x - half)));
    }
}

/* Opaque until it is near an end of the strip, transparent before it would be cut. */
static double opacity(const struct bead_moving_labels *l, const struct label *label, double x)
{
    double half = 0.5 * label->width + 1, room = fmin(x - half, l->strip.width - x - half);
    return fmax(0, fmin(1, room / (fade * l->look.tick)));
}

enum bead_error bead_moving_labels_draw(struct bead_moving_labels *l, double left, struct bead_frame *frame,
                                        const struct bead_frame *background, struct bead_changes *changes, struct bead_message *msg)
{
    double em = l->look.tick, tick = round(tick_length * em);
    if (l->drawn && changes && left == l->shown)
        return BEAD_OK;
    bead_frame_copy(frame, background, l->strip);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < l->count; i++) {
        struct label *label = &l->label[i];
        double x = round((label->place - left) * l->scale * steps_per_pixel) / steps_per_pixel;
        double alpha = opacity(l, label, x);
        if (alpha <= 0)
            continue;
        if (!label->mask.surface)
            err = make_mask(l, label, msg);
        if (err)
            break;
        bool below = label->sign == BEAD_LABEL_TICK;
        int baseline = below ? (int)round(tick + (label_gap + digit_height) * em) : (int)round(0.95 * em);
        if (label->sign != BEAD_LABEL_PLAIN)
            draw_sign(l, label->sign, x, alpha, below ? l->look.axis : label->colour, frame);
        draw_mask(l, label, x - 0.5 * label->mask.text - 1, baseline - (int)round(em), alpha, frame);
    }
    if (changes)
        bead_changes_add(changes, l->strip);
    l->shown = left;
    l->drawn = true;
    return err;
}
