/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The journal of a sweep: a head, then one record for each chain, in the order in which they finished. A killed process leaves
 * complete records and at most one incomplete one, which the next process cuts off. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/base/clock.h"
#include "sim/base/file.h"
#include "sim/base/fingerprint.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

static const char magic[16] = "beadreel-sweep\n";
enum { FORMAT = 5 };
/* A power failure may lose this many seconds of work. */
static const double sync_every = 1;

struct head {
    char magic[16];
    uint64_t format, version, fingerprint, jobs, part, parts, check;
};

struct bead_sweep_journal {
    struct bead_file_lock lock;
    int file; /* the locked file */
    char *path;
    uint64_t *record; /* label, results, checksum */
    double synced;    /* s, clock */
    bool empty;       /* begun by this run, with no record yet */
};

/* The first word of a record: its job, and its length in words, so that records can be counted without the sweep. */
enum { JOB_BITS = 40 };

static uint64_t label_of(size_t job, size_t words)
{
    return (uint64_t)words << JOB_BITS | job;
}

static size_t job_of(uint64_t label)
{
    return (size_t)(label & (((uint64_t)1 << JOB_BITS) - 1));
}

static enum bead_error failed(const struct bead_sweep_journal *j, const char *what, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_IO, "%s: %s: %s", j->path, what, strerror(errno));
}

static struct head head_of(const struct bead_sweep *sweep)
{
    struct head head = {.format = FORMAT,
                        .version = bead_fingerprint(BEAD_FINGERPRINT_START, sweep->version, strlen(sweep->version)),
                        .fingerprint = sweep->scene->fingerprint,
                        .jobs = sweep->jobs,
                        .part = sweep->part,
                        .parts = sweep->parts};
    memcpy(head.magic, magic, sizeof head.magic);
    head.check = bead_fingerprint(BEAD_FINGERPRINT_START, &head, offsetof(struct head, check));
    return head;
}

/* Copies a job's results into a record: label, peaks, profiles, checksum. Returns its words. */
static size_t pack(const struct bead_sweep *sweep, size_t job, uint64_t *record)
{
    size_t row = 0;
    const struct sweep_panel *p = bead_sweep_panel_of(sweep, job, &row);
    size_t peaks = PEAK_WORDS * p->shown.places, words = bead_sweep_words(p);
    _Static_assert(sizeof(struct bead_sweep_peak) % sizeof(uint64_t) == 0, "a peak is whole words");
    record[0] = label_of(job, words + 2);
    if (peaks > 0)
        memcpy(record + 1, p->peaks + row * p->shown.places, peaks * sizeof *record);
    if (p->profiles)
        memcpy(record + 1 + peaks, p->profiles + PROFILES * row * p->shown.beads, (words - peaks) * sizeof *record);
    record[words + 1] = bead_fingerprint(sweep->scene->fingerprint, record, (words + 1) * sizeof *record);
    return words + 2;
}

static void unpack(struct bead_sweep *sweep, const uint64_t *record)
{
    size_t row = 0, job = job_of(record[0]);
    struct sweep_panel *p = bead_sweep_panel_of(sweep, job, &row);
    size_t peaks = PEAK_WORDS * p->shown.places, words = bead_sweep_words(p);
    if (peaks > 0)
        memcpy(p->peaks + row * p->shown.places, record + 1, peaks * sizeof *record);
    if (p->profiles)
        memcpy(p->profiles + PROFILES * row * p->shown.beads, record + 1 + peaks, (words - peaks) * sizeof *record);
    sweep->known[job] = 1;
}

/* Reads `size` bytes at `at`; false: the file is too short (errno 0), or an error (errno). */
static bool read_at(int file, void *bytes, size_t size, off_t at)
{
    size_t got = 0;
    errno = 0;
    while (got < size) {
        ssize_t more = pread(file, (char *)bytes + got, size - got, at + (off_t)got);
        if (more < 0 && errno == EINTR)
            continue;
        if (more <= 0)
            return false;
        got += (size_t)more;
    }
    return true;
}

static bool write_all(int file, const void *bytes, size_t size)
{
    size_t put = 0;
    while (put < size) {
        ssize_t more = write(file, (const char *)bytes + put, size - put);
        if (more < 0 && errno == EINTR)
            continue;
        if (more < 0)
            return false;
        put += (size_t)more;
    }
    return true;
}

/* Loads complete records and sets *end to their end. */
static enum bead_error take_records(struct bead_sweep_journal *j, struct bead_sweep *sweep, off_t *end, struct bead_message *msg)
{
    uint64_t label;
    while (read_at(j->file, &label, sizeof label, *end) && job_of(label) < sweep->jobs) {
        size_t row = 0, job = job_of(label), words = bead_sweep_words(bead_sweep_panel_of(sweep, job, &row));
        size_t size = (words + 2) * sizeof *j->record;
        if (!read_at(j->file, j->record, size, *end))
            break;
        if (j->record[words + 1] != bead_fingerprint(sweep->scene->fingerprint, j->record, (words + 1) * sizeof *j->record))
            break;
        if (bead_sweep_mine(sweep, job))
            unpack(sweep, j->record);
        *end += (off_t)size;
    }
    return errno ? failed(j, "cannot be read", msg) : BEAD_OK;
}

/* An incomplete head counts as a fresh journal; the head of another sweep is an error. */
static enum bead_error check_head(struct bead_sweep_journal *j, const struct bead_sweep *sweep, bool *fresh,
                                  struct bead_message *msg)
{
    struct head wanted = head_of(sweep), found;
    off_t length = lseek(j->file, 0, SEEK_END);
    if (length < 0)
        return failed(j, "cannot be read", msg);
    *fresh = length < (off_t)sizeof found;
    if (*fresh && length > 0) {
        memset(&found, 0, sizeof found);
        if (!read_at(j->file, &found, (size_t)length, 0) || memcmp(&found, &wanted, (size_t)length) != 0)
            return bead_fail(msg, BEAD_ERROR_USAGE, "%s: is not the journal of this sweep; remove it to start over", j->path);
    }
    if (*fresh)
        return BEAD_OK;
    if (!read_at(j->file, &found, sizeof found, 0))
        return failed(j, "cannot be read", msg);
    if (memcmp(found.magic, magic, sizeof magic) != 0 || found.format != FORMAT ||
        found.check != bead_fingerprint(BEAD_FINGERPRINT_START, &found, offsetof(struct head, check)))
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: is not a journal of a sweep; remove it to start over", j->path);
    const char *differs = found.version != wanted.version                                        ? "another version of the program"
                          : found.fingerprint != wanted.fingerprint || found.jobs != wanted.jobs ? "another scene"
                          : found.part != wanted.part || found.parts != wanted.parts             ? "another part of the sweep"
                                                                                                 : NULL;
    if (differs)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: holds the unfinished results of %s; remove it to start over", j->path,
                         differs);
    return BEAD_OK;
}

static enum bead_error journal_begin(struct bead_sweep_journal *j, struct bead_sweep *sweep, struct bead_message *msg)
{
    bool fresh = false;
    struct head head = head_of(sweep);
    off_t end = (off_t)sizeof head;
    BEAD_TRY(bead_file_lock(j->path, j->path, &j->lock, msg));
    j->file = j->lock.descriptor;
    enum bead_error err = check_head(j, sweep, &fresh, msg);
    j->empty = !err && fresh;
    if (!err && fresh &&
        (ftruncate(j->file, 0) != 0 || lseek(j->file, 0, SEEK_SET) != 0 || !write_all(j->file, &head, sizeof head)))
        err = failed(j, "cannot be written", msg);
    if (!err && !fresh)
        err = take_records(j, sweep, &end, msg);
    if (!err && (ftruncate(j->file, end) != 0 || lseek(j->file, end, SEEK_SET) != end))
        err = failed(j, "cannot be written", msg);
    return err;
}

enum bead_error bead_sweep_journal_open(struct bead_sweep *sweep, const char *path, struct bead_sweep_journal **journal,
                                        struct bead_message *msg)
{
    size_t words = 0;
    *journal = NULL;
    for (size_t p = 0; p < sweep->panel_count; p++)
        words = bead_sweep_words(&sweep->panels[p]) > words ? bead_sweep_words(&sweep->panels[p]) : words;
    struct bead_sweep_journal *j = calloc(1, sizeof *j);
    if (!j || !(j->path = strdup(path)) || !(j->record = calloc(words + 2, sizeof *j->record))) {
        if (j)
            free(j->path);
        free(j);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a journal");
    }
    j->synced = bead_clock();
    enum bead_error err = journal_begin(j, sweep, msg);
    if (err)
        bead_sweep_journal_close(j);
    else
        *journal = j;
    return err;
}

bool bead_sweep_journal_look(const char *path, struct bead_sweep_progress *progress)
{
    struct head head;
    uint64_t label;
    int file = bead_file_look(path);
    bool is = file >= 0 && read_at(file, &head, sizeof head, 0) && memcmp(head.magic, magic, sizeof magic) == 0;
    *progress = (struct bead_sweep_progress){0};
    if (is) {
        *progress =
            (struct bead_sweep_progress){.chains = (size_t)head.jobs, .part = (size_t)head.part, .parts = (size_t)head.parts};
        off_t end = lseek(file, 0, SEEK_END), at = (off_t)sizeof head;
        while (at < end && read_at(file, &label, sizeof label, at)) {
            off_t words = (off_t)(label >> JOB_BITS);
            if (words < 2 || words > (end - at) / (off_t)sizeof label)
                break;
            at += words * (off_t)sizeof label;
            progress->done++;
        }
    }
    if (file >= 0)
        close(file);
    return is;
}

enum bead_error bead_sweep_journal_add(struct bead_sweep_journal *j, const struct bead_sweep *sweep, size_t job,
                                       struct bead_message *msg)
{
    size_t words = pack(sweep, job, j->record);
    j->empty = false;
    if (!write_all(j->file, j->record, words * sizeof *j->record))
        return failed(j, "cannot be written", msg);
    if (bead_clock() - j->synced > sync_every) {
        if (fdatasync(j->file) != 0)
            return failed(j, "cannot be written", msg);
        j->synced = bead_clock();
    }
    return BEAD_OK;
}

void bead_sweep_journal_close(struct bead_sweep_journal *j)
{
    if (!j)
        return;
    if (j->empty)
        bead_file_discard(j->path); /* before the lock is released */
    bead_file_unlock(&j->lock);     /* all is written */
    free(j->path);
    free(j->record);
    free(j);
}
