/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The work-precision diagram of a table of precision.sh, drawn with this program's own axes and text.
 *   precision_diagram TABLE.csv NAME [velocity]       writes NAME.png and NAME.pdf: errors of peaks, or of velocities */
#include "beadreel/view.h"
#include "render/draw/looks.h"
#include "tests/bench/diagram.h"

enum { WORDS = 48, COLUMNS = 3, ROWS = 2 };
static const double dpi = 300, millimetre = 300 / 25.4;
static const int width = 2126, height = 1500; /* px: 180 mm x 127 mm */
static const double lowest_error = 1e-15, highest_error = 1;

struct point {
    char problem[WORDS], solver[WORDS];
    double cpu, error;
};

struct points {
    struct point *point;
    size_t count;
};

enum marker { DISC, SQUARE, DIAMOND, TRIANGLE, RING };

static const struct style {
    const char *solver, *label;
    struct bead_rgb colour;
    double line; /* in units of the look's */
    bool dashed;
    enum marker marker;
} styles[] = {
    {"auto", "default, accuracy asked", {0.84, 0.15, 0.16}, 3.5, false, DISC},
    {"rkn8", "RKN8 with contact events", {0.95, 0.55, 0.10}, 2, false, DIAMOND},
    {"rkn8-plain", "RKN8", {0.60, 0.45, 0.05}, 1.5, false, SQUARE},
    {"rkn12", "RKN12", {0.35, 0.20, 0.50}, 1.5, false, TRIANGLE},
    {"rkn6", "RKN6", {0.80, 0.45, 0.70}, 1.5, false, SQUARE},
    {"pefrl", "PEFRL", {0.30, 0.55, 0.25}, 1.5, false, TRIANGLE},
    {"vefrl", "VEFRL", {0.55, 0.75, 0.40}, 1.5, false, RING},
    {"rk4", "Runge-Kutta 4", {0.10, 0.10, 0.10}, 1.5, false, RING},
    {"verlet", "velocity Verlet", {0.55, 0.55, 0.55}, 1.5, false, DIAMOND},
    {"GSL rk8pd", "GSL rk8pd", {0.00, 0.45, 0.70}, 1.5, true, SQUARE},
    {"CVODE Adams", "SUNDIALS CVODE, Adams", {0.00, 0.60, 0.60}, 1.5, true, TRIANGLE},
    {"ARKODE ERK8", "SUNDIALS ARKODE, ERK 8", {0.20, 0.70, 0.85}, 1.5, true, DIAMOND},
    {"Boost rkn_sb3a", "Boost.odeint, RKN SB3A", {0.55, 0.35, 0.15}, 1.5, true, SQUARE},
    {"Boost rkf78", "Boost.odeint, RKF 7(8)", {0.85, 0.60, 0.30}, 1.5, true, TRIANGLE},
    {"SciPy DOP853", "SciPy DOP853", {0.25, 0.25, 0.75}, 1.5, true, DISC},
    {"SciPy LSODA", "SciPy LSODA", {0.60, 0.60, 0.90}, 1.5, true, RING},
    {"thesis (Octave)", "the thesis's program, Octave", {0.10, 0.10, 0.10}, 1.5, true, DISC},
};
enum { STYLES = sizeof styles / sizeof *styles };

struct diagram {
    struct bead_look look;
    struct points points;
    bool velocities;
};

static struct points read_points(const char *path, bool velocities)
{
    struct points all = {NULL, 0};
    char line[512];
    FILE *file = fopen(path, "r");
    if (!file)
        GIVE_UP("cannot read %s", path);
    while (fgets(line, sizeof line, file)) {
        struct point p;
        double velocity;
        if (sscanf(line, "%47[^,],%47[^,],%*[^,],%lf,%lf,%lf", p.problem, p.solver, &p.cpu, &p.error, &velocity) != 5)
            continue;
        p.error = velocities ? velocity : p.error;
        if (!(p.cpu > 0) || !isfinite(p.error))
            continue;
        struct point *grown = realloc(all.point, (all.count + 1) * sizeof *grown);
        if (!grown)
            GIVE_UP("out of memory");
        all.point = grown;
        p.error = fmin(fmax(p.error, lowest_error), highest_error);
        all.point[all.count++] = p;
    }
    fclose(file);
    return all;
}

static void marker_path(cairo_t *cr, enum marker marker, double x, double y, double r)
{
    const double corners[][4][2] = {
        [SQUARE] = {{-0.85, -0.85}, {0.85, -0.85}, {0.85, 0.85}, {-0.85, 0.85}},
        [DIAMOND] = {{0, -1.2}, {1.2, 0}, {0, 1.2}, {-1.2, 0}},
        [TRIANGLE] = {{0, -1.15}, {1.1, 0.8}, {-1.1, 0.8}, {0, -1.15}},
    };
    cairo_new_path(cr);
    if (marker == DISC || marker == RING) {
        cairo_arc(cr, x, y, r, 0, 2 * 3.14159265358979);
        return;
    }
    for (int i = 0; i < 4; i++)
        cairo_line_to(cr, x + r * corners[marker][i][0], y + r * corners[marker][i][1]);
    cairo_close_path(cr);
}

static void draw_marker(cairo_t *cr, const struct diagram *d, const struct style *style, double x, double y)
{
    double r = d->look.line * (1.6 + 0.35 * style->line);
    marker_path(cr, style->marker, x, y, r);
    if (style->marker == RING)
        cairo_set_source_rgb(cr, 1, 1, 1);
    else
        cairo_set_source_rgb(cr, style->colour.r, style->colour.g, style->colour.b);
    cairo_fill_preserve(cr);
    cairo_set_source_rgb(cr, style->colour.r, style->colour.g, style->colour.b);
    cairo_set_line_width(cr, d->look.line);
    cairo_set_dash(cr, NULL, 0, 0);
    cairo_stroke(cr);
}

static void line_style(cairo_t *cr, const struct diagram *d, const struct style *style)
{
    double dash[2] = {4 * d->look.line, 3 * d->look.line};
    cairo_set_source_rgb(cr, style->colour.r, style->colour.g, style->colour.b);
    cairo_set_line_width(cr, style->line * d->look.line);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cr, dash, style->dashed ? 2 : 0, 0);
}

struct panel {
    const char *problem, *title;
    struct bead_rect plot;
    struct bead_axis work, error;
};

static void place_of(const struct panel *panel, const struct point *p, double *x, double *y)
{
    *x = panel->plot.x + bead_axis_place(&panel->work, p->cpu) * panel->plot.width;
    *y = panel->plot.y + (1 - bead_axis_place(&panel->error, p->error)) * panel->plot.height;
}

static bool belongs(const struct point *p, const struct panel *panel, const struct style *style)
{
    return strcmp(p->problem, panel->problem) == 0 && strcmp(p->solver, style->solver) == 0;
}

static void draw_curve(cairo_t *cr, const struct diagram *d, const struct panel *panel, const struct style *style)
{
    double x, y;
    line_style(cr, d, style);
    cairo_new_path(cr);
    for (size_t i = 0; i < d->points.count; i++) {
        if (belongs(&d->points.point[i], panel, style)) {
            place_of(panel, &d->points.point[i], &x, &y);
            cairo_line_to(cr, x, y);
        }
    }
    cairo_stroke(cr);
    for (size_t i = 0; i < d->points.count; i++) {
        if (belongs(&d->points.point[i], panel, style)) {
            place_of(panel, &d->points.point[i], &x, &y);
            draw_marker(cr, d, style, x, y);
        }
    }
}

/* From the fastest to the slowest run, with some air. */
static bool find_work(const struct diagram *d, const char *problem, double range[2])
{
    range[0] = INFINITY;
    range[1] = 0;
    for (size_t i = 0; i < d->points.count; i++) {
        if (strcmp(d->points.point[i].problem, problem) == 0) {
            range[0] = fmin(range[0], d->points.point[i].cpu / 1.5);
            range[1] = fmax(range[1], d->points.point[i].cpu * 1.5);
        }
    }
    return range[1] > 0;
}

static void draw_panel(cairo_t *cr, const struct diagram *d, struct panel *panel, bool left)
{
    const struct bead_look *look = &d->look;
    double range[2];
    if (!find_work(d, panel->problem, range))
        return;
    bead_axis_make(&panel->work, range[0], range[1], "s", BEAD_SCALE_LOG, panel->plot.width, look->tick, true);
    bead_axis_make(&panel->error, lowest_error, highest_error, "", BEAD_SCALE_LOG, panel->plot.height, look->tick, false);
    bead_box_draw(cr, look, panel->plot);
    bead_axis_draw(cr, look, &panel->work, panel->plot, BEAD_SIDE_BOTTOM, false, true, "CPU time");
    bead_axis_draw(cr, look, &panel->error, panel->plot, BEAD_SIDE_LEFT, false, true,
                   !left           ? NULL
                   : d->velocities ? "error of velocities, of the striker's"
                                   : "relative error of peak forces");
    struct bead_text_style title = {.family = look->family, .size = look->title, .colour = look->ink, .down = BEAD_ALIGN_END};
    bead_text_draw(cr, &title, panel->plot.x, panel->plot.y - look->gap, panel->title);
    cairo_save(cr);
    cairo_rectangle(cr, panel->plot.x, panel->plot.y, panel->plot.width, panel->plot.height);
    cairo_clip(cr);
    for (size_t i = STYLES; i-- > 0;)
        draw_curve(cr, d, panel, &styles[i]);
    cairo_restore(cr);
}

/* Programs that are not installed have no points. */
static bool is_measured(const struct diagram *d, const struct style *style)
{
    for (size_t i = 0; i < d->points.count; i++) {
        if (strcmp(d->points.point[i].solver, style->solver) == 0)
            return true;
    }
    return false;
}

static void draw_legend(cairo_t *cr, const struct diagram *d, struct bead_rect box)
{
    const struct bead_look *look = &d->look;
    double line = box.height / (STYLES + 2.5), y = box.y;
    struct bead_text_style text = {
        .family = look->family, .size = fmin(look->label, 0.82 * line), .colour = look->ink, .down = BEAD_ALIGN_MIDDLE};
    const struct style *last = NULL;
    for (size_t i = 0; i < STYLES; i++) {
        if (!is_measured(d, &styles[i]))
            continue;
        if (!last || styles[i].dashed != last->dashed) {
            text.bold = true;
            y += last ? line / 2 : 0;
            bead_text_draw(cr, &text, box.x, y + line / 2, styles[i].dashed ? "other programs" : "this program");
            text.bold = false;
            y += line;
        }
        last = &styles[i];
        double middle = y + line / 2, sample = 7 * millimetre;
        line_style(cr, d, &styles[i]);
        cairo_move_to(cr, box.x, middle);
        cairo_rel_line_to(cr, sample, 0);
        cairo_stroke(cr);
        draw_marker(cr, d, &styles[i], box.x + sample / 2, middle);
        bead_text_draw(cr, &text, box.x + sample + 2 * look->gap, middle, styles[i].label);
        y += line;
    }
}

static enum bead_error draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    static const char *const titles[PROBLEMS] = {"P1: 50 beads of steel", "P2: 68 beads, steel and aluminium",
                                                 "P3: 64 random dimers, 3 ms", "P4: the same, compressed by 10 N",
                                                 "250 random dimers, 12 ms"};
    struct diagram *d = context;
    double left = 14 * millimetre, right = 3 * millimetre, top = 6 * millimetre, bottom = 11 * millimetre;
    double across = width / (double)COLUMNS, down = height / (double)ROWS;
    (void)msg;
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        struct bead_rect plot = {(int)(i % COLUMNS * across + left), (int)(i / COLUMNS * down + top), (int)(across - left - right),
                                 (int)(down - top - bottom)};
        struct panel panel = {.plot = plot};
        if (i < PROBLEMS) {
            panel.problem = problems[i].name;
            panel.title = titles[i];
            draw_panel(cr, d, &panel, i % COLUMNS == 0);
        } else {
            plot.x -= (int)(left / 2);
            draw_legend(cr, d, plot);
        }
    }
    return BEAD_OK;
}

int main(int count, char **word)
{
    struct bead_picture_notes notes = {.size = sizeof notes,
                                       .dpi = dpi,
                                       .title = "Work against error",
                                       .description = "Waves in chains of beads: CPU time and error of peak forces"};
    const bool velocities = count == 4 && strcmp(word[3], "velocity") == 0;
    if (count != 3 && !velocities)
        GIVE_UP("precision_diagram TABLE.csv NAME [velocity]");
    if (velocities)
        notes.description = "Waves in chains of beads: CPU time of a whole run and error of velocities at an early time";
    struct diagram diagram = {.points = read_points(word[1], velocities), .velocities = velocities};
    bead_look_paper(&diagram.look, dpi);
    diagram_write(word[2], width, height, draw, &diagram, &notes);
    free(diagram.points.point);
    return 0;
}
