/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The configurations of a sweep: groups of one magnetism, from `magnetism` or `spins` and the random cells of its chain. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/chain/spins.h"
#include "sim/scene/scene_private.h"

/* Cells of the pattern: random ones, and those that count for the magnetism besides. */
struct cells {
    size_t random, given, up; /* given, up: that are not random */
};

static struct cells count_cells(const struct bead_chain_spec *chain, struct bead_sweep_spec *sweep)
{
    struct cells cells = {0, 0, 0};
    size_t bead = 0;
    for (size_t s = 0; s < chain->segment_count; s++) {
        const struct bead_segment *segment = &chain->segments[s];
        bead += segment->count * segment->cell_beads;
        if (segment->spins == BEAD_SPINS_RANDOM) {
            cells.random += segment->count;
            sweep->last = bead;
        } else if (segment->spins_given && segment->cell_beads > 1) {
            cells.given += segment->count;
            cells.up += segment->spins == BEAD_SPINS_UP ? segment->count : 0;
            for (size_t i = 0; segment->digits && i < segment->count; i++)
                cells.up += segment->digits[i] == '1';
        }
    }
    return cells;
}

static enum bead_error make_groups(const struct bead_reader *reader, struct bead_sweep_spec *sweep, size_t count)
{
    sweep->groups = calloc(count + 1, sizeof *sweep->groups);
    return sweep->groups ? BEAD_OK : bead_no_memory(reader);
}

/* The group with `total` of all cells up; false: the fixed ones do not allow it. */
static bool add_group(struct bead_sweep_spec *sweep, const struct cells *cells, size_t total)
{
    double all = (double)(cells->random + cells->given);
    if (total < cells->up || total - cells->up > cells->random)
        return false;
    size_t up = total - cells->up;
    bool one_way = up == 0 || up == cells->random;
    sweep->groups[sweep->group_count++] =
        (struct bead_sweep_group){(2 * (double)total - all) / all, up, one_way ? 1 : sweep->configurations};
    return true;
}

static enum bead_error all_groups(const struct bead_reader *reader, struct bead_sweep_spec *sweep, const struct cells *cells)
{
    size_t all = cells->random + cells->given;
    enum bead_error err = make_groups(reader, sweep, all / 2 + 1);
    for (size_t total = (all + 1) / 2; total <= all && !err; total++)
        add_group(sweep, cells, total);
    return err;
}

static int by_magnetism(const void *a, const void *b)
{
    const struct bead_sweep_group *p = a, *q = b;
    return (p->up > q->up) - (p->up < q->up);
}

static enum bead_error list_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep,
                                   const struct cells *cells)
{
    static const struct bead_option number = {.low = 0, .high = 1};
    bool list = at->node->kind == BEAD_NODE_LIST;
    size_t count = list ? at->node->count : 1, all = cells->random + cells->given;
    if (count == 0)
        return bead_wrong(reader, at, "is an empty list; must be all, a number, or a list of numbers from 0 to 1");
    enum bead_error err = make_groups(reader, sweep, count);
    for (size_t i = 0; i < count && !err; i++) {
        struct bead_at element = {at, NULL, i, list ? at->node->items[i] : at->node};
        const struct bead_at *where = list ? &element : at;
        double magnetism = 0;
        err = bead_read_number(reader, where, &number, &magnetism);
        size_t total = bead_spins_up(all, magnetism);
        for (size_t k = 0; k < i && !err; k++) {
            if (sweep->groups[k].up + cells->up == total)
                err = bead_wrong(reader, where, "gives the same magnetism as another of the list, %.6g, with %zu cells",
                                 sweep->groups[k].magnetism, all);
        }
        if (!err && !add_group(sweep, cells, total))
            err = bead_wrong(reader, where, "is out of reach: of %zu cells %zu are fixed, %zu of these up", all, cells->given,
                             cells->up);
    }
    if (!err)
        qsort(sweep->groups, sweep->group_count, sizeof *sweep->groups, by_magnetism);
    return err;
}

/* One group of each configuration given. */
static enum bead_error given_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST || at->node->count == 0)
        return bead_wrong(reader, at, "is %s; must be a list such as [\"1101\", \"0110\"]",
                          at->node->kind == BEAD_NODE_LIST ? "empty" : bead_node_show(at->node, shown, sizeof shown));
    enum bead_error err = make_groups(reader, sweep, at->node->count);
    if (err || !(sweep->spins = calloc(at->node->count, sizeof *sweep->spins)))
        return err ? err : bead_no_memory(reader);
    for (size_t i = 0; i < at->node->count; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        const char *digits = NULL;
        err = bead_read_scalar(reader, &element, "one digit per random cell, 1 up and 0 down", &digits);
        if (err)
            return err;
        if (strspn(digits, "01") != strlen(digits))
            return bead_wrong(reader, &element, "is %s; must be digits 0 and 1", bead_node_show(element.node, shown, sizeof shown));
        if (strlen(digits) != sweep->cells)
            return bead_wrong(reader, &element, "has %zu digits; must have one for each of the %zu random cells", strlen(digits),
                              sweep->cells);
        size_t up = 0;
        for (size_t k = 0; k < sweep->cells; k++)
            up += digits[k] == '1';
        sweep->groups[sweep->group_count++] = (struct bead_sweep_group){NAN, up, 1};
        if (!(sweep->spins[i] = strdup(digits)))
            return bead_no_memory(reader);
    }
    return BEAD_OK;
}

enum bead_error bead_scene_read_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    struct cells cells = count_cells(&reader->scene->chains[sweep->chain], sweep);
    struct bead_at magnetism = bead_at_key(at, "magnetism"), spins = bead_at_key(at, "spins");
    bool has_magnetism = magnetism.node != at->node, has_spins = spins.node != at->node;
    sweep->cells = cells.random;
    if (cells.random == 0)
        return bead_wrong(reader, at, "finds no `spins: random` to draw in `chain`; give some, or `cells`");
    if (has_magnetism && has_spins)
        return bead_wrong(reader, &spins, "is given beside `magnetism`; give one of them");
    if (has_spins)
        return given_groups(reader, &spins, sweep);
    if (!has_magnetism && sweep->asked == 0) {
        enum bead_error err = make_groups(reader, sweep, 1);
        if (!err)
            sweep->groups[0] = (struct bead_sweep_group){NAN, SIZE_MAX, sweep->configurations};
        sweep->group_count = 1;
        sweep->own_magnetism = true;
        return err;
    }
    if (!has_magnetism || (magnetism.node->kind == BEAD_NODE_SCALAR && strcmp(magnetism.node->text, "all") == 0))
        return all_groups(reader, sweep, &cells);
    return list_groups(reader, &magnetism, sweep, &cells);
}
