/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The linear limit of precompressed chains: K = (3/2) A^{2/3} F0^{1/3}, omega = 2 sqrt(K/m) |sin(k/2)|; for dimers the edges of
 * bands sqrt(2K/M), sqrt(2K/m) and sqrt(2K(1/m + 1/M)), with nothing between the two bands. */
#include "support.h"

static const double pi = 3.14159265358979323846;

/* Half of 1 %, of every frequency. */
static const double within = 0.005;

/* Samples of all beads' displacements, equally spaced, of a chain that a weak hit on its left end shakes. */
struct record {
    size_t beads, count;
    double every, stiffness;
    double mass[2]; /* of beads 0 and 1 */
    double *u;      /* [count][beads] */
};

static struct record record(const char *chain, double every, size_t count)
{
    struct built built = build(chain, "until: 1 s, accuracy: 1e-5");
    struct record r = {.beads = bead_chain_beads(built.chain), .count = count, .every = every};
    double a = bead_chain_stiffness(built.chain)[0], force = bead_chain_static_force(built.chain)[0];
    r.stiffness = 1.5 * pow(a, 2. / 3) * cbrt(force);
    r.mass[0] = bead_chain_mass(built.chain)[0];
    r.mass[1] = bead_chain_mass(built.chain)[1];
    r.u = calloc(count * r.beads, sizeof *r.u);
    assert_non_null(r.u);
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 1});
    for (size_t i = 0; i < count; i++) {
        run_until(run, (double)i * every);
        struct bead_sample sample = sample_at(run, (double)i * every);
        memcpy(r.u + i * r.beads, sample.field[BEAD_FIELD_DISPLACEMENT], r.beads * sizeof *r.u);
    }
    bead_run_destroy(run);
    release(&built);
    return r;
}

/* Power at a frequency in a series, with a Hann window. */
static double power(const double *x, size_t count, size_t stride, double phase)
{
    double re = 0, im = 0, turn_c = cos(phase), turn_s = sin(phase), c = 1, s = 0;
    double step = 2 * pi / (double)(count - 1), step_c = cos(step), step_s = sin(step), wc = 1, ws = 0;
    for (size_t i = 0; i < count; i++) {
        double w = 0.5 - 0.5 * wc, next = c * turn_c - s * turn_s, next_w = wc * step_c - ws * step_s;
        ws = ws * step_c + wc * step_s;
        wc = next_w;
        re += w * x[i * stride] * c;
        im += w * x[i * stride] * s;
        s = s * turn_c + c * turn_s;
        c = next;
    }
    return re * re + im * im;
}

/* A uniform chain before a rigid wall of twice the stiffness, as a mirror image is: beads 0..n-1, free at the left, have the modes
 * cos(k (j + 1/2)) with k = pi (m + 1/2) / n. The motion in each is projected out, and its frequency found in its spectrum. */
static void uniform_chains_have_their_dispersion(void **state)
{
    (void)state;
    struct record r = record("chain: {striker: {velocity: 1 um/s}, beads: [{bead: large-steel, count: 39}], precompression: 100 N, "
                             "wall: rigid}\n",
                             4e-6, 3000);
    double *q = calloc(r.count, sizeof *q);
    assert_non_null(q);
    for (size_t m = 0; m < r.beads; m += 5) {
        double k = pi * ((double)m + 0.5) / (double)r.beads, omega = 2 * sqrt(r.stiffness / r.mass[0]) * sin(k / 2);
        for (size_t i = 0; i < r.count; i++) {
            q[i] = 0;
            for (size_t j = 0; j < r.beads; j++)
                q[i] += r.u[i * r.beads + j] * cos(k * ((double)j + 0.5));
        }
        double best = 0, found = 0;
        for (int step = -60; step <= 60; step++) {
            double trial = omega * (1 + (step + 0.37) * 0.001), p = power(q, r.count, 1, trial * r.every);
            found = p > best ? trial : found;
            best = p > best ? p : best;
        }
        assert_near(found / omega, 1, within);
    }
    free(q);
    free(r.u);
}

/* The outermost line of the spectrum in a direction from a frequency: the last of the peaks above a part of the highest. */
static double last_line(const struct record *r, double from, double to)
{
    enum { STEPS = 300 };
    double p[STEPS], highest = 0, found = NAN;
    for (int i = 0; i < STEPS; i++) {
        double omega = from + (to - from) * i / (STEPS - 1);
        p[i] = 0;
        for (size_t j = 0; j < r->beads; j += 3)
            p[i] += power(r->u + j, r->count, r->beads, omega * r->every);
        highest = fmax(highest, p[i]);
    }
    for (int i = 1; i + 1 < STEPS; i++) {
        if (p[i] > 1e-5 * highest && p[i] > p[i - 1] && p[i] >= p[i + 1])
            found = from + (to - from) * i / (STEPS - 1);
    }
    return found;
}

static void dimers_have_their_band_edges(void **state)
{
    (void)state;
    struct record r = record("chain: {striker: {velocity: 1 um/s}, beads: [{cell: [aluminium, large-steel], count: 30}], "
                             "precompression: 100 N}\n",
                             4e-6, 8192);
    double K = r.stiffness, M = r.mass[0], m = r.mass[1];
    double acoustic = sqrt(2 * K / M), optical = sqrt(2 * K / m), top = sqrt(2 * K * (1 / m + 1 / M));
    assert_true(M > m && top * r.every < pi);
    assert_near(last_line(&r, 0.9 * acoustic, 1.1 * acoustic) / acoustic, 1, within);
    assert_near(last_line(&r, 1.1 * optical, 0.9 * optical) / optical, 1, within);
    assert_near(last_line(&r, 0.9 * top, 1.1 * top) / top, 1, within);
    free(r.u);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_chains_have_their_dispersion),
        cmocka_unit_test(dimers_have_their_band_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
