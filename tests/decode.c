/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "decode.h"

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void take_frames(AVCodecContext *codec, AVRational base, struct decoded *movie)
{
    for (;;) {
        AVFrame *frame = av_frame_alloc();
        assert_non_null(frame);
        int code = avcodec_receive_frame(codec, frame);
        if (code < 0) {
            assert_true(code == AVERROR(EAGAIN) || code == AVERROR_EOF);
            av_frame_free(&frame);
            return;
        }
        assert_true(movie->count < DECODED_MOST);
        assert_true(frame->best_effort_timestamp != AV_NOPTS_VALUE);
        movie->time[movie->count] = (double)frame->best_effort_timestamp * av_q2d(base);
        movie->frame[movie->count++] = frame;
    }
}

static void tag(const AVFormatContext *format, const char *key, char *text, size_t size)
{
    const AVDictionaryEntry *entry = av_dict_get(format->metadata, key, NULL, 0);
    snprintf(text, size, "%s", entry ? entry->value : "");
}

static void describe(const AVFormatContext *format, const AVStream *stream, const AVCodec *decoder, struct decoded *movie)
{
    movie->width = stream->codecpar->width;
    movie->height = stream->codecpar->height;
    snprintf(movie->format, sizeof movie->format, "%s", format->iformat->name);
    snprintf(movie->codec, sizeof movie->codec, "%s", avcodec_get_name(decoder->id));
    tag(format, "title", movie->title, sizeof movie->title);
    tag(format, "comment", movie->comment, sizeof movie->comment);
    tag(format, "description", movie->description, sizeof movie->description);
    movie->chapters = format->nb_chapters;
    for (unsigned i = 0; i < format->nb_chapters; i++) {
        const AVChapter *chapter = format->chapters[i];
        const AVDictionaryEntry *title = av_dict_get(chapter->metadata, "title", NULL, 0);
        movie->chapter_start = (double)chapter->start * av_q2d(chapter->time_base);
        snprintf(movie->chapter_title, sizeof movie->chapter_title, "%s", title ? title->value : "");
    }
    if (format->duration != AV_NOPTS_VALUE)
        movie->said = (double)format->duration / AV_TIME_BASE;
}

static bool is_subtitle(const AVStream *stream)
{
    return stream->codecpar->codec_type == AVMEDIA_TYPE_SUBTITLE;
}

/* As libavcodec has it: behind eight commas. */
static void keep_subtitle(const AVStream *stream, const AVPacket *packet, const AVSubtitle *read, struct decoded *movie)
{
    if (movie->subtitles < 2) {
        double *span = movie->subtitle_span[movie->subtitles];
        span[0] = (double)packet->pts * av_q2d(stream->time_base);
        span[1] = span[0] + (double)packet->duration * av_q2d(stream->time_base);
        const char *text = read->rects[0]->ass;
        for (int comma = 0; comma < 8; comma++)
            text = strchr(text, ',') + 1;
        snprintf(movie->subtitle[movie->subtitles], sizeof movie->subtitle[0], "%s", text);
    }
    movie->subtitles++;
}

static void take_subtitle(const AVStream *stream, AVPacket *packet, struct decoded *movie)
{
    const AVCodec *decoder = avcodec_find_decoder(stream->codecpar->codec_id);
    AVCodecContext *codec = avcodec_alloc_context3(decoder);
    assert_non_null(codec);
    assert_true(avcodec_parameters_to_context(codec, stream->codecpar) >= 0);
    codec->pkt_timebase = stream->time_base;
    assert_int_equal(avcodec_open2(codec, decoder, NULL), 0);
    AVSubtitle read = {0};
    int got = 0;
    assert_true(avcodec_decode_subtitle2(codec, &read, &got, packet) >= 0);
    if (got && read.num_rects > 0) /* else nothing is shown for a while */
        keep_subtitle(stream, packet, &read, movie);
    avsubtitle_free(&read);
    avcodec_free_context(&codec);
}

/* The film's stream. FFmpeg from 6.1 has the first picture of an AVIF loop as a separate stream. */
static unsigned stream_of_film(const AVFormatContext *format)
{
    unsigned film = 0;
    for (unsigned i = 1; i < format->nb_streams; i++) {
        if (format->streams[i]->codecpar->codec_id == AV_CODEC_ID_AV1 &&
            format->streams[i]->nb_frames > format->streams[film]->nb_frames)
            film = i;
    }
    return film;
}

void decode(const char *path, struct decoded *movie)
{
    memset(movie, 0, sizeof *movie);
    AVFormatContext *format = NULL;
    assert_int_equal(avformat_open_input(&format, path, NULL, NULL), 0);
    assert_true(avformat_find_stream_info(format, NULL) >= 0);
    unsigned lists = 0;
    const unsigned film = stream_of_film(format);
    for (unsigned i = 0; i < format->nb_streams; i++) {
        if (i == film)
            continue;
        if (strstr(path, ".avif")) {
            lists++;
            continue;
        }
        if (format->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_DATA) { /* the chapters of an mp4 file */
            lists++;
            continue;
        }
        if (is_subtitle(format->streams[i]) || format->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_AUDIO) {
            lists++;
            continue;
        }
        assert_true(format->streams[i]->disposition & AV_DISPOSITION_ATTACHED_PIC);
        movie->covers += format->streams[i]->codecpar->codec_id == AV_CODEC_ID_PNG;
        movie->cover_bytes = (size_t)format->streams[i]->attached_pic.size;
    }
    assert_int_equal(format->nb_streams, 1 + lists + movie->covers);
    const AVStream *stream = format->streams[film];
    const AVCodec *decoder = avcodec_find_decoder(stream->codecpar->codec_id);
    if (av_dict_get(stream->metadata, "alpha_mode", NULL, 0)) /* libavcodec's own does not know it */
        decoder = avcodec_find_decoder_by_name("libvpx-vp9");
    assert_non_null(decoder);
    describe(format, stream, decoder, movie);
    AVCodecContext *codec = avcodec_alloc_context3(decoder);
    assert_non_null(codec);
    assert_true(avcodec_parameters_to_context(codec, stream->codecpar) >= 0);
    codec->thread_count = 1;
    assert_int_equal(avcodec_open2(codec, decoder, NULL), 0);
    AVPacket *packet = av_packet_alloc();
    assert_non_null(packet);
    while (av_read_frame(format, packet) >= 0) {
        if (packet->stream_index != (int)film) {
            if (is_subtitle(format->streams[packet->stream_index]))
                take_subtitle(format->streams[packet->stream_index], packet, movie);
            av_packet_unref(packet);
            continue;
        }
        double end = (double)(packet->pts + packet->duration) * av_q2d(stream->time_base);
        movie->duration = end > movie->duration ? end : movie->duration;
        assert_int_equal(avcodec_send_packet(codec, packet), 0);
        take_frames(codec, stream->time_base, movie);
        av_packet_unref(packet);
    }
    assert_int_equal(avcodec_send_packet(codec, NULL), 0);
    take_frames(codec, stream->time_base, movie);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&format);
}

static size_t take_sound(AVCodecContext *codec, float **samples, size_t count)
{
    const int channels = codec->ch_layout.nb_channels;
    AVFrame *frame = av_frame_alloc();
    assert_non_null(frame);
    while (avcodec_receive_frame(codec, frame) >= 0) {
        const size_t more = (size_t)frame->nb_samples;
        bool planes = frame->format == AV_SAMPLE_FMT_FLTP;
        assert_true(planes || frame->format == AV_SAMPLE_FMT_FLT);
        *samples = realloc(*samples, (count + more) * (size_t)channels * sizeof **samples);
        assert_non_null(*samples);
        for (size_t i = 0; i < more * (size_t)channels; i++) {
            size_t at = i / (size_t)channels, channel = i % (size_t)channels;
            (*samples)[count * (size_t)channels + i] = planes ? ((float *)frame->data[channel])[at] : ((float *)frame->data[0])[i];
        }
        count += more;
    }
    av_frame_free(&frame);
    return count;
}

float *decode_sound(const char *path, size_t *count, int *channels)
{
    AVFormatContext *format = NULL;
    AVCodecContext *codec = NULL;
    AVPacket *packet = av_packet_alloc();
    float *samples = NULL;
    assert_non_null(packet);
    assert_int_equal(avformat_open_input(&format, path, NULL, NULL), 0);
    assert_true(avformat_find_stream_info(format, NULL) >= 0);
    const AVCodec *decoder;
    int stream = av_find_best_stream(format, AVMEDIA_TYPE_AUDIO, -1, -1, &decoder, 0);
    assert_true(stream >= 0);
    codec = avcodec_alloc_context3(decoder);
    assert_non_null(codec);
    assert_true(avcodec_parameters_to_context(codec, format->streams[stream]->codecpar) >= 0);
    assert_int_equal(codec->sample_rate, 48000);
    assert_int_equal(avcodec_open2(codec, decoder, NULL), 0);
    *count = 0;
    while (av_read_frame(format, packet) >= 0) {
        if (packet->stream_index == stream) {
            assert_int_equal(avcodec_send_packet(codec, packet), 0);
            *count = take_sound(codec, &samples, *count);
        }
        av_packet_unref(packet);
    }
    assert_int_equal(avcodec_send_packet(codec, NULL), 0);
    *count = take_sound(codec, &samples, *count);
    *channels = codec->ch_layout.nb_channels;
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&format);
    return samples;
}

void decoded_free(struct decoded *movie)
{
    for (size_t i = 0; i < movie->count; i++)
        av_frame_free(&movie->frame[i]);
    movie->count = 0;
}

void decoded_rgb(const AVFrame *frame, int x, int y, int rgb[3])
{
    const uint8_t *line = frame->data[0] + (ptrdiff_t)y * frame->linesize[0];
    switch (frame->format) {
    case AV_PIX_FMT_RGB24:
        for (int c = 0; c < 3; c++)
            rgb[c] = line[3 * x + c];
        break;
    case AV_PIX_FMT_BGR0:
    case AV_PIX_FMT_BGRA:
        for (int c = 0; c < 3; c++)
            rgb[c] = line[4 * x + 2 - c];
        break;
    case AV_PIX_FMT_ARGB:
        for (int c = 0; c < 3; c++)
            rgb[c] = line[4 * x + 1 + c];
        break;
    case AV_PIX_FMT_GBRP:
        for (int c = 0; c < 3; c++) /* planes are G B R */
            rgb[c] = frame->data[(c + 2) % 3][(ptrdiff_t)y * frame->linesize[(c + 2) % 3] + x];
        break;
    default:
        fail_msg("pixel format %d is not RGB", frame->format);
    }
}
