/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that appear complete or not at all, and claims on them. All files that the programs write are made here. */
#include "sim/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <linux/openat2.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "sim/base/fingerprint.h"
#include "sim/base/memory.h"

/* The first `length` bytes of `a`, `b` and `c` as one text. */
static enum bead_error concatenate(const char *a, size_t length, const char *b, const char *c, char **text,
                                   struct bead_message *msg)
{
    if (asprintf(text, "%.*s%s%s", (int)length, a, b, c) >= 0)
        return BEAD_OK;
    *text = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a file name");
}

enum bead_error bead_file_join(const char *directory, const char *path, char **joined, struct bead_message *msg)
{
    *joined = NULL;
    if (!path || !*path)
        return bead_fail(msg, BEAD_ERROR_IO, "an output has no file name");
    if (!directory || !*directory || strcmp(directory, ".") == 0 || path[0] == '/')
        return concatenate("", 0, "", path, joined, msg);
    const size_t length = strlen(directory);
    return concatenate(directory, length, directory[length - 1] == '/' ? "" : "/", path, joined, msg);
}

bool bead_file_is_inside(const char *path)
{
    if (path[0] == '/')
        return false;
    while (path) {
        if (path[0] == '.' && path[1] == '.' && (path[2] == '/' || path[2] == '\0'))
            return false;
        path = strchr(path, '/');
        if (path)
            path += strspn(path, "/");
    }
    return true;
}

/* Does a symbolic link in `path` lead out of `base`? Old kernels, and some containers, have no openat2: there, any link at the end
 * of `path` counts as one. */
static bool leads_out(int base, const char *path)
{
    const struct open_how how = {.flags = O_PATH | O_DIRECTORY | O_CLOEXEC, .resolve = RESOLVE_BENEATH};
    struct stat found;
    const int descriptor = (int)syscall(SYS_openat2, base, path, &how, sizeof how);
    if (descriptor >= 0) {
        close(descriptor);
        return false;
    }
    if (errno == ENOENT || errno == ENOTDIR)
        return false;
    return errno == EXDEV || errno == ELOOP || (fstatat(base, path, &found, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(found.st_mode));
}

bool bead_file_stays_beneath(const char *directory, const char *path)
{
    char part[PATH_MAX];
    const int base = open(directory, O_PATH | O_DIRECTORY | O_CLOEXEC);
    bool stays = true;
    for (const char *slash = strchr(path, '/'); base >= 0 && stays && slash; slash = strchr(slash + 1, '/')) {
        const int length = snprintf(part, sizeof part, "%.*s", (int)(slash - path), path);
        stays = length < (int)sizeof part && (length == 0 || !leads_out(base, part));
    }
    if (base >= 0)
        close(base);
    return stays;
}

/* Names of the file that claims an unfinished one if there are no locks, and of the one that keeps others from taking over the
 * claim of a killed run. */
static const char claim_ending[] = ".lock", taking_ending[] = ".take";

/* Length of the beginning of `name` that has at most `most` bytes and only whole characters of UTF-8. */
static size_t whole_characters(const char *name, size_t most)
{
    while (most > 0 && ((unsigned char)name[most] & 0xC0) == 0x80)
        most--;
    return most;
}

enum bead_error bead_file_part_name(const char *path, char **part, struct bead_message *msg)
{
    static const char ending[] = ".part";
    char mark[32]; /* "~0123456789abcdef" */
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t length = strlen(name), room = NAME_MAX - (sizeof ending - 1) - (sizeof claim_ending - 1);
    if (length <= room || length > NAME_MAX)
        return concatenate(path, strlen(path), "", ending, part, msg);
    const int marked = snprintf(mark, sizeof mark, "~%016" PRIx64, bead_fingerprint(BEAD_FINGERPRINT_START, name, length));
    const size_t kept = (size_t)(name - path) + whole_characters(name, room - (size_t)marked);
    return concatenate(path, kept, mark, ending, part, msg);
}

static enum bead_error cannot_write(const char *part, int error, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written: %s", part,
                     error == ELOOP    ? "it is a symbolic link"
                     : error == ENXIO  ? "it is not a regular file"
                     : error == EMLINK ? "it is a file of other names, too (hard links)"
                                       : strerror(error));
}

/* A file renamed to `path` would replace a pipe or a device for good. */
static enum bead_error check_place(const char *path, struct bead_message *msg)
{
    struct stat found;
    if (lstat(path, &found) != 0 || S_ISREG(found.st_mode) || S_ISLNK(found.st_mode))
        return BEAD_OK;
    if (S_ISDIR(found.st_mode))
        return cannot_write(path, EISDIR, msg);
    return bead_fail(msg, BEAD_ERROR_IO,
                     "%s: is a pipe or a device, and files replace what is there; -o - writes to standard output", path);
}

enum bead_error bead_file_open(const char *part, int *descriptor, bool *created, struct bead_message *msg)
{
    /* O_NONBLOCK, as opening a FIFO without a reader would block. */
    const int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    struct stat found;
    bool made = true;
    *descriptor = open(part, flags | O_EXCL, 0666);
    if (*descriptor < 0 && errno == EEXIST) {
        made = false;
        *descriptor = open(part, flags, 0666);
    }
    if (*descriptor < 0)
        return cannot_write(part, errno, msg);
    if (created)
        *created = made;
    const bool regular = fstat(*descriptor, &found) == 0 && S_ISREG(found.st_mode);
    if (regular && found.st_nlink <= 1)
        return BEAD_OK;
    close(*descriptor);
    *descriptor = -1;
    return cannot_write(part, regular ? EMLINK : ENXIO, msg);
}

enum bead_error bead_file_create(const char *part, FILE **file, struct bead_message *msg)
{
    int descriptor;
    bool created;
    *file = NULL;
    BEAD_TRY(bead_file_open(part, &descriptor, &created, msg));
    if (ftruncate(descriptor, 0) == 0 && (*file = fdopen(descriptor, "wb")))
        return BEAD_OK;
    int error = errno;
    close(descriptor);
    if (created)
        unlink(part);
    return cannot_write(part, error, msg);
}

/* Returns 0 or an errno. EINVAL is not a failure: the file system cannot sync such an object. */
static int sync_open(int descriptor)
{
    return fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS ? errno : 0;
}

enum bead_error bead_file_close(FILE *file, const char *part, struct bead_message *msg)
{
    errno = 0;
    int failed = fflush(file) != 0 || ferror(file);
    int error = errno;
    if (!failed && (error = sync_open(fileno(file))))
        failed = 1; /* this descriptor reports all failures since its writes; commit opens another */
    if (fclose(file) != 0 && !failed) {
        failed = 1;
        error = errno;
    }
    if (failed)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed: %s", part, error ? strerror(error) : "an earlier write failed");
    return BEAD_OK;
}

/* "a/b" of "a/b/c", "/" of "/c", "." of "c"; to be freed, NULL: no memory. */
static char *directory_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
}

static int sync_path(const char *path, int flags)
{
    int fd = open(path, flags | O_CLOEXEC);
    if (fd < 0)
        return errno;
    int error = sync_open(fd);
    close(fd);
    return error;
}

/* The rename must reach the disk, too. A directory without read permission cannot be synced, which is not a failure. */
static void sync_directory(const char *path)
{
    BEAD_FREED char *directory = directory_of(path);
    if (directory)
        sync_path(directory, O_RDONLY | O_DIRECTORY);
}

enum bead_error bead_file_commit(const char *part, const char *path, struct bead_message *msg)
{
    enum bead_error err = check_place(path, msg);
    int error = err ? 0 : sync_path(part, O_RDONLY);
    if (!err && !error && rename(part, path) != 0)
        error = errno;
    if (error)
        err = bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be finished: %s", path, strerror(error));
    if (err) {
        unlink(part);
        return err;
    }
    sync_directory(path);
    return BEAD_OK;
}

struct bead_claim {
    struct bead_file_lock lock;
    char *part;
};

/* Does `part` still name the file that is open? It may have become its finished file. */
static bool still_names(const char *part, int descriptor)
{
    struct stat open_file, named;
    return fstat(descriptor, &open_file) == 0 && lstat(part, &named) == 0 && open_file.st_dev == named.st_dev &&
           open_file.st_ino == named.st_ino;
}

/* Claims beside a file name their owner: "PID HOST BOOT NAMESPACE"; process numbers are valid for one boot and one namespace. */
struct owner {
    int pid;
    char host[80], boot[64], space[64];
};

static struct owner this_process(void)
{
    struct owner own = {.pid = (int)getpid(), .host = "?", .boot = "?", .space = "?"};
    FILE *boot = fopen("/proc/sys/kernel/random/boot_id", "re");
    if (gethostname(own.host, sizeof own.host - 1) != 0 || !*own.host)
        strcpy(own.host, "?");
    if (boot && fscanf(boot, "%63s", own.boot) != 1)
        strcpy(own.boot, "?");
    if (boot)
        fclose(boot);
    const ssize_t length = readlink("/proc/self/ns/pid", own.space, sizeof own.space - 1);
    if (length > 0)
        own.space[length] = '\0';
    return own;
}

/* Finds the owner of a claim; false: the file does not name it, perhaps not yet. */
static bool read_owner(const char *beside, struct owner *owner)
{
    const int descriptor = open(beside, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "r");
    *owner = (struct owner){.host = "?"};
    const bool read = file && fscanf(file, "%d %79s %63s %63s", &owner->pid, owner->host, owner->boot, owner->space) == 4;
    if (file)
        fclose(file);
    else if (descriptor >= 0)
        close(descriptor);
    return read;
}

/* Was it a process of this machine that no longer exists? */
static bool is_gone(const struct owner *owner, const struct owner *own)
{
    return strcmp(own->boot, "?") != 0 && strcmp(own->space, "?") != 0 && strcmp(owner->boot, own->boot) == 0 &&
           strcmp(owner->space, own->space) == 0 && owner->pid > 0 && kill(owner->pid, 0) != 0 && errno == ESRCH;
}

/* Returns 0 or an errno; EEXIST: it is there. */
static int make_claim(const char *name, const struct owner *own)
{
    const int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return errno;
    const bool said = dprintf(descriptor, "%d %s %s %s\n", own->pid, own->host, own->boot, own->space) > 0;
    const int error = said ? 0 : errno;
    if (close(descriptor) == 0 && said)
        return 0;
    unlink(name);
    return error ? error : EIO;
}

/* If two runs find the claim of a killed one, the run that first makes the file `taking` takes it over. */
static void take_over(const char *beside, const char *taking, const struct owner *own)
{
    struct owner owner;
    if (make_claim(taking, own) != 0)
        return;
    if (read_owner(beside, &owner) && is_gone(&owner, own))
        unlink(beside);
    unlink(taking);
}

/* On file systems without locks: a file that only one run can make. */
static enum bead_error claim_beside(const char *part, const char *path, struct bead_file_lock *lock, struct bead_message *msg)
{
    BEAD_FREED char *taking = NULL;
    const struct owner own = this_process();
    struct owner owner;
    BEAD_TRY(concatenate(part, strlen(part), taking_ending, "", &taking, msg));
    BEAD_TRY(concatenate(part, strlen(part), claim_ending, "", &lock->beside, msg));
    int error = make_claim(lock->beside, &own);
    if (error == EEXIST && read_owner(lock->beside, &owner) && is_gone(&owner, &own)) {
        take_over(lock->beside, taking, &own);
        error = make_claim(lock->beside, &own);
    }
    if (!error)
        return BEAD_OK;
    BEAD_FREED char *name = lock->beside;
    lock->beside = NULL;
    if (error != EEXIST)
        return cannot_write(name, error, msg);
    if (!read_owner(name, &owner))
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: another run begins to write it; if there is none, remove %s", path, name);
    return bead_fail(msg, BEAD_ERROR_USAGE, "%s: another run is writing it, process %d on %s; if that is gone, remove %s", path,
                     owner.pid, owner.host, name);
}

enum bead_error bead_file_lock(const char *part, const char *path, struct bead_file_lock *lock, struct bead_message *msg)
{
    *lock = (struct bead_file_lock){.descriptor = -1};
    BEAD_TRY(check_place(path, msg));
    for (;;) { /* again if another run finished and renamed the file in between */
        BEAD_TRY(bead_file_open(part, &lock->descriptor, &lock->created, msg));
        enum bead_error err = BEAD_OK;
        const bool locked = flock(lock->descriptor, LOCK_EX | LOCK_NB) == 0;
        if (!locked && errno == EWOULDBLOCK)
            err = bead_fail(msg, BEAD_ERROR_USAGE, "%s: another run is writing it", path);
        else if (!locked)
            err = claim_beside(part, path, lock, msg);
        if (!err && still_names(part, lock->descriptor))
            return BEAD_OK;
        bead_file_unlock(lock);
        if (err)
            return err;
    }
}

void bead_file_unlock(struct bead_file_lock *lock)
{
    if (lock->beside)
        unlink(lock->beside);
    if (lock->descriptor >= 0)
        close(lock->descriptor);
    free(lock->beside);
    *lock = (struct bead_file_lock){.descriptor = -1};
}

enum bead_error bead_file_claim(const char *path, struct bead_claim **claim, struct bead_message *msg)
{
    *claim = NULL;
    struct bead_claim *made = calloc(1, sizeof *made);
    if (!made)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a file name");
    enum bead_error err = bead_file_part_name(path, &made->part, msg);
    if (!err)
        err = bead_file_lock(made->part, path, &made->lock, msg);
    if (!err) {
        *claim = made;
        return BEAD_OK;
    }
    free(made->part);
    free(made);
    return err;
}

const char *bead_file_claimed_by(const struct bead_claim *claim)
{
    return claim ? claim->lock.beside : NULL;
}

static void remove_part(const struct bead_claim *claim)
{
    if (claim->lock.created && still_names(claim->part, claim->lock.descriptor))
        unlink(claim->part);
}

void bead_file_abandon(const struct bead_claim *claim)
{
    if (!claim)
        return;
    remove_part(claim);
    if (claim->lock.beside)
        unlink(claim->lock.beside);
}

void bead_file_release(struct bead_claim *claim, bool keep)
{
    if (!claim)
        return;
    if (!keep)
        remove_part(claim);
    bead_file_unlock(&claim->lock);
    free(claim->part);
    free(claim);
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

double bead_file_room(const char *path)
{
    struct statvfs found;
    BEAD_FREED char *directory = directory_of(path);
    while (directory && statvfs(directory, &found) != 0) {
        if (errno != ENOENT || strcmp(directory, ".") == 0 || strcmp(directory, "/") == 0)
            return INFINITY;
        char *parent = directory_of(directory); /* of one that does not exist yet */
        free(directory);
        directory = parent;
    }
    return directory ? (double)found.f_bavail * (double)found.f_frsize : INFINITY;
}

enum bead_error bead_file_write(const char *path, bead_file_fill fill, void *context, uint64_t *bytes, struct bead_message *msg)
{
    BEAD_FREED char *part = NULL;
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

enum bead_error bead_file_make_parents(const char *path, struct bead_message *msg)
{
    const char *slash = strrchr(path, '/');
    if (!slash || slash == path)
        return BEAD_OK;
    BEAD_FREED char *directory = strndup(path, (size_t)(slash - path));
    if (!directory)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a file name");
    return bead_file_make_directory(directory, msg);
}
