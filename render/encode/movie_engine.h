/* Engines: what turns pictures into packets. libavcodec's encoders are one; H.264 has its own, which is told what has not changed.
 * Numbers returned are those of libav: 0, or a negative AVERROR. */
#ifndef BEADREEL_RENDER_ENCODE_MOVIE_ENGINE_H
#define BEADREEL_RENDER_ENCODE_MOVIE_ENGINE_H

#include "render/encode/movie_av.h"
#include "render/encode/movie_blocks.h"
#include "render/encode/movie_pictures.h"
#include "render/encode/movie_private.h"

struct bead_engine; /* each kind's own */

struct bead_engine_setup {
    const struct bead_av *av; /* borrowed while the engine lives */
    const struct bead_preset *preset;
    struct bead_picture_format pictures;
    AVRational frame_time; /* s: unit of times */
    bool global_header;    /* the container has a place for headers */
};

struct bead_engine_type {
    /* There is an encoder of this name. Errors: UNSUPPORTED. */
    enum bead_error (*check)(const struct bead_av *av, const char *encoder, struct bead_message *msg);
    /* *engine is to be closed also after an error, if it is not NULL. */
    int (*open)(const struct bead_engine_setup *setup, struct bead_engine **engine);
    int (*describe)(const struct bead_engine *engine, AVCodecParameters *stream);
    /* One more picture, its time in `pts`; NULL: there are no more. `blocks`: against the picture sent before. */
    int (*send)(struct bead_engine *engine, AVFrame *picture, const struct bead_blocks *blocks);
    /* AVERROR(EAGAIN): not before another picture is sent; AVERROR_EOF: that was all. */
    int (*receive)(struct bead_engine *engine, AVPacket *packet);
    void (*close)(struct bead_engine *engine);
};

enum { BEAD_KEY_INTERVAL = 300 /* frames given to the engine from one that can be jumped to, to the next */ };

/* "key=value key=value ..." */
int bead_engine_options(const struct bead_av *av, const char *text, AVDictionary **options);

#endif
