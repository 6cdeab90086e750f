#include "render/views.h"

static const struct bead_view_type *const views[] = {
#if __has_include("render/view_beads.c")
    &bead_view_beads_type,
#endif
#if __has_include("render/view_profile.c")
    &bead_view_profile_type,
#endif
#if __has_include("render/view_spacetime.c")
    &bead_view_spacetime_type,
#endif
#if __has_include("render/view_sensors.c")
    &bead_view_sensors_type,
#endif
    NULL,
};

const struct bead_view_type *bead_view_find(enum bead_view_kind kind)
{
    for (const struct bead_view_type *const *view = views; *view; view++) {
        if ((*view)->kind == kind)
            return *view;
    }
    return NULL;
}
