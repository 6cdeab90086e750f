/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trajectory whose run is killed can be read, whenever that happens: after each of its writes. */
#include "trajectory_support.h"

#include <fcntl.h>
#include <stdbool.h>
#include <sys/syscall.h>

#include "sim/output/trajectory_sink.h"

/* What the program did to its file: bytes written at an offset, or (with no bytes) its new length. */
struct change {
    off_t offset;
    size_t size;
    unsigned char *bytes;
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
    *change = (struct change){offset, size, malloc(size + 1)};
    assert_non_null(change->bytes);
    if (size)
        memcpy(change->bytes, bytes, size);
}

/* These stand before the C library's. */
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

static void repeat(int file, const struct change *change)
{
    if (change->size)
        assert_int_equal(pwrite(file, change->bytes, change->size, change->offset), change->size);
    else
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

static void every_write_leaves_a_readable_file(void **state)
{
    (void)state;
    struct stand s;
    struct bead_message msg = {""};
    if (try_set_up(&s, TWO_CHAINS, "trajectory: run.h5, every: 1 us, fields: [displacement, velocity, contact-force]", 0.6e-3,
                   &msg))
        fail_msg("%s", msg.text);
    s.sink->chunk_rows = 4; /* so that the indices of chunks grow, and split */
    recording = true;
    begin(&s);
    for (int i = 0; i < 150; i++) {
        deliver(&s, 2);
        if (i % 40 == 0) { /* half a chunk is flushed, too */
            s.sink->flushed -= 10;
            deliver(&s, 1);
            s.sink->flushed -= 10;
            deliver(&s, 1);
        }
    }
    const size_t delivered = s.next;
    finish(&s);
    recording = false;

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
    for (size_t i = 0; i < change_count; i++)
        free(changes[i].bytes);
    free(changes);
    tear_down(&s, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_write_leaves_a_readable_file)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
