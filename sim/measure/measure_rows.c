/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of measures: one row each, with name, unit and function. Tables, --info and sweeps read it. */
#include <math.h>

#include "beadreel/law.h"
#include "sim/base/wide.h"
#include "sim/chain/spins.h"
#include "sim/measure/measure_private.h"
#include "sim/measure/participation.h"
#include "sim/measure/sink_grid.h"
#include "sim/run/uncertainty.h"

enum { NOTE = sizeof((struct bead_measure *)0)->note };

struct reading {
    const struct bead_measures *m;
    const struct bead_outcome *outcome; /* may be NULL */
    struct bead_pulse_found pulse;
    struct bead_decay_found decay;
    char *note; /* [NOTE] for the row being read, filled in by its function */
};

/* ---- the chain ---- */

static double magnetism(const struct reading *r, int)
{
    return *bead_chain_spins(r->m->chain) ? bead_chain_magnetism(r->m->chain) : NAN;
}

static double order(const struct reading *r, int which)
{
    const char *spins = bead_chain_spins(r->m->chain);
    return bead_spins_order(spins, strlen(spins), which);
}

static double arrival(const struct reading *r, int)
{
    return r->outcome ? r->outcome->front_arrival : NAN;
}

/* ---- the front ---- */

/* Over the second half up to the probe; cell by cell if the chain is regular there. `per_second`: in beads per second. */
static double front_speed(const struct reading *r, int per_second)
{
    const struct bead_places *places = &r->m->places;
    size_t half = places->links / 2, from = half > places->regular_from ? half : places->regular_from, step = places->cell;
    double beads = NAN, speed = NAN;
    if (places->regular && places->probe > from) {
        from += (places->probe - from) % step;
        bead_front_speed(r->m, from, places->probe, step, 3, &beads, &speed);
    }
    if (isnan(speed))
        bead_front_speed(r->m, places->links / 4, places->probe, 1, 3, &beads, &speed);
    return per_second ? beads : speed;
}

/* ---- the leading pulse ---- */

static double of_pulse(const struct reading *r, int offset)
{
    double value;
    memcpy(&value, (const char *)&r->pulse + offset, sizeof value);
    return value;
}

static double force_width(const struct reading *r, int level)
{
    return r->pulse.force_time[level] * r->pulse.beads_per_second;
}

static double velocity_width(const struct reading *r, int level)
{
    return r->pulse.velocity_time[level] * r->pulse.beads_per_second;
}

static double energy_ratio(const struct reading *r, int)
{
    return r->pulse.potential > 0 ? r->pulse.kinetic / r->pulse.potential : NAN;
}

static double energy_part(const struct reading *r, int)
{
    double input = bead_chain_energy(r->m->chain);
    return input > 0 ? r->pulse.energy / input : NAN;
}

/* A ratio of compressions. */
static double ahead(const struct reading *r, int n)
{
    const struct bead_measures *m = r->m;
    const struct bead_law_spec *spec = &bead_chain_spec(m->chain)->law;
    const struct bead_law *law = spec->row;
    const double *a = bead_chain_stiffness(m->chain);
    size_t probe = m->places.probe, contact = probe + (size_t)n;
    double force = m->pulses->ahead[n - 1], first = bead_pulses_first(m->pulses, probe).force;
    if (isnan(force) || bead_chain_static_force(m->chain)[probe] > 0)
        return NAN;
    return law->compression(a[contact], spec, force) / law->compression(a[probe], spec, first);
}

/* Measured as far along the chain as the pulse has travelled, where it has separated from the pulses ahead of it. */
static double follower(const struct reading *r, int n)
{
    const struct bead_pulses *p = r->m->pulses;
    for (size_t k = r->m->places.probe + 1; k-- > 0;) {
        if (p->track[k].count > (size_t)n && !(p->track[k].pulse[n].time > p->struck))
            return p->track[k].pulse[n].force / p->track[k].pulse[0].force;
    }
    return NAN;
}

/* ---- participation: (sum e)^2 / sum e^2, at the end and when the front arrives ---- */

/* Without a state from the run, the nearest sample is used, and the note gives its time. */
static void note_time(const struct reading *r, double time)
{
    bead_time_text(time, "s", r->note + snprintf(r->note, NOTE, "at "), NOTE - 3);
}

/* Notes that a motion is lost: velocities of the check run differ by more than a predictable number may. Two such motions show
 * nothing about the errors of their measures. */
static void note_lost(const struct reading *r, const struct bead_moment *moment, const struct bead_moment *check)
{
    const double *mass = bead_chain_mass(r->m->chain), *v = moment->velocity;
    double moving = 0, apart = 0;
    for (size_t j = 0; check->velocity && j < bead_chain_beads(r->m->chain); j++) {
        const double difference = v[j] - check->velocity[j];
        moving += mass[j] * v[j] * v[j];
        apart += mass[j] * difference * difference;
    }
    if (bead_uncertainty_is_large(sqrt(moving), bead_uncertainty_measured(0, sqrt(apart), 0)))
        snprintf(r->note, NOTE, "unpredictable");
}

/* The beads at the end of the run. */
static struct bead_moment final(const struct reading *r)
{
    if (r->outcome && r->outcome->check && r->outcome->final.displacement)
        note_lost(r, &r->outcome->final, &r->outcome->check->final);
    if (r->outcome && r->outcome->final.displacement)
        return r->outcome->final;
    note_time(r, r->m->time);
    return (struct bead_moment){r->m->time, r->m->u, r->m->v};
}

static double force_of(const struct bead_measures *m, const double *u, size_t k)
{
    const struct bead_law_spec *spec = &bead_chain_spec(m->chain)->law;
    double next = k + 1 < bead_chain_beads(m->chain) ? u[k + 1] : 0;
    double compression = bead_chain_static_compression(m->chain)[k] + (u[k] - next);
    return spec->row->force(bead_chain_stiffness(m->chain)[k], spec, compression) - bead_chain_static_force(m->chain)[k];
}

static double force_participation(const struct reading *r, int)
{
    const struct bead_measures *m = r->m;
    const struct bead_moment end = final(r);
    double sum = 0, squares = 0;
    for (size_t k = 0; k < bead_chain_contacts(m->chain); k++) {
        double f = force_of(m, end.displacement, k);
        sum += f;
        squares += f * f;
    }
    return squares > 0 ? sum * sum / squares : NAN;
}

static double energy_participation(const struct reading *r, int)
{
    const struct bead_moment end = final(r);
    return bead_chain_participation(r->m->chain, end.displacement, end.velocity);
}

static double clean_index(const struct reading *r, int)
{
    const struct bead_measures *m = r->m;
    const struct bead_moment *arrived = r->outcome && r->outcome->arrived.displacement ? &r->outcome->arrived : NULL;
    double found = arrived ? bead_chain_participation(m->chain, arrived->displacement, arrived->velocity) : m->arrived;
    if (!arrived)
        note_time(r, m->arrived_time);
    else if (r->outcome->check)
        note_lost(r, arrived, &r->outcome->check->arrived);
    /* In a run that ends at the front's arrival the last sample may be just before it. */
    if (isnan(found) && r->outcome && r->outcome->front_arrival <= m->time + 1.5 * m->pulses->spacing)
        found = energy_participation(r, 0);
    return bead_clean_index(bead_chain_beads(m->chain), found, m->clean);
}

/* ---- decay, defects, walls ---- */

static double decay_rate(const struct reading *r, int)
{
    if (!isnan(r->decay.rate) && !r->decay.seen)
        snprintf(r->note, NOTE, "none seen");
    return r->decay.seen ? r->decay.rate : NAN;
}

#define OF_DECAY(name, value)                                  \
    static double decay_##name(const struct reading *r, int n) \
    {                                                          \
        (void)n;                                               \
        return isnan(r->decay.rate) ? NAN : (value);           \
    }
OF_DECAY(length, r->decay.seen && r->decay.rate > 0 ? 1 / r->decay.rate : NAN)
OF_DECAY(error, r->decay.error)
OF_DECAY(first, (double)r->decay.first)
OF_DECAY(last, (double)r->decay.last)

/* Sums over one cell each. */
static double past_defect(const struct reading *r, int energy)
{
    const struct bead_places *places = &r->m->places;
    const struct bead_law_spec *law = &bead_chain_spec(r->m->chain)->law;
    double before = 0, after = 0;
    if (!places->defect || !law->row->exponent)
        return NAN;
    for (size_t i = 0; i < places->cell; i++) {
        before += bead_pulses_first(r->m->pulses, places->before + i).force;
        after += bead_pulses_first(r->m->pulses, places->probe + i).force;
    }
    const double power = law->row->exponent(law);
    return energy ? bead_pow(after / before, (power + 1) / power) : after / before;
}

static double at_wall(const struct reading *r, int reflected)
{
    const struct bead_measures *m = r->m;
    if (bead_chain_spec(m->chain)->wall == BEAD_WALL_NONE)
        return NAN;
    const struct bead_track *wall = &m->pulses->track[m->pulses->contacts - 1], *probe = &m->pulses->track[m->places.probe];
    if (wall->count == 0 || probe->count == 0 || (reflected && !(probe->late.force > 0)))
        return NAN;
    return (reflected ? probe->late.force : wall->pulse[0].force) / probe->pulse[0].force;
}

/* Once all waves have met an absorbing end. */
static double reflected_energy(const struct reading *r, int)
{
    const struct bead_outcome *o = r->outcome;
    return o && o->energy_end + o->absorbed > 0 ? o->energy_end / (o->energy_end + o->absorbed) : NAN;
}

/* ---- is the model valid? ---- */

static double strike_speed(const struct reading *r, int)
{
    return r->m->validity.strike > 0 ? r->m->validity.strike : NAN;
}

static double strain(const struct reading *r, int pressure)
{
    const struct bead_validity *v = &r->m->validity;
    const double found = pressure ? v->pressure : v->compression;
    snprintf(r->note, NOTE, "contact %zu%s", pressure ? v->hardest : v->deepest,
             found > (pressure ? BEAD_HARDEST : BEAD_DEEPEST) ? "; beyond the model" : "");
    return found > 0 ? found : NAN;
}

/* ---- the striker ---- */

static double strike_compression(const struct reading *r, int)
{
    return r->m->strike.largest > 0 ? r->m->strike.largest : NAN;
}

static double strike_time(const struct reading *r, int)
{
    return bead_chain_spec(r->m->chain)->law.row->one_sided ? r->m->strike.opened : NAN;
}

/* After the striker has separated. */
static double striker_velocity(const struct reading *r, int)
{
    return isnan(r->m->strike.opened) ? NAN : r->m->strike.velocity;
}

/* For two free beads. */
static double restitution(const struct reading *r, int)
{
    const struct bead_chain_spec *spec = bead_chain_spec(r->m->chain);
    const bool collision = bead_chain_beads(r->m->chain) == 2 && spec->wall == BEAD_WALL_NONE && spec->start_count == 0;
    return collision && !isnan(r->m->strike.opened) ? (r->m->v[1] - r->m->v[0]) / spec->striker_velocity : NAN;
}

#define PULSE(member) of_pulse, offsetof(struct bead_pulse_found, member)
/* Widths are in beads: times at the probe, multiplied by the speed of the pulse there. */
static const struct row {
    struct bead_measure_info info;
    double (*value)(const struct reading *reading, int n); /* NaN: not in this run; the note may say why */
    int n;
} rows[] = {
    {{"magnetism", "", "M = |N_up - N_down| / (N_up + N_down); thesis, Eq. 15"}, magnetism, 0},
    {{BEAD_ORDER_DOMAIN, "cells", "mean number of cells in a row with equal orientation"}, order, 0},
    {{BEAD_ORDER_CORRELATION, "",
      "mean of s_i s_(i+1), s = 1 up and -1 reversed: 1 if all are alike, -1 in up down up down ..., where M = 0"},
     order,
     1},
    {{BEAD_ORDER_SECOND, "", "mean of s_i s_(i+2), 1 in both of these cases"}, order, 2},
    {{"front arrival", "s", "first time at which the force of the last contact exceeds 1e-4 of the largest so far"}, arrival, 0},
    {{"front speed", "m/s", "least squares of the times of the first maxima over the second half of the chain"}, front_speed, 0},
    {{"front speed in beads", "1/s", "the same, in beads per second"}, front_speed, 1},
    {{"local front speed", "m/s", "the same, over two cells on each side of the probe, or ten beads where no cells repeat"},
     PULSE(speed)},
    {{"peak contact force", "N", "of the leading pulse above the static force, the largest in the probe's cell"}, PULSE(force)},
    {{"peak bead force", "N", "mean of a bead's two contacts, above their static force"}, PULSE(bead_force)},
    {{"peak velocity", "m/s", "of a bead"}, PULSE(velocity)},
    {{"peak compression", "m", "of a contact"}, PULSE(compression)},
    {{"force width", "beads", "of the contact force, at half its maximum"}, force_width, 0},
    {{"force width at 1 %", "beads", "where it falls to a hundredth"}, force_width, 1},
    {{"velocity width", "beads", "at half its maximum"}, velocity_width, 0},
    {{"velocity width at 1 %", "beads", "where it falls to a hundredth"}, velocity_width, 1},
    {{"compression 1 bead ahead", "",
      "compression there when the pulse is centred at the probe, as a fraction of the peak compression"},
     ahead,
     1},
    {{"compression 2 beads ahead", "", "the same, two beads ahead"}, ahead, 2},
    {{"compression 3 beads ahead", "", "the same, three beads ahead"}, ahead, 3},
    {{"compression 4 beads ahead", "", "the same, four beads ahead"}, ahead, 4},
    {{"pulse energy", "J", "integral of force times velocity behind the probe"}, PULSE(energy)},
    {{"pulse momentum", "kg m/s", "integral of the force in the probe"}, PULSE(momentum)},
    {{"pulse part of energy", "", "pulse energy / the striker's"}, energy_part, 0},
    {{"kinetic / potential", "", "energies of one cell, integrated over the pulse; 5/4 for Hertz's law"}, energy_ratio, 0},
    {{"second pulse", "", "peak force of the second pulse / of the leading one, as far along the chain as it has travelled"},
     follower,
     1},
    {{"third pulse", "", "the same for the next pulse"}, follower, 2},
    {{"fourth pulse", "", "the same for the next pulse"}, follower, 3},
    {{"fifth pulse", "", "the same for the next pulse"}, follower, 4},
    {{"sixth pulse", "", "the same for the next pulse"}, follower, 5},
    {{"participation of forces", "contacts", "(sum f)^2 / sum f^2 of the contact forces at the end"}, force_participation, 0},
    {{"participation of energies", "beads", "(sum e)^2 / sum e^2 of the beads' energies at the end"}, energy_participation, 0},
    {{"clean index", "",
      "when the front arrives: 1 if as few beads share the energy as in the clean wave, 0 if all share it equally"},
     clean_index,
     0},
    {{"decay rate", "1/bead",
      "-d ln F / d bead of the leading force: line through means of whole cells, begun where its error is smallest, that is, "
      "after the striker's transient; `none seen` if the rate is below its error"},
     decay_rate,
     0},
    {{"decay rate error", "1/bead",
      "the largest of: two standard errors, half the difference between both halves of the fit, the decay that the error of "
      "the energy explains"},
     decay_error,
     0},
    {{"decay fit begins", "", "first contact of the fit"}, decay_first, 0},
    {{"decay fit ends", "", "last contact of the fit"}, decay_last, 0},
    {{"decay length", "beads", "1 / decay rate"}, decay_length, 0},
    {{"force past defect", "", "leading force of a cell at the probe / of a cell before the first irregular one"}, past_defect, 0},
    {{"energy past defect", "", "the same to the power 1 + 1/n for forces ~ d^n (5/3 for Hertz's law)"}, past_defect, 1},
    {{"force at wall", "", "first maximum at the wall / leading force at the probe"}, at_wall, 0},
    {{"reflected force", "", "largest force at the probe after the wall's first maximum / leading force there"}, at_wall, 1},
    {{"reflected energy", "",
      "with an absorbing end: energy of the chain at the end of the run, as a part of that and what was absorbed"},
     reflected_energy,
     0},
    {{"compression / radius", "", "largest of a contact, as a part of its smaller radius; Hertz's law holds up to a tenth or so"},
     strain,
     0},
    {{"pressure / yield strength", "",
      "largest in the centre of a contact / smaller yield strength: 1.6 where yielding begins, 4.5 where it is fully plastic"},
     strain,
     1},
    {{"strike / bar speed", "",
      "speed of the striker / smaller sqrt(E / density) of it and the first bead; below a tenth an impact is "
      "quasi-static"},
     strike_speed,
     0},
    {{"striker's compression", "m", "largest compression of its contact, until that opens"}, strike_compression, 0},
    {{"striker's contact time", "s", "time until its contact first opens"}, strike_time, 0},
    {{"striker's velocity", "m/s", "at the end, if its contact has opened; negative after a rebound"}, striker_velocity, 0},
    {{"restitution", "", "of a striker and one bead: speed at which they part / that of the strike"}, restitution, 0},
};
enum { ROWS = sizeof rows / sizeof *rows };

const struct bead_measure_info *bead_measure_info(size_t index)
{
    return index < ROWS ? &rows[index].info : NULL;
}

size_t bead_measures_read(struct bead_measures *m, const struct bead_outcome *outcome, struct bead_measure *found, size_t room)
{
    char note[NOTE];
    bead_pulses_end(m->pulses);
    for (size_t k = 0; k < bead_chain_contacts(m->chain); k++)
        bead_validity_add(&m->validity, m->chain, k, bead_chain_static_compression(m->chain)[k] + m->deepest[k]);
    struct reading reading = {
        .m = m, .outcome = outcome, .pulse = bead_trace_read(m), .decay = bead_decay_find(m, outcome), .note = note};
    size_t count = 0;
    for (size_t i = 0; i < ROWS; i++) {
        *note = '\0';
        double value = rows[i].value(&reading, rows[i].n);
        if (!isfinite(value) && strcmp(note, "none seen") != 0)
            continue;
        if (count < room) {
            struct bead_measure *f = &found[count];
            *f = (struct bead_measure){.unit = rows[i].info.unit, .value = value};
            snprintf(f->name, sizeof f->name, "%s", rows[i].info.name);
            memcpy(f->note, note, sizeof note);
        }
        count++;
    }
    return count;
}
