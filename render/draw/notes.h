/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The notes of a picture as its caller gives them; NULL: none. */
#pragma once

#include "render/draw/picture.h"
#include "sim/base/settings.h"

BEAD_CHECK static inline enum bead_error bead_notes_take(struct bead_picture_notes *own, const struct bead_picture_notes *given,
                                                         struct bead_message *msg)
{
    *own = (struct bead_picture_notes){0};
    return !given ? BEAD_OK
                  : bead_settings_take(own, sizeof *own, BEAD_SETTINGS_UP_TO(struct bead_picture_notes, dpi), given,
                                       "bead_picture_notes", msg);
}
