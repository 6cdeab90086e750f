/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a chain from its part of the scene: first the outline, which is enough for plans, then the arrays of its beads and
 * contacts. Runs do not change it. */

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/contact_walk.h"
#include "sim/chain/drive.h"
#include "sim/chain/spins.h"
#include "sim/chain/system.h"
#include "sim/yaml/yaml.h"

static const double gravity = 9.80665; /* m/s^2, standard */
/* Radius of the drawn masses of a string, as a part of the distance that their motion leaves (at half they would touch), and the
 * least, as a part of the distance at rest. Chosen by eye. */
static const double radius_of_points = 0.45, least_radius = 0.15;

/* The last part of a path that the scene has. NULL: the scene was not read from a text. */
static const struct bead_node *last_given(const struct bead_chain *chain, const char *path)
{
    const char *const own = "chain";
    const struct bead_node *node = chain->scene->tree ? bead_yaml_root(chain->scene->tree) : NULL;
    if (strncmp(path, own, strlen(own)) == 0 && chain->spec->node) {
        node = chain->spec->node;
        path += strlen(own) + strspn(path + strlen(own), ".");
    }
    while (node && *path) {
        char key[32];
        const size_t length = strcspn(path, ".");
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        const struct bead_node *value = bead_node_get(node, key, NULL);
        if (!value)
            break;
        node = value;
        path += length + strspn(path + length, ".");
    }
    return node;
}

const char *bead_chain_place(const struct bead_chain *chain, const char *path, char *text, size_t size)
{
    const struct bead_node *node = last_given(chain, path);
    const char *file = node && node->origin ? node->origin : chain->scene->file;
    *text = '\0';
    if (node)
        snprintf(text, size, "%.64s:%zu:%zu: ", file, node->place.line, node->place.column);
    else if (file && *file)
        snprintf(text, size, "%.64s: ", file);
    return text;
}

static size_t count_spins(const struct bead_chain_spec *spec)
{
    size_t spins = 0;
    for (size_t s = 0; s < spec->segment_count; s++)
        spins += spec->segments[s].cell_beads > 1 ? spec->segments[s].count : 0;
    return spins;
}

uint64_t bead_chain_bytes(const struct bead_chain *chain)
{
    return chain->beads * (sizeof *chain->material + (chain->spring_rate > 0 ? 8 : 7) * sizeof(double));
}

/* Arrays of all beads are filled at once: refuse a chain that does not fit, before the system kills the program halfway. */
static enum bead_error check_memory(const struct bead_chain *chain, struct bead_message *msg)
{
    char what[200], place[128];
    snprintf(what, sizeof what, "%schain: %zu beads", bead_chain_place(chain, "chain", place, sizeof place), chain->beads);
    return bead_memory_check(bead_chain_bytes(chain), what, msg);
}

static void free_arrays(struct bead_chain *chain)
{
    double **array[] = {&chain->mass,         &chain->inverse_mass,       &chain->radius, &chain->position, &chain->stiffness,
                        &chain->static_force, &chain->static_compression, &chain->spring};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++) {
        free(*array[i]);
        *array[i] = NULL;
    }
    free(chain->material);
    chain->material = NULL;
}

static enum bead_error allocate(struct bead_chain *chain, struct bead_message *msg)
{
    size_t n = chain->beads;
    BEAD_TRY(check_memory(chain, msg));
    chain->material = calloc(n, sizeof *chain->material);
    chain->mass = calloc(n, sizeof(double));
    chain->inverse_mass = calloc(n, sizeof(double));
    chain->radius = calloc(n, sizeof(double));
    chain->position = calloc(n, sizeof(double));
    chain->stiffness = calloc(n, sizeof(double));
    chain->static_force = calloc(n, sizeof(double));
    chain->static_compression = calloc(n, sizeof(double));
    bool all = chain->material && chain->mass && chain->inverse_mass && chain->radius && chain->position && chain->stiffness &&
               chain->static_force && chain->static_compression;
    if (chain->spring_rate > 0)
        all = (chain->spring = calloc(n, sizeof(double))) && all;
    if (all)
        return BEAD_OK;
    free_arrays(chain);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a chain");
}

static void write_spins(const struct bead_segment *segment, char *digits)
{
    if (segment->spins == BEAD_SPINS_DIGITS)
        memcpy(digits, segment->digits, segment->count);
    else if (segment->spins == BEAD_SPINS_RANDOM)
        bead_spins_draw(digits, segment->count, segment->magnetism, segment->seed, 0);
    else
        memset(digits, segment->spins == BEAD_SPINS_UP ? '1' : '0', segment->count);
}

/* Is one cell the mirror image of the other, and different from it? */
static bool mirrors(const struct bead_segment *a, const struct bead_segment *b)
{
    bool same = a->cell_beads == b->cell_beads, turned = same;
    for (size_t i = 0; turned && i < a->cell_beads; i++) {
        same = same && a->cell[i] == b->cell[i];
        turned = a->cell[i] == b->cell[b->cell_beads - 1 - i];
    }
    return turned && !same;
}

/* The magnetism of the cells whose spins the scene gives; other cells count only if there are no such cells. Of these, the first
 * written is up, and so are all except its mirror image. */
static double find_magnetism(const struct bead_chain *chain)
{
    double up[2] = {0, 0}, all[2] = {0, 0};
    const char *spin = chain->spins;
    const struct bead_segment *first = NULL;
    for (size_t s = 0; s < chain->spec->segment_count; s++) {
        const struct bead_segment *segment = &chain->spec->segments[s];
        if (segment->cell_beads > 1 && !segment->spins_given && !first)
            first = segment;
        const bool down = first && !segment->spins_given && mirrors(first, segment);
        for (size_t cell = 0; segment->cell_beads > 1 && cell < segment->count; cell++, spin++) {
            up[segment->spins_given] += (*spin == '1') != down;
            all[segment->spins_given]++;
        }
    }
    bool given = all[1] > 0;
    return all[given] > 0 ? fabs(2 * up[given] - all[given]) / all[given] : 1;
}

static enum bead_error draw_spins(struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = chain->spec;
    BEAD_TRY(bead_new(&chain->spins, count_spins(spec) + 1, msg, "a chain"));
    char *spin = chain->spins;
    for (size_t s = 0; s < spec->segment_count; s++) {
        if (spec->segments[s].cell_beads == 1)
            continue;
        write_spins(&spec->segments[s], spin);
        spin += spec->segments[s].count;
    }
    chain->magnetism = find_magnetism(chain);
    return BEAD_OK;
}

static enum bead_error find_sensors(struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = chain->spec;
    size_t sensors = 0, at = 1;
    for (size_t s = 0; s < spec->segment_count; s++)
        sensors += spec->segments[s].sensor != NULL;
    BEAD_TRY(bead_new(&chain->sensors, sensors + 1, msg, "a chain"));
    for (size_t s = 0; s < spec->segment_count; s++) {
        if (spec->segments[s].sensor)
            chain->sensors[chain->sensor_count++] = (struct bead_sensor){spec->segments[s].sensor, at};
        at += spec->segments[s].cell_beads * spec->segments[s].count;
    }
    return BEAD_OK;
}

/* A pendulum of length L swings to both sides as if held by a spring m g / L, as long as the angle u / L is small: L. D. Landau and
 * E. M. Lifshitz, Mechanics, section 21. */
double bead_chain_pendulum_of(const struct bead_chain *chain, size_t material)
{
    return chain->spec->cradle > 0 ? chain->scene->materials[material].mass * gravity / chain->spec->cradle : 0;
}

double bead_chain_spring_of(const struct bead_chain *chain, size_t material)
{
    return chain->scene->materials[material].spring + bead_chain_pendulum_of(chain, material);
}

static void count_spring(struct bead_chain *chain, size_t material)
{
    if (material != SIZE_MAX) /* the wall */
        chain->spring_rate =
            fmax(chain->spring_rate, bead_chain_spring_of(chain, material) / chain->scene->materials[material].mass);
}

/* Masses need no check: their materials were checked. Finds the fastest spring on the way. */
static enum bead_error check_contacts(struct bead_chain *chain, struct bead_message *msg)
{
    struct bead_contact_walk w;
    char place[128];
    for (bead_contact_walk_start(&w, chain, true); bead_contact_walk_next(&w);) {
        if (!(w.stiffness > 0) || !isfinite(w.stiffness) || !isfinite(w.static_compression))
            return bead_fail(msg, BEAD_ERROR_SCENE,
                             "%schain: a contact's stiffness is not a positive finite number: check materials and law",
                             bead_chain_place(chain, "chain", place, sizeof place));
        count_spring(chain, w.left);
        count_spring(chain, w.right);
    }
    return BEAD_OK;
}

/* The energy of the beads that do not start at rest, and the largest velocity. One that is displaced, of mass m, is counted with
 * the velocity that the energy E of its contacts can give it, sqrt(2 E/m). */
static void find_start(struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = chain->spec;
    const struct bead_start *left = spec->starts, *end = left ? left + spec->start_count : left, rest = {0};
    struct bead_contact_walk w;
    chain->speed = fabs(spec->striker_velocity);
    for (bead_contact_walk_start(&w, chain, false); left < end && bead_contact_walk_next(&w);) {
        const struct bead_start *next = left->bead == w.k ? left + 1 : left;
        const struct bead_start *right = next < end && next->bead == w.k + 1 ? next : &rest, *here = next > left ? left : &rest;
        const double change = here->displacement - right->displacement;
        const double held = chain->spring_rate > 0 ? 0.5 * bead_chain_spring_of(chain, w.left) : 0;
        const double stored = (change != 0 ? bead_contact_walk_excess(&w, w.static_compression + change) : 0) +
                              held * (here->displacement * here->displacement);
        chain->started += 0.5 * w.left_mass * (here->velocity * here->velocity) + stored;
        chain->speed = fmax(chain->speed, fmax(fabs(here->velocity), sqrt(2 * fmax(stored, 0) / w.left_mass)));
        if (right != &rest && w.k + 2 == chain->beads && w.k + 1 == chain->contacts) { /* at a free end */
            const double pulled = chain->spring_rate > 0 ? bead_chain_spring_of(chain, w.right) : 0;
            const double swing = 0.5 * pulled * (right->displacement * right->displacement);
            chain->started += 0.5 * w.right_mass * (right->velocity * right->velocity) + swing;
            chain->speed = fmax(chain->speed, fmax(fabs(right->velocity), sqrt(2 * swing / w.right_mass)));
        }
        left = next;
    }
}

/* The energy that a drive will bring in is unknown: counts the energy of its bead at the largest velocity. */
static void find_drive(struct bead_chain *chain)
{
    const size_t bead = chain->spec->drive.bead;
    struct bead_contact_walk w;
    for (bead_contact_walk_start(&w, chain, false); bead_contact_walk_next(&w) && w.k < bead;)
        ;
    const double mass = w.k == bead ? w.left_mass : w.right_mass, speed = bead_drive_speed(chain, mass, w.stiffness);
    chain->speed = fmax(chain->speed, speed);
    chain->started += 0.5 * mass * (speed * speed);
}

static enum bead_error outline(struct bead_chain *chain, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = chain->spec;
    chain->beads = spec->system->count(spec, chain->scene->simulate.accuracy);
    if (spec->system->has_contacts) {
        chain->contacts = chain->beads - (spec->wall == BEAD_WALL_NONE);
        chain->slope = gravity * bead_sin(spec->tilt);
        chain->striker_mass = chain->scene->materials[spec->striker_material].mass;
        chain->striker_force = chain->striker_mass * chain->slope;
    }
    enum bead_error err = draw_spins(chain, msg);
    if (!err)
        err = find_sensors(chain, msg);
    if (!err)
        err = check_contacts(chain, msg);
    char place[128];
    if (!err && !bead_chain_find_end(chain))
        err = bead_fail(msg, BEAD_ERROR_SCENE,
                        "%schain.wall: `absorbing` needs a stiffness of the contacts at rest: give `precompression`, or the "
                        "impedance, {absorbing: 20 kg/s}",
                        bead_chain_place(chain, "chain.wall", place, sizeof place));
    if (err || !spec->system->has_contacts)
        return err;
    find_start(chain);
    if (bead_is_driven(spec))
        find_drive(chain);
    const double energy = bead_chain_energy(chain);
    chain->energy = NAN; /* until omega is known */
    chain->omega = bead_chain_omega(chain, energy);
    chain->energy = energy;
    return BEAD_OK;
}

/* For systems without contacts: all masses are 1, and the arrays of contacts stay zero. */
static void lay_points(struct bead_chain *chain)
{
    const struct bead_system *system = chain->spec->system;
    double first = 0, spacing = 1;
    system->places(chain->spec, chain->beads, &first, &spacing);
    const double nearest = 1 - (system->approach ? system->approach(chain->spec) : 0);
    for (size_t i = 0; i < chain->beads; i++) {
        chain->mass[i] = chain->inverse_mass[i] = 1;
        chain->radius[i] = fmax(least_radius, radius_of_points * nearest) * spacing;
        chain->position[i] = first + (double)i * spacing;
    }
}

static void lay_contacts(struct bead_chain *chain)
{
    struct bead_contact_walk w;
    for (bead_contact_walk_start(&w, chain, false); bead_contact_walk_next(&w);) {
        chain->material[w.k] = w.left;
        if (w.k + 1 < chain->beads)
            chain->material[w.k + 1] = w.right;
        chain->stiffness[w.k] = w.stiffness;
        if (w.static_compression == 0) /* already zero: untouched pages take no memory */
            continue;
        chain->static_compression[w.k] = w.static_compression;
        chain->static_force[w.k] = w.static_force;
    }
}

static void lay_beads(struct bead_chain *chain)
{
    for (size_t i = 0; i < chain->beads; i++) {
        const struct bead_material *material = &chain->scene->materials[chain->material[i]];
        chain->mass[i] = material->mass;
        chain->inverse_mass[i] = 1 / material->mass;
        chain->radius[i] = material->radius;
        if (chain->spring)
            chain->spring[i] = bead_chain_spring_of(chain, chain->material[i]);
    }
    if (chain->spec->drive.displacement) /* nothing moves it otherwise */
        chain->inverse_mass[chain->spec->drive.bead] = 0;
    /* The centre of bead 1 is at 0, the striker to its left. */
    chain->position[0] = -(chain->radius[0] + chain->radius[1]);
    for (size_t i = 2; i < chain->beads; i++)
        chain->position[i] =
            chain->position[i - 1] + chain->radius[i - 1] + chain->radius[i] + fmax(0 - chain->static_compression[i - 1], 0);
}

enum bead_error bead_chain_lay(struct bead_chain *chain, struct bead_message *msg)
{
    if (chain->mass)
        return BEAD_OK;
    BEAD_TRY(allocate(chain, msg));
    if (chain->spec->system->has_contacts) {
        lay_contacts(chain);
        lay_beads(chain);
    } else {
        lay_points(chain);
    }
    return BEAD_OK;
}

enum bead_error bead_chain_create(const struct bead_scene *scene, size_t index, struct bead_chain **chain, struct bead_message *msg)
{
    *chain = NULL;
    if (index >= scene->chain_count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "chain %zu: the scene has %zu", index, scene->chain_count);
    return bead_chain_create_of(scene, &scene->chains[index], chain, msg);
}

enum bead_error bead_chain_outline(const struct bead_scene *scene, const struct bead_chain_spec *spec, struct bead_chain **chain,
                                   struct bead_message *msg)
{
    *chain = NULL;
    struct bead_chain *made;
    BEAD_TRY(bead_new(&made, 1, msg, "a chain"));
    made->scene = scene;
    made->spec = spec;
    made->law = spec->law.row;
    enum bead_error err = outline(made, msg);
    if (err)
        bead_chain_destroy(made);
    else
        *chain = made;
    return err;
}

enum bead_error bead_chain_create_of(const struct bead_scene *scene, const struct bead_chain_spec *spec, struct bead_chain **chain,
                                     struct bead_message *msg)
{
    enum bead_error err = bead_chain_outline(scene, spec, chain, msg);
    if (!err)
        err = bead_chain_lay(*chain, msg);
    if (err) {
        bead_chain_destroy(*chain);
        *chain = NULL;
    }
    return err;
}

void bead_chain_destroy(struct bead_chain *chain)
{
    if (!chain)
        return;
    free_arrays(chain);
    free(chain->spins);
    free(chain->sensors);
    free(chain->own);
    free(chain);
}
