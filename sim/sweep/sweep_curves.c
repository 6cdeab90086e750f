/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the curves of a sweep over keys: see sweep_curves.h. */
#include "sim/sweep/sweep_curves.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/places.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

static enum bead_error find_key(const struct bead_over *over, const char *against, size_t *key, struct bead_message *msg)
{
    *key = 0;
    while (*key < over->key_count && (*against ? strcmp(over->keys[*key].path, against) != 0 : over->keys[*key].seed))
        (*key)++;
    if (*key < over->key_count)
        return BEAD_OK;
    *key = 0; /* nothing but seeds */
    return *against ? bead_fail(msg, BEAD_ERROR_USAGE, "against: `%s` is no key of the sweep; the first is `%s`", against,
                                over->keys[0].path)
                    : BEAD_OK;
}

size_t bead_sweep_curve_of(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key)
{
    const struct bead_over *over = &bead_sweep_panel(sweep, panel)->spec->over;
    size_t number = 0;
    for (size_t k = 0; k < over->key_count && over->combine == BEAD_COMBINE_GRID; k++) {
        if (k != key && !over->keys[k].seed)
            number = number * over->keys[k].count + bead_sweep_value(sweep, panel, index, k);
    }
    return number;
}

/* The beginning of the part of a path before this one; a number belongs to the part that it counts. */
static const char *part_before(const char *path, const char *part)
{
    do {
        for (part--; part > path && part[-1] != '.'; part--)
            ;
    } while (part > path && isdigit((unsigned char)*part));
    return part;
}

/* Does no other key's path end like this? */
static bool is_own(const struct bead_over *over, size_t key, const char *end)
{
    const size_t length = strlen(end);
    bool own = true;
    for (size_t k = 0; k < over->key_count; k++) {
        const char *path = over->keys[k].path;
        const size_t all = strlen(path);
        own = own && (k == key || all <= length || path[all - length - 1] != '.' || strcmp(path + all - length, end) != 0);
    }
    return own;
}

void bead_over_key_name(const struct bead_over *over, size_t key, bool whose, char *text, size_t size)
{
    const char *path = over->keys[key].path, *dot = strrchr(path, '.'), *from = dot ? dot + 1 : path, *part = from;
    for (part = from > path ? part - 1 : part; part > path && part[-1] != '.'; part--)
        ;
    if (whose && part > path && !isdigit((unsigned char)*part))
        from = part;
    while (from > path && !is_own(over, key, from))
        from = part_before(path, from);
    snprintf(text, size, "%s", from);
    for (char *c = text; *c; c++)
        *c = *c == '.' ? ' ' : *c;
}

void bead_sweep_curve_name(const struct bead_sweep *sweep, size_t panel, size_t index, size_t key, char name[200])
{
    const struct bead_over *over = &bead_sweep_panel(sweep, panel)->spec->over;
    for (size_t k = 0; k < over->key_count && over->combine == BEAD_COMBINE_GRID; k++) {
        const struct bead_over_key *of = &over->keys[k];
        const size_t used = strlen(name), value = bead_sweep_value(sweep, panel, index, k);
        char key_name[150];
        if (k == key || of->seed)
            continue;
        bead_over_key_name(over, k, false, key_name, sizeof key_name);
        char *unit = of->text[value], number[32] = "";
        if (of->digits > 0 && value > 0 && value + 1 < of->count) /* the ends stay as written */
            snprintf(number, sizeof number, "%.*g", of->digits, strtod(of->text[value], &unit));
        snprintf(name + used, 200 - used, "%s%s %s%s", used ? ", " : "", key_name, number, unit);
    }
}

static int by_x(const void *a, const void *b)
{
    const struct bead_sweep_point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->value > q->value) - (p->value < q->value);
}

/* Fits a straight line to the logarithms of the means. `room`: for two numbers of each point. */
static void fit_slope(struct bead_sweep_curve *curve, double *room)
{
    double *x = room, *y = room + curve->count, off_by = 0;
    for (size_t i = 0; i < curve->count; i++) {
        x[i] = bead_log(curve->points[i].x);
        y[i] = bead_log(curve->points[i].summary.mean);
    }
    const struct bead_line line = bead_line_of(x, y, curve->count);
    for (size_t i = 0; i < curve->count; i++)
        off_by += fabs(x[i] - line.centre) * curve->points[i].uncertainty.mean / curve->points[i].summary.mean;
    curve->slope = line.slope;
    curve->slope_error = line.error;
    curve->offset = line.offset;
    curve->slope_uncertainty = off_by / line.spread; /* the slope is linear in the logarithms */
}

/* The values of a point, by how much each may be off, and room for as many numbers. */
struct gathered {
    double *value, *off, *room; /* [configurations] */
    size_t count;
};

/* Gathers configuration i if its result is known: one of `values`, or its peak force. */
static void gather(const struct bead_sweep *sweep, size_t panel, size_t place, const struct bead_sweep_values *values, size_t i,
                   double worst, struct gathered *g)
{
    struct bead_sweep_configuration found;
    if (values && isfinite(values->value[i])) {
        g->value[g->count] = values->value[i];
        g->off[g->count++] = values->uncertainty[i];
    } else if (!values && bead_sweep_configuration(sweep, panel, i, &found)) {
        const struct bead_sweep_peak *peak = &found.peaks[place];
        g->value[g->count] = peak->force;
        g->off[g->count++] = peak->uncertainty > 0 ? peak->uncertainty : worst * peak->force;
    }
}

/* Fills in all points of one curve: the known results of each value along the axis. */
static enum bead_error fill(const struct bead_sweep *sweep, size_t panel, size_t place, const struct bead_sweep_values *values,
                            size_t number, size_t key, struct bead_sweep_curve *curve, struct bead_message *msg)
{
    const struct bead_sweep_panel *shown = bead_sweep_panel(sweep, panel);
    const struct bead_over_key *along = &shown->spec->over.keys[key];
    const double worst = values ? NAN : bead_sweep_uncertainty(sweep, panel, place);
    const size_t all = shown->configurations;
    BEAD_FREED double *memory = NULL;
    BEAD_TRY(bead_new(&curve->points, along->count, msg, "the curves of a sweep"));
    BEAD_TRY(bead_new(&memory, 3 * all, msg, "the curves of a sweep"));
    struct gathered g = {memory, memory + all, memory + 2 * all, 0};
    for (size_t value = 0; value < along->count; value++) {
        g.count = 0;
        for (size_t i = 0; i < all; i++) {
            if (bead_sweep_value(sweep, panel, i, key) != value || bead_sweep_curve_of(sweep, panel, i, key) != number)
                continue;
            if (!*curve->name)
                bead_sweep_curve_name(sweep, panel, i, key, curve->name);
            gather(sweep, panel, place, values, i, worst, &g);
        }
        if (g.count == 0)
            continue;
        struct bead_sweep_point *point = &curve->points[curve->count++];
        *point = (struct bead_sweep_point){.value = value, .x = isnan(along->value[value]) ? (double)value : along->value[value]};
        bead_summary_uncertainty(g.value, g.off, g.count, g.room, &point->uncertainty);
        bead_summary_of(g.value, g.count, &point->summary);
    }
    qsort(curve->points, curve->count, sizeof *curve->points, by_x);
    fit_slope(curve, memory);
    return BEAD_OK;
}

enum bead_error bead_sweep_curves_find(const struct bead_sweep *sweep, size_t panel, size_t place,
                                       const struct bead_sweep_values *values, const char *against,
                                       struct bead_sweep_curves *curves, struct bead_message *msg)
{
    const struct bead_sweep_panel *shown = bead_sweep_panel(sweep, panel);
    size_t count = 1;
    *curves = (struct bead_sweep_curves){.count = 0};
    BEAD_TRY(find_key(&shown->spec->over, against, &curves->key, msg));
    for (size_t i = 0; i < shown->configurations; i++) {
        const size_t number = bead_sweep_curve_of(sweep, panel, i, curves->key);
        count = number >= count ? number + 1 : count;
    }
    BEAD_TRY(bead_new(&curves->curves, count, msg, "the curves of a sweep"));
    while (curves->count < count) {
        const size_t i = curves->count++;
        BEAD_TRY(fill(sweep, panel, place, values, i, curves->key, &curves->curves[i], msg));
    }
    return BEAD_OK;
}

void bead_sweep_curves_free(struct bead_sweep_curves *curves)
{
    for (size_t i = 0; curves->curves && i < curves->count; i++)
        free(curves->curves[i].points);
    free(curves->curves);
}

/* Outputs, and the beads of the first chain. */
struct looked {
    const struct bead_output *const *outputs;
    size_t count, beads;
};

static bool is_of_chains(const struct bead_output *output)
{
    return output->kind == BEAD_OUTPUT_IMAGE || bead_sweep_lines(output->sweep_curves.show) != BEAD_SHOW_COUNT;
}

/* Have the chains the places of curves, and are those of equal length whose means are taken in space? */
static enum bead_error check_chain(void *context, const struct bead_chain *chain, size_t index, struct bead_message *msg)
{
    struct looked *looked = context;
    looked->beads = index == 0 ? bead_chain_beads(chain) : looked->beads;
    for (size_t i = 0; i < looked->count; i++) {
        const struct bead_output *output = looked->outputs[i];
        const bool image = output->kind == BEAD_OUTPUT_IMAGE;
        if (!is_of_chains(output))
            continue;
        if ((image || output->curves.show == BEAD_SHOW_DISPERSION) && bead_chain_beads(chain) != looked->beads)
            return bead_output_wrong(output, msg, "show: chains have %zu and %zu beads; a mean needs chains of equal length",
                                     looked->beads, bead_chain_beads(chain));
        BEAD_TRY(image ? BEAD_OK : bead_places_check(output, chain, msg));
    }
    return BEAD_OK;
}

static enum bead_error check_words(const struct bead_over *over, const struct bead_output *output, struct bead_message *msg)
{
    const struct bead_sweep_curves_asked *asked = &output->sweep_curves;
    const char *unit;
    size_t key;
    struct bead_message why = {""};
    enum bead_error err = BEAD_OK;
    if (asked->measure && *asked->measure)
        err = bead_sweep_measure_unit(asked->measure, &unit, &why);
    if (!err && asked->against && *asked->against && over->key_count > 0)
        err = find_key(over, asked->against, &key, &why);
    return err ? bead_output_wrong(output, msg, "%s", why.text) : BEAD_OK;
}

enum bead_error bead_sweep_asked_check(const struct bead_sweep *sweep, const struct bead_output *const *outputs, size_t count,
                                       struct bead_message *msg)
{
    const struct bead_over *over = &bead_sweep_panel(sweep, 0)->spec->over;
    bool of_chains = false;
    for (size_t i = 0; i < count; i++) {
        BEAD_TRY(check_words(over, outputs[i], msg));
        of_chains = of_chains || (over->key_count > 0 && is_of_chains(outputs[i]));
    }
    return of_chains ? bead_sweep_try(sweep, check_chain, &(struct looked){outputs, count, 0}, msg) : BEAD_OK;
}
