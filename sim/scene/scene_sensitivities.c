/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What sensitivities are wanted of, and where they cannot be had. */
#include <stdlib.h>

#include "sim/scene/scene_output.h"

static int ascending(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

BEAD_OUTPUT_READER(bead_output_read_contacts)
{
    static const struct bead_option number = {.type = BEAD_OPTION_COUNT, .low = 0, .high = BEAD_SCENE_BEADS};
    struct bead_curves_asked *curves = &((struct bead_output *)settings)->curves;
    char shown[64];
    const bool one = at->node->kind == BEAD_NODE_SCALAR;
    const size_t count = one ? 1 : at->node->count;
    if (at->node->kind == BEAD_NODE_MAP || count == 0)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    curves->contacts = calloc(count, sizeof *curves->contacts);
    if (!curves->contacts)
        return bead_no_memory(reader);
    for (size_t i = 0; i < count; i++) {
        struct bead_at element = {at, NULL, i, one ? at->node : at->node->items[i]};
        double value = 0;
        enum bead_error err = bead_read_number(reader, one ? at : &element, &number, &value);
        if (err)
            return err;
        curves->contacts[i] = (size_t)value;
    }
    qsort(curves->contacts, count, sizeof *curves->contacts, ascending);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || curves->contacts[i] != curves->contacts[i - 1])
            curves->contacts[curves->contact_count++] = curves->contacts[i];
    }
    return BEAD_OK;
}

/* Every contact must be one of some chain. */
static enum bead_error check_contacts(const struct bead_reader *reader, const struct bead_at *at,
                                      const struct bead_curves_asked *curves)
{
    const struct bead_scene *scene = reader->scene;
    const struct bead_at where = bead_at_key(at, "contacts");
    size_t contacts = 0;
    for (size_t c = 0; c < scene->chain_count; c++) {
        const size_t own = bead_scene_count_beads(&scene->chains[c]) + (scene->chains[c].wall != BEAD_WALL_NONE);
        contacts = own > contacts ? own : contacts;
    }
    for (size_t i = 0; i < curves->contact_count; i++) {
        if (curves->contacts[i] >= contacts)
            return bead_wrong(reader, &where, "has %zu, but the last contact is %zu", curves->contacts[i], contacts - 1);
    }
    return BEAD_OK;
}

bool bead_scene_tolerances(const struct bead_scene *scene)
{
    bool any = false;
    for (size_t i = 0; i < scene->material_count; i++)
        any = any || scene->materials[i].radius_tolerance > 0 || scene->materials[i].modulus_tolerance > 0;
    return any;
}

/* A damped contact's force jumps as it closes: the derivatives of what follows would jump with it. */
static enum bead_error check_damping(const struct bead_reader *reader, const struct bead_at *where, const char *what)
{
    const struct bead_scene *scene = reader->scene;
    for (size_t c = 0; c < scene->chain_count; c++) {
        const struct bead_chain_spec *chain = &scene->chains[c];
        if (chain->damping_coefficient > 0)
            return bead_wrong(reader, where,
                              "%s cannot be had of chain%s%s: it has `damping`, whose forces jump when contacts close", what,
                              chain->name && *chain->name ? " " : "", chain->name ? chain->name : "");
    }
    return BEAD_OK;
}

BEAD_OUTPUT_CHECK(bead_output_check_sensitivities)
{
    const enum bead_show show = output->curves.show;
    const bool peaks = show == BEAD_SHOW_PEAKS || show == BEAD_SHOW_BEAD_PEAKS;
    const struct bead_at where = bead_at_key(at, show == BEAD_SHOW_PEAKS ? "table" : "show");
    if (show == BEAD_SHOW_SENSITIVITIES) {
        enum bead_error err = check_damping(reader, &where, "sensitivities");
        return err ? err : check_contacts(reader, at, &output->curves);
    }
    return peaks && bead_scene_tolerances(reader->scene)
               ? check_damping(reader, &where, "the deviations of peaks that follow from `tolerance`")
               : BEAD_OK;
}
