/* Golden pictures: every tests/golden/NAME.yaml is run and its picture, or the middle frame of its movie, compared with NAME.png.
 * Fonts differ a little from one release to the next, so a few pixels may differ, the more the less. Where too many do,
 * BUILD/golden/NAME.png shows what was expected, what came and the difference, side by side.
 * `make golden` (BEADREEL_GOLDEN=update) makes the pictures anew; look at them before they are committed. */
/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "beadreel/picture.h"
#include "decode.h"
#include "pictures.h"
#include "sessions.h"

/* Of all pixels, at most `share` may differ by more than `levels` of 255 in some colour. */
static const struct grade {
    int levels;
    double share;
} grades[] = {{2, 0.02}, {16, 0.006}, {64, 0.001}};
enum { GRADES = sizeof grades / sizeof *grades };

struct raster {
    int width, height;
    uint8_t *rgb;
};

static int difference(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    for (int i = 0; i < 3; i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

/* The grade that is missed, or NULL. */
static const struct grade *missed(const struct raster *a, const struct raster *b, double *share)
{
    size_t pixels = (size_t)a->width * (size_t)a->height;
    *share = 1;
    if (a->width != b->width || a->height != b->height)
        return &grades[GRADES - 1];
    for (size_t g = 0; g < GRADES; g++) {
        size_t count = 0;
        for (size_t i = 0; i < pixels; i++)
            count += difference(a->rgb + 3 * i, b->rgb + 3 * i) > grades[g].levels;
        *share = (double)count / (double)pixels;
        if (*share > grades[g].share)
            return &grades[g];
    }
    return NULL;
}

static void paste(struct bead_frame *frame, const struct raster *r, int x0)
{
    for (int y = 0; y < r->height; y++) {
        for (int x = 0; x < r->width; x++) {
            const uint8_t *from = r->rgb + 3 * ((size_t)y * (size_t)r->width + (size_t)x);
            uint8_t *to = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)(x0 + x);
            to[0] = from[2], to[1] = from[1], to[2] = from[0];
        }
    }
}

/* Black where they agree, from grey to white with the difference. */
static struct raster differences(const struct raster *a, const struct raster *b)
{
    struct raster d = {a->width < b->width ? a->width : b->width, a->height < b->height ? a->height : b->height, NULL};
    d.rgb = test_calloc((size_t)d.width * (size_t)d.height, 3);
    for (int y = 0; y < d.height; y++) {
        for (int x = 0; x < d.width; x++) {
            int value = difference(a->rgb + 3 * ((size_t)y * (size_t)a->width + (size_t)x),
                                   b->rgb + 3 * ((size_t)y * (size_t)b->width + (size_t)x));
            memset(d.rgb + 3 * ((size_t)y * (size_t)d.width + (size_t)x), value ? (value < 64 ? 64 + 3 * value : 255) : 0, 3);
        }
    }
    return d;
}

static void show_difference(const char *name, const struct raster *expected, const struct raster *got, char path[512])
{
    struct raster parts[] = {*expected, *got, differences(expected, got)};
    struct bead_frame frame;
    struct bead_message msg = {""};
    int width = 0, height = 0;
    for (size_t i = 0; i < 3; i++) {
        width += parts[i].width + 8;
        height = parts[i].height > height ? parts[i].height : height;
    }
    const char *build = getenv("BUILD");
    snprintf(path, 512, "%s/golden", build ? build : "build");
    mkdir(path, 0777);
    snprintf(path, 512, "%s/golden/%s.png", build ? build : "build", name);
    assert_int_equal(bead_frame_create(width, height, &frame, &msg), BEAD_OK);
    for (size_t i = 0, x = 0; i < 3; x += (size_t)parts[i++].width + 8)
        paste(&frame, &parts[i], (int)x);
    struct bead_picture_notes notes = {.title = name};
    uint64_t bytes;
    if (bead_png_write(path, &frame, &notes, &bytes, &msg))
        print_error("%s\n", msg.text);
    bead_frame_free(&frame);
    test_free(parts[2].rgb);
}

/* ---- pictures made ---- */

static struct raster from_png(const char *path)
{
    struct png_file png = read_png(path);
    struct raster r = {png.width, png.height, test_calloc((size_t)png.width * (size_t)png.height, 3)};
    memcpy(r.rgb, png.rgb, 3 * (size_t)png.width * (size_t)png.height);
    free(png.rgb);
    return r;
}

static struct raster from_movie(const char *path)
{
    static struct decoded movie;
    decode(path, &movie);
    struct raster r = {movie.width, movie.height, test_calloc((size_t)movie.width * (size_t)movie.height, 3)};
    for (int y = 0; y < r.height; y++) {
        for (int x = 0; x < r.width; x++) {
            int rgb[3];
            decoded_rgb(movie.frame[movie.count / 2], x, y, rgb);
            for (int i = 0; i < 3; i++)
                r.rgb[3 * ((size_t)y * (size_t)r.width + (size_t)x) + (size_t)i] = (uint8_t)rgb[i];
        }
    }
    decoded_free(&movie);
    return r;
}

static struct raster make_picture(const char *scene)
{
    char directory[512];
    const struct bead_result *results;
    in_directory("", directory, sizeof directory);
    struct bead_session *session = play_session((struct bead_job){.input = scene, .output = directory});
    assert_int_equal(bead_session_results(session, &results), 1);
    struct raster r = strstr(results[0].path, ".mkv") ? from_movie(results[0].path) : from_png(results[0].path);
    assert_int_equal(unlink(results[0].path), 0);
    bead_session_close(session);
    return r;
}

static void keep(const char *path, const struct raster *r)
{
    struct bead_frame frame;
    struct bead_message msg = {""};
    struct bead_picture_notes notes = {.title = NULL};
    uint64_t bytes;
    assert_int_equal(bead_frame_create(r->width, r->height, &frame, &msg), BEAD_OK);
    paste(&frame, r, 0);
    if (bead_png_write(path, &frame, &notes, &bytes, &msg))
        fail_msg("%s", msg.text);
    bead_frame_free(&frame);
}

/* ---- the golden pictures ---- */

static bool compare(const char *name, bool update)
{
    char scene[512], golden[512], shown[512];
    double share;
    snprintf(scene, sizeof scene, "tests/golden/%s.yaml", name);
    snprintf(golden, sizeof golden, "tests/golden/%s.png", name);
    struct raster got = make_picture(scene);
    if (update)
        keep(golden, &got);
    struct raster expected = from_png(golden);
    const struct grade *grade = missed(&expected, &got, &share);
    if (grade) {
        show_difference(name, &expected, &got, shown);
        print_error("%s: %.2f %% of the pixels differ by more than %d levels: see %s; is it better? make golden\n", name,
                    100 * share, grade->levels, shown);
    }
    test_free(got.rgb);
    test_free(expected.rgb);
    return !grade;
}

static void test_golden_pictures(void **state)
{
    (void)state;
    const char *wish = getenv("BEADREEL_GOLDEN");
    size_t count = 0, bad = 0;
    DIR *dir = opendir("tests/golden");
    assert_non_null(dir);
    for (struct dirent *e; (e = readdir(dir));) {
        char name[256];
        const char *dot = strrchr(e->d_name, '.');
        if (!dot || strcmp(dot, ".yaml") != 0)
            continue;
        snprintf(name, sizeof name, "%.*s", (int)(dot - e->d_name), e->d_name);
        bad += !compare(name, wish && strcmp(wish, "update") == 0);
        count++;
    }
    closedir(dir);
    assert_true(count > 0);
    assert_int_equal(bad, 0);
}

/* The comparison itself: what it lets pass, what not, and what it leaves to look at. */
static void test_differences_are_seen(void **state)
{
    (void)state;
    enum { WIDTH = 100, HEIGHT = 80 };
    struct raster a = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)}, b = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)};
    double share;
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        a.rgb[i] = b.rgb[i] = (uint8_t)(i * 7 % 200);
    assert_null(missed(&a, &b, &share));
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        b.rgb[i] = (uint8_t)(a.rgb[i] + 2);
    assert_null(missed(&a, &b, &share));
    b.rgb[0] = (uint8_t)(a.rgb[0] + 40); /* one pixel */
    assert_null(missed(&a, &b, &share));
    for (size_t i = 0; i < 60; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 40); /* 0.75 % */
    assert_ptr_equal(missed(&a, &b, &share), &grades[1]);
    for (size_t i = 0; i < 10; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 100);
    for (size_t i = 10; i < 60; i++)
        b.rgb[3 * i] = a.rgb[3 * i];
    assert_ptr_equal(missed(&a, &b, &share), &grades[2]);
    char shown[512], *build = getenv("BUILD") ? strdup(getenv("BUILD")) : NULL;
    in_directory("", shown, sizeof shown);
    setenv("BUILD", shown, 1);
    show_difference("pair", &a, &b, shown);
    struct raster seen = from_png(shown);
    assert_int_equal(seen.width, 3 * (WIDTH + 8));
    assert_memory_equal(seen.rgb, a.rgb, 3 * WIDTH);
    assert_int_equal(seen.rgb[3 * 2 * (WIDTH + 8)], 255);
    test_free(seen.rgb);
    unlink(shown);
    in_directory("golden", shown, sizeof shown);
    rmdir(shown);
    if (build)
        setenv("BUILD", build, 1);
    else
        unsetenv("BUILD");
    free(build);
    b.width--;
    assert_non_null(missed(&a, &b, &share));
    test_free(a.rgb);
    test_free(b.rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden_pictures),
        cmocka_unit_test(test_differences_are_seen),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
