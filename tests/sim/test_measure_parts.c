/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the measures, for forces in closed form: where the chain repeats itself, means over cells, the end of a pulse. */
#include "support.h"

#include "sim/measure/measure_private.h"

static struct bead_places places_of(const char *beads)
{
    char text[512];
    snprintf(text, sizeof text, "chain: {beads: [%s]}\n", beads);
    struct built built = build(text, "until: 1 us");
    const struct bead_places places = bead_places_find(built.chain);
    release(&built);
    return places;
}

/* The stretch that repeats itself reaches up to the last bead: an end of another kind ends it, however long it was. */
static void the_tail_ends_with_the_chain(void **state)
{
    (void)state;
    struct bead_places p = places_of("{bead: large-steel, count: 60}");
    assert_true(p.regular && p.cell == 1 && p.regular_from == 1 && p.links == 60);
    p = places_of("{bead: large-steel, count: 59}, {bead: aluminium}");
    assert_true(!p.regular && p.cell == 1);
    p = places_of("{cell: [large-steel, aluminium], count: 30}");
    assert_true(p.regular && p.cell == 2 && p.regular_from == 1);
    p = places_of("{cell: [large-steel, aluminium], count: 30}, {bead: aluminium}");
    assert_true(!p.regular);
    p = places_of("{cell: [large-steel, aluminium], count: 30}, {bead: large-steel}");
    assert_true(p.regular && p.cell == 2);
    /* Forty other beads before ten dimers. */
    p = places_of("{bead: brass, count: 40, mass: 4 g, radius: 4.76 mm}, {cell: [large-steel, aluminium], count: 10}");
    assert_true(p.regular && p.cell == 2 && p.regular_from == 41 && p.probe == 44);
}

/* Behind `head` beads that all differ, a tail of `tail` beads of cells of `period`. */
static struct bead_places places_behind(size_t head, size_t tail, size_t period)
{
    static const char *const kinds[] = {"large-steel", "aluminium", "brass", "ptfe"};
    char text[4000];
    int used = snprintf(text, sizeof text, "chain: {beads: [");
    for (size_t i = 0; i < head; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "{bead: brass, mass: %zu mg}, ", 100 + i);
    for (size_t i = 0; i < tail; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "{bead: %s}%s", kinds[i % period], i + 1 < tail ? ", " : "]}\n");
    struct built built = build(text, "until: 1 us");
    const struct bead_places places = bead_places_find(built.chain);
    release(&built);
    return places;
}

/* A tail repeats itself if it has three cells, of which one is before the probe and one behind it, within the chain. */
static void tails_are_long_enough(void **state)
{
    (void)state;
    size_t regular = 0, many = 0;
    for (size_t head = 1; head <= 31; head += 3) {
        for (size_t n = 0; n < 4 * 22; n++) {
            const size_t period = 1 + n % 4, tail = period + n / 4, last = head + tail, margin = last / 4 < 20 ? last / 4 : 20;
            const size_t probe = last - 1 - margin, first = head + 1;
            const bool is = tail >= 3 * period && probe >= first + period && probe + period <= last - 1;
            const struct bead_places found = places_behind(head, tail, period);
            if (found.regular != is || found.probe != probe || (is && (found.cell != period || found.regular_from != first)))
                fail_msg("%zu beads of cells of %zu behind %zu: cells of %zu from %zu, at %zu", tail, period, head, found.cell,
                         found.regular_from, found.probe);
            regular += is;
            many++;
        }
    }
    assert_true(regular > many / 4 && regular < many * 3 / 4);
}

/* Forces whose means over cells of two fall exactly by exp(-rate), while each cell's two differ, the other way round in every
 * second cell: the mean of one contact and that of the cell before would scatter by a tenth. */
static void decay_is_that_of_the_mean_over_cells(void **state)
{
    (void)state;
    static const double rate = 2.5e-3;
    struct built built = build("chain: {beads: [{cell: [large-steel, aluminium], count: 60}]}\n", "until: 1 us");
    struct bead_message msg = {""};
    struct bead_measures *m;
    assert_int_equal(bead_measures_create(built.chain, false, &m, &msg), BEAD_OK);
    enum { MARGIN = 5 }; /* contacts left out at the beginning: cells are counted from there */
    for (size_t k = 0; k < bead_chain_contacts(built.chain); k++) {
        const size_t cell = (k + 2 - MARGIN % 2) / 2, first = (k + 2 - MARGIN % 2) % 2 == 0;
        const double differ = (cell % 2 ? 0.1 : -0.1) * (first ? 1 : -1);
        m->pulses->track[k].count = 1;
        m->pulses->track[k].pulse[0] = (struct bead_pulse){10 * exp(-rate * 2 * (double)cell) * (1 + differ), 1e-5 * (double)k};
    }
    const struct bead_decay_found found = bead_decay_find(m, NULL);
    assert_near(found.rate, rate, 1e-13);
    assert_below(found.error, 1e-12);
    assert_true(found.seen && found.first >= MARGIN && (found.first - MARGIN) % 2 == 0);
    bead_measures_destroy(m);
    release(&built);
}

/* A trace at the probe of two bells, `apart` in units of their width. */
static struct bead_pulse_found two_bells(const struct built *built, double second, double apart)
{
    enum { COUNT = 1200 };
    static const double spacing = 1e-7, width = 5e-6;
    struct bead_message msg = {""};
    struct bead_measures *m;
    assert_int_equal(bead_measures_create(built->chain, false, &m, &msg), BEAD_OK);
    const size_t beads = bead_chain_beads(built->chain), probe = m->places.probe;
    double *zeros = calloc(beads, sizeof *zeros), *force = calloc(beads, sizeof *force);
    struct bead_sample sample = {.active = beads};
    for (int f = 0; f < BEAD_FIELD_STRAIN; f++)
        sample.field[f] = zeros;
    sample.field[BEAD_FIELD_CONTACT_FORCE] = force;
    for (size_t i = 0; i < COUNT; i++) {
        sample.time = spacing * (double)i;
        const double x = sample.time / width - 6;
        force[probe] = 20 * (exp(-x * x) + second * exp(-(x - apart) * (x - apart)));
        force[probe + 1] = force[probe]; /* the trace lasts three times its rise beyond this one's maximum */
        assert_int_equal(bead_measures_feed(m, &sample, &msg), BEAD_OK);
    }
    const struct bead_pulse_found found = bead_trace_read(m);
    bead_measures_destroy(m);
    free(zeros);
    free(force);
    return found;
}

/* The momentum, in sqrt(pi) w F, of two bells up to the minimum between them, by bisection and in closed form. */
static double momentum_before(double second, double apart)
{
    double low = 0, high = apart;
    while (high - low > 1e-14) {
        const double x = 0.5 * (low + high), slope = -x * exp(-x * x) - second * (x - apart) * exp(-(x - apart) * (x - apart));
        *(slope < 0 ? &low : &high) = x;
    }
    return 0.5 * (1 + erf(low) + second * (1 + erf(low - apart)));
}

/* Momentum is the integral of the force over the pulse, sqrt(pi) w F for a bell. The pulse lasts to the first minimum below a
 * twentieth of its maximum: with a dip to .3 of it both bells are one pulse, with one to .0004 the first is a separate pulse. */
static void a_pulse_lasts_to_a_deep_minimum(void **state)
{
    (void)state;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 60}]}\n", "until: 1 us");
    const double bell = sqrt(acos(-1)) * 5e-6 * 20;
    struct bead_pulse_found found = two_bells(&built, 0.4, 2.4);
    assert_near(found.momentum, 1.4 * bell, 1e-6 * bell);
    assert_near(found.force, 20, 0.03 * 20);
    found = two_bells(&built, 0.2, 3.6); /* down to .034: a sum of whole samples would be off by up to 2e-4 */
    assert_near(found.momentum, momentum_before(0.2, 3.6) * bell, 1e-9 * bell);
    found = two_bells(&built, 0.4, 5.6);
    assert_near(found.momentum, bell, 2e-4 * bell);
    assert_near(found.force, 20, 1e-4 * 20);
    assert_near(found.force_time[0], 2 * 5e-6 * sqrt(log(2)), 1e-4 * 5e-6);
    assert_near(found.force_time[1], 2 * 5e-6 * sqrt(log(100)), 1e-3 * 5e-6);
    release(&built);
}

/* Bells of width `bell_width` that run along a chain of dimers, each contact `bell_later` widths after the one before. */
static const double bell_width = 5e-6 /* s */, bell_later = 0.9;
struct bells {
    double force[2], velocity[2]; /* N, m/s, of contacts and beads by turns, from the probe on */
};

static double bell(double x, double at)
{
    return exp(-(x - at) * (x - at));
}

/* The compression that a contact's force adds to its static one, m. */
static double compressed_by(const struct bead_chain *chain, size_t contact, double force)
{
    const double a = bead_chain_stiffness(chain)[contact], rest = bead_chain_static_force(chain)[contact];
    return pow((rest + force) / a, 2.0 / 3) - pow(rest / a, 2.0 / 3);
}

static struct bead_pulse_found running_bells(const struct built *built, const struct bells *bells, size_t *probe)
{
    enum { COUNT = 4000 };
    struct bead_message msg = {""};
    struct bead_measures *m;
    const struct bead_chain *chain = built->chain;
    assert_int_equal(bead_measures_create(chain, false, &m, &msg), BEAD_OK);
    const size_t beads = bead_chain_beads(chain), contacts = bead_chain_contacts(chain);
    double *field[3];
    struct bead_sample sample = {.active = beads};
    for (int f = 0; f < 3; f++)
        field[f] = calloc(beads + 1, sizeof *field[f]);
    for (int f = 0; f < BEAD_FIELD_STRAIN; f++)
        sample.field[f] = field[0];
    sample.field[BEAD_FIELD_CONTACT_FORCE] = field[0];
    sample.field[BEAD_FIELD_VELOCITY] = field[1];
    sample.field[BEAD_FIELD_DISPLACEMENT] = field[2];
    *probe = m->places.probe;
    for (size_t i = 0; i < COUNT; i++) {
        sample.time = 1e-7 * (double)i;
        const double x = sample.time / bell_width;
        for (size_t k = contacts; k-- > 0;) { /* displacements from the far end on: sums of compressions */
            const double now = bell(x, 6 + bell_later * (double)k);
            const size_t turn = (k + *probe) % 2;
            field[0][k] = bead_chain_static_force(chain)[k] + bells->force[turn] * now;
            field[1][k + 1] = bells->velocity[turn] * now;
            field[2][k] = field[2][k + 1] + compressed_by(chain, k, bells->force[turn] * now);
        }
        assert_int_equal(bead_measures_feed(m, &sample, &msg), BEAD_OK);
    }
    assert_int_equal(m->places.cell, 2);
    const struct bead_pulse_found found = bead_trace_read(m);
    bead_measures_destroy(m);
    for (int f = 0; f < 3; f++)
        free(field[f]);
    return found;
}

/* Energy of a contact with Hertz's law above its static state, integrated over the bell, J s. */
static double stored(const struct bead_chain *chain, size_t contact, double force)
{
    const double a = bead_chain_stiffness(chain)[contact], rest = bead_chain_static_force(chain)[contact],
                 d0 = pow(rest / a, 2.0 / 3);
    double sum = 0;
    for (double x = -8; x < 8; x += 0.01) {
        const double d = compressed_by(chain, contact, force * bell(x, 0));
        sum += 0.01 * bell_width * (0.4 * a * (pow(d0 + d, 2.5) - pow(d0, 2.5)) - rest * d);
    }
    return sum;
}

/* Measures of the bells agree with their parameters: integrals of squares of bells are sqrt(pi / 2) widths, the front runs one
 * contact in `bell_later` widths; of two beads and contacts the larger counts. Loads at rest have no effect. */
static void a_pulse_is_what_it_was_made_of(void **state)
{
    (void)state;
    static const struct bells kinds[] = {{{20, 24}, {0.3, 0.5}}, {{24, 20}, {0.5, 0.3}}};
    static const char *const loads[] = {"", ", precompression: 5 N, wall: rigid"};
    const double square = sqrt(acos(-1) / 2) * bell_width;
    for (size_t i = 0; i < 4; i++) {
        const struct bells *b = &kinds[i % 2];
        char text[200];
        snprintf(text, sizeof text, "chain: {beads: [{cell: [large-steel, aluminium], count: 30}]%s}\n", loads[i / 2]);
        struct built built = build(text, "until: 1 us");
        size_t probe;
        const struct bead_pulse_found found = running_bells(&built, b, &probe);
        const double *mass = bead_chain_mass(built.chain) + probe + 1, *position = bead_chain_position(built.chain) + probe;
        const size_t strong = b->force[1] > b->force[0];
        assert_near(found.momentum, sqrt(acos(-1)) * bell_width * b->force[0], 1e-9 * found.momentum);
        assert_near(found.energy, square * b->force[0] * b->velocity[0], 1e-9 * found.energy);
        assert_near(found.kinetic, square * 0.5 * (mass[0] * pow(b->velocity[0], 2) + mass[1] * pow(b->velocity[1], 2)),
                    1e-9 * found.kinetic);
        assert_near(found.potential, stored(built.chain, probe, b->force[0]) + stored(built.chain, probe + 1, b->force[1]),
                    1e-8 * found.potential);
        assert_near(found.force, 24, 1e-6);
        assert_near(found.compression, compressed_by(built.chain, probe + strong, 24), 1e-6 * found.compression);
        assert_near(found.velocity, 0.5, 1e-7);
        for (int level = 0; level < 2; level++) {
            const double width = 2 * bell_width * sqrt(log(level ? 100 : 2));
            assert_near(found.force_time[level], width, 1e-4 * width);
            assert_near(found.velocity_time[level], width, 1e-4 * width);
        }
        double both = 0;
        for (double x = 0; x < bell_later; x += 1e-4)
            both = fmax(both, 0.5 * (20 * bell(x, 0) + 24 * bell(x, bell_later)));
        assert_near(found.bead_force, both, 1e-6 * both);
        assert_near(found.beads_per_second, 1 / (bell_later * bell_width), 1e-6 * found.beads_per_second);
        assert_near(found.speed, (position[2] - position[0]) / (2 * bell_later * bell_width), 1e-6 * found.speed);
        release(&built);
    }
}

/* A measure is as uncertain as that of the same name in the check run differs; of one that is not there nothing is known. */
static void measures_are_checked_by_name(void **state)
{
    (void)state;
    const struct bead_measure checks[] = {{.name = "a", .value = 1}, {.name = "b", .value = 2.5}, {.name = "c", .value = 3}};
    const struct bead_measure measures[] = {{.name = "b", .value = 2}, {.name = "c", .value = 3}, {.name = "d", .value = 4}};
    const double known = bead_measure_uncertainty(&measures[0], checks, 2);
    assert_true(known >= 0.5 && known < 10);
    assert_near(bead_measure_uncertainty(&measures[1], checks, 3), 0, 1e-12);
    assert_true(isnan(bead_measure_uncertainty(&measures[1], checks, 2)));
    assert_true(isnan(bead_measure_uncertainty(&measures[2], checks, 3)));
}

/* Forces that rise and fall between HUMPS maxima and the minima before, between and after them, by half a cosine each. */
enum { HUMPS = 9, HALF = 24, TRAINS = 40 };

struct train {
    double top[HUMPS], dip[HUMPS + 1]; /* N; the dips before the first and behind the last are 0 */
};

static double random_of(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 40) / 0x1p24;
}

static struct train draw_train(uint64_t *state)
{
    struct train t = {.dip = {0}};
    for (int i = 0; i < HUMPS; i++)
        t.top[i] = pow(10, -3 * random_of(state) * random_of(state));
    for (int i = 1; i < HUMPS; i++)
        t.dip[i] =
            fmin(t.top[i - 1], t.top[i]) * (random_of(state) < 0.5 ? 0.09 * random_of(state) : 0.11 + 0.8 * random_of(state));
    return t;
}

static double force_of_train(const struct train *t, size_t index)
{
    const size_t half = index / HALF, hump = half / 2;
    if (hump >= HUMPS)
        return 0;
    const double part = 0.5 - 0.5 * cos(M_PI * (double)(index % HALF) / HALF);
    const double from = half % 2 ? t->top[hump] : t->dip[hump], to = half % 2 ? t->dip[hump + 1] : t->top[hump];
    return from + part * (to - from);
}

/* A pulse is a maximum before and behind which the force falls to a tenth of it, or of a neighbour that is lower. */
static void assert_pulses(const struct bead_track *track, const struct train *t)
{
    size_t count = 0, best[HUMPS];
    double low = 0;
    for (size_t i = 0; i < HUMPS; i++) {
        low = fmin(low, t->dip[i]);
        const bool same = count > 0 && low > 0.1 * fmin(t->top[best[count - 1]], t->top[i]);
        if ((same && t->top[i] <= t->top[best[count - 1]]) || (count > 0 && t->top[i] < 5e-3 * t->top[best[0]]))
            continue;
        if (!same && count == BEAD_PULSES)
            continue;
        best[same ? count - 1 : count++] = i;
        low = INFINITY;
    }
    assert_int_equal(track->count, count);
    for (size_t n = 0; n < count; n++) {
        assert_near(track->pulse[n].force, t->top[best[n]], 2e-4 * t->top[best[n]]);
        assert_near(track->pulse[n].time, (double)((2 * best[n] + 1) * HALF),
                    0.25); /* measured: 0.2 of a sample; the bend of the force jumps there */
    }
    assert_true(track->late.force == 0);
}

static void pulses_are_apart_where_the_force_falls(void **)
{
    uint64_t state = 1;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 8}]}\n", "until: 1 us");
    for (int n = 0; n < TRAINS; n++) {
        struct bead_message msg = {""};
        struct bead_pulses *pulses;
        struct train train[8];
        double force[8];
        if (bead_pulses_create(built.chain, 6, &pulses, &msg))
            fail_msg("%s", msg.text);
        for (int k = 0; k < 8; k++)
            train[k] = draw_train(&state);
        for (size_t i = 0; i <= 2 * HUMPS * HALF; i++) {
            for (int k = 0; k < 8; k++)
                force[k] = force_of_train(&train[k], i);
            bead_pulses_feed(pulses,
                             &(struct bead_sample){.time = (double)i, .active = 9, .field[BEAD_FIELD_CONTACT_FORCE] = force});
        }
        bead_pulses_end(pulses);
        for (int k = 0; k < 8; k++)
            assert_pulses(&pulses->track[k], &train[k]);
        bead_pulses_destroy(pulses);
    }
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tail_ends_with_the_chain),          cmocka_unit_test(tails_are_long_enough),
        cmocka_unit_test(measures_are_checked_by_name),          cmocka_unit_test(decay_is_that_of_the_mean_over_cells),
        cmocka_unit_test(a_pulse_lasts_to_a_deep_minimum),       cmocka_unit_test(a_pulse_is_what_it_was_made_of),
        cmocka_unit_test(pulses_are_apart_where_the_force_falls)};
    return cmocka_run_group_tests_name("measure_parts", tests, NULL, NULL);
}
