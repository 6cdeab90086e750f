/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the packets of a movie's further tracks and writes them among those of the pictures. */
#include "render/encode/tracks.h"

#include <stdlib.h>

struct bead_track *bead_tracks_add(const struct bead_av *av, struct bead_tracks *tracks)
{
    struct bead_track *track = &tracks->track[tracks->count++];
    *track = (struct bead_track){.codec = av->avcodec_parameters_alloc()};
    return track->codec ? track : NULL;
}

AVPacket *bead_track_add(const struct bead_av *av, struct bead_track *track)
{
    if (track->count == track->room) {
        size_t room = 2 * track->room + 16;
        AVPacket **more = realloc(track->packets, room * sizeof *more);
        if (!more)
            return NULL;
        track->packets = more;
        track->room = room;
    }
    AVPacket *packet = av->av_packet_alloc();
    if (packet)
        track->packets[track->count++] = packet;
    return packet;
}

void bead_tracks_free(const struct bead_av *av, struct bead_tracks *tracks)
{
    for (size_t t = 0; t < tracks->count; t++) {
        struct bead_track *track = &tracks->track[t];
        for (size_t i = 0; i < track->count; i++)
            av->av_packet_free(&track->packets[i]);
        free(track->packets);
        av->avcodec_parameters_free(&track->codec);
    }
    tracks->count = 0;
}

int bead_tracks_open(const struct bead_av *av, struct bead_tracks *tracks, AVFormatContext *to)
{
    int code = 0;
    for (size_t t = 0; t < tracks->count && code >= 0; t++) {
        struct bead_track *track = &tracks->track[t];
        AVStream *stream = av->avformat_new_stream(to, NULL);
        if (!stream)
            return AVERROR(ENOMEM);
        track->stream = stream->index;
        stream->time_base = track->unit;
        code = av->avcodec_parameters_copy(stream->codecpar, track->codec);
        if (code >= 0 && track->title)
            code = av->av_dict_set(&stream->metadata, "title", track->title, 0);
    }
    return code;
}

/* The track whose next packet is the earliest; NULL: none begins before `time`. */
static struct bead_track *find_next(struct bead_tracks *tracks, int64_t time, AVRational unit, const struct bead_av *av)
{
    struct bead_track *next = NULL;
    for (size_t t = 0; t < tracks->count; t++) {
        struct bead_track *track = &tracks->track[t];
        if (track->written == track->count)
            continue;
        int64_t begin = track->packets[track->written]->dts;
        if (av->av_compare_ts(begin, track->unit, time, unit) < 0) {
            next = track;
            time = begin;
            unit = track->unit;
        }
    }
    return next;
}

int bead_tracks_write(const struct bead_av *av, struct bead_tracks *tracks, AVFormatContext *to, int64_t time, AVRational unit)
{
    int code = 0;
    struct bead_track *track;
    while (code >= 0 && (track = find_next(tracks, time, unit, av))) {
        AVPacket *packet = track->packets[track->written++];
        packet->stream_index = track->stream;
        av->av_packet_rescale_ts(packet, track->unit, to->streams[track->stream]->time_base);
        code = av->av_write_frame(to, packet);
        av->av_packet_unref(packet);
    }
    return code >= 0 ? to->pb->error : code;
}
