/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds and lists ready scenes: assets/scenes/NAME.yaml, in folders too. */
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <sys/stat.h>

#include "sim/base/assets.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/base/text.h"
#include "sim/scene/scene_private.h"

enum { DEEPEST = 4 };
static const char extension[] = ".yaml";

struct listing {
    struct bead_ready_scene *scenes;
    size_t count, before; /* characters of a path before the name */
    struct bead_message *msg;
};

static enum bead_error add(struct listing *list, const char *name, size_t length)
{
    struct bead_ready_scene *grown = realloc(list->scenes, (list->count + 1) * sizeof *grown);
    if (!grown)
        return bead_fail(list->msg, BEAD_ERROR_MEMORY, "out of memory for the list of ready scenes");
    list->scenes = grown;
    grown[list->count] = (struct bead_ready_scene){strndup(name, length), NULL};
    return grown[list->count++].name ? BEAD_OK
                                     : bead_fail(list->msg, BEAD_ERROR_MEMORY, "out of memory for the list of ready scenes");
}

static enum bead_error walk(struct listing *list, const char *directory, int depth);

static enum bead_error visit(struct listing *list, const char *directory, const char *entry, int depth)
{
    char path[PATH_MAX];
    struct stat status;
    const int length = snprintf(path, sizeof path, "%s/%s", directory, entry);
    if (entry[0] == '.' || length >= (int)sizeof path || stat(path, &status))
        return BEAD_OK;
    if (S_ISDIR(status.st_mode))
        return depth < DEEPEST ? walk(list, path, depth + 1) : BEAD_OK;
    const size_t end = (size_t)length - strlen(extension);
    return strcmp(path + end, extension) == 0 ? add(list, path + list->before, end - list->before) : BEAD_OK;
}

static enum bead_error walk(struct listing *list, const char *directory, int depth)
{
    DIR *open = opendir(directory);
    enum bead_error err = BEAD_OK;
    if (!open)
        return bead_fail(list->msg, BEAD_ERROR_IO, "%s: %s", directory, strerror(errno));
    for (const struct dirent *entry; !err && (entry = readdir(open));)
        err = visit(list, directory, entry->d_name, depth);
    closedir(open);
    return err;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct bead_ready_scene *)a)->name, ((const struct bead_ready_scene *)b)->name);
}

/* Names only, sorted. */
static enum bead_error list_names(struct listing *list)
{
    char directory[PATH_MAX];
    BEAD_TRY(bead_asset_path("scenes", directory, sizeof directory, list->msg));
    list->before = strlen(directory) + 1;
    BEAD_TRY(walk(list, directory, 0));
    if (list->count > 1)
        qsort(list->scenes, list->count, sizeof *list->scenes, by_name);
    return BEAD_OK;
}

/* The title alone: a ready scene need not be whole to be listed. */
static enum bead_error read_title(struct bead_ready_scene *scene, struct bead_message *msg)
{
    char name[PATH_MAX];
    BEAD_FREED char *text = NULL;
    BEAD_LEFT_TO(bead_yaml_left) struct bead_yaml *yaml = NULL;
    size_t length = 0;
    snprintf(name, sizeof name, "scenes/%s%s", scene->name, extension);
    BEAD_TRY(bead_asset_read(name, &text, &length, msg));
    BEAD_TRY(bead_yaml_parse(name, text, length, &yaml, msg));
    const struct bead_node *title = bead_node_get(bead_yaml_root(yaml), "title", NULL);
    scene->title = strdup(title && title->kind == BEAD_NODE_SCALAR ? title->text : "");
    return scene->title ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the list of ready scenes");
}

enum bead_error bead_scene_ready(struct bead_ready_scene **scenes, size_t *count, struct bead_message *msg)
{
    struct listing list = {.msg = msg};
    *scenes = NULL;
    *count = 0;
    enum bead_error err = list_names(&list);
    for (size_t i = 0; i < list.count && !err; i++)
        err = read_title(&list.scenes[i], msg);
    if (err) {
        bead_scene_ready_free(list.scenes, list.count);
        return err;
    }
    *scenes = list.scenes;
    *count = list.count;
    return BEAD_OK;
}

void bead_scene_ready_free(struct bead_ready_scene *scenes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        free(scenes[i].name);
        free(scenes[i].title);
    }
    free(scenes);
}

static const char *stem(const char *name, char *text, size_t size)
{
    const char *dot = strrchr(name, '.');
    snprintf(text, size, "%.*s", (int)(dot ? (size_t)(dot - name) : strlen(name)), name);
    return text;
}

/* Suggests a scene or a trajectory with a similar name in the same folder: "; did you mean `waves.yaml`?" */
static void suggest_file(const char *name, char *text, size_t size)
{
    static const char *const endings[] = {".yaml", ".yml", ".h5", NULL};
    const char *slash = strrchr(name, '/');
    char folder[PATH_MAX], word[NAME_MAX + 1], tried[NAME_MAX + 1], best[NAME_MAX + 1] = "";
    struct bead_suggest search;
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - name) + 1 : 1, slash ? name : ".");
    DIR *open = opendir(folder);
    bead_suggest_begin(&search, stem(slash ? slash + 1 : name, word, sizeof word));
    for (struct dirent *entry; open && (entry = readdir(open));) {
        const char *dot = strrchr(entry->d_name, '.');
        search.best = NULL;
        if (dot && bead_is_one_of(dot, endings))
            bead_suggest_try(&search, stem(entry->d_name, tried, sizeof tried));
        if (search.best)
            bead_text_show(entry->d_name, best, sizeof best);
    }
    if (open)
        closedir(open);
    search.best = *best ? best : NULL;
    bead_suggest_text(&search, text, size);
}

/* The error for a name that is neither a file nor a ready scene. */
static enum bead_error not_found(const char *name, struct bead_message *msg)
{
    struct listing list = {.msg = msg};
    struct bead_suggest search;
    char near[400], shown[200];
    enum bead_error err = list_names(&list);
    if (!err) {
        bead_suggest_begin(&search, name);
        for (size_t i = 0; i < list.count; i++)
            bead_suggest_try(&search, list.scenes[i].name);
        bead_text_show(name, shown, sizeof shown);
        if (!search.best)
            suggest_file(name, near, sizeof near);
        else
            bead_suggest_text(&search, near, sizeof near);
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: no such file, and no ready scene%s", shown,
                        *near ? near : "; --list scenes shows those");
    }
    bead_scene_ready_free(list.scenes, list.count);
    return err;
}

/* Can it be the name of a ready scene? It must not lead out of their directory. */
static bool may_be_ready(const char *name)
{
    return *name && *name != '/' && *name != '.' && !strstr(name, "/.") && strlen(name) < 1000;
}

/* "fig7" is thesis/fig7, unless another folder has one, too. */
static bool find_in_folders(const char *name, char *path, size_t size)
{
    struct listing list = {.msg = NULL};
    const char *found = NULL;
    size_t count = 0;
    char asset[1100];
    bool good = !strchr(name, '/') && list_names(&list) == BEAD_OK;
    for (size_t i = 0; good && i < list.count; i++) {
        const char *slash = strrchr(list.scenes[i].name, '/');
        if (slash && strcmp(slash + 1, name) == 0) {
            found = list.scenes[i].name;
            count++;
        }
    }
    if (count == 1) {
        snprintf(asset, sizeof asset, "scenes/%s%s", found, extension);
        good = bead_asset_path(asset, path, size, NULL) == BEAD_OK;
    }
    bead_scene_ready_free(list.scenes, list.count);
    return good && count == 1;
}

/* A file that can be read was recognised before this. */
static bool is_unfinished(const char *name)
{
    static const char ending[] = ".part";
    size_t length = strlen(name);
    return length >= sizeof ending && strcmp(name + length - (sizeof ending - 1), ending) == 0;
}

enum bead_error bead_scene_find(const char *name, char *path, size_t size, struct bead_message *msg)
{
    char asset[1100];
    struct stat status;
    const bool standard = strcmp(name, "-") == 0, exists = standard || stat(name, &status) == 0;
    const int error = errno;
    if (standard || (exists && !S_ISDIR(status.st_mode))) {
        if (is_unfinished(name))
            return bead_fail(
                msg, BEAD_ERROR_FORMAT,
                "%s: is an unfinished file, from which nothing can be read: its run was killed too early, or it is the "
                "journal of a sweep (see --info), which goes on when its command is run again",
                name);
        if (strlen(name) >= size)
            return bead_fail(msg, BEAD_ERROR_IO, "the name of the scene is too long");
        memcpy(path, name, strlen(name) + 1);
        return BEAD_OK;
    }
    if (may_be_ready(name)) {
        snprintf(asset, sizeof asset, "scenes/%s%s", name, extension);
        if (bead_asset_path(asset, path, size, NULL) == BEAD_OK || find_in_folders(name, path, size))
            return BEAD_OK;
    }
    if (exists)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: is a directory, not a scene", name);
    return error == ENOENT ? not_found(name, msg) : bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", name, strerror(error));
}
