/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `fit`: the keys of a scene whose values are found from measurements. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/scene/scene_private.h"

void bead_scene_naming(const char *naming[BEAD_NAMINGS])
{
    memset(naming, 0, BEAD_NAMINGS * sizeof *naming);
    naming[0] = "name";
    naming[1] = "sensor";
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
        naming[2 + kind] = bead_output_key(kind);
}

/* The value of a key must be a number: the search starts there. */
static enum bead_error read_key(const struct bead_reader *reader, const struct bead_at *at, struct bead_fit_key *key)
{
    const struct bead_node *node = NULL;
    const char *naming[BEAD_NAMINGS];
    struct bead_message unused;
    char why[200];
    BEAD_TRY(bead_read_text(reader, at, &key->path));
    bead_scene_naming(naming);
    enum bead_error err = bead_yaml_find(reader->yaml, key->path, naming, &node, &unused);
    if (err == BEAD_ERROR_MEMORY)
        return bead_no_memory(reader);
    if (err || node->kind != BEAD_NODE_SCALAR)
        return bead_wrong(reader, at, "the scene has no number `%s`: give it an initial value", key->path);
    if (!(key->unit = strdup(bead_scene_unit_of(reader, node->text))))
        return bead_no_memory(reader);
    if (bead_units_read(reader->units, node->text, *key->unit ? key->unit : "1", &key->first, why, sizeof why))
        return bead_wrong(reader, at, "`%s` is `%s`: %s", key->path, node->text, why);
    key->value = key->first;
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_scene_read_fit)
{
    struct bead_scene *scene = settings;
    struct bead_fit *fit = &scene->fit;
    size_t measured = 0;
    BEAD_TRY(bead_need_list(reader, at, option->shape, BEAD_FIT_KEYS, "keys"));
    if (scene->sweep_count > 0)
        return bead_wrong(reader, at, "is given beside a sweep: a fit finds one chain");
    for (size_t i = 0; i < scene->output_count; i++)
        measured += scene->outputs[i].curves.measured_count;
    if (measured == 0 && !reader->unsound)
        return bead_wrong(reader, at, "needs a plot with `measured`");
    BEAD_TRY(bead_new(&fit->keys, at->node->count, reader->msg, "a fit"));
    for (size_t i = 0; i < at->node->count; i++) {
        const struct bead_at item = bead_at_item(at, i);
        BEAD_TRY(read_key(reader, &item, &fit->keys[fit->count++]));
    }
    return BEAD_OK;
}

void bead_scene_free_fit(struct bead_fit *fit)
{
    for (size_t i = 0; i < fit->count; i++) {
        free(fit->keys[i].path);
        free(fit->keys[i].unit);
    }
    free(fit->keys);
}
