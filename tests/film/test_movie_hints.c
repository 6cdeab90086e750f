/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hints to encoders about unchanged parts are true: every change reaches the screen. */
#include "movies.h"

#include "decode.h"
#include "render/encode/libav.h"

enum { BLOCK = 16, SIDE_X = 20 * BLOCK - 6, SIDE_Y = 15 * BLOCK - 10, FRAMES = 60 };

/* Where FFmpeg has hints for encoders, a picture carries those of the last call only; where it has none, nothing happens. */
static void pictures_carry_hints(void **state)
{
    (void)state;
    const struct bead_changes changes = {2, {{16, 16, 16, 16}, {95, 63, 2, 2}}}, fewer = {1, {{0, 8, 48, 2}}};
    assert_int_equal(bead_av_open(NULL), BEAD_OK);
    AVFrame *picture = av_frame_alloc();
    assert_non_null(picture);
    assert_int_equal(bead_av_hint(picture, &changes), 0);
    assert_int_equal(bead_av_hint(picture, &fewer), 0);
#ifdef AVUTIL_VIDEO_HINT_H
    assert_int_equal(picture->nb_side_data, 1);
    const AVVideoHint *hint = (const AVVideoHint *)picture->side_data[0]->data;
    assert_int_equal(hint->nb_rects, 1);
    assert_int_equal(hint->type, AV_VIDEO_HINT_TYPE_CHANGED);
    const AVVideoRect *r = av_video_hint_get_rect(hint, 0);
    assert_true(r->x == 0 && r->y == 8 && r->width == 48 && r->height == 2);
    assert_string_equal(BEAD_AV_HINT_OPTIONS, "mb_info=1");
#endif
    assert_int_equal(bead_av_hint(picture, NULL), 0);
    assert_int_equal(picture->nb_side_data, 0);
    av_frame_free(&picture);
}

static unsigned next(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 16;
}

/* A grain that no block can be predicted from, the same at every call. */
static void draw_grain(struct bead_frame *frame, struct bead_rect r)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++) {
            unsigned seed = (unsigned)(y * 1009 + x);
            next(&seed);
            int grey = 70 + (int)(next(&seed) % 40);
            put(frame, x, y, grey, grey, grey);
        }
    }
}

static void draw_spot(struct bead_frame *frame, struct bead_rect r)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++)
            put(frame, x, y, 250, 250, 250);
    }
}

/* The spot of frame `index`; every fifth frame it stays. */
static struct bead_rect spot_of(int index)
{
    unsigned seed = (unsigned)(index - (index % 5 == 4)) * 7919u + 13;
    int x = (int)(next(&seed) % (SIDE_X - 12)), y = (int)(next(&seed) % (SIDE_Y - 9));
    return (struct bead_rect){x, y, 5 + (int)(next(&seed) % 8), 3 + (int)(next(&seed) % 7)};
}

static void assert_alike(const char *name, int index, const AVFrame *picture, const struct bead_frame *frame)
{
    for (int y = 0; y < SIDE_Y; y++) {
        for (int x = 0; x < SIDE_X; x++) {
            double luma = 16 + 219 / 255.0 * frame->pixels[(size_t)y * frame->stride + 4 * (size_t)x];
            if (abs((int)(picture->data[0][y * picture->linesize[0] + x] - luma)) > 70)
                fail_msg("%s: frame %d has luma %d at %d, %d, not %g", name, index, picture->data[0][y * picture->linesize[0] + x],
                         x, y, luma);
        }
    }
}

/* A spot jumps about on grain, between frames in which nothing changes; some of its rectangles are one
 * block, some touch four. A spot left behind, or one that does not come, is 100 levels off. */
static void nothing_stays_behind(void **state)
{
    (void)state;
    static const enum bead_quality quality[] = {BEAD_QUALITY_DRAFT, BEAD_QUALITY_STANDARD, BEAD_QUALITY_HIGH};
    for (size_t q = 0; q < 3; q++) {
        const char *path = place("spots.mp4");
        struct bead_movie_settings wanted = settings(quality[q]);
        struct bead_frame frame;
        struct bead_movie *movie;
        wanted.width = SIDE_X;
        wanted.height = SIDE_Y;
        assert_int_equal(bead_frame_create(SIDE_X, SIDE_Y, &frame, NULL), BEAD_OK);
        draw_grain(&frame, (struct bead_rect){0, 0, SIDE_X, SIDE_Y});
        assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
        for (int i = 0; i < FRAMES; i++) {
            struct bead_changes changes = {.count = 0};
            if (i % 5 != 4) {
                changes = (struct bead_changes){2, {spot_of(i ? i - 1 : 0), spot_of(i)}};
                draw_grain(&frame, changes.rect[0]);
                draw_spot(&frame, changes.rect[1]);
            }
            assert_int_equal(bead_movie_add(movie, &frame, &changes, NULL), BEAD_OK);
        }
        assert_int_equal(bead_movie_close(movie, NULL, NULL), BEAD_OK);
        struct decoded back;
        decode(path, &back);
        /* In drafts the very last again, to end in time. */
        assert_int_equal(back.count, quality[q] == BEAD_QUALITY_DRAFT ? FRAMES - FRAMES / 5 + 1 : FRAMES);
        for (size_t f = 0; f < back.count; f++) {
            int index = (int)(back.time[f] * FPS + 0.5);
            draw_grain(&frame, (struct bead_rect){0, 0, SIDE_X, SIDE_Y});
            draw_spot(&frame, spot_of(index));
            assert_alike(path, index, back.frame[f], &frame);
        }
        decoded_free(&back);
        bead_frame_free(&frame);
        unlink(path);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_carry_hints),
        cmocka_unit_test(nothing_stays_behind),
    };
    return cmocka_run_group_tests_name("movie_hints", tests, make_directory, remove_directory);
}
