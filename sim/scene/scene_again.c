/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One output of a scene as a list of its own: what `-o FILE` asks for. */
#include <stdlib.h>
#include <string.h>

#include "sim/scene/scene_output.h"

/* The entry of output number `index`; NULL: no memory. */
static struct bead_node *entry_at(struct bead_yaml *yaml, size_t index)
{
    const struct bead_node *list = bead_node_get(bead_yaml_root(yaml), "outputs", NULL);
    const struct bead_reader reader = {.yaml = yaml};
    for (size_t i = 0; list && i < list->count; i++) {
        const size_t files = bead_output_files(list->items[i]);
        if (index < files)
            return bead_output_entry(&reader, list->items[i], index);
        index -= files;
    }
    return NULL;
}

enum bead_error bead_scene_single_output(const struct bead_scene *scene, size_t index, char **outputs, struct bead_message *msg)
{
    struct bead_yaml *yaml = NULL;
    *outputs = NULL;
    enum bead_error err = bead_yaml_parse(scene->file, scene->text, strlen(scene->text), &yaml, msg);
    if (err)
        return err;
    struct bead_node *root = bead_yaml_root(yaml), *entry = entry_at(yaml, index),
                     *list = bead_yaml_node(yaml, BEAD_NODE_LIST, root->place);
    if (entry && list && bead_yaml_append(yaml, list, entry)) {
        list->flow = true;
        *root = *list; /* the document is only written from here on */
        err = bead_yaml_emit(yaml, outputs, msg);
    } else {
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", scene->file);
    }
    bead_yaml_free(yaml);
    return err;
}
