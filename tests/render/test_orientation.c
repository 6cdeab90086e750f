/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Space-time images in every orientation: the same pixels, turned or mirrored, in films and in contact sheets; the default of each
 * kind of output; and no word of a sheet is cut off or covered by another. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/figure/contact_sheet.h"
#include "render/movie/composer.h"
#include "render/view/orientation.h"
#include "render/view/views.h"
#include "tests/sweeps.h"

static const char *const names[] = {"auto", "time-right", "time-down", "matrix"};

/* ---- films ---- */

enum { ALONG = 60, BEADS = 21, STEPS = 90 };

/* Bare pixels of a film, ALONG time, and so many across; `until` is the last of STEPS that is drawn. */
static void make_film(enum bead_orientation orientation, int across, int until, struct bead_frame *frame)
{
    const bool down = orientation != BEAD_TIME_RIGHT && orientation != BEAD_MATRIX;
    const int width = down ? across : ALONG, height = down ? ALONG : across;
    struct bead_message msg = {""};
    struct bead_chain *chain;
    struct bead_composer *composer;
    char text[600];
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: large-steel, count: %d}]}\nsimulate: {until: 1 ms}\n"
             "outputs: [{movie: m.mp4, axes: false, views: [spacetime], size: [%d, %d], orientation: %s}]\n",
             BEADS - 1, width, height, names[orientation]);
    struct bead_scene *scene = parse(text);
    assert_int_equal(bead_chain_create(scene, 0, &chain, &msg), BEAD_OK);
    const struct bead_chain *const chains[] = {chain};
    struct bead_composer_setup setup = {.output = &scene->outputs[0],
                                        .chains = chains,
                                        .chain_count = 1,
                                        .width = width,
                                        .height = height,
                                        .time = {0, 1e-3},
                                        .step = 1e-3 / STEPS,
                                        .range = {.high = 20},
                                        .scene = scene,
                                        .canvas = "plain",
                                        .tolerance_factor = 1};
    if (bead_composer_create(&setup, &composer, &msg) || bead_composer_open(composer, &msg))
        fail_msg("%s\n%s", msg.text, text);
    for (int i = 0; i <= until; i++) {
        struct bead_changes changes = {0};
        double force[BEADS];
        for (int j = 0; j < BEADS; j++) {
            double from = j - 0.2 * i;
            force[j] = 20 * exp(-0.3 * from * from) + (i * 7 + j * 3) % 5;
        }
        struct bead_sample sample = {.time = 1e-3 * i / STEPS, .active = BEADS};
        sample.field[BEAD_FIELD_FORCE] = force;
        assert_int_equal(bead_composer_feed(composer, &sample, &msg), BEAD_OK);
        assert_int_equal(bead_composer_draw(composer, sample.time, &changes, &msg), BEAD_OK);
    }
    assert_int_equal(bead_frame_create(width, height, frame, &msg), BEAD_OK);
    bead_frame_copy(frame, bead_composer_frame(composer), (struct bead_rect){0, 0, width, height});
    bead_composer_close(composer);
    bead_composer_destroy(composer);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

static const uint8_t *pixel(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

static void compare_films(int across, int until)
{
    struct bead_frame films[4];
    size_t colours = 0;
    for (int o = 0; o < 4; o++)
        make_film((enum bead_orientation)o, across, until, &films[o]);
    for (int time = 0; time < ALONG; time++) {
        for (int place = 0; place < across; place++) {
            const uint8_t *down = pixel(&films[BEAD_TIME_DOWN], place, time);
            assert_memory_equal(down, pixel(&films[BEAD_ORIENTATION_AUTO], place, time), 3);
            assert_memory_equal(down, pixel(&films[BEAD_MATRIX], time, place), 3);
            assert_memory_equal(down, pixel(&films[BEAD_TIME_RIGHT], time, across - 1 - place), 3);
            colours += place > 0 && memcmp(down, pixel(&films[BEAD_TIME_DOWN], place - 1, time), 3) != 0;
        }
    }
    assert_true(colours > (size_t)until);
    for (int o = 0; o < 4; o++)
        bead_frame_free(&films[o]);
}

/* Also while a film runs, with a line at the present. */
static void test_films_turn(void **state)
{
    (void)state;
    static const int across[] = {BEADS, 2 * BEADS, 34}, until[] = {STEPS, 53, 20};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            compare_films(across[i], until[k]);
    }
}

/* ---- contact sheets ---- */

enum { MOST_TEXTS = 512 };

struct texts {
    double box[MOST_TEXTS][4]; /* left, top, right, bottom */
    char markup[MOST_TEXTS][300];
    size_t count;
};

static void see(void *context, const char *markup, double x, double y, double width, double height)
{
    struct texts *seen = context;
    assert_true(seen->count < MOST_TEXTS);
    memcpy(seen->box[seen->count], (double[]){x, y, x + width, y + height}, sizeof seen->box[0]);
    snprintf(seen->markup[seen->count++], sizeof seen->markup[0], "%s", markup);
}

static void assert_legible(const struct texts *seen, const struct bead_page *page)
{
    for (size_t i = 0; i < seen->count; i++) {
        const double *a = seen->box[i];
        if (a[0] < 0 || a[1] < 0 || a[2] > page->width || a[3] > page->height)
            fail_msg("%d x %d: '%s' is cut off", page->width, page->height, seen->markup[i]);
        for (size_t j = 0; j < i; j++) {
            const double *b = seen->box[j];
            if (a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3])
                fail_msg("%d x %d: '%s' lies over '%s'", page->width, page->height, seen->markup[i], seen->markup[j]);
        }
    }
}

static bool wrote(const struct texts *seen, const char *words)
{
    for (size_t i = 0; i < seen->count; i++) {
        if (strstr(seen->markup[i], words))
            return true;
    }
    return false;
}

struct paper {
    struct bead_scene *scene;
    struct bead_sweep *sweep;
    struct contact_sheet sheet;
    cairo_surface_t *surface;
    struct texts seen;
};

/* Both beads of each dimer have its spin; the mean of the first six, which are random, is the magnetism. The striker has none. */
static void assert_spins(const struct contact_image *image)
{
    enum { CELLS = 6, IN_CELL = 2 };
    size_t count = 0;
    double sum = 0;
    assert_true(image->spin[0] < 0);
    for (size_t i = 1; i < image->beads && image->spin[i] >= 0; i++) {
        sum += count < CELLS * IN_CELL ? 2 * image->spin[i] - 1 : 0;
        assert_true(++count % IN_CELL == 1 || image->spin[i - 1] == image->spin[i]);
    }
    assert_true(count + 1 == image->beads && fabs(sum / (CELLS * IN_CELL) - image->magnetism) < 1e-12);
}

static void open_paper(struct paper *p, enum bead_orientation orientation, int width, int height)
{
    const struct bead_text_watch watch = {see, &p->seen};
    struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 2};
    struct bead_message msg = {""};
    char text[400];
    snprintf(text, sizeof text,
             "title: A sheet\nsweep: {cells: 6, configurations: 12, seed: 7}\n"
             "outputs: [{sheet: sheet.png, size: [%d, %d], orientation: %s}]\n",
             width, height, names[orientation]);
    p->scene = parse(text);
    p->seen.count = 0;
    assert_int_equal(bead_sweep_create(p->scene, &p->sweep, &msg), BEAD_OK);
    p->sheet = (struct contact_sheet){.output = &p->scene->outputs[0], .sweep = p->sweep};
    if (contact_sheet_make(&p->sheet, &settings, &msg))
        fail_msg("%s", msg.text);
    for (size_t i = 0; i < p->sheet.image_count; i++)
        assert_spins(&p->sheet.images[i]);
    p->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    assert_true(bead_text_watch(p->surface, &watch));
    cairo_t *cr = cairo_create(p->surface);
    assert_int_equal(contact_sheet_draw(&p->sheet, cr, &msg), BEAD_OK);
    cairo_destroy(cr);
    cairo_surface_flush(p->surface);
}

static void close_paper(struct paper *p)
{
    cairo_surface_destroy(p->surface);
    contact_sheet_clear(&p->sheet);
    bead_sweep_close(p->sweep);
    bead_scene_free(p->scene);
}

static const uint8_t *dot(const struct paper *p, int x, int y)
{
    return cairo_image_surface_get_data(p->surface) + y * cairo_image_surface_get_stride(p->surface) + 4 * x;
}

/* Every pixel of every picture is the mean of its stretch of chain and time. */
static void check_pictures(const struct paper *p, enum bead_orientation orientation)
{
    const bool down = orientation != BEAD_TIME_RIGHT && orientation != BEAD_MATRIX;
    assert_true(p->sheet.image_count > 4);
    for (size_t i = 0; i < p->sheet.image_count; i++) {
        const struct contact_image *image = &p->sheet.images[i];
        const struct bead_rect *box = &image->picture;
        const int columns = down ? box->height : box->width, places = down ? box->width : box->height;
        double means[4000];
        assert_int_equal(bead_area_places(image->area), places);
        for (int c = 0; c < columns; c++) {
            if (!bead_area_column(image->area, c, means))
                continue;
            for (int k = 0; k < places; k++) {
                const int x = down ? k : c, y = down ? c : orientation == BEAD_MATRIX ? k : places - 1 - k;
                const uint8_t *rgb = p->sheet.map.rgb[bead_colours_index(&p->sheet.colours, means[k])],
                              *found = dot(p, box->x + x, box->y + y);
                assert_true(found[2] == rgb[0] && found[1] == rgb[1] && found[0] == rgb[2]);
            }
        }
    }
}

/* The spins are beside the beads that they belong to. */
static void check_spins(const struct paper *p, enum bead_orientation orientation)
{
    const bool down = orientation != BEAD_TIME_RIGHT && orientation != BEAD_MATRIX;
    const struct contact_image *image = &p->sheet.images[p->sheet.image_count - 1];
    const struct bead_rect *box = &image->spins, *picture = &image->picture;
    assert_true(down ? box->width == picture->width && box->y + box->height < picture->y
                     : box->height == picture->height && box->x + box->width < picture->x);
    size_t reversed = 0;
    for (size_t j = 0; j < image->beads; j++) {
        double part = ((double)j + 0.5) / (double)image->beads;
        part = orientation == BEAD_TIME_RIGHT ? 1 - part : part;
        const struct bead_rgb expected = contact_sheet_spin_colour(&p->sheet, image->spin[j]);
        const uint8_t *found = down ? dot(p, box->x + (int)(part * box->width), box->y + box->height / 2)
                                    : dot(p, box->x + box->width / 2, box->y + (int)(part * box->height));
        assert_true(fabs(found[2] - 255 * expected.r) < 1.5 && fabs(found[0] - 255 * expected.b) < 1.5);
        reversed += image->spin[j] == 0;
    }
    assert_true(reversed > 0 && reversed < image->beads);
}

static void test_sheets_turn(void **state)
{
    (void)state;
    static struct paper p;
    for (int o = 0; o < 4; o++) {
        open_paper(&p, (enum bead_orientation)o, 900, 700);
        check_pictures(&p, (enum bead_orientation)o);
        check_spins(&p, (enum bead_orientation)o);
        assert_true(wrote(&p.seen, o == BEAD_TIME_RIGHT ? "bottom to top" : o == BEAD_MATRIX ? "top to bottom" : "left to right"));
        assert_true(wrote(&p.seen, o == BEAD_TIME_RIGHT || o == BEAD_MATRIX ? "to the right" : "downwards"));
        close_paper(&p);
    }
}

static void test_words_of_sheets(void **state)
{
    (void)state;
    static struct paper p;
    static const int sizes[][2] = {{640, 480}, {1280, 720}, {1920, 1080}, {700, 1400}, {1600, 500}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int o = 0; o < 4; o++) {
            open_paper(&p, (enum bead_orientation)o, sizes[i][0], sizes[i][1]);
            assert_legible(&p.seen, &p.sheet.page);
            close_paper(&p);
        }
    }
}

/* ---- what each kind takes by itself ---- */

static void test_defaults(void **state)
{
    (void)state;
    static const struct {
        const char *output;
        enum bead_orientation orientation;
    } cases[] = {{"image: a.png", BEAD_TIME_RIGHT},
                 {"image: a.png, axes: false", BEAD_MATRIX},
                 {"image: a.png, views: [beads, spacetime]", BEAD_TIME_DOWN},
                 {"image: a.png, views: [profile, spacetime], axes: false", BEAD_TIME_DOWN},
                 {"movie: a.mp4", BEAD_TIME_DOWN},
                 {"movie: a.mp4, views: [spacetime]", BEAD_TIME_DOWN},
                 {"movie: a.mp4, views: [spacetime], axes: false", BEAD_TIME_DOWN},
                 {"image: a.png, orientation: time-down", BEAD_TIME_DOWN},
                 {"movie: a.mp4, orientation: time-right", BEAD_TIME_RIGHT},
                 {"movie: a.mp4, axes: false, orientation: matrix", BEAD_MATRIX}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[300];
        snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, count: 5}]}\noutputs: [{%s}]\n", cases[i].output);
        struct bead_scene *scene = parse(text);
        if (bead_orientation_of(&scene->outputs[0]) != cases[i].orientation)
            fail_msg("%s: %s", cases[i].output, names[bead_orientation_of(&scene->outputs[0])]);
        bead_scene_free(scene);
    }
}

/* The unit of times, of one letter, is no symbol in italics. */
static void test_unit_after_both_titles(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("chain: {beads: [{bead: large-steel, count: 5}]}\noutputs: [{movie: a.mp4}]\n");
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_view *view;
    static struct texts seen;
    static struct bead_colormap map;
    assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
    bead_look_film(&look, 1920, 1080, true, false);
    const struct bead_view_setup setup = {.chain = chain,
                                          .field = BEAD_FIELD_FORCE,
                                          .beads = {0, 4},
                                          .time = {0, 3},
                                          .colours = {&map, BEAD_SCALE_LINEAR, 0, 40, 0},
                                          .look = &look,
                                          .axes = true,
                                          .bead_labels = true,
                                          .against = true,
                                          .orientation = BEAD_TIME_RIGHT,
                                          .titles = BEAD_TITLES_ABOVE};
    assert_int_equal(bead_view_spacetime_type.create(&setup, &view, NULL), BEAD_OK);
    assert_int_equal(bead_view_spacetime_type.place(view, (struct bead_rect){100, 100, 400, 200}, NULL, NULL), BEAD_OK);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1920, 1080);
    const struct bead_text_watch watch = {see, &seen};
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    assert_int_equal(bead_view_spacetime_type.decorate(view, cr, NULL), BEAD_OK);
    assert_true(wrote(&seen, "bead against time (s)"));
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    bead_view_spacetime_type.destroy(view);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_films_turn),
        cmocka_unit_test(test_sheets_turn),
        cmocka_unit_test(test_words_of_sheets),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_unit_after_both_titles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
