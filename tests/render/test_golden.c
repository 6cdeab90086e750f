/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Golden pictures: every tests/golden/NAME.yaml is run and its picture, or the middle frame of its movie, compared with NAME.png.
 * The pictures are made on Debian 12, where every pixel must be unchanged. From cairo 1.18, glyphs lie between pixels, so that
 * elsewhere text may be off by one, and a few of its pixels by more; but never as many in one place as a mark covers. If too many
 * pixels differ, BUILD/golden/NAME.png shows the expected picture, the actual one and the difference, side by side. `make golden`
 * (BEADREEL_GOLDEN=update) makes the pictures again; look at them before you commit them. */
/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */
#include <cairo.h>
#include <dirent.h>
#include <pango/pango.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "decode.h"
#include "pictures.h"
#include "render/draw/picture.h"
#include "sessions.h"

/* A pixel may be `reach` from where it was. Of all pixels at most `share`, and within any square of CROWD by CROWD at most `crowd`,
 * may differ by more than `levels` of 255 in some colour from all those near it. Text set by Debian 13's libraries has up to 38, 28
 * and 19 such pixels in a square; one mark of a plot that is elsewhere has 75, 72 and 59, and one that is hollow instead 41,
 * 40, 37. */
enum { GRADES = 3, CROWD = 16 };
static const struct tolerance {
    int reach;
    struct grade {
        int levels;
        double share;
        size_t crowd;
    } grades[GRADES];
} same_text = {0, {{2, 1e-4, 3}, {16, 0, 0}, {64, 0, 0}}}, other_text = {1, {{2, 0.006, 56}, {16, 0.003, 42}, {64, 0.0005, 28}}};

/* The golden pictures' own libraries: text comes out as it is there. */
static bool has_same_text(void)
{
    return strcmp(cairo_version_string(), "1.16.0") == 0 && strcmp(pango_version_string(), "1.50.12") == 0;
}

struct raster {
    int width, height;
    uint8_t *rgb;
};

static const uint8_t *pixel(const struct raster *r, int x, int y)
{
    return r->rgb + 3 * ((size_t)y * (size_t)r->width + (size_t)x);
}

/* How far the pixel of `a` is outside the range of those of `b` within `reach` of it. */
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
    if (memcmp(pixel(a, x, y), pixel(b, x, y), 3) == 0) /* as nearly all are */
        return 0;
    int one = outside(a, b, x, y, reach), other = outside(b, a, x, y, reach);
    return one > other ? one : other;
}

/* Of the pixels in the square from (x, y) on, those that differ by more than `levels`. */
static size_t crowd_at(const struct raster *map, int x, int y, int levels)
{
    size_t count = 0;
    for (int v = y; v < y + CROWD && v < map->height; v++) {
        for (int u = x; u < x + CROWD && u < map->width; u++)
            count += *pixel(map, u, v) > levels;
    }
    return count;
}

static bool misses(const struct grade *grade, const struct raster *map, double *share, size_t *crowd)
{
    size_t all = 0;
    *crowd = 0;
    for (int y = 0; y < map->height; y += CROWD / 2) {
        for (int x = 0; x < map->width; x += CROWD / 2) {
            size_t here = crowd_at(map, x, y, grade->levels);
            *crowd = here > *crowd ? here : *crowd;
        }
    }
    for (int y = 0; y < map->height; y += CROWD) {
        for (int x = 0; x < map->width; x += CROWD)
            all += crowd_at(map, x, y, grade->levels);
    }
    *share = (double)all / ((double)map->width * map->height);
    return *share > grade->share || *crowd > grade->crowd;
}

/* All three colours of a pixel are what it differs by. */
static struct raster differences(const struct raster *a, const struct raster *b, int reach)
{
    struct raster d = {a->width < b->width ? a->width : b->width, a->height < b->height ? a->height : b->height, NULL};
    d.rgb = test_calloc((size_t)d.width * (size_t)d.height, 3);
    for (int y = 0; y < d.height; y++) {
        for (int x = 0; x < d.width; x++)
            memset(d.rgb + 3 * ((size_t)y * (size_t)d.width + (size_t)x), difference(a, b, x, y, reach), 3);
    }
    return d;
}

/* The grade that is missed, or NULL. */
static const struct grade *missed(const struct tolerance *tolerance, const struct raster *a, const struct raster *b, double *share,
                                  size_t *crowd)
{
    const struct grade *grade = NULL;
    *share = 1, *crowd = CROWD * CROWD;
    if (a->width != b->width || a->height != b->height)
        return &tolerance->grades[GRADES - 1];
    struct raster map = differences(a, b, tolerance->reach);
    for (size_t g = 0; !grade && g < GRADES; g++)
        grade = misses(&tolerance->grades[g], &map, share, crowd) ? &tolerance->grades[g] : NULL;
    test_free(map.rgb);
    return grade;
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
static struct raster visible(struct raster d)
{
    for (size_t i = 0; i < 3 * (size_t)d.width * (size_t)d.height; i++)
        d.rgb[i] = (uint8_t)(!d.rgb[i] ? 0 : d.rgb[i] < 64 ? 64 + 3 * d.rgb[i] : 255);
    return d;
}

static void show_difference(const char *name, const struct raster *expected, const struct raster *got, char path[512])
{
    struct raster parts[] = {*expected, *got, visible(differences(expected, got, 0))};
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
    size_t crowd;
    snprintf(scene, sizeof scene, "tests/golden/%s.yaml", name);
    snprintf(golden, sizeof golden, "tests/golden/%s.png", name);
    struct raster got = make_picture(scene);
    if (update)
        keep(golden, &got);
    struct raster expected = from_png(golden);
    const struct grade *grade = missed(has_same_text() ? &same_text : &other_text, &expected, &got, &share, &crowd);
    if (grade) {
        show_difference(name, &expected, &got, shown);
        print_error("%s: %.4f %% of the pixels differ by more than %d levels, %zu of them close together: see %s; is it better? "
                    "make golden\n",
                    name, 100 * share, grade->levels, crowd, shown);
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

/* The comparison itself: what it lets pass and what not. */
static void test_differences_are_seen(void **state)
{
    (void)state;
    enum { WIDTH = 100, HEIGHT = 80, ALL = CROWD * CROWD };
    static const struct tolerance graded = {0, {{2, 0.02, ALL}, {16, 0.006, ALL}, {64, 0.001, ALL}}},
                                  dense = {0, {{2, 1, ALL}, {16, 1, 15}, {64, 1, ALL}}};
    struct raster a = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)}, b = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)};
    double share;
    size_t crowd;
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        a.rgb[i] = b.rgb[i] = (uint8_t)(i * 7 % 200);
    assert_null(missed(&same_text, &a, &b, &share, &crowd));
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        b.rgb[i] = (uint8_t)(a.rgb[i] + 2);
    assert_null(missed(&same_text, &a, &b, &share, &crowd));
    b.rgb[0] = (uint8_t)(a.rgb[0] + 40); /* one pixel */
    assert_null(missed(&graded, &a, &b, &share, &crowd));
    assert_ptr_equal(missed(&same_text, &a, &b, &share, &crowd), &same_text.grades[0]);
    for (size_t i = 0; i < 60; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 40); /* 0.75 %, 16 of them in a row within a square */
    assert_ptr_equal(missed(&graded, &a, &b, &share, &crowd), &graded.grades[1]);
    assert_ptr_equal(missed(&dense, &a, &b, &share, &crowd), &dense.grades[1]);
    assert_int_equal(crowd, 16);
    for (size_t i = 0; i < 10; i++)
        b.rgb[3 * i] = (uint8_t)(a.rgb[3 * i] + 100);
    for (size_t i = 10; i < 60; i++)
        b.rgb[3 * i] = a.rgb[3 * i];
    assert_ptr_equal(missed(&graded, &a, &b, &share, &crowd), &graded.grades[2]);
    assert_null(missed(&dense, &a, &b, &share, &crowd));
    b.width--;
    assert_non_null(missed(&same_text, &a, &b, &share, &crowd));
    test_free(a.rgb);
    test_free(b.rgb);
}

/* What it leaves to look at. */
static void test_differences_are_shown(void **state)
{
    (void)state;
    enum { WIDTH = 100, HEIGHT = 80 };
    struct raster a = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)}, b = {WIDTH, HEIGHT, test_calloc(WIDTH * HEIGHT, 3)};
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        a.rgb[i] = b.rgb[i] = (uint8_t)(i * 7 % 200);
    b.rgb[0] = (uint8_t)(a.rgb[0] + 100);
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
    test_free(a.rgb);
    test_free(b.rgb);
}

struct mark {
    double y;
    bool hollow, red;
};

/* A plot as large as the golden one of peaks, with one mark of its size; NULL: none. */
static struct raster marked(const struct mark *mark)
{
    enum { WIDTH = 677, HEIGHT = 504 };
    struct raster r = {WIDTH, HEIGHT, test_malloc((size_t)3 * WIDTH * HEIGHT)};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    cairo_set_source_rgb(cr, mark && mark->red ? 0.8 : 0.1, 0.3, mark && mark->red ? 0.1 : 0.6);
    if (mark)
        cairo_arc(cr, 300.5, mark->y, mark->hollow ? 4.5 : 5, 0, 7);
    if (mark && mark->hollow)
        cairo_stroke(cr);
    else
        cairo_fill(cr);
    cairo_surface_flush(surface);
    for (int y = 0; y < HEIGHT; y++) {
        const uint8_t *row = cairo_image_surface_get_data(surface) + (ptrdiff_t)y * cairo_image_surface_get_stride(surface);
        for (int x = 0; x < 3 * WIDTH; x++)
            r.rgb[3 * WIDTH * y + x] = row[4 * (x / 3) + 2 - x % 3];
    }
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return r;
}

/* One mark of a plot that is elsewhere, of another colour or kind, or gone, is seen with any libraries. */
static void test_moved_marks_are_seen(void **state)
{
    (void)state;
    static const struct mark dot = {.y = 200.3}, ring = {.y = 200.3, .hollow = true};
    const struct {
        const struct mark *before, *after;
        bool passes;
    } marks[] = {
        {&dot, &dot, true},
        {&ring, &ring, true},
        {&dot, NULL, false},
        {&ring, NULL, false},
        {&dot, &ring, false},
        {&dot, &(struct mark){.y = 204.3}, false},
        {&ring, &(struct mark){.y = 204.3, .hollow = true}, false},
        {&dot, &(struct mark){.y = 200.3, .red = true}, false},
        {&ring, &(struct mark){.y = 200.3, .hollow = true, .red = true}, false},
    };
    double share;
    size_t crowd;
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        struct raster a = marked(marks[i].before), b = marked(marks[i].after);
        assert_int_equal(missed(&same_text, &a, &b, &share, &crowd) == NULL, marks[i].passes);
        assert_int_equal(missed(&other_text, &a, &b, &share, &crowd) == NULL, marks[i].passes);
        test_free(a.rgb);
        test_free(b.rgb);
    }
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
    size_t crowd;
    memset(a.rgb, 255, 3 * SIZE * SIZE);
    memset(a.rgb + 3 * SIZE * AT, 0, 3 * SIZE);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        memset(b.rgb, 255, 3 * SIZE * SIZE);
        memset(b.rgb + 3 * SIZE * lines[i].at, lines[i].value, 3 * SIZE);
        assert_int_equal(missed(&other_text, &a, &b, &share, &crowd) == NULL, lines[i].passes);
        assert_int_equal(missed(&same_text, &a, &b, &share, &crowd) == NULL, i == 0);
    }
    test_free(a.rgb);
    test_free(b.rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden_pictures),       cmocka_unit_test(test_differences_are_seen),
        cmocka_unit_test(test_differences_are_shown), cmocka_unit_test(test_moved_lines_are_seen),
        cmocka_unit_test(test_moved_marks_are_seen),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
