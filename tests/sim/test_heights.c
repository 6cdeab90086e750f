/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heights of forces in the parts of a run against the forces at the ends of its steps. */
#include "sim/run/heights.h"

#include "support.h"

enum { MOST_STEPS = 4000, MOST_BEADS = 32 };

/* Forces at the ends of steps, N: of contacts, then of beads. */
static struct {
    size_t steps;
    double time[MOST_STEPS], force[MOST_STEPS][2][MOST_BEADS];
} kept;

static void run_all(struct bead_run *run, double end)
{
    struct bead_message msg = {""};
    for (kept.steps = 0; bead_run_time(run) < end; kept.steps++) {
        assert_true(kept.steps < MOST_STEPS);
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
        const struct bead_sample sample = sample_at(run, bead_run_time(run));
        kept.time[kept.steps] = sample.time;
        for (size_t i = 0; i < sample.active; i++) {
            kept.force[kept.steps][0][i] = sample.field[BEAD_FIELD_CONTACT_FORCE][i];
            kept.force[kept.steps][1][i] = sample.field[BEAD_FIELD_FORCE][i];
        }
    }
}

static double largest_from(double time, int of_beads, size_t i)
{
    double largest = 0;
    for (size_t s = 0; s < kept.steps; s++)
        largest = kept.time[s] >= time ? fmax(largest, kept.force[s][of_beads][i]) : largest;
    return largest;
}

static void assert_in_order(double low, double middle, double high)
{
    if (!(low <= middle && middle <= high))
        fail_msg("%.9g, %.9g and %.9g do not ascend", low, middle, high);
}

/* Parts are at most a sixteenth of the run: the height after a time is that from the beginning of its part on, or, if that does not
 * count, from the end of it on. Stored as float. */
static void heights_are_the_largest_forces_after_a_time(void **state)
{
    (void)state;
    static const double end = 0.6e-3, rounding = 1e-6;
    static const char *const chains[] = {
        "chain: {beads: [{cell: [large-steel, aluminium], spins: \"1011000101\"}], wall: brass}\n",
        "chain: {striker: {bead: small-steel, velocity: 1 m/s}, precompression: 10 N, wall: brass,\n"
        "  beads: [{cell: [large-steel, aluminium], count: 10}]}\n"};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct built built = build(chains[c], "until: 1 ms");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end, .bead_peaks = true, .heights = true});
        const struct bead_heights *heights = bead_run_heights(run);
        size_t smaller = 0;
        assert_near(bead_heights_after(heights, false, 0, 0, 0), 0, 0);
        run_all(run, end);
        for (int at = 0; at < 37; at++) {
            const double t = at * end / 37, part = 2 * end / BEAD_HEIGHT_PARTS;
            for (size_t i = 0; i < 2 * bead_chain_contacts(built.chain); i++) {
                const int of_beads = i % 2;
                const double whole = bead_heights_after(heights, of_beads, i / 2, t, NAN),
                             rest = bead_heights_after(heights, of_beads, i / 2, t, end);
                assert_in_order(largest_from(t, of_beads, i / 2) * (1 - rounding), whole,
                                largest_from(t - part, of_beads, i / 2) * (1 + rounding));
                assert_in_order(largest_from(t + part, of_beads, i / 2) * (1 - rounding), rest,
                                largest_from(t, of_beads, i / 2) * (1 + rounding));
                smaller += rest < whole;
            }
        }
        assert_true(smaller > 37);
        assert_near(bead_heights_after(heights, false, 0, 2 * end, NAN), 0, 0);
        bead_run_destroy(run);
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(heights_are_the_largest_forces_after_a_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
