/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep computed in parts and merged equals the whole one, for everything that rows can hold. */
#include "sweeps.h"

#include "scratch.h"

enum { PARTS = 3 };

static const char *const scenes[] = {
    /* several places */
    "chain:\n"
    "  beads:\n"
    "    - {cell: [large-steel, aluminium], count: 8, spins: random}\n"
    "    - {bead: small-steel, sensor: first}\n"
    "    - {cell: [large-steel, aluminium], count: 3}\n"
    "    - {bead: small-steel, sensor: second}\n"
    "    - {cell: [large-steel, aluminium], count: 4}\n"
    "sweep: {configurations: 4, seed: 2, magnetism: [0, 0.5], measure: {peak: force, sensor: [first, second]}}" OUTPUT,
    /* profiles, without peaks */
    "sweep: {cells: 24, configurations: 3, seed: 3, magnetism: [0, 0.5], measure: {peak: none, decay: true}}" OUTPUT,
};

static void parts_hold_every_place(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        struct bead_scene *scene = parse(scenes[s]);
        struct bead_sweep *whole = compute(scene, NULL), *merged = NULL;
        char path[PARTS][512];
        const char *paths[PARTS];
        for (size_t k = 0; k < PARTS; k++) {
            snprintf(path[k], sizeof path[k], "%.200s/part%zu.h5", directory, k);
            paths[PARTS - 1 - k] = path[k];
            const struct bead_sweep_settings settings = {.threads = 1, .part = k + 1, .parts = PARTS};
            struct bead_sweep *part = compute(scene, &settings);
            assert_int_equal(bead_sweep_write(part, path[k], &msg), BEAD_OK);
            bead_sweep_close(part);
        }
        assert_int_equal(bead_sweep_merge(paths, PARTS, &merged, &msg), BEAD_OK);
        size_t rows = 0, different = 0;
        const size_t places = bead_sweep_panel(whole, 0)->places, beads = bead_sweep_panel(whole, 0)->beads;
        double before = 0;
        struct bead_sweep_configuration a, b;
        for (; bead_sweep_configuration(whole, 0, rows, &a); rows++) {
            assert_true(bead_sweep_configuration(merged, 0, rows, &b));
            assert_true(a.magnetism == b.magnetism);
            for (size_t p = 0; p < places; p++)
                assert_true(a.peaks[p].force == b.peaks[p].force && a.peaks[p].time == b.peaks[p].time &&
                            a.peaks[p].bead == b.peaks[p].bead);
            if (a.bead_force) {
                assert_memory_equal(a.bead_force, b.bead_force, beads * sizeof *a.bead_force);
                assert_memory_equal(a.bead_energy, b.bead_energy, beads * sizeof *a.bead_energy);
                assert_memory_equal(a.last_energy, b.last_energy, beads * sizeof *a.last_energy);
            }
            const double value = places ? a.peaks[places - 1].force : a.bead_force[beads / 2];
            different += value != before;
            before = value;
        }
        assert_false(bead_sweep_configuration(merged, 0, rows, &b));
        assert_int_equal(rows, s == 0 ? 8 : 6);
        assert_int_equal(different, rows); /* else rows could have been swapped */
        bead_sweep_close(merged);
        bead_sweep_close(whole);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(parts_hold_every_place)};
    return cmocka_run_group_tests_name("sweep_parts", tests, make_directory, remove_directory);
}
