/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of libav: contexts over open descriptors, and the last step of an mp4 movie, which copies the fragments it grew by into a
 * plain file. */
#include "render/encode/av_file.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "beadreel/file.h"

/* Written out when it is full or flushed: large enough for what is flushed at once, so that a killed run is rarely cut within it.
 */
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

/* Libavformat 61 promises not to change the bytes. */
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

AVIOContext *bead_av_file_wrap(const struct bead_av *av, int descriptor, bool writes)
{
    struct place *place = malloc(sizeof *place);
    uint8_t *buffer = av->av_malloc(BUFFER_BYTES);
    AVIOContext *context = NULL;
    if (place && buffer) {
        *place = (struct place){descriptor, 0};
        context = av->avio_alloc_context(buffer, BUFFER_BYTES, writes, place, read_bytes, write_bytes, seek_to);
    }
    if (!context) {
        av->av_free(buffer);
        free(place);
    }
    return context;
}

void bead_av_file_unwrap(const struct bead_av *av, AVIOContext **context)
{
    if (!context || !*context)
        return;
    free((*context)->opaque);
    av->av_free((*context)->buffer);
    av->avio_context_free(context);
}

/* ---- from one file into another ---- */

/* What the muxer needs to read its own file a second time, when it moves the index to the front. */
struct again {
    const struct bead_av *av;
    int descriptor;
};

static int open_again(AVFormatContext *format, AVIOContext **context, const char *url, int flags, AVDictionary **options)
{
    const struct again *again = format->opaque;
    (void)url, (void)options;
    if (flags & AVIO_FLAG_WRITE)
        return AVERROR(EINVAL);
    *context = bead_av_file_wrap(again->av, again->descriptor, false);
    return *context ? 0 : AVERROR(ENOMEM);
}

static int close_again(AVFormatContext *format, AVIOContext *context)
{
    const struct again *again = format->opaque;
    bead_av_file_unwrap(again->av, &context);
    return 0;
}

static int copy_stream(const struct bead_av *av, const AVStream *from, AVFormatContext *to)
{
    AVStream *stream = av->avformat_new_stream(to, NULL);
    if (!stream)
        return AVERROR(ENOMEM);
    const AVDictionaryEntry *alpha = av->av_dict_get(from->metadata, "alpha_mode", NULL, 0); /* of WebM */
    stream->time_base = from->time_base;
    stream->avg_frame_rate = from->avg_frame_rate;
    int code = av->avcodec_parameters_copy(stream->codecpar, from->codecpar);
    stream->sample_aspect_ratio = stream->codecpar->sample_aspect_ratio = (AVRational){1, 1}; /* not read where they are 1 */
    stream->codecpar->bit_rate = 0;                                                           /* of the first fragment only */
    return code < 0 ? code : av->av_dict_set(&stream->metadata, "alpha_mode", alpha ? alpha->value : NULL, 0);
}

/* A picture beside the movie is a stream of its own, of one packet. */
static int add_cover(const struct bead_av *av, AVFormatContext *to)
{
    AVStream *stream = av->avformat_new_stream(to, NULL);
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

/* Two packets of the pictures: one waits until the next tells how long it lasts. */
struct pair {
    AVPacket *held, *next;
};

/* Behind the packets of other tracks that begin earlier: readers find together what is shown together. `end`: of the packet held.
 */
static int write_held(const struct bead_av *av, const struct pair *packets, int64_t end, AVFormatContext *to,
                      struct bead_tracks *tracks)
{
    AVPacket *packet = packets->held;
    if (!packet->data)
        return 0;
    int code = bead_tracks_write(av, tracks, to, packet->dts, to->streams[0]->time_base);
    packet->duration = end - packet->dts;
    if (code >= 0)
        code = av->av_write_frame(to, packet);
    av->av_packet_unref(packet);
    return code >= 0 ? to->pb->error : code;
}

static int copy_pictures(const struct bead_av *av, AVFormatContext *from, const struct pair *packets, AVFormatContext *to,
                         const struct bead_av_beside *beside)
{
    const AVRational unit = to->streams[0]->time_base;
    int code = 0;
    int64_t end = 0;
    while (code >= 0 && (code = av->av_read_frame(from, packets->next)) >= 0) {
        AVPacket *next = packets->next;
        av->av_packet_rescale_ts(next, from->streams[0]->time_base, unit);
        next->pos = -1;
        if (next->dts == AV_NOPTS_VALUE) /* of Matroska; pictures are shown in the order of the file */
            next->dts = next->pts;
        code = write_held(av, packets, next->dts, to, beside->tracks);
        end = next->dts + av->av_rescale_q(1, beside->frame_time, unit); /* the last lasts one frame */
        av->av_packet_move_ref(packets->held, next);
    }
    if (code == AVERROR_EOF)
        code = from->pb->error;
    if (code >= 0)
        code = write_held(av, packets, end, to, beside->tracks);
    return code >= 0 ? bead_tracks_write(av, beside->tracks, to, INT64_MAX, unit) : code;
}

static int copy_packets(const struct bead_av *av, AVFormatContext *from, AVFormatContext *to, const struct bead_av_beside *beside)
{
    struct pair packets = {av->av_packet_alloc(), av->av_packet_alloc()};
    int code = packets.held && packets.next ? copy_pictures(av, from, &packets, to, beside) : AVERROR(ENOMEM);
    av->av_packet_free(&packets.held);
    av->av_packet_free(&packets.next);
    return code;
}

static int write_cover(const struct bead_av *av, AVFormatContext *to, AVPacket *cover)
{
    cover->stream_index = (int)to->nb_streams - 1;
    return av->av_write_frame(to, cover);
}

static int copy_all(const struct bead_av *av, AVFormatContext *from, AVFormatContext *to, AVDictionary **options,
                    const struct bead_av_beside *beside)
{
    int code = copy_stream(av, from->streams[0], to);
    if (code >= 0)
        code = bead_tracks_open(av, beside->tracks, to);
    if (code >= 0 && beside->cover)
        code = add_cover(av, to);
    if (code >= 0)
        code = av->avformat_write_header(to, options);
    if (code >= 0)
        code = copy_packets(av, from, to, beside);
    if (code >= 0 && beside->cover)
        code = write_cover(av, to, beside->cover);
    if (code >= 0)
        code = av->av_write_trailer(to);
    av->avio_flush(to->pb);
    return code >= 0 ? to->pb->error : code;
}

int bead_av_copy(const struct bead_av *av, int from, AVFormatContext *to, int descriptor, AVDictionary **options,
                 const struct bead_av_beside *beside)
{
    struct again again = {av, descriptor};
    AVIOContext *reader = bead_av_file_wrap(av, from, false);
    AVFormatContext *grown = av->avformat_alloc_context();
    to->pb = bead_av_file_wrap(av, descriptor, true);
    int code = reader && grown && to->pb ? 0 : AVERROR(ENOMEM);
    if (code >= 0) {
        to->avoid_negative_ts = 0; /* sound may begin before the pictures by what its encoder needs to get going */
        to->opaque = &again;       /* until the end of this function; cppcheck-suppress autoVariables */
        to->io_open = open_again;
        to->io_close2 = close_again;
        grown->pb = reader;
        code = av->avformat_open_input(&grown, NULL, NULL, NULL); /* frees it on failure, but not its pb */
    }
    if (code >= 0)
        code = grown->nb_streams == 1 ? copy_all(av, grown, to, options, beside) : AVERROR_INVALIDDATA;
    to->opaque = NULL;
    if (grown)
        av->avformat_close_input(&grown);
    bead_av_file_unwrap(av, &reader);
    bead_av_file_unwrap(av, &to->pb);
    return code;
}
