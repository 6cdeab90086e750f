/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of outputs, in the order of their enum, and what everybody asks of them. */
#include "sim/scene/output_kinds.h"

#include <string.h>
#include <strings.h>

#include "sim/scene/scene_output.h"

#define TYPE_DECLARED(ID, name) extern const struct bead_output_type bead_##name##_output;
BEAD_OUTPUTS(TYPE_DECLARED)
#define TYPE_LISTED(ID, name) &bead_##name##_output,
static const struct bead_output_type *const types[BEAD_OUTPUT_KINDS] = {BEAD_OUTPUTS(TYPE_LISTED)};

const struct bead_output_type *bead_output_type(enum bead_output_kind kind)
{
    return types[kind];
}

static const struct bead_options *main_options(const struct bead_output_type *type)
{
    return type->options ? type->options : type->sweep_options;
}

const char *bead_output_key(enum bead_output_kind kind)
{
    return main_options(types[kind])->rows[0].key;
}

const char *bead_output_endings(enum bead_output_kind kind)
{
    return strchr(main_options(types[kind])->rows[0].shape, '.'); /* behind FILE */
}

bool bead_output_ends_like(const char *endings, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    for (const char *known = endings; dot && dot > base && known; known = strchr(known + 1, '.')) {
        if (strcspn(known, ", ") == strlen(dot) && strncasecmp(known, dot, strlen(dot)) == 0)
            return true;
    }
    return false;
}

const char *bead_output_second(const struct bead_output *output, const char **key)
{
    *key = output->trajectory.xdmf ? "xdmf" : "poster";
    const char *file = output->trajectory.xdmf ? output->trajectory.xdmf : output->movie.poster;
    return file ? file : "";
}

/* The kinds, those that sweeps have otherwise, and panels. */
static const struct bead_options *family_member(size_t index)
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
const struct bead_option_family bead_output_family = {"outputs", "outputs of kind", family_member};
