/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The participation of beads in the wave, relative to the clean wave, which is found by running a chain of equal cells. */
#include "sim/measure/participation.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/drive.h"
#include "sim/measure/measure_private.h"
#include "sim/run/play.h"

/* Least accuracy of the clean wave, and the passage times after which it is given up. */
static const double accuracy = 1e-6, patience = 100;

static double compression(const struct bead_chain *chain, const double *u, size_t k)
{
    return chain->static_compression[k] + (u[k] - (k + 1 < chain->beads ? u[k + 1] : 0));
}

double bead_chain_participation(const struct bead_chain *chain, const double *u, const double *v)
{
    double sum = 0, squares = 0, behind = 0;
    for (size_t j = 0; j < chain->beads; j++) {
        double ahead = 0;
        if (j < chain->contacts) {
            double a = chain->stiffness[j], d0 = chain->static_compression[j], d = compression(chain, u, j);
            ahead = bead_chain_share(chain, j) * (chain->law->energy(a, &chain->spec->law, d) -
                                                  chain->law->energy(a, &chain->spec->law, d0) - chain->static_force[j] * (d - d0));
        }
        double e = 0.5 * chain->mass[j] * v[j] * v[j] + bead_chain_spring_energy(chain, j, u[j]) + behind + ahead;
        sum += e;
        squares += e * e;
        behind = ahead;
    }
    return squares > 0 ? sum * sum / squares : NAN;
}

double bead_clean_index(size_t beads, double participation, double clean)
{
    double equal = 1 / (double)beads, index = (1 / participation - equal) / (1 / clean - equal);
    if (!(clean < (double)beads) || isnan(index))
        return NAN;
    return fmin(fmax(index, 0), 1);
}

/* ---- the clean wave ---- */

static bool same_cell(const struct bead_segment *a, const struct bead_segment *b)
{
    return a->cell_beads == b->cell_beads && memcmp(a->cell, b->cell, a->cell_beads * sizeof *a->cell) == 0;
}

/* The segment whose cell most beads of all segments belong to. */
static const struct bead_segment *usual_segment(const struct bead_chain_spec *spec)
{
    const struct bead_segment *usual = &spec->segments[0];
    size_t most = 0;
    for (size_t s = 0; s < spec->segment_count; s++) {
        size_t beads = 0;
        for (size_t t = 0; t < spec->segment_count; t++)
            beads += same_cell(&spec->segments[s], &spec->segments[t]) ? spec->segments[t].cell_beads * spec->segments[t].count : 0;
        if (beads > most) {
            most = beads;
            usual = &spec->segments[s];
        }
    }
    return usual;
}

/* Are most cells like that of `usual` reversed? */
static bool mostly_down(const struct bead_chain *chain, const struct bead_segment *usual)
{
    const char *spin = chain->spins;
    size_t up = 0, down = 0;
    for (size_t s = 0; s < chain->spec->segment_count; s++) {
        const struct bead_segment *segment = &chain->spec->segments[s];
        for (size_t c = 0; segment->cell_beads > 1 && c < segment->count && *spin; c++, spin++) {
            up += same_cell(segment, usual) && *spin == '1';
            down += same_cell(segment, usual) && *spin == '0';
        }
    }
    return down > up;
}

/* Put the beads of the clean chain's cell into `cell`, which has room for the largest; return their number. */
static size_t find_cell(const struct bead_chain *chain, size_t *cell)
{
    struct bead_places places = bead_places_find(chain);
    if (places.regular && 2 * (chain->beads - places.regular_from) >= chain->beads) {
        memcpy(cell, chain->material + places.regular_from, places.cell * sizeof *cell);
        return places.cell;
    }
    const struct bead_segment *usual = usual_segment(chain->spec);
    bool down = mostly_down(chain, usual);
    for (size_t i = 0; i < usual->cell_beads; i++)
        cell[i] = usual->cell[down ? usual->cell_beads - 1 - i : i];
    return usual->cell_beads;
}

static enum bead_error participation_measure(const struct bead_chain *chain, double tolerance_factor, double *clean,
                                             struct bead_message *msg)
{
    struct bead_simulate asked = chain->scene->simulate;
    asked.accuracy = (asked.step > 0 ? accuracy : fmin(asked.accuracy, accuracy)) * tolerance_factor;
    asked.step = 0;
    struct bead_consumer consumer = {.needs = {.states = true}};
    const struct bead_play play = {.chains = &chain,
                                   .chain_count = 1,
                                   .simulate = &asked,
                                   .kernels = bead_kernels_find(NULL),
                                   .consumers = &consumer,
                                   .consumer_count = 1,
                                   .end = INFINITY,
                                   .needed = INFINITY,
                                   .passage = BEAD_PASSAGE_OF_FRONT,
                                   .patience = patience,
                                   .threads = 1};
    struct bead_played played;
    enum bead_error err = bead_play(&play, &played, msg);
    if (!err)
        *clean = bead_chain_participation(chain, played.outcomes[0].arrived.displacement, played.outcomes[0].arrived.velocity);
    bead_played_free(&played);
    return err;
}

enum bead_error bead_participation_clean(const struct bead_chain *chain, double tolerance_factor, double *clean,
                                         struct bead_message *msg)
{
    size_t most = BEAD_PLACE_PERIOD;
    *clean = NAN;
    /* No front is watched if more than the striker moves at first. */
    if (chain->spec->segment_count == 0 || chain->spec->start_count > 0 || bead_is_driven(chain->spec) ||
        !(bead_chain_energy(chain) > 0))
        return BEAD_OK;
    for (size_t s = 0; s < chain->spec->segment_count; s++)
        most = chain->spec->segments[s].cell_beads > most ? chain->spec->segments[s].cell_beads : most;
    size_t *cell;
    BEAD_TRY(bead_new(&cell, most, msg, "a cell of %zu beads", most));
    const size_t beads = find_cell(chain, cell), all = chain->beads - 1 < BEAD_ORDER_BEADS ? chain->beads - 1 : BEAD_ORDER_BEADS;
    /* The same chain, of equal cells. */
    struct bead_segment segment = {.cell = cell, .cell_beads = beads, .count = (all + beads - 1) / beads, .spins = BEAD_SPINS_UP};
    struct bead_chain_spec spec = *chain->spec;
    struct bead_chain *made = NULL;
    struct bead_message why = {""};
    spec.segments = &segment;
    spec.segment_count = 1;
    enum bead_error err = bead_chain_create_of(chain->scene, &spec, &made, &why);
    if (!err)
        err = participation_measure(made, tolerance_factor, clean, &why);
    bead_chain_destroy(made);
    free(cell);
    return err == BEAD_ERROR_MEMORY ? bead_fail(msg, err, "%s", why.text) : BEAD_OK; /* other errors: no clean wave */
}
