/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies that cannot be made: refused in time, with one line, and without leftovers. */
#include "movies.h"

#include "render/encode/movie_internal.h"
#include "render/encode/movie_private.h"
#include "sim/kinds/output_kinds.h"

#include <math.h>
#include <signal.h>
#include <sys/resource.h>

/* Messages about impossible requests name the possible ones. */
static void formats_without_alpha_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum bead_quality quality;
        const char *says;
    } wrong[] = {{"a.mp4", BEAD_QUALITY_HIGH,
                  "mp4 files cannot be transparent (`background: none`); mov, webm, webp, apng and png files can"},
                 {"a.mkv", BEAD_QUALITY_LOSSLESS, "mkv files"},
                 {"a.gif", BEAD_QUALITY_STANDARD, "gif files"},
                 {"a.webm", BEAD_QUALITY_LOSSLESS, "lossless webm files"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct bead_movie_settings wanted = settings(wrong[i].quality);
        struct bead_message msg = {""};
        wanted.alpha = true;
        assert_int_equal(bead_movie_check(wrong[i].name, &wanted, &msg), BEAD_ERROR_SCENE);
        if (!strstr(msg.text, wrong[i].says))
            fail_msg("%s", msg.text);
    }
    static const char *const fine[] = {"a.mov", "a.webm", "a.apng", "a.png", "a.hash"};
    for (size_t i = 0; i < sizeof fine / sizeof *fine; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
        wanted.alpha = true;
        assert_int_equal(bead_movie_check(fine[i], &wanted, NULL), BEAD_OK);
    }
}

static void formats_without_av1_are_refused(void **state)
{
    (void)state;
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
    struct bead_message msg = {""};
    wanted.codec = BEAD_CODEC_AV1;
    static const char *const names[] = {"a.mov", "a.gif", "a.webp", "a.png", "a.avif"};
    for (size_t i = 0; i < sizeof names / sizeof *names - 1; i++) {
        assert_int_equal(bead_movie_check(names[i], &wanted, &msg), BEAD_ERROR_SCENE);
        assert_non_null(strstr(msg.text, "(`codec: av1`); mp4, mkv, webm and avif files can"));
    }
    assert_int_equal(bead_movie_check("a.avif", &wanted, &msg), BEAD_OK);
    wanted.alpha = true;
    assert_int_equal(bead_movie_check("a.webm", &wanted, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "webm files cannot be transparent (`background: none`) with `codec: av1`"));
    wanted.alpha = false;
    wanted.codec = (enum bead_codec_asked)7;
    assert_int_equal(bead_movie_check("a.mp4", &wanted, &msg), BEAD_ERROR_SCENE);
}

static void wrong_settings_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int width, height;
        double fps;
        enum bead_quality quality;
        const char *says;
    } wrong[] = {
        {"a.mp4", 641, 360, 60, BEAD_QUALITY_STANDARD, "642 x 360"},
        {"a.webm", 640, 361, 60, BEAD_QUALITY_HIGH, "640 x 362"},
        {"a.mkv", 1, 1, 60, BEAD_QUALITY_DRAFT, "2 x 2"},
        {"a.mp4", 0, 360, 60, BEAD_QUALITY_STANDARD, "0 x 360"},
        {"a.gif", 640, -2, 60, BEAD_QUALITY_STANDARD, "640 x -2"},
        {"a.mp4", 20000, 2, 60, BEAD_QUALITY_STANDARD, "16384"},
        {"a.avi", 640, 360, 60, BEAD_QUALITY_STANDARD, "webm"},
        {"a", 640, 360, 60, BEAD_QUALITY_STANDARD, "mp4"},
        {"a.mp4", 640, 360, NAN, BEAD_QUALITY_STANDARD, "frames a second"},
        {"a.mp4", 640, 360, 0, BEAD_QUALITY_STANDARD, "frames a second"},
        {"a.mp4", 640, 360, INFINITY, BEAD_QUALITY_STANDARD, "frames a second"},
        {"a.mp4", 640, 360, 60, (enum bead_quality)9, "quality"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct bead_movie_settings wanted = {.size = sizeof wanted,
                                             .width = wrong[i].width,
                                             .height = wrong[i].height,
                                             .fps = wrong[i].fps,
                                             .quality = wrong[i].quality};
        struct bead_movie *movie = (struct bead_movie *)&wanted;
        struct bead_message msg = {""};
        const char *path = place(wrong[i].name);
        assert_int_equal(bead_movie_check(path, &wanted, &msg), BEAD_ERROR_SCENE);
        assert_int_equal(bead_movie_open(path, &wanted, &movie, &msg), BEAD_ERROR_SCENE);
        assert_null(movie);
        assert_non_null(strstr(msg.text, wrong[i].says));
        assert_null(strchr(msg.text, '\n'));
        assert_false(left_behind(path));
    }
    struct bead_movie_settings odd = {.size = sizeof odd, .width = 641, .height = 361, .fps = 60, .quality = BEAD_QUALITY_LOSSLESS};
    static const char *const fine[] = {"a.mp4", "a.mkv", "a.webm", "a.gif", "a.png", "a.hash"};
    for (size_t i = 0; i < sizeof fine / sizeof *fine; i++)
        assert_int_equal(bead_movie_check(fine[i], &odd, NULL), BEAD_OK);
}

/* What scenes may name as a movie has a codec, and no codec is of anything else but hashes, which only programs ask for. */
static void scenes_and_codecs_agree(void **state)
{
    (void)state;
    const char *endings = bead_output_endings(BEAD_OUTPUT_MOVIE);
    const struct bead_codec_info *codec;
    size_t known = 0, named = 0;
    for (const char *dot = endings; dot; dot = strchr(dot + 1, '.'))
        known++;
    for (size_t i = 0; (codec = bead_movie_codec(i)); i++) {
        char path[16];
        snprintf(path, sizeof path, "a.%s", codec->extension);
        assert_string_equal(bead_codec_find(path, false)->info.extension, codec->extension);
        named += bead_output_ends_like(endings, path);
        assert_true(bead_output_ends_like(endings, path) || strcmp(codec->extension, "hash") == 0);
    }
    assert_int_equal(named, known);
}

static void unwritable_places_are_told(void **state)
{
    (void)state;
    FILE *file = fopen(place("plain"), "w");
    assert_non_null(file);
    fclose(file);
    static const char *const names[] = {"missing/a.mp4", "plain/a.mp4", "missing/a.gif", "missing/a.hash", "plain/a.png"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
        struct bead_movie *movie;
        struct bead_message msg = {""};
        const char *path = place(names[i]);
        assert_int_equal(bead_movie_open(path, &wanted, &movie, &msg), BEAD_ERROR_IO);
        assert_null(movie);
        assert_non_null(strstr(msg.text, path));
        assert_false(left_behind(path));
    }
    unlink(place("plain"));
}

/* A limit on the size of files replaces a full disk: an error, and nothing is left of the file. */
static void full_disk_is_told(void **state)
{
    (void)state;
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    static const char *const names[] = {"full.mp4", "full.mkv", "full.webm", "full.gif", "full.png", "full.hash"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_LOSSLESS);
        struct bead_movie *movie;
        struct bead_frame frame;
        struct bead_message msg = {""};
        const char *path = place(names[i]);
        assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
        assert_int_equal(bead_movie_open(path, &wanted, &movie, &msg), BEAD_OK);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){512, before.rlim_max}), 0);
        enum bead_error err = BEAD_OK;
        for (int f = 0; !err && f < 50; f++) {
            draw(&frame, f);
            err = bead_movie_add(movie, &frame, NULL, &msg);
        }
        enum bead_error first = err;
        err = bead_movie_close(movie, NULL, first ? NULL : &msg);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_int_equal(first ? first : err, BEAD_ERROR_IO);
        assert_true(err != BEAD_OK);
        assert_non_null(strstr(msg.text, path));
        assert_false(left_behind(path));
        bead_frame_free(&frame);
    }
    signal(SIGXFSZ, SIG_DFL);
}

static void abort_removes_only_the_unfinished(void **state)
{
    (void)state;
    for (int i = 0; i < ALL; i++) {
        struct bead_movie_settings wanted = settings_of(&all[i]);
        const char *path = place(all[i].name);
        write_movie(path, &wanted, 3, 0);
        uint64_t before = bead_file_bytes(path);
        for (int frames = 0; frames < 3; frames++) {
            struct bead_movie *movie;
            struct bead_frame frame;
            assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
            assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
            for (int f = 0; f < frames; f++)
                assert_int_equal(bead_movie_add(movie, &frame, NULL, NULL), BEAD_OK);
            bead_movie_abort(movie);
            bead_frame_free(&frame);
        }
        assert_int_equal(bead_file_bytes(path), before);
        unlink(path);
        assert_false(left_behind(path));
    }
    bead_movie_abort(NULL);
}

static void misuse_is_an_error(void **state)
{
    (void)state;
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
    struct bead_movie *movie;
    struct bead_frame frame;
    const char *path = place("misuse.mp4");
    assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
    assert_int_equal(bead_movie_close(movie, NULL, NULL), BEAD_ERROR_CODEC); /* no frames */
    assert_false(left_behind(path));
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    /* Frames narrower, lower, without pixels, with rows that begin anywhere or overlap. */
    struct bead_frame wrong[5];
    for (size_t i = 0; i < 5; i++)
        wrong[i] = frame;
    wrong[0].width -= 2;
    wrong[1].height -= 2;
    wrong[2].pixels = NULL;
    wrong[3].stride += 4;
    wrong[4].stride = 64;
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
        assert_int_equal(bead_movie_add(movie, &wrong[i], NULL, NULL), BEAD_ERROR_CODEC);
        assert_int_equal(bead_movie_close(movie, NULL, NULL), BEAD_ERROR_CODEC);
        assert_false(left_behind(path));
    }
    bead_frame_free(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_without_alpha_are_refused), cmocka_unit_test(formats_without_av1_are_refused),
        cmocka_unit_test(wrong_settings_are_refused),        cmocka_unit_test(scenes_and_codecs_agree),
        cmocka_unit_test(unwritable_places_are_told),        cmocka_unit_test(full_disk_is_told),
        cmocka_unit_test(abort_removes_only_the_unfinished), cmocka_unit_test(misuse_is_an_error),
    };
    return cmocka_run_group_tests_name("movie errors", tests, make_directory, remove_directory);
}
