/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples between steps are as accurate as the steps, even if contacts open or close within them; and the times of samples with
 * growing spacing. */
#include "support.h"

/* A steel chain that is struck, one of disorder, one that parts from its precompression, and light beads that rattle between heavy
 * ones (whose smooth steps are long for septics at 1e-8); each beside the same chain with steps of 0.02 us, which have a state at
 * every sample. */
static const struct {
    const char *name, *chain;
    double end;   /* s: before chaos has grown */
    double bound; /* of errors at 1e-8, in units of that */
} cases[] = {
    {"struck", P1_CHAIN, 0.4e-3, 1},
    {"random", P3_CHAIN, 0.4e-3, 1},
    {"precompressed",
     "chain: {precompression: 1 N, wall: brass, beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}]}\n", 0.3e-3, 1},
    {"rattling",
     "materials: {m0: {density: 3532.5, modulus: 27.451 GPa, poisson: 0.418, radius: 4.9623 mm},\n"
     "  m1: {density: 4441.5, modulus: 62.772 GPa, poisson: 0.184, radius: 1.3647 mm},\n"
     "  m2: {density: 3112.5, modulus: 1.7884 GPa, poisson: 0.398, radius: 7.3241 mm}}\n"
     "chain: {striker: {bead: m1, velocity: 0.87038 m/s}, wall: rigid, beads: [{cell: [m0, m1, m2], count: 8}]}\n",
     0.3e-3, 2.5},
};
enum { CASES = sizeof cases / sizeof *cases };
static const double asked[] = {1e-4, 1e-6, 1e-8};
enum { ASKED = sizeof asked / sizeof *asked };

static const enum bead_field fields[] = {BEAD_FIELD_DISPLACEMENT, BEAD_FIELD_VELOCITY, BEAD_FIELD_CONTACT_FORCE, BEAD_FIELD_FORCE,
                                         BEAD_FIELD_ENERGY};
enum { FIELDS = sizeof fields / sizeof *fields };

struct errors {
    double most[FIELDS], largest[FIELDS];
};

static void compare(const struct bead_sample *sample, const struct bead_sample *exact, size_t beads, struct errors *e)
{
    for (size_t i = 0; i < FIELDS; i++) {
        const double *a = sample->field[fields[i]], *b = exact->field[fields[i]];
        for (size_t j = 0; j < beads && j < sample->active && j < exact->active; j++) {
            e->most[i] = fmax(e->most[i], fabs(a[j] - b[j]));
            e->largest[i] = fmax(e->largest[i], fabs(b[j]));
        }
    }
}

/* Of all fields, at samples every 0.5 us: nearly all lie between steps. */
static struct errors errors_of(const char *chain, const char *simulate, double end)
{
    struct errors e = {{0}, {0}};
    struct built built = build(chain, simulate), fine = build(chain, "method: rkn8, step: 0.02 us");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end}),
                    *exact = start_run(&fine, (struct bead_run_settings){.end = end});
    for (int i = 1; i * 0.5e-6 < end; i++) {
        const double time = i * 0.5e-6;
        run_until(run, time);
        run_until(exact, time);
        struct bead_sample a = sample_at(run, time), b = sample_at(exact, time);
        compare(&a, &b, built.chain->beads, &e);
    }
    bead_run_destroy(run);
    bead_run_destroy(exact);
    release(&built);
    release(&fine);
    return e;
}

static void samples_are_as_asked(void **state)
{
    (void)state;
    for (size_t c = 0; c < CASES; c++) {
        for (size_t i = 0; i < ASKED; i++) {
            char simulate[64];
            snprintf(simulate, sizeof simulate, "accuracy: %g", asked[i]);
            struct errors e = errors_of(cases[c].chain, simulate, cases[c].end);
            for (size_t f = 0; f < FIELDS; f++) {
                const double error = e.most[f] / (e.largest[f] * asked[i]);
                if (!(error < (asked[i] > 1e-7 ? 1 : cases[c].bound)))
                    fail_msg("%s, asked %g: %s is off by %.3g times that", cases[c].name, asked[i],
                             bead_field_info(fields[f])->name, error);
            }
        }
    }
}

/* The largest error of a velocity in the first step, of length h, in which the striker's contact closes. */
static double first_step_error(const char *law, double h)
{
    enum { PARTS = 16 };
    char chain[256], simulate[2][64];
    snprintf(chain, sizeof chain, "chain: {%sbeads: [{bead: large-steel, count: 6}]}\n", law);
    snprintf(simulate[0], sizeof *simulate, "method: rkn8, step: %.9g", h);
    snprintf(simulate[1], sizeof *simulate, "method: rkn8, step: %.9g", h / (4 * PARTS));
    struct built built = build(chain, simulate[0]), fine = build(chain, simulate[1]);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 4 * h}),
                    *exact = start_run(&fine, (struct bead_run_settings){.end = 4 * h});
    double most = 0;
    run_until(run, h);
    for (int i = 1; i < PARTS; i++) {
        run_until(exact, i * (h / PARTS));
        struct bead_sample a = sample_at(run, i * (h / PARTS)), b = sample_at(exact, i * (h / PARTS));
        for (size_t j = 0; j < 3; j++)
            most = fmax(most, fabs(a.field[BEAD_FIELD_VELOCITY][j] - b.field[BEAD_FIELD_VELOCITY][j]));
    }
    bead_run_destroy(run);
    bead_run_destroy(exact);
    release(&built);
    release(&fine);
    return most;
}

/* With polynomials alone it would be the power p + 1 of the step. The error after the first rounds of correction has more than
 * twice that power, except for small terms of the power 2 (p + 1). */
static void they_converge_where_a_contact_closes(void **state)
{
    (void)state;
    static const char *const laws[] = {"", "law: {power: 1.4, coefficient: 3e9}, ", "law: {power: 1, coefficient: 1e7}, "};
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        const double order = log2(first_step_error(laws[i], 4e-6) / first_step_error(laws[i], 2e-6));
        if (!(order > 4.5))
            fail_msg("%sorder %.2f", laws[i], order);
    }
}

/* As close as asked at first; from 32 spacings on the next is never further than 1/32 of the way, nor closer than 1/64; all but the
 * last, which is the end, are multiples of the spacing; and nothing is left out of a short grid. */
static void grids_widen_as_powers_of_time_do(void **state)
{
    (void)state;
    static const double ends[] = {0, 0.125, 40, 63, 64, 65, 66, 4000, 1e9 + 0.5};
    for (size_t e = 0; e < sizeof ends / sizeof *ends; e++) {
        const struct bead_grid grid = {.start = 0.25, .every = 0.5, .end = 0.25 + 0.5 * ends[e], .widens = 1};
        const size_t count = bead_grid_count(&grid);
        double before = -1;
        for (size_t i = 0; i < count; i++) {
            const double place = (bead_grid_time(&grid, i) - 0.25) / 0.5;
            assert_true(place > before && place <= ends[e]);
            assert_true(i + 1 == count || place == floor(place));
            assert_true(place - before <= fmax(1, place / 32));
            assert_true(i + 1 == count || place - before >= fmax(1, place / 64));
            before = place;
        }
        assert_true(before == ends[e] && count <= 66 + 32 * fmax(0, log2(fmax(1, ends[e]) / 64)));
        assert_true(bead_grid_time(&grid, count) == grid.end);
    }
}

/* A run of 50 beads until `end`, and its state at `time` in the last step. */
static struct bead_outcome outcome_at(const struct built *built, double end, double time, double state[2][51])
{
    struct bead_outcome outcome;
    struct bead_run *run = start_run(built, (struct bead_run_settings){.end = 1e-3, .states = true});
    run_until(run, end);
    const struct bead_sample sample = sample_at(run, time);
    memcpy(state[0], sample.field[BEAD_FIELD_DISPLACEMENT], sizeof state[0]);
    memcpy(state[1], sample.field[BEAD_FIELD_VELOCITY], sizeof state[1]);
    bead_run_finish(run, time, &outcome);
    assert_true(outcome.final.time == time);
    assert_memory_equal(outcome.final.displacement, state[0], sizeof state[0]);
    assert_memory_equal(outcome.final.velocity, state[1], sizeof state[1]);
    bead_run_destroy(run);
    return outcome;
}

/* States that an outcome has are the samples of their times. */
static void outcomes_have_the_states_of_their_times(void **state)
{
    (void)state;
    struct built built = build(P1_CHAIN, "until: 1 ms");
    double found[2][51], speed = 0;
    const double arrival = outcome_at(&built, 0.9e-3, 0.9e-3, found).front_arrival;
    assert_true(arrival > 0.1e-3 && arrival < 0.9e-3);
    struct bead_outcome outcome;
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1e-3, .states = true});
    run_until(run, arrival);
    const struct bead_sample sample = sample_at(run, arrival);
    bead_run_finish(run, arrival, &outcome);
    assert_true(outcome.arrived.time == arrival);
    for (int j = 0; j < 51; j++)
        speed = fmax(speed, fabs(sample.field[BEAD_FIELD_VELOCITY][j]));
    assert_true(speed > 0.1);
    assert_memory_equal(outcome.arrived.displacement, sample.field[BEAD_FIELD_DISPLACEMENT], sizeof found[0]);
    assert_memory_equal(outcome.arrived.velocity, sample.field[BEAD_FIELD_VELOCITY], sizeof found[1]);
    bead_run_destroy(run);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_as_asked),
        cmocka_unit_test(they_converge_where_a_contact_closes),
        cmocka_unit_test(grids_widen_as_powers_of_time_do),
        cmocka_unit_test(outcomes_have_the_states_of_their_times),
    };
    return cmocka_run_group_tests_name("samples", tests, NULL, NULL);
}
