/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order of spins apart from their magnetism: domains and correlations. */
#include "support.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(orders_of_known_spins), cmocka_unit_test(random_spins_have_no_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
