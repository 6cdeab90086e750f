/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A user's own settings: finds and reads their file. */
#include "sim/base/memory.h"
#include "sim/scene/scene_private.h"

#include <stdlib.h>
#include <unistd.h>

#include "sim/base/file.h"
#include "sim/scene/scene_internal.h"

bool bead_colours_are_file(const char *value)
{
    return *value != '#' && strpbrk(value, "./") != NULL;
}

/* ---- where it is ---- */

/* `folder` ends at `end`; relative folders are ignored, as the specification requires. */
static bool look_in(const char *folder, const char *end, const char *below, char *path, size_t size)
{
    int length = snprintf(path, size, "%.*s%s/beadreel/config.yaml", (int)(end - folder), folder, below);
    return *folder == '/' && length > 0 && (size_t)length < size && access(path, F_OK) == 0;
}

bool bead_config_find(char *path, size_t size)
{
    const char *own = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME"), *all = getenv("XDG_CONFIG_DIRS");
    const bool set = own && *own;
    const char *first = set ? own : home ? home : "";
    if (look_in(first, first + strlen(first), set ? "" : "/.config", path, size))
        return true;
    for (const char *at = all && *all ? all : "/etc/xdg"; *at; at += *at == ':') {
        const char *end = at + strcspn(at, ":");
        if (look_in(at, end, "", path, size))
            return true;
        at = end;
    }
    return false;
}

/* ---- what it says ---- */

static BEAD_OPTION_READER(read_colormaps)
{
    struct bead_config *config = settings;
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_must_be(reader, at, option->shape);
    BEAD_TRY(bead_new(&config->colormaps, at->node->count / 2 + 1, reader->msg, "colour maps"));
    for (size_t i = 0; i + 1 < at->node->count; i += 2) {
        const struct bead_at one = {at, at->node->items[i]->text, 0, at->node->items[i + 1]};
        struct bead_config_colormap *map = &config->colormaps[config->colormap_count];
        if (bead_colours_are_file(one.key) || !*one.key || strcmp(one.key, "auto") == 0)
            return bead_wrong(reader, &one, "cannot be the name of a colour map");
        enum bead_error err = bead_read_text(reader, &one, &map->file);
        config->colormap_count += map->file != NULL;
        if (err)
            return err;
        if (!(map->name = strdup(one.key)))
            return bead_no_memory(reader);
    }
    return BEAD_OK;
}

static const struct bead_option rows[] = {
    {.key = "style", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_config, style)},
    {.key = "font", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_config, font)},
    {.key = "canvas", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_config, canvas)},
    {.key = "materials", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_config, materials)},
    {.key = "colormaps", .type = BEAD_OPTION_CUSTOM, .shape = "a map of names to files", .read = read_colormaps},
};
static const struct bead_options config_options = {"settings", "of a user", BEAD_OPTIONS(rows), NULL, NULL};

/* Relative to the folder of the settings, or to the home directory. */
static bool place_file(const char *config, char **file)
{
    const char *slash = strrchr(config, '/'), *home = getenv("HOME");
    char *whole = NULL;
    int length = 0;
    if (!*file || **file == '/')
        return true;
    if (strncmp(*file, "~/", 2) == 0 && home)
        length = asprintf(&whole, "%s%s", home, *file + 1);
    else
        length = asprintf(&whole, "%.*s%s", slash ? (int)(slash - config) + 1 : 0, config, *file);
    if (length < 0)
        return false;
    free(*file);
    *file = whole;
    return true;
}

static bool place_files(struct bead_config *config)
{
    bool good = place_file(config->path, &config->materials);
    for (size_t i = 0; i < config->colormap_count; i++)
        good = good && place_file(config->path, &config->colormaps[i].file);
    return good;
}

static struct bead_place place_of(const struct bead_node *root, const char *key)
{
    const struct bead_node *value = bead_node_get(root, key, NULL);
    return value ? value->place : (struct bead_place){0, 0};
}

static enum bead_error read_config(struct bead_reader *reader, struct bead_config *config)
{
    const struct bead_at root = {NULL, "", 0, bead_yaml_root(reader->yaml)};
    BEAD_TRY(bead_yaml_parse("default", "{}", 2, &reader->scratch, reader->msg));
    BEAD_TRY(bead_options_read(reader, &root, &config_options, config));
    config->style_place = place_of(root.node, "style");
    config->font_place = place_of(root.node, "font");
    config->canvas_place = place_of(root.node, "canvas");
    config->materials_place = place_of(root.node, "materials");
    return place_files(config) ? BEAD_OK : bead_no_memory(reader);
}

enum bead_error bead_config_load(const char *path, struct bead_config **config, struct bead_message *msg)
{
    struct bead_reader reader = {.msg = msg};
    char *text = NULL;
    size_t length = 0;
    struct bead_config *c = *config = calloc(1, sizeof *c);
    if (!c || !(c->path = strdup(path))) {
        free(c);
        *config = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
    }
    enum bead_error err = bead_file_read(path, BEAD_YAML_BYTES, &text, &length, msg);
    if (!err && text[strspn(text, " \t\r\n")])
        err = bead_yaml_parse(path, text, length, &reader.yaml, msg);
    if (!err && reader.yaml)
        err = read_config(&reader, c);
    free(text);
    bead_yaml_free(reader.scratch);
    bead_yaml_free(reader.yaml);
    if (err) {
        bead_config_free(c);
        *config = NULL;
    }
    return err;
}

void bead_config_free(struct bead_config *config)
{
    if (!config)
        return;
    for (size_t i = 0; i < config->colormap_count; i++) {
        free(config->colormaps[i].name);
        free(config->colormaps[i].file);
    }
    free(config->colormaps);
    free(config->path);
    free(config->style);
    free(config->font);
    free(config->canvas);
    free(config->materials);
    free(config);
}
