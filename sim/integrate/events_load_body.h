/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: loads the patches around contacts that open or close, see events.h. Lanes are contacts. */
#include "sim/integrate/events_patch.h"

/* Quintic Hermite: e, e1, e2 are the contributions of the cubic and higher terms to d, d', d'' at the end. */
static inline void load_quintics(struct bead_patch *patch, size_t k, const lanes d0[3], const lanes d1[3])
{
    double *const *array = patch->array;
    lanes c2 = 0.5 * d0[2], e = d1[0] - ((d0[0] + d0[1]) + c2), e1 = d1[1] - (d0[1] + 2 * c2), e2 = d1[2] - 2 * c2;
    store_lanes(array[BEAD_PATCH_C + 0] + k, d0[0]);
    store_lanes(array[BEAD_PATCH_C + 1] + k, d0[1]);
    store_lanes(array[BEAD_PATCH_C + 2] + k, c2);
    store_lanes(array[BEAD_PATCH_C + 3] + k, (10 * e - 4 * e1) + 0.5 * e2);
    store_lanes(array[BEAD_PATCH_C + 4] + k, (7 * e1 - 15 * e) - e2);
    store_lanes(array[BEAD_PATCH_C + 5] + k, (6 * e - 3 * e1) + 0.5 * e2);
    store_lanes(array[BEAD_PATCH_END_D] + k, d1[0]);
    store_lanes(array[BEAD_PATCH_END_RATE] + k, d1[1]);
    store_lanes(array[BEAD_PATCH_D] + k, d0[0]);
    store_lanes(array[BEAD_PATCH_RATE] + k, d0[1]);
    lane_masks closed = (d0[0] > 0) | (d1[0] > 0);
    *(lane_bytes *)(patch->closed + k) = __builtin_convertvector(closed, lane_bytes) & 1;
}

static inline lanes step_of(const double *x, ptrdiff_t k)
{
    return load_lanes(x + k) - load_lanes(x + k + 1);
}

/* Cubic Hermite over the step of the difference of two beads' accelerations from the springs that hold them in place. */
static inline void load_pull(const struct bead_patch_source *source, ptrdiff_t from, size_t k, struct bead_patch *patch)
{
    const double h = source->h, square = h * h;
    double *const *array = patch->array + BEAD_PATCH_PULL;
    const lanes left = -square * load_lanes(source->pull + from), right = -square * load_lanes(source->pull + from + 1);
    const lanes e0 = left * load_lanes(source->u0 + from) - right * load_lanes(source->u0 + from + 1);
    const lanes e1 = left * load_lanes(source->u1 + from) - right * load_lanes(source->u1 + from + 1);
    const lanes r0 = h * (left * load_lanes(source->v0 + from) - right * load_lanes(source->v0 + from + 1));
    const lanes r1 = h * (left * load_lanes(source->v1 + from) - right * load_lanes(source->v1 + from + 1));
    store_lanes(array[0] + k, e0);
    store_lanes(array[1] + k, r0);
    store_lanes(array[2] + k, 3 * (e1 - e0) - (2 * r0 + r1));
    store_lanes(array[3] + k, 2 * (e0 - e1) + (r0 + r1));
}

/* Loads all contacts of the patch; elements of the last vector beyond them are never used. */
static void load_patch(const struct bead_patch_source *source, ptrdiff_t at, struct bead_patch *patch)
{
    const double h = source->h, square = h * h;
    double *const *array = patch->array;
    const lanes zero = {0};
    for (size_t k = 0; k < patch->count + 2; k += LANES) {
        const ptrdiff_t from = at + (ptrdiff_t)k;
        lanes rest = load_lanes(source->static_compression + from), impulse = zero, moment = zero;
        lanes d0[3] = {rest + step_of(source->u0, from), h * step_of(source->v0, from), square * step_of(source->a0, from)};
        lanes d1[3] = {rest + step_of(source->u1, from), h * step_of(source->v1, from), square * step_of(source->a1, from)};
        load_quintics(patch, k, d0, d1);
        for (size_t i = 0; i < source->stages; i++) {
            lanes f = load_lanes(source->stage[i] + from);
            impulse += source->impulse[i] * f;
            moment += source->moment[i] * f;
        }
        if (source->pull)
            load_pull(source, from, k, patch);
        store_lanes(array[BEAD_PATCH_GIVEN_IMPULSE] + k, impulse);
        store_lanes(array[BEAD_PATCH_GIVEN_MOMENT] + k, moment);
        store_lanes(array[BEAD_PATCH_IMPULSE] + k, zero);
        store_lanes(array[BEAD_PATCH_MOMENT] + k, zero);
        store_lanes(array[BEAD_PATCH_STIFFNESS] + k, load_lanes(source->stiffness + from));
        store_lanes(array[BEAD_PATCH_STATIC_FORCE] + k, load_lanes(source->static_force + from));
        store_lanes(array[BEAD_PATCH_LEFT] + k, square * load_lanes(source->inverse_mass + from));
        store_lanes(array[BEAD_PATCH_RIGHT] + k, square * load_lanes(source->inverse_mass + from + 1));
    }
}
