/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --reproduce: makes a file again from the scene that made it, and compares. */
#include <dirent.h>
#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "beadreel/api.h"
#include "sim/base/clock.h"
#include "sim/base/file.h"
#include "sim/base/stop.h"
#include "sim/base/suggest.h"
#include "sim/cli/command_line.h"
#include "sim/kinds/output_kinds.h"
#include "sim/session/session_data.h"
#include "sim/yaml/yaml.h"

static enum bead_error stopped(const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_STOPPED, "stopped by signal %d (%s)", (int)*stop, strsignal(*stop));
}

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

/* An output of a scene that makes a file: the output's own name, and that of the file, which may be its second one. */
struct making {
    const char *output, *file; /* NULL: none */
};

/* The output with the file's name, or else the only one with its ending. `names`: all. */
static struct making find_output(const struct bead_scene *scene, const char *path, bool by_ending, char *names, size_t size)
{
    struct making alike = {.output = NULL};
    size_t count = 0;
    *names = 0;
    for (size_t i = 0; i < 2 * scene->output_count; i++) {
        const struct bead_output *output = &scene->outputs[i / 2];
        const char *key, *made = i % 2 ? bead_output_second(output, &key) : output->path;
        if (!*made)
            continue;
        bead_list_add(names, size, ", ", made);
        if (strcmp(base_name(made), base_name(path)) == 0)
            return (struct making){output->path, made};
        if (strcasecmp(ending(made), ending(path)) == 0) {
            alike = (struct making){output->path, made};
            count++;
        }
    }
    return by_ending && count == 1 ? alike : (struct making){.output = NULL};
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

/* The scene in a scene file, or in a file of results. Errors: as of command_find_origin. */
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
        found = parse(command, origin, &scene, NULL) == BEAD_OK &&
                find_output(scene, command->job.input, false, names, sizeof names).file;
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

/* Tables have no room for a scene: finds one in the directory that names this file. Those in other files of results come first,
 * since they are as they were run, then scene files as they are now. */
static enum bead_error find_beside(const struct command *command, struct command_origin *origin, const volatile sig_atomic_t *stop,
                                   struct bead_message *msg)
{
    const char *path = command->job.input, *base = base_name(path);
    char directory[PATH_MAX];
    snprintf(directory, sizeof directory, "%.*s", base > path ? (int)(base - path) : 2, base > path ? path : "./");
    struct dirent **entries = NULL;
    const int count = scandir(directory, &entries, NULL, alphasort);
    bool found = false;
    for (int i = 0; i < 2 * count && !found && !bead_stop_is_asked(stop); i++) {
        const struct dirent *entry = entries[i % count];
        char beside[PATH_MAX];
        const int length = snprintf(beside, sizeof beside, "%s%s", directory, entry->d_name);
        found = length < (int)sizeof beside && entry->d_type == DT_REG && strcmp(entry->d_name, base) != 0 &&
                is_scene_file(beside) == (i >= count) && names_input(command, beside, origin);
    }
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
    if (!found && bead_stop_is_asked(stop))
        return stopped(stop, msg);
    return found ? BEAD_OK
                 : bead_fail(msg, BEAD_ERROR_FORMAT,
                             "%s: no scene is stored in it, and no file beside it has a scene that names it", path);
}

static int remove_one(const char *path, const struct stat *, int, struct FTW *)
{
    return remove(path);
}

struct likeness {
    bool same;
    uint64_t bytes, line; /* up to the first difference */
};

static FILE *open_one(const char *path, struct bead_message *msg)
{
    const int descriptor = bead_file_look(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (!file)
        (void)bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, bead_file_reason(errno));
    return file;
}

/* Side by side, as trajectories may be longer than memory. Errors: IO, STOPPED. */
static enum bead_error compare_bytes(const char *const paths[2], const volatile sig_atomic_t *stop, struct likeness *found,
                                     struct bead_message *msg)
{
    enum { BLOCK = 1 << 14 };
    char blocks[2][BLOCK];
    size_t got[2] = {1, 1};
    FILE *files[2] = {open_one(paths[0], msg), NULL};
    files[1] = files[0] ? open_one(paths[1], msg) : NULL;
    *found = (struct likeness){.same = true, .line = 1};
    while (files[1] && found->same && got[0] > 0 && !bead_stop_is_asked(stop)) {
        size_t same = 0;
        for (int i = 0; i < 2; i++)
            got[i] = fread(blocks[i], 1, BLOCK, files[i]);
        for (; same < got[0] && same < got[1] && blocks[0][same] == blocks[1][same]; same++)
            found->line += blocks[0][same] == '\n';
        found->bytes += same;
        found->same = same == got[0] && same == got[1];
    }
    enum bead_error err = files[1] ? BEAD_OK : BEAD_ERROR_IO;
    for (int i = 0; i < 2 && !err; i++)
        err = ferror(files[i]) ? bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read", paths[i]) : BEAD_OK;
    for (int i = 0; i < 2; i++)
        if (files[i])
            fclose(files[i]);
    return !err && bead_stop_is_asked(stop) ? stopped(stop, msg) : err;
}

/* Says whether `made` has the bytes of the file, or where they differ. Errors: IO, STOPPED, NUMBERS: they differ. */
static enum bead_error compare(const struct command *command, const struct command_origin *origin, const char *made,
                               const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    const unsigned long long length = bead_file_bytes(command->job.input);
    struct likeness found;
    char where[96], version[96] = "";
    BEAD_TRY(compare_bytes((const char *const[]){command->job.input, made}, stop, &found, msg));
    if (found.same) {
        command_print(stdout, "%s: same bits: %llu bytes, by the scene %s%s\n", command->job.input, length,
                      *origin->beside ? "of " : "in it", origin->beside);
        return BEAD_OK;
    }
    if (strcasecmp(ending(made), ".csv") == 0)
        snprintf(where, sizeof where, "line %llu", (unsigned long long)found.line);
    else
        snprintf(where, sizeof where, "byte %llu of %llu", (unsigned long long)found.bytes, length);
    if (*origin->version && strcmp(origin->version, BEADREEL_VERSION) != 0)
        snprintf(version, sizeof version, "; beadreel %s made it, this is " BEADREEL_VERSION, origin->version);
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: other bits from %s on%s%s", command->job.input, where, version,
                     command->job.output ? "; the new file is there to compare" : "; -o DIRECTORY keeps the new file");
}

/* A run that makes the file again. */
struct attempt {
    const char *input;  /* a scene or a trajectory */
    const char *output; /* a directory, or the file */
    const char *only;   /* the one output to make; NULL: all */
    const char *file;   /* the result to compare, by its name in the scene; NULL: the first */
    bool compared;      /* else it is made for another attempt */
};

static const char *find_result(const struct bead_session *session, const char *file)
{
    const struct bead_result *results = NULL;
    const size_t count = bead_session_results(session, &results);
    for (size_t i = 0; i < count; i++) {
        if (!file || strcmp(results[i].name, file) == 0)
            return results[i].path;
    }
    return NULL;
}

static enum bead_error make_again(const struct command *command, const struct command_origin *origin, const struct attempt *attempt,
                                  const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    struct command again = *command;
    struct command_meter meter;
    struct bead_session *session = NULL;
    command_meter_init(&meter, command->progress);
    again.job.input = attempt->input;
    again.job.name = *origin->file ? origin->file : NULL;
    again.job.output = attempt->output;
    again.job.config = NULL; /* the scene is as it was run */
    again.job.frame = *origin->frame ? origin->frame : NULL;
    again.job.still = *origin->still ? origin->still : NULL;
    again.job.only = &attempt->only;
    again.job.only_count = attempt->only != NULL;
    again.job.stop = stop;
    again.job.progress = command_meter_tell;
    again.job.progress_context = &meter;
    enum bead_error err = bead_session_open(&again.job, &session, msg);
    command_guard(session);
    if (!err)
        err = bead_session_run(session, msg);
    command_meter_clear(&meter);
    const char *made = err ? NULL : find_result(session, attempt->file);
    if (!err && !made)
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: %s does not make it", attempt->file ? attempt->file : attempt->output,
                        command->program->name);
    if (!err && attempt->compared)
        err = compare(command, origin, made, stop, msg);
    command_guard(NULL);
    bead_session_close(session);
    return err;
}

static enum bead_error join(const char *directory, const char *name, char path[PATH_MAX], struct bead_message *msg)
{
    return snprintf(path, PATH_MAX, "%s/%s", directory, name) < PATH_MAX ? BEAD_OK
                                                                         : bead_fail(msg, BEAD_ERROR_IO, "%s: too long", directory);
}

static enum bead_error write_scene(const char *path, const char *scene, struct bead_message *msg)
{
    FILE *file = NULL;
    BEAD_TRY(bead_file_create(path, &file, msg));
    fputs(scene, file);
    return bead_file_close(file, path, msg);
}

/* A file that was drawn from a trajectory, which knows less than a run, is drawn from that trajectory, made again. */
static enum bead_error draw_again(const struct command *command, const struct command_origin *origin, struct attempt *attempt,
                                  const char *keeper, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    char trajectory[PATH_MAX], drawn[PATH_MAX];
    const char *directory = attempt->output;
    BEAD_TRY(join(directory, keeper, trajectory, msg));
    BEAD_TRY(join(directory, base_name(attempt->file ? attempt->file : command->job.input), drawn, msg));
    struct command_origin plain = *origin;
    *plain.frame = *plain.still = 0;
    attempt->only = attempt->file = keeper;
    attempt->compared = false;
    BEAD_TRY(make_again(command, &plain, attempt, stop, msg));
    *attempt = (struct attempt){.input = trajectory, .output = drawn, .compared = true};
    return make_again(command, origin, attempt, stop, msg);
}

/* Tries one way after the other, because what a file says about its run depends on its source and on the other outputs: by itself;
 * as one of all files of its scene; from the scene's trajectory. `made`: the output that makes it; none: -o made it from one.
 */
static enum bead_error try_all(const struct command *command, const struct command_origin *origin, const struct bead_scene *scene,
                               struct making made, const char *directory, const volatile sig_atomic_t *stop,
                               struct bead_message *msg)
{
    char path[PATH_MAX], converted[PATH_MAX];
    const struct bead_output *keeper = bead_session_keeper(scene);
    struct bead_message other;
    BEAD_TRY(join(directory, ".beadreel-scene.yaml", path, msg));
    BEAD_TRY(join(directory, base_name(command->job.input), converted, msg));
    BEAD_TRY(write_scene(path, origin->scene, msg));
    struct attempt attempt = {.input = path, .output = directory, .only = made.output, .file = made.file, .compared = true};
    const bool single = !made.file || *origin->frame || *origin->still;
    if (single)
        attempt = (struct attempt){.input = path, .output = converted, .compared = true};
    enum bead_error err = make_again(command, origin, &attempt, stop, msg);
    attempt = (struct attempt){.input = path, .output = directory, .file = made.file, .compared = true};
    if (err == BEAD_ERROR_NUMBERS && !single)
        err = make_again(command, origin, &attempt, stop, msg);
    if (err == BEAD_ERROR_NUMBERS && keeper && keeper->path != made.output &&
        draw_again(command, origin, &attempt, keeper->path, stop, &other) == BEAD_OK)
        err = BEAD_OK;
    unlink(path);
    return err;
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

/* A file below the directory that is written to might be replaced, and then compared with itself. */
static enum bead_error check_apart(const char *path, const char *directory, struct bead_message *msg)
{
    char below[PATH_MAX], above[PATH_MAX];
    const bool known = realpath(path, below) && realpath(directory, above);
    const size_t length = known ? strlen(above) : 0;
    return known && strncmp(below, above, length) == 0 && (length == 1 || below[length] == '/')
               ? bead_fail(msg, BEAD_ERROR_USAGE,
                           "--reproduce: -o %s has %s in it, which might be replaced; name another directory", directory, path)
               : BEAD_OK;
}

static enum bead_error in_directory(const struct command *command, const struct command_origin *origin,
                                    const struct bead_scene *scene, struct making made, const volatile sig_atomic_t *stop,
                                    struct bead_message *msg)
{
    char temporary[PATH_MAX];
    if (command->job.output) {
        BEAD_TRY(check_apart(command->job.input, command->job.output, msg));
        BEAD_TRY(bead_file_make_directory(command->job.output, msg));
        return try_all(command, origin, scene, made, command->job.output, stop, msg);
    }
    BEAD_TRY(command_make_temporary(temporary, msg));
    enum bead_error err = try_all(command, origin, scene, made, temporary, stop, msg);
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
        err = find_beside(command, &origin, stop, msg);
    if (!err)
        err = parse(command, &origin, &scene, msg);
    struct making made = {.output = NULL};
    if (!err)
        made = find_output(scene, command->job.input, true, names, sizeof names);
    if (!err && !made.file && !bead_session_names_file(command->job.input, command->job.own))
        err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: its scene makes no such file, only %s; was it drawn from a trajectory?",
                        command->job.input, names);
    if (!err)
        err = in_directory(command, &origin, scene, made, stop, msg);
    bead_scene_free(scene);
    free(origin.scene);
    return err;
}
