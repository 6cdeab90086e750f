/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the packets of subtitles: texts with little around them, which need no encoder. */
#include "render/encode/tracks.h"

#include <math.h>
#include <string.h>

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
    AVPacket *packet = bead_track_add(track);
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
    struct bead_track *track = bead_tracks_add(tracks);
    if (!track)
        return AVERROR(ENOMEM);
    track->unit = (AVRational){1, subtitles_per_second};
    track->title = "Captions";
    int code = describe_text(format, track->codec);
    for (size_t i = 0; i < settings->subtitle_count && code >= 0; i++)
        code = add_text(format, &settings->subtitles[i], track);
    return code;
}
