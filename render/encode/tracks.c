/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the packets of a movie's sound and subtitles, and writes them between those of the pictures. */
#include "render/encode/tracks.h"

#include <stdlib.h>

#include "sim/base/memory.h"

struct bead_track *bead_tracks_add(struct bead_tracks *tracks)
{
    struct bead_track *track = &tracks->track[tracks->count++];
    *track = (struct bead_track){.codec = avcodec_parameters_alloc()};
    return track->codec ? track : NULL;
}

AVPacket *bead_track_add(struct bead_track *track)
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
    tracks->count = 0;
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
