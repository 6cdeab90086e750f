/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the packets of a movie's sound and subtitles, and writes them between those of the pictures. */
#include "render/encode/tracks.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

/* NULL: out of memory. */
static struct bead_track *add_track(struct bead_tracks *tracks)
{
    struct bead_track *track = &tracks->track[tracks->count++];
    *track = (struct bead_track){.codec = avcodec_parameters_alloc()};
    return track->codec ? track : NULL;
}

/* The track owns it. NULL: out of memory. */
static AVPacket *add_packet(struct bead_track *track)
{
    if (!bead_memory_grow((void **)&track->packets, &track->room, track->count + 1, sizeof *track->packets))
        return NULL;
    AVPacket *packet = av_packet_alloc();
    if (packet)
        track->packets[track->count++] = packet;
    return packet;
}

void bead_tracks_free(struct bead_tracks *tracks)
{
    for (size_t t = 0; t < tracks->count; t++) {
        struct bead_track *track = &tracks->track[t];
        for (size_t i = 0; i < track->count; i++)
            av_packet_free(&track->packets[i]);
        free(track->packets);
        avcodec_parameters_free(&track->codec);
    }
}

int bead_tracks_open(struct bead_tracks *tracks, AVFormatContext *to)
{
    int code = 0;
    for (size_t t = 0; t < tracks->count && code >= 0; t++) {
        struct bead_track *track = &tracks->track[t];
        AVStream *stream = avformat_new_stream(to, NULL);
        if (!stream)
            return AVERROR(ENOMEM);
        track->stream = stream->index;
        stream->time_base = track->unit;
        code = avcodec_parameters_copy(stream->codecpar, track->codec);
        if (code >= 0 && track->title)
            code = av_dict_set(&stream->metadata, "title", track->title, 0);
    }
    return code;
}

/* The track whose next packet is the earliest; NULL: none begins before `time`. */
static struct bead_track *find_next(struct bead_tracks *tracks, int64_t time, AVRational unit)
{
    struct bead_track *next = NULL;
    for (size_t t = 0; t < tracks->count; t++) {
        struct bead_track *track = &tracks->track[t];
        if (track->written == track->count)
            continue;
        int64_t begin = track->packets[track->written]->dts;
        if (av_compare_ts(begin, track->unit, time, unit) < 0) {
            next = track;
            time = begin;
            unit = track->unit;
        }
    }
    return next;
}

int bead_tracks_write(struct bead_tracks *tracks, AVFormatContext *to, int64_t time, AVRational unit)
{
    int code = 0;
    struct bead_track *track;
    while (code >= 0 && (track = find_next(tracks, time, unit))) {
        AVPacket *packet = track->packets[track->written++];
        packet->stream_index = track->stream;
        av_packet_rescale_ts(packet, track->unit, to->streams[track->stream]->time_base);
        code = av_write_frame(to, packet);
        av_packet_unref(packet);
    }
    return code >= 0 ? to->pb->error : code;
}

/* Adds the chapters of a movie to a format of libav, which frees them. */

static const int per_second = 1000;

int bead_chapters_add(AVFormatContext *format, const struct bead_movie_settings *settings)
{
    size_t count = settings->chapter_count;
    if (count == 0)
        return 0;
    format->chapters = av_mallocz(count * sizeof(AVChapter *));
    if (!format->chapters)
        return AVERROR(ENOMEM);
    for (size_t i = 0; i < count; i++) {
        const struct bead_movie_chapter *from = &settings->chapters[i];
        AVChapter *chapter = av_mallocz(sizeof *chapter);
        if (!chapter)
            return AVERROR(ENOMEM);
        format->chapters[format->nb_chapters++] = chapter;
        chapter->id = (int)i + 1;
        chapter->time_base = (AVRational){1, per_second};
        chapter->start = llround(from->start * per_second);
        chapter->end = llround((i + 1 < count ? from[1].start : settings->length) * per_second);
        int code = av_dict_set(&chapter->metadata, "title", from->title, 0);
        if (code < 0)
            return code;
    }
    return 0;
}

/* Makes the packets of subtitles: texts with a short header, which need no encoder. */

static const int subtitles_per_second = 1000;

/* The style record of 3GPP TS 26.245, 5.16: at the bottom, centred, white letters of 18 px without background, in a font named
 * Sans. */
static const uint8_t timed_text[] = {
    0, 0, 0, 0,  1,   0xff, 0,   0,   0,    0,                /* flags, place, background */
    0, 0, 0, 0,  0,   0,    0,   0,                           /* box: all of the frame */
    0, 0, 0, 0,  0,   1,    0,   18,  0xff, 0xff, 0xff, 0xff, /* all letters, font 1, plain, size, colour */
    0, 0, 0, 17, 'f', 't',  'a', 'b', 0,    1,    0,    1,    4, 'S', 'a', 'n', 's'};

const struct bead_subtitle_format bead_subtitles_mp4 = {
    .codec = AV_CODEC_ID_MOV_TEXT, .counted = true, .style = timed_text, .style_bytes = sizeof timed_text};
const struct bead_subtitle_format bead_subtitles_mkv = {.codec = AV_CODEC_ID_SUBRIP};
const struct bead_subtitle_format bead_subtitles_webm = {.codec = AV_CODEC_ID_WEBVTT, .escaped = true};

/* Returns the bytes of the packet; `out` NULL: only counts them. */
static size_t write_text(const struct bead_subtitle_format *format, const char *text, uint8_t *out)
{
    static const char special[] = "&<>", *const escapes[] = {"&amp;", "&lt;", "&gt;"};
    size_t used = format->counted ? 2 : 0;
    for (const char *c = text; *c; c++) {
        const char *found = format->escaped ? strchr(special, *c) : NULL, *put = found ? escapes[found - special] : c;
        size_t bytes = found ? strlen(put) : 1;
        if (out)
            memcpy(out + used, put, bytes);
        used += bytes;
    }
    if (out && format->counted) {
        out[0] = (uint8_t)((used - 2) >> 8);
        out[1] = (uint8_t)(used - 2);
    }
    return used;
}

static int add_text(const struct bead_subtitle_format *format, const struct bead_movie_subtitle *from, struct bead_track *track)
{
    AVPacket *packet = add_packet(track);
    if (!packet || av_new_packet(packet, (int)write_text(format, from->text, NULL)) < 0)
        return AVERROR(ENOMEM);
    write_text(format, from->text, packet->data);
    packet->pts = packet->dts = llround(from->start * subtitles_per_second);
    packet->duration = llround(from->end * subtitles_per_second) - packet->pts;
    packet->flags |= AV_PKT_FLAG_KEY;
    return 0;
}

static int describe_text(const struct bead_subtitle_format *format, AVCodecParameters *codec)
{
    codec->codec_type = AVMEDIA_TYPE_SUBTITLE;
    codec->codec_id = format->codec;
    if (!format->style)
        return 0;
    codec->extradata = av_mallocz((size_t)format->style_bytes + AV_INPUT_BUFFER_PADDING_SIZE);
    if (!codec->extradata)
        return AVERROR(ENOMEM);
    memcpy(codec->extradata, format->style, (size_t)format->style_bytes);
    codec->extradata_size = format->style_bytes;
    return 0;
}

int bead_subtitles_make(const struct bead_subtitle_format *format, const struct bead_movie_settings *settings,
                        struct bead_tracks *tracks)
{
    if (!format || settings->subtitle_count == 0)
        return 0;
    struct bead_track *track = add_track(tracks);
    if (!track)
        return AVERROR(ENOMEM);
    track->unit = (AVRational){1, subtitles_per_second};
    track->title = "Captions";
    int code = describe_text(format, track->codec);
    for (size_t i = 0; i < settings->subtitle_count && code >= 0; i++)
        code = add_text(format, &settings->subtitles[i], track);
    return code;
}

/* Encodes the sound of a movie, all at once. */

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
        AVPacket *packet = add_packet(track);
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
    struct bead_track *track = add_track(tracks);
    if (!track)
        return AVERROR(ENOMEM);
    track->unit = (AVRational){1, BEAD_SOUND_RATE};
    int code = open_encoder(format, channels, &codec);
    if (code >= 0)
        code = encode_all(codec, samples, count, track);
    avcodec_free_context(&codec);
    return code;
}
