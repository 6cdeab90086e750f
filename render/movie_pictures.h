/* Pictures as an encoder wants them, changed in place as frames change. */
#ifndef BEAD_RENDER_MOVIE_PICTURES_H
#define BEAD_RENDER_MOVIE_PICTURES_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/frame.h"
#include "render/convert.h"
#include "render/movie_av.h"
#include "render/palette.h"

struct bead_picture_slot {
    AVFrame *picture;
    bool filled;
};

struct bead_pictures {
    const struct bead_av *av;     /* borrowed, as all names */
    const AVCodecContext *codec;  /* borrowed */
    const char *name;             /* of the file, for messages */
    bead_convert convert;         /* or: */
    struct bead_palette *palette; /* then there is one slot only */
    struct bead_picture_slot *slots;
    size_t count;
};

/* One slot. Errors: MEMORY, CODEC. What was made is freed by close, also after an error. */
BEAD_CHECK enum bead_error bead_pictures_open(const struct bead_av *av, const AVCodecContext *codec, const char *name,
                                              struct bead_pictures *pictures, struct bead_message *msg);
/* At least `count` slots. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_pictures_reserve(struct bead_pictures *pictures, size_t count, struct bead_message *msg);
/* Bring a slot up to date with a frame that differs in `missing`; the first time everything is converted. Slots may be converted in
 * one thread while another encodes others. Errors: MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_pictures_convert(const struct bead_pictures *pictures, size_t slot, const struct bead_frame *frame,
                                                 const struct bead_changes *missing, struct bead_message *msg);
/* Do changes reach into the picture? */
bool bead_pictures_differ(const struct bead_pictures *pictures, const struct bead_changes *changes);
void bead_pictures_close(struct bead_pictures *pictures);

#endif
