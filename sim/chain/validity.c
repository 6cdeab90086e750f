/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares a chain's strike, compressions and pressures with what the model allows: see validity.h. */
#include "sim/chain/validity.h"

#include <math.h>

#include "sim/base/suggest.h"
#include "sim/chain/contact_walk.h"
#include "sim/chain/drive.h"
#include "sim/chain/system.h"

static const double pi = 3.14159265358979323846;

/* Two bodies in contact. */
struct pair {
    const struct bead_material *left, *right; /* right NULL: a rigid wall */
    bool flat;                                /* it is a wall */
    double stiffness;
};

/* `right` SIZE_MAX: the wall. */
static struct pair pair_of(const struct bead_chain *c, size_t left, size_t right, double stiffness)
{
    const struct bead_material *m = c->scene->materials;
    const bool flat = right == SIZE_MAX, rigid = flat && c->spec->wall != BEAD_WALL_MATERIAL;
    return (struct pair){&m[left], rigid ? NULL : &m[flat ? c->spec->wall_material : right], flat, stiffness};
}

/* The smaller of two positive numbers; 0 and NaN mean that there is none. */
static double smaller(double a, double b)
{
    return !(a > 0) ? (b > 0 ? b : 0) : b < a && b > 0 ? b : a;
}

static void add(struct bead_validity *v, const struct bead_chain *c, size_t k, const struct pair *p, double d)
{
    if (!c->law->one_sided || !(d > 0))
        return;
    const double r1 = p->left->radius, r2 = p->flat ? INFINITY : p->right->radius, depth = d / fmin(r1, r2);
    /* p0 = 3 F / (2 pi a^2), a^2 = R d, 1/R = 1/r1 + 1/r2 (Johnson, section 4.2) */
    const double pressure = 1.5 * p->stiffness * sqrt(d) * (1 / r1 + 1 / r2) / pi;
    const double yield = smaller(p->left->yield, p->right ? p->right->yield : 0);
    if (depth > v->compression) {
        v->compression = depth;
        v->deepest = k;
    }
    if (c->law->hertz && !c->law->as_printed && yield > 0 && pressure / yield > v->pressure) {
        v->pressure = pressure / yield;
        v->hardest = k;
    }
}

void bead_validity_add(struct bead_validity *v, const struct bead_chain *c, size_t k, double d)
{
    const struct pair pair = pair_of(c, c->material[k], k + 1 < c->beads ? c->material[k + 1] : SIZE_MAX, c->stiffness[k]);
    add(v, c, k, &pair, d);
}

static double bar_speed(const struct bead_material *m)
{
    return sqrt(m->modulus * (4.0 / 3 * pi) * (m->radius * m->radius * m->radius) / m->mass);
}

static double strike(const struct bead_chain *c)
{
    const struct bead_material *m = c->scene->materials;
    struct bead_contact_walk w;
    bead_contact_walk_start(&w, c, true);
    if (!c->law->one_sided || !bead_contact_walk_next(&w) || w.right == SIZE_MAX)
        return 0;
    return bead_chain_speed(c) / fmin(bar_speed(&m[w.left]), bar_speed(&m[w.right]));
}

static struct bead_validity walk(const struct bead_chain *c, double energy)
{
    struct bead_validity v = {.strike = 0};
    struct bead_contact_walk w;
    if (!c->spec->system->has_contacts)
        return v;
    v.strike = strike(c);
    for (bead_contact_walk_start(&w, c, true); bead_contact_walk_next(&w);) {
        const struct pair pair = pair_of(c, w.left, w.right, w.stiffness);
        add(&v, c, w.k, &pair, bead_contact_bound(&w, energy));
    }
    return v;
}

struct bead_validity bead_validity_begin(const struct bead_chain *chain)
{
    return walk(chain, 0);
}

struct bead_validity bead_validity_bound(const struct bead_chain *chain)
{
    return walk(chain, bead_is_driven(chain->spec) ? INFINITY : bead_chain_energy(chain));
}

/* Damping is part of the force: then no more than all the energy allows. */
static double compression_at(const struct bead_chain *c, size_t k, double force)
{
    const double a = c->stiffness[k], d = c->law->compression(a, &c->spec->law, force);
    const double most = fmax(c->static_compression[k], 0) + c->law->energy_compression(a, &c->spec->law, bead_chain_energy(c));
    return c->spec->damping_coefficient > 0 ? fmin(d, most) : d;
}

void bead_validity_add_peaks(struct bead_validity *v, const struct bead_chain *chain, const struct bead_peak *peaks)
{
    for (size_t k = 0; k < chain->contacts; k++)
        bead_validity_add(v, chain, k, compression_at(chain, k, peaks[k].value));
}

bool bead_validity_beyond(const struct bead_chain *chain, size_t contact, double force)
{
    struct bead_validity v = {.strike = strike(chain)};
    bead_validity_add(&v, chain, contact, compression_at(chain, contact, force));
    return v.strike > BEAD_FASTEST || v.compression > BEAD_DEEPEST;
}

bool bead_validity_fails(const struct bead_validity *v)
{
    return v->strike > BEAD_FASTEST || v->compression > BEAD_DEEPEST || v->pressure > BEAD_HARDEST;
}

const char *bead_validity_words(const struct bead_validity *v, char *text, size_t size)
{
    const struct {
        double found, most;
        const char *format;
        size_t contact;
    } all[] = {
        {v->strike, BEAD_FASTEST, "the striker has %.3g of the speed of sound in a bar (at most %g)", 0},
        {v->compression, BEAD_DEEPEST, "the compression is %.3g of the radius (at most %g) in contact %zu", v->deepest},
        {v->pressure, BEAD_HARDEST,
         "the pressure in the centre is %.3g times the yield strength (fully plastic above %g) in contact %zu", v->hardest},
    };
    char piece[160];
    *text = '\0';
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        snprintf(piece, sizeof piece, all[i].format, all[i].found, all[i].most, all[i].contact);
        if (all[i].found > all[i].most)
            bead_list_add(text, size, ", ", piece);
    }
    return text;
}
