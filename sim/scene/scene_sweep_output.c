/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of outputs that only sweeps have, or that a sweep must fit. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/statistics.h"
#include "sim/base/suggest.h"
#include "sim/scene/scene_output.h"

/* Cells are whole numbers: magnetisms asked for may be this far off. */
static const double sheet_near = 0.05;

enum bead_error bead_output_check_sweep(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_output *outputs = scene->outputs;
    const struct bead_output_type *type = bead_output_type(outputs[index].kind);
    struct bead_at where = bead_at_key(at, bead_output_key(outputs[index].kind));
    if (!type->options && scene->sweep_count == 0)
        return bead_wrong(reader, &where, "needs a sweep: the scene has neither `sweep` nor `sweeps`");
    if (scene->sweep_count > 0 && !type->sweep_options)
        return bead_wrong(reader, &where,
                          "shows a single run, and a sweep has many; must be sweep, sheet, plot, table or report (--configuration "
                          "N shows one run of a "
                          "sweep's file)");
    for (size_t i = 0; i < index && type->stores_sweep; i++) {
        if (outputs[i].kind == outputs[index].kind)
            return bead_wrong(reader, &where, "is a second file of the same results; one is enough");
    }
    return BEAD_OK;
}

/* A row of a sheet must be a magnetism of one of the sweeps. */
BEAD_OUTPUT_CHECK(bead_output_check_sheet)
{
    enum bead_error err = bead_output_check_field(reader, at, output);
    if (err)
        return err;
    struct bead_at list = bead_at_key(at, "magnetism");
    for (size_t i = 0; i < output->sheet.magnetism_count; i++) {
        double nearest = INFINITY;
        for (size_t s = 0; s < reader->scene->sweep_count; s++) {
            for (size_t g = 0; g < reader->scene->sweeps[s].group_count; g++) {
                double m = reader->scene->sweeps[s].groups[g].magnetism;
                if (fabs(m - output->sheet.magnetism[i]) < fabs(nearest - output->sheet.magnetism[i]))
                    nearest = m;
            }
        }
        bool single = list.node->kind == BEAD_NODE_SCALAR;
        struct bead_at element = {&list, NULL, i, single ? list.node : list.node->items[i]};
        if (!isfinite(nearest))
            return bead_wrong(reader, &list, "is given, but the sweep has no magnetisms to choose from");
        if (fabs(nearest - output->sheet.magnetism[i]) > sheet_near)
            return bead_wrong(reader, single ? &list : &element, "is %g; the nearest of the sweep is %.4g",
                              output->sheet.magnetism[i], nearest);
    }
    return BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_sweep_curves)
{
    const bool decay = output->sweep_curves.show == BEAD_SWEEP_DECAY;
    struct bead_at where = bead_at_key(at, "show"), range = bead_at_key(at, "range");
    if (decay && output->plot.range[0] <= 0)
        return bead_wrong(reader, &range, "begins at %g; must be above 0: the axes of decay are logarithmic",
                          output->plot.range[0]);
    for (size_t i = 0; i < reader->scene->sweep_count; i++) {
        const struct bead_sweep_spec *sweep = &reader->scene->sweeps[i];
        if (decay && !sweep->measures.decay)
            return bead_wrong(reader, &where, "decay is not measured; must have `measure: {decay: true}` in every sweep");
        if (!decay && !sweep->measures.peak)
            return bead_wrong(reader, &where, "peaks are not measured (measure: {peak: none}); must be decay");
    }
    return BEAD_OK;
}

BEAD_OUTPUT_READER(bead_output_read_threshold)
{
    struct bead_output *output = settings;
    const struct bead_threshold_info *info;
    const char *text = NULL;
    char all[120] = "", shown[64], near[96];
    struct bead_suggest search;
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &text);
    if (err)
        return err;
    bead_suggest_begin(&search, text);
    for (size_t i = 0; (info = bead_threshold_info(i)); i++) {
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", info->name);
        bead_suggest_try(&search, info->name);
        if (strcmp(info->name, text) == 0) {
            free(output->sweep_curves.threshold);
            output->sweep_curves.threshold = strdup(text);
            return output->sweep_curves.threshold ? BEAD_OK : bead_no_memory(reader);
        }
    }
    return bead_wrong(reader, at, "is %s; must be %s%s", bead_node_show(at->node, shown, sizeof shown), all,
                      bead_suggest_text(&search, near, sizeof near));
}

BEAD_OUTPUT_READER(bead_output_read_magnetism)
{
    static const struct bead_option number = {.low = 0, .high = 1};
    struct bead_output *output = settings;
    char shown[64];
    bool one = at->node->kind == BEAD_NODE_SCALAR;
    size_t count = one ? 1 : at->node->count;
    if (one && strcmp(at->node->text, "auto") == 0)
        return BEAD_OK;
    if (at->node->kind == BEAD_NODE_MAP || count == 0)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    output->sheet.magnetism = calloc(count, sizeof *output->sheet.magnetism);
    if (!output->sheet.magnetism)
        return bead_no_memory(reader);
    for (size_t i = 0; i < count; i++) {
        struct bead_at element = {at, NULL, i, one ? at->node : at->node->items[i]};
        enum bead_error err = bead_read_number(reader, one ? at : &element, &number, &output->sheet.magnetism[i]);
        if (err)
            return err;
    }
    output->sheet.magnetism_count = count;
    return BEAD_OK;
}
