/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Copies the user's own settings that a scene uses into its document, so that the text stored in trajectories is complete:
 * materials that it names, style and font of outputs that give none, colours from files. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/waves.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

enum { MOST_COLOURS = 1024 };

struct own {
    struct bead_reader *reader;
    const struct bead_config *config; /* NULL: none */
    bool changed;
};

/* ---- materials ---- */

/* Is any value of the tree `name`, alone or after a count: `2 carbide`? */
static bool names(const struct bead_node *node, const char *name)
{
    bool any = false;
    if (node->kind == BEAD_NODE_SCALAR) {
        const char *text = node->text + strspn(node->text, "0123456789 ");
        return strcmp(node->text, name) == 0 || strcmp(text, name) == 0;
    }
    for (size_t i = node->kind == BEAD_NODE_MAP; i < node->count && !any; i += node->kind == BEAD_NODE_MAP ? 2 : 1)
        any = names(node->items[i], name);
    return any;
}

/* The map under `materials`, which is created if the scene has none; NULL: no memory. */
static struct bead_node *own_materials(struct bead_yaml *yaml)
{
    struct bead_node *root = bead_yaml_root(yaml), *map = bead_node_get(root, "materials", NULL);
    if (map)
        return map;
    map = bead_yaml_node(yaml, BEAD_NODE_MAP, root->place);
    return bead_yaml_put(yaml, root, "materials", strlen("materials"), map) ? map : NULL;
}

/* Takes a material of the library if the scene names it and does not define it; it takes precedence over a ready one. */
static enum bead_error take_material(struct own *own, const struct bead_yaml *library, const struct bead_node *key,
                                     const struct bead_node *value)
{
    struct bead_reader *reader = own->reader;
    const char *file = bead_yaml_name(library, NULL);
    if (!names(bead_yaml_root(reader->yaml), key->text))
        return BEAD_OK;
    struct bead_node *map = own_materials(reader->yaml);
    if (map && (map->kind != BEAD_NODE_MAP || bead_node_get(map, key->text, NULL)))
        return BEAD_OK;
    const char *origin = bead_yaml_text(reader->yaml, file, strlen(file));
    struct bead_node *copy = origin ? bead_yaml_copy(reader->yaml, value, value->place, origin) : NULL;
    own->changed = true;
    if (!map || !bead_yaml_put(reader->yaml, map, key->text, strlen(key->text), copy))
        return bead_no_memory(reader);
    return BEAD_OK;
}

static enum bead_error take_materials(struct own *own)
{
    const struct bead_config *config = own->config;
    struct bead_message *msg = own->reader->msg, why = {""};
    BEAD_LEFT_TO(bead_yaml_left) struct bead_yaml *library = NULL;
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    enum bead_error err = bead_yaml_read_part(own->reader->yaml, config->materials, BEAD_YAML_BYTES, &text, &length, &why);
    if (err)
        return bead_fail(msg, err == BEAD_ERROR_IO ? BEAD_ERROR_SCENE : err, "%s:%zu:%zu: materials: %.500s", config->path,
                         config->materials_place.line, config->materials_place.column, why.text);
    BEAD_TRY(bead_yaml_parse(config->materials, text, length, &library, msg));
    const struct bead_node *root = bead_yaml_root(library);
    if (root->kind != BEAD_NODE_MAP)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: must be a map of materials, as under `materials` of scenes",
                         config->materials, root->place.line, root->place.column);
    for (size_t i = 0; i + 1 < root->count; i += 2)
        BEAD_TRY(take_material(own, library, root->items[i], root->items[i + 1]));
    return BEAD_OK;
}

/* ---- style and font ---- */

static const struct bead_options *options_of(const struct own *own, const struct bead_node *entry)
{
    const bool sweep = bead_sweep_node(bead_yaml_root(own->reader->yaml), 0) != NULL;
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        if (bead_node_get(entry, bead_output_key(kind), NULL))
            return sweep ? bead_output_type(kind)->sweep_options : bead_output_type(kind)->options;
    }
    return NULL;
}

static enum bead_error take_default(struct own *own, struct bead_node *entry, const char *name, const char *text,
                                    struct bead_place place)
{
    struct bead_yaml *yaml = own->reader->yaml;
    const struct bead_options *options = text && entry->kind == BEAD_NODE_MAP ? options_of(own, entry) : NULL;
    if (!options || !bead_options_find(options, name) || bead_node_get(entry, name, NULL))
        return BEAD_OK;
    struct bead_node *value = bead_yaml_scalar(yaml, text, strlen(text), place);
    own->changed = true;
    if (!value || !(value->origin = bead_yaml_text(yaml, own->config->path, strlen(own->config->path))))
        return bead_no_memory(own->reader);
    return bead_yaml_put(yaml, entry, name, strlen(name), value) ? BEAD_OK : bead_no_memory(own->reader);
}

/* ---- colours ---- */

/* Reads a row of three numbers separated by spaces, tabs or commas; false: it is not one. */
static bool read_row(const char *line, double rgb[3])
{
    const char *at = line;
    for (int c = 0; c < 3; c++) {
        char *end = NULL;
        at += strspn(at, " \t,;");
        rgb[c] = strtod(at, &end);
        if (end == at || !(rgb[c] >= 0 && rgb[c] <= 255))
            return false;
        at = end;
    }
    return at[strspn(at, " \t\r,;")] == '\n' || !at[strspn(at, " \t\r,;")];
}

/* "#rrggbb #rrggbb ..." from rows between 0 and 1 or between 0 and 255, then `turned`. To be freed; NULL: no memory. */
static char *colours_text(double (*rgb)[3], size_t count, const char *turned)
{
    double most = 0;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < 3 * count; i++)
        most = fmax(most, rgb[i / 3][i % 3]);
    const double scale = most <= 1 ? 255 : 1;
    for (size_t i = 0; i < count; i++) {
        fputs(i ? " #" : "#", out);
        for (int c = 0; c < 3; c++)
            fprintf(out, "%02lx", (unsigned long)lround(scale * rgb[i][c]));
    }
    fputs(turned, out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

/* Errors are texts without the file's name. */
static char *read_colours(const char *text, const char *turned, char *why, size_t size)
{
    static const char shape[] = "must be a row of red, green and blue, all from 0 to 255 or all from 0 to 1";
    BEAD_FREED double(*rgb)[3] = calloc(MOST_COLOURS, sizeof *rgb);
    size_t count = 0, number = 1;
    snprintf(why, size, "out of memory");
    for (const char *line = text; rgb && line && *line; line = strchr(line, '\n'), line += line != NULL, number++) {
        const char *first = line + strspn(line, " \t\r");
        if (*first == '#' || *first == '\n' || !*first)
            continue;
        const char *wrong = count == MOST_COLOURS ? "has more than 1024 colours" : !read_row(line, rgb[count]) ? shape : NULL;
        if (wrong) {
            snprintf(why, size, "line %zu: %s", number, wrong);
            return NULL;
        }
        count++;
    }
    if (rgb && count < 2)
        snprintf(why, size, "has %zu colours; must have from 2 to %d, a row each", count, MOST_COLOURS);
    return rgb && count >= 2 ? colours_text(rgb, count, turned) : NULL;
}

static char *colours_path(const struct own *own, const struct bead_node *node, const char *name)
{
    for (size_t i = 0; own->config && i < own->config->colormap_count; i++) {
        if (strcmp(own->config->colormaps[i].name, name) == 0)
            return strdup(own->config->colormaps[i].file);
    }
    return bead_colours_are_file(name) ? bead_yaml_beside(own->reader->yaml, node, name) : strdup("");
}

/* The file of a map, or of NAME for NAME_r, which reverses it; "": it has none. */
static char *colours_file(const struct own *own, const struct bead_node *node, const char **turned)
{
    const size_t length = node->kind == BEAD_NODE_SCALAR ? strlen(node->text) : 0;
    char *path = length ? colours_path(own, node, node->text) : strdup("");
    *turned = "";
    if (!path || *path || length < 3 || strcmp(node->text + length - 2, "_r") != 0)
        return path;
    free(path);
    char *name = strndup(node->text, length - 2);
    path = name ? colours_path(own, node, name) : NULL;
    *turned = "_r";
    free(name);
    return path;
}

static enum bead_error take_colours(struct own *own, const struct bead_at *at)
{
    struct bead_reader *reader = own->reader;
    struct bead_message why = {""};
    const char *turned;
    char *path = colours_file(own, at->node, &turned), *text = NULL, *colours = NULL, wrong[160];
    size_t length = 0;
    if (path && !*path) {
        free(path);
        return BEAD_OK;
    }
    enum bead_error err = path ? bead_yaml_read_part(reader->yaml, path, BEAD_YAML_BYTES, &text, &length, &why) : BEAD_ERROR_MEMORY;
    if (err == BEAD_ERROR_IO || err == BEAD_ERROR_SCENE)
        err = bead_wrong(reader, at, "%s", why.text);
    if (!err && !(colours = read_colours(text, turned, wrong, sizeof wrong)))
        err = bead_wrong(reader, at, "%s: %s", path, wrong);
    struct bead_node *node = (struct bead_node *)(uintptr_t)at->node; /* of the document that is changed here */
    if (!err && !(node->text = bead_yaml_text(reader->yaml, colours, strlen(colours))))
        err = bead_no_memory(reader);
    node->plain = false;
    own->changed = true;
    free(colours);
    free(text);
    free(path);
    return err == BEAD_ERROR_MEMORY ? bead_no_memory(reader) : err;
}

/* Every `colormap` of outputs and their panels. */
static enum bead_error take_all_colours(struct own *own, const struct bead_at *at)
{
    const struct bead_node *node = at->node;
    for (size_t i = 0; node->kind == BEAD_NODE_LIST && i < node->count; i++)
        BEAD_TRY(take_all_colours(own, &(struct bead_at){at, NULL, i, node->items[i]}));
    for (size_t i = 0; node->kind == BEAD_NODE_MAP && i + 1 < node->count; i += 2) {
        const struct bead_at value = {at, node->items[i]->text, 0, node->items[i + 1]};
        BEAD_TRY(strcmp(value.key, "colormap") == 0 ? take_colours(own, &value) : take_all_colours(own, &value));
    }
    return BEAD_OK;
}

/* ---- all ---- */

static enum bead_error take_config(struct own *own, struct bead_node *outputs)
{
    const struct bead_config *c = own->config;
    BEAD_TRY(c->materials ? take_materials(own) : BEAD_OK);
    for (size_t i = 0; outputs && outputs->kind == BEAD_NODE_LIST && i < outputs->count; i++) {
        BEAD_TRY(take_default(own, outputs->items[i], "style", c->style, c->style_place));
        BEAD_TRY(take_default(own, outputs->items[i], "font", c->font, c->font_place));
    }
    return BEAD_OK;
}

enum bead_error bead_scene_take_own(struct bead_reader *reader, const char *path, bool *changed)
{
    BEAD_LEFT_TO(bead_config_left) struct bead_config *config = NULL;
    const struct bead_at root = {NULL, "", 0, bead_yaml_root(reader->yaml)};
    if (path) {
        BEAD_TRY(bead_yaml_note_part(reader->yaml, path, reader->msg));
        BEAD_TRY(bead_config_load(path, &config, reader->msg));
    }
    struct own own = {reader, config, false};
    struct bead_node *outputs = bead_node_get(root.node, "outputs", NULL);
    if (config && root.node->kind == BEAD_NODE_MAP)
        BEAD_TRY(take_config(&own, outputs));
    BEAD_TRY(bead_scene_take_waves(reader, &root, &own.changed));
    if (outputs)
        BEAD_TRY(take_all_colours(&own, &(struct bead_at){&root, "outputs", 0, outputs}));
    *changed = *changed || own.changed;
    return BEAD_OK;
}
