/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order of spins apart from their magnetism: domains and correlations. */
#include "sweeps.h"

#include "sim/chain/spins.h"

static double order(const char *spins, int which)
{
    return bead_spins_order(spins, strlen(spins), which);
}

static void orders_of_known_spins(void **state)
{
    (void)state;
    static const struct {
        const char *spins;
        double domain, correlation, second;
    } cases[] = {{"11111111", 8, 1, 1},        {"00000000", 8, 1, 1},
                 {"10101010", 1, -1, 1}, /* tetramers: M = 0, and as regular as M = 1 */
                 {"11001100", 2, 1.0 / 7, -1}, {"11110000", 4, 5.0 / 7, 1.0 / 3},
                 {"10", 1, -1, NAN},           {"1", 1, NAN, NAN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double found[] = {cases[i].domain, cases[i].correlation, cases[i].second};
        for (int k = 0; k < BEAD_ORDERS; k++) {
            const double value = order(cases[i].spins, k);
            assert_true(isnan(found[k]) ? isnan(value) : fabs(value - found[k]) < 1e-15);
        }
    }
    assert_true(isnan(order("", 0)));
}

/* Of N spins of which half are up, neighbours differ in N / 2 (1 + 1 / (N - 1)) places on average. */
static void random_spins_have_no_order(void **state)
{
    (void)state;
    enum { CELLS = 40000 };
    static char spins[CELLS];
    bead_spins_draw(spins, CELLS, 0, 5, 0);
    assert_near(bead_spins_order(spins, CELLS, 0), 2, 0.04); /* four standard deviations, 1 / sqrt(N) of a correlation */
    assert_near(bead_spins_order(spins, CELLS, 1), 0, 0.02);
    assert_near(bead_spins_order(spins, CELLS, 2), 0, 0.02);
}

/* In a sweep without a magnetism of its own, each random segment has the one of the chain, exactly; each has its own stream, and so
 * has each configuration. */
static void segments_keep_their_magnetism(void **state)
{
    (void)state;
    enum { CONFIGURATIONS = 20 };
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(
        "chain:\n  beads:\n    - {cell: [large-steel, aluminium], count: 10, spins: random, magnetism: 0.6}\n    - {bead: ptfe}\n"
        "    - {cell: [large-steel, aluminium], count: 7, spins: random, magnetism: 1}\n"
        "    - {cell: [large-steel, aluminium], spins: \"101\"}\n"
        "    - {cell: [large-steel, aluminium], count: 10, spins: random, magnetism: 0.6}\n"
        "    - {bead: large-steel, count: 10}\n"
        "sweep: {configurations: 20, seed: 4}" OUTPUT);
    struct bead_sweep *sweep = NULL;
    struct bead_sweep_configuration found[CONFIGURATIONS];
    if (bead_sweep_create(scene, &sweep, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bead_sweep_panel(sweep, 0)->configurations, CONFIGURATIONS);
    int alike = 0;
    for (size_t i = 0; i < CONFIGURATIONS; i++) {
        size_t up[3] = {0};
        bead_sweep_configuration(sweep, 0, i, &found[i]);
        for (size_t k = 0; k < 27; k++)
            up[k < 10 ? 0 : k < 17 ? 1 : 2] += found[i].spins[k] == '1';
        assert_true(up[0] == 8 && up[1] == 7 && up[2] == 8);
        assert_near(found[i].magnetism, (2 * 25 - 30) / 30., 1e-15);
        alike += memcmp(found[i].spins, found[i].spins + 17, 10) == 0;
        for (size_t other = 0; other < i; other++)
            assert_true(memcmp(found[i].spins, found[other].spins, 27) != 0);
    }
    assert_true(alike <= 4); /* of 45 possible draws of 8 in 10, by chance */
    struct bead_sweep_configuration clean;
    bead_sweep_configuration(sweep, 0, BEAD_SWEEP_CLEAN, &clean);
    for (size_t k = 0; k < 27; k++)
        assert_int_equal(clean.spins[k], '1');
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(orders_of_known_spins), cmocka_unit_test(random_spins_have_no_order),
                                       cmocka_unit_test(segments_keep_their_magnetism)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
