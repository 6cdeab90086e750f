/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Queries of a chain: its beads and contacts, its energy, and the bound on its frequencies, which limits the step. */
#include <math.h>

#include "sim/base/json.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/contact_walk.h"

const char *bead_chain_name(const struct bead_chain *chain)
{
    return chain->spec->name ? chain->spec->name : "";
}

const struct bead_chain_spec *bead_chain_spec(const struct bead_chain *chain)
{
    return chain->spec;
}

const struct bead_scene *bead_chain_scene(const struct bead_chain *chain)
{
    return chain->scene;
}

size_t bead_chain_beads(const struct bead_chain *chain)
{
    return chain->beads;
}

size_t bead_chain_contacts(const struct bead_chain *chain)
{
    return chain->contacts;
}

const double *bead_chain_mass(const struct bead_chain *chain)
{
    return chain->mass;
}

const double *bead_chain_radius(const struct bead_chain *chain)
{
    return chain->radius;
}

const double *bead_chain_position(const struct bead_chain *chain)
{
    return chain->position;
}

const size_t *bead_chain_material(const struct bead_chain *chain)
{
    return chain->material;
}

const double *bead_chain_stiffness(const struct bead_chain *chain)
{
    return chain->stiffness;
}

const double *bead_chain_static_force(const struct bead_chain *chain)
{
    return chain->static_force;
}

const double *bead_chain_static_compression(const struct bead_chain *chain)
{
    return chain->static_compression;
}

const char *bead_chain_spins(const struct bead_chain *chain)
{
    return chain->spins;
}

double bead_chain_magnetism(const struct bead_chain *chain)
{
    return chain->magnetism;
}

const struct bead_sensor *bead_chain_sensors(const struct bead_chain *chain, size_t *count)
{
    *count = chain->sensor_count;
    return chain->sensors;
}

void bead_chain_write_sensors(struct bead_json *json, const struct bead_chain *chain)
{
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    bead_json_open(json, "sensors", '[');
    for (size_t i = 0; i < count; i++) {
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "name", sensors[i].name);
        bead_json_number(json, "bead", (double)sensors[i].bead);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
}

/* m: on a tilt gravity works on the striker while it pushes; allow for this distance. */
static const double tilt_reach = 1e-3;

double bead_chain_energy(const struct bead_chain *chain)
{
    double v = chain->spec->striker_velocity;
    return 0.5 * chain->striker_mass * v * v + chain->striker_force * tilt_reach + chain->started;
}

double bead_chain_speed(const struct bead_chain *chain)
{
    return chain->speed;
}

double bead_chain_swing(const struct bead_chain *chain)
{
    double least = chain->spring ? INFINITY : 0;
    for (size_t i = 0; chain->spring && i < chain->beads; i++)
        least = fmin(least, chain->spring[i]);
    return least > 0 ? sqrt(2 * bead_chain_energy(chain) / least) : 0;
}

double bead_contact_walk_excess(const struct bead_contact_walk *w, double d)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    return law->row->energy(w->stiffness, law, d) - law->row->energy(w->stiffness, law, w->static_compression) -
           w->static_force * (d - w->static_compression);
}

/* With a static compression, found by bisection. */
double bead_contact_bound(const struct bead_contact_walk *w, double energy)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    double d0 = fmax(w->static_compression, 0), high = d0 + law->row->energy_compression(w->stiffness, law, energy);
    if (d0 == 0)
        return high;
    while (bead_contact_walk_excess(w, high) < energy && high < 1e30)
        high = d0 + 2 * (high - d0);
    double low = d0;
    for (int i = 0; i < 40; i++) {
        double middle = 0.5 * (low + high);
        *(bead_contact_walk_excess(w, middle) < energy ? &low : &high) = middle;
    }
    return high;
}

/* Cells repeat, so keep the bounds of the last few different contacts: cells of two beads in any order have three. */
enum { BOUNDS = 4 };
struct hardest {
    double stiffness, start; /* of the contact: its identity */
    double pushed, either;   /* N/m: the largest stiffness that the energy allows, if contacts push, and if they may pull, too */
};
struct bounds {
    struct hardest known[BOUNDS];
    size_t next;
};

static const struct hardest *remembered_bound(struct bounds *bounds, const struct bead_contact_walk *w, double energy)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    for (size_t i = 0; i < BOUNDS; i++) {
        if (bounds->known[i].stiffness == w->stiffness && bounds->known[i].start == w->static_compression)
            return &bounds->known[i];
    }
    struct hardest *found = &bounds->known[bounds->next++ % BOUNDS];
    const double d = bead_contact_bound(w, energy), pushed = law->row->stiffness(w->stiffness, law, d);
    *found =
        (struct hardest){w->stiffness, w->static_compression, pushed, fmax(pushed, law->row->stiffness(w->stiffness, law, -d))};
    return found;
}

double bead_chain_omega(const struct bead_chain *chain, double energy)
{
    if (energy == chain->energy)
        return chain->omega;
    struct bounds bounds = {0};
    struct bead_contact_walk w;
    double worst = 0, before = 0, here = 0, left = 0, right = 0;
    for (bead_contact_walk_start(&w, chain, true); bead_contact_walk_next(&w);) {
        const double after = remembered_bound(&bounds, &w, energy)->either;
        /* The Gershgorin row of the previous contact, now that its right neighbour is known. */
        if (w.k > 0)
            worst = fmax(worst, here * (left + right) + before * left + after * right);
        before = here;
        here = after;
        left = 1 / w.left_mass;
        right = 1 / w.right_mass;
    }
    return sqrt(fmax(worst, here * (left + right) + before * left) + chain->spring_rate);
}

double bead_chain_flight(const struct bead_chain *chain)
{
    struct bead_contact_walk w;
    double gaps = 0;
    for (bead_contact_walk_start(&w, chain, false); bead_contact_walk_next(&w);)
        gaps += fmax(0, 0 - w.static_compression);
    return chain->speed > 0 ? gaps / chain->speed : 0;
}

double bead_chain_passage(const struct bead_chain *chain, double energy)
{
    struct bounds bounds = {0};
    struct bead_contact_walk w;
    double time = 0;
    for (bead_contact_walk_start(&w, chain, false); bead_contact_walk_next(&w);) {
        const double stiffness = remembered_bound(&bounds, &w, energy)->pushed;
        const double mass = isfinite(w.right_mass) ? fmax(w.left_mass, w.right_mass) : w.left_mass;
        time += stiffness > 0 ? sqrt(mass / stiffness) : 0;
    }
    return time + bead_chain_flight(chain);
}

void bead_derive_compressions(const struct bead_chain *chain, const double *u, size_t first, size_t last, double *compression)
{
    for (size_t k = first; k <= last && k < chain->contacts; k++) {
        const double next = k + 1 < chain->beads ? u[k + 1] : 0, d = chain->static_compression[k] + (u[k] - next);
        compression[k] = chain->law->one_sided ? fmax(0, d) : d;
    }
}

void bead_derive_forces(const struct bead_chain *chain, const double *u, double *contact_force, double *bead_force)
{
    const struct bead_law_spec *spec = &chain->spec->law;
    double before = 0;
    for (size_t k = 0; k < chain->beads; k++) {
        double next = k + 1 < chain->beads ? u[k + 1] : 0, d = chain->static_compression[k] + (u[k] - next);
        double force = k < chain->contacts ? chain->law->force(chain->stiffness[k], spec, d) : 0;
        /* the integrator subtracts the static part and sampling adds it again: so here, for equal last bits */
        contact_force[k] = (force - chain->static_force[k]) + chain->static_force[k];
        bead_force[k] = 0.5 * (before + contact_force[k]);
        before = contact_force[k];
    }
}
