/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills through libav: pictures read back equal those drawn, with their colours and their size on paper. */
#include "movies.h"

#include <math.h>

#include "decode.h"
#include "render/encode/picture_file.h"
#include "sim/base/memory.h"

/* R, G, B of a pixel; from full-range YCbCr by the equations of JFIF (ITU-T T.871, clause 7). */
static void colour_of(const AVFrame *picture, int x, int y, double rgb[3])
{
    if (picture->format == AV_PIX_FMT_YUVJ444P || picture->format == AV_PIX_FMT_YUV444P) {
        double ycc[3];
        for (int c = 0; c < 3; c++)
            ycc[c] = picture->data[c][y * picture->linesize[c] + x] - (c ? 128 : 0);
        rgb[0] = ycc[0] + 1.402 * ycc[2];
        rgb[1] = ycc[0] - (0.114 * 1.772 * ycc[1] + 0.299 * 1.402 * ycc[2]) / 0.587;
        rgb[2] = ycc[0] + 1.772 * ycc[1];
        return;
    }
    int exact[3];
    decoded_rgb(picture, x, y, exact);
    for (int c = 0; c < 3; c++)
        rgb[c] = exact[c];
}

/* dB, of all three colours. */
static double psnr(const AVFrame *picture, const struct bead_frame *frame)
{
    double sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t *bgr = frame->pixels + (size_t)(i / WIDTH) * frame->stride + 4 * (size_t)(i % WIDTH);
        double rgb[3];
        colour_of(picture, i % WIDTH, i / WIDTH, rgb);
        for (int c = 0; c < 3; c++)
            sum += pow(rgb[c] - bgr[2 - c], 2) / (3.0 * WIDTH * HEIGHT);
    }
    return 10 * log10(255 * 255 / sum);
}

static void write_still(const char *path, const struct bead_frame *frame)
{
    const struct bead_picture_notes notes = {.size = sizeof notes, .dpi = 300};
    struct bead_message msg = {""};
    uint64_t bytes;
    assert_int_equal(bead_picture_check(path, WIDTH, HEIGHT, false, &msg), BEAD_OK);
    if (bead_picture_write(path, frame, &notes, &bytes, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bytes, bead_file_bytes(path));
}

static void every_format_shows_what_was_drawn(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double psnr; /* dB, at least */
    } stills[] = {{"still.jpg", 45},        {"still.JPEG", 45},       {"still.tif", INFINITY},
                  {"still.tiff", INFINITY}, {"still.webp", INFINITY}, {"still.avif", 42}};
    struct bead_frame frame;
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    draw(&frame, 0);
    for (size_t i = 0; i < sizeof stills / sizeof *stills; i++) {
        const char *path = place(stills[i].name);
        write_still(path, &frame);
        struct decoded still;
        decode(path, &still);
        assert_int_equal(still.count, 1);
        const double found = psnr(still.frame[0], &frame);
        if (!(found >= stills[i].psnr))
            fail_msg("%s: %.1f dB", stills[i].name, found);
        decoded_free(&still);
        unlink(path);
    }
    bead_frame_free(&frame);
}

/* TIFF 6.0: a directory of entries of 12 bytes (tag, type, count, value or place of the value); 282 and 283 are pixels in a unit,
 * as fractions, and 296 the unit: 2, an inch. */
static void tiff_has_its_size_on_paper(void **state)
{
    (void)state;
    const char *path = place("dpi.tif");
    struct bead_frame frame;
    size_t size;
    unsigned found = 0;
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    draw(&frame, 0);
    write_still(path, &frame);
    BEAD_FREED char *bytes = NULL;
    assert_int_equal(bead_file_read(path, 1 << 20, &bytes, &size, NULL), BEAD_OK);
    unlink(path);
    assert_memory_equal(bytes, "II*", 4);
    uint32_t at, value[2];
    uint16_t count, tag;
    memcpy(&at, bytes + 4, sizeof at);
    memcpy(&count, bytes + at, sizeof count);
    for (const char *entry = bytes + at + 2; count-- > 0; entry += 12) {
        memcpy(&tag, entry, sizeof tag);
        memcpy(&at, entry + 8, sizeof at);
        if (tag == 282 || tag == 283) {
            memcpy(value, bytes + at, sizeof value);
            assert_int_equal(value[0], 300 * value[1]);
        }
        if (tag == 296)
            assert_int_equal(at & 0xffff, 2);
        found += tag == 282 || tag == 283 || tag == 296;
    }
    assert_int_equal(found, 3);
    bead_frame_free(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_shows_what_was_drawn),
        cmocka_unit_test(tiff_has_its_size_on_paper),
    };
    return cmocka_run_group_tests_name("stills", tests, make_directory, remove_directory);
}
