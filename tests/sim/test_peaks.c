/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of forces against the forces themselves: the largest of many samples within each step of the run. */
#include "support.h"

enum { SAMPLES = 48 /* of a step */, MOST_BEADS = 64 };

/* What samples say of one force. */
struct sampled {
    double largest, time; /* N, s: of the run up to its limit */
    double best, rival;   /* N: largest maximum, and the last other one of at least half of it; rival NaN: none */
    double second;        /* N: the largest other one; 0: none */
    double best_time;     /* s; of a maximum within the run, else 0 */
    double last[2];       /* N, the samples before */
    double rest;          /* N */
};

/* Before the front, rounding has its own maxima. */
static void take(struct sampled *s, double force, double time, double spacing)
{
    const double middle = s->last[1];
    if (middle > s->last[0] && middle >= force && middle > s->rest + 1e-9) {
        if (middle > s->best) {
            s->rival = s->best_time > 0 ? s->best : s->rival;
            s->second = s->best_time > 0 ? s->best : s->second;
            s->best = middle;
            s->best_time = time - spacing;
        } else {
            s->rival = middle > 0.5 * s->best ? middle : s->rival;
            s->second = fmax(s->second, middle);
        }
    }
    if (force > s->largest) {
        s->largest = force;
        s->time = time;
    }
    s->last[0] = middle;
    s->last[1] = force;
}

struct all_sampled {
    struct sampled contact[MOST_BEADS], bead[MOST_BEADS];
    double spacing; /* s, the longest between samples */
};

/* Runs to the end, with samples from `from` to `until` s. */
static void watch(struct bead_run *run, const struct bead_chain *chain, double from, double until, struct all_sampled *all)
{
    const size_t beads = bead_chain_beads(chain), contacts = bead_chain_contacts(chain);
    struct bead_message msg = {""};
    assert_true(beads <= MOST_BEADS);
    for (double t0 = 0; bead_run_time(run) < until; t0 = bead_run_time(run)) {
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
        const double h = (bead_run_time(run) - t0) / SAMPLES;
        all->spacing = fmax(all->spacing, h);
        for (int i = 1; i <= SAMPLES && t0 + i * h <= until * (1 + 1e-12); i++) {
            const double t = i == SAMPLES ? bead_run_time(run) : t0 + i * h;
            const struct bead_sample sample = sample_at(run, t);
            if (t < from)
                continue;
            for (size_t k = 0; k < contacts; k++)
                take(&all->contact[k], sample.field[BEAD_FIELD_CONTACT_FORCE][k], t, h);
            for (size_t j = 0; j < beads; j++)
                take(&all->bead[j], sample.field[BEAD_FIELD_FORCE][j], t, h);
        }
    }
}

static void begin(struct all_sampled *all, const struct bead_chain *chain)
{
    const double *rest = bead_chain_static_force(chain);
    *all = (struct all_sampled){.spacing = 0};
    for (size_t k = 0; k < bead_chain_beads(chain); k++) {
        const double here = k < bead_chain_contacts(chain) ? rest[k] : 0, bead = 0.5 * ((k > 0 ? rest[k - 1] : 0) + here);
        all->contact[k] = (struct sampled){.largest = here, .best = here, .rival = NAN, .last = {here, here}, .rest = here};
        all->bead[k] = (struct sampled){.largest = bead, .best = bead, .rival = NAN, .last = {bead, bead}, .rest = bead};
    }
}

/* Between samples a force changes by less than this part: they are a fiftieth of a step apart, and a step is a part of the shortest
 * period. */
static const double between = 2e-4;

static void assert_peak(const struct bead_peak *peak, const struct sampled *sampled, double spacing, const char *what, size_t index)
{
    const double most = sampled->largest;
    if (!(peak->value > most * (1 - 1e-9) && peak->value <= most * (1 + between)))
        fail_msg("%s %zu: the peak is %.9g N, the largest sample %.9g", what, index, peak->value, most);
    if (most > 0 && !(fabs(peak->time - sampled->time) <= 1.001 * spacing))
        fail_msg("%s %zu: the peak is at %.9g s, the largest sample at %.9g", what, index, peak->time, sampled->time);
}

static const char *const chains[] = {
    "chain: {beads: [{cell: [large-steel, aluminium], spins: \"1011000101\"}], wall: brass}\n",
    "chain: {striker: {bead: small-steel, velocity: 1 m/s}, precompression: 10 N, wall: brass,\n"
    "  beads: [{cell: [large-steel, aluminium], count: 10}]}\n",
    "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, tilt: 8 deg, wall: rigid,\n"
    "  beads: [{bead: small-steel, count: 7}, {bead: large-steel, count: 8}]}\n",
    "chain: {striker: {bead: lead, velocity: 2 m/s}, beads: [{cell: [ptfe, large-steel, brass], spins: random, seed: 3, count: "
    "6}]}\n",
    /* all displacements are negative: */
    "chain: {precompression: 10 N, wall: rigid, start: [{bead: 17, velocity: -0.3 m/s}], beads: [{bead: large-steel, count: "
    "20}]}\n",
    /* a bead's force rises within a step, at whose ends it falls: one contact's rises as the other's falls */
    "materials:\n  a: {density: 14515, modulus: 16.1 GPa, poisson: 0.3, radius: 0.678 mm}\n"
    "  b: {density: 1663, modulus: 2.73 GPa, poisson: 0.3, radius: 1.45 mm}\n"
    "  c: {density: 7247, modulus: 3.25 GPa, poisson: 0.3, radius: 1.09 mm}\n"
    "chain: {striker: {bead: b, velocity: 0.5}, wall: rigid, beads: [{bead: b}, {bead: c}, {bead: b}, {bead: a}]}\n",
};
enum { SWINGING = sizeof chains / sizeof *chains - 1, CHAINS = SWINGING }; /* the last is for the first test */

/* No sample is larger than the peak, and the peak hardly larger than the largest; where a force still rises at the end, its peak is
 * the last sample. */
static void no_sample_is_larger(void **state)
{
    (void)state;
    static const double ends[] = {0.35e-3, 0.18e-3, 0.6e-3, 0.45e-3, 0.3e-3, 0.6e-3};
    size_t open = 0;
    for (size_t c = 0; c <= SWINGING; c++) {
        struct built built = build(chains[c], c < SWINGING ? "until: 1 ms" : "until: 1 ms, accuracy: 1e-4");
        struct bead_run *run =
            start_run(&built, (struct bead_run_settings){.end = ends[c], .contact_peaks = true, .bead_peaks = true});
        static struct all_sampled all;
        struct bead_outcome outcome;
        begin(&all, built.chain);
        watch(run, built.chain, 0, ends[c], &all);
        bead_run_finish(run, ends[c], &outcome);
        for (size_t k = 0; k < bead_chain_contacts(built.chain); k++) {
            assert_peak(&outcome.contact_peaks[k], &all.contact[k], all.spacing, "contact", k);
            const bool rises = all.contact[k].largest > 0 && all.contact[k].time > 0.999999 * ends[c];
            assert_int_equal(outcome.contact_peaks[k].open, rises);
            open += rises;
        }
        for (size_t j = 0; j < bead_chain_beads(built.chain); j++) {
            assert_peak(&outcome.bead_peaks[j], &all.bead[j], all.spacing, "bead", j);
            assert_int_equal(outcome.bead_peaks[j].open, all.bead[j].largest > 0 && all.bead[j].time > 0.999999 * ends[c]);
        }
        bead_run_destroy(run);
        release(&built);
    }
    assert_true(open >= 3);
}

/* The second maximum counts if it is a tenth lower at most, beyond the force at rest. */
static bool is_second(const struct sampled *s, const struct bead_peak *second)
{
    const double found = second->time > 0 ? second->value : 0, bar = s->rest + 0.9 * (s->best - s->rest);
    const double off = between * s->best;
    if (!(found == 0 || fabs(found - s->second) <= off) || (found > 0 ? found < bar - off : s->second > bar + off))
        fail_msg("the second maximum is %.9g N, not %.9g; the highest %.9g, at rest %.9g", found, s->second, s->best, s->rest);
    return found > 0;
}

/* The peak of each contact and bead, the last other maximum of half its height, and the second highest. */
static void peaks_and_rivals(void **state)
{
    (void)state;
    static const double end = 0.9e-3;
    size_t seconds = 0;
    for (size_t c = 0; c < CHAINS; c++) {
        struct built built = build(chains[c], "until: 1 ms");
        struct bead_run *run = start_run(
            &built,
            (struct bead_run_settings){.end = end, .contact_peaks = true, .bead_peaks = true, .rivals = true, .peaks_apart = 1e-9});
        static struct all_sampled all;
        struct bead_outcome outcome;
        begin(&all, built.chain);
        watch(run, built.chain, 0, end, &all);
        bead_run_finish(run, end, &outcome);
        for (int of_beads = 0; of_beads < 2; of_beads++) {
            const struct bead_peak *peaks = of_beads ? outcome.bead_peaks : outcome.contact_peaks;
            const struct bead_peak *rivals = bead_run_rivals(run, of_beads);
            const size_t count = of_beads ? bead_chain_beads(built.chain) : bead_chain_contacts(built.chain);
            const struct bead_peak *second = bead_run_second_peaks(run, of_beads);
            size_t rivalled = 0;
            for (size_t i = 0; i < count; i++) {
                const struct sampled *s = of_beads ? &all.bead[i] : &all.contact[i];
                if (peaks[i].open)
                    continue;
                if (!(fabs(peaks[i].value - s->best) <= between * s->best))
                    fail_msg("chain %zu, %d: peak %zu is %.9g N at %g s, not %.9g", c, of_beads, i, peaks[i].value, peaks[i].time,
                             s->best);
                const double wanted = isnan(s->rival) ? 0 : s->rival, rival = rivals[i].time > 0 ? rivals[i].value : 0;
                if (!(fabs(rival - wanted) <= between * s->best))
                    fail_msg("chain %zu, %d: the rival of %zu is %.9g N at %g s, not %.9g", c, of_beads, i, rival, rivals[i].time,
                             wanted);
                rivalled += wanted > 0;
                seconds += is_second(s, &second[i]);
            }
            assert_true(rivalled > 0);
        }
        bead_run_destroy(run);
        release(&built);
    }
    assert_true(seconds > 0);
}

/* Peaks of a span are those of the whole; outside of it nothing is searched. */
static void spans_are_part_of_the_whole(void **state)
{
    (void)state;
    static const double end = 0.5e-3;
    static const struct bead_span spans[] = {{0, SIZE_MAX}, {4, 9}, {7, 7}, {0, 0}, {1, 12}, {10, SIZE_MAX}};
    for (size_t c = 0; c < CHAINS; c++) {
        struct built built = build(chains[c], "until: 1 ms");
        const size_t beads = bead_chain_beads(built.chain), contacts = bead_chain_contacts(built.chain);
        const double *rest = bead_chain_static_force(built.chain);
        struct bead_peak whole[2][MOST_BEADS];
        for (size_t i = 0; i < sizeof spans / sizeof *spans; i++) {
            const struct bead_run_settings settings = {
                .end = end, .contact_peaks = true, .bead_peaks = true, .peak_span = i > 0 ? &spans[i] : NULL};
            struct bead_run *run = start_run(&built, settings);
            struct bead_outcome found;
            run_until(run, end);
            bead_run_finish(run, end, &found);
            if (i == 0) {
                memcpy(whole[0], found.contact_peaks, contacts * sizeof whole[0][0]);
                memcpy(whole[1], found.bead_peaks, beads * sizeof whole[0][0]);
            }
            for (size_t k = 0; k < beads; k++) {
                const bool within = k >= spans[i].first && k <= spans[i].last;
                const double still = 0.5 * ((k > 0 ? rest[k - 1] : 0) + (k < contacts ? rest[k] : 0));
                if (k < contacts)
                    assert_true(found.contact_peaks[k].value == (within ? whole[0][k].value : rest[k]));
                assert_true(found.bead_peaks[k].value == (within ? whole[1][k].value : still));
                assert_true(whole[1][k].value > still);
            }
            bead_run_destroy(run);
        }
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_sample_is_larger), cmocka_unit_test(peaks_and_rivals),
                                       cmocka_unit_test(spans_are_part_of_the_whole)};
    return cmocka_run_group_tests_name("peaks", tests, NULL, NULL);
}
