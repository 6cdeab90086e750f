/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The waves of drives: see drive.h. */
#include "sim/chain/drive.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/base/random.h"

static const double two_pi = 6.283185307179586;

/* sin p(t) and its derivatives, of a phase with p''' = 0. */
static struct bead_wave_at sine(double p, double p1, double p2)
{
    double c, s;
    bead_turn_to((struct bead_pair){p, 0}, &c, &s);
    return (struct bead_wave_at){{s, p1 * c, p2 * c - p1 * p1 * s, -3 * p1 * p2 * s - p1 * p1 * p1 * c}};
}

/* Noise is a uniform cubic B-spline with independent coefficients, one for each half period of the given frequency: its spectrum
 * falls as sinc^4 and is 0 at twice that frequency. The mean square of the spline is 151/315 of that of the coefficients, which are
 * uniform with variance 1: C. de Boor, A Practical Guide to Splines (Springer, 1978). */
enum { NOISE_DRAWS = 2000 };

static double coefficient(const struct bead_drive *drive, int64_t i)
{
    static const double root_three = 1.7320508075688772;
    const double uniform = ((double)(bead_draw(drive->seed, NOISE_DRAWS, (uint64_t)i) >> 11) + 0.5) * 0x1p-53;
    return sqrt(315. / 151) * root_three * (2 * uniform - 1);
}

static struct bead_wave_at noise(const struct bead_drive *drive, double t)
{
    const double rate = 2 * drive->frequency, at = floor(t * rate), y = t * rate - at, z = 1 - y;
    double c[4];
    for (int i = 0; i < 4; i++)
        c[i] = coefficient(drive, (int64_t)at + i);
    return (struct bead_wave_at){
        {(z * z * z * c[0] + (3 * y * y * y - 6 * y * y + 4) * c[1] + (3 * z * z * z - 6 * z * z + 4) * c[2] + y * y * y * c[3]) /
             6,
         rate * (-z * z * c[0] + (3 * y * y - 4 * y) * c[1] + (4 * z - 3 * z * z) * c[2] + y * y * c[3]) / 2,
         rate * rate * (z * c[0] + (3 * y - 2) * c[1] + (3 * z - 2) * c[2] + y * c[3]),
         rate * rate * rate * (c[3] - c[0] + 3 * (c[1] - c[2]))}};
}

/* By elimination: bend_i = bend[i] - work[i] bend_{i+1}. */
void bead_wave_spline(struct bead_wave_point *p, size_t count, double *work)
{
    for (size_t i = 0; i < count; i++) {
        const double h = i > 0 ? p[i].time - p[i - 1].time : 0, g = i + 1 < count ? p[i + 1].time - p[i].time : 0;
        const double before = i > 0 ? (p[i].value - p[i - 1].value) / h : 0, after = g > 0 ? (p[i + 1].value - p[i].value) / g : 0;
        const double pivot = 2 * (h + g) - (i > 0 ? h * work[i - 1] : 0);
        p[i].bend = (6 * (after - before) - (i > 0 ? h * p[i - 1].bend : 0)) / pivot;
        work[i] = g / pivot;
    }
    for (size_t i = count - 1; i-- > 0;)
        p[i].bend -= work[i] * p[i + 1].bend;
}

/* The first of the two points around t, the last but one behind them all. */
static size_t point_before(const struct bead_drive *drive, double t)
{
    size_t low = 0, high = drive->point_count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(drive->points[middle].time <= t ? &low : &high) = middle;
    }
    return low;
}

/* Before the first point, and behind the last, the wave stays as it is there. */
static struct bead_wave_at points(const struct bead_drive *drive, double t)
{
    const struct bead_wave_point *p = drive->points + point_before(drive, t), *last = drive->points + drive->point_count - 1;
    if (t < p->time || t >= last->time)
        return (struct bead_wave_at){{t < p->time ? p->value : last->value}};
    const double h = p[1].time - p->time, y = (t - p->time) / h, z = 1 - y, m0 = p->bend, m1 = p[1].bend;
    return (struct bead_wave_at){{z * p->value + y * p[1].value + ((z * z * z - z) * m0 + (y * y * y - y) * m1) * (h * h / 6),
                                  (p[1].value - p->value) / h + ((3 * y * y - 1) * m1 - (3 * z * z - 1) * m0) * (h / 6),
                                  z * m0 + y * m1, (m1 - m0) / h}};
}

/* Rises from 0 to 1 in the time of the ramp, with two derivatives that do not jump. */
static struct bead_wave_at ramp(double duration, double t)
{
    const double x = t / duration, y = 1 - x;
    if (!(x < 1))
        return (struct bead_wave_at){{1}};
    return (struct bead_wave_at){{x * x * x * (10 - 15 * x + 6 * x * x), 30 * x * x * y * y / duration,
                                  60 * x * y * (1 - 2 * x) / (duration * duration),
                                  60 * (1 - 6 * x * y) / (duration * duration * duration)}};
}

struct bead_wave_at bead_drive_at(const struct bead_chain *chain, double t)
{
    const struct bead_drive *drive = &chain->spec->drive;
    const enum bead_wave wave = drive->force ? drive->force : drive->displacement;
    const double w = two_pi * drive->frequency,
                 bend = wave == BEAD_WAVE_CHIRP ? two_pi * (drive->to - drive->frequency) / chain->scene->simulate.until : 0;
    const struct bead_wave_at f = wave == BEAD_WAVE_POINTS  ? points(drive, t)
                                  : wave == BEAD_WAVE_NOISE ? noise(drive, t)
                                                            : sine((w + 0.5 * bend * t) * t, w + bend * t, bend),
                              e = ramp(drive->ramp, t);
    struct bead_wave_at all = {{e.x[0] * f.x[0], e.x[1] * f.x[0] + e.x[0] * f.x[1],
                                e.x[2] * f.x[0] + 2 * e.x[1] * f.x[1] + e.x[0] * f.x[2],
                                e.x[3] * f.x[0] + 3 * (e.x[2] * f.x[1] + e.x[1] * f.x[2]) + e.x[0] * f.x[3]}};
    for (int i = 0; i < 4; i++)
        all.x[i] *= drive->amplitude;
    return all;
}

void bead_drive_acceleration(const struct bead_chain *chain, double t, double a[2])
{
    const struct bead_wave_at at = bead_drive_at(chain, t);
    const bool force = chain->spec->drive.force;
    const double scale = force ? 1 / chain->mass[chain->spec->drive.bead] : 1;
    a[0] = scale * at.x[force ? 0 : 2];
    a[1] = scale * at.x[force ? 1 : 3];
}

void bead_drive_apply(const struct bead_chain *chain, double t, int order, double *a)
{
    const size_t bead = chain->spec->drive.bead;
    double driven[2];
    bead_drive_acceleration(chain, t, driven);
    a[bead] = chain->spec->drive.displacement ? driven[order] : a[bead] + driven[order];
}

double bead_drive_break(const struct bead_chain *chain, double t)
{
    const struct bead_drive *drive = &chain->spec->drive;
    double next = drive->ramp > t ? drive->ramp : INFINITY;
    if (drive->force == BEAD_WAVE_NOISE || drive->displacement == BEAD_WAVE_NOISE) {
        const double rate = 2 * drive->frequency, knot = (floor(t * rate) + 1) / rate;
        next = fmin(next, knot > t ? knot : (floor(t * rate) + 2) / rate);
    }
    for (size_t i = drive->point_count > 0 ? point_before(drive, t) : 0; i < drive->point_count; i++) {
        if (drive->points[i].time > t)
            return fmin(next, drive->points[i].time);
    }
    return next;
}

double bead_drive_end(const struct bead_chain *chain, double t0, double t1)
{
    const double just = nextafter(t1, t0);
    return bead_drive_break(chain, just) <= t1 ? just : t1;
}

/* The second derivative of a ramp, 60 x y (1 - 2x), is nearly 2 pi sin 2 pi x. */
double bead_drive_omega(const struct bead_chain *chain, double t)
{
    const struct bead_drive *drive = &chain->spec->drive;
    const enum bead_wave wave = drive->force ? drive->force : drive->displacement;
    const bool waves = wave == BEAD_WAVE_SINE || wave == BEAD_WAVE_CHIRP;
    return two_pi * fmax(waves ? fmax(drive->frequency, drive->to) : 0, t < drive->ramp ? 1 / drive->ramp : 0);
}

double bead_drive_speed(const struct bead_chain *chain, double mass, double stiffness)
{
    const struct bead_drive *drive = &chain->spec->drive;
    const double low = two_pi * drive->frequency, high = two_pi * fmax(drive->frequency, drive->to);
    double most = 1, fastest = high, impulse = 1 / low;
    if (drive->point_count > 0)
        most = fastest = impulse = 0;
    for (size_t i = 0; i + 1 < drive->point_count; i++) {
        const struct bead_wave_point *p = drive->points + i;
        const double larger = fmax(fabs(p->value), fabs(p[1].value)), h = p[1].time - p->time;
        most = fmax(most, larger);
        fastest = fmax(fastest, fabs(p[1].value - p->value) / h);
        impulse += larger * h;
    }
    /* a ramp rises at 15/8 over its duration at most, to a value that only a sine has not had the time to reach */
    const enum bead_wave wave = drive->displacement;
    if (drive->ramp > 0 && (wave == BEAD_WAVE_NOISE || wave == BEAD_WAVE_POINTS))
        fastest = fmax(fastest, 15. / 8 * most / drive->ramp);
    if (drive->displacement)
        return drive->amplitude * fastest;
    /* A free bead, and one that compresses its contact with this force. */
    const struct bead_law *law = chain->law;
    const double d = law->compression(stiffness, &chain->spec->law, most * drive->amplitude);
    return fmin(drive->amplitude * impulse / mass, sqrt(2 * law->energy(stiffness, &chain->spec->law, d) / mass));
}
