/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Accuracy against references good to 14 digits, and the order of every method on a smooth problem. */
#include "support.h"

static double peaks_of(const char *chain, const char *simulate, double end, const char *reference)
{
    struct built built = build(chain, simulate);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end, .contact_peaks = true});
    run_until(run, end);
    struct bead_outcome outcome;
    bead_run_finish(run, end, &outcome);
    struct table table = read_table(reference, 3);
    double error = peak_error(outcome.contact_peaks, &table);
    size_t open = 0;
    for (size_t k = 0; k < table.rows; k++)
        open += outcome.contact_peaks[k].open;
    assert_true(open <= 1); /* contact 109 of P3, of those in the tables */
    free(table.value);
    bead_run_destroy(run);
    release(&built);
    return error;
}

static void peaks_agree_with_references(void **state)
{
    (void)state;
    assert_below(peaks_of(P1_CHAIN, "until: 0.8 ms, method: rkn8, step: 0.1 us", 0.8e-3, "p1_peaks.csv"), 1e-6);
    assert_below(peaks_of(P2_CHAIN, "until: 1.5 ms, method: rkn8, step: 0.1 us", 1.5e-3, "p2_peaks.csv"), 1e-6);
    assert_below(peaks_of(P3_CHAIN, "until: 3 ms, method: rkn8, step: 0.1 us", 3e-3, "p3_peaks.csv"), 1e-6);
}

/* The thesis's method at the thesis's step: peaks to about 1e-7, no better. */
static void rk4_shows_its_known_error(void **state)
{
    (void)state;
    double error = peaks_of(P3_CHAIN, "until: 3 ms, method: rk4, step: 0.1 us", 3e-3, "p3_peaks.csv");
    assert_below(error, 1.2e-7);
    assert_true(error > 5e-8);
}

/* Displacements of P4 at `end`, which no sample time forces a step to. */
static void solve_p4(const char *method, double step, double end, double *u, size_t beads)
{
    char simulate[128];
    snprintf(simulate, sizeof simulate, "until: %.17g, method: %s, step: %.17g", end, method, step);
    struct built built = build(P4_CHAIN, simulate);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end});
    run_until(run, end);
    assert_int_equal(built.chain->beads, beads);
    struct bead_sample sample = sample_at(run, end);
    memcpy(u, sample.field[BEAD_FIELD_DISPLACEMENT], beads * sizeof *u);
    bead_run_destroy(run);
    release(&built);
}

static double distance(const double *a, const double *b, size_t n)
{
    double worst = 0, scale = 0;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        scale = fmax(scale, fabs(b[i]));
    }
    return worst / scale;
}

static void orders_are_those_of_the_tables(void **state)
{
    (void)state;
    enum { BEADS = 129 };
    static const struct {
        const char *method;
        double step, order;
    } cases[] = {{"rk4", 2e-6, 4},  {"verlet", 0.5e-6, 2}, {"pefrl", 2e-6, 4}, {"vefrl", 2e-6, 4},
                 {"rkn6", 5e-6, 6}, {"rkn8", 8e-6, 8},     {"rk8", 8e-6, 8}};
    const double end = 0.4e-3;
    double exact[BEADS], coarse[BEADS], fine[BEADS];
    solve_p4("rkn12", 1e-6, end, exact, BEADS);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        solve_p4(cases[i].method, cases[i].step, end, coarse, BEADS);
        solve_p4(cases[i].method, cases[i].step / 2, end, fine, BEADS);
        double order = log2(distance(coarse, exact, BEADS) / distance(fine, exact, BEADS));
        print_message("%s: order %.2f, error %.1e\n", cases[i].method, order, distance(fine, exact, BEADS));
        assert_near(order, cases[i].order, 0.5);
    }
}

/* With a requested accuracy, peaks are within it, and the steps are not much shorter than necessary: at most 100 times better,
 * unless the step is the longest allowed. */
static void accuracy_is_what_was_asked(void **state)
{
    (void)state;
    static const double asked[] = {1e-3, 1e-4, 1e-6, 1e-8, 1e-10};
    static const struct {
        const char *chain, *reference;
        double end;
    } cases[] = {{P1_CHAIN, "p1_peaks.csv", 0.8e-3}, {P2_CHAIN, "p2_peaks.csv", 1.5e-3}, {P3_CHAIN, "p3_peaks.csv", 3e-3}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        for (size_t a = 0; a < sizeof asked / sizeof *asked; a++) {
            char simulate[64];
            snprintf(simulate, sizeof simulate, "until: %g, accuracy: %g", cases[c].end, asked[a]);
            double error = peaks_of(cases[c].chain, simulate, cases[c].end, cases[c].reference);
            assert_below(error, asked[a]);
            if (asked[a] < 1e-4) /* there the step is at its cap */
                assert_true(error > asked[a] / 100);
        }
    }
}

/* Where the energy cannot open any contact, auto leaves the correction out. */
static void smooth_chains_are_as_asked(void **state)
{
    (void)state;
    static const double asked[] = {1e-6, 1e-8, 1e-10};
    for (size_t a = 0; a < sizeof asked / sizeof *asked; a++) {
        char simulate[64];
        struct bead_stepping stepping;
        struct bead_message msg = {""};
        snprintf(simulate, sizeof simulate, "until: 3 ms, accuracy: %g", asked[a]);
        struct built built = build(P4_CHAIN, simulate);
        assert_int_equal(bead_run_stepping(built.chain, &built.scene->simulate, 1, &stepping, &msg), BEAD_OK);
        assert_string_equal(stepping.method->info.name, "rkn8-plain");
        release(&built);
        double error = peaks_of(P4_CHAIN, simulate, 3e-3, "p4_peaks.csv");
        assert_below(error, asked[a]);
    }
}

/* Peaks that had come are within `accuracy` of the exact ones; 0: these are the exact ones. */
static void compare_peaks(size_t contacts, const struct bead_peak *peaks, double accuracy, struct bead_peak *exact)
{
    for (size_t k = 0; k < contacts; k++) {
        if (accuracy == 0)
            exact[k] = peaks[k];
        else if (!exact[k].open)
            assert_below(fabs(peaks[k].value / exact[k].value - 1), accuracy);
    }
}

/* The same for chains without references, against another run with a step 20 times shorter than the default. */
static void accuracy_holds_for_other_chains(void **state)
{
    (void)state;
    static const double asked[] = {1e-3, 1e-4, 1e-6, 1e-8, 1e-10};
    static const struct {
        const char *chain, *step;
    } cases[] = {
        {"chain: {beads: [{cell: [large-steel, ptfe], count: 20}]}\n", "0.2 us"},
        {"chain: {beads: [{cell: [large-steel, ptfe], spins: \"11000011101100110001\"}]}\n", "0.2 us"},
        {"chain: {beads: [{cell: [large-steel, aluminium, small-steel], count: 20}], wall: brass}\n", "0.1 us"},
        {"chain: {beads: [{cell: [large-steel, aluminium], spins: \"10101101001111111111\"}, {bead: large-steel, count: 30}]}\n",
         "0.1 us"},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct bead_peak exact[256] = {{.value = 0}};
        char simulate[64];
        snprintf(simulate, sizeof simulate, "method: rkn8, step: %s", cases[c].step);
        for (size_t a = 0; a <= sizeof asked / sizeof *asked; a++) {
            if (a > 0)
                snprintf(simulate, sizeof simulate, "accuracy: %g", asked[a - 1]);
            struct built built = build(cases[c].chain, simulate);
            struct bead_run *run =
                start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = true, .contact_peaks = true});
            while (isnan(bead_run_arrival(run)))
                run_until(run, bead_run_time(run) + 1e-9);
            struct bead_outcome outcome;
            bead_run_finish(run, bead_run_arrival(run), &outcome);
            compare_peaks(built.chain->contacts, outcome.contact_peaks, a == 0 ? 0 : asked[a - 1], exact);
            bead_run_destroy(run);
            release(&built);
        }
    }
}

/* With damping the force jumps when contacts close; steps end there, so the accuracy asked holds too. */
static void accuracy_holds_with_damping(void **state)
{
    (void)state;
    static const double asked[] = {1e-4, 1e-6, 1e-7};
    static const char *const damping[] = {"{coefficient: 100, exponent: 1}", "{coefficient: 1, exponent: 1}",
                                          "{coefficient: 20, exponent: 1.8}"};
    for (size_t c = 0; c < sizeof damping / sizeof *damping; c++) {
        char chain[512], simulate[64];
        struct bead_peak exact[64] = {{.value = 0}};
        snprintf(chain, sizeof chain,
                 "chain: {beads: [{cell: [large-steel, aluminium], spins: \"110100111010\"}], wall: brass, damping: %s}\n",
                 damping[c]);
        snprintf(simulate, sizeof simulate, "until: 0.6 ms, method: rk4, step: 20 ns");
        for (size_t a = 0; a <= sizeof asked / sizeof *asked; a++) {
            if (a > 0)
                snprintf(simulate, sizeof simulate, "until: 0.6 ms, accuracy: %g", asked[a - 1]);
            struct built built = build(chain, simulate);
            struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.6e-3, .contact_peaks = true});
            run_until(run, 0.6e-3);
            struct bead_outcome outcome;
            bead_run_finish(run, 0.6e-3, &outcome);
            compare_peaks(built.chain->contacts, outcome.contact_peaks, a == 0 ? 0 : asked[a - 1], exact);
            bead_run_destroy(run);
            release(&built);
        }
    }
}

/* Bead force maxima of sensors, first passage (68 beads, small steel sensors at beads 39 and 48). */
static void sensors_of_the_experiment(void **state)
{
    (void)state;
    static const struct {
        const char *spins;
        double f1, t1, f2, t2;
    } cases[] = {{"111111111111111111", 34.504943, 732.687e-6, 33.427628, 894.168e-6},
                 {"111111111110111111", 29.725809, 734.082e-6, 29.274391, 898.910e-6},
                 {"111110111011011100", 24.453513, 749.709e-6, 23.736214, 911.775e-6},
                 {"011110001000110001", 20.860941, 746.862e-6, 19.284343, 925.099e-6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char chain[1024];
        snprintf(chain, sizeof chain,
                 "chain:\n  wall: brass\n  beads:\n    - {cell: [large-steel, aluminium]}\n"
                 "    - {cell: [large-steel, aluminium], spins: \"%s\"}\n    - {bead: small-steel, sensor: first}\n"
                 "    - {cell: [large-steel, aluminium], count: 4}\n    - {bead: small-steel, sensor: second}\n"
                 "    - {cell: [large-steel, aluminium], count: 10}\n",
                 cases[i].spins);
        struct built built = build(chain, "accuracy: 1e-8");
        assert_int_equal(built.chain->sensors[0].bead, 39);
        assert_int_equal(built.chain->sensors[1].bead, 48);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = true, .bead_peaks = true});
        while (isnan(bead_run_arrival(run)))
            run_until(run, bead_run_time(run) + 1e-9);
        struct bead_outcome outcome;
        bead_run_finish(run, bead_run_arrival(run), &outcome);
        const struct bead_peak *peak = outcome.bead_peaks;
        assert_near(peak[39].value, cases[i].f1, 1e-6 * cases[i].f1);
        assert_near(peak[48].value, cases[i].f2, 1e-6 * cases[i].f2);
        assert_near(peak[39].time, cases[i].t1, 1e-9);
        assert_near(peak[48].time, cases[i].t2, 1e-9);
        bead_run_destroy(run);
        release(&built);
    }
}

/* One row: N_total dimers as `bits`, 15 more up, free end; largest bead force of beads 2N+3..2N+5. */
static double largest_behind(const char *bits)
{
    size_t n = strlen(bits);
    char chain[1024];
    snprintf(chain, sizeof chain,
             "chain:\n  beads:\n    - {cell: [large-steel, aluminium], spins: \"%s\"}\n"
             "    - {cell: [large-steel, aluminium], count: 15}\n",
             bits);
    struct built built = build(chain, "accuracy: 1e-8");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = true, .bead_peaks = true});
    while (isnan(bead_run_arrival(run)))
        run_until(run, bead_run_time(run) + 1e-9);
    struct bead_outcome outcome;
    bead_run_finish(run, bead_run_arrival(run), &outcome);
    double most = 0;
    for (size_t j = 2 * n + 3; j <= 2 * n + 5; j++)
        most = fmax(most, outcome.bead_peaks[j].value);
    bead_run_destroy(run);
    release(&built);
    return most;
}

static void disordered_chains_agree(void **state)
{
    (void)state;
    FILE *file = fopen("tests/reference/fig7_cases.csv", "r");
    char line[2048], bits[512];
    double force;
    size_t rows = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%*d,%*f,%511[01],%lf", bits, &force) != 2)
            continue;
        double got = largest_behind(bits);
        if (!(fabs(got / force - 1) < 1e-5))
            fail_msg("%zu dimers: %.9g N, not %.9g N", strlen(bits), got, force);
        rows++;
    }
    fclose(file);
    assert_int_equal(rows, 27);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accuracy_is_what_was_asked),      cmocka_unit_test(smooth_chains_are_as_asked),
        cmocka_unit_test(accuracy_holds_for_other_chains), cmocka_unit_test(accuracy_holds_with_damping),
        cmocka_unit_test(peaks_agree_with_references),     cmocka_unit_test(rk4_shows_its_known_error),
        cmocka_unit_test(orders_are_those_of_the_tables),  cmocka_unit_test(sensors_of_the_experiment),
        cmocka_unit_test(disordered_chains_agree),
    };
    return cmocka_run_group_tests_name("accuracy", tests, NULL, NULL);
}
