/* Contacts that open and close: what the correction of their steps restores, and what it must not touch. */
#include "support.h"

#include "beadreel/law.h"
#include "sim/events.h"
#include "sim/events_patch.h"
#include "sim/peaks.h"

enum { STEEL, ALUMINIUM, BRASS, LIGHT };
static struct bead_material materials[] = {
    [STEEL] = {.name = "steel", .mass = 3.63e-3, .radius = 4.76e-3, .modulus = 193e9, .poisson = 0.30},
    [ALUMINIUM] = {.name = "aluminium", .mass = 1.26e-3, .radius = 4.76e-3, .modulus = 72.4e9, .poisson = 0.33},
    [BRASS] = {.name = "brass", .mass = NAN, .radius = NAN, .modulus = 90.2e9, .poisson = 0.34},
    [LIGHT] = {.name = "light", .mass = 0.123e-3, .radius = 2.38e-3, .modulus = 1.46e9, .poisson = 0.46},
};

struct setup {
    struct bead_scene scene;
    struct bead_chain_spec spec;
    struct bead_segment segment;
    size_t cell[2];
    struct bead_chain *chain;
};

/* `count` cells of one or two beads behind a steel striker. */
static void describe(struct setup *x, size_t cell_beads, size_t first, size_t second, size_t count, const char *spins,
                     double velocity)
{
    *x = (struct setup){.cell = {first, second}};
    x->segment = (struct bead_segment){.cell_beads = cell_beads,
                                       .count = count,
                                       .spins = spins ? BEAD_SPINS_DIGITS : BEAD_SPINS_UP,
                                       .digits = (char *)(uintptr_t)spins};
    x->spec = (struct bead_chain_spec){.striker_material = STEEL,
                                       .striker_velocity = velocity,
                                       .segment_count = 1,
                                       .wall = BEAD_WALL_MATERIAL,
                                       .wall_material = BRASS,
                                       .law = {.kind = BEAD_LAW_HERTZ, .power = 1.5}};
    x->scene =
        (struct bead_scene){.file = (char *)(uintptr_t) "test", .materials = materials, .material_count = 4, .chain_count = 1};
}

static void make(struct setup *x)
{
    struct bead_message msg = {""};
    x->segment.cell = x->cell;
    x->spec.segments = &x->segment;
    x->scene.chains = &x->spec;
    if (bead_chain_create(&x->scene, 0, &x->chain, &msg))
        fail_msg("%s", msg.text);
}

/* The problems that references exist for. */
static void make_problem(struct setup *x, int problem, double velocity)
{
    if (problem == 1)
        describe(x, 1, STEEL, STEEL, 50, NULL, velocity);
    else if (problem == 2)
        describe(x, 2, STEEL, ALUMINIUM, 34, NULL, velocity);
    else
        describe(x, 2, STEEL, ALUMINIUM, 64, P3_SPINS, velocity);
    make(x);
}

static struct bead_stepper *make_stepper(const struct setup *x, const char *method, const char *kernels, bool full)
{
    struct bead_message msg = {""};
    struct bead_stepper *stepper;
    const struct bead_kernels *set = bead_kernels_find(kernels);
    if (!set)
        return NULL;
    if (bead_stepper_create(x->chain, bead_method_row(method), set, full, &stepper, &msg))
        fail_msg("%s", msg.text);
    return stepper;
}

static void steps(struct bead_stepper *s, double h, size_t count)
{
    for (size_t i = 0; i < count; i++)
        bead_stepper_advance_by(s, h, s->t1 + h);
    assert_false(bead_events_failed(s->events));
}

static struct bead_stepper *run(const struct setup *x, const char *method, double h, double until)
{
    struct bead_stepper *s = make_stepper(x, method, NULL, false);
    steps(s, h, (size_t)llround(until / h));
    return s;
}

static void drop(struct setup *x, struct bead_stepper *s)
{
    bead_stepper_destroy(s);
    if (x)
        bead_chain_destroy(x->chain);
}

/* Largest deviation of a velocity from a reference table (time, bead, displacement, velocity), in units of the striker's. */
static double velocity_error(const struct bead_stepper *s, const struct table *reference, double time)
{
    double worst = 0;
    for (size_t r = 0; r < reference->rows; r++) {
        const double *row = reference->value + r * reference->columns;
        if (fabs(row[0] - time) < 1e-9)
            worst = fmax(worst, fabs(s->end.v[(size_t)row[1]] - row[3]));
    }
    assert_true(worst > 0);
    return worst / s->chain->spec->striker_velocity;
}

static double difference(const struct bead_stepper *a, const struct bead_stepper *b)
{
    double worst = 0;
    for (size_t j = 0; j < a->beads; j++)
        worst = fmax(worst, fabs(a->end.v[j] - b->end.v[j]));
    return worst;
}

/* Every step halved gains at least 2^5, down to rounding: without the correction it is 2^2.5. */
static void the_order_is_restored(void **state)
{
    (void)state;
    struct table reference = read_table("p3_states.csv", 4);
    struct setup x;
    make_problem(&x, 3, 0.443);
    double before = 0;
    for (double h = 4e-6; h > 0.9e-6; h /= 2) {
        struct bead_stepper *s = run(&x, "rkn8", h, 0.6e-3);
        double error = velocity_error(s, &reference, 0.6e-3);
        if (before > 0)
            assert_below(error, before / 32);
        before = error;
        drop(NULL, s);
    }
    assert_below(before, 1e-12);
    struct bead_stepper *plain = run(&x, "rkn8-plain", 1e-6, 0.6e-3);
    assert_true(velocity_error(plain, &reference, 0.6e-3) > 1e4 * before);
    drop(&x, plain);
    free(reference.value);
}

static void peaks_and_energy(void **state)
{
    (void)state;
    static const struct {
        int problem;
        double until, peaks;
        const char *reference;
    } cases[] = {{1, 0.8e-3, 1e-10, "p1_peaks.csv"}, {2, 1.5e-3, 1e-10, "p2_peaks.csv"}, {3, 3e-3, 1e-10, "p3_peaks.csv"}};
    for (size_t i = 0; i < 3; i++) {
        struct table reference = read_table(cases[i].reference, 3);
        struct setup x;
        make_problem(&x, cases[i].problem, 0.443);
        struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
        struct bead_peaks *peaks;
        struct bead_message msg = {""};
        assert_int_equal(bead_peaks_create(s, false, (struct bead_span){0, SIZE_MAX}, &peaks, &msg), BEAD_OK);
        double energy = bead_stepper_energy(s, &s->end), drift = 0;
        while (s->t1 < cases[i].until - 1e-6) {
            steps(s, 2e-6, 1);
            bead_peaks_step(peaks, s, INFINITY);
            drift = fmax(drift, fabs(bead_stepper_energy(s, &s->end) / energy - 1));
        }
        assert_below(peak_error(bead_peaks_found(peaks), &reference), cases[i].peaks);
        assert_below(drift, i == 0 ? 3e-11 : 1e-11);
        bead_peaks_destroy(peaks);
        drop(&x, s);
        free(reference.value);
    }
}

/* Bead forces, means of two contacts', have their maxima where one of the contacts may have a kink. */
static void peaks_of_beads(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0.443);
    struct bead_stepper *s[2];
    struct bead_peaks *peaks[2];
    for (int i = 0; i < 2; i++) {
        struct bead_message msg = {""};
        s[i] = make_stepper(&x, "rkn8", NULL, false);
        assert_int_equal(bead_peaks_create(s[i], true, (struct bead_span){0, SIZE_MAX}, &peaks[i], &msg), BEAD_OK);
        while (s[i]->t1 < 0.9e-3 - 1e-7) {
            steps(s[i], i ? 0.5e-6 : 4e-6, 1);
            bead_peaks_step(peaks[i], s[i], 0.9e-3);
        }
    }
    for (size_t j = 0; j < 40; j++) {
        const struct bead_peak *coarse = bead_peaks_found(peaks[0]) + j, *fine = bead_peaks_found(peaks[1]) + j;
        assert_near(coarse->value / fine->value, 1, 3e-8);
        assert_near(coarse->time, fine->time, 1e-10);
    }
    for (int i = 0; i < 2; i++) {
        bead_peaks_destroy(peaks[i]);
        drop(i ? &x : NULL, s[i]);
    }
}

/* Beta function: 2 d/v times the integral of (1 - x^{p+1})^{-1/2} is B(1/(p+1), 1/2) 2 d/((p+1) v). */
static double duration(double p, double stiffness, double mass, double velocity)
{
    double q = 1 / (p + 1), d = pow((p + 1) * mass * velocity * velocity / (2 * stiffness), q);
    return 2 * d / velocity * q * tgamma(q) * tgamma(0.5) / tgamma(q + 0.5);
}

/* Two beads part with the velocities of an elastic collision, after the time that quadrature of the energy gives. The first contact
 * happens at t = 0, at the very start of a step. */
static void check_collision(size_t bead, enum bead_law_kind kind, double power, double steps_each, double accuracy)
{
    struct setup x;
    describe(&x, 1, bead, bead, 1, NULL, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    x.spec.law = (struct bead_law_spec){
        .kind = kind, .power = power, .coefficient = kind == BEAD_LAW_POWER ? 3e9 * pow(1e-6, 1.5 - power) : 0};
    make(&x);
    double m = materials[STEEL].mass, n = materials[bead].mass, v = x.spec.striker_velocity;
    double time = duration(power, x.chain->stiffness[0], m * n / (m + n), v), h = time / steps_each;
    struct bead_stepper *s = run(&x, "rkn8", h, 1.1 * time);
    assert_near(s->end.v[0] / v, (m - n) / (m + n), accuracy);
    assert_near(s->end.v[1] / v, 2 * m / (m + n), accuracy);
    double parted = s->t1 - (s->end.u[1] - s->end.u[0]) / (s->end.v[1] - s->end.v[0]);
    assert_near(parted / time, 1, 3 * accuracy);
    drop(&x, s);
}

static void two_beads_collide_exactly(void **state)
{
    (void)state;
    assert_near(duration(1.5, 1, 1, 1) / pow(1.25, 0.4), 2.9433, 1e-4);
    check_collision(STEEL, BEAD_LAW_HERTZ, 1.5, 50.3, 1e-13);
    check_collision(ALUMINIUM, BEAD_LAW_HERTZ, 1.5, 61.3, 1e-13);
    check_collision(LIGHT, BEAD_LAW_HERTZ, 1.5, 61.7, 1e-13);
}

static void other_powers_collide(void **state)
{
    (void)state;
    check_collision(STEEL, BEAD_LAW_POWER, 1.5, 50.3, 1e-13);
    check_collision(ALUMINIUM, BEAD_LAW_POWER, 2, 50.3, 1e-12);
    check_collision(STEEL, BEAD_LAW_POWER, 5.0 / 3, 50.3, 1e-12);
    check_collision(STEEL, BEAD_LAW_POWER, 1.4, 50.3, 1e-12);
    check_collision(STEEL, BEAD_LAW_POWER, 1.25, 50.3, 1e-12);
    check_collision(ALUMINIUM, BEAD_LAW_POWER, 3, 50.3, 1e-12);
    check_collision(STEEL, BEAD_LAW_POWER, 1, 50.3, 1e-11);
    check_collision(STEEL, BEAD_LAW_POWER, 1.3717, 50.3, 1e-9);
}

static void momentum_is_kept(void **state)
{
    (void)state;
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 64, P3_SPINS, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    make(&x);
    struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
    double momentum = bead_stepper_momentum(s, &s->end);
    steps(s, 3e-6, 1000);
    assert_near(bead_stepper_momentum(s, &s->end) / momentum, 1, 1e-13);
    drop(&x, s);
}

/* v x 32 is t / 2, u x 16: to the bit where steps are halved, but for numbers that nothing distinguishes from zero. */
static void scaling_is_exact(void **state)
{
    (void)state;
    struct setup x, y;
    make_problem(&x, 3, 0.443);
    make_problem(&y, 3, 32 * 0.443);
    struct bead_stepper *a = make_stepper(&x, "rkn8", NULL, false), *b = make_stepper(&y, "rkn8", NULL, false);
    for (int i = 0; i < 600; i++) {
        steps(a, 2.3e-6, 1);
        steps(b, 1.15e-6, 1);
        for (size_t j = 0; j < a->beads; j++) {
            if (fabs(a->end.u[j]) < 1e-250)
                continue;
            assert_true(16 * a->end.u[j] == b->end.u[j]);
            assert_true(32 * a->end.v[j] == b->end.v[j]);
        }
    }
    drop(&x, a);
    drop(&y, b);
}

/* Neither the window nor the instruction set changes a bit; with tolerances that leave most events to kinks, or to patches. */
static void bits_are_the_same(void **state)
{
    (void)state;
    static const char *const sets[] = {"sse2", "avx2", "avx512"};
    static const double tolerances[] = {1e-7, 1e-12};
    struct setup x;
    make_problem(&x, 3, 0.443);
    for (size_t t = 0; t < 2; t++) {
        struct bead_stepper *one = make_stepper(&x, "rkn8", NULL, false);
        one->event_tolerance = tolerances[t];
        steps(one, 4e-6, 225);
        for (size_t i = 0; i < 3; i++) {
            struct bead_stepper *other = make_stepper(&x, "rkn8", sets[i], true);
            if (!other)
                continue;
            other->event_tolerance = tolerances[t];
            steps(other, 4e-6, 225);
            assert_memory_equal(one->end.u, other->end.u, x.chain->beads * sizeof(double));
            assert_memory_equal(one->end.v, other->end.v, x.chain->beads * sizeof(double));
            assert_memory_equal(one->end.f, other->end.f, x.chain->beads * sizeof(double));
            drop(NULL, other);
        }
        drop(NULL, one);
    }
    drop(&x, NULL);
}

/* A long chain goes through the stages in tiles, a short one does not. With the same beads, all moving, they agree to the bit but
 * for what the short one's end has told its neighbours. */
static void tiles_change_no_bit(void **state)
{
    (void)state;
    enum { CELLS = 8000, PART = 1000, STEPS = 12, REACH = 10 * STEPS };
    struct setup x[2];
    struct bead_stepper *s[2];
    for (int i = 0; i < 2; i++) {
        describe(&x[i], 2, STEEL, ALUMINIUM, i ? PART : CELLS, NULL, 0.443);
        x[i].spec.wall = BEAD_WALL_NONE;
        make(&x[i]);
        s[i] = make_stepper(&x[i], "rkn8", NULL, true);
        s[i]->event_tolerance = 1e-8;
        for (size_t j = 0; j < s[i]->beads; j++)
            s[i]->end.v[j] = 0.1 * sin(1.7 * (double)j);
        bead_stepper_evaluate(s[i], s[i]->end.u, s[i]->end.v, s[i]->end.f, s[i]->end.a);
        steps(s[i], 4e-6, STEPS);
    }
    assert_memory_equal(s[0]->end.u, s[1]->end.u, (2 * PART - REACH) * sizeof(double));
    assert_memory_equal(s[0]->end.v, s[1]->end.v, (2 * PART - REACH) * sizeof(double));
    assert_memory_equal(s[0]->end.a, s[1]->end.a, (2 * PART - REACH) * sizeof(double));
    for (int i = 0; i < 2; i++)
        drop(&x[i], s[i]);
}

/* Velocities of P3 at 0.6 ms. */
static double error_with(const char *method, double tolerance)
{
    struct table reference = read_table("p3_states.csv", 4);
    struct setup x;
    make_problem(&x, 3, 0.443);
    struct bead_stepper *s = make_stepper(&x, method, NULL, false);
    s->event_tolerance = tolerance;
    steps(s, 4e-6, 150);
    double error = velocity_error(s, &reference, 0.6e-3);
    drop(&x, s);
    free(reference.value);
    return error;
}

/* Where kinks are enough for the tolerance they leave a hundredth of what contacts that open or close would do. */
static void kinks_are_put_right(void **state)
{
    (void)state;
    double plain = error_with("rkn8-plain", 0), kinks = error_with("rkn8", 3e-8), patches = error_with("rkn8", 1e-13);
    print_message("velocity errors: %.1e plain, %.1e kinks, %.1e patches\n", plain, kinks, patches);
    assert_below(kinks, 0.01 * plain);
    assert_below(patches, 0.7 * kinks);
}

/* A precompressed chain (on a slope, too) hit hard enough to open: errors against a run with finer steps. */
static void check_opening(double tilt)
{
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 32, P3_SPINS, 0.6);
    x.spec.precompression = 2;
    x.spec.tilt = tilt;
    make(&x);
    struct bead_stepper *fine = run(&x, "rkn8", 0.5e-6, 0.5e-3);
    double before = 0;
    size_t open = 0;
    for (size_t k = 0; k < x.chain->contacts; k++)
        open += x.chain->static_compression[k] + (fine->end.u[k] - fine->end.u[k + 1]) < 0;
    assert_true(open > 3);
    for (double h = 4e-6; h > 0.9e-6; h /= 2) {
        struct bead_stepper *s = run(&x, "rkn8", h, 0.5e-3);
        double error = difference(s, fine) / 0.6;
        if (before > 0)
            assert_below(error, fmax(before / 32, 1e-12));
        before = error;
        drop(NULL, s);
    }
    assert_below(before, 2e-12);
    drop(&x, fine);
}

static void precompressed_chains_open(void **state)
{
    (void)state;
    check_opening(0);
    check_opening(0.3);
}

/* Beads 1 and 2 part with a little force left between them while bead 0 pushes: contact 1 turns at `depth` times its compression,
 * below zero for depth < 0 (it opens and closes in one step). One step against 64 short ones. */
static double turning_error(const char *method, double depth)
{
    const double h = 1e-6, pushed = 2e-6;
    struct setup x;
    describe(&x, 1, STEEL, ALUMINIUM, 4, NULL, 0.443);
    x.cell[0] = ALUMINIUM;
    make(&x);
    double push = x.chain->stiffness[0] * pushed * sqrt(pushed) / materials[ALUMINIUM].mass; /* m/s^2 */
    double rate = 0.5 * push * h, turn = 0.5 * rate * rate / push;                           /* turns in the middle of the step */
    struct bead_stepper *s[2] = {make_stepper(&x, method, NULL, true), make_stepper(&x, "rkn8", NULL, true)};
    for (int i = 0; i < 2; i++) {
        double *u = s[i]->end.u, *v = s[i]->end.v;
        u[0] = pushed;
        u[2] = -turn * (1 + depth);
        u[3] = u[4] = 1e-6; /* out of reach of bead 2 */
        v[0] = 0;
        v[2] = rate;
        bead_stepper_evaluate(s[i], u, v, s[i]->end.f, s[i]->end.a);
        steps(s[i], i ? h / 64 : h, i ? 64 : 1);
    }
    double error = difference(s[0], s[1]) / rate;
    drop(NULL, s[0]);
    drop(&x, s[1]);
    return error;
}

static void grazing_contacts(void **state)
{
    (void)state;
    static const double depths[] = {-0.5, -0.1, -1e-3, 0, 1e-3, 0.1};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        assert_below(turning_error("rkn8", depths[i]), 3e-11);
        assert_true(turning_error("rkn8", depths[i]) < 0.01 * turning_error("rkn8-plain", depths[i]));
    }
}

/* Four hundred contacts that close in one step: more than one patch may hold. */
static void all_contacts_at_once(void **state)
{
    (void)state;
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 200, NULL, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    make(&x);
    struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, true);
    for (size_t j = 0; j < x.chain->beads; j++) {
        s->end.u[j] = 1e-9 * (double)j;
        s->end.v[j] = 0.01 * (200 - (double)j + 0.3 * sin((double)j));
    }
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    double energy = bead_stepper_energy(s, &s->end), momentum = bead_stepper_momentum(s, &s->end);
    steps(s, 1e-6, 300);
    assert_near(bead_stepper_energy(s, &s->end) / energy, 1, 1e-9);
    assert_near(bead_stepper_momentum(s, &s->end) / momentum, 1, 1e-10); /* the sum itself loses digits: the beads move both ways */
    drop(&x, s);
}

/* Branch points of a contact with known compression: d = sign (s - a)(s - b). */
static size_t branches(double a, double b, double sign, struct bead_patch_branch *branch)
{
    const double c[6] = {sign * a * b, -sign * (a + b), sign}, end[2] = {sign * (1 - a) * (1 - b), sign * (2 - a - b)};
    return bead_patch_branches(c, end, 1, branch);
}

static void branch_points_are_found(void **state)
{
    (void)state;
    struct bead_patch_branch b[BEAD_BRANCHES_MAX];
    /* opens and closes in one step */
    assert_int_equal(branches(0.3, 0.8, 1, b), 2);
    assert_near(b[0].s, 0.3, 1e-6);
    assert_near(b[1].s, 0.8, 1e-6);
    assert_true(b[0].before && !b[0].after && !b[1].before && b[1].after);
    /* closes and opens in one step, even within a hundredth of it */
    assert_int_equal(branches(0.503, 0.513, -1, b), 2);
    assert_near(b[0].s, 0.503, 1e-6);
    assert_near(b[1].s, 0.513, 1e-6);
    assert_true(!b[0].before && b[0].after && b[1].before && !b[1].after);
    /* has closed before the step and opens in it; closes in it and opens behind it */
    assert_int_equal(branches(-0.2, 0.6, -1, b), 2);
    assert_near(b[0].s, -0.2, 1e-6);
    assert_near(b[1].s, 0.6, 1e-6);
    assert_int_equal(branches(0.4, 1.25, -1, b), 2);
    assert_near(b[0].s, 0.4, 1e-6);
    assert_near(b[1].s, 1.25, 1e-6);
    /* impact: touches at the start */
    assert_true(branches(0, 3, -1, b) >= 1);
    assert_near(b[0].s, 0, 1e-12);
    assert_true(b[0].after && !b[0].before);
    /* stays open */
    assert_int_equal(branches(0.5, 0.5, -1, b), 0);
}

/* Contacts at rest, touching or open, cost nothing and stay exactly at rest. */
static void rest_is_untouched(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0);
    struct bead_stepper *s = run(&x, "rkn8", 2e-6, 0.1e-3);
    for (size_t j = 0; j < x.chain->beads; j++)
        assert_true(s->end.u[j] == 0 && s->end.v[j] == 0 && s->end.f[j] == 0);
    drop(&x, s);
}

/* The last Picard sweep's change is of the size of the errors that a third sweep would take away: small, and falling with the step.
 */
static void picard_changes_are_reported(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0.443);
    double worst[2] = {0};
    for (int i = 0; i < 2; i++) {
        struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
        for (size_t n = 0; n < (i ? 300 : 150); n++) {
            steps(s, i ? 2e-6 : 4e-6, 1);
            worst[i] = fmax(worst[i], s->event_change);
        }
        drop(NULL, s);
    }
    assert_true(worst[1] > 0);
    assert_below(worst[0], 1e-5 * 0.443);
    assert_below(worst[1], worst[0] / 16);
    drop(&x, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_is_restored),
        cmocka_unit_test(peaks_and_energy),
        cmocka_unit_test(peaks_of_beads),
        cmocka_unit_test(two_beads_collide_exactly),
        cmocka_unit_test(other_powers_collide),
        cmocka_unit_test(tiles_change_no_bit),
        cmocka_unit_test(kinks_are_put_right),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(scaling_is_exact),
        cmocka_unit_test(bits_are_the_same),
        cmocka_unit_test(precompressed_chains_open),
        cmocka_unit_test(grazing_contacts),
        cmocka_unit_test(branch_points_are_found),
        cmocka_unit_test(all_contacts_at_once),
        cmocka_unit_test(rest_is_untouched),
        cmocka_unit_test(picard_changes_are_reported),
    };
    return cmocka_run_group_tests_name("events", tests, NULL, NULL);
}
