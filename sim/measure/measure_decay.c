/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits the decay of the leading force, after the transient of the strike. */
#include "sim/measure/measure_private.h"

#include <math.h>

#include "sim/base/elementary.h"

/* Contacts left out at both ends of the chain, whole cells also left out at the far end, and the fewest means of a fit. */
enum { MARGIN = 5, MARGIN_CELLS = 2, FEWEST = 8 };
/* Standard errors that a rate must exceed. */
static const double sure = 2;

/* Length, in beads, of the cell that most beads belong to. */
static size_t usual_cell(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    size_t most = 0, cell = 1;
    for (size_t s = 0; s < spec->segment_count; s++) {
        size_t beads = spec->segments[s].cell_beads * spec->segments[s].count;
        if (beads > most) {
            most = beads;
            cell = spec->segments[s].cell_beads;
        }
    }
    return cell;
}

/* Logarithm of the mean force of the `cell` contacts from k on; not finite if one of them has no pulse. */
static double cell_force(const struct bead_measures *m, size_t k, size_t cell)
{
    double sum = 0;
    for (size_t i = 0; i < cell; i++)
        sum += bead_pulses_first(m->pulses, k + i).force;
    return bead_log(sum / (double)cell);
}

/* A least-squares line through points added one by one; sums about the running means lose no digits. */
struct line {
    double n, x, y, xx, xy, yy;
};

static void add_point(struct line *l, double x, double y)
{
    const double dx = x - l->x, dy = y - l->y;
    l->n++;
    l->x += dx / l->n;
    l->y += dy / l->n;
    l->xx += dx * (x - l->x);
    l->xy += dx * (y - l->y);
    l->yy += dy * (y - l->y);
}

static double standard_error(const struct line *l)
{
    return sqrt(fmax(l->yy - l->xy * l->xy / l->xx, 0) / (l->n - 2) / l->xx);
}

/* The cells that begin at contacts first, first + cell, ... < end. */
struct cells {
    const struct bead_measures *m;
    size_t first, end, cell;
    size_t latest; /* the fit may begin up to here */
};

static struct line fit(const struct cells *c, size_t from, size_t to)
{
    struct line line = {0};
    for (size_t k = from; k < to; k += c->cell) {
        double y = cell_force(c->m, k, c->cell);
        if (isfinite(y))
            add_point(&line, (double)k, y);
    }
    return line;
}

/* The beginning that leaves the smallest standard error: points in the transient increase it by more than their number reduces it
 * (the marginal standard error rule of White, Simulation 69, 323 (1997), applied to a slope). */
static size_t find_beginning(const struct cells *c, size_t *count)
{
    const size_t all = c->end > c->first ? (c->end - c->first + c->cell - 1) / c->cell : 0;
    struct line line = {0};
    double least = INFINITY;
    size_t best = c->first;
    for (size_t i = all; i-- > 0;) {
        const size_t k = c->first + i * c->cell;
        double y = cell_force(c->m, k, c->cell);
        if (!isfinite(y))
            continue;
        add_point(&line, (double)k, y);
        if (line.n < FEWEST || (i > 0 && k > c->latest) || !(standard_error(&line) < least))
            continue;
        least = standard_error(&line);
        best = k;
    }
    *count = (size_t)line.n;
    return best;
}

/* Forces are proportional to a power of the energy below one: an energy error that grows with time looks like a decay. */
static double energy_part(const struct bead_outcome *outcome, size_t contacts)
{
    return outcome && isfinite(outcome->energy_error) ? outcome->energy_error / (double)contacts : 0;
}

struct bead_decay_found bead_decay_find(const struct bead_measures *m, const struct bead_outcome *outcome)
{
    struct cells c = {.m = m, .first = MARGIN, .cell = usual_cell(m->chain)};
    const size_t links = m->places.links, margin = MARGIN + (1 + MARGIN_CELLS) * c.cell;
    struct bead_decay_found found = {.rate = NAN, .error = NAN};
    size_t count = 0;
    c.end = links + 1 > margin ? links + 1 - margin : 0;
    /* Following White, leave out at most half of the contacts, and no defect: a force lost at a defect is not a transient. */
    const size_t head = bead_places_head(m->chain, c.cell), half = c.first + (c.end > c.first ? c.end - c.first : 0) / 2;
    const bool regular = head + 1 >= bead_chain_beads(m->chain);
    c.latest = head < half ? head : half;
    found.first = find_beginning(&c, &count);
    if (count < FEWEST)
        return found;
    const struct line whole = fit(&c, found.first, c.end);
    size_t middle = found.first + (c.end - found.first) / c.cell / 2 * c.cell;
    const struct line near = fit(&c, found.first, middle), far = fit(&c, middle, c.end);
    found.last = found.first + (c.end - 1 - found.first) / c.cell * c.cell + c.cell - 1;
    found.rate = -whole.xy / whole.xx;
    /* With disorder both halves scatter around the rate; without it they differ by the rest of the transient. */
    const double halves = fabs(near.xy / near.xx - far.xy / far.xx);
    found.error = fmax(sure * standard_error(&whole), regular ? halves : 0.5 * halves);
    found.error = fmax(found.error, energy_part(outcome, found.last - found.first));
    found.seen = fabs(found.rate) > found.error;
    return found;
}
