/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The front's arrival compared with another way to find it: forces after each of many short steps. */
#include "support.h"

#include "sim/chain/chain_internal.h"

/* Time when the last contact has 1e-4 of the largest force so far, both less the static ones: between steps so short that the
 * logarithm of the force is straight. */
static double arrival_by_steps(const char *chain, const char *step)
{
    struct built built = build(chain, step);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY});
    const size_t contacts = bead_chain_contacts(built.chain);
    const double *rest = bead_chain_static_force(built.chain);
    double largest = 0, before = 0, before_time = 0, arrival = NAN;
    for (bool first = true; isnan(arrival); first = false) {
        struct bead_message msg = {""};
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
        const double time = bead_run_time(run);
        if (first) { /* with damping, the force jumps as the striker hits */
            const struct bead_sample struck = sample_at(run, 0);
            largest = struck.field[BEAD_FIELD_CONTACT_FORCE][0] - rest[0];
        }
        const double *force = sample_at(run, time).field[BEAD_FIELD_CONTACT_FORCE];
        for (size_t k = 0; k < contacts; k++)
            largest = fmax(largest, force[k] - rest[k]);
        const double last = force[contacts - 1] - rest[contacts - 1], level = 1e-4 * largest;
        if (last > level)
            arrival = before_time + (time - before_time) * log(level / before) / log(last / before);
        before = last;
        before_time = time;
    }
    bead_run_destroy(run);
    release(&built);
    return arrival;
}

static void fronts_arrive_when_the_last_force_rises(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "chain: {beads: [{bead: large-steel, count: 12}], wall: brass}\n",
        "chain: {beads: [{cell: [large-steel, aluminium], spins: \"10110\"}]}\n",
        "chain: {striker: {bead: large-steel, velocity: 0.3 m/s}, precompression: 5 N, wall: brass,\n"
        "  beads: [{cell: [large-steel, aluminium], count: 6}]}\n",
        "chain: {striker: {bead: small-steel, velocity: 1 m/s}, tilt: 10 deg, wall: rigid, beads: [{bead: small-steel, count: "
        "12}]}\n",
        "chain: {damping: {coefficient: 5}, beads: [{bead: large-steel, count: 8}], wall: rigid}\n",
        "chain: {striker: {bead: lead, velocity: 3 m/s}, beads: [{bead: ptfe, count: 4}]}\n",
    };
    /* Also long steps: the error of their motion is smaller, that of polynomials over whole ones larger. */
    static const struct {
        const char *simulate;
        double tolerance; /* s, as measured; the reference has steps of 20 ns, between which logarithms bend */
    } kinds[] = {{"accuracy: 1e-4", 2.5e-11}, {"accuracy: 1e-9", 4e-12}};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        const double wanted = arrival_by_steps(chains[c], "step: 20 ns");
        for (size_t kind = 0; kind < sizeof kinds / sizeof *kinds; kind++) {
            struct built built = build(chains[c], kinds[kind].simulate);
            struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = BEAD_PASSAGE_OF_FRONT});
            while (isnan(bead_run_arrival(run))) {
                struct bead_message msg = {""};
                if (bead_run_step(run, &msg))
                    fail_msg("%s", msg.text);
            }
            const double arrival = bead_run_arrival(run);
            if (!(fabs(arrival - wanted) < kinds[kind].tolerance))
                fail_msg("chain %zu, %s: the front arrives at %.14g s, not at %.14g", c, kinds[kind].simulate, arrival, wanted);
            bead_run_destroy(run);
            release(&built);
        }
    }
}

/* Equal beads take over the striker's velocity one by one: the front crosses each gap with it. So does the estimate of its passage.
 */
static void fronts_cross_gaps(void **state)
{
    (void)state;
    static const double gaps[] = {1e-7, 2e-5, 1e-2}, speed = 0.25;
    enum { GAPS = 5 };
    struct built tight = build("chain: {striker: {velocity: 0.25 m/s}, beads: [{bead: large-steel, count: 6}]}\n", "");
    const double energy = bead_chain_energy(tight.chain), passage = bead_chain_passage(tight.chain, energy);
    assert_true(bead_chain_flight(tight.chain) == 0);
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++) {
        char chain[200];
        struct bead_message msg = {""};
        snprintf(chain, sizeof chain, "chain: {striker: {velocity: 0.25 m/s}, gap: %g, beads: [{bead: large-steel, count: 6}]}\n",
                 gaps[g]);
        struct built built = build(chain, "");
        const double flight = GAPS * gaps[g] / speed;
        assert_near(bead_chain_flight(built.chain), flight, 1e-12 * flight);
        assert_near(bead_chain_passage(built.chain, energy), passage + flight, 1e-9 * passage);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = BEAD_PASSAGE_OF_FRONT});
        while (isnan(bead_run_arrival(run))) {
            if (bead_run_step(run, &msg))
                fail_msg("%s", msg.text);
        }
        assert_true(bead_run_arrival(run) > flight && bead_run_arrival(run) < flight + 4 * passage);
        bead_run_destroy(run);
        release(&built);
    }
    release(&tight);
}

/* The first pulse is over when the last contact has a twentieth of its largest force left. */
static void pulses_are_over_at_a_twentieth(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "chain: {beads: [{bead: large-steel, count: 20}], wall: rigid}\n",
        "chain: {beads: [{cell: [large-steel, aluminium], count: 10}], wall: brass}\n",
        "chain: {striker: {bead: small-steel, velocity: 1 m/s}, beads: [{bead: small-steel, count: 15}], wall: lead}\n",
    };
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct built built = build(chains[c], "accuracy: 1e-8");
        struct bead_run *run =
            start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = BEAD_PASSAGE_OF_PULSE, .contact_peaks = true});
        while (isnan(bead_run_over(run))) {
            struct bead_message msg = {""};
            if (bead_run_step(run, &msg))
                fail_msg("%s", msg.text);
        }
        const double over = bead_run_over(run);
        const size_t last = bead_chain_contacts(built.chain) - 1;
        const double force = sample_at(run, over).field[BEAD_FIELD_CONTACT_FORCE][last];
        struct bead_outcome outcome;
        bead_run_finish(run, over, &outcome);
        assert_true(outcome.contact_peaks[last].time > bead_run_arrival(run) && outcome.contact_peaks[last].time < over);
        assert_near(force / outcome.contact_peaks[last].value, 0.05, 1e-6);
        bead_run_destroy(run);
        release(&built);
    }
}

/* One contact, or the two of a bead with a sensor, watched in short steps: when the pulse there is over. */
struct watched {
    size_t first, contacts;
    double most, before[2], passed; /* forces of the last two times */
};

static void watch(struct watched *w, const double *force, const double *rest, double largest, double time, double step)
{
    double sum = 0;
    for (size_t i = 0; i < w->contacts; i++)
        sum += force[w->first + i] - rest[w->first + i];
    w->most = fmax(w->most, sum);
    if (isnan(w->passed) && w->most > 1e-3 * largest) {
        const double level = 0.05 * w->most;
        const bool turned = w->before[0] > w->before[1] && sum > w->before[1] && w->before[1] < 0.5 * w->most;
        const double bend = sum - 2 * w->before[1] + w->before[0];
        w->passed = turned        ? time - step - step * (sum - w->before[0]) / (2 * bend)
                    : sum < level ? time - step * (level - sum) / (w->before[1] - sum)
                                  : NAN;
    }
    w->before[0] = w->before[1];
    w->before[1] = sum;
}

/* When the pulses are over at the last contact and at the bead with a sensor, if there is one. */
static double over_by_steps(const struct built *built, size_t sensor)
{
    static const double step = 20e-9;
    const size_t contacts = bead_chain_contacts(built->chain);
    const double *rest = bead_chain_static_force(built->chain);
    struct watched places[2] = {{contacts - 1, 1, 0, {0}, NAN}, {sensor - 1, sensor < contacts ? 2 : 1, 0, {0}, sensor ? NAN : 0}};
    struct bead_run *run = start_run(built, (struct bead_run_settings){.end = INFINITY});
    double largest = 0;
    for (double time = 0; isnan(places[0].passed) || isnan(places[1].passed); time += step) {
        run_until(run, time);
        const double *force = sample_at(run, time).field[BEAD_FIELD_CONTACT_FORCE];
        for (size_t k = 0; k < contacts; k++)
            largest = fmax(largest, force[k] - rest[k]);
        for (size_t p = 0; p < (sensor > 0 ? 2 : 1); p++)
            watch(&places[p], force, rest, largest, time, step);
    }
    bead_run_destroy(run);
    return fmax(places[0].passed, places[1].passed);
}

static void pulses_are_over_at_sensors_too(void **state)
{
    (void)state;
    static const struct {
        const char *beads;
        size_t sensor;
    } chains[] = {
        {"{bead: large-steel, count: 9}, {bead: ptfe, sensor: s}, {bead: small-steel, count: 2}", 10},
        {"{cell: [large-steel, ptfe], count: 4}, {bead: large-steel, sensor: s}", 9},
        {"{cell: [large-steel, small-steel], count: 4}, {bead: large-steel, sensor: s}, {bead: small-steel, count: 1}", 9},
        {"{cell: [large-steel, small-steel], count: 3}, {bead: ptfe, sensor: s}, {bead: large-steel, count: 1}", 7},
        {"{cell: [lead, small-steel], count: 3}, {bead: lead, sensor: s}, {bead: large-steel, count: 1}", 7},
        {"{cell: [large-steel, small-steel], count: 5}", 0},
    };
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        char text[400];
        snprintf(text, sizeof text, "chain: {striker: {bead: large-steel, velocity: 1 m/s}, wall: rigid, beads: [%s]}\n",
                 chains[c].beads);
        struct built built = build(text, "accuracy: 1e-8"), rough = build(text, "accuracy: 1e-5");
        struct bead_run *run = start_run(&rough, (struct bead_run_settings){.end = INFINITY, .passage = BEAD_PASSAGE_OF_PULSE});
        while (isnan(bead_run_over(run))) {
            struct bead_message msg = {""};
            if (bead_run_step(run, &msg))
                fail_msg("%s", msg.text);
        }
        assert_near(bead_run_over(run), over_by_steps(&built, chains[c].sensor), 1e-9);
        bead_run_destroy(run);
        release(&built);
        release(&rough);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fronts_arrive_when_the_last_force_rises),
                                       cmocka_unit_test(fronts_cross_gaps), cmocka_unit_test(pulses_are_over_at_a_twentieth),
                                       cmocka_unit_test(pulses_are_over_at_sensors_too)};
    return cmocka_run_group_tests_name("front", tests, NULL, NULL);
}
