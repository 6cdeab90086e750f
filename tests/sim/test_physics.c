/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Physics that must hold exactly, or to rounding: scaling, conservation, symmetry, known solutions; and neither window nor
 * instruction set changes a bit. */
#include "support.h"

static uint64_t hash_of(const char *chain, const char *simulate, double end, struct bead_run_settings settings)
{
    struct built built = build(chain, simulate);
    settings.end = end;
    settings.hash = true;
    struct bead_run *run = start_run(&built, settings);
    run_until(run, end);
    uint64_t hash = bead_run_work(run).hash;
    assert_true(hash != 0);
    bead_run_destroy(run);
    release(&built);
    return hash;
}

static const char *const methods[] = {"rk4", "rk8", "verlet", "pefrl", "vefrl", "rkn6", "rkn8-plain", "rkn8", "rkn12"};
enum { METHODS = sizeof methods / sizeof *methods };

static void window_changes_no_bit(void **state)
{
    (void)state;
    static const char *const chains[] = {
        P1_CHAIN,
        P3_CHAIN,
        P4_CHAIN,
        "chain: {wall: brass, tilt: 3.5 deg, beads: [{bead: large-steel, count: 60}]}\n",
        "chain: {beads: [{bead: ptfe, count: 60}], law: {power: 2, coefficient: 1e9}}\n",
        "chain: {beads: [{bead: large-steel, count: 80}], law: {fpu-alpha: 1000, stiffness: 1e7}}\n"};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        for (int m = 0; m < METHODS; m++) {
            char simulate[128];
            snprintf(simulate, sizeof simulate, "until: 0.3 ms, method: %s, step: 1 us", methods[m]);
            uint64_t window = hash_of(chains[c], simulate, 0.3e-3, (struct bead_run_settings){.full_window = false});
            uint64_t full = hash_of(chains[c], simulate, 0.3e-3, (struct bead_run_settings){.full_window = true});
            if (window != full)
                fail_msg("chain %zu, %s: the window changed the states", c, methods[m]);
        }
    }
}

static void damped_window_changes_no_bit(void **state)
{
    (void)state;
    const char *chain =
        "chain: {beads: [{bead: large-steel, count: 60}], wall: rigid, damping: {coefficient: 20, exponent: 1.8}}\n";
    const char *simulate = "until: 0.3 ms, method: rk4, step: 0.5 us";
    assert_true(hash_of(chain, simulate, 0.3e-3, (struct bead_run_settings){.full_window = false}) ==
                hash_of(chain, simulate, 0.3e-3, (struct bead_run_settings){.full_window = true}));
}

static void instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    static const char *const sets[] = {"sse2", "avx2", "avx512"};
    const struct bead_kernels *plain = bead_kernels_find("portable");
    assert_non_null(plain);
    for (int i = 0; i < 3; i++) {
        const struct bead_kernels *kernels = bead_kernels_find(sets[i]);
        if (!kernels)
            continue; /* this machine has none */
        assert_string_equal(kernels->name, sets[i]);
        for (int m = 0; m < METHODS; m++) {
            char simulate[128];
            snprintf(simulate, sizeof simulate, "until: 1 ms, method: %s, step: 1 us", methods[m]);
            assert_true(hash_of(P3_CHAIN, simulate, 1e-3, (struct bead_run_settings){.kernels = plain}) ==
                        hash_of(P3_CHAIN, simulate, 1e-3, (struct bead_run_settings){.kernels = kernels}));
            assert_true(hash_of(P4_CHAIN, simulate, 1e-3, (struct bead_run_settings){.kernels = plain}) ==
                        hash_of(P4_CHAIN, simulate, 1e-3, (struct bead_run_settings){.kernels = kernels}));
        }
    }
}

/* v0 x 32 and step / 2 must give u x 16 and v x 32, to the bit: s = 32, u ~ s^{4/5}, t ~ s^{-1/5}. */
static void scaling_is_exact(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        char slow[128], fast[128];
        const char *beads = "beads: [{cell: [large-steel, aluminium], spins: \"" P3_SPINS "\"}], wall: brass}\n";
        snprintf(slow, sizeof slow, "until: %.17g, method: %s, step: %.17g", 1024 * 0x1p-20, methods[m], 0x1p-20);
        snprintf(fast, sizeof fast, "until: %.17g, method: %s, step: %.17g", 512 * 0x1p-20, methods[m], 0x1p-21);
        char chain[512], quick[512];
        snprintf(chain, sizeof chain, "chain: {striker: {bead: large-steel, velocity: 0.443}, %s", beads);
        snprintf(quick, sizeof quick, "chain: {striker: {bead: large-steel, velocity: %.17g}, %s", 32 * 0.443, beads);
        struct built a = build(chain, slow), b = build(quick, fast);
        struct bead_run *ra = start_run(&a, (struct bead_run_settings){.end = 1024 * 0x1p-20});
        struct bead_run *rb = start_run(&b, (struct bead_run_settings){.end = 512 * 0x1p-20});
        run_until(ra, 1024 * 0x1p-20);
        run_until(rb, 512 * 0x1p-20);
        struct bead_sample sa = sample_at(ra, bead_run_time(ra)), sb = sample_at(rb, bead_run_time(rb));
        for (size_t j = 0; j < a.chain->beads; j++) {
            if (16 * sa.field[BEAD_FIELD_DISPLACEMENT][j] != sb.field[BEAD_FIELD_DISPLACEMENT][j] ||
                32 * sa.field[BEAD_FIELD_VELOCITY][j] != sb.field[BEAD_FIELD_VELOCITY][j])
                fail_msg("%s: bead %zu does not scale", methods[m], j);
        }
        bead_run_destroy(ra);
        bead_run_destroy(rb);
        release(&a);
        release(&b);
    }
}

/* Before the wave reaches the wall momentum stays, whatever the method. */
static void momentum_stays(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        char simulate[128];
        snprintf(simulate, sizeof simulate, "until: 1 ms, method: %s, step: 1 us", methods[m]);
        struct built built = build(P3_CHAIN, simulate);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1e-3});
        struct bead_outcome outcome;
        run_until(run, 1e-3);
        bead_run_finish(run, 1e-3, &outcome);
        assert_near(outcome.momentum_start, 3.63e-3 * 0.443, 1e-17);
        assert_below(fabs(outcome.momentum_end / outcome.momentum_start - 1), 1e-13);
        bead_run_destroy(run);
        release(&built);
    }
}

static void damping_keeps_momentum_and_takes_energy(void **state)
{
    (void)state;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 40}], damping: {coefficient: 20, exponent: 1.8}}\n",
                               "until: 0.5 ms, step: 0.1 us");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.5e-3});
    struct bead_outcome outcome;
    double before = INFINITY;
    for (int i = 1; i <= 10; i++) {
        run_until(run, i * 0.05e-3);
        bead_run_finish(run, i * 0.05e-3, &outcome);
        assert_true(outcome.energy_end < before);
        before = outcome.energy_end;
    }
    assert_below(outcome.energy_end, 0.99 * outcome.energy_start);
    assert_below(fabs(outcome.momentum_end / outcome.momentum_start - 1), 1e-13);
    bead_run_destroy(run);
    release(&built);
}

/* Two equal beads: delta_max = (5 m* v^2 / (4 A))^{2/5}, contact for 2.9433 delta_max / v, velocities exchanged. */
static void two_beads_collide(void **state)
{
    (void)state;
    struct built built = build("chain: {striker: {bead: large-steel, velocity: 1}, beads: [{bead: large-steel}]}\n",
                               "until: 1 ms, method: rkn8, step: 0.05 us");
    const struct bead_chain *c = built.chain;
    double deepest = pow(5 * (c->mass[0] / 2) / (4 * c->stiffness[0]), 0.4), duration = 2.9432751 * deepest;
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1e-3, .contact_peaks = true});
    run_until(run, 1.05 * duration);
    struct bead_outcome outcome;
    bead_run_finish(run, 1.05 * duration, &outcome);
    assert_near(outcome.contact_peaks[0].value / (c->stiffness[0] * pow(deepest, 1.5)), 1, 1e-9);
    assert_near(outcome.contact_peaks[0].time / (duration / 2), 1, 1e-6);
    assert_false(outcome.contact_peaks[0].open);
    struct bead_sample sample = sample_at(run, bead_run_time(run));
    assert_near(sample.field[BEAD_FIELD_VELOCITY][0], 0, 1e-6);
    assert_near(sample.field[BEAD_FIELD_VELOCITY][1], 1, 1e-6);
    assert_true(sample.field[BEAD_FIELD_CONTACT_FORCE][0] == 0);
    bead_run_destroy(run);
    release(&built);
}

/* Contact 9 has had a maximum of 23.48 N and rises to a higher one as the run ends: its largest force so far is the one there. */
static void peaks_that_still_rise_are_the_force_at_the_end(void **state)
{
    (void)state;
    const double end = 210e-6;
    struct built built = build("chain: {striker: {bead: large-steel, velocity: 0.443}, wall: rigid,\n"
                               "  beads: [{cell: [large-steel, aluminium], count: 8, spins: \"11011101\"}]}\n",
                               "until: 210 us");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = end, .contact_peaks = true, .bead_peaks = true});
    run_until(run, end);
    struct bead_outcome outcome;
    bead_run_finish(run, end, &outcome);
    struct bead_sample sample = sample_at(run, end);
    const struct bead_peak *peak[2] = {outcome.contact_peaks, outcome.bead_peaks};
    const double *force[2] = {sample.field[BEAD_FIELD_CONTACT_FORCE], sample.field[BEAD_FIELD_FORCE]};
    size_t open = 0;
    for (size_t i = 0; i < 2; i++) {
        for (size_t j = 0; j < built.chain->contacts; j++) {
            assert_true(peak[i][j].value >= (1 - 1e-9) * force[i][j]);
            open += peak[i][j].open;
            if (peak[i][j].open)
                assert_true(fabs(peak[i][j].value / force[i][j] - 1) < 1e-9 && peak[i][j].time == end);
        }
    }
    assert_true(open > 8 && outcome.contact_peaks[9].open && outcome.contact_peaks[9].value > 30);
    bead_run_destroy(run);
    release(&built);
}

/* Peaks are of the whole force: the static one where the wave has not come, and never less. */
static void peaks_ahead_of_the_wave_are_static(void **state)
{
    (void)state;
    static const char *const chains[] = {"chain: {beads: [{bead: large-steel, count: 50}], wall: brass, precompression: 10 N}\n",
                                         "chain: {beads: [{bead: large-steel, count: 50}], wall: brass, tilt: 30 deg}\n",
                                         ("chain: {beads: [{bead: large-steel, count: 50}], precompression: 10 N, "
                                          "damping: {coefficient: 20, exponent: 1.8}}\n")};
    for (size_t i = 0; i < 3; i++) {
        struct built built = build(chains[i], "until: 0.1 ms");
        struct bead_run *run =
            start_run(&built, (struct bead_run_settings){.end = 0.1e-3, .contact_peaks = true, .bead_peaks = true});
        run_until(run, 0.1e-3);
        struct bead_outcome outcome;
        bead_run_finish(run, 0.1e-3, &outcome);
        const double *still = built.chain->static_force;
        for (size_t k = 0; k < built.chain->contacts; k++) {
            const struct bead_peak *of_contact = &outcome.contact_peaks[k], *of_bead = &outcome.bead_peaks[k];
            assert_true(of_contact->value >= still[k] && of_bead->value >= 0.5 * (still[k] + (k > 0 ? still[k - 1] : 0)));
            assert_true(k > 5 || of_contact->value > 30);
            assert_true(k < 30 || (of_contact->value == still[k] && of_contact->time == 0 && !of_contact->open));
            assert_true(k < 30 || (of_bead->value == 0.5 * (still[k] + still[k - 1]) && of_bead->time == 0 && !of_bead->open));
        }
        bead_run_destroy(run);
        release(&built);
    }
}

/* An fpu-alpha spring struck beyond 1 / alpha: reported, not blamed on the accuracy. */
static void a_collapsing_spring_is_told(void **state)
{
    (void)state;
    struct built built = build("chain: {striker: {bead: large-steel, velocity: 20}, wall: rigid,\n"
                               "  law: {fpu-alpha: 2e3, stiffness: 1e6}, beads: [{bead: large-steel, count: 20}]}\n",
                               "until: 5 ms");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 5e-3});
    struct bead_message msg = {""};
    enum bead_error err = BEAD_OK;
    while (!err && bead_run_time(run) < 5e-3)
        err = bead_run_step(run, &msg);
    assert_int_equal(err, BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "the spring of contact 0 has collapsed"));
    assert_null(strstr(msg.text, "simulate.accuracy"));
    bead_run_destroy(run);
    release(&built);
}

/* A steel chain: speed 272.3646 F^{1/6} m/s with F the peak contact force, 543.393 m/s at 0.4 m/s of the pulse;
 * here from the times of two far peaks. The bead force's peak is 0.7073 of the contact force's. */
static void solitary_wave_of_a_steel_chain(void **state)
{
    (void)state;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 120}]}\n", "until: 1.6 ms, method: rkn8, step: 0.2 us");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1.6e-3, .contact_peaks = true, .bead_peaks = true});
    run_until(run, 1.6e-3);
    struct bead_outcome outcome;
    bead_run_finish(run, 1.6e-3, &outcome);
    const struct bead_peak *p = outcome.contact_peaks;
    double speed = 40 * 2 * 4.76e-3 / (p[80].time - p[40].time);
    assert_near(speed / (272.3646 * pow(p[60].value, 1.0 / 6)), 1, 2e-5);
    assert_near(outcome.bead_peaks[80].value / p[80].value, 0.7073, 1e-4);
    bead_run_destroy(run);
    release(&built);
}

/* Reflections: the wall's peak force over the incident one, 1.9439 for a flat wall of the beads' own material, 2.2384 rigid. */
static void walls_reflect(void **state)
{
    (void)state;
    static const struct {
        const char *wall;
        double ratio;
    } cases[] = {{"large-steel", 1.9439}, {"rigid", 2.2384}};
    for (int i = 0; i < 2; i++) {
        char chain[256];
        snprintf(chain, sizeof chain, "chain: {beads: [{bead: large-steel, count: 80}], wall: %s}\n", cases[i].wall);
        struct built built = build(chain, "until: 1.6 ms, method: rkn8, step: 0.2 us");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1.6e-3, .contact_peaks = true});
        run_until(run, 1.6e-3);
        struct bead_outcome outcome;
        bead_run_finish(run, 1.6e-3, &outcome);
        assert_near(outcome.contact_peaks[80].value / outcome.contact_peaks[50].value, cases[i].ratio, 1e-3);
        bead_run_destroy(run);
        release(&built);
    }
}

/* Stiffnesses of the materials in use, N/m^{3/2}. */
static void contacts_are_hertzian(void **state)
{
    (void)state;
    struct built built = build(
        "chain: {beads: [{bead: large-steel}, {bead: aluminium}, {bead: aluminium}, {bead: large-steel}], wall: brass}\n", "");
    const double *a = bead_chain_stiffness(built.chain);
    static const double wanted[] = {6.89784e9, 3.82112e9, 2.64247e9, 3.82112e9, 6.33547e9};
    for (int k = 0; k < 5; k++)
        assert_near(a[k] / wanted[k], 1, 2e-6); /* six digits */
    release(&built);
    built = build("chain: {beads: [{bead: large-steel}], law: thesis-appendix}\n", "");
    assert_near(bead_chain_stiffness(built.chain)[0] / 6.89784e9, 10.249, 1e-3);
    release(&built);
}

static void a_tilted_chain_rests_in_balance(void **state)
{
    (void)state;
    struct built built = build("chain: {striker: {bead: large-steel, velocity: 0.1}, beads: [{bead: large-steel, count: 30}], "
                               "wall: brass, tilt: 3.5 deg}\n",
                               "until: 0.05 ms");
    const double *f = bead_chain_static_force(built.chain);
    assert_true(f[0] == 0);
    assert_near(f[30], 30 * 3.63e-3 * 9.80665 * sin(3.5 * M_PI / 180), 1e-12);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.05e-3});
    run_until(run, 0.05e-3);
    struct bead_sample sample = sample_at(run, 0.05e-3);
    assert_true(sample.field[BEAD_FIELD_DISPLACEMENT][30] == 0);
    assert_near(sample.field[BEAD_FIELD_CONTACT_FORCE][30], f[30], 1e-15);
    bead_run_destroy(run);
    release(&built);
}

/* Long waves in a precompressed chain follow omega = 2 sqrt(K/m) |sin(k/2)|, K = (3/2) A^{2/3} F0^{1/3}: their speed is sqrt(K/m)
 * beads a second. */
static void sound_in_a_compressed_chain(void **state)
{
    (void)state;
    struct built built = build("chain: {striker: {bead: large-steel, velocity: 1e-5}, beads: [{bead: large-steel, count: 400}], "
                               "precompression: 20 N, wall: rigid}\n",
                               "until: 2 ms, step: 1 us");
    const struct bead_chain *c = built.chain;
    double k = 1.5 * pow(c->stiffness[0], 2.0 / 3) * cbrt(20), omega = sqrt(k / c->mass[0]);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 2e-3});
    double end = 200 / omega;
    run_until(run, end);
    struct bead_sample sample = sample_at(run, end);
    /* The exact linear solution: v_j = v0 J_{2j}(2 omega t) for a free striker: v_j = v0 [J_{2j} + J_{2j+2}](2 omega t). */
    for (int j = 150; j < 200; j++) {
        double exact = 1e-5 * (jn(2 * j, 2 * omega * end) + jn(2 * j + 2, 2 * omega * end));
        assert_near(sample.field[BEAD_FIELD_VELOCITY][j], exact, 1e-5 * 2e-4);
    }
    bead_run_destroy(run);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(window_changes_no_bit),
        cmocka_unit_test(damped_window_changes_no_bit),
        cmocka_unit_test(instruction_sets_give_the_same_bits),
        cmocka_unit_test(scaling_is_exact),
        cmocka_unit_test(momentum_stays),
        cmocka_unit_test(damping_keeps_momentum_and_takes_energy),
        cmocka_unit_test(two_beads_collide),
        cmocka_unit_test(peaks_that_still_rise_are_the_force_at_the_end),
        cmocka_unit_test(peaks_ahead_of_the_wave_are_static),
        cmocka_unit_test(a_collapsing_spring_is_told),
        cmocka_unit_test(solitary_wave_of_a_steel_chain),
        cmocka_unit_test(walls_reflect),
        cmocka_unit_test(contacts_are_hertzian),
        cmocka_unit_test(a_tilted_chain_rests_in_balance),
        cmocka_unit_test(sound_in_a_compressed_chain),
    };
    return cmocka_run_group_tests_name("physics", tests, NULL, NULL);
}
