/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --reproduce: makes a file again from the scene that it was made of, and compares. */
#include <dirent.h>
#include <ftw.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "beadreel/api.h"
#include "sim/base/clock.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/cli/command_line.h"
#include "sim/session/session_data.h"
#include "sim/yaml/yaml.h"

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const char *ending(const char *path)
{
    const char *dot = strrchr(base_name(path), '.');
    return dot ? dot : "";
}

/* The output of a scene that is this file: that of its name, or else the only one of its ending; NULL: neither. `names`: all. */
static const char *find_output(const struct bead_scene *scene, const char *path, bool by_ending, char *names, size_t size)
{
    const char *alike = NULL;
    size_t count = 0;
    *names = 0;
    for (size_t i = 0; i < scene->output_count; i++) {
        const char *made = scene->outputs[i].path;
        bead_list_add(names, size, ", ", made);
        if (strcmp(base_name(made), base_name(path)) == 0)
            return made;
        if (strcasecmp(ending(made), ending(path)) == 0) {
            alike = made;
            count++;
        }
    }
    return by_ending && count == 1 ? alike : NULL;
}

static enum bead_error parse(const struct command *command, const struct command_origin *origin, struct bead_scene **scene,
                             struct bead_message *msg)
{
    const struct bead_overrides overrides = {.own = command->job.own};
    return bead_scene_parse(*origin->file ? origin->file : "its scene", origin->scene, strlen(origin->scene), &overrides, scene,
                            msg);
}

static bool is_scene_file(const char *path)
{
    return strcasecmp(ending(path), ".yaml") == 0 || strcasecmp(ending(path), ".yml") == 0;
}

/* The scene of a file, or that a file of results has in it. Errors: as of command_find_origin. */
static enum bead_error read_origin(const struct command *command, const char *path, struct command_origin *origin)
{
    size_t length = 0;
    if (!is_scene_file(path))
        return command_find_origin(command, path, origin, NULL);
    *origin = (struct command_origin){.scene = NULL};
    snprintf(origin->file, sizeof origin->file, "%s", path);
    return bead_file_read(path, BEAD_YAML_BYTES, &origin->scene, &length, NULL);
}

/* Does the scene of this file name the input? If so it is kept in `origin`. */
static bool names_input(const struct command *command, const char *path, struct command_origin *origin)
{
    char names[64];
    struct bead_scene *scene = NULL;
    bool found = read_origin(command, path, origin) == BEAD_OK && origin->scene;
    if (found) {
        found =
            parse(command, origin, &scene, NULL) == BEAD_OK && find_output(scene, command->job.input, false, names, sizeof names);
        bead_scene_free(scene);
    }
    if (found)
        snprintf(origin->beside, sizeof origin->beside, "%.255s", base_name(path));
    else
        free(origin->scene);
    if (!found)
        origin->scene = NULL;
    return found;
}

/* Tables and GIF files have no room for a scene: one of the directory that names this file, rather as another file of results has
 * it, which is as it was run, than as its own file has it now. */
static enum bead_error find_beside(const struct command *command, struct command_origin *origin, struct bead_message *msg)
{
    const char *path = command->job.input, *base = base_name(path);
    char directory[PATH_MAX];
    snprintf(directory, sizeof directory, "%.*s", base > path ? (int)(base - path) : 2, base > path ? path : "./");
    struct dirent **entries = NULL;
    const int count = scandir(directory, &entries, NULL, alphasort);
    bool found = false;
    for (int i = 0; i < 2 * count && !found; i++) {
        const struct dirent *entry = entries[i % count];
        char beside[PATH_MAX];
        const int length = snprintf(beside, sizeof beside, "%s%s", directory, entry->d_name);
        found = length < (int)sizeof beside && entry->d_type == DT_REG && strcmp(entry->d_name, base) != 0 &&
                is_scene_file(beside) == (i >= count) && names_input(command, beside, origin);
    }
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
    return found
               ? BEAD_OK
               : bead_fail(msg, BEAD_ERROR_FORMAT, "%s: no scene is stored in it, nor one that names it in a file beside it", path);
}

static int remove_one(const char *path, const struct stat *, int, struct FTW *)
{
    return remove(path);
}

static size_t line_of(const char *bytes, size_t at)
{
    size_t line = 1;
    for (size_t i = 0; i < at; i++)
        line += bytes[i] == '\n';
    return line;
}

/* Says whether `made` has the bytes of the file, or where they differ. Errors: NUMBERS: they differ. */
static enum bead_error compare(const struct command *command, const struct command_origin *origin, const char *made,
                               struct bead_message *msg)
{
    BEAD_FREED char *old = NULL, *new = NULL;
    size_t old_length = 0, new_length = 0, same = 0;
    char where[96], version[96] = "";
    BEAD_TRY(bead_file_read(command->job.input, (size_t)1 << 40, &old, &old_length, msg));
    BEAD_TRY(bead_file_read(made, (size_t)1 << 40, &new, &new_length, msg));
    while (same < old_length && same < new_length && old[same] == new[same])
        same++;
    if (same == old_length && same == new_length) {
        command_print(stdout, "%s: same bits: %zu bytes, by the scene %s%s\n", command->job.input, old_length,
                      *origin->beside ? "of " : "in it", origin->beside);
        return BEAD_OK;
    }
    if (strcasecmp(ending(made), ".csv") == 0)
        snprintf(where, sizeof where, "line %zu", line_of(old, same));
    else
        snprintf(where, sizeof where, "byte %zu of %zu", same, old_length);
    if (*origin->version && strcmp(origin->version, BEADREEL_VERSION) != 0)
        snprintf(version, sizeof version, "; beadreel %s made it, this is " BEADREEL_VERSION, origin->version);
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: other bits from %s on%s%s", command->job.input, where, version,
                     command->job.output ? "; the new file is there to compare" : "; -o DIRECTORY keeps the new file");
}

/* The result of a run that has this name, or NULL: the first; NULL: there is none. */
static const char *find_result(const struct bead_session *session, const char *output)
{
    const struct bead_result *results = NULL;
    const size_t count = bead_session_results(session, &results);
    for (size_t i = 0; i < count; i++) {
        if (!output || strcmp(results[i].name, output) == 0)
            return results[i].path;
    }
    return NULL;
}

/* The output of the scene, or NULL: what `-o` makes of one for the file's name. */
static enum bead_error make_again(const struct command *command, const struct command_origin *origin, const char *output,
                                  bool alone, const char *directory, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    char path[PATH_MAX], converted[PATH_MAX];
    const int length = snprintf(path, sizeof path, "%s/.beadreel-scene.yaml", directory);
    if (length >= (int)sizeof path ||
        snprintf(converted, sizeof converted, "%s/%s", directory, base_name(command->job.input)) >= (int)sizeof converted)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: too long", directory);
    FILE *file = NULL;
    BEAD_TRY(bead_file_create(path, &file, msg));
    fputs(origin->scene, file);
    BEAD_TRY(bead_file_close(file, path, msg));
    struct command again = *command;
    struct command_meter meter;
    struct bead_session *session = NULL;
    command_meter_init(&meter, command->progress);
    again.job.input = path;
    again.job.name = *origin->file ? origin->file : NULL;
    again.job.output = output ? directory : converted;
    again.job.config = NULL; /* the scene is as it was run */
    again.job.only = &output;
    again.job.only_count = alone && output ? 1 : 0;
    again.job.stop = stop;
    again.job.progress = command_meter_tell;
    again.job.progress_context = &meter;
    enum bead_error err = bead_session_open(&again.job, &session, msg);
    command_guard(session);
    if (!err)
        err = bead_session_run(session, msg);
    command_meter_clear(&meter);
    const char *made = err ? NULL : find_result(session, output);
    if (!err && !made)
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: %s does not make it", output ? output : converted, command->program->name);
    if (!err)
        err = compare(command, origin, made, msg);
    command_guard(NULL);
    bead_session_close(session);
    unlink(path);
    return err;
}

/* By itself; where bits differ, as one of all files of its scene: what a file says of its run depends on what else was asked of it.
 */
static enum bead_error try_both(const struct command *command, const struct command_origin *origin, const char *output,
                                const char *directory, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    enum bead_error err = make_again(command, origin, output, true, directory, stop, msg);
    return err == BEAD_ERROR_NUMBERS && output ? make_again(command, origin, output, false, directory, stop, msg) : err;
}

enum bead_error command_make_temporary(char path[PATH_MAX], struct bead_message *msg)
{
    const char *parent = getenv("TMPDIR");
    const int length = snprintf(path, PATH_MAX, "%s/beadreel.XXXXXX", parent && *parent ? parent : "/tmp");
    return length < PATH_MAX && mkdtemp(path) ? BEAD_OK : bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be made", path);
}

void command_remove_temporary(const char *path)
{
    nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

static enum bead_error in_directory(const struct command *command, const struct command_origin *origin, const char *output,
                                    const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    char temporary[PATH_MAX];
    if (command->job.output) {
        BEAD_TRY(bead_file_make_directory(command->job.output, msg));
        return try_both(command, origin, output, command->job.output, stop, msg);
    }
    BEAD_TRY(command_make_temporary(temporary, msg));
    enum bead_error err = try_both(command, origin, output, temporary, stop, msg);
    command_remove_temporary(temporary);
    return err;
}

enum bead_error command_reproduce(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    struct command_origin origin;
    struct bead_scene *scene = NULL;
    char names[512];
    enum bead_error err = command_find_origin(command, command->job.input, &origin, msg);
    if (!err && !origin.scene)
        err = find_beside(command, &origin, msg);
    if (!err)
        err = parse(command, &origin, &scene, msg);
    const char *output = err ? NULL : find_output(scene, command->job.input, true, names, sizeof names);
    if (!err && !output && !bead_session_names_file(command->job.input, command->job.own))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: its scene makes no such file, only %s; was it drawn from a trajectory?",
                        command->job.input, names);
    if (!err)
        err = in_directory(command, &origin, output, stop, msg);
    bead_scene_free(scene);
    free(origin.scene);
    return err;
}
