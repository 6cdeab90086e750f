/* Engine: encoders of libavcodec. */
#include <stdlib.h>

#include "render/encode/movie_engine.h"

struct bead_engine {
    const struct bead_av *av;
    AVCodecContext *codec;
};

int bead_engine_options(const struct bead_av *av, const char *text, AVDictionary **options)
{
    return text && *text ? av->av_dict_parse_string(options, text, "=", " ", 0) : 0;
}

static enum bead_error check_encoder(const struct bead_av *av, const char *encoder, struct bead_message *msg)
{
    if (av->avcodec_find_encoder_by_name(encoder))
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "libavcodec was built without its encoder %s", encoder);
}

static void set_up(const struct bead_engine_setup *setup, AVCodecContext *c)
{
    const struct bead_picture_format *f = &setup->pictures;
    c->width = f->width;
    c->height = f->height;
    c->pix_fmt = f->pixels;
    c->color_primaries = f->primaries;
    c->color_trc = f->transfer;
    c->colorspace = f->matrix;
    c->color_range = f->range;
    c->chroma_sample_location = f->chroma;
    c->time_base = setup->frame_time;
    c->framerate = av_inv_q(setup->frame_time);
    c->sample_aspect_ratio = (AVRational){1, 1};
    c->gop_size = BEAD_KEY_INTERVAL;
    c->max_b_frames = 0;
    c->thread_count = 1; /* x264's pictures depend on the number of threads */
    c->flags |= AV_CODEC_FLAG_BITEXACT | (setup->global_header ? AV_CODEC_FLAG_GLOBAL_HEADER : 0);
}

static int open_encoder(const struct bead_engine_setup *setup, struct bead_engine **engine)
{
    struct bead_engine *e = *engine = calloc(1, sizeof *e);
    if (!e)
        return AVERROR(ENOMEM);
    e->av = setup->av;
    const AVCodec *type = e->av->avcodec_find_encoder_by_name(setup->preset->encoder);
    e->codec = e->av->avcodec_alloc_context3(type);
    if (!e->codec)
        return AVERROR(ENOMEM);
    set_up(setup, e->codec);
    AVDictionary *options = NULL;
    int code = bead_engine_options(e->av, setup->preset->options, &options);
    if (code >= 0)
        code = e->av->avcodec_open2(e->codec, type, &options);
    if (code >= 0 && e->av->av_dict_count(options))
        code = AVERROR_OPTION_NOT_FOUND;
    e->av->av_dict_free(&options);
    return code;
}

static int describe_stream(const struct bead_engine *e, AVCodecParameters *stream)
{
    return e->av->avcodec_parameters_from_context(stream, e->codec);
}

static int send_picture(struct bead_engine *e, AVFrame *picture, const struct bead_blocks *blocks)
{
    (void)blocks; /* none of them asks */
    return e->av->avcodec_send_frame(e->codec, picture);
}

static int receive_packet(struct bead_engine *e, AVPacket *packet)
{
    return e->av->avcodec_receive_packet(e->codec, packet);
}

static void close_encoder(struct bead_engine *e)
{
    if (!e)
        return;
    e->av->avcodec_free_context(&e->codec);
    free(e);
}

const struct bead_engine_type bead_engine_av = {.check = check_encoder,
                                                .open = open_encoder,
                                                .describe = describe_stream,
                                                .send = send_picture,
                                                .receive = receive_packet,
                                                .close = close_encoder};
