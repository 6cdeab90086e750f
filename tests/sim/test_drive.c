/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Driven beads: a force, or a displacement, as a function of time. */
#include "sim/chain/drive.h"
#include "support.h"

#define MATERIAL "materials: {unit: {mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}}\n"
#define UNIT     "law: {power: 1.5, coefficient: 1e9}, "
static const double mass = 1e-3, pi = 3.14159265358979323846;

/* Each derivative is that of the one before, by a difference of fourth order: for all waves, in the ramp and behind it. */
static void derivatives_belong_to_the_wave(void **state)
{
    (void)state;
    static const char *const waves[] = {"force: sine, frequency: 5 kHz", "displacement: chirp, frequency: 2 kHz, to: 9 kHz",
                                        "force: noise, frequency: 4 kHz, seed: 3",
                                        "displacement: '0 0, 2e-4 1, 9e-4 -0.5, 1.2e-3 0.25, 3e-3 1'"};
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        char text[300];
        snprintf(text, sizeof text, MATERIAL "chain: {" UNIT "beads: [{bead: unit}], drive: {%s, amplitude: 2, ramp: 1 ms}}\n",
                 waves[i]);
        struct built b = build(text, "until: 4 ms");
        for (double t = 0.11e-3; t < 2e-3; t += 0.31e-3) {
            const double h = 1e-7;
            struct bead_wave_at at[5], middle = bead_drive_at(b.chain, t);
            for (int k = 0; k < 5; k++)
                at[k] = bead_drive_at(b.chain, t + (k - 2) * h);
            for (int d = 0; d < 3; d++) {
                const double slope = (8 * (at[3].x[d] - at[1].x[d]) - (at[4].x[d] - at[0].x[d])) / (12 * h);
                assert_near(slope, middle.x[d + 1], 1e-6 * 2 * pow(2 * pi * 9e3, d + 1));
            }
        }
        release(&b);
    }
}

/* A wave breaks where its ramp ends, at each knot of noise, two of which are in a period, and at each point. */
static void waves_break_where_they_are_put_together(void **)
{
    static const struct {
        const char *wave;
        double every, points[3];
    } waves[] = {{"force: sine, frequency: 5 kHz", INFINITY, {0}},
                 {"force: noise, frequency: 4 kHz, seed: 3", 1.25e-4, {0}},
                 {"displacement: noise, frequency: 0.7 kHz", 1 / 1.4e3, {0}},
                 {"displacement: '0 0, 2e-4 1, 9e-4 -0.5, 3e-3 1'", INFINITY, {2e-4, 9e-4, 3e-3}}};
    const double ramp = 1e-3, end = 4e-3;
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        char text[300];
        snprintf(text, sizeof text, MATERIAL "chain: {" UNIT "beads: [{bead: unit}], drive: {%s, amplitude: 2, ramp: 1 ms}}\n",
                 waves[i].wave);
        struct built b = build(text, "until: 4 ms");
        for (double t = 0.1234e-4; t < end; t += 0.3137e-4) {
            double next = ramp > t ? ramp : INFINITY;
            for (double knot = waves[i].every; knot < 2 * end && isfinite(knot); knot += waves[i].every)
                next = knot > t ? fmin(next, knot) : next;
            for (int k = 0; k < 3; k++)
                next = waves[i].points[k] > t ? fmin(next, waves[i].points[k]) : next;
            const double found = bead_drive_break(b.chain, t);
            if (!(found == next || fabs(found - next) < 1e-12))
                fail_msg("%s: behind %g s the next break is at %.17g s, not %.17g s", waves[i].wave, t, found, next);
        }
        release(&b);
    }
}

/* Noise has the requested standard deviation, and no mean. */
static void noise_has_its_amplitude(void **state)
{
    (void)state;
    struct built b =
        build(MATERIAL "chain: {" UNIT "beads: [{bead: unit}], drive: {force: noise, amplitude: 3 N, frequency: 1 kHz, seed: 5}}\n",
              "until: 1 s");
    double sum = 0, squares = 0;
    const int count = 40000;
    for (int i = 0; i < count; i++) {
        const double f = bead_drive_at(b.chain, i * 1e-4 + 1e-5).x[0];
        sum += f;
        squares += f * f;
    }
    /* 8000 independent coefficients */
    assert_near(sum / count, 0, 4 * 3 / sqrt(8000));
    assert_near(sqrt(squares / count), 3, 4 * 3 / sqrt(8000));
    release(&b);
}

/* A force on a free bead, and on one that a spring holds: F/(m w^2) (wt - sin wt), and F/m (sin wt - w/w0 sin w0 t)/(w0^2 - w^2).
 */
static void lone_beads_follow_a_force(void **state)
{
    (void)state;
    const double f = 1e-3, w = 2 * pi * 100, end = 0.0137, stiffness = 1000, w0 = sqrt(stiffness / mass);
    for (int held = 0; held < 2; held++) {
        char text[400];
        snprintf(text, sizeof text,
                 MATERIAL "chain: {" UNIT
                          "gap: 1 m, beads: [{bead: unit}, {bead: unit, spring: %d N/m}], drive: {bead: 2, force: sine, "
                          "amplitude: 1 mN, frequency: 100 Hz}}\n",
                 held ? 1000 : 0);
        struct built b = build(text, "until: 0.1 s, accuracy: 1e-8");
        struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = end});
        run_until(run, end);
        const double wanted = held ? f / mass * (sin(w * end) - w / w0 * sin(w0 * end)) / (w0 * w0 - w * w)
                                   : f / (mass * w * w) * (w * end - sin(w * end));
        assert_near(sample_at(run, end).field[BEAD_FIELD_DISPLACEMENT][2] / wanted, 1, 1e-8);
        assert_true(sample_at(run, end).field[BEAD_FIELD_VELOCITY][1] == 0);
        bead_run_destroy(run);
        release(&b);
    }
}

/* A string of springs k between masses m, of which the first moves as a sin wt: below the band's edge 2 sqrt(k/m) the front follows
 * at the group velocity; above it the steady state decays by the same factor from bead to bead and changes sign, exactly
 * (w/w_edge)^2 = cosh^2(q/2). */
static void beyond_the_band_waves_decay(void **state)
{
    (void)state;
    struct built b =
        build(MATERIAL "chain: {law: {fpu-alpha: 0, stiffness: 1e6 N/m}, beads: [{bead: unit, count: 20}], drive: {displacement: "
                       "sine, amplitude: 1 um, frequency: 12 kHz, ramp: 20 ms}}\n",
              "until: 30 ms, accuracy: 1e-8");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 30e-3});
    const double w = 2 * pi * 12e3, edge = 2 * sqrt(1e6 / mass), factor = exp(-2 * acosh(w / edge));
    const double quarter = (floor(25e-3 * 12e3) + 0.25) / 12e3; /* the drive is at its largest */
    run_until(run, quarter);
    const double *u = sample_at(run, quarter).field[BEAD_FIELD_DISPLACEMENT];
    assert_near(u[0], 1e-6, 1e-8 * 1e-6);
    for (int j = 1; j < 5; j++)
        assert_near(u[j] / u[j - 1], -factor, 1e-4 * factor);
    bead_run_destroy(run);
    release(&b);
}

/* Without precompression contacts open and close all the time; what the drive puts in is the energy of the chain, at each of many
 * times within steps and to the accuracy of tables: for given displacements and forces, at free and fixed ends, at an end and
 * within, slow, fast and weak ones, with ramps of one step or none, also against the bead's own spring. With damping, to what its
 * fixed order gives. The velocity of a bead under a force, interpolated without the corner where a contact opens, left it off by
 * 2e-7; a drive that patches took as a cubic, by 1e-9; steps longer than a ramp, by 9e-8. */
static void work_is_the_energy(void **state)
{
    (void)state;
    enum { TIMES = 600 };
    static const double end = 1.5e-3;
    static const char *const beads[] = {
        "{bead: large-steel, count: 19}", "{cell: [large-steel, aluminium], count: 10, spins: random}",
        "{bead: glass, count: 19, disorder: {radius: normal 5 %, seed: 2}}", "{bead: large-steel, count: 19, spring: 1e6 N/m}"};
    static const struct {
        int beads;
        const char *drive, *more;
        double bound;
    } cases[] = {
        {0, "displacement: sine, amplitude: 2 um, frequency: 3 kHz, ramp: 0.2 ms", "wall: rigid", 1e-9},
        {0, "displacement: sine, amplitude: 20 um, frequency: 1 kHz", "wall: rigid", 1e-9},
        {0, "displacement: sine, amplitude: 1 um, frequency: 9 kHz", "wall: none", 1e-9},
        {1, "bead: 11, displacement: sine, amplitude: 8.2 um, frequency: 8.4 kHz, ramp: 1.18 us", "wall: none", 1e-9},
        {0, "bead: 12, displacement: sine, amplitude: 2 um, frequency: 3 kHz, ramp: 0.2 ms", "wall: none", 1e-9},
        {3, "bead: 7, displacement: sine, amplitude: 2 um, frequency: 3 kHz", "wall: none", 1e-9},
        {0, "displacement: chirp, amplitude: 1 um, frequency: 1 kHz, to: 9 kHz", "wall: none", 1e-9},
        {2, "bead: 7, displacement: chirp, amplitude: 2 um, frequency: 3 kHz, to: 8 kHz", "wall: rigid", 1e-9},
        {0, "displacement: noise, amplitude: 2 um, frequency: 3 kHz", "wall: rigid", 1e-9},
        {2, "displacement: noise, amplitude: 0.9 um, frequency: 1.3 kHz, seed: 286, ramp: 3.2 us", "wall: none", 1e-9},
        {0, "displacement: '0 0, 1e-4 1, 3e-4 -2, 6e-4 1, 1.1e-3 0.5', amplitude: 2 um", "wall: rigid", 1e-9},
        {0, "force: sine, amplitude: 20 N, frequency: 3 kHz, ramp: 0.2 ms", "wall: rigid", 1e-9},
        {0, "force: sine, amplitude: 20 N, frequency: 3 kHz", "wall: rigid, precompression: 30 N", 1e-9},
        {0, "force: sine, amplitude: 2 N, frequency: 8 kHz", "wall: none", 1e-9},
        {0, "force: sine, amplitude: 0.01 N, frequency: 60 kHz", "wall: rigid", 1e-9},
        {2, "bead: 10, force: sine, amplitude: 0.33 N, frequency: 7.1 kHz, ramp: 3.2 us", "wall: none", 1e-9},
        {1, "bead: 9, force: chirp, amplitude: 10 N, frequency: 1 kHz, to: 4 kHz", "wall: rigid", 1e-9},
        {0, "bead: 3, force: noise, amplitude: 20 N, frequency: 3 kHz", "wall: rigid", 1e-9},
        {0, "force: '0 0, 1e-4 20, 3e-4 -5, 1.1e-3 0', amplitude: 1 N", "wall: none", 1e-9},
        {0, "displacement: sine, amplitude: 2 um, frequency: 3 kHz, ramp: 0.2 ms",
         "wall: rigid, damping: {coefficient: 5, exponent: 1}", 1e-7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[500];
        snprintf(text, sizeof text, "chain: {beads: [%s], drive: {%s}, %s}\n", beads[cases[i].beads], cases[i].drive,
                 cases[i].more);
        struct built b = build(text, cases[i].bound > 1e-9 ? "until: 1.5 ms, accuracy: 1e-10" : "until: 1.5 ms, accuracy: 1e-11");
        struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = end, .budget = true});
        run_until(run, 0);
        double first = 0, most = 0, off = 0;
        for (int n = 0; n <= TIMES; n++) {
            const double t = end * n / TIMES;
            run_until(run, t);
            const struct bead_budget *p = sample_at(run, t).budget;
            const double total = p->kinetic + p->contacts + p->wall + p->gravity + p->springs + p->dissipated - p->work;
            first = n == 0 ? total : first;
            most = fmax(most, fabs(p->work));
            off = fmax(off, fabs(total - first));
        }
        assert_true(most > 0);
        assert_below(off / most, cases[i].bound);
        bead_run_destroy(run);
        release(&b);
    }
}

/* Velocities at many times against the method of Runge and Kutta, which knows no events, at 1e-11. Steps that grew while contacts
 * were soft had errors up to 50 times the accuracy requested. */
static void drives_keep_the_accuracy(void **state)
{
    (void)state;
    enum { BEADS = 12, TIMES = 150 };
    static const double end = 0.6e-3, accuracy[] = {1e-11, 1e-6, 1e-8};
    static const char *const drives[] = {"force: sine, amplitude: 5 N, frequency: 4 kHz",
                                         "force: chirp, amplitude: 5 N, frequency: 1 kHz, to: 8 kHz",
                                         "displacement: sine, amplitude: 1 um, frequency: 4 kHz"};
    for (size_t i = 0; i < sizeof drives / sizeof *drives; i++) {
        double velocity[3][TIMES][BEADS], most = 0;
        for (int k = 0; k < 3; k++) {
            char text[300], simulate[100];
            snprintf(text, sizeof text, "chain: {beads: [{bead: brass, count: %d}], wall: rigid, drive: {%s, ramp: 0.2 ms}}\n",
                     BEADS, drives[i]);
            snprintf(simulate, sizeof simulate, "until: 0.6 ms, accuracy: %g%s", accuracy[k], k == 0 ? ", method: rk4" : "");
            struct built b = build(text, simulate);
            struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = end});
            double off = 0;
            for (int n = 0; n < TIMES; n++) {
                const double t = end * (n + 1) / TIMES;
                run_until(run, t);
                const double *v = sample_at(run, t).field[BEAD_FIELD_VELOCITY];
                for (int j = 0; j < BEADS; j++) {
                    velocity[k][n][j] = v[j];
                    most = k == 0 ? fmax(most, fabs(v[j])) : most;
                    off = fmax(off, fabs(v[j] - velocity[0][n][j]));
                }
            }
            assert_true(most > 1e-3);
            if (k > 0)
                assert_below(off / most, accuracy[k]);
            bead_run_destroy(run);
            release(&b);
        }
    }
}

/* A lone bead under a force of straight lines: cubic parabolas between the kinks, and uniform motion after the last. */
static void kinks_are_exact(void **state)
{
    (void)state;
    static const double time[] = {0, 1.1e-3, 1.7e-3, 4e-3}, force[] = {0, 2e-3, -3e-3, 0};
    struct built b =
        build(MATERIAL "chain: {" UNIT "gap: 1 m, beads: [{bead: unit}, {bead: unit}], drive: {bead: 2, amplitude: 1 mN, "
                       "force: '0 0, 1.1e-3 2, 1.7e-3 -3, 4e-3 0'}}\n",
              "until: 6 ms, accuracy: 1e-8");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 6e-3});
    double x = 0, v = 0;
    for (int i = 0; i < 3; i++) {
        const double h = time[i + 1] - time[i], f = force[i] / mass, g = force[i + 1] / mass;
        x += v * h + h * h * (2 * f + g) / 6;
        v += h * (f + g) / 2;
        run_until(run, time[i + 1]);
        assert_near(sample_at(run, time[i + 1]).field[BEAD_FIELD_DISPLACEMENT][2], x, 1e-12 * 2e-6);
    }
    run_until(run, 6e-3);
    assert_near(sample_at(run, 6e-3).field[BEAD_FIELD_DISPLACEMENT][2], x + v * 2e-3, 1e-12 * 2e-6);
    bead_run_destroy(run);
    release(&b);
}

/* The spline goes through its points, and between those of a cosine it is off by 5/384 of their distance to the fourth times the
 * fourth derivative at most (C. A. Hall and W. W. Meyer, J. Approx. Theory 16, 105, 1976). */
static void splines_follow_their_points(void **state)
{
    (void)state;
    double off[2] = {0, 0};
    for (int fine = 0; fine < 2; fine++) {
        const int count = fine ? 41 : 21;
        char text[4000];
        int used =
            snprintf(text, sizeof text, MATERIAL "chain: {" UNIT "beads: [{bead: unit}], drive: {amplitude: 1 mm, displacement: '");
        for (int i = 0; i < count; i++)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%.17g %.17g", i ? ", " : "", 1e-3 * i / (count - 1),
                             cos(3 * pi * i / (count - 1)));
        snprintf(text + used, sizeof text - (size_t)used, "'}}\n");
        struct built b = build(text, "until: 2 ms");
        for (int i = 0; i < count; i++)
            assert_near(bead_drive_at(b.chain, 1e-3 * i / (count - 1)).x[0], 1e-3 * cos(3 * pi * i / (count - 1)), 1e-17);
        for (int i = 0; i <= 1000; i++)
            off[fine] = fmax(off[fine], fabs(bead_drive_at(b.chain, 1e-6 * i).x[0] - 1e-3 * cos(3 * pi * i / 1000)));
        assert_below(off[fine], 5. / 384 * pow(3 * pi / (count - 1), 4) * 1e-3);
        release(&b);
    }
    assert_true(off[0] > 14 * off[1] && off[0] < 18 * off[1]);
}

/* Beads that no wave has reached are skipped: the same bits as if they were not. */
static void quiet_beads_change_nothing(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int full = 0; full < 2; full++) {
        struct built b =
            build("chain: {beads: [{bead: large-steel, count: 200}], drive: {bead: 3, displacement: sine, amplitude: 2 um, "
                  "frequency: 3 kHz}}\n",
                  "until: 1 ms");
        struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 1e-3, .hash = true, .full_window = full});
        run_until(run, 1e-3);
        hash[full] = bead_run_work(run).hash;
        bead_run_destroy(run);
        release(&b);
    }
    assert_true(hash[0] == hash[1]);
}

/* Compositions of drifts and kicks know no times within their steps. */
static void compositions_are_refused(void **state)
{
    (void)state;
    struct built b =
        build("chain: {beads: [{bead: large-steel, count: 2}], drive: {force: sine, amplitude: 1 N, frequency: 1 kHz}}\n",
              "until: 1 ms, method: verlet");
    struct bead_stepping stepping;
    struct bead_message msg = {""};
    assert_int_equal(bead_run_stepping(b.chain, &b.scene->simulate, 1, &stepping, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "does not support drives"));
    release(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_belong_to_the_wave),
        cmocka_unit_test(noise_has_its_amplitude),
        cmocka_unit_test(waves_break_where_they_are_put_together),
        cmocka_unit_test(lone_beads_follow_a_force),
        cmocka_unit_test(beyond_the_band_waves_decay),
        cmocka_unit_test(work_is_the_energy),
        cmocka_unit_test(drives_keep_the_accuracy),
        cmocka_unit_test(kinks_are_exact),
        cmocka_unit_test(splines_follow_their_points),
        cmocka_unit_test(quiet_beads_change_nothing),
        cmocka_unit_test(compositions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
