#include "render/view/views.h"

static const struct bead_view_type *const views[] = {
    &bead_view_beads_type, &bead_view_profile_type, &bead_view_spacetime_type, &bead_view_sensors_type, &bead_view_modes_type, NULL,
};

const struct bead_view_type *bead_view_find(enum bead_view_kind kind)
{
    for (const struct bead_view_type *const *view = views; *view; view++) {
        if ((*view)->kind == kind)
            return *view;
    }
    return NULL;
}
