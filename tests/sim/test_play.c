/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Play: what consumers get from chains, and when a run is over. */
#include "support.h"

#include "sim/chain/chain_internal.h"
#include "sim/run/play.h"

enum { CHAINS = 2 };
#define DIMERS(count) "chain: {beads: [{cell: [large-steel, aluminium], count: " #count "}]}\n"

/* The samples of each chain that a consumer has seen. */
struct seen {
    size_t samples[CHAINS], steps[CHAINS], enough;
    double last[CHAINS], time[CHAINS];
};

struct stage {
    struct built built[CHAINS];
    const struct bead_chain *chains[CHAINS];
    struct seen seen;
    struct bead_consumer consumer;
    struct bead_counts counts;
    struct bead_play play;
    struct bead_played played;
    struct bead_message msg;
};

static enum bead_error take(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg)
{
    struct seen *seen = consumer->context;
    (void)msg;
    assert_int_equal(sample->index, seen->samples[sample->chain]);
    assert_non_null(sample->field[BEAD_FIELD_VELOCITY]);
    assert_null(sample->field[BEAD_FIELD_FORCE]);
    seen->samples[sample->chain]++;
    seen->last[sample->chain] = sample->time;
    return BEAD_OK;
}

static enum bead_error step(const struct bead_consumer *consumer, size_t chain, struct bead_run *run, struct bead_message *msg)
{
    struct seen *seen = consumer->context;
    assert_true(bead_run_time(run) > seen->time[chain]);
    seen->time[chain] = bead_run_time(run);
    return ++seen->steps[chain] == seen->enough ? bead_fail(msg, BEAD_ERROR_STOPPED, "enough") : BEAD_OK;
}

/* A short chain and a long one, each until its front arrives; nobody wants anything yet. */
static int set_up(void **state)
{
    struct stage *s = *state = calloc(1, sizeof *s);
    s->built[0] = build(DIMERS(5), "");
    s->built[1] = build(DIMERS(15), "");
    for (size_t c = 0; c < CHAINS; c++)
        s->chains[c] = s->built[c].chain;
    s->consumer = (struct bead_consumer){.context = &s->seen};
    s->play = (struct bead_play){.chains = s->chains,
                                 .chain_count = CHAINS,
                                 .simulate = &s->built[0].scene->simulate,
                                 .kernels = bead_kernels_find(NULL),
                                 .consumers = &s->consumer,
                                 .consumer_count = 1,
                                 .end = INFINITY,
                                 .needed = INFINITY,
                                 .passage = BEAD_PASSAGE_OF_FRONT,
                                 .counts = &s->counts};
    return 0;
}

static int tear_down(void **state)
{
    struct stage *s = *state;
    bead_played_free(&s->played);
    for (size_t c = 0; c < CHAINS; c++)
        release(&s->built[c]);
    free(s);
    return 0;
}

/* The end of neither run is known before, and the short chain's does not end the other's. */
static void samples_end_with_their_own_run(void **state)
{
    struct stage *s = *state;
    const double every = 7e-6;
    s->consumer.take = take;
    s->consumer.needs.fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    s->consumer.needs.beads.last = 10;
    s->consumer.needs.grid = (struct bead_grid){.every = every, .end = INFINITY};
    if (bead_play(&s->play, &s->played, &s->msg))
        fail_msg("%s", s->msg.text);
    for (size_t c = 0; c < CHAINS; c++) {
        const struct bead_outcome *o = &s->played.outcomes[c];
        assert_true(o->end == o->front_arrival);
        assert_true(s->seen.last[c] <= o->end && s->seen.last[c] + every > o->end);
        assert_int_equal(s->seen.samples[c], (size_t)floor(o->end / every) + 1);
    }
    assert_true(s->played.outcomes[1].end > 2 * s->played.outcomes[0].end);
    assert_int_equal(s->counts.samples, s->seen.samples[0] + s->seen.samples[1]);
}

enum { EACH = 3 };

static enum bead_error take_checked(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *)
{
    struct seen *seen = consumer->context;
    assert_non_null(sample->check);
    const double *own = sample->field[BEAD_FIELD_VELOCITY], *check = sample->check->field[BEAD_FIELD_VELOCITY];
    assert_true(sample->check->time == sample->time);
    assert_true((own != NULL) == (sample->index % EACH == 0));
    for (size_t j = 0; own && j < sample->active; j++)
        assert_true(fabs(own[j] - check[j]) <= 1e-4); /* of 1 m/s; accuracy 1e-4 */
    assert_true(check[0] != 0);
    seen->samples[sample->chain]++;
    return BEAD_OK;
}

/* Each third sample is of the run and of its check run; what lies between is of the check run alone. */
static void check_runs_are_sampled_more_often(void **state)
{
    struct stage *s = *state;
    s->consumer.take = take_checked;
    s->consumer.needs = (struct bead_needs){.fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY),
                                            .beads = {0, 5},
                                            .grid = {.every = 1e-6, .end = 1e-4},
                                            .checked = true,
                                            .each = EACH};
    s->play.end = 1e-4;
    s->play.passage = BEAD_PASSAGE_NONE;
    if (bead_play(&s->play, &s->played, &s->msg))
        fail_msg("%s", s->msg.text);
    assert_int_equal(s->seen.samples[0], 101);
    assert_true(s->counts.sample_values <= CHAINS * 34 * 6); /* beads ahead of the front are not counted */
}

/* Number of times of two grids that end at 3 us. */
static size_t times_of(double every, double other)
{
    const unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    struct bead_consumer consumers[2] = {{.needs = {.fields = fields, .grid = {.every = every, .end = 3e-6}}},
                                         {.needs = {.fields = fields, .grid = {.every = other, .end = 3e-6}}}};
    const struct bead_play play = {.consumers = consumers, .consumer_count = 2};
    struct bead_due due;
    size_t count = 0;
    for (bead_due_start(&play); bead_due_next(&play, &due); count++)
        bead_due_pass(&play, &due);
    return count;
}

/* A time that differs by rounding only is not sampled twice; others are, as a shift by a ten millionth of the spacing is more than
 * the accuracy that may be asked for. */
static void times_are_equal_to_rounding(void **state)
{
    (void)state;
    assert_int_equal(times_of(0.1e-6, 0.3e-6), 31);
    assert_int_equal(times_of(1e-6 / 3000, 1e-6), 9001);
    assert_int_equal(times_of(0.1e-6, 0.1e-6 * (1 + 1e-7)), 31 + 29); /* the last is after the end */
}

/* All steps of all chains, on one thread or several. */
static void steps_are_seen(void **state)
{
    struct stage *s = *state;
    s->consumer.step = step;
    for (s->play.threads = 1; s->play.threads <= CHAINS; s->play.threads++) {
        s->seen = (struct seen){.enough = 0};
        s->counts = (struct bead_counts){0};
        bead_played_free(&s->played);
        assert_int_equal(bead_play(&s->play, &s->played, &s->msg), BEAD_OK);
        assert_int_equal(s->seen.steps[0] + s->seen.steps[1], s->counts.steps);
        for (size_t c = 0; c < CHAINS; c++)
            assert_int_equal(s->seen.steps[c], s->played.outcomes[c].steps);
        assert_true(s->seen.steps[0] > 10 && s->seen.steps[1] > s->seen.steps[0]);
    }
}

/* What has been played until then is there. */
static void a_consumer_may_end_it(void **state)
{
    struct stage *s = *state;
    s->consumer.step = step;
    s->consumer.needs.bead_peaks = true;
    s->seen.enough = 9;
    assert_int_equal(bead_play(&s->play, &s->played, &s->msg), BEAD_ERROR_STOPPED);
    assert_string_equal(s->msg.text, "enough");
    assert_int_equal(s->played.outcomes[0].steps, 9);
    assert_true(s->played.outcomes[0].end == s->seen.time[0]);
    assert_true(s->played.outcomes[0].bead_peaks[1].value > 0);
    assert_int_equal(s->played.outcomes[1].steps, 0);
}

static void a_stop_comes_before_a_step(void **state)
{
    struct stage *s = *state;
    const volatile sig_atomic_t stop = 1;
    s->play.stop = &stop;
    assert_int_equal(bead_play(&s->play, &s->played, &s->msg), BEAD_ERROR_STOPPED);
    assert_int_equal(s->counts.steps, 0);
}

static void patience_ends(void **state)
{
    struct stage *s = *state;
    s->play.patience = 0.1;
    assert_int_equal(bead_play(&s->play, &s->played, &s->msg), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(s->msg.text, "the front has not reached the end: give simulate.until"));
    const double passage = bead_chain_passage(s->chains[0], bead_chain_energy(s->chains[0]));
    assert_true(s->played.outcomes[0].end > 0.1 * passage && s->played.outcomes[0].end < 0.5 * passage);
}

/* To a time, the same bits with and without a sample on the way. */
static void an_end_is_kept(void **state)
{
    struct stage *s = *state;
    uint64_t hash[2];
    s->play.end = 1e-4;
    s->play.passage = BEAD_PASSAGE_NONE;
    s->play.hash = true;
    s->consumer.take = take;
    s->consumer.needs.grid = (struct bead_grid){.start = 3e-5, .every = 1, .end = 3e-5};
    for (int sampled = 0; sampled < 2; sampled++) {
        s->counts = (struct bead_counts){0};
        s->consumer.needs.fields = sampled ? BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) : 0;
        bead_played_free(&s->played);
        assert_int_equal(bead_play(&s->play, &s->played, &s->msg), BEAD_OK);
        assert_true(s->played.end == 1e-4);
        assert_int_equal(s->seen.samples[0] + s->seen.samples[1], sampled ? CHAINS : 0);
        hash[sampled] = s->counts.state_hash;
    }
    assert_true(hash[0] == hash[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(samples_end_with_their_own_run, set_up, tear_down),
        cmocka_unit_test(times_are_equal_to_rounding),
        cmocka_unit_test_setup_teardown(steps_are_seen, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_consumer_may_end_it, set_up, tear_down),
        cmocka_unit_test_setup_teardown(check_runs_are_sampled_more_often, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_stop_comes_before_a_step, set_up, tear_down),
        cmocka_unit_test_setup_teardown(patience_ends, set_up, tear_down),
        cmocka_unit_test_setup_teardown(an_end_is_kept, set_up, tear_down),
    };
    return cmocka_run_group_tests_name("play", tests, NULL, NULL);
}
