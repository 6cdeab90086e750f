/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of views as scenes know them: names and traits, without any drawing. Scene parsing and render both ask it. */
#include "beadreel/view_kind.h"

const struct bead_view_info bead_view_infos[BEAD_VIEW_KINDS] = {
#define VIEW(ID, view, ...) [BEAD_VIEW_##ID] = {.name = #view, __VA_ARGS__},
    BEAD_VIEWS(VIEW)
#undef VIEW
};

bool bead_views_any(const enum bead_view_kind *views, size_t count, unsigned trait)
{
    for (size_t i = 0; i < count; i++) {
        if (bead_view_infos[views[i]].traits & trait)
            return true;
    }
    return false;
}

bool bead_views_all(const enum bead_view_kind *views, size_t count, unsigned trait)
{
    for (size_t i = 0; i < count; i++) {
        if (!(bead_view_infos[views[i]].traits & trait))
            return false;
    }
    return true;
}
