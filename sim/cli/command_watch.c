/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --watch: the scene again each time it is saved; --new: a scene to start from. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "beadreel/scene.h"
#include "sim/base/assets.h"
#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/cli/command_line.h"

enum { LONGEST = 4 << 20 };

/* The file as it is now; NULL: it cannot be read, as while an editor replaces it. */
static char *read_text(const char *path)
{
    char *text;
    size_t length;
    return bead_file_read(path, LONGEST, &text, &length, NULL) ? NULL : text;
}

static bool changed(const char *path, struct stat *last)
{
    struct stat now;
    if (stat(path, &now) != 0)
        return false;
    const bool same = now.st_ino == last->st_ino && now.st_size == last->st_size && now.st_mtim.tv_sec == last->st_mtim.tv_sec &&
                      now.st_mtim.tv_nsec == last->st_mtim.tv_nsec;
    *last = now;
    return !same;
}

static size_t lines_of(const char *text, size_t length)
{
    size_t lines = 0;
    for (size_t i = 0; i < length; i++)
        lines += text[i] == '\n';
    return lines;
}

/* "scene.yaml:12: `velocity: 1 m/s`, was `velocity: 0.443 m/s`", or how many lines are new. */
static void say_change(FILE *out, const char *path, const char *before, const char *now)
{
    size_t same = 0, tail = 0, left[2] = {strlen(before), strlen(now)};
    for (size_t i = 0; before[i] && before[i] == now[i]; i++)
        same = before[i] == '\n' ? i + 1 : same;
    left[0] -= same;
    left[1] -= same;
    for (size_t i = 1; i <= left[0] && i <= left[1] && before[same + left[0] - i] == now[same + left[1] - i]; i++)
        tail = now[same + left[1] - i] == '\n' ? i - 1 : tail;
    const char *line[2] = {before + same, now + same};
    for (int i = 0; i < 2; i++) {
        line[i] += strspn(line[i], " ");
        left[i] -= left[i] > tail ? tail : left[i];
    }
    const size_t number = lines_of(now, same) + 1, fresh = lines_of(now + same, left[1]);
    if (left[0] == 0 && left[1] == 0)
        command_print(out, "%s: saved, not changed\n", path);
    else if (lines_of(before + same, left[0]) == 1 && fresh == 1)
        command_print(out, "%s:%zu: `%.*s`, was `%.*s`\n", path, number, (int)strcspn(line[1], "\n"), line[1],
                      (int)strcspn(line[0], "\n"), line[0]);
    else
        command_print(out, "%s:%zu: %zu line%s instead of %zu\n", path, number, fresh, fresh == 1 ? "" : "s",
                      lines_of(before + same, left[0]));
    fflush(out);
}

enum bead_error command_watch(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    static const struct timespec pause = {0, 30000000}; /* s, ns */
    char path[4096], *text = NULL;
    struct stat last = {0};
    BEAD_TRY(bead_scene_find(command->job.input, path, sizeof path, msg));
    (void)changed(path, &last);
    if (!S_ISREG(last.st_mode))
        return bead_fail(msg, BEAD_ERROR_USAGE, "--watch: %s is not a file that could be saved again", path);
    enum bead_error err = BEAD_OK;
    for (text = read_text(path); !*stop;) {
        err = command_run(command, stop, msg);
        if (err && !*stop) /* the user mends a wrong scene and saves it again */
            command_complain(command->program, err, msg);
        while (!*stop && !changed(path, &last))
            (void)nanosleep(&pause, NULL);
        char *now = *stop ? NULL : read_text(path);
        if (now && text)
            say_change(command_is_json(command) ? stderr : stdout, path, text, now);
        if (now) {
            free(text);
            text = now;
        }
    }
    free(text);
    return bead_fail(msg, BEAD_ERROR_STOPPED, "stopped by signal %d (%s)", (int)*stop, strsignal(*stop));
}

/* A path as a shell reads it: in quotes, where it has more than plain characters. */
static void put_shell_word(FILE *out, const char *path)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:=@%-";
    char shown[PATH_MAX];
    path = bead_text_show(path, shown, sizeof shown); /* a comment is one line */
    if (path[strspn(path, plain)] == '\0') {
        fputs(path, out);
        return;
    }
    fputc('\'', out);
    for (; *path; path++)
        *path == '\'' ? fputs("'\\''", out) : fputc(*path, out);
    fputc('\'', out);
}

/* The scene, after a line with which editors complete and check its keys; its comments name the file at `path` instead of `own`. */
static bool write_new(FILE *file, const char *schema, const char *text, const char *own, const char *path)
{
    fprintf(file, "# yaml-language-server: $schema=%s\n", schema);
    for (const char *found; (found = strstr(text, own)); text = found + strlen(own)) {
        fwrite(text, 1, (size_t)(found - text), file);
        put_shell_word(file, path);
    }
    fputs(text, file);
    return !ferror(file);
}

enum bead_error command_new(const struct command *command, struct bead_message *msg)
{
    char asset[64], own[64], *text = NULL;
    size_t length = 0;
    snprintf(asset, sizeof asset, "new/%s.yaml", command->kind);
    snprintf(own, sizeof own, "%s.yaml", command->kind);
    const char *path = command->job.output ? command->job.output : own;
    const bool printed = strcmp(path, "-") == 0;
    enum bead_error err = bead_asset_read(asset, &text, &length, msg);
    char found[PATH_MAX], schema[PATH_MAX];
    if (!err)
        err = bead_asset_path("scene.schema.json", found, sizeof found, msg);
    FILE *file = err ? NULL : printed ? stdout : fopen(path, "wx");
    if (!err && !file)
        err = bead_fail(msg, errno == EEXIST ? BEAD_ERROR_USAGE : BEAD_ERROR_IO,
                        errno == EEXIST ? "--new: %s exists already; give another name with -o FILE.yaml"
                                        : "--new: %s: cannot be made: %s",
                        path, strerror(errno));
    bool written = file && write_new(file, realpath(found, schema) ? schema : found, text, own, printed ? own : path);
    written = file && (printed ? fflush(file) : fclose(file)) == 0 && written;
    if (file && !written)
        err = bead_fail(msg, BEAD_ERROR_IO, "--new: %s: cannot be written: %s", path, strerror(errno));
    free(text);
    if (err || printed)
        return err;
    command_print(stdout, "%s  edit it, then: %s ", path, command->program->name);
    put_shell_word(stdout, path);
    putchar('\n');
    return err;
}
