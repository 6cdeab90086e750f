#include "beadreel/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static enum bead_error concatenate(const char *a, const char *b, const char *c, char **text, struct bead_message *msg)
{
    size_t la = strlen(a), lb = strlen(b), lc = strlen(c);
    *text = malloc(la + lb + lc + 1);
    if (!*text)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a file name");
    memcpy(*text, a, la);
    memcpy(*text + la, b, lb);
    memcpy(*text + la + lb, c, lc + 1);
    return BEAD_OK;
}

enum bead_error bead_file_join(const char *directory, const char *path, char **joined, struct bead_message *msg)
{
    *joined = NULL;
    if (!path || !*path)
        return bead_fail(msg, BEAD_ERROR_IO, "an output has no file name");
    if (!directory || !*directory || path[0] == '/')
        return concatenate("", "", path, joined, msg);
    return concatenate(directory, directory[strlen(directory) - 1] == '/' ? "" : "/", path, joined, msg);
}

enum bead_error bead_file_part_name(const char *path, char **part, struct bead_message *msg)
{
    *part = NULL;
    return concatenate(path, ".part", "", part, msg);
}

enum bead_error bead_file_create(const char *part, FILE **file, struct bead_message *msg)
{
    *file = NULL;
    int fd = open(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written: %s", part, strerror(errno));
    *file = fdopen(fd, "wb");
    if (*file)
        return BEAD_OK;
    int error = errno;
    close(fd);
    unlink(part);
    return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written: %s", part, strerror(error));
}

enum bead_error bead_file_close(FILE *file, const char *part, struct bead_message *msg)
{
    errno = 0;
    int failed = fflush(file) != 0 || ferror(file);
    int error = errno;
    if (fclose(file) != 0 && !failed) {
        failed = 1;
        error = errno;
    }
    if (failed)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed: %s", part,
                         error ? strerror(error) : "an earlier write did not succeed");
    return BEAD_OK;
}

/* Returns 0 or an errno. Where the file system cannot sync such an object (EINVAL), nothing can be done. */
static int sync_path(const char *path, int flags)
{
    int fd = open(path, flags | O_CLOEXEC);
    if (fd < 0)
        return errno;
    int error = fsync(fd) != 0 && errno != EINVAL && errno != EROFS ? errno : 0;
    close(fd);
    return error;
}

/* The rename itself must reach the disk, too; a directory that may not be read cannot be synced, which is no failure. */
static void sync_directory(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) {
        sync_path(".", O_RDONLY | O_DIRECTORY);
        return;
    }
    char *directory = strndup(path, slash == path ? 1 : (size_t)(slash - path));
    if (directory)
        sync_path(directory, O_RDONLY | O_DIRECTORY);
    free(directory);
}

enum bead_error bead_file_commit(const char *part, const char *path, struct bead_message *msg)
{
    int error = sync_path(part, O_RDONLY);
    if (!error && rename(part, path) != 0)
        error = errno;
    if (error) {
        unlink(part);
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be finished: %s", path, strerror(error));
    }
    sync_directory(path);
    return BEAD_OK;
}

void bead_file_discard(const char *part)
{
    if (part)
        unlink(part);
}

uint64_t bead_file_bytes(const char *path)
{
    struct stat status;
    return path && stat(path, &status) == 0 && status.st_size > 0 ? (uint64_t)status.st_size : 0;
}

enum bead_error bead_file_write(const char *path, bead_file_fill fill, void *context, uint64_t *bytes, struct bead_message *msg)
{
    char *part = NULL;
    FILE *file = NULL;
    enum bead_error err = bead_file_part_name(path, &part, msg);
    if (!err)
        err = bead_file_create(part, &file, msg);
    if (!err) {
        err = fill(context, file, part, msg);
        enum bead_error closed = bead_file_close(file, part, err ? NULL : msg);
        err = err ? err : closed;
        if (err)
            bead_file_discard(part);
        else
            err = bead_file_commit(part, path, msg);
    }
    if (!err && bytes)
        *bytes = bead_file_bytes(path);
    free(part);
    return err;
}

enum bead_error bead_file_make_directory(const char *directory, struct bead_message *msg)
{
    char path[4096];
    if (!directory || !*directory)
        return BEAD_OK;
    if (snprintf(path, sizeof path, "%s", directory) >= (int)sizeof path)
        return bead_fail(msg, BEAD_ERROR_IO, "%.100s...: path too long", directory);
    for (char *slash = path + 1;; slash++) {
        if (*slash != '/' && *slash != '\0')
            continue;
        char end = *slash;
        *slash = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST)
            return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot make the directory: %s", path, strerror(errno));
        *slash = end;
        if (end == '\0')
            break;
    }
    struct stat found;
    if (stat(directory, &found) != 0 || !S_ISDIR(found.st_mode))
        return bead_fail(msg, BEAD_ERROR_IO, "%s: is not a directory", directory);
    return BEAD_OK;
}
