/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table and the diagram of scaling.c: cost and memory of a bead over the length of the chain. */
#ifndef BEADREEL_BENCH_SCALING_PLOT_H
#define BEADREEL_BENCH_SCALING_PLOT_H

#include <sys/stat.h>

#include "render/draw/looks.h"
#include "tests/bench/diagram.h"

struct scaling_row {
    size_t beads;
    double cost, plain, memory; /* ns for each bead and step with and without contact events; bytes for each bead */
};

struct scaling_plot {
    struct bead_look look;
    const struct scaling_row *rows;
    size_t count;
};

enum { SCALING_WIDTH = 2126, SCALING_HEIGHT = 945 }; /* px: 180 mm x 80 mm at 300 dpi */

struct scaling_curve {
    const char *label;
    struct bead_rgb colour;
    double (*value)(const struct scaling_row *row);
};

static inline double scaling_cost(const struct scaling_row *row)
{
    return 1e-9 * row->cost;
}

static inline double scaling_plain(const struct scaling_row *row)
{
    return 1e-9 * row->plain;
}

static inline double scaling_memory(const struct scaling_row *row)
{
    return row->memory;
}

/* A panel with logarithmic beads and `axis` upwards; labels are where the curves end, above the first and below the second. */
static inline void scaling_panel(cairo_t *cr, const struct scaling_plot *p, struct bead_rect plot, const double range[2],
                                 enum bead_scale scale, const char *unit, const char *title, const struct scaling_curve *curves,
                                 size_t count)
{
    const struct bead_look *look = &p->look;
    struct bead_axis beads, axis;
    bead_axis_make(&beads, 50, 2e6, "", BEAD_SCALE_LOG, plot.width, look->tick, true);
    bead_axis_make(&axis, range[0], range[1], unit, scale, plot.height, look->tick, false);
    bead_box_draw(cr, look, plot);
    bead_axis_draw(cr, look, &beads, plot, BEAD_SIDE_BOTTOM, false, true, "beads");
    bead_axis_draw(cr, look, &axis, plot, BEAD_SIDE_LEFT, false, true, title);
    for (size_t c = 0; c < count; c++) {
        double x = 0, y = 0;
        cairo_set_source_rgb(cr, curves[c].colour.r, curves[c].colour.g, curves[c].colour.b);
        cairo_set_line_width(cr, 2.5 * look->line);
        cairo_new_path(cr);
        for (size_t i = 0; i < p->count; i++) {
            x = plot.x + bead_axis_place(&beads, (double)p->rows[i].beads) * plot.width;
            y = plot.y + (1 - bead_axis_place(&axis, curves[c].value(&p->rows[i]))) * plot.height;
            cairo_line_to(cr, x, y);
        }
        cairo_stroke(cr);
        for (size_t i = 0; i < p->count; i++) {
            x = plot.x + bead_axis_place(&beads, (double)p->rows[i].beads) * plot.width;
            y = plot.y + (1 - bead_axis_place(&axis, curves[c].value(&p->rows[i]))) * plot.height;
            cairo_arc(cr, x, y, 3 * look->line, 0, 2 * 3.14159265358979);
            cairo_fill(cr);
        }
        struct bead_text_style text = {.family = look->family,
                                       .size = look->label,
                                       .colour = curves[c].colour,
                                       .across = BEAD_ALIGN_END,
                                       .down = c == 0 ? BEAD_ALIGN_END : BEAD_ALIGN_START};
        bead_text_draw(cr, &text, x, c == 0 ? y - 2 * look->gap : y + 2 * look->gap, curves[c].label);
    }
}

static inline enum bead_error scaling_draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    static const struct scaling_curve costs[] = {
        {"with contact events", {0.84, 0.15, 0.16}, scaling_cost},
        {"plain RKN8", {0.20, 0.35, 0.65}, scaling_plain},
    };
    static const struct scaling_curve memory[] = {{"chain, state and peaks", {0.20, 0.50, 0.25}, scaling_memory}};
    const struct scaling_plot *p = context;
    const double millimetre = 300 / 25.4, left = 17 * millimetre, right = 4 * millimetre, bottom = 12 * millimetre;
    double most = 0, bytes = 0;
    (void)msg;
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    for (size_t i = 0; i < p->count; i++) {
        most = fmax(most, 1.25e-9 * p->rows[i].cost);
        bytes = fmax(bytes, 1.25 * p->rows[i].memory);
    }
    struct bead_rect plot = {(int)left, (int)(4 * millimetre), (int)(SCALING_WIDTH / 2 - left - right),
                             (int)(SCALING_HEIGHT - bottom - 4 * millimetre)};
    scaling_panel(cr, p, plot, (double[2]){0, most}, BEAD_SCALE_LINEAR, "s", "CPU time of a bead and step", costs, 2);
    plot.x += SCALING_WIDTH / 2;
    scaling_panel(cr, p, plot, (double[2]){0, bytes}, BEAD_SCALE_LINEAR, "", "bytes of a bead", memory, 1);
    return BEAD_OK;
}

/* FOLDER/bench/scaling.csv, .png and .pdf. */
static inline void scaling_write(const char *folder, const struct scaling_row *rows, size_t count)
{
    char path[512];
    const struct bead_picture_notes notes = {.size = sizeof notes,
                                             .dpi = 300,
                                             .title = "Scaling",
                                             .description = "Cost and memory of a bead over the length of the chain"};
    struct scaling_plot plot = {.rows = rows, .count = count};
    bead_look_paper(&plot.look, 300);
    snprintf(path, sizeof path, "%s/bench", folder);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/bench/scaling.csv", folder);
    FILE *file = fopen(path, "w");
    if (!file)
        GIVE_UP("cannot write %s", path);
    fprintf(file, "beads,ns_per_bead_step,ns_per_bead_step_plain,bytes_per_bead\n");
    for (size_t i = 0; i < count; i++)
        fprintf(file, "%zu,%.2f,%.2f,%.0f\n", rows[i].beads, rows[i].cost, rows[i].plain, rows[i].memory);
    if (fclose(file))
        GIVE_UP("cannot write %s", path);
    snprintf(path, sizeof path, "%s/bench/scaling", folder);
    diagram_write(path, SCALING_WIDTH, SCALING_HEIGHT, scaling_draw, &plot, &notes);
    fprintf(stderr, "bench: wrote %s/bench/scaling.csv, .png and .pdf\n", folder);
}

#endif
