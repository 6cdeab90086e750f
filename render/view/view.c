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
