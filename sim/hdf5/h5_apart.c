/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The process that reads HDF5 files, and questions to it: see h5_apart.h. */
#include "sim/hdf5/h5_apart.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/base/sandbox.h"
#include "sim/hdf5/h5_private.h"

/* Room for one read: a chunk of any trajectory, or a row of one with many beads, which is no longer than its file. */
static const size_t least_room = 16 << 20, most_room = 1 << 30;

/* Both processes see it. The asking process does not trust what the other one writes. */
struct shared {
    struct bead_h5_question question;
    char name[256];
    struct bead_h5_answer answer;
    enum bead_error error;
    struct bead_message message;
    _Alignas(64) char bytes[];
};

struct bead_h5_apart {
    pid_t process;
    int turn; /* socket */
    struct shared *shared;
    size_t room;
};

/* ---- in the process ---- */

/* `asks`: this process does not end if the other one has ended. */
static bool pass_turn(int turn, bool asks)
{
    const char byte = 0;
    ssize_t done;
    do {
        done = asks ? send(turn, &byte, 1, MSG_NOSIGNAL) : write(turn, &byte, 1);
    } while (done < 0 && errno == EINTR);
    return done == 1;
}

static bool wait_turn(int turn)
{
    char byte;
    ssize_t done;
    do {
        done = read(turn, &byte, 1);
    } while (done < 0 && errno == EINTR);
    return done == 1;
}

static _Noreturn void live(struct bead_h5 *asked, int file, int turn, struct shared *shared, bead_h5_answerer answer)
{
    struct bead_h5 h5 = *asked;
    h5.apart = NULL;
    h5.check.file = file;
    while (wait_turn(turn)) {
        h5.error = BEAD_OK;
        h5.msg = &shared->message;
        shared->answer = answer(&h5, shared->name, shared->question, shared->bytes);
        shared->error = h5.error;
        if (!pass_turn(turn, false))
            break;
    }
    _exit(0);
}

/* ---- the asking process ---- */

/* The process ended without being asked to. */
static void tell_end(struct bead_h5 *h5)
{
    int status = 0;
    const bool known = bead_sandbox_end(h5->apart->process, &status);
    h5->apart->process = -1;
    if (known && WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
        bead_h5_fail(h5, false, "damaged: HDF5 crashes on it (%s)", strsignal(WTERMSIG(status)));
    else
        bead_h5_fail(h5, false, "cannot be read: the process that reads it has ended");
}

static void put_down(const struct bead_h5_place *place, const char *bytes)
{
    if (place->stride == place->size)
        memcpy(place->first, bytes, place->size * place->count);
    else
        for (size_t i = 0; i < place->count; i++)
            memcpy((char *)place->first + i * place->stride, bytes + i * place->size, place->size);
    if (place->size * place->count > least_room) /* back to the system */
        madvise((void *)((uintptr_t)(bytes + 4096) & ~(uintptr_t)4095), place->size * place->count - 4096, MADV_REMOVE);
}

struct bead_h5_answer bead_h5_ask(struct bead_h5 *h5, const char *name, struct bead_h5_question question,
                                  const struct bead_h5_place *place)
{
    struct bead_h5_apart *apart = h5->apart;
    struct shared *s = apart->shared;
    size_t bytes = 0;
    if (h5->error)
        return (struct bead_h5_answer){0};
    if (apart->process < 0 || (name && strlen(name) >= sizeof s->name) ||
        (place && (__builtin_mul_overflow(place->size, place->count, &bytes) || bytes > apart->room))) {
        bead_h5_fail(h5, false, apart->process < 0 ? "cannot be read" : "%s is too large to be read", name ? name : "a row");
        return (struct bead_h5_answer){0};
    }
    s->question = question;
    s->name[0] = '\0';
    if (name)
        strcpy(s->name, name);
    if (!pass_turn(apart->turn, true) || !wait_turn(apart->turn)) {
        tell_end(h5);
        return (struct bead_h5_answer){0};
    }
    const enum bead_error error = s->error;
    if (error) {
        struct bead_message message = s->message;
        message.text[sizeof message.text - 1] = '\0';
        h5->error = bead_fail(h5->msg, error, "%s", message.text);
        return (struct bead_h5_answer){0};
    }
    if (place)
        put_down(place, s->bytes);
    return s->answer;
}

size_t bead_h5_apart_room(const struct bead_h5 *h5)
{
    return h5->apart->room;
}

const char *bead_h5_apart_bytes(const struct bead_h5 *h5)
{
    return h5->apart->shared->bytes;
}

static bool start(struct bead_h5 *h5, struct bead_h5_apart *apart, bead_h5_answerer answer)
{
    int turns[2];
    apart->room = (h5->bytes < most_room ? (size_t)h5->bytes : most_room) + least_room;
    apart->shared =
        mmap(NULL, sizeof *apart->shared + apart->room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (apart->shared == MAP_FAILED)
        return false;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, turns) != 0)
        return false;
    apart->turn = turns[0];
    const int file = h5->check.file;
    apart->process = bead_sandbox_fork((const int[]){file, turns[1]}, 2);
    if (apart->process == 0)
        live(h5, file, turns[1], apart->shared, answer);
    close(turns[1]); /* errno remains that of the fork */
    return apart->process > 0;
}

void bead_h5_apart_open(struct bead_h5 *h5, bead_h5_answerer answer)
{
    struct bead_h5_apart *apart = calloc(1, sizeof *apart);
    if (!apart) {
        h5->error = bead_fail(h5->msg, BEAD_ERROR_MEMORY, "%s: no memory to read it", h5->path);
        return;
    }
    apart->shared = MAP_FAILED;
    apart->turn = apart->process = -1;
    h5->apart = apart;
    if (start(h5, apart, answer))
        bead_h5_ask(h5, NULL, (struct bead_h5_question){.what = BEAD_H5_OPEN}, NULL);
    else
        h5->error = bead_fail(h5->msg, errno == ENOMEM ? BEAD_ERROR_MEMORY : BEAD_ERROR_IO,
                              "%s: cannot be read: no process can be started for it: %s", h5->path, strerror(errno));
    if (h5->error)
        bead_h5_apart_close(h5);
}

void bead_h5_apart_close(struct bead_h5 *h5)
{
    struct bead_h5_apart *apart = h5->apart;
    int status;
    if (!apart)
        return;
    if (apart->process > 0)
        (void)bead_sandbox_end(apart->process, &status);
    if (apart->turn >= 0)
        close(apart->turn);
    if (apart->shared != MAP_FAILED)
        munmap(apart->shared, sizeof *apart->shared + apart->room);
    free(apart);
    h5->apart = NULL;
}
