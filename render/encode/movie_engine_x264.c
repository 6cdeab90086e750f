/* Engine: H.264 by libx264 itself. In most frames of a bead movie four blocks of five are as they were, and x264 can be told which;
 * FFmpeg 5.1's wrapper has no way to. Its decoded pictures are those of x264 without the hint but for the choice of a few blocks.
 */
#include <stdint.h> /* x264.h wants it first */
#include <stdlib.h>
#include <string.h>
#include <x264.h>

#include "beadreel/library.h"
#include "render/encode/movie_engine.h"

#define TEXT(x)    TEXT_OF(x)
#define TEXT_OF(x) #x

#define X264_FUNCTIONS(X)          \
    X(x264_param_default_preset)   \
    X(x264_param_parse)            \
    X(x264_param_cleanup)          \
    X(x264_picture_init)           \
    X(x264_encoder_open)           \
    X(x264_encoder_headers)        \
    X(x264_encoder_encode)         \
    X(x264_encoder_delayed_frames) \
    X(x264_encoder_close)

/* The name in the library has the version of its structures in it. */
#define NAME(function)  TEXT(function),
#define COUNT(function) +1
static const char *const names[] = {X264_FUNCTIONS(NAME)};
static const char *const files[] = {"libx264.so." TEXT(X264_BUILD), NULL};
enum { FUNCTIONS = 0 X264_FUNCTIONS(COUNT) };

struct library {
#define MEMBER(name) __typeof__(name) *name;
    X264_FUNCTIONS(MEMBER)
#undef MEMBER
};

struct bead_engine {
    const struct bead_av *av;
    struct library x264;
    struct bead_picture_format pictures;
    x264_t *encoder;
    uint8_t *headers; /* of the whole stream */
    size_t header_bytes;
    uint8_t *note; /* x264's settings, for the first packet */
    size_t note_bytes;
    x264_nal_t *data; /* a packet that waits; owned by the encoder */
    int bytes;        /* of it; <= 0: none waits */
    x264_picture_t shown;
    bool ended;
};

static enum bead_error load(struct library *x264, struct bead_message *msg)
{
    void (*loaded[FUNCTIONS])(void);
    struct bead_message why;
    _Static_assert(sizeof loaded == sizeof *x264, "nothing but functions");
    if (bead_library_load(files, names, FUNCTIONS, loaded, &why))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "H.264 needs libx264: %s", why.text);
    memcpy(x264, loaded, sizeof *x264);
    return BEAD_OK;
}

static enum bead_error check_library(const struct bead_av *av, const char *encoder, struct bead_message *msg)
{
    (void)av;
    (void)encoder;
    struct library x264;
    return load(&x264, msg);
}

/* "preset=a key=value x264-params=key=value:key=value", as libavcodec takes them: the preset first, for it sets everything. */
static int parse(const struct bead_engine *e, const char *text, x264_param_t *param)
{
    const struct bead_av *av = e->av;
    AVDictionary *options = NULL, *more = NULL;
    int code = bead_engine_options(av, text, &options);
    const AVDictionaryEntry *preset = av->av_dict_get(options, "preset", NULL, 0);
    if (code >= 0 && e->x264.x264_param_default_preset(param, preset ? preset->value : "medium", NULL) < 0)
        code = AVERROR_OPTION_NOT_FOUND;
    const AVDictionaryEntry *params = av->av_dict_get(options, "x264-params", NULL, 0);
    if (code >= 0 && params)
        code = av->av_dict_parse_string(&more, params->value, "=", ":", 0);
    for (int i = 0; i < 2; i++) {
        const AVDictionaryEntry *o = NULL;
        while (code >= 0 && (o = av->av_dict_get(i ? more : options, "", o, AV_DICT_IGNORE_SUFFIX))) {
            if (o != preset && o != params && e->x264.x264_param_parse(param, o->key, o->value) < 0)
                code = AVERROR_OPTION_NOT_FOUND;
        }
    }
    av->av_dict_free(&options);
    av->av_dict_free(&more);
    return code;
}

/* The numbers of libav's colour properties are those of the standard, as x264's are. */
static void set_up(const struct bead_engine_setup *setup, x264_param_t *param)
{
    const struct bead_picture_format *f = &setup->pictures;
    param->i_threads = 1; /* pictures depend on the number of threads */
    param->i_log_level = X264_LOG_NONE;
    param->i_csp = X264_CSP_I420;
    param->i_width = f->width;
    param->i_height = f->height;
    param->vui.i_sar_width = param->vui.i_sar_height = 1;
    param->vui.b_fullrange = f->range == AVCOL_RANGE_JPEG;
    param->vui.i_colorprim = (int)f->primaries;
    param->vui.i_transfer = (int)f->transfer;
    param->vui.i_colmatrix = (int)f->matrix;
    param->vui.i_chroma_loc = f->chroma - AVCHROMA_LOC_LEFT;
    param->b_vfr_input = 1; /* still frames are shown for longer */
    param->i_timebase_num = (uint32_t)setup->frame_time.num;
    param->i_timebase_den = (uint32_t)setup->frame_time.den;
    param->i_fps_num = param->i_timebase_den;
    param->i_fps_den = param->i_timebase_num;
    param->i_keyint_max = BEAD_KEY_INTERVAL;
    param->b_repeat_headers = !setup->global_header;
    param->b_annexb = 1; /* muxers turn it into what they need */
    param->analyse.b_mb_info = 1;
}

static int keep(const x264_nal_t *nal, uint8_t **to, size_t *bytes)
{
    uint8_t *more = realloc(*to, *bytes + (size_t)nal->i_payload);
    if (!more)
        return AVERROR(ENOMEM);
    memcpy(more + *bytes, nal->p_payload, (size_t)nal->i_payload);
    *to = more;
    *bytes += (size_t)nal->i_payload;
    return 0;
}

static int keep_headers(struct bead_engine *e)
{
    x264_nal_t *nal;
    int count = 0, code = e->x264.x264_encoder_headers(e->encoder, &nal, &count) < 0 ? AVERROR_EXTERNAL : 0;
    for (int i = 0; code >= 0 && i < count; i++) {
        bool note = nal[i].i_type == NAL_SEI;
        code = keep(&nal[i], note ? &e->note : &e->headers, note ? &e->note_bytes : &e->header_bytes);
    }
    return code;
}

static int open_encoder(const struct bead_engine_setup *setup, struct bead_engine **engine)
{
    struct bead_engine *e = *engine = calloc(1, sizeof *e);
    if (!e)
        return AVERROR(ENOMEM);
    e->av = setup->av;
    e->pictures = setup->pictures;
    if (load(&e->x264, NULL))
        return AVERROR_ENCODER_NOT_FOUND;
    x264_param_t param;
    int code = parse(e, setup->preset->options, &param);
    if (code < 0)
        return code;
    set_up(setup, &param);
    e->encoder = e->x264.x264_encoder_open(&param);
    e->x264.x264_param_cleanup(&param);
    if (!e->encoder)
        return AVERROR_EXTERNAL;
    return setup->global_header ? keep_headers(e) : 0;
}

static int describe_stream(const struct bead_engine *e, AVCodecParameters *stream)
{
    const struct bead_picture_format *f = &e->pictures;
    stream->codec_type = AVMEDIA_TYPE_VIDEO;
    stream->codec_id = AV_CODEC_ID_H264;
    stream->format = f->pixels;
    stream->width = f->width;
    stream->height = f->height;
    stream->sample_aspect_ratio = (AVRational){1, 1};
    stream->color_primaries = f->primaries;
    stream->color_trc = f->transfer;
    stream->color_space = f->matrix;
    stream->color_range = f->range;
    stream->chroma_location = f->chroma;
    if (!e->header_bytes)
        return 0;
    stream->extradata = e->av->av_mallocz(e->header_bytes + AV_INPUT_BUFFER_PADDING_SIZE);
    if (!stream->extradata)
        return AVERROR(ENOMEM);
    memcpy(stream->extradata, e->headers, e->header_bytes);
    stream->extradata_size = (int)e->header_bytes;
    return 0;
}

static int encode(struct bead_engine *e, x264_picture_t *in)
{
    int nals;
    e->bytes = e->x264.x264_encoder_encode(e->encoder, &e->data, &nals, in, &e->shown);
    return e->bytes < 0 ? AVERROR_EXTERNAL : 0;
}

static int send_picture(struct bead_engine *e, AVFrame *picture, const struct bead_blocks *blocks)
{
    _Static_assert(X264_MBINFO_CONSTANT == 1, "as blocks have it");
    e->ended = !picture;
    if (e->ended)
        return 0;
    x264_picture_t in;
    e->x264.x264_picture_init(&in);
    in.img.i_csp = X264_CSP_I420;
    in.img.i_plane = 3;
    for (int k = 0; k < in.img.i_plane; k++) {
        in.img.plane[k] = picture->data[k];
        in.img.i_stride[k] = picture->linesize[k];
    }
    in.i_pts = picture->pts;
    /* The picture is copied at once, but encoded only when its duration is known: with the next. */
    size_t count = (size_t)blocks->across * (size_t)blocks->down;
    in.prop.mb_info_free = free;
    in.prop.mb_info = malloc(count);
    if (!in.prop.mb_info)
        return AVERROR(ENOMEM);
    memcpy(in.prop.mb_info, blocks->same, count);
    return encode(e, &in);
}

static int receive_packet(struct bead_engine *e, AVPacket *packet)
{
    if (e->bytes <= 0 && !e->ended)
        return AVERROR(EAGAIN);
    if (e->bytes <= 0 && e->x264.x264_encoder_delayed_frames(e->encoder) == 0)
        return AVERROR_EOF;
    int code = e->bytes <= 0 ? encode(e, NULL) : 0;
    if (code < 0)
        return code;
    code = e->av->av_new_packet(packet, (int)e->note_bytes + e->bytes);
    if (code < 0)
        return code;
    if (e->note_bytes)
        memcpy(packet->data, e->note, e->note_bytes);
    memcpy(packet->data + e->note_bytes, e->data[0].p_payload, (size_t)e->bytes); /* its parts follow each other */
    packet->pts = e->shown.i_pts;
    packet->dts = e->shown.i_dts;
    packet->flags = e->shown.b_keyframe ? AV_PKT_FLAG_KEY : 0;
    e->note_bytes = 0;
    e->bytes = 0;
    return 0;
}

static void close_encoder(struct bead_engine *e)
{
    if (!e)
        return;
    if (e->encoder)
        e->x264.x264_encoder_close(e->encoder);
    free(e->headers);
    free(e->note);
    free(e);
}

const struct bead_engine_type bead_engine_x264 = {.check = check_library,
                                                  .open = open_encoder,
                                                  .describe = describe_stream,
                                                  .send = send_picture,
                                                  .receive = receive_packet,
                                                  .close = close_encoder};
