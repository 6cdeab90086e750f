/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of YAML documents, shared by yaml*.c. */
#pragma once

#include "sim/yaml/yaml.h"

struct bead_yaml_chunk {
    struct bead_yaml_chunk *next;
    size_t size, used;
    _Alignas(16) unsigned char bytes[];
};

struct bead_yaml {
    char *name;
    struct bead_node *root;
    struct bead_node *files; /* a list of the names of files of which it has parts; NULL: none */
    struct bead_yaml_chunk *chunks;
    size_t nodes;
    const char *origin; /* of nodes being made, as in bead_node */
};

/* Zeroed memory that lives as long as the document; NULL: out of memory. */
void *bead_yaml_take(struct bead_yaml *yaml, size_t size);
/* Levels of nodes: 1 for a scalar. */
size_t bead_yaml_height(const struct bead_node *node);
