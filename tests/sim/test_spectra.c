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

/* What is found in `samples` samples of x(bead, sample), 1 us apart, of a chain of equal beads behind the striker. */
static struct bead_spectral spectral_of(const char *show, size_t beads, size_t samples, double (*x)(size_t, size_t))
{
    char text[400];
    struct bead_message msg = {""};
    struct bead_spectra *spectra;
    struct bead_spectral found;
    double u[64] = {9};
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: large-steel, count: %zu}]}\nsimulate: {until: 1 ms}\n"
             "outputs: [{table: t.csv, show: %s, field: displacement, every: 1 us}]\n",
             beads, show);
    struct built b;
    assert_int_equal(bead_scene_parse("test", text, strlen(text), NULL, &b.scene, &msg), BEAD_OK);
    assert_int_equal(bead_chain_create(b.scene, 0, &b.chain, &msg), BEAD_OK);
    assert_int_equal(bead_chain_beads(b.chain), beads + 1);
    const struct bead_run_context context = {.scene = b.scene,
                                             .chains = (const struct bead_chain *const *)&b.chain,
                                             .chain_count = 1,
                                             .end = ((double)samples - 0.5) * 1e-6};
    assert_int_equal(bead_spectra_create(&b.scene->outputs[0], &context, &spectra, &msg), BEAD_OK);
    for (size_t i = 0; i < samples; i++) {
        struct bead_sample sample = {.time = (double)i * 1e-6, .field[BEAD_FIELD_DISPLACEMENT] = u};
        for (size_t j = 0; j < beads; j++)
            u[j + 1] = x(j, i);
        assert_int_equal(bead_spectra_feed(spectra, &sample, &msg), BEAD_OK);
    }
    if (bead_spectra_of(spectra, 0, &found, &msg))
        fail_msg("%s", msg.text);
    bead_spectra_destroy(spectra);
    release(&b);
    return found;
}

enum { BEADS = 12, SAMPLES = 40 };
static const double pi = 3.14159265358979323846;

/* Waves A cos(2 pi (q n / BEADS - k i / SAMPLES)), and one number for all times, which is no wave. */
static const struct {
    int q, k;
    double amplitude;
} waves[] = {{1, 1, 3}, {-5, 19, 2}, {2, 7, 3}, {-2, 7, 4}, {0, 3, 7}, {6, 3, 8}, {0, 20, 1.5}, {0, 0, 5}, {4, 0, 6}};

static double of_waves(size_t n, size_t i)
{
    double sum = 0;
    for (size_t w = 0; w < sizeof waves / sizeof *waves; w++)
        sum += waves[w].amplitude * cos(2 * pi * (waves[w].q * (double)n / BEADS - waves[w].k * (double)i / SAMPLES));
    return sum;
}

static double noise(size_t n, size_t i)
{
    return sin(1e4 * (double)(n * n + 1) * (double)(i * i + 3));
}

/* A wave has its amplitude at its wave number and frequency, two in opposite directions the root of the sum of their squares; all
 * else is 0. At Nyquist's frequency the mean square is that of a sine sqrt(2) times as high. */
static void waves_have_their_amplitudes(void **state)
{
    (void)state;
    struct bead_spectral d = spectral_of("dispersion, window: none", BEADS, SAMPLES, of_waves);
    assert_int_equal(d.columns, BEADS / 2 + 1);
    assert_int_equal(d.rows, SAMPLES / 2 + 1);
    assert_near(d.step, 1e6 / SAMPLES, 1e-6);
    assert_near(d.between, 2. / BEADS, 1e-15);
    for (int q = 0; q <= BEADS / 2; q++) {
        for (int k = 0; k <= SAMPLES / 2; k++) {
            double squares = 0;
            for (size_t w = 0; w < sizeof waves / sizeof *waves; w++)
                squares += k > 0 && abs(waves[w].q) == q && waves[w].k == k ? waves[w].amplitude * waves[w].amplitude : 0;
            if (2 * k == SAMPLES)
                squares *= 2;
            assert_near(d.values[q * (int)d.rows + k], sqrt(squares), 1e-12);
        }
    }
    free(d.values);
}

/* Half of the sum of all squares is the mean square about the mean of each bead (Parseval); for odd numbers, too. */
static void squares_add_up(void **state)
{
    (void)state;
    static const size_t sizes[][2] = {{12, 40}, {15, 45}, {9, 16}, {3, 27}, {2, 18}};
    for (size_t c = 0; c < sizeof sizes / sizeof *sizes; c++) {
        for (int all = 0; all < 2; all++) {
            const size_t beads = sizes[c][0], samples = sizes[c][1];
            double squares = 0, sum = 0;
            char show[100] = "dispersion, window: none", *at = show;
            if (all) {
                at += sprintf(at, "spectrum, window: none, beads: [1");
                for (size_t n = 2; n <= beads; n++)
                    at += sprintf(at, ", %zu", n);
                strcpy(at, "]");
            }
            struct bead_spectral d = spectral_of(show, beads, samples, noise);
            for (size_t n = 0; n < beads; n++) {
                double mean = 0;
                for (size_t i = 0; i < samples; i++)
                    mean += noise(n, i) / (double)samples;
                for (size_t i = 0; i < samples; i++)
                    squares += pow(noise(n, i) - mean, 2) / (double)samples;
            }
            for (size_t i = 0; i < d.columns * d.rows; i++)
                sum += d.values[i] * d.values[i] / 2 * (all ? 1 : (double)beads);
            assert_near(sum, squares, 1e-12 * squares);
            free(d.values);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bells_are_found_between_rows), cmocka_unit_test(lines_at_the_ends),
                                       cmocka_unit_test(bands_have_their_own_lines), cmocka_unit_test(waves_have_their_amplitudes),
                                       cmocka_unit_test(squares_add_up)};
    return cmocka_run_group_tests_name("spectra", tests, NULL, NULL);
}
