/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energies of modes, from the series on the grid to the rows of a table, against closed forms. */
#include "tests/support.h"

#include "tests/scratch.h"
#include "tests/sessions.h"

#include "sim/equation/spectral.h"

static const double pi = 3.14159265358979323846;

/* A cosine is half of c_j and half of its conjugate, in the last mode kept as in the first. */
static void series_keep_every_mode(void **state)
{
    (void)state;
    enum { POINTS = 32 };
    struct bead_message msg = {""};
    struct bead_spectral s;
    struct bead_complex c[POINTS];
    assert_int_equal(bead_spectral_create(POINTS, &s, &msg), BEAD_OK);
    assert_int_equal(s.modes, 10); /* two thirds of 32 / 2 */
    for (size_t j = 1; j <= s.modes; j++) {
        for (size_t i = 0; i < POINTS; i++)
            s.grid[i] = cos(2 * pi * (double)(i * j) / POINTS + 0.3);
        memset(c, 0x7f, sizeof c);
        bead_spectral_to_modes(&s, c);
        for (size_t k = 0; k <= s.modes; k++) {
            assert_true(fabs(c[k].re - (k == j ? 0.5 * cos(0.3) : 0)) < 1e-14);
            assert_true(fabs(c[k].im - (k == j ? 0.5 * sin(0.3) : 0)) < 1e-14);
        }
        double value[3];
        bead_spectral_at(c, s.modes, 0.1, value);
        assert_true(fabs(value[0] - cos(0.1 * (double)j + 0.3)) < 1e-14);
    }
    bead_spectral_destroy(&s);
}

/* The rows of "modes.csv" from `scene`: how many there are, and the first one's values after its time. */
static size_t rows_of(const char *scene, size_t count, double *first)
{
    char path[768], line[4096], header[4096];
    size_t rows = 0;
    snprintf(path, sizeof path, "%s/s.yaml", directory);
    write_text(path, scene);
    play_counts((struct bead_job){.input = path, .output = directory});
    snprintf(path, sizeof path, "%s/modes.csv", directory);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(header, sizeof header, file));
    for (; fgets(line, sizeof line, file); rows++) {
        char *at = line;
        double time = strtod(at, &at);
        assert_true(fabs(time - 0.5 * (double)rows) < 1e-12);
        for (size_t k = 0; rows == 0 && k < count; k++) {
            assert_true(*at == ',');
            first[k] = strtod(at + 1, &at);
        }
    }
    fclose(file);
    return rows;
}

/* Unit masses and springs between fixed ends, mode k with amplitude 1: (N + 1) sin^2(pi k / (2 (N + 1))), all of it potential. */
static void strings_begin_with_the_energy_of_their_mode(void **state)
{
    (void)state;
    double energy[8];
    assert_int_equal(rows_of("chains:\n"
                             "  - {name: a, equation: fput, points: 31, alpha: 0.25, start: {mode: 1}}\n"
                             "  - {name: b, equation: fput, points: 15, alpha: 0, start: {mode: 3}}\n"
                             "simulate: {until: 10}\n"
                             "outputs: [{table: modes.csv, show: modes, modes: 4, every: 0.5}]\n",
                             8, energy),
                     21);
    for (size_t k = 1; k <= 4; k++) {
        assert_true(fabs(energy[k - 1] - (k == 1 ? 32 * pow(sin(pi / 64), 2) : 0)) < 1e-14);
        assert_true(fabs(energy[4 + k - 1] - (k == 3 ? 16 * pow(sin(3 * pi / 32), 2) : 0)) < 1e-14);
    }
}

/* The energy of a mode of the Korteweg-de Vries equation is its mean square: a half for a cosine of amplitude 1. */
static void cosines_begin_with_half_their_square(void **state)
{
    (void)state;
    double energy[3];
    assert_int_equal(rows_of("chain: {equation: kdv, length: 2, points: 64, nonlinearity: 1, dispersion: 4.84e-2,\n"
                             "        start: {cosine: 2, amplitude: 1}}\n"
                             "simulate: {until: 1}\n"
                             "outputs: [{table: modes.csv, show: modes, modes: 3, every: 0.5}]\n",
                             3, energy),
                     3);
    assert_true(fabs(energy[0]) < 1e-15 && fabs(energy[1] - 0.5) < 1e-14 && fabs(energy[2]) < 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(series_keep_every_mode),
                                       cmocka_unit_test(strings_begin_with_the_energy_of_their_mode),
                                       cmocka_unit_test(cosines_begin_with_half_their_square)};
    return cmocka_run_group_tests_name("modes", tests, make_directory, remove_directory);
}
