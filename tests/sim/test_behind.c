/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Behind: beads far behind the front are dropped without a change of the measured peaks, or the run reports that it was cut
 * short. */
#include "support.h"

#include "sim/run/behind.h"
#include "sim/run/play.h"

/* Peaks of beads `span` of a chain, the evaluations that they took, and whether the run was cut short. */
struct found {
    struct bead_peak peaks[2];
    uint64_t evaluations, hash;
    bool cut_short;
};

static struct found play_chain(const struct built *built, struct bead_span span, double widening)
{
    struct bead_message msg = {""};
    struct bead_counts counts = {0};
    struct bead_consumer consumer = {.needs = {.bead_peaks = true}};
    const struct bead_chain *chain = built->chain;
    const struct bead_play play = {.chains = &chain,
                                   .chain_count = 1,
                                   .simulate = &built->scene->simulate,
                                   .kernels = bead_kernels_find(NULL),
                                   .consumers = &consumer,
                                   .consumer_count = 1,
                                   .end = INFINITY,
                                   .needed = INFINITY,
                                   .passage = BEAD_PASSAGE_OF_FRONT,
                                   .peak_span = &span,
                                   .widening = widening,
                                   .target = span.first,
                                   .hash = true,
                                   .threads = 1,
                                   .counts = &counts};
    struct bead_played played;
    if (bead_play(&play, &played, &msg))
        fail_msg("%s", msg.text);
    const struct bead_peak *peaks = played.outcomes[0].bead_peaks;
    const struct found found = {
        {peaks[span.first], peaks[span.last]}, counts.evaluations, counts.state_hash, bead_run_cut_short(played.runs[0].run)};
    bead_played_free(&played);
    return found;
}

static double difference(const struct found *a, const struct found *b)
{
    return fmax(fabs(a->peaks[0].value / b->peaks[0].value - 1), fabs(a->peaks[1].value / b->peaks[1].value - 1));
}

#define RANDOM(cell, count, seed) \
    "chain: {beads: [{cell: " cell ", count: " #count ", spins: random, seed: " #seed "}, {cell: " cell ", count: 10}]}\n"

/* The force behind 256 random cells is that of the whole chain to a hundredth of the requested accuracy, for less than two thirds
 * of the evaluations. */
static void peaks_are_those_of_the_whole_chain(void **)
{
    const struct bead_span span = {515, 517};
    struct built chains[] = {build(RANDOM("[large-steel, aluminium]", 256, 1), ""),
                             build(RANDOM("[large-steel, aluminium]", 256, 2), ""),
                             build(RANDOM("[large-steel, small-steel, brass]", 170, 3), "")};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        const struct found whole = play_chain(&chains[i], span, 0), cut = play_chain(&chains[i], span, 1.3);
        assert_false(whole.cut_short);
        assert_false(cut.cut_short);
        assert_true(difference(&cut, &whole) <= 1.5e-8);
        assert_true((double)cut.evaluations < 0.66 * (double)whole.evaluations);
        release(&chains[i]);
    }
}

/* If signals travel faster than the cut allows, the run says so: with less than the speed of the front in any chain, and with the
 * usual widening if hard beads are beside soft ones. With more beads it agrees. */
static void a_cut_too_near_is_noticed(void **)
{
    const struct bead_span span = {259, 261};
    struct built steel = build(RANDOM("[large-steel, aluminium]", 128, 1), ""),
                 hard = build(RANDOM("[tungsten-carbide, ptfe]", 128, 1), "");
    const struct found narrow = play_chain(&steel, span, 0.2), whole = play_chain(&hard, span, 0);
    assert_true(narrow.cut_short);
    assert_true(play_chain(&hard, span, 1.3).cut_short);
    const struct found wide = play_chain(&hard, span, 1.8);
    assert_true(wide.cut_short || difference(&wide, &whole) <= 1.5e-8);
    release(&steel);
    release(&hard);
}

/* Where signals overtake the front, or other forces act, no bead is dropped: every bit of every state is that of the whole run. */
static void other_chains_are_whole(void **)
{
    static const char *const texts[] = {
        "chain: {precompression: 5 N, beads: [{cell: [large-steel, aluminium], count: 60}]}\n",
        "chain: {tilt: 5 deg, wall: brass, beads: [{cell: [large-steel, aluminium], count: 60}]}\n",
        "chain: {damping: {coefficient: 10}, beads: [{cell: [large-steel, aluminium], count: 60}]}\n",
        "chain: {law: {power: 2, coefficient: 1e9}, beads: [{cell: [large-steel, aluminium], count: 60}]}\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct built built = build(texts[i], "");
        const struct bead_span span = {115, 117};
        assert_non_null(bead_behind_refusal(built.chain));
        const struct found whole = play_chain(&built, span, 0), cut = play_chain(&built, span, 1.3);
        assert_int_equal(cut.hash, whole.hash);
        assert_int_equal(cut.evaluations, whole.evaluations);
        assert_false(cut.cut_short);
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peaks_are_those_of_the_whole_chain),
        cmocka_unit_test(a_cut_too_near_is_noticed),
        cmocka_unit_test(other_chains_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
