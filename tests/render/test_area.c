/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas into colours: the same numbers and indices, however they are requested. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/view/area.h"
#include "sim/base/memory.h"

enum { BEADS = 40, COLUMNS = 53 };

static double value_at(size_t bead, int sample)
{
    return 7 * sin(0.9 * (double)bead + 1.3 * sample) - 2;
}

static struct bead_area *make_area(int across, enum bead_sampling sampling)
{
    const struct bead_area_setup setup = {{0, BEADS - 1}, {0, COLUMNS}, across, COLUMNS, sampling};
    struct bead_area *area;
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    return area;
}

/* Sample `i` at 0.7 i: some columns get one, some two. */
static void feed(struct bead_area *area, int i, size_t active)
{
    double values[BEADS];
    for (size_t b = 0; b < BEADS; b++)
        values[b] = value_at(b, b < active ? i : 0);
    bead_area_feed(area, 0.7 * i, values, active);
}

/* ---- colours ---- */

static void assert_same_index(const struct bead_colours *colours, const struct bead_colour_table *table, double value)
{
    uint8_t found = 7;
    bead_colour_table_find(table, 1, &value, &found);
    if (found != bead_colours_index(colours, value))
        fail_msg("scale %d: colour of %.17g is %d, not %d", colours->scale, value, found, bead_colours_index(colours, value));
}

static void test_table_has_the_same_colours(void **state)
{
    (void)state;
    const struct bead_colours all[] = {
        {NULL, BEAD_SCALE_LINEAR, 0, 1, 0},     {NULL, BEAD_SCALE_LINEAR, -3.7, 12.1, 0},
        {NULL, BEAD_SCALE_SQRT, 0, 5, 0},       {NULL, BEAD_SCALE_SQRT, -0.3, 0.8, 0},
        {NULL, BEAD_SCALE_LOG, 1e-4, 1, 0},     {NULL, BEAD_SCALE_LOG, 0.2, 7e9, 0},
        {NULL, BEAD_SCALE_LINEAR, 1, 1e308, 0}, {NULL, BEAD_SCALE_LOG, 1, nextafter(1, 2), 0},
    };
    static const double odd[] = {0, -0.0, NAN, INFINITY, -INFINITY, 1e308, -1e308, 5e-324, -5e-324};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        struct bead_colour_table table;
        bead_colour_table_make(&all[i], &table);
        for (size_t k = 0; k < sizeof odd / sizeof odd[0]; k++)
            assert_same_index(&all[i], &table, odd[k]);
        for (int k = -3000; k <= 13000; k++) { /* also beyond both ends, and at the very borders of colours */
            double part = k / 10000.0, value = all[i].low + part * (all[i].high - all[i].low);
            double root = part * fabs(part) * all[i].high, power = all[i].low * pow(all[i].high / all[i].low, part);
            const double near[] = {value, root, power};
            for (size_t n = 0; n < 3; n++) {
                assert_same_index(&all[i], &table, near[n]);
                assert_same_index(&all[i], &table, nextafter(near[n], INFINITY));
                assert_same_index(&all[i], &table, nextafter(near[n], -INFINITY));
            }
        }
    }
}

static void test_table_has_the_same_borders(void **state)
{
    (void)state;
    for (int scale = BEAD_SCALE_SQRT; scale <= BEAD_SCALE_LOG; scale++) {
        const struct bead_colours colours = {NULL, scale, 0.03, 41, 0};
        struct bead_colour_table table;
        bead_colour_table_make(&colours, &table);
        for (int i = 1; i < 256; i++) {
            assert_int_equal(bead_colours_index(&colours, table.least[i]), i);
            assert_int_equal(bead_colours_index(&colours, nextafter(table.least[i], -INFINITY)), i - 1);
        }
    }
}

/* ---- columns ---- */

/* A column stays the same while later ones are filled, and the extremes are those of all columns at any time. */
static void assert_columns_stay(int across, enum bead_sampling sampling)
{
    struct bead_area *area = make_area(across, sampling);
    double *first = calloc((size_t)across * COLUMNS, sizeof *first), *now = calloc((size_t)across, sizeof *now);
    bool seen[COLUMNS] = {false};
    for (int i = 3; 0.7 * i < COLUMNS + 2; i++) {
        double least = INFINITY, largest = -INFINITY, low, high;
        feed(area, i, i < 20 ? (size_t)i : BEADS);
        for (int c = 0; c < COLUMNS; c++) {
            bool touched = bead_area_column(area, c, now);
            assert_int_equal(touched, c >= 2 && c < 0.7 * i && i > 3);
            if (seen[c])
                assert_memory_equal(now, first + c * across, (size_t)across * sizeof *now);
            else if (touched && c + 1 <= 0.7 * i)
                memcpy(first + c * across, now, (size_t)across * sizeof *now);
            seen[c] = touched && c + 1 <= 0.7 * i;
            for (int p = 0; touched && p < across; p++) {
                least = fmin(least, now[p]);
                largest = fmax(largest, now[p]);
            }
        }
        bead_area_extremes(area, &low, &high);
        if (across <= BEADS) /* else pixels need not be as extreme as beads */
            assert_true(low == least && high == largest);
        else
            assert_true(low <= least && high >= largest);
    }
    for (int c = 2; c < COLUMNS; c++)
        assert_true(seen[c]);
    free(first);
    free(now);
    bead_area_destroy(area);
}

static void test_columns_stay_as_they_are(void **state)
{
    (void)state;
    static const int across[] = {1, 7, BEADS - 1, BEADS, BEADS + 1, 3 * BEADS - 5};
    for (size_t i = 0; i < sizeof across / sizeof across[0]; i++) {
        assert_columns_stay(across[i], BEAD_SAMPLING_AREA);
        assert_columns_stay(across[i], BEAD_SAMPLING_MAX);
    }
}

/* Equal to single pixels, in images of either orientation; nothing is written beside them. */
static void assert_image(const struct bead_area *area, int across, bool down, int from, int to)
{
    const struct bead_colours colours = {NULL, BEAD_SCALE_LINEAR, -9, 5, 0};
    struct bead_colour_table table;
    const ptrdiff_t margin = 3, width = (down ? across : COLUMNS) + 2 * margin, height = (down ? COLUMNS : across) + 2 * margin;
    uint8_t *image = malloc((size_t)(width * height)), *wanted = malloc((size_t)(width * height));
    double *means = calloc((size_t)across, sizeof *means);
    const ptrdiff_t first = margin * width + margin;
    const struct bead_area_image place = {image + first + (down ? 0 : (across - 1) * width), down ? width : 1, down ? 1 : -width};
    int done = -1, last = from;
    memset(image, 200, (size_t)(width * height));
    memset(wanted, 200, (size_t)(width * height));
    for (; last < to && bead_area_column(area, last, means); last++)
        for (ptrdiff_t p = 0; p < across; p++)
            wanted[first + (down ? last * width + p : (across - 1 - p) * width + last)] = bead_colours_index(&colours, means[p]);
    bead_colour_table_make(&colours, &table);
    assert_int_equal(bead_area_colour(area, &table, from, to, &place, &done, NULL), BEAD_OK);
    assert_int_equal(done, last);
    assert_memory_equal(image, wanted, (size_t)(width * height));
    free(image);
    free(wanted);
    free(means);
}

static void test_images_are_of_the_columns(void **state)
{
    (void)state;
    static const int across[] = {1, 13, BEADS, BEADS + 1, 5 * BEADS};
    for (size_t i = 0; i < 2 * sizeof across / sizeof across[0]; i++) {
        int pixels = across[i / 2];
        struct bead_area *area = make_area(pixels, i % 2 ? BEAD_SAMPLING_MAX : BEAD_SAMPLING_AREA);
        for (int k = 3; 0.7 * k < 44; k++)
            feed(area, k, BEADS);
        for (int down = 0; down < 2; down++) {
            assert_image(area, pixels, down, 2, COLUMNS); /* to the first that no sample has touched */
            assert_image(area, pixels, down, 0, 9);       /* none */
            assert_image(area, pixels, down, 9, 10);
            assert_image(area, pixels, down, 5, 41);
            assert_image(area, pixels, down, 7, 7);
        }
        bead_area_destroy(area);
    }
}

/* A picture of more than a page: nothing of what lay there before shows. */
static void test_large_pictures_begin_empty(void **state)
{
    (void)state;
    enum { ACROSS = 700, ALONG = 1500 };
    const struct bead_area_setup setup = {{0, ACROSS - 1}, {0, ALONG}, ACROSS, ALONG, BEAD_SAMPLING_AREA};
    void *memory = bead_large_take(sizeof(double) * ACROSS * ALONG);
    assert_non_null(memory);
    memset(memory, 0x5a, sizeof(double) * ACROSS * ALONG);
    free(memory);
    struct bead_area *area;
    double values[ACROSS] = {0}, means[ACROSS], low, high;
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    for (int t = 0; t <= ALONG; t += 100) {
        values[0] = t;
        bead_area_feed(area, t, values, 1);
    }
    for (int c = 0; c < ALONG; c++) {
        assert_true(bead_area_column(area, c, means));
        assert_true(fabs(means[0] - (c + 0.5)) < 1e-9);
        for (int p = 1; p < ACROSS; p++)
            assert_true(means[p] == 0);
    }
    bead_area_extremes(area, &low, &high);
    assert_true(low == 0 && fabs(high - ALONG + 0.5) < 1e-9);
    bead_area_destroy(area);
}

/* The value of a bead in a column, all along it. */
static double diagonal(int bead, int column)
{
    return bead == column % BEADS ? -0.01 * (column + 1) : 0;
}

static double flash(int bead, int column)
{
    return column == 7 ? 0.01 * (bead + 1) : 0;
}

/* What only a short and narrow event exceeds: of the largest of all columns, in order, the one at 95 %, or of those of all rows the
 * one at 90 %, whichever is larger; nothing is known of nothing. */
static void test_typical_values(void **state)
{
    (void)state;
    static const struct {
        double (*value)(int bead, int column);
        double typical;
    } cases[] = {{diagonal, 0.5}, /* columns have 0.01 to 0.53, rows 0.14 to 0.53: the 50th, and the 36th, 0.49 */
                 {flash, 0.36}};  /* one column has 0.4, the others nothing; rows have 0.01 to 0.4 */
    for (size_t i = 0; i < 2; i++) {
        struct bead_area *area = make_area(BEADS, BEAD_SAMPLING_AREA);
        double largest, typical = bead_area_typical(area, 0, &largest);
        assert_true(isinf(typical) || typical == 0);
        for (int k = 0; k < 2 * COLUMNS; k++) {
            double values[BEADS];
            for (int b = 0; b < BEADS; b++)
                values[b] = cases[i].value(b, k / 2);
            bead_area_feed(area, k / 2 + (k % 2 ? 1 - 1e-9 : 0), values, BEADS);
        }
        typical = bead_area_typical(area, 0, &largest);
        if (!(fabs(typical - cases[i].typical) < 1e-8))
            fail_msg("%g, not %g", typical, cases[i].typical);
        bead_area_destroy(area);
    }
}

/* About a value at rest: a bead at the end has half of it all the time, and is left out. */
static void test_distances_from_rest(void **state)
{
    (void)state;
    struct bead_area *area = make_area(BEADS, BEAD_SAMPLING_AREA);
    for (int k = 0; k < 2 * COLUMNS; k++) {
        double values[BEADS], sign = k / 2 % 2 ? 1 : -1;
        for (int b = 0; b < BEADS; b++)
            values[b] = b == 0 ? 10 : 20 + sign * 0.01 * b;
        bead_area_feed(area, k / 2 + (k % 2 ? 1 - 1e-9 : 0), values, BEADS);
    }
    double largest;
    const double usual = bead_area_typical(area, 20, &largest);
    assert_float_equal(largest, 0.01 * (BEADS - 1), 1e-8);
    assert_float_equal(usual, 0.01 * (BEADS - 1), 1e-8); /* in each column */
    bead_area_typical(area, 0, &largest);
    assert_float_equal(largest, 20 + 0.01 * (BEADS - 1), 1e-8);
    bead_area_destroy(area);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table_has_the_same_colours), cmocka_unit_test(test_table_has_the_same_borders),
        cmocka_unit_test(test_columns_stay_as_they_are),   cmocka_unit_test(test_images_are_of_the_columns),
        cmocka_unit_test(test_large_pictures_begin_empty), cmocka_unit_test(test_typical_values),
        cmocka_unit_test(test_distances_from_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
