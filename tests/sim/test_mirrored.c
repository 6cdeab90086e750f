/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No law here knows left from right: the mirror image of a chain, struck from the other side, does the same in the mirror, as well
 * as is asked for; with damping, gaps, springs, unlike beads. */
#include "support.h"

#define MATERIALS                                                                                                               \
    "materials: {heavy: {mass: 8 g, radius: 6 mm, modulus: 70 GPa, poisson: 0.3}, light: {mass: 0.2 g, radius: 2 mm, modulus: " \
    "200 GPa, poisson: 0.2}, soft: {mass: 1 g, radius: 5 mm, modulus: 1.5 GPa, poisson: 0.45}}\n"
enum { BEADS_MOST = 12, TIMES = 24 };

/* A mirror image adds the forces of both contacts of a bead in the other order, and collisions make more of such roundings. Ends of
 * contacts whose damping depends on their compression are found as well as the run asks for. Bounds are ten times what was
 * measured. */
static const struct {
    const char *keys;
    double bound;
    const char *bead[BEADS_MOST];
    size_t gap; /* of 2 um to the left of this bead; 0: none */
} chains[] = {
    {"", 1e-10, {"heavy", "light", "heavy", "soft", "light", "light", "heavy"}, 0},
    {"", 1e-10, {"heavy", "light", "heavy", "light", "soft", "light", "heavy"}, 4},
    {"precompression: 20 N, ", 1e-10, {"heavy", "light", "heavy", "soft", "light", "light", "heavy"}, 0},
    {"damping: {coefficient: 2, exponent: 1}, ", 1e-10, {"heavy", "light", "heavy", "soft", "light", "light", "heavy"}, 0},
    {"damping: {coefficient: 5, exponent: 1.5}, ", 1e-10, {"soft", "light", "heavy", "soft", "light", "heavy", "heavy"}, 3},
    {"damping: {coefficient: 1, exponent: 0.7}, ", 1e-10, {"heavy", "light", "heavy", "light", "heavy"}, 0},
    {"damping: {coefficient: 1e5, exponent: 1, compression: 0.5}, ",
     2e-8,
     {"heavy", "light", "heavy", "light", "heavy", "light"},
     0},
    {"law: {power: 2.5, coefficient: 1e12}, ",
     1e-10,
     {"heavy", "light, spring: 1e6", "heavy", "soft", "light, spring: 1e5", "light"},
     0},
    {"law: {fpu-alpha: 1e3, stiffness: 1e7}, damping: {coefficient: 1, exponent: 1.2}, ",
     1e-10,
     {"heavy", "light", "heavy, spring: 1e6", "soft", "light", "light"},
     0},
};
static const char *const simulated[] = {"accuracy: 1e-5", "accuracy: 1e-8", "method: rk4, step: 0.5 us"};

/* The chain, struck at its first bead, or its mirror image, struck at its last; besides, all beads may move with a velocity. */
static struct built build_chain(size_t c, bool mirrored, double velocity, const char *simulate)
{
    char text[2000], with[100];
    size_t count = 0;
    while (count < BEADS_MOST && chains[c].bead[count])
        count++;
    const size_t gap = !chains[c].gap ? SIZE_MAX : mirrored ? count - chains[c].gap : chains[c].gap;
    int used = snprintf(text, sizeof text, MATERIALS "chain: {%sstriker: {bead: %s}, start: [", chains[c].keys,
                        mirrored ? "soft" : "heavy");
    if (mirrored)
        used += snprintf(text + used, sizeof text - (size_t)used, "{bead: last, velocity: -1 m/s}], beads: [");
    else
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "{bead: 0, velocity: %g m/s}, {bead: [1, last], velocity: %g m/s}], beads: [", 1 + velocity, velocity);
    for (size_t i = 0; i < count; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "{bead: %s%s}, ", chains[c].bead[mirrored ? count - 1 - i : i],
                         i == gap ? ", gap: 2 um" : "");
    snprintf(text + used, sizeof text - (size_t)used, "{bead: %s}]}\n", mirrored ? "heavy" : "soft");
    snprintf(with, sizeof with, "until: 0.5 ms, %s", simulate);
    return build(text, with);
}

static double largest(const double *x, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

/* How much samples of all fields differ, as parts of the largest value of each. */
static double samples_differ(const struct bead_sample *one, const struct bead_sample *other, size_t beads)
{
    static const struct {
        enum bead_field field;
        double sign;
    } fields[] = {{BEAD_FIELD_DISPLACEMENT, -1}, {BEAD_FIELD_VELOCITY, -1},   {BEAD_FIELD_FORCE, 1},
                  {BEAD_FIELD_CONTACT_FORCE, 1}, {BEAD_FIELD_COMPRESSION, 1}, {BEAD_FIELD_ENERGY, 1}};
    double worst = 0;
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const double *x = one->field[fields[f].field], *y = other->field[fields[f].field];
        const size_t count = beads - bead_field_info(fields[f].field)->of_contacts;
        for (size_t j = 0; j < count; j++)
            worst = fmax(worst, fabs(x[j] - fields[f].sign * y[count - 1 - j]) / largest(x, count));
    }
    return worst;
}

static double peaks_differ(const struct bead_peak *one, const struct bead_peak *other, size_t count)
{
    double worst = 0;
    for (size_t j = 0; j < count; j++) {
        const struct bead_peak *a = &one[j], *b = &other[count - 1 - j];
        assert_int_equal(a->open, b->open);
        assert_int_equal(a->exceeded, b->exceeded);
        worst = fmax(worst, fabs(a->value / b->value - 1));
        /* a time is known only to the root of the error of its maximum, which is flat */
        if (!a->open)
            worst = fmax(worst, (a->time / b->time - 1) * (a->time / b->time - 1));
    }
    return worst;
}

static void mirror_images_do_the_same(void **)
{
    for (size_t n = 0; n < 3 * sizeof chains / sizeof *chains; n++) {
        const struct bead_run_settings settings = {.end = 0.5e-3, .contact_peaks = true, .bead_peaks = true, .budget = true};
        struct built here = build_chain(n / 3, false, 0, simulated[n % 3]), there = build_chain(n / 3, true, 0, simulated[n % 3]);
        struct bead_run *a = start_run(&here, settings), *b = start_run(&there, settings);
        const size_t beads = bead_chain_beads(here.chain);
        struct bead_outcome one, other;
        double worst = 0;
        for (int i = 1; i <= TIMES; i++) {
            const double time = i * 0.5e-3 / TIMES;
            run_until(a, time);
            run_until(b, time);
            const struct bead_sample x = sample_at(a, time), y = sample_at(b, time);
            worst = fmax(worst, samples_differ(&x, &y, beads));
            worst = fmax(worst, fabs(x.budget->dissipated - y.budget->dissipated) / x.budget->kinetic);
        }
        bead_run_finish(a, 0.5e-3, &one);
        bead_run_finish(b, 0.5e-3, &other);
        const double peaks = fmax(peaks_differ(one.contact_peaks, other.contact_peaks, beads - 1),
                                  peaks_differ(one.bead_peaks, other.bead_peaks, beads));
        if (!(fmax(worst, peaks) < chains[n / 3].bound))
            fail_msg("chain %zu, %s: its mirror image differs by %.2e, its peaks by %.2e", n / 3, simulated[n % 3], worst, peaks);
        bead_run_destroy(a);
        bead_run_destroy(b);
        release(&here);
        release(&there);
    }
}

/* Nor is there a place or a velocity of its own: chains that move as a whole do the same. */
static void chains_that_move_do_the_same(void **)
{
    static const double velocity = 0.5, end = 0.5e-3;
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct built still = build_chain(c, false, 0, "accuracy: 1e-9"), moving = build_chain(c, false, velocity, "accuracy: 1e-9");
        struct bead_run *a = start_run(&still, (struct bead_run_settings){.end = end});
        struct bead_run *b = start_run(&moving, (struct bead_run_settings){.end = end});
        const size_t beads = bead_chain_beads(still.chain);
        double worst = 0;
        for (int i = 1; i <= TIMES && !strstr(chains[c].bead[1], "spring") && !strstr(chains[c].bead[2], "spring"); i++) {
            const double time = i * end / TIMES;
            run_until(a, time);
            run_until(b, time);
            const struct bead_sample x = sample_at(a, time), y = sample_at(b, time);
            const double *u = x.field[BEAD_FIELD_DISPLACEMENT], *v = x.field[BEAD_FIELD_VELOCITY], *f = x.field[BEAD_FIELD_FORCE];
            for (size_t j = 0; j < beads; j++) {
                worst = fmax(worst, fabs(y.field[BEAD_FIELD_DISPLACEMENT][j] - velocity * time - u[j]) / largest(u, beads));
                worst = fmax(worst, fabs(y.field[BEAD_FIELD_VELOCITY][j] - velocity - v[j]) / largest(v, beads));
                worst = fmax(worst, fabs(y.field[BEAD_FIELD_FORCE][j] - f[j]) / largest(f, beads));
            }
        }
        assert_below(worst, 1e-7); /* ten times what was measured */
        bead_run_destroy(a);
        bead_run_destroy(b);
        release(&still);
        release(&moving);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mirror_images_do_the_same), cmocka_unit_test(chains_that_move_do_the_same)};
    return cmocka_run_group_tests_name("mirrored", tests, NULL, NULL);
}
