/* Makes a chain from its part of the scene: beads, spins, contacts and their static forces. Runs take it from here, unchanged. */
#include "beadreel/chain.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/spins.h"
#include "sim/chain/system.h"

static const double gravity = 9.80665; /* m/s^2, standard */
/* How large masses of a string are drawn, in parts of their distance. */
static const double radius_of_points = 0.3;

static enum bead_error out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a chain");
}

/* `file:line:column: ` of an error in the chain's own text. */
static enum bead_error wrong(const struct bead_chain *chain, struct bead_place place, struct bead_message *msg, const char *what)
{
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s", chain->scene->file, place.line, place.column, what);
}

static size_t count_beads(const struct bead_chain_spec *spec)
{
    size_t beads = 1;
    for (size_t s = 0; s < spec->segment_count; s++)
        beads += spec->segments[s].cell_beads * spec->segments[s].count;
    return beads;
}

static size_t count_spins(const struct bead_chain_spec *spec)
{
    size_t spins = 0;
    for (size_t s = 0; s < spec->segment_count; s++)
        spins += spec->segments[s].cell_beads > 1 ? spec->segments[s].count : 0;
    return spins;
}

/* Arrays of all beads are filled at once: rather refuse what does not fit than be ended by the system halfway. */
static enum bead_error check_memory(const struct bead_chain *chain, struct bead_message *msg)
{
    char what[128];
    struct bead_place place = chain->spec->place;
    snprintf(what, sizeof what, "%.64s:%zu:%zu: chain: %zu beads", chain->scene->file, place.line, place.column, chain->beads);
    return bead_memory_check(chain->beads * (sizeof *chain->material + 7 * sizeof(double)), what, msg);
}

static enum bead_error allocate(struct bead_chain *chain, struct bead_message *msg)
{
    size_t n = chain->beads, spins = count_spins(chain->spec), sensors = 0;
    enum bead_error err = check_memory(chain, msg);
    if (err)
        return err;
    for (size_t s = 0; s < chain->spec->segment_count; s++)
        sensors += chain->spec->segments[s].sensor != NULL;
    chain->material = calloc(n, sizeof *chain->material);
    chain->mass = calloc(n, sizeof(double));
    chain->inverse_mass = calloc(n, sizeof(double));
    chain->radius = calloc(n, sizeof(double));
    chain->position = calloc(n, sizeof(double));
    chain->stiffness = calloc(n, sizeof(double));
    chain->static_force = calloc(n, sizeof(double));
    chain->static_compression = calloc(n, sizeof(double));
    chain->spins = calloc(spins + 1, 1);
    chain->sensors = calloc(sensors + 1, sizeof *chain->sensors);
    bool all = chain->material && chain->mass && chain->inverse_mass && chain->radius && chain->position && chain->stiffness &&
               chain->static_force && chain->static_compression && chain->spins && chain->sensors;
    return all ? BEAD_OK : out_of_memory(msg);
}

/* Spins of one segment into `digits`. */
static void write_spins(const struct bead_segment *segment, char *digits)
{
    if (segment->spins == BEAD_SPINS_DIGITS)
        memcpy(digits, segment->digits, segment->count);
    else if (segment->spins == BEAD_SPINS_RANDOM)
        bead_spins_draw(digits, segment->count, segment->magnetism, segment->seed, 0);
    else
        memset(digits, segment->spins == BEAD_SPINS_UP ? '1' : '0', segment->count);
}

/* Place the beads of one segment from bead `at` on; returns the next free bead. */
static size_t lay_segment(struct bead_chain *chain, const struct bead_segment *segment, size_t at, char *spins)
{
    size_t length = segment->cell_beads;
    if (length > 1)
        write_spins(segment, spins);
    for (size_t cell = 0; cell < segment->count; cell++) {
        bool reversed = length > 1 && spins[cell] == '0';
        for (size_t i = 0; i < length; i++)
            chain->material[at++] = segment->cell[reversed ? length - 1 - i : i];
    }
    return at;
}

static void lay_beads(struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = chain->spec;
    size_t at = 1, spins = 0;
    chain->material[0] = spec->striker_material;
    for (size_t s = 0; s < spec->segment_count; s++) {
        const struct bead_segment *segment = &spec->segments[s];
        if (segment->sensor)
            chain->sensors[chain->sensor_count++] = (struct bead_sensor){segment->sensor, at};
        at = lay_segment(chain, segment, at, chain->spins + spins);
        spins += segment->cell_beads > 1 ? segment->count : 0;
    }
    for (size_t i = 0; i < chain->beads; i++) {
        const struct bead_material *material = &chain->scene->materials[chain->material[i]];
        chain->mass[i] = material->mass;
        chain->inverse_mass[i] = 1 / material->mass;
        chain->radius[i] = material->radius;
    }
    /* From bead 1 outwards, the striker at its left. */
    chain->position[0] = -(chain->radius[0] + chain->radius[1]);
    for (size_t i = 2; i < chain->beads; i++)
        chain->position[i] = chain->position[i - 1] + chain->radius[i - 1] + chain->radius[i];
}

/* The magnetism is that of the cells whose spins the scene gives; fixed cells beside them do not count. */
static double find_magnetism(const struct bead_chain *chain)
{
    double up[2] = {0, 0}, all[2] = {0, 0};
    const char *spin = chain->spins;
    for (size_t s = 0; s < chain->spec->segment_count; s++) {
        const struct bead_segment *segment = &chain->spec->segments[s];
        for (size_t cell = 0; segment->cell_beads > 1 && cell < segment->count; cell++, spin++) {
            up[segment->spins_given] += *spin == '1';
            all[segment->spins_given]++;
        }
    }
    bool given = all[1] > 0;
    return all[given] > 0 ? fabs(2 * up[given] - all[given]) / all[given] : 1;
}

static double stiffness_of(const struct bead_chain *chain, size_t k)
{
    const struct bead_law_spec *law = &chain->spec->law;
    const struct bead_material *materials = chain->scene->materials, *left = &materials[chain->material[k]];
    bool at_wall = k + 1 == chain->beads;
    if (at_wall && chain->spec->wall == BEAD_WALL_RIGID)
        return law->row->coefficient(law, left, NULL, true);
    const struct bead_material *right = &materials[at_wall ? chain->spec->wall_material : chain->material[k + 1]];
    return law->row->coefficient(law, left, right, at_wall);
}

/* Static force: precompression, and on a tilt the weight of the beads above (the striker has not landed yet,
 * so its own weight stays out of balance). The stored force is that of the stored compression, to the bit,
 * so that a chain at rest feels exactly nothing. */
static void compress(struct bead_chain *chain)
{
    double weight = 0, slope = gravity * bead_sin(chain->spec->tilt);
    for (size_t k = 0; k < chain->contacts; k++) {
        weight += k > 0 ? chain->mass[k] * slope : 0;
        double force = chain->spec->precompression + weight, a = chain->stiffness[k];
        if (!(force > 0)) /* zero already: pages that nobody writes to cost nothing */
            continue;
        double d = chain->law->compression(a, &chain->spec->law, force);
        chain->static_compression[k] = d;
        chain->static_force[k] = chain->law->force(a, &chain->spec->law, d);
    }
    chain->striker_force = chain->mass[0] * slope;
}

/* Masses have been checked with their materials. */
static enum bead_error chain_check(const struct bead_chain *chain, struct bead_message *msg)
{
    for (size_t k = 0; k < chain->contacts; k++) {
        if (!(chain->stiffness[k] > 0) || !isfinite(chain->stiffness[k]) || !isfinite(chain->static_compression[k]))
            return wrong(chain, chain->spec->place, msg,
                         "chain: a contact's stiffness is not a positive finite number: check materials and law");
    }
    return BEAD_OK;
}

/* Points of an equation: masses of 1 where there are masses; the arrays of contacts stay zero. */
static enum bead_error fill_points(struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_equation_spec *spec = &chain->spec->equation;
    double first = 0, spacing = 1;
    chain->beads = chain->system->points(spec, chain->scene->simulate.accuracy);
    enum bead_error err = allocate(chain, msg);
    if (err)
        return err;
    chain->system->places(spec, chain->beads, &first, &spacing);
    for (size_t i = 0; i < chain->beads; i++) {
        chain->mass[i] = chain->inverse_mass[i] = 1;
        chain->radius[i] = radius_of_points * spacing;
        chain->position[i] = first + (double)i * spacing;
    }
    chain->magnetism = 1;
    return BEAD_OK;
}

static enum bead_error chain_fill(struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = chain->spec;
    if (chain->system)
        return fill_points(chain, msg);
    chain->beads = count_beads(spec);
    chain->contacts = chain->beads - (spec->wall == BEAD_WALL_NONE);
    enum bead_error err = allocate(chain, msg);
    if (err)
        return err;
    lay_beads(chain);
    chain->magnetism = find_magnetism(chain);
    for (size_t k = 0; k < chain->contacts; k++)
        chain->stiffness[k] = stiffness_of(chain, k);
    compress(chain);
    return chain_check(chain, msg);
}

enum bead_error bead_chain_create(const struct bead_scene *scene, size_t index, struct bead_chain **chain, struct bead_message *msg)
{
    *chain = NULL;
    if (index >= scene->chain_count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "chain %zu: the scene has %zu", index, scene->chain_count);
    return bead_chain_create_of(scene, &scene->chains[index], chain, msg);
}

enum bead_error bead_chain_create_of(const struct bead_scene *scene, const struct bead_chain_spec *spec, struct bead_chain **chain,
                                     struct bead_message *msg)
{
    *chain = NULL;
    struct bead_chain *made = calloc(1, sizeof *made);
    if (!made)
        return out_of_memory(msg);
    made->scene = scene;
    made->spec = spec;
    made->law = spec->law.row;
    made->system = made->spec->equation.system;
    enum bead_error err = chain_fill(made, msg);
    if (err)
        bead_chain_destroy(made);
    else
        *chain = made;
    return err;
}

void bead_chain_destroy(struct bead_chain *chain)
{
    if (!chain)
        return;
    free(chain->material);
    free(chain->mass);
    free(chain->inverse_mass);
    free(chain->radius);
    free(chain->position);
    free(chain->stiffness);
    free(chain->static_force);
    free(chain->static_compression);
    free(chain->spins);
    free(chain->sensors);
    free(chain);
}
