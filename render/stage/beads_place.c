/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places the row of beads and the lens, and draws names, wall and the lens's frame around them once for each picture. */
#include <math.h>
#include <stdio.h>

#include "render/draw/looks.h"
#include "render/draw/words.h"
#include "render/stage/along.h"
#include "render/stage/beads.h"
#include "render/stage/panel.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

/* Rows of smaller beads are drawn as a strip, px of diameter. */
static const double strip_below = 3;
/* Beads in the lens: their part of its height, and their least number side by side. */
static const double large_share = 0.8, most_across = 14;
/* The largest part of a row's height for its beads; height of the names above it, in units of the ticks' font size. */
static const double row_share = 0.9, names_height = 1.35;

void bead_beads_margins(const struct bead_look *look, int *left, int *right)
{
    *left = (int)ceil(2.6 * look->tick);
    *right = (int)ceil(1.3 * look->gap);
}

/* The diameter of the largest bead shown, in units of the row's length. */
static double largest_part(const struct bead_view_setup *setup)
{
    const double *place = bead_chain_position(setup->chain), *radius = bead_chain_radius(setup->chain);
    size_t first = setup->beads.first, last = setup->beads.last;
    double largest = 0;
    for (size_t i = first; i <= last; i++)
        largest = fmax(largest, radius[i]);
    if (!bead_chain_spec(setup->chain)->system->has_contacts)
        return 2 * largest / (bead_along_border(setup, last + 1) - bead_along_border(setup, first));
    return 2 * largest / (place[last] + radius[last] - place[first] + radius[first]);
}

double bead_beads_most_width(const struct bead_view_setup *setup, double height)
{
    return row_share * (height - names_height * setup->look->tick) / largest_part(setup);
}

double bead_beads_most_height(const struct bead_view_setup *setup, double width)
{
    const struct bead_look *look = setup->look;
    double names = names_height * look->tick, diameter = width * largest_part(setup);
    double row = fmax(0.9 * look->tick, diameter + fmax(4, 0.9 * diameter));
    if (diameter >= 1.25 * look->label)
        return ceil(names + fmax(row, 3 * look->tick));
    return ceil(names + row + 1.2 * look->gap + width / (large_share * most_across));
}

static void set_window(struct bead_window *w, const struct bead_view *v, double scale, double y, double height, bool wide)
{
    int x = wide ? 0 : v->plot.x - v->area.x, width = wide ? v->area.width : v->plot.width;
    double top = floor(y), bottom = floor(y + height);
    *w = (struct bead_window){.rect = {x, (int)top, width, (int)(bottom - top)}, .scale = scale, .middle = 0.5 * (top + bottom)};
}

/* One row, as large as fits; centred if the height limits it. */
static void only_row(struct bead_view *v, double scale, double top)
{
    double height = v->plot.height - top, length = v->ends[1] - v->ends[0];
    double fitting = fmin(scale, row_share * height / (2 * v->largest));
    set_window(&v->row, v, fitting, top, height, true);
    v->row.left = v->plot.x - v->area.x + 0.5 * (v->plot.width - length * fitting);
    v->row.from = v->ends[0];
}

/* The name of a sensor as markup; false: its bead is not shown. */
static bool sensor_name(const struct bead_view *v, const struct bead_sensor *sensor, char markup[160])
{
    char plain[64];
    snprintf(plain, sizeof plain, "%.40s", sensor->name);
    bead_text_escape(plain, markup, 160);
    return sensor->bead >= v->first && sensor->bead < v->first + v->count;
}

/* Do names fit above the row? Sensors need little room, others plenty. */
static bool has_names(const struct bead_view *v)
{
    size_t count, shown = 0;
    char name[160];
    const struct bead_sensor *sensors = bead_chain_sensors(v->setup.chain, &count);
    for (size_t i = 0; i < count; i++)
        shown += sensor_name(v, &sensors[i], name);
    if (v->setup.camera && shown == 0 && !v->setup.bead_labels)
        return false;
    return v->setup.axes && v->plot.height > (shown > 0 || v->setup.bead_labels ? 2.6 : 8.5) * v->look.tick;
}

/* The camera's window takes all room below the names. */
static void only_camera(struct bead_view *v, double top)
{
    double width = bead_camera_width(v->setup.camera);
    v->row = (struct bead_window){.scale = 0};
    v->strip = false;
    set_window(&v->lens, v, v->plot.width / width, top, v->plot.height - top, false);
    v->lens.left = v->lens.rect.x;
    v->lens.from = v->ends[0];
}

enum bead_error bead_beads_divide(struct bead_view *v, struct bead_message *msg)
{
    const struct bead_look *look = &v->look;
    double length = v->ends[1] - v->ends[0], scale = v->plot.width / length, diameter = 2 * v->largest * scale;
    double top = has_names(v) ? round(names_height * look->tick) : 0;
    v->label_y = top > 0 ? 0.95 * look->tick : -1;
    if (v->setup.camera) {
        only_camera(v, top);
        return BEAD_OK;
    }
    v->strip = diameter < strip_below;
    v->lens = (struct bead_window){.scale = 0};
    double row = v->strip ? fmax(8, 0.9 * look->tick) : ceil(diameter + fmax(4, 0.9 * diameter)), zoom = round(1.2 * look->gap);
    /* Only waves in beads at rest, started by a striker, have a front to follow. */
    double height = v->plot.height - top - row - zoom, large = fmin(large_share * height, v->plot.width / most_across);
    bool worth = bead_chain_spec(v->setup.chain)->system->has_striker && large > fmax(14, 1.7 * diameter) &&
                 v->plot.width / large < 0.8 * (double)v->count;
    if (diameter >= 1.25 * look->label || !worth) {
        only_row(v, scale, top);
        row = fmin(2.2 * row, v->row.rect.height);
        v->row.rect.height = v->strip ? (int)row : v->row.rect.height;
        v->row.middle = v->strip ? v->row.rect.y + 0.5 * row : v->row.middle;
        return BEAD_OK;
    }
    set_window(&v->row, v, scale, top, row, true);
    v->row.left = v->plot.x - v->area.x;
    v->row.from = v->ends[0];
    v->zoom = (struct bead_rect){v->plot.x - v->area.x, v->row.rect.y + v->row.rect.height, v->plot.width, (int)zoom};
    set_window(&v->lens, v, large / (2 * v->largest), v->zoom.y + v->zoom.height, large / large_share, false);
    int line = (int)look->line; /* of its frame, which is drawn once */
    v->lens.rect = (struct bead_rect){v->lens.rect.x + line, v->lens.rect.y + line, v->lens.rect.width - 2 * line,
                                      v->lens.rect.height - 2 * line};
    v->lens.left = v->lens.rect.x;
    v->lens.from = v->ends[0];
    return bead_camera_create(v->setup.chain, (struct bead_span){v->first, v->first + v->count - 1},
                              v->lens.rect.width / v->lens.scale, v->setup.time, &v->camera, msg);
}

static void beads_set_colour(cairo_t *cr, struct bead_rgb c, double alpha)
{
    cairo_set_source_rgba(cr, c.r, c.g, c.b, alpha);
}

static void beads_draw_wall(const struct bead_view *v, cairo_t *cr)
{
    const struct bead_chain_spec *spec = bead_chain_spec(v->setup.chain);
    double r = fmax(v->largest * v->row.scale, 3), x = v->area.x + bead_window_x(&v->row, v->ends[1]);
    double half = v->strip ? 0.5 * v->row.rect.height : fmin(1.9 * r, 0.5 * v->row.rect.height),
           y = v->area.y + v->row.middle - half;
    double width = fmin(v->area.x + v->area.width - x, fmax(4, v->look.gap));
    cairo_rectangle(cr, x, y, width, 2 * half);
    if (spec->wall == BEAD_WALL_MATERIAL) {
        const double *own = bead_chain_scene(v->setup.chain)->materials[spec->wall_material].colour;
        cairo_set_source_rgb(cr, own[0], own[1], own[2]);
        cairo_fill(cr);
        return;
    }
    beads_set_colour(cr, v->look.faint, 0.35);
    cairo_fill(cr);
    cairo_save(cr);
    cairo_rectangle(cr, x, y, width, 2 * half);
    cairo_clip(cr);
    beads_set_colour(cr, v->look.faint, 1);
    cairo_set_line_width(cr, v->look.line);
    for (double d = 0; d < 2 * half + width; d += fmax(4, 0.3 * v->look.gap)) {
        cairo_move_to(cr, x, y + d);
        cairo_line_to(cr, x + width, y + d - width);
    }
    cairo_stroke(cr);
    cairo_restore(cr);
}

/* Names above the row; a name that would overlap an earlier one is left out. */
struct names {
    cairo_t *cr;
    const struct bead_view *v;
    double taken[40][2];
    size_t count;
};

static void add_name(struct names *names, double x, const char *markup, enum bead_align across, struct bead_rgb colour)
{
    const struct bead_view *v = names->v;
    struct bead_text_style style = {v->look.family, 0.92 * v->look.tick, colour, false, across, BEAD_ALIGN_BASELINE, false};
    double width, height, gap = 0.6 * v->look.gap;
    bead_text_size(names->cr, &style, markup, &width, &height);
    double from = across == BEAD_ALIGN_START ? x : across == BEAD_ALIGN_MIDDLE ? x - 0.5 * width : x - width;
    bool free = from >= v->area.x && from + width <= v->area.x + v->area.width;
    for (size_t i = 0; i < names->count; i++)
        free = free && (from + width + gap < names->taken[i][0] || from - gap > names->taken[i][1]);
    if (!free || names->count == sizeof names->taken / sizeof names->taken[0])
        return;
    names->taken[names->count][0] = from;
    names->taken[names->count++][1] = from + width;
    bead_text_draw(names->cr, &style, x, v->area.y + v->label_y, markup);
}

static void name_sensors(struct names *names)
{
    const struct bead_view *v = names->v;
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(v->setup.chain, &count);
    for (size_t i = 0; i < count; i++) {
        char markup[160];
        if (!sensor_name(v, &sensors[i], markup))
            continue;
        double x = v->area.x + bead_window_x(&v->row, v->position[sensors[i].bead - v->first]), y = v->area.y + v->label_y;
        double em = 0.3 * v->look.tick;
        beads_set_colour(names->cr, v->look.ink, 1);
        cairo_move_to(names->cr, x - em, y + 0.2 * em);
        cairo_line_to(names->cr, x + em, y + 0.2 * em);
        cairo_line_to(names->cr, x, y + 1.5 * em);
        cairo_fill(names->cr);
        add_name(names, x, markup, BEAD_ALIGN_MIDDLE, v->look.ink);
    }
}

static void wall_name(const struct bead_view *v, char markup[200])
{
    char text[96];
    bead_wall_name(v->setup.chain, text, sizeof text);
    bead_text_escape(text, markup, 200);
}

static void name_ends(struct names *names)
{
    const struct bead_view *v = names->v;
    if (v->striker)
        add_name(names, v->area.x + bead_window_x(&v->row, v->ends[0]), "striker", BEAD_ALIGN_START, v->look.faint);
    if (!v->wall)
        return;
    char markup[200];
    wall_name(v, markup);
    add_name(names, v->area.x + bead_window_x(&v->row, v->ends[1]), markup, BEAD_ALIGN_END, v->look.faint);
}

static void name_numbers(struct names *names)
{
    const struct bead_view *v = names->v;
    const struct bead_chain_axis along = bead_chain_axis(v->setup.chain, false);
    struct bead_axis axis;
    bead_axis_along_chain(&axis, v->setup.chain, false, v->first, v->first + v->count - 1, v->plot.width, v->look.tick, true);
    for (size_t i = 0; i < axis.count; i++) {
        double bead = (axis.ticks[i].value - along.first) / along.spacing - (double)v->first;
        if (bead >= 0 && bead < (double)v->count)
            add_name(names, v->area.x + bead_window_x(&v->row, v->position[(size_t)bead]), axis.ticks[i].label, BEAD_ALIGN_MIDDLE,
                     v->look.faint);
    }
}

/* Names above a moving row move with it. */
static enum bead_error move_names(struct bead_view *v, struct bead_message *msg)
{
    struct bead_rect strip = {v->plot.x, v->plot.y, v->plot.width, v->lens.rect.y};
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(v->setup.chain, &count);
    BEAD_TRY(bead_moving_labels_create(&v->look, strip, v->lens.scale, &v->labels, msg));
    for (size_t i = 0; i < count; i++) {
        char markup[160];
        if (!sensor_name(v, &sensors[i], markup))
            continue;
        BEAD_TRY(bead_moving_labels_add(v->labels, v->position[sensors[i].bead - v->first], markup, v->look.ink, BEAD_LABEL_POINTER,
                                        msg));
    }
    if (v->striker)
        BEAD_TRY(bead_moving_labels_add(v->labels, v->position[0], "striker", v->look.faint, BEAD_LABEL_PLAIN, msg));
    if (v->wall) {
        char markup[200];
        wall_name(v, markup);
        BEAD_TRY(bead_moving_labels_add(v->labels, v->ends[1] - 4 * v->largest, markup, v->look.faint, BEAD_LABEL_PLAIN, msg));
    }
    if (v->setup.bead_labels)
        BEAD_TRY(bead_moving_labels_count(v->labels, v->position, v->first, v->count, bead_camera_width(v->setup.camera),
                                          BEAD_LABEL_PLAIN, msg));
    return BEAD_OK;
}

enum bead_error bead_beads_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *msg)
{
    if (v->lens.scale > 0) {
        const struct bead_rect *r = &v->lens.rect;
        double line = v->look.line;
        bead_look_paint_panel(&v->look, cr, v->area.x + r->x, v->area.y + r->y, r->width, r->height);
        if (v->setup.camera)
            return v->label_y < 0 ? BEAD_OK : move_names(v, msg);
        beads_set_colour(cr, v->look.accent, 0.45);
        cairo_set_line_width(cr, line);
        cairo_rectangle(cr, v->area.x + r->x - 0.5 * line, v->area.y + r->y - 0.5 * line, r->width + line, r->height + line);
        cairo_stroke(cr);
    }
    if (v->wall)
        beads_draw_wall(v, cr);
    struct names names = {.cr = cr, .v = v};
    if (v->label_y < 0)
        return BEAD_OK;
    name_sensors(&names);
    name_ends(&names);
    if (v->setup.bead_labels)
        name_numbers(&names);
    return BEAD_OK;
}
