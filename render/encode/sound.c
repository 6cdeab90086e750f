/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Encodes the sound of a movie, all at once. */
#include "render/encode/tracks.h"

#include <string.h>

const struct bead_sound_format bead_sound_aac = {"aac", AV_SAMPLE_FMT_FLTP, 96000};
const struct bead_sound_format bead_sound_opus = {"libopus", AV_SAMPLE_FMT_FLT, 64000};

static int open_encoder(const struct bead_sound_format *format, int channels, AVCodecContext **codec)
{
    const AVCodec *type = avcodec_find_encoder_by_name(format->encoder);
    AVCodecContext *c = *codec = avcodec_alloc_context3(type);
    if (!c)
        return AVERROR(ENOMEM);
    c->sample_rate = BEAD_SOUND_RATE;
    c->sample_fmt = format->samples;
    c->ch_layout = channels == 1 ? (AVChannelLayout)AV_CHANNEL_LAYOUT_MONO : (AVChannelLayout)AV_CHANNEL_LAYOUT_STEREO;
    c->bit_rate = channels * format->bit_rate;
    c->time_base = (AVRational){1, BEAD_SOUND_RATE};
    c->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    return avcodec_open2(c, type, NULL);
}

/* `count` samples of all channels, side by side or plane by plane. */
static void fill_frame(AVFrame *frame, const float *samples, int count, int channels)
{
    frame->nb_samples = count;
    for (int i = 0; i < count * channels; i++) {
        bool planes = frame->format == AV_SAMPLE_FMT_FLTP;
        float *to = (float *)frame->data[planes ? i % channels : 0];
        to[planes ? i / channels : i] = samples[i];
    }
}

static int take_packets(AVCodecContext *codec, struct bead_track *track)
{
    for (;;) {
        AVPacket *packet = bead_track_add(track);
        int code = packet ? avcodec_receive_packet(codec, packet) : AVERROR(ENOMEM);
        if (code >= 0)
            continue;
        if (packet)
            av_packet_free(&track->packets[--track->count]);
        return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
    }
}

static int send_frame(AVCodecContext *codec, const float *samples, int64_t at, int count)
{
    const int channels = codec->ch_layout.nb_channels;
    AVFrame *frame = av_frame_alloc();
    if (!frame)
        return AVERROR(ENOMEM);
    frame->format = codec->sample_fmt;
    frame->ch_layout = codec->ch_layout; /* given by a mask: it owns no memory */
    frame->sample_rate = codec->sample_rate;
    frame->nb_samples = codec->frame_size;
    frame->pts = at;
    int code = av_frame_get_buffer(frame, 0);
    if (code >= 0) {
        fill_frame(frame, samples + at * channels, count, channels);
        code = avcodec_send_frame(codec, frame);
    }
    av_frame_free(&frame);
    return code;
}

static int encode_all(AVCodecContext *codec, const float *samples, size_t count, struct bead_track *track)
{
    int code = avcodec_parameters_from_context(track->codec, codec);
    for (size_t at = 0; at < count && code >= 0; at += (size_t)codec->frame_size) {
        size_t left = count - at, size = (size_t)codec->frame_size;
        code = send_frame(codec, samples, (int64_t)at, (int)(left < size ? left : size));
        if (code >= 0)
            code = take_packets(codec, track);
    }
    if (code >= 0)
        code = avcodec_send_frame(codec, NULL);
    return code >= 0 ? take_packets(codec, track) : code;
}

int bead_sound_make(const struct bead_sound_format *format, const float *samples, size_t count, int channels,
                    struct bead_tracks *tracks)
{
    AVCodecContext *codec = NULL;
    struct bead_track *track = bead_tracks_add(tracks);
    if (!track)
        return AVERROR(ENOMEM);
    track->unit = (AVRational){1, BEAD_SOUND_RATE};
    int code = open_encoder(format, channels, &codec);
    if (code >= 0)
        code = encode_all(codec, samples, count, track);
    avcodec_free_context(&codec);
    return code;
}
