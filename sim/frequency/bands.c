/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bands of cells, and modes of chains. */
#include "sim/frequency/bands.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"

/* Work grows as the square of the number of beads: 20000 take about two minutes. */
enum { MOST = 20000 };

/* ---- bands ---- */

static double spring_between(const struct bead_chain *chain, size_t left, size_t right)
{
    const struct bead_chain_spec *spec = chain->spec;
    const struct bead_material *all = chain->scene->materials;
    const double a = chain->law->coefficient(&spec->law, &all[left], &all[right], false);
    return chain->law->stiffness(a, &spec->law, chain->law->compression(a, &spec->law, spec->precompression));
}

static enum bead_error make_cell(const struct bead_chain *chain, const struct bead_segment *segment, struct bead_jacobi *cell,
                                 struct bead_message *msg)
{
    const size_t n = segment->cell_beads;
    BEAD_FREED double *masses = NULL;
    BEAD_TRY(bead_new(&masses, 3 * n, msg, "a cell"));
    for (size_t j = 0; j < n; j++) {
        masses[j] = chain->scene->materials[segment->cell[j]].mass;
        masses[n + j] = spring_between(chain, segment->cell[j], segment->cell[(j + 1) % n]);
        masses[2 * n + j] = bead_chain_spring_of(chain, segment->cell[j]);
    }
    return bead_jacobi_create(masses, masses + n, masses + 2 * n, n, false, cell, msg);
}

static bool same_cell(const struct bead_segment *a, const struct bead_segment *b)
{
    return a->cell_beads == b->cell_beads && memcmp(a->cell, b->cell, a->cell_beads * sizeof *a->cell) == 0;
}

/* Does an earlier segment repeat the same cell? */
static bool seen(const struct bead_chain_spec *spec, size_t s)
{
    for (size_t i = 0; i < s; i++) {
        if (!spec->segments[i].each && spec->segments[i].count > 1 && same_cell(&spec->segments[i], &spec->segments[s]))
            return true;
    }
    return false;
}

enum bead_error bead_media_find(const struct bead_chain *chain, struct bead_medium **media, size_t *count, struct bead_message *msg)
{
    const struct bead_chain_spec *spec = chain->spec;
    size_t bead = 1;
    *count = 0;
    BEAD_TRY(bead_new(media, spec->segment_count, msg, "bands"));
    for (size_t s = 0; s < spec->segment_count; s++) {
        const struct bead_segment *segment = &spec->segments[s];
        const size_t beads = segment->cell_beads * segment->count;
        if (!segment->each && segment->count > 1 && !seen(spec, s)) {
            struct bead_medium *medium = &(*media)[(*count)++];
            medium->first = bead;
            medium->last = bead + beads - 1;
            BEAD_TRY(make_cell(chain, segment, &medium->cell, msg));
        }
        bead += beads;
    }
    return BEAD_OK;
}

void bead_media_free(struct bead_medium *media, size_t count)
{
    for (size_t i = 0; media && i < count; i++)
        bead_jacobi_free(&media[i].cell);
    free(media);
}

void bead_band(const struct bead_medium *medium, size_t index, double ends[2])
{
    const double a = bead_jacobi_frequency(&medium->cell, index, 1), b = bead_jacobi_frequency(&medium->cell, index, -1);
    ends[0] = fmin(a, b);
    ends[1] = fmax(a, b);
}

bool bead_gap(const struct bead_medium *medium, size_t index, double ends[2])
{
    static const double rounding = 1e-7; /* bands that touch: square roots of equal eigenvalues, each off by rounding */
    double here[2], next[2];
    if (index + 1 >= medium->cell.count)
        return false;
    bead_band(medium, index, here);
    bead_band(medium, index + 1, next);
    ends[0] = here[1];
    ends[1] = next[0];
    return ends[1] - ends[0] > rounding * ends[1];
}

/* ---- modes ---- */

static enum bead_error make_matrix(const struct bead_chain *chain, struct bead_jacobi *matrix, struct bead_message *msg)
{
    BEAD_FREED double *springs = NULL;
    BEAD_TRY(bead_new(&springs, chain->beads, msg, "modes"));
    for (size_t k = 0; k < chain->contacts; k++)
        springs[k] = chain->law->stiffness(chain->stiffness[k], &chain->spec->law, chain->static_compression[k]);
    return bead_jacobi_create(chain->mass, springs, chain->spring, chain->beads, true, matrix, msg);
}

/* Thouless: the product of the end elements of a normalised vector is that of the elements beside the diagonal, over that of the
 * differences to all other eigenvalues. */
static double length_of(const struct bead_jacobi *matrix, const struct bead_mode *modes, size_t mode)
{
    const double turn = 2 * 3.14159265358979323846, own = modes[mode].frequency * turn;
    double sum = 0;
    for (size_t i = 0; i < matrix->count; i++) {
        const double other = modes[i].frequency * turn;
        if (i != mode)
            sum += bead_log(fabs((other - own) * (other + own)));
        if (i + 1 < matrix->count)
            sum -= bead_log(fabs(matrix->beside[i]));
    }
    return (double)(matrix->count - 1) / sum;
}

static enum bead_error find_modes(const struct bead_jacobi *matrix, struct bead_mode *modes, struct bead_message *msg)
{
    const size_t n = matrix->count;
    BEAD_FREED double *vector = NULL;
    BEAD_TRY(bead_new(&vector, 3 * n, msg, "modes"));
    for (size_t i = 0; i < n; i++) {
        double squares = 0, centre = 0;
        modes[i].frequency = bead_jacobi_frequency(matrix, i, 1);
        bead_jacobi_vector(matrix, modes[i].frequency, vector, vector + n);
        for (size_t j = 0; j < n; j++) {
            const double e = vector[j] * vector[j];
            squares += e * e;
            centre += (double)j * e;
        }
        modes[i].participation = 1 / squares;
        modes[i].centre = centre;
    }
    for (size_t i = 0; i < n; i++)
        modes[i].length = length_of(matrix, modes, i);
    return BEAD_OK;
}

enum bead_error bead_modes_find(const struct bead_chain *chain, struct bead_mode **modes, struct bead_message *msg)
{
    struct bead_jacobi matrix = {0};
    *modes = NULL;
    if (chain->beads > MOST)
        return bead_fail(msg, BEAD_ERROR_SCENE, "eigenmodes of %zu beads: at most %d are found", chain->beads, MOST);
    enum bead_error err = make_matrix(chain, &matrix, msg);
    if (!err)
        err = bead_new(modes, chain->beads, msg, "the modes of %zu beads", chain->beads);
    if (!err)
        err = find_modes(&matrix, *modes, msg);
    bead_jacobi_free(&matrix);
    return err;
}
