/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages about outputs that have been read: the tree of the scene has the place of each of their keys. */
#include "beadreel/scene.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/kinds/output_kinds.h"
#include "sim/yaml/yaml.h"

/* The value that `path` leads to, "captions.1.at"; as far as there is one. */
static const struct bead_node *find(const struct bead_node *node, const char *path)
{
    char key[32];
    for (const struct bead_node *next = node; next && *path; path += strspn(path, ".")) {
        const size_t length = strcspn(path, "."), index = (size_t)strtoul(path, NULL, 10);
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        next = node->kind != BEAD_NODE_LIST ? bead_node_get(node, key, NULL) : index < node->count ? node->items[index] : NULL;
        node = next ? next : node;
        path += length;
    }
    return node;
}

enum bead_error bead_output_wrong(const struct bead_output *output, struct bead_message *msg, const char *format, ...)
{
    char text[640], key[64];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    if (!output->node) /* made without a scene */
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s", text);
    snprintf(key, sizeof key, "%.*s", (int)strcspn(text, ":"), text);
    const struct bead_node *node = find(output->node, key);
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s", node->origin ? node->origin : output->file, node->place.line,
                     node->place.column, text);
}

enum bead_error bead_output_tell(const struct bead_output *output, enum bead_error err, const struct bead_message *why,
                                 struct bead_message *msg)
{
    if (err == BEAD_ERROR_SCENE)
        return bead_output_wrong(output, msg, "%.600s", why->text);
    return err ? bead_fail(msg, err, "%s", why->text) : BEAD_OK;
}
