#include "render/peaks_plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "beadreel/picture.h"
#include "render/page.h"

/* In units of the label's font size. */
static const double paper_margin = 0.35, screen_margin = 1.3, legend_row = 1.5, sample_length = 1.8, marker_size = 0.24;
/* Axes: room above the largest; a logarithmic one shows this part of the largest force at least. */
static const double headroom = 1.06, log_room = 1.35, log_span = 1e-4;
/* Contacts closer than this, in line widths, are a line without markers. */
static const double least_spacing = 4;
static const int smallest_plot = 24; /* px */

struct bead_peaks_plot {
    const struct bead_output *output;
    struct bead_stage stage;
    struct bead_page page;
    struct bead_look look;
    char why[64];
    /* Known at the end: */
    const struct bead_outcome *outcomes;
    struct bead_rect plot;
    struct bead_axis contacts, force;
    struct entry {
        char markup[320];
        double x, width; /* px */
        int row;
    } * entries; /* [chains + 1], of the legend; the last one says what hollow markers are */
    int rows;
    bool open; /* there are hollow markers */
};

enum bead_error bead_peaks_plot_create(const struct bead_output *output, const struct bead_stage *stage,
                                       struct bead_peaks_plot **plot, struct bead_message *msg)
{
    struct bead_peaks_plot *p = *plot = calloc(1, sizeof *p);
    if (p)
        p->entries = calloc(stage->chain_count + 1, sizeof *p->entries);
    if (!p || !p->entries) {
        bead_peaks_plot_destroy(p);
        *plot = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot of peaks");
    }
    p->output = output;
    p->stage = *stage;
    enum bead_error err = bead_page_find(output, stage->scene->file, &p->page, msg);
    if (err) {
        bead_peaks_plot_destroy(p);
        *plot = NULL;
        return err;
    }
    bead_page_look(&p->page, output, &p->look);
    snprintf(p->why, sizeof p->why, "%d x %d pixels, peaks of contacts", p->page.width, p->page.height);
    return BEAD_OK;
}

void bead_peaks_plot_destroy(struct bead_peaks_plot *plot)
{
    if (plot)
        free(plot->entries);
    free(plot);
}

void bead_peaks_plot_needs(const struct bead_peaks_plot *plot, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.contact_peaks = true, .until = INFINITY, .why = plot->why};
}

static size_t contacts_of(const struct bead_peaks_plot *p, size_t chain)
{
    return p->outcomes[chain].contact_peaks ? bead_chain_contacts(p->stage.chains[chain]) : 0;
}

/* Contacts that were never loaded have no peak. */
static bool has_peak(const struct bead_peak *peak)
{
    return isfinite(peak->value) && !(peak->value == 0 && isnan(peak->time));
}

/* ---- layout ---- */

static void find_axes(struct bead_peaks_plot *p)
{
    double least = INFINITY, largest = 0, /* finished peaks matter for how far down the axis goes */
        width = p->plot.width, height = p->plot.height, em = p->look.tick;
    size_t most = 1;
    for (size_t c = 0; c < p->stage.chain_count; c++) {
        size_t count = contacts_of(p, c);
        most = count > most ? count : most;
        for (size_t i = 0; i < count; i++) {
            const struct bead_peak *peak = &p->outcomes[c].contact_peaks[i];
            largest = fmax(largest, has_peak(peak) ? peak->value : 0);
            least = peak->value > 0 && !peak->open ? fmin(least, peak->value) : least;
            p->open = p->open || (has_peak(peak) && peak->open);
        }
    }
    double high = largest > 0 ? largest : 1;
    bool logarithmic = p->output->scale == BEAD_SCALE_LOG;
    double low = logarithmic ? fmax(log_span * high, fmin(least, high)) / log_room : 0;
    bead_axis_make(&p->contacts, -0.5, (double)most - 0.5, "1", BEAD_SCALE_LINEAR, width, em, true);
    bead_axis_make(&p->force, low, high * (logarithmic ? log_room : headroom), "N", p->output->scale, height, em, false);
}

static struct bead_text_style text_style(const struct bead_peaks_plot *p)
{
    return (struct bead_text_style){.family = p->look.family,
                                    .size = p->look.label,
                                    .colour = p->look.ink,
                                    .across = BEAD_ALIGN_START,
                                    .down = BEAD_ALIGN_MIDDLE};
}

/* What stands in the legend for a chain; behind the last chain, what hollow markers are. */
static void entry_words(const struct bead_peaks_plot *p, size_t c, char *markup, size_t size)
{
    char name[160], magnetism[128] = "";
    if (c == p->stage.chain_count) {
        snprintf(markup, size, "%s", p->open ? "hollow: still rising at the end" : "");
        return;
    }
    const struct bead_chain *chain = p->stage.chains[c];
    bead_text_escape(bead_chain_name(chain), name, sizeof name);
    if (*bead_chain_spins(chain))
        bead_text_magnetism(bead_chain_magnetism(chain), magnetism, sizeof magnetism);
    snprintf(markup, size, "%s%s%s", name, *name && *magnetism ? "  " : "", magnetism);
}

/* A piece of the curve stands before its name where there are several. */
static double sample_width(const struct bead_peaks_plot *p, size_t c)
{
    return p->stage.chain_count > 1 && c < p->stage.chain_count ? (sample_length + 0.5) * p->look.label : 0;
}

/* In rows as wide as the plot. */
static void lay_out_legend(struct bead_peaks_plot *p)
{
    double em = p->look.label, x = 0, height;
    struct bead_text_style style = text_style(p);
    p->rows = 0;
    for (size_t c = 0; c <= p->stage.chain_count; c++) {
        struct entry *entry = &p->entries[c];
        entry_words(p, c, entry->markup, sizeof entry->markup);
        entry->width = sample_width(p, c);
        if (*entry->markup) {
            double text;
            bead_text_size(NULL, &style, entry->markup, &text, &height);
            entry->width += text;
        }
        if (!(entry->width > 0))
            continue;
        if (x > 0 && x + entry->width > p->plot.width) {
            p->rows++;
            x = 0;
        }
        entry->x = x;
        entry->row = p->rows;
        x += entry->width + 1.6 * em;
    }
    p->rows += x > 0;
}

static bool has_title(const struct bead_peaks_plot *p)
{
    return !p->page.paper && p->page.height >= 240 && *p->stage.scene->title;
}

/* Twice: what axes and legend take depends on the size of the plot. */
static enum bead_error lay_out(struct bead_peaks_plot *p, struct bead_message *msg)
{
    double em = p->look.label, margin = round((p->page.paper ? paper_margin : screen_margin) * em);
    double title = has_title(p) ? round(1.35 * p->look.title + 0.7 * em) : 0, left = 4 * em, bottom = 3 * em;
    for (int pass = 0; pass < 3; pass++) {
        double top = margin + title + round(p->rows * legend_row * em) + round((p->rows ? 0.2 : 0.4) * em);
        p->plot = (struct bead_rect){(int)(margin + ceil(left)), (int)top, 0, 0};
        p->plot.width = p->page.width - p->plot.x - (int)(margin + round(0.7 * p->look.tick));
        p->plot.height = p->page.height - p->plot.y - (int)(margin + ceil(bottom));
        if (p->plot.width < smallest_plot || p->plot.height < smallest_plot)
            return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: size: %d x %d pixels leave no room for a plot and its labels",
                             p->stage.scene->file, p->output->place.line, p->output->place.column, p->page.width, p->page.height);
        find_axes(p);
        lay_out_legend(p);
        left = bead_axis_draw(NULL, &p->look, &p->force, p->plot, BEAD_SIDE_LEFT, false, true, "peak force");
        bottom = bead_axis_draw(NULL, &p->look, &p->contacts, p->plot, BEAD_SIDE_BOTTOM, false, true, "contact");
    }
    return BEAD_OK;
}

/* ---- drawing ---- */

static void set_source(cairo_t *cr, struct bead_rgb colour)
{
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
}

/* Corners on a circle of radius 1, turned by `turn` of a full turn: circles are those with none. */
static const struct shape {
    int corners;
    double turn, size;
} shapes[] = {{0, 0, 1}, {4, 0.125, 1.2}, {3, 0.75, 1.3}, {4, 0, 1.3}, {3, 0.25, 1.3}};

static const double turn = 6.283185307179586;

/* Filled; hollow where the force was still rising at the end. */
static void draw_marker(const struct bead_peaks_plot *p, cairo_t *cr, size_t chain, double x, double y, double size, bool hollow)
{
    const struct shape *shape = &shapes[chain % (sizeof shapes / sizeof shapes[0])];
    double radius = shape->size * size;
    cairo_new_path(cr);
    if (shape->corners == 0)
        cairo_arc(cr, x, y, radius, 0, turn);
    for (int i = 0; i < shape->corners; i++) {
        double angle = turn * (shape->turn + (double)i / shape->corners);
        cairo_line_to(cr, x + radius * cos(angle), y + radius * sin(angle));
    }
    cairo_close_path(cr);
    set_source(cr, hollow ? (p->look.dark ? p->look.panel : p->look.background) : bead_look_curve(&p->look, chain));
    cairo_fill_preserve(cr);
    set_source(cr, bead_look_curve(&p->look, chain));
    cairo_stroke(cr);
}

/* A small arrow down at the lower end of the axis: the peak lies below. */
static void draw_below(const struct bead_peaks_plot *p, cairo_t *cr, size_t chain, double x, double size, bool hollow)
{
    double bottom = p->plot.y + p->plot.height;
    cairo_new_path(cr);
    cairo_move_to(cr, x - size, bottom - 1.6 * size);
    cairo_line_to(cr, x + size, bottom - 1.6 * size);
    cairo_line_to(cr, x, bottom);
    cairo_close_path(cr);
    set_source(cr, bead_look_curve(&p->look, chain));
    if (!hollow)
        cairo_fill_preserve(cr);
    cairo_stroke(cr);
}

static double x_of(const struct bead_peaks_plot *p, size_t contact)
{
    return p->plot.x + bead_axis_place(&p->contacts, (double)contact) * p->plot.width;
}

/* -1: below the axis. */
static double y_of(const struct bead_peaks_plot *p, const struct bead_peak *peak)
{
    double place = bead_axis_place(&p->force, peak->value);
    return place >= 0 ? p->plot.y + (1 - place) * p->plot.height : -1;
}

/* Lines to guide the eye, between finished peaks: thin, and paler than the markers; as they are where there is no room for markers.
 */
static void draw_guide(const struct bead_peaks_plot *p, cairo_t *cr, size_t chain, bool alone)
{
    struct bead_rgb ink = bead_look_curve(&p->look, chain), paper = p->look.background;
    double part = alone ? 1 : 0.55;
    bool pen = false;
    cairo_new_path(cr);
    for (size_t i = 0; i < contacts_of(p, chain); i++) {
        const struct bead_peak *peak = &p->outcomes[chain].contact_peaks[i];
        double y = has_peak(peak) && (alone || !peak->open) ? y_of(p, peak) : -1;
        if (y < 0) {
            pen = false;
            continue;
        }
        if (!pen)
            cairo_move_to(cr, x_of(p, i), y);
        else
            cairo_line_to(cr, x_of(p, i), y);
        pen = true;
    }
    cairo_set_source_rgb(cr, paper.r + part * (ink.r - paper.r), paper.g + part * (ink.g - paper.g),
                         paper.b + part * (ink.b - paper.b));
    cairo_set_line_width(cr, alone ? 1.5 * p->look.line : p->look.line);
    cairo_stroke(cr);
}

static void draw_chain(const struct bead_peaks_plot *p, cairo_t *cr, size_t chain)
{
    double spacing = x_of(p, 1) - x_of(p, 0), size = fmin(marker_size * p->look.label, 0.35 * spacing);
    bool markers = spacing >= least_spacing * p->look.line;
    draw_guide(p, cr, chain, !markers);
    cairo_set_line_width(cr, fmin(p->look.line, 0.5 * size));
    for (size_t i = 0; markers && i < contacts_of(p, chain); i++) {
        const struct bead_peak *peak = &p->outcomes[chain].contact_peaks[i];
        if (has_peak(peak) && y_of(p, peak) >= 0)
            draw_marker(p, cr, chain, x_of(p, i), y_of(p, peak), size, peak->open);
        else if (has_peak(peak))
            draw_below(p, cr, chain, x_of(p, i), size, peak->open);
    }
}

static void draw_legend(const struct bead_peaks_plot *p, cairo_t *cr)
{
    double em = p->look.label, top = p->plot.y - round(0.2 * em) - round(p->rows * legend_row * em);
    struct bead_text_style style = text_style(p);
    for (size_t c = 0; c <= p->stage.chain_count; c++) {
        const struct entry *entry = &p->entries[c];
        double x = p->plot.x + entry->x, y = top + (entry->row + 0.5) * legend_row * em;
        if (sample_width(p, c) > 0) {
            set_source(cr, bead_look_curve(&p->look, c));
            cairo_set_line_width(cr, p->look.line);
            cairo_move_to(cr, x, y);
            cairo_rel_line_to(cr, sample_length * em, 0);
            cairo_stroke(cr);
            draw_marker(p, cr, c, x + sample_length * em / 2, y, marker_size * em, false);
        }
        style.colour = c < p->stage.chain_count ? p->look.ink : p->look.faint;
        if (*entry->markup)
            bead_text_draw(cr, &style, x + sample_width(p, c), y, entry->markup);
    }
}

static void draw_title(const struct bead_peaks_plot *p, cairo_t *cr)
{
    char markup[1024];
    struct bead_text_style style = text_style(p);
    style.size = 1.2 * p->look.title;
    style.bold = true;
    style.down = BEAD_ALIGN_BASELINE;
    bead_text_escape(p->stage.scene->title, markup, sizeof markup);
    bead_text_draw(cr, &style, p->plot.x, round(screen_margin * p->look.label) + p->look.title, markup);
}

static enum bead_error draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_peaks_plot *p = context;
    const struct bead_rect *plot = &p->plot;
    set_source(cr, p->look.background);
    cairo_paint(cr);
    if (p->look.dark) {
        set_source(cr, p->look.panel);
        cairo_rectangle(cr, plot->x, plot->y, plot->width, plot->height);
        cairo_fill(cr);
    }
    if (has_title(p))
        draw_title(p, cr);
    draw_legend(p, cr);
    cairo_save(cr);
    cairo_rectangle(cr, plot->x, plot->y, plot->width, plot->height);
    cairo_clip(cr);
    for (size_t c = 0; c < p->stage.chain_count; c++)
        draw_chain(p, cr, c);
    cairo_restore(cr);
    if (!p->look.dark)
        bead_box_draw(cr, &p->look, *plot);
    bead_axis_draw(cr, &p->look, &p->force, *plot, BEAD_SIDE_LEFT, false, true, "peak force");
    bead_axis_draw(cr, &p->look, &p->contacts, *plot, BEAD_SIDE_BOTTOM, false, true, "contact");
    cairo_status_t status = cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "plot of peaks: %s", cairo_status_to_string(status)) : BEAD_OK;
}

static enum bead_error write_raster(struct bead_peaks_plot *p, const char *path, const struct bead_picture_notes *notes,
                                    uint64_t *bytes, struct bead_message *msg)
{
    struct bead_frame frame;
    enum bead_error err = bead_frame_create(p->page.width, p->page.height, &frame, msg);
    if (err)
        return err;
    cairo_surface_t *surface =
        cairo_image_surface_create_for_data(frame.pixels, CAIRO_FORMAT_RGB24, frame.width, frame.height, (int)frame.stride);
    cairo_t *cr = cairo_create(surface);
    err = draw(p, cr, msg);
    cairo_destroy(cr);
    cairo_surface_flush(surface);
    cairo_surface_destroy(surface);
    if (!err)
        err = bead_png_write(path, &frame, notes, bytes, msg);
    bead_frame_free(&frame);
    return err;
}

enum bead_error bead_peaks_plot_write(struct bead_peaks_plot *p, const struct bead_outcome *outcomes, const char *path,
                                      uint64_t *bytes, struct bead_message *msg)
{
    struct bead_picture_notes notes;
    char description[512];
    if (!outcomes)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: peaks are known only at the end of a run", path);
    p->outcomes = outcomes;
    enum bead_error err = lay_out(p, msg);
    if (err)
        return err;
    bead_page_notes(&p->page, p->output, p->stage.scene, description, sizeof description, &notes);
    return p->page.vector ? bead_vector_write(path, p->page.width, p->page.height, draw, p, &notes, bytes, msg)
                          : write_raster(p, path, &notes, bytes, msg);
}
