#include "render/magnify.h"

#include <math.h>

#include "beadreel/law.h"

static const double share = 0.25; /* of a radius */

double bead_compression_scale(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const struct bead_law *law = bead_law_find(spec->law.kind);
    const double *mass = bead_chain_mass(chain);
    if (!law || bead_chain_contacts(chain) < 1 || !(spec->striker_velocity != 0))
        return 0;
    double reduced = bead_chain_beads(chain) < 2 ? mass[0] : mass[0] * mass[1] / (mass[0] + mass[1]);
    double energy = 0.5 * reduced * spec->striker_velocity * spec->striker_velocity;
    double d = law->energy_compression(bead_chain_stiffness(chain)[0], &spec->law, energy);
    return isfinite(d) && d > 0 ? d : 0;
}

static double round_factor(double x)
{
    static const double steps[] = {8, 6, 5, 4, 3, 2, 1.5, 1};
    if (!(x > 1))
        return 1;
    double unit = pow(10, floor(log10(x)));
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        if (x >= steps[i] * unit)
            return steps[i] * unit;
    }
    return unit;
}

double bead_magnify_auto(const struct bead_chain *const *chains, size_t count)
{
    double factor = INFINITY;
    for (size_t c = 0; c < count; c++) {
        double radius = INFINITY, compression = bead_compression_scale(chains[c]);
        for (size_t i = 0; i < bead_chain_beads(chains[c]); i++)
            radius = fmin(radius, bead_chain_radius(chains[c])[i]);
        if (compression > 0)
            factor = fmin(factor, share * radius / compression);
    }
    return isfinite(factor) ? round_factor(factor) : 1;
}
