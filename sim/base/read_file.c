/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads whole files, of a bounded length. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/base/file.h"

const char *bead_file_reason(int error)
{
    return error == ENXIO ? "it is not a regular file" : strerror(error);
}

static enum bead_error cannot_read(const char *path, int error, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, bead_file_reason(error));
}

int bead_file_look(const char *path)
{
    struct stat found;
    if (stat(path, &found) != 0)
        return -1;
    if (S_ISREG(found.st_mode))
        return open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    errno = S_ISDIR(found.st_mode) ? EISDIR : ENXIO;
    return -1;
}

bool bead_file_same(const char *a, const char *b)
{
    struct stat found[2];
    return stat(a, &found[0]) == 0 && stat(b, &found[1]) == 0 && found[0].st_dev == found[1].st_dev &&
           found[0].st_ino == found[1].st_ino;
}

/* Up to `room` bytes. Waiting in poll() ends with a signal, even if its handler restarts other calls. */
static enum bead_error read_open(int file, const char *path, size_t room, char *bytes, size_t *length, struct bead_message *msg)
{
    while (*length < room) {
        struct pollfd ready = {.fd = file, .events = POLLIN};
        if (poll(&ready, 1, -1) < 0)
            return errno == EINTR ? bead_fail(msg, BEAD_ERROR_STOPPED, "%s: stopped while waiting for it", path)
                                  : cannot_read(path, errno, msg);
        const ssize_t got = read(file, bytes + *length, room - *length);
        if (got < 0 && errno != EINTR && errno != EAGAIN)
            return cannot_read(path, errno, msg);
        if (got == 0)
            break;
        *length += got > 0 ? (size_t)got : 0;
    }
    bytes[*length] = '\0';
    return BEAD_OK;
}

/* Files below /proc claim to be empty; some of them would be waited for endlessly. */
static enum bead_error read_whole(int file, const char *path, size_t most, char **bytes, size_t *length, struct bead_message *msg)
{
    struct stat found;
    if (fstat(file, &found) != 0 || (S_ISDIR(found.st_mode) && (errno = EISDIR)))
        return cannot_read(path, errno, msg);
    const size_t room = S_ISREG(found.st_mode) ? (size_t)found.st_size : most + 1;
    if (room <= most + 1 && !(*bytes = malloc(room + 1)))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
    enum bead_error err = *bytes ? read_open(file, path, room, *bytes, length, msg) : BEAD_OK;
    if (!err && (!*bytes || *length > most))
        err = bead_fail(msg, BEAD_ERROR_SCENE, "%s: is too long; at most %zu MiB are allowed", path, most >> 20);
    return err;
}

enum bead_error bead_file_read_open(int file, const char *path, size_t most, char **bytes, size_t *length, struct bead_message *msg)
{
    *bytes = NULL;
    *length = 0;
    if (file < 0)
        return cannot_read(path, errno, msg);
    enum bead_error err = read_whole(file, path, most, bytes, length, msg);
    close(file);
    if (err) {
        free(*bytes);
        *bytes = NULL;
    }
    return err;
}

enum bead_error bead_file_read(const char *path, size_t most, char **bytes, size_t *length, struct bead_message *msg)
{
    return bead_file_read_open(bead_file_look(path), path, most, bytes, length, msg);
}

enum bead_error bead_file_read_input(const char *path, size_t most, char **bytes, size_t *length, struct bead_message *msg)
{
    /* O_NONBLOCK, as opening a FIFO without a writer would block. */
    const int file = strcmp(path, "-") == 0 ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    return bead_file_read_open(file, path, most, bytes, length, msg);
}
