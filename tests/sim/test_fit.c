/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits of synthetic experiments: the values put in are found, with errors as large as the standard errors say. */
#include "support.h"

#include "scratch.h"

#include "beadreel/trajectory.h"
#include "sessions.h"
#include "sim/base/random.h"
#include "sim/session/session_data.h"

enum { EXPERIMENTS = 50, KEYS = 3, POINTS = 110, MEASURED = 16384 };
static const double truth[KEYS] = {0.443, 12, 0.7}; /* m/s, ..., N */

/* Gaussian: Box and Muller. */
static double chance(uint64_t seed, uint64_t index)
{
    const double u = ((double)bead_draw(seed, 0, index) + 0.5) * 0x1p-64, v = (double)bead_draw(seed, 1, index) * 0x1p-64;
    return sqrt(-2 * log(u)) * cos(2 * 3.14159265358979323846 * v);
}

/* The force on a bead of the true chain, at times that are not samples of the fit, with noise. */
static void measure(uint64_t seed, double noise, char *text)
{
    struct built b = build("chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 6}],\n"
                           " damping: {coefficient: 12}}\n",
                           "until: 0.2 ms");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){0});
    size_t used = 0;
    for (size_t i = 0; i < POINTS; i++) {
        const double t = 1.37e-6 * (double)i;
        run_until(run, t);
        const double force = sample_at(run, t).field[BEAD_FIELD_FORCE][4];
        used += (size_t)snprintf(text + used, MEASURED - used, "%s%.17g %.17g", i ? ", " : "", t,
                                 force - truth[2] + noise * chance(seed, i));
    }
    bead_run_destroy(run);
    release(&b);
}

/* Fits from other values, and gives back those found, with their errors. */
static struct bead_fit_key *fit(const char *measured, struct bead_session **session)
{
    static char text[MEASURED + 1024];
    char path[512];
    struct bead_message msg = {""};
    snprintf(text, sizeof text,
             "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 6}],\n"
             " damping: {coefficient: 8}}\nsimulate: {until: 0.2 ms}\n"
             "outputs: [{plot: p.png, beads: 4, measured: {points: '%s', offset: 0 N}}, {table: fit.csv, show: fit}]\n"
             "fit: [chain.striker.velocity, chain.damping.coefficient, outputs.0.measured.offset]\n",
             measured);
    snprintf(path, sizeof path, "%s/fit.yaml", directory);
    write_text(path, text);
    if (bead_session_open(&(struct bead_job){.size = sizeof(struct bead_job), .input = path, .output = directory}, session, &msg))
        fail_msg("%s", msg.text);
    return (*session)->scene->fit.keys;
}

/* Without noise, only the errors of the runs remain. */
static void the_truth_is_found(void **state)
{
    (void)state;
    static char measured[MEASURED];
    struct bead_session *session;
    measure(0, 0, measured);
    const struct bead_fit_key *keys = fit(measured, &session);
    for (size_t k = 0; k < KEYS; k++)
        assert_near(keys[k].value, truth[k], 1e-4 * truth[k]);
    bead_session_close(session);
}

/* With Gaussian noise, 95.4 % lie within two standard errors: of 150, 143 with a standard deviation of 2.6. */
static void standard_errors_hold(void **state)
{
    (void)state;
    static char measured[MEASURED];
    size_t within = 0;
    for (uint64_t e = 1; e <= EXPERIMENTS; e++) {
        struct bead_session *session;
        measure(e, 0.5, measured);
        const struct bead_fit_key *keys = fit(measured, &session);
        for (size_t k = 0; k < KEYS; k++)
            within += fabs(keys[k].value - truth[k]) < 2 * keys[k].error;
        assert_near(session->scene->fit.rms, 0.5, 0.15); /* by four of its standard deviations */
        bead_session_close(session);
    }
    print_message("%zu of %d within two standard errors\n", within, EXPERIMENTS * KEYS);
    assert_true(within >= 0.9 * EXPERIMENTS * KEYS && within <= 0.99 * EXPERIMENTS * KEYS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_truth_is_found), cmocka_unit_test(standard_errors_hold)};
    return cmocka_run_group_tests_name("fits", tests, make_directory, remove_directory);
}
