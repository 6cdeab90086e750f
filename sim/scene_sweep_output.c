/* What outputs of sweeps have of their own. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/statistics.h"
#include "sim/scene_output.h"
#include "sim/suggest.h"

enum bead_error bead_output_check_sweep(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_output *outputs = scene->outputs;
    const enum bead_output_kind kind = outputs[index].kind;
    static const char *const keys[BEAD_OUTPUT_KINDS] = {"trajectory", "image", "movie", "plot", "table", "sweep"};
    struct bead_at where = bead_at_key(at, keys[kind]);
    bool of_sweeps = kind == BEAD_OUTPUT_SWEEP || kind == BEAD_OUTPUT_PLOT || kind == BEAD_OUTPUT_TABLE;
    if (kind == BEAD_OUTPUT_SWEEP && scene->sweep_count == 0)
        return bead_wrong(reader, &where, "needs a sweep: the scene has neither `sweep` nor `sweeps`");
    if (scene->sweep_count > 0 && !of_sweeps)
        return bead_wrong(
            reader, &where,
            "shows a single run, and a sweep has many; must be sweep, plot or table (--configuration N shows one run of a "
            "sweep's file)");
    for (size_t i = 0; i < index && kind == BEAD_OUTPUT_SWEEP; i++) {
        if (outputs[i].kind == BEAD_OUTPUT_SWEEP)
            return bead_wrong(reader, &where, "is a second file of the same results; one is enough");
    }
    return BEAD_OK;
}

enum bead_error bead_output_check_sweep_shown(const struct bead_reader *reader, const struct bead_at *at,
                                              const struct bead_output *output)
{
    struct bead_at where = bead_at_key(at, "show");
    if (output->kind == BEAD_OUTPUT_SWEEP)
        return BEAD_OK;
    for (size_t i = 0; i < reader->scene->sweep_count; i++) {
        const struct bead_sweep_spec *sweep = &reader->scene->sweeps[i];
        if (output->sweep_show == BEAD_SWEEP_DECAY && !sweep->measures.decay)
            return bead_wrong(reader, &where, "decay is not measured; must have `measure: {decay: true}` in every sweep");
        if (output->sweep_show != BEAD_SWEEP_DECAY && !sweep->measures.peak)
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
            free(output->threshold);
            output->threshold = strdup(text);
            return output->threshold ? BEAD_OK : bead_no_memory(reader);
        }
    }
    return bead_wrong(reader, at, "is %s; must be %s%s", bead_node_show(at->node, shown, sizeof shown), all,
                      bead_suggest_text(&search, near, sizeof near));
}
