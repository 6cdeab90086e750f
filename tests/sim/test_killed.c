/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trajectory whose run is killed can be read, after whichever of its writes that happens. So can one whose disk lost power,
 * whatever it kept of the data written since the last sync. */
#include "trajectory_support.h"

#include <fcntl.h>
#include <stdbool.h>
#include <sys/syscall.h>

#include "sim/hdf5/h5.h"
#include "sim/trajectory/trajectory_data.h"
#include "sim/trajectory/trajectory_sink.h"

/* The program's operations on its file: bytes written at an offset, or (without bytes) its new length; or a wait for the disk. */
struct change {
    off_t offset;
    size_t size;
    unsigned char *bytes;
    bool waited;
};
static struct change *changes;
static size_t change_count;
static bool recording;

static void record(off_t offset, const void *bytes, size_t size)
{
    if (!recording)
        return;
    struct change *grown = realloc(changes, (change_count + 1) * sizeof *changes);
    assert_non_null(grown);
    changes = grown;
    struct change *change = &changes[change_count++];
    *change = (struct change){offset, size, malloc(size + 1), false};
    assert_non_null(change->bytes);
    if (size)
        memcpy(change->bytes, bytes, size);
}

/* These precede the C library's. */
ssize_t pwrite(int file, const void *bytes, size_t size, off_t offset)
{
    record(offset, bytes, size);
    return syscall(SYS_pwrite64, file, bytes, size, offset);
}
int ftruncate(int file, off_t length)
{
    record(length, NULL, 0);
    return (int)syscall(SYS_ftruncate, file, length);
}

int fdatasync(int file)
{
    record(0, NULL, 0);
    if (!recording)
        return (int)syscall(SYS_fdatasync, file);
    changes[change_count - 1].waited = true;
    return 0;
}

static void repeat(int file, const struct change *change)
{
    if (change->size)
        assert_int_equal(pwrite(file, change->bytes, change->size, change->offset), change->size);
    else if (!change->waited)
        assert_int_equal(ftruncate(file, change->offset), 0);
}

/* All samples that the file has are those that were written. Returns their number. */
static size_t check_file(const char *path, size_t change)
{
    struct bead_message msg = {""};
    struct bead_trajectory *t = NULL;
    if (bead_trajectory_open(path, NULL, &t, &msg))
        fail_msg("killed after change %zu of %zu: %s", change, change_count, msg.text);
    size_t chains, samples = bead_grid_count(bead_trajectory_grid(t));
    const unsigned fields =
        BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE);
    const struct bead_chain *const *chain = bead_trajectory_chains(t, &chains);
    for (size_t i = 0; i < samples; i++)
        for (size_t c = 0; c < chains; c++) {
            struct bead_sample sample;
            if (bead_trajectory_read(t, i, c, fields, &sample, &msg))
                fail_msg("killed after change %zu of %zu: %s", change, change_count, msg.text);
            for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
                for (size_t j = 0; sample.field[f] && j < bead_chain_contacts(chain[c]); j++)
                    if (sample.field[f][j] != made_up(c, f, i, j))
                        fail_msg("killed after change %zu: sample %zu of %zu is not what was written", change, i, samples);
        }
    bead_trajectory_close(t);
    return samples;
}

/* A run of about 300 samples, recorded; returns how many. */
static size_t record_run(struct stand *s)
{
    struct bead_message msg = {""};
    if (try_set_up(s, TWO_CHAINS, "trajectory: run.h5, every: 1 us, fields: [displacement, velocity, contact-force]", 0.6e-3, &msg))
        fail_msg("%s", msg.text);
    s->sink->chunk_rows = 4; /* so that the indices of chunks grow, and split */
    recording = true;
    begin(s);
    for (int i = 0; i < 150; i++) {
        deliver(s, 2);
        if (i % 40 == 0) { /* half a chunk is also flushed */
            s->sink->flushed -= 10;
            deliver(s, 1);
            s->sink->flushed -= 10;
            deliver(s, 1);
        }
    }
    const size_t delivered = s->next;
    finish(s);
    recording = false;
    return delivered;
}

static void forget_run(struct stand *s)
{
    for (size_t i = 0; i < change_count; i++)
        free(changes[i].bytes);
    free(changes);
    changes = NULL;
    change_count = 0;
    tear_down(s, 2);
}

/* The names of a group, and its table of them, cannot be read half old and half new: one page has all of them. Both begin with four
 * letters; names with their length in byte 8, behind a head of 32 bytes, tables are of 328. */
static void groups_lie_in_one_page(const char *path)
{
    enum { PAGE = 4096, HEAD = 32, TABLE = 328, MOST = 1 << 20 };
    unsigned char *bytes = calloc(1, MOST);
    const int file = open(path, O_RDONLY);
    assert_non_null(bytes);
    const ssize_t size = read(file, bytes, MOST);
    size_t found = 0;
    for (ssize_t at = 0; at + TABLE < size; at++) {
        const bool names = memcmp(bytes + at, "HEAP", 4) == 0;
        const ssize_t last = at + (names ? HEAD + bytes[at + 8] + 256 * bytes[at + 9] : TABLE) - 1;
        if (!names && memcmp(bytes + at, "SNOD", 4) != 0)
            continue;
        if (at / PAGE != last / PAGE)
            fail_msg("%.4s, bytes %zd to %zd", (const char *)bytes + at, at, last);
        found++;
    }
    assert_true(found > 20);
    close(file);
    free(bytes);
}

/* Titles of many lengths move them. */
static void names_of_groups_are_never_halved(void **state)
{
    (void)state;
    for (int length = 1; length < 990; length += 41) {
        struct stand s;
        struct bead_message msg = {""};
        char scene[2048];
        snprintf(scene, sizeof scene, "title: %0*d x\n" TWO_CHAINS, length, 0);
        if (try_set_up(&s, scene, "trajectory: run.h5, every: 1 us, fields: [displacement]", 1e-6, &msg))
            fail_msg("%s", msg.text);
        begin(&s);
        deliver(&s, 2);
        finish(&s);
        groups_lie_in_one_page(s.path);
        tear_down(&s, 1);
    }
}

static void every_write_leaves_a_readable_file(void **state)
{
    (void)state;
    struct stand s;
    const size_t delivered = record_run(&s);
    char path[160];
    snprintf(path, sizeof path, "%s/copy.h5", s.directory);
    int file = open(path, O_RDWR | O_CREAT, 0600);
    assert_true(file >= 0);
    size_t least = 0;
    bool begun = false;
    for (size_t i = 0; i < change_count; i++) {
        repeat(file, &changes[i]);
        if (!begun && !bead_trajectory_is(path)) /* nothing is known of it yet */
            continue;
        begun = true;
        size_t samples = check_file(path, i);
        if (samples < least)
            fail_msg("change %zu of %zu takes samples away: %zu, %zu before", i, change_count, samples, least);
        least = samples;
    }
    assert_int_equal(least, delivered);
    close(file);
    forget_run(&s);
}

/* Of a change, the pages that a disk keeps which keeps one with the probability `kept`. */
static void keep_some(int file, const struct change *change, double kept)
{
    enum { PAGE = 4096 };
    if (change->size == 0 && drand48() < kept)
        repeat(file, change);
    for (size_t from = 0; from < change->size;) {
        const size_t left = change->size - from, page = PAGE - (size_t)(change->offset + (off_t)from) % PAGE;
        struct change part = {change->offset + (off_t)from, page < left ? page : left, change->bytes + from, false};
        if (drand48() < kept)
            repeat(file, &part);
        from += part.size;
    }
}

/* The power fails after each change: what came before the last wait is on the disk, of what came after it any page may be. All
 * samples are there that were when the disk was last waited for. */
static void a_disk_without_power_keeps_a_readable_file(void **state)
{
    (void)state;
    struct stand s;
    char path[160], lost[160];
    size_t cases = 0;
    record_run(&s);
    srand48(1);
    snprintf(path, sizeof path, "%s/copy.h5", s.directory);
    snprintf(lost, sizeof lost, "%s/lost.h5", s.directory);
    const int file = open(path, O_RDWR | O_CREAT, 0600);
    assert_true(file >= 0);
    size_t waited = 0, samples = 0;
    for (size_t i = 0; i < change_count; i++) {
        if (changes[i].waited) {
            for (; waited < i; waited++)
                repeat(file, &changes[waited]);
            samples = bead_trajectory_is(path) ? check_file(path, i) : 0;
            continue;
        }
        if (samples) {
            unsigned char block[65536];
            const int disk = open(lost, O_RDWR | O_CREAT | O_TRUNC, 0600);
            ssize_t got;
            for (off_t at = 0; (got = pread(file, block, sizeof block, at)) > 0; at += got)
                assert_int_equal(write(disk, block, (size_t)got), got);
            const double kept = drand48();
            for (size_t c = waited; c <= i; c++)
                keep_some(disk, &changes[c], kept);
            close(disk);
            const size_t left = check_file(lost, i);
            if (left < samples)
                fail_msg("power lost after change %zu of %zu: %zu of %zu samples are left", i, change_count, left, samples);
            cases++;
        }
    }
    assert_true(cases > 500);
    print_message("power lost %zu times\n", cases);
    close(file);
    unlink(lost);
    forget_run(&s);
}

int main(void)
{
    bead_h5_stay_in_process(); /* thousands of files: a process for each would take most of the time */
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_write_leaves_a_readable_file),
                                       cmocka_unit_test(names_of_groups_are_never_halved),
                                       cmocka_unit_test(a_disk_without_power_keeps_a_readable_file)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
