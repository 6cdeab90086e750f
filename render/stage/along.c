/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places along a chain, from the borders between beads, or from the centres that contacts lie between. */
#include "render/stage/along.h"

#include <math.h>

#include "render/stage/panel.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

static const double apart = 0.5 /* radii */, narrowest = 2 /* px */;

static bool of_contacts(const struct bead_view_setup *setup)
{
    return bead_field_info(setup->field)->of_contacts;
}

bool bead_along_fixed(const struct bead_view_setup *setup)
{
    const struct bead_chain_spec *spec = bead_chain_spec(setup->chain);
    return !spec->system->has_contacts && spec->system->has_masses && spec->equation.ends == BEAD_ENDS_FIXED &&
           setup->beads.first == 0 && setup->beads.last + 1 == bead_chain_beads(setup->chain) && !setup->camera && !setup->trust;
}

/* Places between the outermost bead and its end. */
static double end_places(const struct bead_view_setup *setup)
{
    return bead_along_fixed(setup) ? 1 : 0.5;
}

/* From the centre of an outermost bead to the end of the chain there: points of strings have no size. */
static double end_room(const struct bead_view_setup *setup, size_t bead)
{
    if (bead_chain_spec(setup->chain)->system->has_contacts)
        return bead_chain_radius(setup->chain)[bead];
    return end_places(setup) * bead_chain_axis(setup->chain, false).spacing;
}

double bead_along_border(const struct bead_view_setup *setup, size_t number)
{
    const double *position = bead_chain_position(setup->chain), *radius = bead_chain_radius(setup->chain);
    const size_t beads = bead_chain_beads(setup->chain);
    if (of_contacts(setup))
        return number < beads ? position[number] : position[number - 1] + radius[number - 1];
    if (number == setup->beads.first)
        return position[number] - end_room(setup, number);
    if (number > setup->beads.last)
        return position[number - 1] + end_room(setup, number - 1);
    return 0.5 * (position[number - 1] + radius[number - 1] + position[number] - radius[number]);
}

static double length_of(const struct bead_view_setup *setup)
{
    return bead_along_border(setup, setup->beads.last + 1) - bead_along_border(setup, setup->beads.first);
}

bool bead_along_uneven(const struct bead_view_setup *setup, double length)
{
    const size_t first = setup->beads.first, last = setup->beads.last, beads = bead_chain_beads(setup->chain);
    if (bead_along_fixed(setup))
        return true;
    if (!setup->over_beads || setup->camera || setup->trust || last >= beads)
        return false;
    const double *radius = bead_chain_radius(setup->chain);
    const double whole = length_of(setup), begin = bead_along_border(setup, first), mean = whole / (double)(last - first + 1);
    bool uneven = false;
    for (size_t j = first; j <= last; j++) {
        const double left = bead_along_border(setup, j), right = bead_along_border(setup, j + 1);
        const double even = begin + ((double)(j - first) + 0.5) * mean;
        if (!(right - left >= narrowest * whole / length))
            return false;
        uneven = uneven || fabs(0.5 * (left + right) - even) > apart * radius[j];
    }
    return uneven;
}

/* 0..1 of a bead's centre, from border to border of the outermost; and its radius. */
static double part_of(const struct bead_view_setup *setup, size_t bead, double *radius)
{
    const double *position = bead_chain_position(setup->chain), *r = bead_chain_radius(setup->chain);
    const size_t first = setup->beads.first, last = setup->beads.last;
    const double begin = position[first] - r[first], length = position[last] + r[last] - begin;
    *radius = r[bead] / length;
    return (position[bead] - begin) / length;
}

bool bead_along_alike(const struct bead_view_setup *setup, const struct bead_view_setup *other)
{
    bool alike = setup->beads.first == other->beads.first && setup->beads.last == other->beads.last;
    for (size_t j = setup->beads.first; setup->over_beads && alike && j <= setup->beads.last; j++) {
        double radius, others;
        const double from = part_of(setup, j, &radius), to = part_of(other, j, &others);
        alike = !(fabs(from - to) > apart * fmin(radius, others));
    }
    return alike;
}

double bead_along_place(const struct bead_view_setup *setup, double number)
{
    const double *position = bead_chain_position(setup->chain), first = (double)setup->beads.first,
                 last = (double)setup->beads.last;
    const double begin = bead_along_border(setup, setup->beads.first);
    double at = fmin(last + 1, fmax(first, number + 0.5)), whole = fmin(last, floor(at));
    double left = bead_along_border(setup, (size_t)whole), right = bead_along_border(setup, (size_t)whole + 1);
    if (!of_contacts(setup)) { /* between centres; beyond the outermost to the ends */
        const double ends = end_places(setup);
        whole = fmin(last, fmax(first - 1, floor(number)));
        at = fmin(last + ends, fmax(first - ends, number));
        left = whole < first ? begin : position[(size_t)whole];
        right = whole < last ? position[(size_t)(whole + 1)] : bead_along_border(setup, setup->beads.last + 1);
        at = whole < first ? whole + 1 + (at - first) / ends : whole < last ? at : whole + (at - last) / ends;
    }
    return (left + (at - whole) * (right - left) - begin) / length_of(setup);
}

/* The width of the narrowest place in units of the mean: labels that fit there fit everywhere. */
static double least_part(const struct bead_view_setup *setup)
{
    double least = INFINITY;
    for (size_t j = setup->beads.first; j <= setup->beads.last; j++)
        least = fmin(least, bead_along_border(setup, j + 1) - bead_along_border(setup, j));
    return least * (double)(setup->beads.last - setup->beads.first + 1) / length_of(setup);
}

const char *bead_along_axis(struct bead_axis *axis, const struct bead_view_setup *setup, double length, double em, bool horizontal)
{
    const bool fixed = bead_along_fixed(setup), uneven = !fixed && bead_along_uneven(setup, length); /* outlines have no beads */
    const char *title = bead_axis_along_chain(axis, setup->chain, of_contacts(setup), setup->beads.first, setup->beads.last,
                                              uneven ? fmax(4 * em, length * least_part(setup)) : length, em, horizontal);
    const double span = axis->high - axis->low;
    if (fixed) { /* even, from end to end */
        const struct bead_chain_axis along = bead_chain_axis(setup->chain, false);
        bead_axis_make(axis, axis->low - 0.5 * along.spacing, axis->high + 0.5 * along.spacing, along.unit, BEAD_SCALE_LINEAR,
                       length, em, horizontal);
        return title;
    }
    for (size_t i = 0; uneven && i < axis->count; i++)
        axis->ticks[i].place = bead_along_place(setup, axis->ticks[i].value);
    for (size_t i = 0; uneven && i < axis->minor_count; i++)
        axis->minor[i] = bead_along_place(setup, axis->low + axis->minor[i] * span);
    return title;
}
