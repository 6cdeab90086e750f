/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds how far energy has spread: see spreading.h. */
#include "sim/measure/spreading.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"

static const double front_part = 1e-6;
/* Fewer samples in the window give no exponent. */
enum { FEWEST = 8 };

enum bead_error bead_spreading_begin(struct bead_spreading *s, const struct bead_chain *chain, size_t times,
                                     struct bead_message *msg)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const bool struck = spec->start_count == 0 || spec->striker_velocity != 0;
    *s = (struct bead_spreading){
        .room = times, .beads = bead_chain_beads(chain), .origin = struck ? 0 : spec->starts[spec->start_count / 2].bead};
    for (int i = 0; i < 3; i++)
        BEAD_TRY(bead_new(&s->log[i], times, msg, "the spreading of %zu times", times));
    return BEAD_OK;
}

void bead_spreading_free(struct bead_spreading *s)
{
    for (int i = 0; i < 3; i++)
        free(s->log[i]);
}

struct bead_line bead_spreading_exponent(const struct bead_spreading *s, int of)
{
    size_t first = s->count;
    while (first > 0 && s->log[0][first - 1] >= s->log[0][s->count - 1] + bead_log(BEAD_SPREADING_WINDOW))
        first--;
    const size_t used = s->count - first;
    return bead_line_of(s->log[0] + first, s->log[of + 1] + first, used < FEWEST ? 0 : used);
}

void bead_spreading_feed(struct bead_spreading *s, const struct bead_sample *sample, double numbers[BEAD_SPREADING_NUMBERS])
{
    const double *e = sample->field[BEAD_FIELD_ENERGY], origin = (double)s->origin;
    const size_t count = sample->active < s->beads ? sample->active : s->beads;
    double all = 0, squares = 0, moment = 0, front = 0;
    for (size_t n = 0; n < count; n++) {
        all += e[n];
        squares += e[n] * e[n];
        moment += ((double)n - origin) * ((double)n - origin) * e[n];
    }
    for (size_t n = 0; n < count; n++)
        front = e[n] > front_part * all ? fmax(front, fabs((double)n - origin)) : front;
    numbers[BEAD_SECOND_MOMENT] = moment / all;
    numbers[BEAD_PARTICIPATION] = all * all / squares;
    numbers[BEAD_FRONT] = front;
    if (sample->time > 0 && moment > 0 && s->count < s->room) {
        s->log[0][s->count] = bead_log(sample->time);
        s->log[1][s->count] = bead_log(moment / all);
        s->log[2][s->count++] = bead_log(all * all / squares);
    }
}
