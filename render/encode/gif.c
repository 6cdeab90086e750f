/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a GIF file in two passes over a lossless one: the first counts colours, the second encodes with the best palette for all
 * frames. */
#include "render/encode/av_file.h"

#include <string.h>

#include "render/colour/palette.h"

enum { PER_SECOND = 100 /* units of GIF's times */, LEAST_DELAY = 2 /* units: players slow shorter delays down */ };

struct gif {
    AVRational frame_time;
    int64_t frames, last; /* in total; number of the last one written */
    struct bead_palette *palette;
    AVFormatContext *format;
    AVCodecContext *codec;
    AVPacket *packet;
    bool begun; /* the file has its header */
};

/* Takes a picture, RGB24, that is shown from frame `at`. */
typedef int (*take_picture)(struct gif *gif, const AVFrame *picture, int64_t at);

/* ---- reading ---- */

static int take_pictures(struct gif *gif, AVCodecContext *decoder, const AVFormatContext *from, AVFrame *picture, take_picture take)
{
    int code;
    while ((code = avcodec_receive_frame(decoder, picture)) >= 0) {
        int64_t at = av_rescale_q(picture->best_effort_timestamp, from->streams[0]->time_base, gif->frame_time);
        code = picture->format == AV_PIX_FMT_RGB24 ? take(gif, picture, at) : AVERROR_INVALIDDATA;
        av_frame_unref(picture);
        if (code < 0)
            return code;
    }
    return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

static int open_decoder(const AVFormatContext *from, AVCodecContext **decoder)
{
    const AVCodec *type = avcodec_find_decoder(from->streams[0]->codecpar->codec_id);
    *decoder = type ? avcodec_alloc_context3(type) : NULL;
    if (!*decoder)
        return type ? AVERROR(ENOMEM) : AVERROR_DECODER_NOT_FOUND;
    (*decoder)->thread_count = 1;
    int code = avcodec_parameters_to_context(*decoder, from->streams[0]->codecpar);
    return code < 0 ? code : avcodec_open2(*decoder, type, NULL);
}

static int decode_all(struct gif *gif, AVFormatContext *from, AVFrame *picture, take_picture take)
{
    AVCodecContext *decoder = NULL;
    int code = from->nb_streams == 1 ? open_decoder(from, &decoder) : AVERROR_INVALIDDATA;
    while (code >= 0 && (code = av_read_frame(from, gif->packet)) >= 0) {
        code = avcodec_send_packet(decoder, gif->packet);
        av_packet_unref(gif->packet);
        if (code >= 0)
            code = take_pictures(gif, decoder, from, picture, take);
    }
    if (code == AVERROR_EOF)
        code = avcodec_send_packet(decoder, NULL);
    if (code >= 0)
        code = take_pictures(gif, decoder, from, picture, take);
    avcodec_free_context(&decoder);
    return code;
}

static int read_all(struct gif *gif, int descriptor, take_picture take)
{
    AVIOContext *reader = bead_av_file_wrap(descriptor, false);
    AVFormatContext *from = avformat_alloc_context();
    AVFrame *picture = av_frame_alloc();
    int code = reader && from && picture ? 0 : AVERROR(ENOMEM);
    if (code >= 0) {
        from->pb = reader;
        code = avformat_open_input(&from, NULL, NULL, NULL); /* on failure frees the context, but not its pb */
    }
    if (code >= 0)
        code = decode_all(gif, from, picture, take);
    av_frame_free(&picture);
    if (from)
        avformat_close_input(&from);
    bead_av_file_unwrap(&reader);
    return code;
}

/* ---- the first pass ---- */

static int count_colours(struct gif *gif, const AVFrame *picture, int64_t)
{
    for (int y = 0; y < picture->height; y++)
        bead_palette_count(gif->palette, picture->data[0] + (ptrdiff_t)y * picture->linesize[0], (size_t)picture->width);
    return 0;
}

/* ---- the second pass ---- */

static int start(struct gif *gif, const AVFrame *picture)
{
    const AVCodec *type = avcodec_find_encoder_by_name("gif");
    AVStream *stream = avformat_new_stream(gif->format, NULL);
    AVCodecContext *c = gif->codec = avcodec_alloc_context3(type);
    if (!stream || !c)
        return AVERROR(ENOMEM);
    c->width = picture->width;
    c->height = picture->height;
    c->pix_fmt = AV_PIX_FMT_PAL8;
    c->time_base = stream->time_base = gif->frame_time;
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    int code = avcodec_open2(c, type, NULL);
    if (code >= 0)
        code = avcodec_parameters_from_context(stream->codecpar, c);
    if (code >= 0)
        code = avformat_write_header(gif->format, NULL);
    gif->begun = code >= 0;
    return code;
}

static int write_packets(struct gif *gif)
{
    int code;
    while ((code = avcodec_receive_packet(gif->codec, gif->packet)) >= 0) {
        av_packet_rescale_ts(gif->packet, gif->frame_time, gif->format->streams[0]->time_base);
        gif->packet->stream_index = 0;
        code = av_write_frame(gif->format, gif->packet);
        av_packet_unref(gif->packet);
        if (code < 0 || gif->format->pb->error < 0)
            return code < 0 ? code : gif->format->pb->error;
    }
    return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

static int encode_picture(struct gif *gif, const AVFrame *picture, int64_t at)
{
    uint32_t colours[256];
    int code = gif->codec ? 0 : start(gif, picture);
    AVFrame *own = av_frame_alloc(); /* the encoder keeps it, to compare it with the next */
    if (code < 0 || !own) {
        av_frame_free(&own);
        return code < 0 ? code : AVERROR(ENOMEM);
    }
    own->width = picture->width;
    own->height = picture->height;
    own->format = AV_PIX_FMT_PAL8;
    own->pts = gif->last = at;
    code = av_frame_get_buffer(own, 0);
    if (code >= 0) {
        bead_palette_colours(gif->palette, colours);
        memcpy(own->data[1], colours, sizeof colours);
        for (int y = 0; y < picture->height; y++)
            bead_palette_convert(gif->palette, picture->data[0] + (ptrdiff_t)y * picture->linesize[0], (size_t)picture->width,
                                 own->data[0] + (ptrdiff_t)y * own->linesize[0]);
        code = avcodec_send_frame(gif->codec, own);
    }
    av_frame_free(&own);
    return code >= 0 ? write_packets(gif) : code;
}

static int finish(struct gif *gif)
{
    const AVRational unit = {1, PER_SECOND};
    if (!gif->codec)
        return AVERROR_INVALIDDATA;
    int64_t lasts = av_rescale_q(gif->frames, gif->frame_time, unit) - av_rescale_q(gif->last, gif->frame_time, unit);
    int code = avcodec_send_frame(gif->codec, NULL);
    if (code >= 0)
        code = write_packets(gif);
    return code < 0 ? code : av_opt_set_int(gif->format->priv_data, "final_delay", lasts > LEAST_DELAY ? lasts : LEAST_DELAY, 0);
}

/* Also after an error `code`: the muxer frees what it holds only with the trailer. */
static int end(struct gif *gif, int code)
{
    const int ended = gif->begun ? av_write_trailer(gif->format) : 0;
    if (code < 0 || ended < 0)
        return code < 0 ? code : ended;
    avio_flush(gif->format->pb);
    return gif->format->pb->error;
}

static int write_all(struct gif *gif, int from, int to)
{
    int code = avformat_alloc_output_context2(&gif->format, NULL, "gif", NULL);
    if (code < 0)
        return code;
    gif->format->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO;
    gif->format->pb = bead_av_file_wrap(to, true);
    code = gif->format->pb ? read_all(gif, from, encode_picture) : AVERROR(ENOMEM);
    code = end(gif, code < 0 ? code : finish(gif));
    bead_av_file_unwrap(&gif->format->pb);
    avformat_free_context(gif->format);
    return code;
}

int bead_gif_make(int from, int to, AVRational frame_time, int64_t frames)
{
    struct gif gif = {.frame_time = frame_time, .frames = frames, .packet = av_packet_alloc()};
    int code = gif.packet && bead_palette_create(&gif.palette, NULL) == BEAD_OK ? 0 : AVERROR(ENOMEM);
    if (code >= 0)
        code = read_all(&gif, from, count_colours);
    if (code >= 0 && bead_palette_choose(gif.palette, NULL) != BEAD_OK)
        code = AVERROR(ENOMEM);
    if (code >= 0)
        code = write_all(&gif, from, to);
    avcodec_free_context(&gif.codec);
    av_packet_free(&gif.packet);
    bead_palette_destroy(gif.palette);
    return code;
}
