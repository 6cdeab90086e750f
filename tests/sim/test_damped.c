/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damped contacts: their force jumps as they close, to gamma |D|^a at D m/s. Peaks are the larger of both sides of a jump, and no
 * interpolation between steps crosses it. */
#include "support.h"

#include "sim/integrate/damped_contacts.h"
#include "sim/integrate/dense.h"
#include "sim/run/peaks.h"

#define BALLS "materials: {ball: {mass: 2 g, modulus: 100 GPa, poisson: 0.3, radius: 5 mm}}\n"

static struct bead_outcome finish(struct bead_run *run, double end)
{
    struct bead_outcome outcome;
    run_until(run, end);
    bead_run_finish(run, end, &outcome);
    return outcome;
}

/* The largest of k d + c d' for two beads of mass m that meet at v: a damped oscillator of the mass m/2, until the force is 0. */
static double oscillator_peak(double k, double c, double m, double v)
{
    const double decay = c / m, fast = sqrt(2 * k / m - decay * decay), part = (k - c * decay) / fast;
    const double turn = atan2(part * fast - c * decay, c * fast + part * decay) / fast;
    return turn <= 0 ? c * v : v * exp(-decay * turn) * (part * sin(fast * turn) + c * cos(fast * turn));
}

/* Weak damping: the peak is within the contact; strong: it is the jump, whatever the steps. One- and two-sided. */
static void linear_contacts_have_their_closed_form(void **state)
{
    (void)state;
    static const char *const laws[] = {"power: 1, coefficient: 1e6", "fpu-alpha: 1e-9, stiffness: 1e6"};
    static const double damping[] = {1, 10, 31, 32, 40};
    for (size_t i = 0; i < 2 * sizeof damping / sizeof *damping; i++) {
        char chain[512];
        const double c = damping[i / 2];
        snprintf(chain, sizeof chain,
                 BALLS "chain: {striker: {bead: ball, velocity: 1}, beads: [{bead: ball}], law: {%s}, damping: "
                       "{coefficient: %g, exponent: 1}}\n",
                 laws[i % 2], c);
        struct built built = build(chain, "until: 60 us, accuracy: 1e-7");
        struct bead_run *run =
            start_run(&built, (struct bead_run_settings){.end = 6e-5, .contact_peaks = true, .bead_peaks = true});
        struct bead_outcome outcome = finish(run, 6e-5);
        const double exact = oscillator_peak(1e6, c, 2e-3, 1);
        assert_near(outcome.contact_peaks[0].value / exact, 1, c > 31.7 ? 1e-15 : 1e-7);
        assert_near(outcome.bead_peaks[1].value / exact, 0.5, c > 31.7 ? 1e-15 : 1e-7);
        assert_true((outcome.contact_peaks[0].time > 0) == (c < 31.7));
        bead_run_destroy(run);
        release(&built);
    }
}

/* The striker a gap away from two beads that approach each other, and its contact open. */
static struct bead_stepper *start_apart(const struct built *built, double gap)
{
    struct bead_message msg = {""};
    struct bead_stepper *s = NULL;
    if (bead_stepper_create(built->chain, bead_method_row("rk8"), bead_kernels_find(NULL), true, &s, &msg))
        fail_msg("%s", msg.text);
    s->end.u[0] = -gap;
    s->end.u[1] = 2e-7;
    s->end.v[1] = 0.05;
    s->closed[0] = 0;
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    return s;
}

/* A step ends where a contact closes: its peak is that of the other side of the jump, and the compression of the next contact is
 * known within the step, though its rate jumps at the end. */
static void a_contact_closes_within_a_step(void **state)
{
    (void)state;
    static const char *const chain = BALLS "chain: {striker: {bead: ball, velocity: 2}, beads: [{bead: ball, count: 2}], "
                                           "damping: {coefficient: 100, exponent: 1.8}}\n";
    const double gap = 1e-6, step = 8e-7;
    double middle[2], closed_at[2];
    for (int fine = 0; fine < 2; fine++) {
        struct built built = build(chain, "accuracy: 1e-6");
        struct bead_stepper *s = start_apart(&built, gap);
        struct bead_message msg = {""};
        struct bead_peaks *peaks = NULL;
        if (bead_peaks_create(s, false, (struct bead_span){0, 1}, &peaks, &msg))
            fail_msg("%s", msg.text);
        middle[fine] = NAN;
        for (double t = 0, h = fine ? step / 64 : step; s->was_closed[0] == 0 && t < 2e-6; t = s->t1) {
            bead_stepper_advance(s, s->t1 + h);
            const double from = s->t0, to = s->t1, at = 0.3e-6;
            const struct bead_polynomial d = bead_dense_compression(s, 1);
            if (from <= at && at <= to)
                middle[fine] = bead_polynomial_value(&d, (at - from) / (to - from));
            closed_at[fine] = s->was_closed[0] ? closed_at[fine] : s->t1;
            bead_peaks_step(peaks, s, INFINITY, INFINITY);
        }
        const struct bead_peak *peak = bead_peaks_found(peaks);
        const double speed = s->start.v[0] - s->start.v[1];
        assert_near(s->start.u[0], s->start.u[1], 1e-14);
        assert_true(speed > 1.9);
        assert_near(peak[0].value / (100 * pow(speed, 1.8)), 1, 1e-12);
        assert_near(peak[0].time, s->t0, 1e-20);
        bead_peaks_destroy(peaks);
        bead_stepper_destroy(s);
        release(&built);
    }
    assert_near(closed_at[0] / closed_at[1], 1, 1e-7);
    assert_near(middle[0] / middle[1], 1, 1e-8);
}

/* Bead 1 closes the contacts on both of its sides, the second `later` s after the first. Returns its velocity after the step. */
static double squeezed(double later, double h)
{
    struct bead_message msg = {""};
    struct bead_stepper *s = NULL;
    struct built built = build(BALLS "chain: {striker: {bead: ball, velocity: 2}, beads: [{bead: ball, count: 2}], "
                                     "damping: {coefficient: 100, exponent: 1.8}}\n",
                               "accuracy: 1e-6");
    if (bead_stepper_create(built.chain, bead_method_row("rk8"), bead_kernels_find(NULL), true, &s, &msg))
        fail_msg("%s", msg.text);
    s->end.u[0] = -2 * 0.6e-6;
    s->end.u[2] = 1.5 * (0.6e-6 + later);
    s->end.v[2] = -1.5;
    s->closed[0] = s->closed[1] = 0;
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    while (s->t1 < 1.6e-6)
        bead_stepper_advance(s, fmin(s->t1 + h, 1.6e-6));
    const double v = s->end.v[1];
    bead_stepper_destroy(s);
    release(&built);
    return v;
}

/* However soon the second closes, it does so at its own time. */
static void contacts_close_one_after_the_other(void **state)
{
    (void)state;
    static const double later[] = {1e-15, 1e-13, 1e-11, 0.9e-10, 3e-10, 7e-10, 1e-8, -1e-13, -3e-10};
    for (size_t i = 0; i < sizeof later / sizeof *later; i++) {
        const double exact = squeezed(later[i], 0.8e-6 / 64);
        assert_near(squeezed(later[i], 0.8e-6) / exact, 1, 1e-4);
        assert_near(squeezed(later[i], 0.4e-6) / exact, 1, 1e-5);
    }
}

/* The front arrives at 1e-4 of the largest force, which is that of the striker's impact, at time 0. */
static void the_front_counts_the_impact(void **state)
{
    (void)state;
    static const double asked[] = {1e-3, 1e-5, 1e-7};
    double arrival[3];
    for (int i = 0; i < 3; i++) {
        char simulate[64];
        snprintf(simulate, sizeof simulate, "accuracy: %g", asked[i]);
        struct built built = build(BALLS "chain: {striker: {bead: ball, velocity: 1}, beads: [{bead: ball, count: 12}], "
                                         "damping: {coefficient: 700, exponent: 1.8}}\n",
                                   simulate);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = INFINITY, .passage = true});
        struct bead_message msg = {""};
        while (isnan(bead_run_arrival(run))) {
            if (bead_run_step(run, &msg))
                fail_msg("%s", msg.text);
        }
        arrival[i] = bead_run_arrival(run);
        const struct bead_sample sample = sample_at(run, arrival[i]);
        assert_near(sample.field[BEAD_FIELD_CONTACT_FORCE][11] / 700, 1e-4, 1e-4 * 20 * asked[i]);
        bead_run_destroy(run);
        release(&built);
    }
    assert_near(arrival[0] / arrival[2], 1, asked[0]);
    assert_near(arrival[1] / arrival[2], 1, asked[1]);
}

/* The force of a Hertzian contact jumps at the impact, falls at first, and is highest later: the run does not end with the jump, at
 * which the front arrives. The peak is that of a run to a given end. */
static void the_impact_is_not_the_peak_of_the_last_contact(void **state)
{
    (void)state;
    static const char text[] =
        BALLS "chain: {striker: {bead: ball, velocity: 1}, beads: [{bead: ball}], damping: {coefficient: 20, "
              "exponent: 1}}\n";
    double peak[2];
    for (int i = 0; i < 2; i++) {
        const double end = i == 0 ? INFINITY : 6e-5;
        struct built built = build(text, "until: 60 us, accuracy: 1e-7");
        struct bead_run *run = start_run(
            &built, (struct bead_run_settings){
                        .end = end, .passage = i == 0 ? BEAD_PASSAGE_OF_PULSE : BEAD_PASSAGE_NONE, .contact_peaks = true});
        struct bead_message msg = {""};
        struct bead_outcome outcome;
        while (i == 0 ? isnan(bead_run_over(run)) : bead_run_time(run) < end) {
            if (bead_run_step(run, &msg))
                fail_msg("%s", msg.text);
        }
        bead_run_finish(run, i == 0 ? bead_run_over(run) : end, &outcome);
        peak[i] = outcome.contact_peaks[0].value;
        assert_true(outcome.contact_peaks[0].time > 1e-5 && !outcome.contact_peaks[0].exceeded && !outcome.contact_peaks[0].open);
        bead_run_destroy(run);
        release(&built);
    }
    assert_near(peak[0] / peak[1], 1, 2e-7);
    assert_true(peak[0] > 2 * 20);
}

enum { CONTACTS = 7, ACCURACIES = 4 };

/* Peaks of a chain of 8 beads until 1 ms, requested like these; the first of them counts as exact. */
static void assert_as_accurate(const char *chain, const double asked[ACCURACIES])
{
    struct bead_peak exact[CONTACTS];
    for (int i = 0; i < ACCURACIES; i++) {
        char simulate[64];
        snprintf(simulate, sizeof simulate, "until: 1 ms, accuracy: %g", asked[i]);
        struct built built = build(chain, simulate);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1e-3, .contact_peaks = true});
        struct bead_outcome outcome = finish(run, 1e-3);
        for (size_t k = 0; k < CONTACTS; k++) {
            if (i > 0 && !outcome.contact_peaks[k].open)
                assert_near(outcome.contact_peaks[k].value / exact[k].value, 1, asked[i]);
        }
        if (i == 0)
            memcpy(exact, outcome.contact_peaks, sizeof exact);
        bead_run_destroy(run);
        release(&built);
    }
}

/* Light beads that strong damping slows faster than they vibrate: steps follow the damping. */
static void strong_damping_is_as_accurate_as_asked(void **state)
{
    (void)state;
    static const double asked[ACCURACIES] = {1e-9, 1e-4, 1e-6, 1e-8};
    static const char *const damping[] = {"{coefficient: 20, exponent: 1}", "{coefficient: 20, exponent: 1.5}"};
    for (size_t c = 0; c < 2; c++) {
        char chain[512];
        snprintf(chain, sizeof chain,
                 "materials: {light: {mass: 10 mg, modulus: 1 GPa, poisson: 0.3, radius: 2 mm}}\n"
                 "chain: {striker: {bead: light, velocity: 0.3}, beads: [{bead: light, count: 7}], damping: %s}\n",
                 damping[c]);
        assert_as_accurate(chain, asked);
    }
}

/* Below the exponent 1 the force has an infinite slope wherever a contact turns: steps become shorter there. */
static void steep_damping_is_as_accurate_as_asked(void **state)
{
    (void)state;
    static const double asked[ACCURACIES] = {1e-9, 1e-4, 1e-6, 1e-8};
    static const char *const exponents[] = {"0.3", "0.6", "0.9"};
    for (size_t e = 0; e < 3; e++) {
        char chain[256];
        snprintf(chain, sizeof chain,
                 "chain: {striker: {bead: ptfe, velocity: 0.5}, beads: [{bead: ptfe, count: 7}], "
                 "damping: {coefficient: 0.05, exponent: %s}}\n",
                 exponents[e]);
        assert_as_accurate(chain, asked);
    }
}

/* ... there only: not everywhere, and not where contacts ahead of the front open and close by rounding errors. */
static void steep_damping_takes_few_steps(void **state)
{
    (void)state;
    static const char *const damping[] = {"30, exponent: 1", "3, exponent: 0.7", "30, exponent: 0.7", "300, exponent: 0.7"};
    static const char *const asked[] = {"accuracy: 1e-4", "accuracy: 1e-6"};
    for (size_t a = 0; a < 2; a++) {
        uint64_t steps[4];
        for (size_t i = 0; i < 4; i++) {
            char chain[256];
            snprintf(chain, sizeof chain, "chain: {beads: [{bead: large-steel, count: 30}], damping: {coefficient: %s}}\n",
                     damping[i]);
            char simulate[64];
            snprintf(simulate, sizeof simulate, "%s%s", asked[a], i == 0 ? ", method: rk4" : "");
            struct built built = build(chain, simulate);
            struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.5e-3});
            run_until(run, 0.5e-3);
            steps[i] = bead_run_work(run).steps;
            print_message("%s: %lu\n", damping[i], (unsigned long)steps[i]);
            assert_true(steps[i] < 10 * steps[0]);
            bead_run_destroy(run);
            release(&built);
        }
    }
}

/* An energy budget needs 1e-11; Runge-Kutta 4 took 3 ns for it, 677000 steps in 2 ms. All kinds of branch points, and none. */
static void budgets_take_few_steps(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "beads: [{bead: large-steel, count: 24}], damping: {coefficient: 20, exponent: 1.8}",
        "beads: [{bead: large-steel, count: 24}], damping: {coefficient: 20, exponent: 0.7}",
        "beads: [{bead: large-steel, count: 24}], precompression: 20 N, wall: rigid, damping: {coefficient: 10, exponent: 2}",
        "beads: [{cell: [large-steel, ptfe], count: 9}], wall: brass, damping: {coefficient: 5, exponent: 3}",
        "beads: [{bead: large-steel, count: 16}], damping: {coefficient: 3e4, exponent: 1, compression: 0.5}"};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char chain[256];
        snprintf(chain, sizeof chain, "chain: {striker: {velocity: 1 m/s}, %s}\n", chains[i]);
        struct built built = build(chain, "accuracy: 1e-11");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 2e-3, .budget = true});
        run_until(run, 2e-3);
        const struct bead_budget *b = sample_at(run, 2e-3).budget;
        const double put_in = 0.5 * 3.63e-3, total = b->kinetic + b->contacts + b->wall + b->gravity + b->dissipated;
        assert_near(total / put_in, 1, 1e-10);
        assert_true(b->dissipated > 0.01 * put_in);
        assert_true(bead_run_work(run).steps < 40000);
        bead_run_destroy(run);
        release(&built);
    }
}

/* Steps of rk4, which keeps no stages, count what dampers and an absorbing end take by their polynomials. */
static void budgets_of_short_steps(void **state)
{
    (void)state;
    static const char *const chains[] = {"beads: [{bead: large-steel, count: 9}], damping: {coefficient: 20, exponent: 1}",
                                         "beads: [{bead: large-steel, count: 9}], precompression: 20 N, wall: absorbing"};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char chain[256];
        snprintf(chain, sizeof chain, "chain: {striker: {velocity: 1 m/s}, %s}\n", chains[i]);
        struct built built = build(chain, "method: rk4, step: 0.1 us, until: 0.6 ms");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.6e-3, .budget = true});
        double first = 0;
        for (int n = 0; n <= 6; n++) {
            run_until(run, 0.1e-3 * n);
            const struct bead_budget *b = sample_at(run, 0.1e-3 * n).budget;
            const double total = b->kinetic + b->contacts + b->wall + b->gravity + b->dissipated;
            first = n == 0 ? total : first;
            assert_near(total / first, 1, 1e-7);
            assert_true(n < 6 || b->dissipated > 0.2 * first);
        }
        bead_run_destroy(run);
        release(&built);
    }
}

/* Velocity of bead j of `count` alike, of which the first had the velocity 1. Springs, of k / m = `stiffness`, and dashpots, of c /
 * m = `damping`, have modes cos((2 j + 1) q pi / 2 count), damped oscillators s^2 + damping K s + stiffness K = 0 with K = 4
 * sin^2(q pi / 2 count). Where all are overdamped, momentum spreads like heat. */
static double spread_velocity(size_t j, size_t count, double damping, double stiffness, double time)
{
    double sum = 1;
    for (size_t q = 1; q < count; q++) {
        const double angle = (double)q * M_PI / (2 * (double)count), s = sin(angle), k = 4 * s * s,
                     fast = -0.5 * damping * k * (1 + sqrt(1 - 4 * stiffness / (damping * damping * k))),
                     slow = stiffness * k / fast, decay = (fast * exp(fast * time) - slow * exp(slow * time)) / (fast - slow);
        sum += 2 * cos(angle) * cos((double)(2 * j + 1) * angle) * decay;
    }
    return sum / (double)count;
}

/* Neighbours would have the same velocity in a small part of the time. When they nearly do, steps may be longer than that. */
static void momentum_spreads_like_heat(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    static const double asked[] = {1e-4, 1e-6, 1e-8};
    const double damping = 10 / 2e-3, stiffness = 1 / 2e-3, end = 50e-3;
    for (size_t a = 0; a < 3; a++) {
        char simulate[64];
        snprintf(simulate, sizeof simulate, "until: 60 ms, accuracy: %g", asked[a]);
        struct built built = build(BALLS "chain: {striker: {bead: ball, velocity: 1}, beads: [{bead: ball, count: 39}], law: "
                                         "{fpu-alpha: 1e-9, stiffness: 1}, damping: {coefficient: 10, exponent: 1}}\n",
                                   simulate);
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 60e-3});
        for (double t = end / 16; t <= end; t *= 2) {
            run_until(run, t);
            const double *v = sample_at(run, t).field[BEAD_FIELD_VELOCITY];
            for (size_t j = 0; j < COUNT; j++)
                assert_near(v[j], spread_velocity(j, COUNT, damping, stiffness, t),
                            asked[a] * spread_velocity(0, COUNT, damping, stiffness, t));
        }
        assert_true((double)bead_run_work(run).steps < 2 * 4 * damping * end);
        bead_run_destroy(run);
        release(&built);
    }
}

/* Steps follow the state, but only as far as beads have moved; what they are computed from moves none ahead of these. */
static void the_window_changes_no_bit(void **state)
{
    (void)state;
    static const char *const damping[] = {"5, exponent: 1", "5, exponent: 1.8", "0.5, exponent: 0.9"};
    for (int e = 0; e < 6; e++) {
        uint64_t hash[2];
        for (int full = 0; full < 2; full++) {
            char chain[256];
            snprintf(chain, sizeof chain,
                     "chain: {beads: [{bead: ptfe, count: 60}], precompression: %d N, damping: {coefficient: %s}}\n", e / 3,
                     damping[e % 3]);
            struct built built = build(chain, "accuracy: 1e-5");
            struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.2e-3, .full_window = full, .hash = true});
            run_until(run, 0.2e-3);
            hash[full] = bead_run_work(run).hash;
            bead_run_destroy(run);
            release(&built);
        }
        assert_true(hash[0] == hash[1]);
    }
}

/* Restitution of two spheres with the contact of Kuwabara and Kono, gamma sqrt(d) D, at speed v. */
static double restitution(double coefficient, double v, const char *accuracy)
{
    char text[400], simulate[100];
    snprintf(
        text, sizeof text,
        "materials: {unit: {mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}}\n"
        "chain: {law: {power: 1.5, coefficient: 1e9}, striker: {bead: unit, velocity: %.17g m/s}, beads: [{bead: unit}], damping: "
        "{coefficient: %.17g, exponent: 1, compression: 0.5}}\n",
        v, coefficient);
    snprintf(simulate, sizeof simulate, "until: 1 ms, accuracy: %s", accuracy);
    struct built b = build(text, simulate);
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 1e-3});
    run_until(run, 1e-3);
    const double *end = sample_at(run, 1e-3).field[BEAD_FIELD_VELOCITY], e = (end[1] - end[0]) / v;
    assert_near(end[0] + end[1], v, 1e-13 * v);
    bead_run_destroy(run);
    release(&b);
    return e;
}

/* With gamma = (3/2) k A and x = (3/2) A (k/m)^(2/5) v^(1/5), e = 1 - C1 x + C2 x^2 - C3 x^3 + ..., where C1 = 1.15344, C2 = (3/5)
 * C1^2 and C3 = .483582: R. Ramirez, T. Poschel, N. V. Brilliantov, T. Schwager, Phys. Rev. E 60, 4465 (1999). They let beads pull
 * until d = 0. Here a contact opens where its force would pull, at d = (3/2) A D; the work that this saves, (4/15) k d^(5/2), adds
 * (4/15) x^(5/2) to e. What is left is of order x^(7/2), whichever of A and v makes x smaller. */
static void restitution_follows_the_expansion(void **state)
{
    (void)state;
    const double c1 = 1.15344, c2 = 0.6 * c1 * c1, c3 = 0.483582, stiffness = 1e9, reduced = 0.5e-3;
    const double unit = 1.5 * pow(stiffness / reduced, 0.4);
    static const struct {
        double x, v;
    } cases[] = {{0.16, 1}, {0.08, 1}, {0.04, 1}, {0.02, 1}, {0.02, 1 / 32.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double x = cases[i].x, v = cases[i].v, gamma = 1.5 * stiffness * (x / pow(v, 0.2) / unit);
        const double e = 1 - c1 * x + c2 * x * x + 4 / 15.0 * pow(x, 2.5) - c3 * x * x * x;
        assert_near(restitution(gamma, v, "1e-9"), e, pow(x, 3.5));
    }
}

/* Beads that start apart do not damp each other until they touch, here after 5 us. */
static void open_contacts_do_not_damp(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "gap: 1 um, start: [{bead: 2, velocity: -0.2 m/s}]",
        "gap: 3 um, start: [{bead: 1, displacement: 1 um}, {bead: 2, velocity: -0.2 m/s, displacement: -1 um}]"};
    for (size_t i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 BALLS "chain: {striker: {bead: ball, velocity: 0}, beads: [{bead: ball, count: 3}], damping: "
                       "{coefficient: 20, exponent: 1}, %s}\n",
                 chains[i]);
        struct built built = build(text, "until: 9 us");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 9e-6});
        struct bead_sample sample = {.chain = 0};
        const unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE);
        for (double t = 0; t < 4.9e-6; t += 0.7e-6) {
            run_until(run, t);
            assert_int_equal(bead_run_sample(run, t, fields, (struct bead_span){0, 3}, &sample, NULL), BEAD_OK);
            assert_true(sample.field[BEAD_FIELD_CONTACT_FORCE][1] == 0 && sample.field[BEAD_FIELD_CONTACT_FORCE][2] == 0);
            assert_near(sample.field[BEAD_FIELD_VELOCITY][2], -0.2, 1e-15);
        }
        bead_run_destroy(run);
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_contacts_have_their_closed_form),
        cmocka_unit_test(a_contact_closes_within_a_step),
        cmocka_unit_test(contacts_close_one_after_the_other),
        cmocka_unit_test(the_front_counts_the_impact),
        cmocka_unit_test(the_impact_is_not_the_peak_of_the_last_contact),
        cmocka_unit_test(strong_damping_is_as_accurate_as_asked),
        cmocka_unit_test(steep_damping_is_as_accurate_as_asked),
        cmocka_unit_test(steep_damping_takes_few_steps),
        cmocka_unit_test(the_window_changes_no_bit),
        cmocka_unit_test(restitution_follows_the_expansion),
        cmocka_unit_test(budgets_take_few_steps),
        cmocka_unit_test(budgets_of_short_steps),
        cmocka_unit_test(momentum_spreads_like_heat),
        cmocka_unit_test(open_contacts_do_not_damp),
    };
    return cmocka_run_group_tests_name("damped", tests, NULL, NULL);
}
