/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the motion at the probe and at the striker, sample by sample, for measure_rows.c. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/law.h"
#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/measure/measure_private.h"

/* The trace begins when the probe's force exceeds this part of the largest so far, that of a struck probe with the run: before the
 * pulse rises, so that a curve goes through samples on both sides. It ends this many rise times, a choice, after the maximum of the
 * cell's last contact. */
static const double begin_part = 1e-12, tail_rises = 3;
/* A pulse rises from the first of these parts of its maximum, and ends with the first minimum below the second; both are chosen. */
static const double rise_part = 1e-10, end_part = 0.05;
/* Contacts on each side of the probe for the local speed, if no cell repeats there. */
enum { IRREGULAR = 10 };

void bead_trace_free(struct bead_trace *trace)
{
    free(trace->force[0]);
    *trace = (struct bead_trace){0};
}

/* All rows in one block of memory, `room` numbers each. */
static enum bead_error grow(struct bead_trace *t, struct bead_message *msg)
{
    enum { ROWS = 3 * BEAD_PLACE_PERIOD + 2 };
    size_t room = t->room ? 2 * t->room : 512;
    double *memory, *old = t->force[0];
    BEAD_TRY(bead_new(&memory, room * ROWS, msg, "the trace of a pulse"));
    for (size_t i = 0; old && i < ROWS; i++)
        memcpy(memory + i * room, old + i * t->room, t->count * sizeof *memory);
    free(old);
    t->room = room;
    for (size_t i = 0; i <= BEAD_PLACE_PERIOD; i++) {
        t->force[i] = memory + i * room;
        t->displacement[i] = memory + (BEAD_PLACE_PERIOD + 1 + i) * room;
        if (i < BEAD_PLACE_PERIOD)
            t->velocity[i] = memory + (2 * BEAD_PLACE_PERIOD + 2 + i) * room;
    }
    return BEAD_OK;
}

/* Number of contacts in the trace, from the probe on: those of the cell and, if the chain has it, the next. */
static size_t trace_contacts(const struct bead_measures *m)
{
    size_t there = bead_chain_contacts(m->chain) - m->places.probe, wanted = m->places.cell + 1;
    return wanted < there ? wanted : there;
}

enum bead_error bead_trace_feed(struct bead_measures *m, const struct bead_sample *sample, struct bead_message *msg)
{
    struct bead_trace *t = &m->trace;
    size_t probe = m->places.probe, cell = m->places.cell, contacts = trace_contacts(m);
    const double *force = sample->field[BEAD_FIELD_CONTACT_FORCE], *rest = bead_chain_static_force(m->chain);
    if (t->count == 0 && probe > 0 && !(force[probe] - rest[probe] > begin_part * m->pulses->record))
        return BEAD_OK;
    struct bead_pulse first = bead_pulses_first(m->pulses, probe), last = bead_pulses_first(m->pulses, probe + cell - 1);
    if (sample->time > last.time + tail_rises * (first.time - t->begin))
        return BEAD_OK;
    if (t->count == t->room) {
        enum bead_error err = grow(t, msg);
        if (err)
            return err;
    }
    if (t->count == 0)
        t->begin = sample->time;
    for (size_t i = 0; i < contacts; i++)
        t->force[i][t->count] = force[probe + i] - rest[probe + i];
    for (size_t i = 0; i <= cell; i++)
        t->displacement[i][t->count] = sample->field[BEAD_FIELD_DISPLACEMENT][probe + i];
    for (size_t i = 0; i < cell; i++)
        t->velocity[i][t->count] = sample->field[BEAD_FIELD_VELOCITY][probe + 1 + i];
    t->count++;
    t->spacing = (sample->time - t->begin) / (double)(t->count > 1 ? t->count - 1 : 1);
    return BEAD_OK;
}

/* A number of contact probe + i, or of the bead that it pushes, at a sample. */
typedef double quantity(const struct bead_measures *m, size_t i, size_t sample);

static double compression(const struct bead_measures *m, size_t i, size_t sample)
{
    return m->trace.displacement[i][sample] - m->trace.displacement[i + 1][sample];
}

static double force(const struct bead_measures *m, size_t i, size_t sample)
{
    return m->trace.force[i][sample];
}

static double valley(const struct bead_measures *m, size_t i, size_t sample)
{
    return -m->trace.force[i][sample];
}

static double power(const struct bead_measures *m, size_t i, size_t sample)
{
    return m->trace.force[i][sample] * m->trace.velocity[i][sample];
}

static double kinetic(const struct bead_measures *m, size_t i, size_t sample)
{
    const double v = m->trace.velocity[i][sample];
    return 0.5 * bead_chain_mass(m->chain)[m->places.probe + 1 + i] * v * v;
}

/* Energy of the contact above its static state, J. */
static double potential(const struct bead_measures *m, size_t i, size_t sample)
{
    const struct bead_law_spec *spec = &bead_chain_spec(m->chain)->law;
    const struct bead_law *law = spec->row;
    const size_t contact = m->places.probe + i;
    const double a = bead_chain_stiffness(m->chain)[contact], d0 = bead_chain_static_compression(m->chain)[contact],
                 d = compression(m, i, sample);
    return law->energy(a, spec, d0 + d) - law->energy(a, spec, d0) - bead_chain_static_force(m->chain)[contact] * d;
}

/* The curve through the samples around index `at`; its place 0 is sample *first. */
static struct bead_curve around(const struct bead_measures *m, size_t i, quantity *of, size_t at, size_t *first)
{
    double values[BEAD_CURVE_POINTS];
    size_t points;
    *first = bead_curve_window(m->trace.count, at, &points);
    for (size_t s = 0; s < points; s++)
        values[s] = of(m, i, *first + s);
    return bead_curve_through(values, points);
}

/* Fronts fall off doubly exponentially: logarithms are smooth. */
static double logarithm(const struct bead_measures *m, size_t i, size_t sample)
{
    return bead_log(m->trace.force[i][sample]);
}

/* When the probe's force rises above a part of its maximum, in spacings; 0 if it does so before the trace. */
static double rise_begin(const struct bead_measures *m, double level)
{
    const struct bead_trace *t = &m->trace;
    size_t at = 0, first;
    while (at + 1 < t->count && t->force[0][at] < level)
        at++;
    const struct bead_curve curve = around(m, 0, logarithm, at, &first);
    const double x = at == 0 ? 0 : bead_curve_crossing(&curve, bead_log(level), (double)(at - 1 - first), (double)(at - first));
    return at == 0 || !isfinite(bead_curve_value(&curve, x)) ? (double)at : (double)first + x;
}

/* Where a pulse ends that goes on, in spacings: `tail_rises` rises at the probe after the maximum of the cell's last contact, which
 * may come first. The samples reach further, unless the run ends. */
static double latest_end(const struct bead_measures *m)
{
    const struct bead_trace *t = &m->trace;
    const struct bead_pulse first = bead_pulses_first(m->pulses, m->places.probe),
                            last = bead_pulses_first(m->pulses, m->places.probe + m->places.cell - 1);
    const double rise = (first.time - t->begin) / t->spacing - rise_begin(m, rise_part * first.force);
    return fmin(fmax((last.time - t->begin) / t->spacing + tail_rises * rise, 0), (double)(t->count - 1));
}

/* Where the pulse in contact probe + i ends, near sample `at`, in spacings: where the contact opens, or at a minimum. */
static double end_near(const struct bead_measures *m, size_t i, size_t at)
{
    size_t first;
    if (m->trace.force[i][at] > 0) {
        const struct bead_curve curve = around(m, i, valley, at, &first);
        return (double)first + bead_curve_maximum(&curve, (double)(at - 1 - first), (double)(at + 1 - first));
    }
    /* The force has a branch point where a contact opens, the compression has none; a dashpot may end the force before. */
    const struct bead_curve curve = around(m, i, compression(m, i, at) <= 0 ? compression : force, at, &first);
    return (double)first + bead_curve_crossing(&curve, 0, (double)(at - 1 - first), (double)(at - first));
}

/* When the pulse in contact probe + i has passed, in spacings: at the first of these below end_part, but not after latest_end. */
static double pulse_end(const struct bead_measures *m, size_t i, double peak, double peak_time)
{
    const struct bead_trace *t = &m->trace;
    const double *f = t->force[i];
    size_t at = (size_t)fmin(fmax((peak_time - t->begin) / t->spacing, 0) + 1, (double)t->count);
    while (at + 1 < t->count && f[at] > end_part * peak)
        at++;
    while (at + 1 < t->count && f[at] > 0 && f[at + 1] < f[at])
        at++;
    return at + 1 < t->count ? fmin(end_near(m, i, at), latest_end(m)) : latest_end(m);
}

/* Time, s, between the two crossings of `part` of the maximum nearest to it. */
static double width(const double *values, size_t count, double spacing, double part)
{
    double largest;
    double at = bead_samples_maximum(values, count, &largest);
    if (!(largest > 0) || isnan(at))
        return NAN;
    size_t from = (size_t)lround(at);
    return spacing * (bead_samples_crossing(values, count, from, 1, part * largest) -
                      bead_samples_crossing(values, count, from, -1, part * largest));
}

/* From the first sample to `end`, in spacings: between two samples, of the curve through those around them. */
static double integral(const struct bead_measures *m, size_t i, quantity *of, double end)
{
    double sum = 0;
    for (size_t s = 0, first; (double)s < end; s++) {
        const struct bead_curve curve = around(m, i, of, s, &first);
        sum += bead_curve_integral(&curve, (double)(s - first), fmin((double)(s + 1), end) - (double)first);
    }
    return m->trace.spacing * sum;
}

/* Mean of the forces in contact probe + i and the next. */
static double bead_force(const struct bead_measures *m, size_t i, size_t sample)
{
    const bool second = i + 1 < trace_contacts(m);
    return 0.5 * (m->trace.force[i][sample] + (second ? m->trace.force[i + 1][sample] : 0));
}

/* The largest until `end`, in spacings. */
static double largest_bead_force(const struct bead_measures *m, size_t i, double end)
{
    size_t at = 0, first;
    for (size_t s = 1; (double)s <= end; s++)
        at = bead_force(m, i, s) > bead_force(m, i, at) ? s : at;
    const struct bead_curve curve = around(m, i, bead_force, at, &first);
    const double low = fmax((double)at - 1, 0), high = fmin((double)at + 1, end);
    const double x = bead_curve_maximum(&curve, low - (double)first, high - (double)first);
    return fmax(bead_force(m, i, at), bead_curve_value(&curve, x)); /* the first where a kink is nearby */
}

static void read_contact(const struct bead_measures *m, size_t i, struct bead_pulse_found *found)
{
    const struct bead_trace *t = &m->trace;
    const struct bead_law_spec *spec = &bead_chain_spec(m->chain)->law;
    size_t contact = m->places.probe + i;
    struct bead_pulse first = bead_pulses_first(m->pulses, contact);
    const double over = pulse_end(m, i, first.force, first.time);
    const size_t end = (size_t)over + 1;
    double velocity, rest = bead_chain_static_force(m->chain)[contact], a = bead_chain_stiffness(m->chain)[contact];
    bead_samples_maximum(t->velocity[i], end, &velocity);
    found->energy += i == 0 ? integral(m, i, power, over) : 0;
    found->momentum += i == 0 ? integral(m, i, force, over) : 0;
    found->kinetic += integral(m, i, kinetic, over);
    found->potential += integral(m, i, potential, over);
    found->bead_force = fmax(found->bead_force, largest_bead_force(m, i, over));
    if (velocity > found->velocity) {
        found->velocity = velocity;
        found->velocity_time[0] = width(t->velocity[i], end, t->spacing, 0.5);
        found->velocity_time[1] = width(t->velocity[i], end, t->spacing, 0.01);
    }
    if (first.force > found->force) {
        found->force = first.force;
        found->force_time[0] = width(t->force[i], end, t->spacing, 0.5);
        found->force_time[1] = width(t->force[i], end, t->spacing, 0.01);
        found->compression = spec->row->compression(a, spec, first.force + rest) - bead_chain_static_compression(m->chain)[contact];
    }
}

void bead_front_speed(const struct bead_measures *m, size_t first, size_t last, size_t step, size_t fewest,
                      double *beads_per_second, double *speed)
{
    const double *position = bead_chain_position(m->chain), *radius = bead_chain_radius(m->chain);
    double n = 0, k0 = 0, t0 = 0, x0 = 0, tt = 0, tk = 0, tx = 0;
    last = last < m->places.links ? last : m->places.links - 1;
    for (int pass = 0; pass < 2; pass++) { /* the means first: with these subtracted, sums of squares lose no digits */
        for (size_t k = first; k <= last; k += step) {
            double t = bead_pulses_first(m->pulses, k).time, x = position[k] + radius[k];
            if (isnan(t))
                continue;
            if (pass == 0) {
                n++;
                k0 += (double)k;
                t0 += t;
                x0 += x;
            } else {
                tt += (t - t0) * (t - t0);
                tk += (t - t0) * ((double)k - k0);
                tx += (t - t0) * (x - x0);
            }
        }
        if (pass == 0 && n > 0) {
            k0 /= n;
            t0 /= n;
            x0 /= n;
        }
    }
    *beads_per_second = n >= (double)fewest && tt > 0 ? tk / tt : NAN;
    *speed = n >= (double)fewest && tt > 0 ? tx / tt : NAN;
}

struct bead_pulse_found bead_trace_read(const struct bead_measures *m)
{
    struct bead_pulse_found found = {0};
    size_t probe = m->places.probe, cell = m->places.cell;
    bool there = m->trace.count > BEAD_CURVE_POINTS;
    for (size_t i = 0; i < cell; i++)
        there = there && !isnan(bead_pulses_first(m->pulses, probe + i).force);
    if (!there)
        return (struct bead_pulse_found){NAN, NAN, NAN, NAN, NAN, NAN, {NAN, NAN}, {NAN, NAN}, NAN, NAN, NAN, NAN};
    for (size_t i = 0; i < cell; i++)
        read_contact(m, i, &found);
    size_t around = m->places.regular ? 2 * cell : IRREGULAR;
    bead_front_speed(m, probe > around ? probe - around : 0, probe + around, cell, 2, &found.beads_per_second, &found.speed);
    if (!(found.beads_per_second > 0))
        found.beads_per_second = found.speed = NAN;
    return found;
}

/* The zero of a cubic before x = 0, in steps; d and r are its values and its slopes, per step, at 0 and 1. */
static double zero_before(const double d[2], const double r[2])
{
    double third = r[0] + r[1] - 2 * (d[1] - d[0]), second = d[1] - d[0] - r[0] - third, x = -d[0] / r[0];
    for (int i = 0; i < 5; i++)
        x -= (((third * x + second) * x + r[0]) * x + d[0]) / ((3 * third * x + 2 * second) * x + r[0]);
    return x;
}

/* The time at which the contact opened, from later samples only: at the opening the force has a branch point, and the motion is
 * less smooth before it. */
static void find_opening(struct bead_strike *s, double time, double step, double d, double rate)
{
    bool first = isnan(s->opened);
    double at[2] = {first ? d : s->behind[0], d}, slope[2] = {step * (first ? rate : s->behind[1]), step * rate};
    double x = first ? fmax(-1, -d / slope[0]) : zero_before(at, slope);
    if (x >= -1 && x <= 0 && d <= 0)
        s->opened = time + (first ? x : x - 1) * step;
    s->behind[0] = first ? d : NAN;
    s->behind[1] = rate;
}

void bead_strike_feed(struct bead_measures *m, const struct bead_sample *sample)
{
    struct bead_strike *s = &m->strike;
    const double *u = sample->field[BEAD_FIELD_DISPLACEMENT], *v = sample->field[BEAD_FIELD_VELOCITY], *before = s->compression;
    double largest;
    s->velocity = v[0];
    if (bead_chain_beads(m->chain) < 2 || (!isnan(s->opened) && isnan(s->behind[0])))
        return;
    double d = bead_chain_static_compression(m->chain)[0] + u[0] - u[1];
    memmove(s->compression, s->compression + 1, sizeof s->compression - sizeof *s->compression);
    s->compression[BEAD_CURVE_POINTS - 1] = d;
    if (++s->fed < BEAD_CURVE_POINTS)
        return;
    bead_samples_maximum(s->compression, BEAD_CURVE_POINTS, &largest);
    s->largest = fmax(s->largest, largest);
    if (!isnan(s->opened) || (before[BEAD_CURVE_POINTS - 2] > 0 && d <= 0))
        find_opening(s, sample->time, sample->time - m->time, d, v[0] - v[1]);
}
