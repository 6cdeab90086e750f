/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills: outputs of one picture, `image:` and `plot:`. still.c chooses the kind that draws an output. */
#pragma once

#include <stdbool.h>

#include "beadreel/sink.h"

struct bead_still; /* each kind's own */

struct bead_still_kind {
    size_t size; /* of its struct bead_still, zero before `create`, destroyed even after an error */
    bool (*wanted)(const struct bead_output *output);
    /* `output` is borrowed. Errors: SCENE (with the place of the output or panel), MEMORY, IO and FORMAT of colour maps. */
    enum bead_error (*create)(const struct bead_output *output, const struct bead_run_context *context, struct bead_still *still,
                              struct bead_message *msg);
    void (*needs)(const struct bead_still *still, struct bead_needs *needs);
    enum bead_error (*feed)(struct bead_still *still, const struct bead_sample *sample, struct bead_message *msg);
    /* Writes a file in the format of its name. Errors: UNSUPPORTED (no outcomes for peaks), IO, MEMORY, GRAPHICS. */
    enum bead_error (*write)(struct bead_still *still, const struct bead_outcome *outcomes, const char *path, uint64_t *bytes,
                             struct bead_message *msg);
    /* The painter of its beads, after `write`; "": none was needed. NULL: this kind paints nothing. */
    const char *(*painter)(const struct bead_still *still);
    /* As in struct bead_sink_type. */
    bool (*looks_at_beads)(const struct bead_output *output);
    void (*destroy)(struct bead_still *still); /* all but the struct itself */
};

extern const struct bead_still_kind bead_panels, bead_bare_image;
extern const struct bead_sink_type bead_image_sink; /* used to draw images of sweeps */
