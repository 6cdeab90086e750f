/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of views, as scenes use them: names and traits, without any drawing. Scene parsing and render both ask it. */
#include "sim/kinds/view_kinds.h"

const struct bead_view_info bead_view_infos[BEAD_VIEW_KINDS] = {
#define VIEW(ID, view, ...) [BEAD_VIEW_##ID] = {.name = #view, __VA_ARGS__},
    BEAD_VIEWS(VIEW)
#undef VIEW
};

/* A view's type begins with its traits; the rest is for drawing. */
static const struct bead_view_info *info_of(const struct bead_view_type *type)
{
    return *(const struct bead_view_info *const *)(const void *)type;
}

const struct bead_view_info *bead_views_info(const struct bead_views_asked *asked, size_t index)
{
    const unsigned kind = asked->kinds[index];
    return kind < BEAD_VIEW_KINDS ? &bead_view_infos[kind] : info_of(asked->own[kind - BEAD_VIEW_KINDS]);
}

bool bead_views_any(const struct bead_views_asked *asked, unsigned trait)
{
    for (size_t i = 0; i < asked->count; i++) {
        if (bead_views_info(asked, i)->traits & trait)
            return true;
    }
    return false;
}

bool bead_views_all(const struct bead_views_asked *asked, unsigned trait)
{
    for (size_t i = 0; i < asked->count; i++) {
        if (!(bead_views_info(asked, i)->traits & trait))
            return false;
    }
    return true;
}
