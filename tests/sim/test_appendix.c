/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program printed in the thesis's Appendix 4, run once under GNU Octave: the same forces from the ready scene. */
#include "support.h"

enum { BEADS = 46 };

static void the_printed_program_is_reproduced(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct built built;
    if (bead_scene_load("assets/scenes/thesis/imagesc.yaml", NULL, &built.scene, &msg) ||
        bead_chain_create(built.scene, 0, &built.chain, &msg))
        fail_msg("%s", msg.text);
    assert_string_equal(built.chain->law->name, "thesis-appendix");
    assert_int_equal(built.chain->beads, BEADS + 1);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 3e-3});
    struct table table = read_table("appendix4.csv", BEADS + 1);
    double worst = 0, largest = 0;
    for (size_t r = 0; r < table.rows; r++) {
        const double *row = table.value + r * table.columns;
        double time = 0.4e-6 + 0.5e-6 * row[0];
        run_until(run, time - 1e-12);
        struct bead_sample sample = sample_at(run, fmin(time, bead_run_time(run)));
        for (size_t j = 1; j <= BEADS; j++) {
            worst = fmax(worst, fabs(sample.field[BEAD_FIELD_FORCE][j] - row[j]));
            largest = fmax(largest, row[j]);
        }
    }
    assert_true(largest > 50);
    print_message("largest difference %.3g N of %.4g N\n", worst, largest);
    assert_below(worst, 1e-9 * largest);
    free(table.value);
    bead_run_destroy(run);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_printed_program_is_reproduced)};
    return cmocka_run_group_tests_name("appendix", tests, NULL, NULL);
}
