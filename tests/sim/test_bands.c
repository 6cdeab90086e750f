/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small vibrations: bands of dimers and of beads held in place, in closed form, three bands and two gaps of trimers, modes of a
 * free row, the mode at a light impurity, and Thouless's identity between vectors and eigenvalues. */
#include "support.h"

#include "sim/frequency/bands.h"

static const double pi = 3.14159265358979323846;

#define DIMER                                                                      \
    "materials:\n"                                                                 \
    "  heavy: {mass: 28.84 g, radius: 9.53 mm, modulus: 193 GPa, poisson: 0.3}\n"  \
    "  light: {mass: 9.75 g, radius: 9.53 mm, modulus: 73.5 GPa, poisson: 0.33}\n" \
    "  middle: {mass: 15 g, radius: 9.53 mm, modulus: 120 GPa, poisson: 0.3}\n"    \
    "  half: {mass: 14.42 g, radius: 9.53 mm, modulus: 193 GPa, poisson: 0.3}\n"   \
    "chain: {striker: {bead: heavy, velocity: 1 m/s}, precompression: 20 N, beads: "

static struct bead_medium *media_of(const char *beads, size_t count, struct built *built)
{
    char text[2000];
    struct bead_message msg = {""};
    struct bead_medium *media = NULL;
    size_t found = 0;
    snprintf(text, sizeof text, DIMER "%s}\n", beads);
    *built = build(text, "until: 1 ms, accuracy: 1e-6");
    if (bead_media_find(built->chain, &media, &found, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(found, count);
    return media;
}

static double stiffness(double e1, double nu1, double e2, double nu2)
{
    const double a = 4 / 3. / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2) * sqrt(9.53e-3 / 2);
    return 1.5 * pow(a, 2. / 3) * cbrt(20);
}

/* sqrt(2K/M), sqrt(2K/m), sqrt(2K(1/m + 1/M)) over 2 pi: 4710.9, 8102.2 and 9372.2 Hz. Reversed cells are no other ones. */
static void dimers_have_two_bands(void **state)
{
    (void)state;
    struct built built;
    struct bead_medium *media = media_of("[{cell: [heavy, light], count: 30}, {cell: [heavy, light], spins: \"0011\"}]", 1, &built);
    const double k = stiffness(193e9, 0.3, 73.5e9, 0.33), heavy = 28.84e-3, light = 9.75e-3;
    double low[2], high[2], gap[2];
    bead_band(&media[0], 0, low);
    bead_band(&media[0], 1, high);
    assert_true(low[0] == 0 && bead_gap(&media[0], 0, gap) && gap[0] == low[1] && gap[1] == high[0]);
    assert_near(low[1] / (sqrt(2 * k / heavy) / (2 * pi)), 1, 1e-13);
    assert_near(high[0] / (sqrt(2 * k / light) / (2 * pi)), 1, 1e-13);
    assert_near(high[1] / (sqrt(2 * k * (1 / heavy + 1 / light)) / (2 * pi)), 1, 1e-13);
    assert_near(low[1], 4710.9, 0.05);
    assert_near(high[0], 8102.2, 0.05);
    assert_near(high[1], 9372.2, 0.05);
    bead_media_free(media, 1);
    release(&built);
}

/* Three bands and two gaps; the squares of the frequencies sum to the trace at every phase. */
static void trimers_have_three_bands(void **state)
{
    (void)state;
    struct built built;
    struct bead_medium *media = media_of("[{cell: [heavy, middle, light], count: 30}]", 1, &built);
    double ends[2];
    assert_int_equal(media[0].cell.count, 3);
    assert_true(bead_gap(&media[0], 0, ends) && bead_gap(&media[0], 1, ends) && !bead_gap(&media[0], 2, ends));
    const double hm = stiffness(193e9, 0.3, 120e9, 0.3), ml = stiffness(120e9, 0.3, 73.5e9, 0.33),
                 lh = stiffness(73.5e9, 0.33, 193e9, 0.3), trace = (lh + hm) / 28.84e-3 + (hm + ml) / 15e-3 + (ml + lh) / 9.75e-3;
    for (int q = 0; q <= 10; q++) {
        double sum = 0;
        for (size_t i = 0; i < 3; i++)
            sum += pow(2 * pi * bead_jacobi_frequency(&media[0].cell, i, cos(q * pi / 10)), 2);
        assert_near(sum / trace, 1, 1e-13);
    }
    bead_media_free(media, 1);
    release(&built);
}

/* Three equal beads written as a cell are a folded uniform chain: 2 sqrt(K/m) |sin(q/2)|, without gaps. */
static void equal_beads_have_no_gaps(void **state)
{
    (void)state;
    struct built built;
    struct bead_medium *media = media_of("[{cell: [heavy, heavy, heavy], count: 30}]", 1, &built);
    const double k = stiffness(193e9, 0.3, 193e9, 0.3), scale = 2 * sqrt(k / 28.84e-3) / (2 * pi);
    double ends[2];
    for (size_t i = 0; i < 3; i++) {
        for (int q = 1; q < 10; q++) { /* phase of the cell, folded; the first bead alone has the middle one */
            const double phase = q * pi / 10, own = (i % 2 ? 2 * pi * (double)((i + 1) / 2) - phase : pi * (double)i + phase) / 3;
            assert_near(bead_jacobi_frequency(&media[0].cell, i, cos(phase)) / (scale * sin(own / 2)), 1,
                        i == 1 && q == 5 ? 1e-8 : 1e-12);
        }
        assert_false(bead_gap(&media[0], i, ends));
    }
    bead_media_free(media, 1);
    release(&built);
}

/* Springs at every bead lift the square of every frequency by k/m. */
static void held_beads_have_a_lower_edge(void **state)
{
    (void)state;
    struct built built;
    struct bead_medium *media = media_of("[{bead: heavy, count: 30, spring: 1e6 N/m}]", 1, &built);
    const double k = stiffness(193e9, 0.3, 193e9, 0.3);
    double ends[2];
    bead_band(&media[0], 0, ends);
    assert_near(ends[0] / (sqrt(1e6 / 28.84e-3) / (2 * pi)), 1, 1e-13);
    assert_near(ends[1] / (sqrt((1e6 + 4 * k) / 28.84e-3) / (2 * pi)), 1, 1e-13);
    bead_media_free(media, 1);
    release(&built);
}

static struct bead_mode *modes_of(const char *beads, struct built *built)
{
    char text[2000];
    struct bead_message msg = {""};
    struct bead_mode *modes = NULL;
    snprintf(text, sizeof text, DIMER "%s}\n", beads);
    *built = build(text, "until: 1 ms, accuracy: 1e-6");
    if (bead_modes_find(built->chain, &modes, &msg))
        fail_msg("%s", msg.text);
    return modes;
}

/* n free equal beads: 2 sqrt(K/m) sin(pi j / 2n); standing waves have a participation of 2n/3, the rigid motion n. Their ends,
 * cos^2(pi j / 2n) 2 / n in all, make the length that Thouless's formula has even for these. */
static void free_rows_have_standing_waves(void **state)
{
    (void)state;
    struct built built;
    struct bead_mode *modes = modes_of("[{bead: heavy, count: 49}]", &built);
    const double scale = 2 * sqrt(stiffness(193e9, 0.3, 193e9, 0.3) / 28.84e-3) / (2 * pi);
    assert_true(modes[0].frequency == 0);
    assert_near(modes[0].participation, 50, 1e-6);
    for (int j = 1; j < 50; j++) {
        assert_near(modes[j].frequency / (scale * sin(pi * j / 100)), 1, 1e-11);
        assert_near(modes[j].participation, j == 25 ? 50 : 100 / 3., 1e-6);
        assert_near(modes[j].centre, 24.5, 1e-6);
        assert_near(modes[j].length * log(25 / pow(cos(pi * j / 100), 2)) / 49, 1, 1e-9);
    }
    free(modes);
    release(&built);
}

/* A bead of half the mass in a uniform row: w^2 = wmax^2 / (1 - 1/4), and amplitudes fall by (1 - 1/2) / (1 + 1/2) from bead to
 * bead (Montroll and Potts 1955): a length of 1 / ln 3, except for the ends' part of 1/n. */
static void light_impurities_hold_a_mode(void **state)
{
    (void)state;
    struct built built;
    struct bead_mode *modes = modes_of("[{bead: heavy, count: 99}, {bead: half}, {bead: heavy, count: 100}]", &built);
    const struct bead_mode *top = &modes[200];
    const double highest = 2 * sqrt(stiffness(193e9, 0.3, 193e9, 0.3) / 28.84e-3) / (2 * pi);
    assert_near(top->frequency / (highest / sqrt(0.75)), 1, 1e-12);
    assert_near(top->centre, 100, 1e-9);
    assert_near(1 / top->length, log(3), 1e-2);
    assert_true(top->participation < 3 && modes[199].participation > 100);
    free(modes);
    release(&built);
}

/* The vectors of a disordered chain solve their equations, and the product of their ends is the one that the eigenvalues say. */
static void random_chains_obey_thouless(void **state)
{
    (void)state;
    struct built built;
    struct bead_mode *modes = modes_of("[{cell: [heavy, light], count: 60, spins: random, magnetism: 0, seed: 4}]", &built);
    const struct bead_chain *chain = built.chain;
    const size_t n = bead_chain_beads(chain);
    double springs[128], vector[128], work[256];
    struct bead_jacobi matrix;
    struct bead_message msg = {""};
    assert_in_range(n, 3, 128);
    for (size_t k = 0; k < bead_chain_contacts(chain); k++)
        springs[k] = 1.5 * pow(bead_chain_stiffness(chain)[k], 2. / 3) * cbrt(20);
    springs[n - 1] = 0;
    assert_int_equal(bead_jacobi_create(bead_chain_mass(chain), springs, NULL, n, true, &matrix, &msg), BEAD_OK);
    for (size_t i = 1; i < n; i++) {
        const double square = pow(2 * pi * modes[i].frequency, 2);
        double residual = 0;
        bead_jacobi_vector(&matrix, modes[i].frequency, vector, work);
        for (size_t j = 0; j < n; j++) {
            const double before = j > 0 ? matrix.beside[j - 1] * vector[j - 1] : 0;
            const double behind = j + 1 < n ? matrix.beside[j] * vector[j + 1] : 0;
            residual = fmax(residual, fabs(before + behind + (matrix.diagonal[j] - square) * vector[j]));
        }
        assert_true(residual < 1e-13 * matrix.bound);
        assert_near(-log(fabs(vector[0] * vector[n - 1])) * modes[i].length / (double)(n - 1), 1, 1e-6);
    }
    bead_jacobi_free(&matrix);
    free(modes);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dimers_have_two_bands),         cmocka_unit_test(trimers_have_three_bands),
        cmocka_unit_test(equal_beads_have_no_gaps),      cmocka_unit_test(held_beads_have_a_lower_edge),
        cmocka_unit_test(free_rows_have_standing_waves), cmocka_unit_test(light_impurities_hold_a_mode),
        cmocka_unit_test(random_chains_obey_thouless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
