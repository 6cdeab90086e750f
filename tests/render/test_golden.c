/* Golden pictures: every tests/golden/NAME.yaml is run and its picture, or the middle frame of its movie, compared with NAME.png.
 * Fonts differ a little from one release to the next, so a few pixels may differ, the more the less. The pictures are made with
 * cairo 1.16: from 1.18 on it puts glyphs between pixels, so that with others text may be off by one. Where too many pixels differ,
 * BUILD/golden/NAME.png shows what was expected, what came and the difference, side by side.
 * `make golden` (BEADREEL_GOLDEN=update) makes the pictures anew; look at them before they are committed. */
/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */
#include <cairo.h>
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

/* A pixel may be `reach` from where it was, and of all pixels at most `share` may differ by more than `levels` of 255 in some
 * colour from all those near it. */
enum { GRADES = 3 };
static const struct tolerance {
    int reach;
    struct grade {
        int levels;
        double share;
    } grades[GRADES];
} same_text = {0, {{2, 0.02}, {16, 0.006}, {64, 0.001}}}, other_text = {1, {{2, 0.006}, {16, 0.003}, {64, 0.0005}}};

struct raster {
    int width, height;
    uint8_t *rgb;
};

static const uint8_t *pixel(const struct raster *r, int x, int y)
{
    return r->rgb + 3 * ((size_t)y * (size_t)r->width + (size_t)x);
}

/* By how much the pixel of `a` is out of what those of `b` within `reach` of it span. */
static int outside(const struct raster *a, const struct raster *b, int x, int y, int reach)
{
    int most = 0;
    for (int i = 0; i < 3; i++) {
        int value = pixel(a, x, y)[i], low = 255, high = 0;
        for (int v = y - reach; v <= y + reach; v++) {
            for (int u = x - reach; u <= x + reach; u++) {
                if (u < 0 || v < 0 || u >= b->width || v >= b->height)
                    continue;
                int other = pixel(b, u, v)[i];
                low = other < low ? other : low, high = other > high ? other : high;
            }
        }
        int out = value < low ? low - value : value > high ? value - high : 0;
        most = out > most ? out : most;
    }
    return most;
}

static int difference(const struct raster *a, const struct raster *b, int x, int y, int reach)
{
    int one = outside(a, b, x, y, reach), other = outside(b, a, x, y, reach);
    return one > other ? one : other;
}

/* The grade that is missed, or NULL. */
static const struct grade *missed(const struct tolerance *tolerance, const struct raster *a, const struct raster *b, double *share)
{
    double pixels = (double)a->width * a->height;
    size_t count[GRADES] = {0};
    *share = 1;
    if (a->width != b->width || a->height != b->height)
        return &tolerance->grades[GRADES - 1];
    for (int y = 0; y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            int levels = difference(a, b, x, y, tolerance->reach);
            for (size_t g = 0; g < GRADES; g++)
                count[g] += levels > tolerance->grades[g].levels;
        }
    }
    for (size_t g = 0; g < GRADES; g++) {
        *share = (double)count[g] / pixels;
        if (*share > tolerance->grades[g].share)
            return &tolerance->grades[g];
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
            int value = difference(a, b, x, y, 0);
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
    struct bead_picture_notes notes = {.size = sizeof notes, .title = name};
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
    struct bead_picture_notes notes = {.size = sizeof notes, .title = NULL};
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
    bool same = strncmp(cairo_version_string(), "1.16.", 5) == 0;
    const struct grade *grade = missed(same ? &same_text : &other_text, &expected, &got, &share);
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
    assert_null(missed(&same_text, &a, &b, &share));
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        b.rgb[i] = (uint8_t)(a.rgb[i] + 2);
    assert_null(missed(&same_text, &a, &b, &share));
    b.rgb[0] = (uint8_t)(a.rgb[0] + 40); /* one pixel */
    assert_null(missed(&same_text, &a, &b, &share));
    for (size_t i = 0; i < 60; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 40); /* 0.75 % */
    assert_ptr_equal(missed(&same_text, &a, &b, &share), &same_text.grades[1]);
    for (size_t i = 0; i < 10; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 100);
    for (size_t i = 10; i < 60; i++)
        b.rgb[3 * i] = a.rgb[3 * i];
    assert_ptr_equal(missed(&same_text, &a, &b, &share), &same_text.grades[2]);
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
    assert_non_null(missed(&same_text, &a, &b, &share));
    test_free(a.rgb);
    test_free(b.rgb);
}

/* Text between pixels passes where it may; a line that is two pixels off, or of another colour, does not. */
static void test_moved_lines_are_seen(void **state)
{
    (void)state;
    enum { SIZE = 100, AT = 40 };
    static const struct {
        int at, value;
        bool passes;
    } lines[] = {{AT, 0, true}, {AT + 1, 0, true}, {AT + 2, 0, false}, {AT + 1, 100, false}, {AT, 100, false}};
    struct raster a = {SIZE, SIZE, test_malloc(3 * SIZE * SIZE)}, b = {SIZE, SIZE, test_malloc(3 * SIZE * SIZE)};
    double share;
    memset(a.rgb, 255, 3 * SIZE * SIZE);
    memset(a.rgb + 3 * SIZE * AT, 0, 3 * SIZE);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        memset(b.rgb, 255, 3 * SIZE * SIZE);
        memset(b.rgb + 3 * SIZE * lines[i].at, lines[i].value, 3 * SIZE);
        assert_int_equal(missed(&other_text, &a, &b, &share) == NULL, lines[i].passes);
        assert_int_equal(missed(&same_text, &a, &b, &share) == NULL, i == 0);
    }
    test_free(a.rgb);
    test_free(b.rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden_pictures),
        cmocka_unit_test(test_differences_are_seen),
        cmocka_unit_test(test_moved_lines_are_seen),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
