/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of dispersions: bells with known frequency and height, which a parabola through logarithms finds exactly. */
#include "support.h"

#include "sim/frequency/bands.h"
#include "sim/measure/spectra.h"

enum { COLUMNS = 9, ROWS = 200 };

/* A bell about the row `at`. */
static void add_bell(struct bead_spectral *d, size_t column, double at, double height)
{
    for (size_t k = 0; k < d->rows; k++)
        d->values[column * d->rows + k] += height * exp(-((double)k - at) * ((double)k - at) / 4);
}

static void bells_are_found_between_rows(void **state)
{
    (void)state;
    double values[COLUMNS * ROWS] = {0};
    struct bead_spectral d = {.columns = COLUMNS, .rows = ROWS, .step = 40, .values = values};
    double at[COLUMNS];
    for (size_t c = 0; c < COLUMNS; c++) {
        at[c] = 20 + 18 * (double)c + 0.11 * ((double)c - 4); /* up to .44 rows beside one */
        add_bell(&d, c, at[c], 3 + (double)c);
    }
    for (size_t c = 0; c < COLUMNS; c++) {
        const struct bead_spectral_line line = bead_spectral_line(&d, NULL, c, 0);
        assert_true(isnan(line.exact));
        assert_near(line.found, 40 * at[c], 1e-9 * line.found);
        assert_near(line.amplitude, (3 + (double)c) * exp(-pow(at[c] - round(at[c]), 2) / 4), 1e-12);
    }
}

/* At the first and the last row, or beside rows without any amplitude, a line is where its row is; there is none without amplitude.
 * The first row only has rounding errors. */
static void lines_at_the_ends(void **state)
{
    (void)state;
    double values[7 * 5] = {9, 4, 2, 1, 1, 1, 1, 2, 4, 9, 0, 0, 5,     3, 0, 0, 0, 0,
                            0, 0, 0, 3, 5, 0, 4, 4, 0, 5, 3, 1, 3e-16, 5, 4, 1, 0};
    const struct bead_spectral d = {.columns = 7, .rows = 5, .step = 10, .values = values};
    static const double found[] = {0, 40, 20, NAN, 20, 20, 10}, amplitude[] = {9, 9, 5, 0, 5, 5, 5};
    for (size_t c = 0; c < 7; c++) {
        const struct bead_spectral_line line = bead_spectral_line(&d, NULL, c, 0);
        assert_true(line.found == found[c] || (isnan(found[c]) && isnan(line.found)));
        assert_true(line.amplitude == amplitude[c]);
    }
}

/* Each band has its own line, the strongest between the middles to its neighbours, however strong theirs are. */
static void bands_have_their_own_lines(void **state)
{
    (void)state;
    struct built built = build(
        "chain: {precompression: 20 N, wall: rigid, beads: [{cell: [large-steel, aluminium, ptfe], count: 40}]}\n", "until: 1 us");
    struct bead_medium *media;
    size_t count;
    struct bead_message msg = {""};
    if (bead_media_find(built.chain, &media, &count, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(count, 1);
    double values[COLUMNS * ROWS] = {0}, exact[3], ends[2];
    bead_band(&media[0], 2, ends);
    struct bead_spectral d = {
        .columns = COLUMNS, .rows = ROWS, .step = 1.2 * ends[1] / ROWS, .first = 0.1, .between = 0.1, .values = values};
    for (size_t c = 0; c < COLUMNS; c++) {
        for (size_t band = 0; band < 3; band++) {
            exact[band] = bead_spectral_line(&d, &media[0], c, band).exact;
            bead_band(&media[0], band, ends);
            assert_true(exact[band] >= ends[0] * (1 - 1e-12) && exact[band] <= ends[1] * (1 + 1e-12));
            assert_true(band == 0 || exact[band] > exact[band - 1]);
            add_bell(&d, c, exact[band] / d.step + 0.3, band == c % 3 ? 1 : 1e-3);
        }
        for (size_t band = 0; band < 3; band++) {
            const struct bead_spectral_line line = bead_spectral_line(&d, &media[0], c, band);
            assert_near(line.found, exact[band] + 0.3 * d.step, 1e-3 * d.step);
        }
    }
    bead_media_free(media, count);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bells_are_found_between_rows), cmocka_unit_test(lines_at_the_ends),
                                       cmocka_unit_test(bands_have_their_own_lines)};
    return cmocka_run_group_tests_name("spectra", tests, NULL, NULL);
}
