/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of libav: contexts on open descriptors, and the last step of an mp4 movie, which copies its fragments into a plain file. */
#include "render/encode/av_file.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/base/file.h"

/* Large enough for the data between two flushes: a killed run rarely leaves a partial write. */
enum { BUFFER_BYTES = 1 << 20 };

struct place {
    int descriptor;
    int64_t at;
};

enum bead_error bead_av_file_create(const char *part, int *descriptor, struct bead_message *msg)
{
    bool created;
    enum bead_error err = bead_file_open(part, descriptor, &created, msg);
    if (err || ftruncate(*descriptor, 0) == 0)
        return err;
    err = bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written: it cannot be emptied", part);
    close(*descriptor);
    *descriptor = -1;
    if (created)
        bead_file_discard(part);
    return err;
}

static int read_bytes(void *opaque, uint8_t *bytes, int size)
{
    struct place *p = opaque;
    ssize_t got;
    do {
        got = pread(p->descriptor, bytes, (size_t)size, p->at);
    } while (got < 0 && errno == EINTR);
    if (got <= 0)
        return got < 0 ? AVERROR(errno) : AVERROR_EOF;
    p->at += got;
    return (int)got;
}

/* From libavformat 61 the bytes are const. */
#if LIBAVFORMAT_VERSION_MAJOR >= 61
static int write_bytes(void *opaque, const uint8_t *bytes, int size)
#else
static int write_bytes(void *opaque, uint8_t *bytes, int size)
#endif
{
    struct place *p = opaque;
    for (int done = 0; done < size;) {
        ssize_t put = pwrite(p->descriptor, bytes + done, (size_t)(size - done), p->at);
        if (put < 0 && errno != EINTR)
            return AVERROR(errno);
        done += put > 0 ? (int)put : 0;
        p->at += put > 0 ? put : 0;
    }
    return size;
}

static int64_t seek_to(void *opaque, int64_t offset, int whence)
{
    struct place *p = opaque;
    struct stat status;
    if (whence != SEEK_SET && whence != SEEK_CUR && fstat(p->descriptor, &status) != 0)
        return AVERROR(errno);
    if (whence == AVSEEK_SIZE)
        return status.st_size;
    int64_t at = offset + (whence == SEEK_CUR ? p->at : whence == SEEK_END ? status.st_size : 0);
    if (at < 0)
        return AVERROR(EINVAL);
    return p->at = at;
}

AVIOContext *bead_av_file_wrap(int descriptor, bool writes)
{
    struct place *place = malloc(sizeof *place);
    uint8_t *buffer = av_malloc(BUFFER_BYTES);
    AVIOContext *context = NULL;
    if (place && buffer) {
        *place = (struct place){descriptor, 0};
        context = avio_alloc_context(buffer, BUFFER_BYTES, writes, place, read_bytes, write_bytes, seek_to);
    }
    if (!context) {
        av_free(buffer);
        free(place);
    }
    return context;
}

void bead_av_file_unwrap(AVIOContext **context)
{
    if (!context || !*context)
        return;
    free((*context)->opaque);
    av_free((*context)->buffer);
    avio_context_free(context);
}

/* ---- from one file into another ---- */

/* The muxer reads its own file again to move the index to the front: `opaque` is its descriptor. */
static int open_again(AVFormatContext *format, AVIOContext **context, const char *, int flags, AVDictionary **)
{
    const int *descriptor = format->opaque;
    if (flags & AVIO_FLAG_WRITE)
        return AVERROR(EINVAL);
    *context = bead_av_file_wrap(*descriptor, false);
    return *context ? 0 : AVERROR(ENOMEM);
}

static int close_again(AVFormatContext *, AVIOContext *context)
{
    bead_av_file_unwrap(&context);
    return 0;
}

static int copy_stream(const AVStream *from, int format, AVFormatContext *to)
{
    AVStream *stream = avformat_new_stream(to, NULL);
    if (!stream)
        return AVERROR(ENOMEM);
    const AVDictionaryEntry *alpha = av_dict_get(from->metadata, "alpha_mode", NULL, 0); /* of WebM */
    stream->time_base = from->time_base;
    stream->avg_frame_rate = from->avg_frame_rate;
    int code = avcodec_parameters_copy(stream->codecpar, from->codecpar);
    stream->sample_aspect_ratio = stream->codecpar->sample_aspect_ratio = (AVRational){1, 1}; /* not read if 1 */
    stream->codecpar->format = format; /* demuxers leave it out, and the muxer of AVIF needs it */
    stream->codecpar->bit_rate = 0;    /* of the first fragment only */
    return code < 0 ? code : av_dict_set(&stream->metadata, "alpha_mode", alpha ? alpha->value : NULL, 0);
}

/* The cover is a separate stream with one packet. */
static int add_cover(AVFormatContext *to)
{
    AVStream *stream = avformat_new_stream(to, NULL);
    if (!stream)
        return AVERROR(ENOMEM);
    const AVStream *movie = to->streams[0];
    stream->time_base = movie->time_base;
    stream->disposition = AV_DISPOSITION_ATTACHED_PIC;
    stream->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
    stream->codecpar->codec_id = AV_CODEC_ID_PNG;
    stream->codecpar->width = movie->codecpar->width;
    stream->codecpar->height = movie->codecpar->height;
    return 0;
}

/* Two packets of the pictures: `held` waits until `next` gives its duration. */
struct pair {
    AVPacket *held, *next;
};

/* Write the held packet, after packets of other tracks that begin earlier, so that packets for the same time are close together.
 * `end`: its time plus its duration. */
static int write_held(const struct pair *packets, int64_t end, AVFormatContext *to, struct bead_tracks *tracks)
{
    AVPacket *packet = packets->held;
    if (!packet->data)
        return 0;
    int code = bead_tracks_write(tracks, to, packet->dts, to->streams[0]->time_base);
    packet->duration = end - packet->dts;
    if (code >= 0)
        code = av_write_frame(to, packet);
    av_packet_unref(packet);
    return code >= 0 ? to->pb->error : code;
}

static int copy_pictures(AVFormatContext *from, const struct pair *packets, AVFormatContext *to,
                         const struct bead_av_beside *beside)
{
    const AVRational unit = to->streams[0]->time_base;
    int code = 0;
    int64_t end = 0;
    while (code >= 0 && (code = av_read_frame(from, packets->next)) >= 0) {
        AVPacket *next = packets->next;
        av_packet_rescale_ts(next, from->streams[0]->time_base, unit);
        next->pos = -1;
        if (next->dts == AV_NOPTS_VALUE) /* in Matroska; pictures are shown in the order of the file */
            next->dts = next->pts;
        code = write_held(packets, next->dts, to, beside->tracks);
        end = next->dts + av_rescale_q(1, beside->frame_time, unit); /* the last picture lasts one frame */
        av_packet_move_ref(packets->held, next);
    }
    if (code == AVERROR_EOF)
        code = from->pb->error;
    if (code >= 0)
        code = write_held(packets, end, to, beside->tracks);
    return code >= 0 ? bead_tracks_write(beside->tracks, to, INT64_MAX, unit) : code;
}

static int copy_packets(AVFormatContext *from, AVFormatContext *to, const struct bead_av_beside *beside)
{
    struct pair packets = {av_packet_alloc(), av_packet_alloc()};
    int code = packets.held && packets.next ? copy_pictures(from, &packets, to, beside) : AVERROR(ENOMEM);
    av_packet_free(&packets.held);
    av_packet_free(&packets.next);
    return code;
}

static int write_cover(AVFormatContext *to, AVPacket *cover)
{
    cover->stream_index = (int)to->nb_streams - 1;
    return av_write_frame(to, cover);
}

static int copy_all(AVFormatContext *from, AVFormatContext *to, AVDictionary **options, const struct bead_av_beside *beside)
{
    int code = copy_stream(from->streams[0], beside->format, to);
    if (code >= 0)
        code = bead_tracks_open(beside->tracks, to);
    if (code >= 0 && beside->cover)
        code = add_cover(to);
    if (code >= 0)
        code = avformat_write_header(to, options);
    if (code >= 0)
        code = copy_packets(from, to, beside);
    if (code >= 0 && beside->cover)
        code = write_cover(to, beside->cover);
    if (code >= 0)
        code = av_write_trailer(to);
    avio_flush(to->pb);
    return code >= 0 ? to->pb->error : code;
}

int bead_av_copy(int from, AVFormatContext *to, int descriptor, AVDictionary **options, const struct bead_av_beside *beside)
{
    AVIOContext *reader = bead_av_file_wrap(from, false);
    AVFormatContext *grown = avformat_alloc_context();
    to->pb = bead_av_file_wrap(descriptor, true);
    int code = reader && grown && to->pb ? 0 : AVERROR(ENOMEM);
    if (code >= 0) {
        to->avoid_negative_ts = 0; /* sound may begin before the pictures, by the delay of its encoder */
        to->opaque = &descriptor;  /* until the end of this function; cppcheck-suppress autoVariables */
        to->io_open = open_again;
        to->io_close2 = close_again;
        grown->pb = reader;
        code = avformat_open_input(&grown, NULL, NULL, NULL); /* on failure frees the context, but not its pb */
    }
    if (code >= 0)
        code = grown->nb_streams == 1 ? copy_all(grown, to, options, beside) : AVERROR_INVALIDDATA;
    to->opaque = NULL;
    if (grown)
        avformat_close_input(&grown);
    bead_av_file_unwrap(&reader);
    bead_av_file_unwrap(&to->pb);
    return code;
}
