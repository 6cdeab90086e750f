/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the functions that draw a view: one row for each row of the table of kinds. */
#include "render/view/views.h"

static const struct bead_view_type *const views[BEAD_VIEW_KINDS] = {
#define ROW(ID, name, ...) [BEAD_VIEW_##ID] = &bead_view_##name##_type,
    BEAD_VIEWS(ROW)
#undef ROW
};

const struct bead_view_type *bead_view_find(enum bead_view_kind kind)
{
    return (unsigned)kind < BEAD_VIEW_KINDS ? views[kind] : NULL;
}

/* Does the view have the functions that every view needs, and those of views that show all times? */
static bool is_whole(const struct bead_view_type *t)
{
    const bool all = t->fields && t->create && t->place && t->decorate && t->feed && t->draw && t->vector && t->destroy;
    const bool ranges = t->extremes && t->set_range && t->horizon;
    return all && (ranges || !bead_view_has(t, BEAD_SHOWS_ALL_TIMES)) && (t->overlay || !bead_view_has(t, BEAD_OVERLAYS));
}

enum bead_error bead_view_take(const struct bead_views_asked *asked, size_t index, const struct bead_view_type **type,
                               struct bead_message *msg)
{
    const unsigned kind = asked->kinds[index];
    *type = kind < BEAD_VIEW_KINDS ? bead_view_find((enum bead_view_kind)kind) : asked->own[kind - BEAD_VIEW_KINDS];
    return is_whole(*type) ? BEAD_OK : bead_fail(msg, BEAD_ERROR_USAGE, "view `%s`: a function is missing", (*type)->info->name);
}
