/* An output that names several files is as many outputs: {plot: [a.pdf, a.png], ...}. */
#include "sim/scene/scene_output.h"

static const char *const kinds[] = {"trajectory", "image", "movie", "plot", "table", "sweep", "sheet"};

/* Place in the map of the list of files; 0: there is none. */
static size_t find_list(const struct bead_node *entry)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct bead_node *key = NULL, *value = bead_node_get(entry, kinds[k], &key);
        for (size_t i = 0; value && value->kind == BEAD_NODE_LIST && i + 1 < entry->count; i += 2) {
            if (entry->items[i] == key)
                return i + 1;
        }
    }
    return 0;
}

size_t bead_output_files(const struct bead_node *entry)
{
    size_t list = find_list(entry);
    return list ? entry->items[list]->count : 1;
}

struct bead_node *bead_output_of_file(const struct bead_reader *reader, struct bead_node *entry, size_t file)
{
    size_t list = find_list(entry);
    if (!list)
        return entry;
    struct bead_node *single = bead_yaml_node(reader->yaml, BEAD_NODE_MAP, entry->place);
    if (!single)
        return NULL;
    single->setting = entry->setting;
    for (size_t i = 0; i < entry->count; i++) {
        if (!bead_yaml_append(reader->yaml, single, i == list ? entry->items[i]->items[file] : entry->items[i]))
            return NULL;
    }
    return single;
}
