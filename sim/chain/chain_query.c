/* What others ask a chain: its beads and contacts, its energy, and the bound on its frequencies from which the step follows. */
#include <math.h>

#include "sim/chain/chain_data.h"

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

/* On a tilt the striker falls a little further than it pushes: allow for the work over a millimetre. */
static const double tilt_reach = 1e-3;

double bead_chain_energy(const struct bead_chain *chain)
{
    double v = chain->spec->striker_velocity;
    return 0.5 * chain->mass[0] * v * v + chain->striker_force * tilt_reach;
}

/* Energy of contact k above its static state at compression d. */
static double excess(const struct bead_chain *chain, size_t k, double d)
{
    const struct bead_law_spec *spec = &chain->spec->law;
    double a = chain->stiffness[k], d0 = chain->static_compression[k];
    return chain->law->energy(a, spec, d) - chain->law->energy(a, spec, d0) - chain->static_force[k] * (d - d0);
}

/* Largest compression of contact k that `energy` allows: of the contact alone, or with a static part by bisection. */
static double bound(const struct bead_chain *chain, size_t k, double energy)
{
    double d0 = chain->static_compression[k];
    double high = d0 + chain->law->energy_compression(chain->stiffness[k], &chain->spec->law, energy);
    if (d0 == 0)
        return high;
    while (excess(chain, k, high) < energy && high < 1e30)
        high = d0 + 2 * (high - d0);
    double low = d0;
    for (int i = 0; i < 40; i++) {
        double middle = 0.5 * (low + high);
        *(excess(chain, k, middle) < energy ? &low : &high) = middle;
    }
    return high;
}

/* Cells repeat, so the bounds of the last few different contacts are kept: cells of two beads in any order have three. */
enum { BOUNDS_KEPT = 4 };
struct bounds {
    double stiffness[BOUNDS_KEPT], start[BOUNDS_KEPT], found[BOUNDS_KEPT];
    int next;
};

static double remembered_bound(struct bounds *known, const struct bead_chain *chain, size_t k, double energy)
{
    double a = chain->stiffness[k], d0 = chain->static_compression[k];
    for (int i = 0; i < BOUNDS_KEPT; i++) {
        if (known->stiffness[i] == a && known->start[i] == d0)
            return known->found[i];
    }
    int i = known->next;
    known->next = (i + 1) % BOUNDS_KEPT;
    known->stiffness[i] = a;
    known->start[i] = d0;
    return known->found[i] = bound(chain, k, energy);
}

double bead_chain_omega(const struct bead_chain *chain, double energy)
{
    struct bounds known = {{0}, {0}, {0}, 0};
    double worst = 0, before = 0, here = 0;
    for (size_t k = 0; k < chain->contacts; k++) {
        const struct bead_law_spec *spec = &chain->spec->law;
        double a = chain->stiffness[k], d = remembered_bound(&known, chain, k, energy);
        double after = fmax(chain->law->stiffness(a, spec, d), chain->law->stiffness(a, spec, -d));
        /* Gershgorin row of contact k - 1, now that its right neighbour is known. */
        if (k > 0) {
            double left = chain->inverse_mass[k - 1], right = chain->inverse_mass[k];
            worst = fmax(worst, here * (left + right) + before * left + after * right);
        }
        before = here;
        here = after;
    }
    size_t last = chain->contacts - 1;
    double right = last + 1 < chain->beads ? chain->inverse_mass[last + 1] : 0;
    worst = fmax(worst, here * (chain->inverse_mass[last] + right) + before * chain->inverse_mass[last]);
    return sqrt(worst);
}

double bead_chain_passage(const struct bead_chain *chain, double energy)
{
    struct bounds known = {{0}, {0}, {0}, 0};
    double time = 0;
    for (size_t k = 0; k < chain->contacts; k++) {
        double d = remembered_bound(&known, chain, k, energy);
        double stiffness = chain->law->stiffness(chain->stiffness[k], &chain->spec->law, d);
        double mass = k + 1 < chain->beads ? fmax(chain->mass[k], chain->mass[k + 1]) : chain->mass[k];
        time += stiffness > 0 ? sqrt(mass / stiffness) : 0;
    }
    return time;
}
