/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files as FFmpeg's libraries read, write and search them: every byte, from any place, as the system does it. */
#include "movies.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "render/encode/av_file.h"

enum { BYTES = 37 };

static int open_with(const uint8_t *bytes, size_t count)
{
    const int descriptor = open(place("file"), O_RDWR | O_CREAT | O_TRUNC, 0600);
    assert_true(descriptor >= 0 && pwrite(descriptor, bytes, count, 0) == (ssize_t)count);
    return descriptor;
}

static void close_file(AVIOContext *context, int descriptor)
{
    bead_av_file_unwrap(&context);
    assert_null(context);
    assert_int_equal(close(descriptor), 0);
    assert_int_equal(unlink(place("file")), 0);
}

/* In parts of any size, one byte, too, from any place up to the end, which is told. */
static void files_are_read_to_their_last_byte(void **)
{
    uint8_t bytes[BYTES], got[BYTES + 1];
    for (int i = 0; i < BYTES; i++)
        bytes[i] = (uint8_t)(7 * i + 1);
    for (int size = 1; size <= BYTES; size++) {
        const int descriptor = open_with(bytes, BYTES);
        AVIOContext *context = bead_av_file_wrap(descriptor, false);
        assert_true(context && !context->write_flag && context->buffer_size > 65536);
        for (int from = 0; from <= BYTES; from += 5) {
            int at = from;
            assert_int_equal(context->seek(context->opaque, from, SEEK_SET), from);
            for (int read; (read = context->read_packet(context->opaque, got, size)) > 0; at += read) {
                assert_true(read == size || at + read == BYTES);
                assert_memory_equal(got, bytes + at, (size_t)read);
            }
            assert_int_equal(at, BYTES);
            assert_int_equal(context->read_packet(context->opaque, got, size), AVERROR_EOF);
        }
        close_file(context, descriptor);
    }
}

/* From the beginning, the end, and where the last byte was read or written; before the file there is nothing. */
static void places_are_found(void **)
{
    static const uint8_t bytes[BYTES] = {1, 2, 3};
    const int descriptor = open_with(bytes, BYTES);
    AVIOContext *context = bead_av_file_wrap(descriptor, true);
    uint8_t got[8];
    assert_non_null(context);
    void *const place_in = context->opaque;
    assert_int_equal(context->seek(place_in, 0, AVSEEK_SIZE), BYTES);
    assert_int_equal(context->seek(place_in, 0, SEEK_CUR), 0);
    assert_int_equal(context->read_packet(place_in, got, 8), 8);
    assert_int_equal(context->seek(place_in, 0, SEEK_CUR), 8);
    assert_int_equal(context->seek(place_in, -3, SEEK_CUR), 5);
    assert_int_equal(context->seek(place_in, -2, SEEK_END), BYTES - 2);
    assert_int_equal(context->seek(place_in, 2, SEEK_SET), 2);
    assert_int_equal(context->seek(place_in, 0, AVSEEK_SIZE), BYTES); /* stays where it is */
    assert_int_equal(context->seek(place_in, 0, SEEK_CUR), 2);
    assert_int_equal(context->seek(place_in, -3, SEEK_CUR), AVERROR(EINVAL));
    assert_int_equal(context->seek(place_in, -1, SEEK_SET), AVERROR(EINVAL));
    assert_int_equal(context->seek(place_in, 0, SEEK_CUR), 2);
    assert_int_equal(context->seek(place_in, -2, SEEK_CUR), 0);
    close_file(context, descriptor);
}

/* One after the other, over what was there, and beyond the end. */
static void files_are_written(void **)
{
    uint8_t bytes[BYTES] = {0}, other[BYTES], got[2 * BYTES];
    for (int i = 0; i < BYTES; i++)
        other[i] = (uint8_t)(i + 100);
    const int descriptor = open_with(bytes, BYTES);
    AVIOContext *context = bead_av_file_wrap(descriptor, true);
    assert_true(context && context->write_flag);
    assert_int_equal(context->seek(context->opaque, BYTES - 5, SEEK_SET), BYTES - 5);
    for (int size = 1, at = 0; at < BYTES; at += size++) {
        size = size < BYTES - at ? size : BYTES - at;
        assert_int_equal(context->write_packet(context->opaque, other + at, size), size);
    }
    assert_int_equal(context->seek(context->opaque, 0, SEEK_CUR), 2 * BYTES - 5);
    assert_int_equal(pread(descriptor, got, sizeof got, 0), 2 * BYTES - 5);
    assert_memory_equal(got, bytes, BYTES - 5);
    assert_memory_equal(got + BYTES - 5, other, BYTES);
    close_file(context, descriptor);
}

/* What a file of this name had is gone; one that cannot be read or written tells the system's reason. */
static void failures_have_their_reasons(void **)
{
    static const uint8_t bytes[BYTES] = {1};
    struct bead_message msg = {""};
    struct stat status;
    uint8_t got[4];
    int descriptor = open_with(bytes, BYTES), again;
    assert_int_equal(bead_av_file_create(place("file"), &again, &msg), BEAD_OK);
    assert_true(fstat(again, &status) == 0 && status.st_size == 0);
    assert_int_equal(close(again), 0);
    AVIOContext *context = bead_av_file_wrap(descriptor, true);
    assert_non_null(context);
    close_file(context, descriptor);
    assert_int_equal(bead_av_file_create(place("missing/file"), &again, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "missing/file"));
    context = bead_av_file_wrap(-1, true);
    assert_non_null(context);
    assert_int_equal(context->read_packet(context->opaque, got, 4), AVERROR(EBADF));
    assert_int_equal(context->write_packet(context->opaque, got, 4), AVERROR(EBADF));
    assert_int_equal(context->seek(context->opaque, 0, SEEK_END), AVERROR(EBADF));
    assert_int_equal(context->seek(context->opaque, 3, SEEK_SET), 3);
    bead_av_file_unwrap(&context);
    bead_av_file_unwrap(&context);
    bead_av_file_unwrap(NULL);
}

static int open_libav(void **state)
{
    return bead_av_open(NULL) ? -1 : make_directory(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_read_to_their_last_byte),
        cmocka_unit_test(places_are_found),
        cmocka_unit_test(files_are_written),
        cmocka_unit_test(failures_have_their_reasons),
    };
    return cmocka_run_group_tests_name("files of libav", tests, open_libav, remove_directory);
}
