/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of outputs, in the order of their enum, and queries of them. */
#include "sim/kinds/output_kinds.h"

#include "beadreel/sink.h"
#include "sim/kinds/outputs.h"

#define TYPE_DECLARED(ID, name) extern const struct bead_output_type bead_##name##_output;
BEAD_OUTPUTS(TYPE_DECLARED)
#define TYPE_LISTED(ID, name) &bead_##name##_output,
static const struct bead_output_type *const types[BEAD_OUTPUT_KINDS] = {BEAD_OUTPUTS(TYPE_LISTED)};

const struct bead_output_type *bead_output_type(enum bead_output_kind kind)
{
    return kind < BEAD_OUTPUT_KINDS ? types[kind] : &bead_own_output;
}

static const struct bead_options *main_options(const struct bead_output_type *type)
{
    return type->options ? type->options : type->sweep_options;
}

const char *bead_output_key(enum bead_output_kind kind)
{
    return main_options(bead_output_type(kind))->rows[0].key;
}

const char *bead_output_endings(enum bead_output_kind kind)
{
    return strchr(main_options(bead_output_type(kind))->rows[0].shape, '.'); /* behind FILE */
}

bool bead_output_made_of(enum bead_output_kind kind, enum bead_source_kind source)
{
    const struct bead_output_type *type = bead_output_type(kind);
    switch (source) {
    case BEAD_OF_TRAJECTORIES:
    case BEAD_OF_DIFFERENCE:
    case BEAD_OF_TRAJECTORY: /* a trajectory is not made from one */
        return type->options && !type->stores_samples;
    case BEAD_OF_SWEEP:
        return type->sweep_options;
    case BEAD_OF_CONFIGURATIONS:
        return type->shows_configurations;
    default:
        return type->options;
    }
}

bool bead_output_ending_means(enum bead_output_kind kind, enum bead_source_kind source)
{
    const bool several = source == BEAD_OF_SWEEP || source == BEAD_OF_TRAJECTORIES;
    return bead_output_made_of(kind, source) && !(several && bead_output_type(kind)->only_in_scenes);
}

enum bead_output_kind bead_output_kind_of(const char *file, enum bead_source_kind source)
{
    enum bead_output_kind kind = 0;
    if (source == BEAD_OF_TRAJECTORIES && bead_output_ends_like(bead_output_endings(BEAD_OUTPUT_PLOT), file))
        return BEAD_OUTPUT_PLOT; /* not a film of .png */
    while (kind < BEAD_OUTPUT_KINDS &&
           !(bead_output_ending_means(kind, source) && bead_output_ends_like(bead_output_endings(kind), file)))
        kind++;
    return kind;
}

const char *bead_output_second(const struct bead_output *output, const char **key)
{
    const char *slides = output->movie.slides && output->movie.slides[0] ? output->movie.slides : NULL;
    *key = output->trajectory.xdmf ? "xdmf" : slides ? "slides" : "poster";
    const char *file = output->trajectory.xdmf ? output->trajectory.xdmf : slides ? slides : output->movie.poster;
    return file ? file : "";
}

const struct bead_show_type *bead_output_show(const struct bead_output *output)
{
    return bead_output_type(output->kind)->shows ? bead_show_type(output->curves.show) : NULL;
}

const char *bead_output_kind_name(const struct bead_output *output)
{
    return output->own ? output->own->name : bead_output_key(output->kind);
}

/* The kinds, those with different keys in sweeps, and panels. */
const struct bead_options *bead_output_options(size_t index)
{
    static const struct bead_options *const panels[] = {&bead_image_panel_options, &bead_plot_panel_options};
    if (index < BEAD_OUTPUT_KINDS)
        return main_options(types[index]);
    index -= BEAD_OUTPUT_KINDS;
    for (size_t i = 0; i < BEAD_OUTPUT_KINDS; i++) {
        if (types[i]->options && types[i]->sweep_options && index-- == 0)
            return types[i]->sweep_options;
    }
    return index < 2 ? panels[index] : NULL;
}
