/* SPDX-License-Identifier: GPL-3.0-or-later */
/* See theory_line.h. */
#include "render/view/theory_line.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "render/draw/words.h"
#include "render/stage/along.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/compacton.h"
#include "sim/measure/measure.h"

struct bead_theory_line {
    struct bead_view_setup setup;
    size_t first, end; /* contacts that the wave passes as in an endless chain: `end` is out of reach of reflections */
    size_t next;       /* the first that it has not passed; SIZE_MAX: nothing is fed */
    double *peak;      /* [end] N: largest forces so far */
    double *before[2]; /* [end] N: forces of the last sample, and of the one before */
};

/* Contacts [*first, *end) whose pulses are compared with it: as many are behind the last bead shown as the wave is wide. */
static void find_contacts(const struct bead_chain *chain, struct bead_span beads, size_t *first, size_t *end)
{
    const double last = (double)bead_chain_beads(chain) - 1 - ceil(bead_compacton_width(chain));
    *first = beads.first > 1 ? beads.first : 1;
    *end = (size_t)fmax(0, fmin(last, (double)beads.last));
}

enum bead_error bead_theory_line_check(const struct bead_output *output, const struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    size_t first, end;
    if (!bead_compacton_is_of(chain) && !bead_compacton_of_dimers(chain))
        return bead_output_wrong(
            output, msg,
            "theory: there is one for equal Hertzian beads, or two kinds in turn, without precompression, tilt, gaps or springs");
    if (!(spec->striker_velocity > 0) || spec->start_count > 0 || spec->drive.displacement || spec->drive.force)
        return bead_output_wrong(output, msg, "theory: the line is that of a striker's wave, which moves alone at first");
    find_contacts(chain, output->shown.beads, &first, &end);
    return end > first
               ? BEAD_OK
               : bead_output_wrong(output, msg,
                                   "theory: too few beads are shown; the wave is %.0f contacts wide and ends before the last",
                                   bead_compacton_width(chain));
}

enum bead_error bead_theory_line_create(const struct bead_view_setup *setup, struct bead_theory_line **line,
                                        struct bead_message *msg)
{
    BEAD_TRY(bead_new(line, 1, msg, "a line of theory"));
    struct bead_theory_line *l = *line;
    l->setup = *setup;
    find_contacts(setup->chain, setup->beads, &l->first, &l->end);
    l->next = SIZE_MAX;
    BEAD_TRY(bead_new(&l->peak, 3 * l->end + 1, msg, "a line of theory"));
    l->before[0] = l->peak + l->end;
    l->before[1] = l->before[0] + l->end;
    return BEAD_OK;
}

void bead_theory_line_destroy(struct bead_theory_line *line)
{
    if (!line)
        return;
    free(line->peak);
    free(line);
}

/* Beads that the wave passed before the first sample tell nothing about it. */
static size_t first_at_rest(const struct bead_theory_line *line, const double *force)
{
    size_t next = line->end;
    while (next > line->first && force[next - 1] == 0)
        next--;
    return next;
}

/* The top of the parabola through three samples; 0: it is not between them. */
static double top(double before, double here, double after)
{
    const double bend = before - 2 * here + after;
    return here >= before && here >= after && bend < 0 ? here - (after - before) * (after - before) / (8 * bend) : 0;
}

/* A contact is passed where measures end its pulse. */
void bead_theory_line_feed(struct bead_theory_line *l, const struct bead_sample *sample)
{
    const double *force = sample->field[BEAD_FIELD_CONTACT_FORCE];
    if (l->next == SIZE_MAX)
        l->next = first_at_rest(l, force);
    for (size_t c = l->next; c < l->end && force[c] > 0; c++) {
        l->peak[c] = fmax(l->peak[c], fmax(force[c], top(l->before[1][c], l->before[0][c], force[c])));
        l->before[1][c] = l->before[0][c];
        l->before[0][c] = force[c];
    }
    while (l->next < l->end && force[l->next] < BEAD_PULSE_END * l->peak[l->next])
        l->next++;
}

/* The force of the wave when it was last seen whole: the largest in a cell, whose contacts have different forces. 0: never. */
static double force_of(const struct bead_theory_line *l)
{
    const size_t cell = bead_compacton_of_dimers(l->setup.chain) ? 2 : 1;
    double force = 0;
    for (size_t c = l->next; c > l->first && c + cell > l->next; c--)
        force = fmax(force, l->peak[c - 1]);
    return force;
}

static void line_point(const struct bead_theory_line *l, struct bead_rect plot, double bead, double time, double xy[2])
{
    const struct bead_view_setup *s = &l->setup;
    const bool down = s->orientation == BEAD_TIME_DOWN, contacts = bead_field_info(s->field)->of_contacts;
    const double number = bead - (contacts ? 0.5 : 0), first = (double)s->beads.first, count = (double)s->beads.last - first + 1;
    const double place =
        bead_along_uneven(s, down ? plot.width : plot.height) ? bead_along_place(s, number) : (number - first + 0.5) / count;
    const double when = (time - s->time[0]) / (s->time[1] - s->time[0]);
    xy[0] = plot.x + plot.width * (down ? place : when);
    xy[1] = plot.y + plot.height * (down ? when : s->orientation == BEAD_MATRIX ? place : 1 - place);
}

/* Through all beads if they are unevenly wide, else from end to end. */
static void line_path(const struct bead_theory_line *l, struct bead_rect plot, double speed, cairo_t *cr)
{
    const struct bead_view_setup *s = &l->setup;
    const bool uneven = bead_along_uneven(s, s->orientation == BEAD_TIME_DOWN ? plot.width : plot.height);
    const size_t last = bead_chain_beads(s->chain) - 1;
    double xy[2];
    for (size_t bead = 1; bead <= last; bead = uneven || bead == last ? bead + 1 : last) {
        line_point(l, plot, (double)bead, ((double)bead - 1) / speed, xy);
        cairo_line_to(cr, xy[0], xy[1]);
    }
}

/* Does a box in the corner where beads are still at rest end before the line? */
static bool is_clear(const struct bead_theory_line *l, struct bead_rect plot, double speed, double width, double height)
{
    const struct bead_view_setup *s = &l->setup;
    const bool down = s->orientation == BEAD_TIME_DOWN;
    const double part = down ? width / plot.width : height / plot.height;
    const double bead = (double)s->beads.last + 0.5 - part * ((double)(s->beads.last - s->beads.first) + 1);
    double xy[2];
    line_point(l, plot, bead, (bead - 1) / speed, xy);
    return down ? xy[1] - plot.y > height : xy[0] - plot.x > width;
}

/* Draws the words, without the speed if it does not fit; none until there is room. */
static void line_words(const struct bead_theory_line *l, const struct bead_look *look, struct bead_rect plot, struct bead_rect part,
                       double speed, cairo_t *cr)
{
    const bool down = l->setup.orientation == BEAD_TIME_DOWN, low = l->setup.orientation == BEAD_MATRIX;
    const double pad = 0.4 * look->tick;
    const char *name = bead_compacton_of_dimers(l->setup.chain) ? "long waves of dimers" : "Nesterenko\u2019s wave";
    char markup[160], number[48];
    double width, height;
    struct bead_text_style style = bead_words_style(look, look->tick, look->ink, BEAD_ALIGN_START);
    bead_number(speed, 0, number, sizeof number);
    snprintf(markup, sizeof markup, "theory: %s, %s\u00a0beads/s", name, number);
    bead_text_size(cr, &style, markup, &width, &height);
    if (!is_clear(l, plot, speed, width + 4 * pad, height + 4 * pad)) {
        snprintf(markup, sizeof markup, "theory: %s", name);
        bead_text_size(cr, &style, markup, &width, &height);
    }
    const double x = down ? plot.x + plot.width - width - 3 * pad : plot.x + pad,
                 y = low ? plot.y + plot.height - height - 3 * pad : plot.y + pad;
    if (x < part.x || y < part.y || x + width + 2 * pad > part.x + part.width || y + height + 2 * pad > part.y + part.height)
        return;
    cairo_rectangle(cr, x, y, width + 2 * pad, height + 2 * pad);
    cairo_set_source_rgb(cr, look->background.r, look->background.g, look->background.b);
    cairo_fill(cr);
    bead_text_draw(cr, &style, x + pad, y + pad, markup);
}

void bead_theory_line_draw(const struct bead_theory_line *l, const struct bead_look *look, struct bead_rect plot,
                           struct bead_rect part, cairo_t *cr)
{
    const double force = force_of(l), speed = bead_compacton_speed(l->setup.chain, force);
    const double dashes[] = {6 * look->line, 4 * look->line};
    if (!(force > 0))
        return;
    cairo_save(cr);
    cairo_rectangle(cr, part.x, part.y, part.width, part.height);
    cairo_clip(cr);
    cairo_new_path(cr);
    cairo_set_dash(cr, dashes, 2, 0);
    line_path(l, plot, speed, cr);
    for (int pass = 0; pass < 2; pass++) { /* a light line with dark edges is visible on any colour */
        cairo_set_source_rgba(cr, pass, pass, pass, pass ? 1 : 0.6);
        cairo_set_line_width(cr, (pass ? 1.5 : 3.5) * look->line);
        cairo_stroke_preserve(cr);
    }
    cairo_new_path(cr);
    line_words(l, look, plot, part, speed, cr);
    cairo_restore(cr);
}
