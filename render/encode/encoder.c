/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes frames to a file with libavcodec and libavformat: one video stream, times in frames, pictures changed in place. The sink's
 * encoding thread calls these functions after pictures.c has converted the pixels. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "render/encode/av_file.h"
#include "render/encode/libav.h"
#include "render/encode/movie_private.h"
#include "render/encode/pictures.h"
#include "render/encode/tracks.h"
#include "render/origin/origin.h"
#include "sim/base/file.h"
#include "sim/base/thread_pool.h"

enum {
    KEY_INTERVAL = 300 /* encoded frames between two that players can jump to */,
    FLUSH_INTERVAL = 8 /* encoded frames that are lost, at most, when the run is killed */
};

struct bead_encoder {
    AVFormatContext *format;
    AVCodecContext *codec;
    struct bead_changes changes;   /* since the last encoded picture */
    struct bead_pictures pictures; /* converted frames; the first is for frames added at once */
    size_t now;                    /* the last one added */
    AVPacket *packet, *held;       /* a packet waits in `held` until the next one gives its duration */
    AVPacket *cover;               /* written at the end; NULL: none */
    struct bead_tracks tracks;     /* also written at the end */
    int file;                      /* descriptor of the part; -1: none */
    int unflushed;                 /* packets */
    AVRational frame_time;         /* s: unit of all times here */
    int64_t last;                  /* time of the last encoded picture */
    bool dirty;                    /* the movie has changed since */
    bool holding;
    bool begun; /* the header is written, the trailer not */
};

/* A message from libav's error number. A failed write comes first: it causes the other errors. */
static enum bead_error fail(const struct bead_movie *movie, const char *what, int code, struct bead_message *msg)
{
    const struct bead_encoder *e = movie->encoder;
    const AVFormatContext *format = e->format;
    int written = format && format->pb ? format->pb->error : 0;
    char text[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(written < 0 ? written : code, text, sizeof text);
    if (code == AVERROR(ENOMEM))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", movie->path);
    if (written < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed: %s", movie->path, text);
    return bead_fail(msg, BEAD_ERROR_CODEC, "%s: %s: %s", movie->path, what, text);
}

static enum bead_error no_memory(const struct bead_movie *movie, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", movie->path);
}

/* BT.709 for YUV, JFIF's BT.601 for YUV of stills, sRGB for everything else. */
static void set_colours(AVCodecContext *c)
{
    const enum AVPixelFormat pixels = c->pix_fmt;
    const bool halved = pixels == AV_PIX_FMT_YUV420P || pixels == AV_PIX_FMT_YUVA420P;
    const bool still = pixels == AV_PIX_FMT_YUVJ444P || pixels == AV_PIX_FMT_YUV444P;
    const bool yuv = halved || pixels == AV_PIX_FMT_YUV444P10 || pixels == AV_PIX_FMT_YUVA444P10;
    c->color_primaries = AVCOL_PRI_BT709;
    c->color_trc = yuv ? AVCOL_TRC_BT709 : AVCOL_TRC_IEC61966_2_1; /* pixels unchanged, in sRGB */
    c->colorspace = yuv ? AVCOL_SPC_BT709 : still ? AVCOL_SPC_BT470BG : AVCOL_SPC_RGB;
    c->color_range = yuv ? AVCOL_RANGE_MPEG : AVCOL_RANGE_JPEG;
    c->chroma_sample_location = halved ? AVCHROMA_LOC_CENTER : AVCHROMA_LOC_UNSPECIFIED;
}

static void set_up(const struct bead_movie *movie)
{
    const struct bead_encoder *e = movie->encoder;
    AVCodecContext *c = e->codec;
    c->width = movie->settings.width;
    c->height = movie->settings.height;
    c->pix_fmt = movie->preset->format;
    set_colours(c);
    c->time_base = e->frame_time;
    c->framerate = av_inv_q(e->frame_time);
    c->sample_aspect_ratio = (AVRational){1, 1};
    c->gop_size = KEY_INTERVAL;
    c->max_b_frames = 0;
    /* Not the number of processors, because the file depends on it. */
    c->thread_count = movie->preset->threads;
    c->thread_type = FF_THREAD_FRAME;
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    if (e->format->oformat->flags & AVFMT_GLOBALHEADER)
        c->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
}

static int start_codec(void *context)
{
    const struct bead_movie *movie = context;
    struct bead_encoder *e = movie->encoder;
    const struct bead_preset *preset = movie->preset;
    const AVCodec *type = avcodec_find_encoder_by_name(preset->encoder);
    e->codec = avcodec_alloc_context3(type);
    if (!e->codec)
        return AVERROR(ENOMEM);
    set_up(movie);
    AVDictionary *options = NULL;
    int code = bead_av_options(preset->options, &options);
    if (code >= 0 && preset->hinted)
        code = bead_av_options(BEAD_AV_HINT_OPTIONS, &options);
    if (code >= 0 && movie->codec->dpi && movie->settings.dpi > 0)
        code = av_dict_set_int(&options, movie->codec->dpi, lround(movie->settings.dpi), 0);
    if (code >= 0)
        code = avcodec_open2(e->codec, type, &options);
    if (code >= 0 && av_dict_count(options))
        code = AVERROR_OPTION_NOT_FOUND;
    av_dict_free(&options);
    return code;
}

static enum bead_error open_codec(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    /* Frames are drawn one after the other, and encoded in several threads: drawing comes first. */
    int code = bead_thread_call_below(start_codec, movie);
    if (code < 0)
        return fail(movie, "cannot open the encoder", code, msg);
    return bead_pictures_open(e->codec, movie->path, &e->pictures, msg);
}

static int open_stream(struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    AVStream *stream = avformat_new_stream(e->format, NULL);
    if (!stream)
        return AVERROR(ENOMEM);
    stream->time_base = e->frame_time;
    stream->avg_frame_rate = av_inv_q(e->frame_time);
    int code = avcodec_parameters_from_context(stream->codecpar, e->codec);
    if (code >= 0 && movie->settings.title)
        code = av_dict_set(&e->format->metadata, "title", movie->settings.title, 0);
    if (code >= 0 && movie->codec->chapters && !movie->codec->plain_options) /* else in the finished file */
        code = bead_chapters_add(e->format, &movie->settings);
    if (code >= 0 && movie->settings.comment)
        code = av_dict_set(&e->format->metadata, "comment", movie->settings.comment, 0);
    return code;
}

static enum bead_error libav_cover(struct bead_movie *movie, const uint8_t *png, size_t bytes, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    av_packet_free(&e->cover);
    e->cover = av_packet_alloc();
    if (!e->cover || bytes > INT_MAX / 2 || av_new_packet(e->cover, (int)bytes) < 0)
        return no_memory(movie, msg);
    memcpy(e->cover->data, png, bytes);
    e->cover->flags = AV_PKT_FLAG_KEY;
    e->cover->pts = e->cover->dts = 0;
    return BEAD_OK;
}

static enum bead_error libav_sound(struct bead_movie *movie, const float *samples, size_t count, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = bead_sound_make(movie->codec->sound, samples, count, movie->settings.channels, &e->tracks);
    return code < 0 ? fail(movie, "cannot encode the sound", code, msg) : BEAD_OK;
}

static enum bead_error open_file(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = open_stream(movie);
    if (code < 0)
        return fail(movie, "no stream", code, msg);
    BEAD_TRY(bead_av_file_create(movie->part, &e->file, msg));
    e->format->pb = bead_av_file_wrap(e->file, true);
    if (!e->format->pb)
        return no_memory(movie, msg);
    AVDictionary *options = NULL;
    code = bead_av_options(movie->codec->muxer_options, &options);
    if (code >= 0)
        code = avformat_write_header(e->format, &options);
    e->begun = code >= 0;
    if (code >= 0 && av_dict_count(options))
        code = AVERROR_OPTION_NOT_FOUND;
    av_dict_free(&options);
    return code < 0 ? fail(movie, "cannot start the file", code, msg) : BEAD_OK;
}

/* Without a name: the table gives the container, open_file the file. */
static int make_format(const char *muxer, AVFormatContext **format)
{
    int code = avformat_alloc_output_context2(format, NULL, muxer, NULL);
    if (code < 0)
        return code;
    (*format)->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO; /* no dates, no random identifiers */
    (*format)->flush_packets = 0;                                   /* only by `flush` */
    return code;
}

static enum bead_error libav_open(struct bead_movie *movie, struct bead_message *msg)
{
    BEAD_TRY(bead_av_open(msg));
    struct bead_encoder *e = movie->encoder = calloc(1, sizeof *e);
    if (!e)
        return no_memory(movie, msg);
    e->file = -1;
    bead_av_silence();
    e->frame_time = av_inv_q(av_d2q(movie->settings.fps, 100100));
    e->packet = av_packet_alloc();
    e->held = av_packet_alloc();
    if (!e->packet || !e->held)
        return no_memory(movie, msg);
    int code = make_format(movie->codec->muxer, &e->format);
    if (code < 0)
        return fail(movie, "libavformat does not write this container", code, msg);
    BEAD_TRY(open_codec(movie, msg));
    return open_file(movie, msg);
}

/* Make all encoded frames readable from the file. */
static int flush(struct bead_encoder *e, const char *ending)
{
    int code = e->format->oformat->flags & AVFMT_ALLOW_FLUSH ? av_write_frame(e->format, NULL) : 0;
    e->unflushed = 0;
    avio_flush(e->format->pb);
    /* The next packet overwrites the ending. */
    if (code >= 0 && ending && pwrite(e->file, ending, BEAD_ENDING_BYTES, avio_seek(e->format->pb, 0, SEEK_CUR)) < 0)
        code = AVERROR(errno);
    return code;
}

/* Write the waiting packet; `next`: time of the next one, or of the end. */
static int release(const struct bead_movie *movie, int64_t next)
{
    struct bead_encoder *e = movie->encoder;
    if (!e->holding)
        return 0;
    e->holding = false;
    e->held->duration = next - e->held->pts;
    av_packet_rescale_ts(e->held, e->frame_time, e->format->streams[0]->time_base);
    e->held->stream_index = 0;
    int code = av_write_frame(e->format, e->held);
    av_packet_unref(e->held);
    return code >= 0 && ++e->unflushed == FLUSH_INTERVAL ? flush(e, movie->codec->ending) : code;
}

static enum bead_error drain(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    for (;;) {
        int code = avcodec_receive_packet(e->codec, e->packet);
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF)
            return BEAD_OK;
        if (code < 0)
            return fail(movie, "encoding failed", code, msg);
        code = release(movie, e->packet->pts);
        if (code >= 0 && e->format->pb->error < 0)
            code = e->format->pb->error;
        if (code < 0)
            return fail(movie, "writing failed", code, msg);
        av_packet_move_ref(e->held, e->packet);
        e->holding = true;
    }
}

static enum bead_error encode(struct bead_movie *movie, int64_t time, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    AVFrame *picture = e->pictures.slots[e->now].picture;
    picture->pts = e->last = time;
    e->dirty = false;
    int code = bead_av_hint(picture, movie->preset->hinted ? &e->changes : NULL);
    if (code >= 0)
        code = avcodec_send_frame(e->codec, picture);
    if (code < 0)
        return fail(movie, "encoding failed", code, msg);
    e->changes.count = 0;
    movie->encoded++;
    return drain(movie, msg);
}

static enum bead_error libav_reserve(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg)
{
    *reserved = true;
    return bead_pictures_reserve(&movie->encoder->pictures, slots, msg);
}

static enum bead_error libav_convert(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                                     const struct bead_changes *missing, struct bead_message *msg)
{
    return bead_pictures_convert(&movie->encoder->pictures, slot, frame, missing, msg);
}

/* A group of frames is encoded as its last one, at the time of its first; but the movie begins with its first frame. A frame equal
 * to the previous one is encoded again, because players seek and editing programs count frames; in drafts the previous picture
 * lasts longer instead. */
static enum bead_error libav_add_slot(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                      struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int64_t time = (int64_t)movie->shown, place = time % movie->group;
    const struct bead_changes aligned = bead_pictures_align(&e->pictures, changes);
    e->now = slot;
    e->dirty = e->dirty || aligned.count > 0;
    for (size_t i = 0; i < aligned.count; i++)
        bead_changes_add(&e->changes, aligned.rect[i]);
    if (!e->dirty && movie->settings.quality == BEAD_QUALITY_DRAFT)
        return BEAD_OK;
    if (time == 0)
        return encode(movie, 0, msg);
    return place == movie->group - 1 && time >= movie->group ? encode(movie, time - place, msg) : BEAD_OK;
}

static enum bead_error libav_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                                 struct bead_message *msg)
{
    BEAD_TRY(libav_convert(movie, 0, frame, changes, msg));
    return libav_add_slot(movie, 0, changes, msg);
}

/* Encode pending changes, and the last frame once more if its picture was only prolonged: players and tools disagree about the
 * duration of a last picture, unless it is one frame. */
static enum bead_error last_frame(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int64_t time = (int64_t)movie->shown - 1, start = time - time % movie->group;
    if (e->last >= start && !e->dirty)
        return BEAD_OK;
    return encode(movie, start > e->last ? start : time, msg);
}

static int set_final_delay(const struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    if (!movie->codec->final_delay)
        return 0;
    /* An exact fraction of a second. */
    AVRational delay = av_mul_q((AVRational){(int)((int64_t)movie->shown - e->last), 1}, e->frame_time);
    return av_opt_set_q(e->format->priv_data, "final_delay", delay, 0);
}

/* Write all encoded frames and close the container. */
static enum bead_error end_part(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = avcodec_send_frame(e->codec, NULL);
    if (code < 0)
        return fail(movie, "encoding failed", code, msg);
    BEAD_TRY(drain(movie, msg));
    code = release(movie, (int64_t)movie->shown);
    if (code >= 0)
        code = set_final_delay(movie);
    if (code >= 0) {
        e->begun = false;
        code = av_write_trailer(e->format);
    }
    avio_flush(e->format->pb);
    if (code >= 0)
        code = e->format->pb->error;
    return code < 0 ? fail(movie, "cannot finish the file", code, msg) : BEAD_OK;
}

static int copy_plain(struct bead_movie *movie, int descriptor)
{
    struct bead_encoder *e = movie->encoder;
    const struct bead_av_beside beside = {e->frame_time, &e->tracks, e->cover, e->codec->pix_fmt};
    AVFormatContext *plain = NULL;
    AVDictionary *options = NULL;
    int code = make_format(movie->codec->plain_muxer ? movie->codec->plain_muxer : movie->codec->muxer, &plain);
    if (code >= 0)
        code = av_dict_copy(&plain->metadata, e->format->metadata, 0);
    if (code >= 0 && movie->description && *movie->description)
        code = av_dict_set(&plain->metadata, "description", movie->description, 0);
    if (code >= 0 && movie->codec->chapters)
        code = bead_chapters_add(plain, &movie->settings);
    if (code >= 0)
        code = bead_av_options(movie->codec->plain_options, &options);
    if (code >= 0)
        code = bead_av_copy(e->file, plain, descriptor, &options, &beside);
    av_dict_free(&options);
    avformat_free_context(plain);
    return code;
}

/* The finished file without fragments, which only the growing file needs: players seek faster in it. It also has the tracks of
 * sound and subtitles. */
static enum bead_error make_plain(struct bead_movie *movie, struct bead_message *msg)
{
    int descriptor;
    enum bead_error err = bead_file_part_name(movie->part, &movie->plain, msg);
    if (!err)
        err = bead_av_file_create(movie->plain, &descriptor, msg);
    if (err) { /* a file with this name is not ours */
        free(movie->plain);
        movie->plain = NULL;
        return err;
    }
    const struct bead_encoder *e = movie->encoder;
    int code = movie->codec->gif ? bead_gif_make(e->file, descriptor, e->frame_time, (int64_t)movie->shown)
                                 : copy_plain(movie, descriptor);
    if (code >= 0 && movie->comment)
        err = bead_origin_put(movie->path, descriptor, movie->comment, msg);
    if (close(descriptor) != 0 && code >= 0)
        code = AVERROR(errno);
    return code < 0 ? fail(movie, "cannot finish the file", code, msg) : err;
}

static enum bead_error close_part(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    bead_av_file_unwrap(&e->format->pb);
    const bool finished = !movie->plain && !movie->codec->gif && !movie->codec->plain_muxer; /* else it is another file */
    if (movie->comment && finished)
        BEAD_TRY(bead_origin_put(movie->path, e->file, movie->comment, msg));
    int descriptor = e->file;
    e->file = -1;
    return close(descriptor) == 0 ? BEAD_OK : bead_fail(msg, BEAD_ERROR_IO, "%s: closing failed", movie->path);
}

static enum bead_error libav_finish(struct bead_movie *movie, bool complete, struct bead_message *msg)
{
    enum bead_error err = last_frame(movie, msg);
    if (!err)
        err = end_part(movie, msg);
    int code = !err && complete ? bead_subtitles_make(movie->codec->subtitles, &movie->settings, &movie->encoder->tracks) : 0;
    if (code < 0)
        err = fail(movie, "no subtitles", code, msg);
    const bool described = movie->codec->chapters && movie->description && *movie->description;
    if (!err && complete && (movie->codec->plain_options || movie->codec->gif || described || movie->encoder->tracks.count > 0))
        err = make_plain(movie, msg);
    return err ? err : close_part(movie, msg);
}

/* SVT-AV1 1.4 hangs if closed before its end, or without a picture. */
static void exhaust(const struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    if (!e->codec || !avcodec_is_open(e->codec) || strcmp(e->codec->codec->name, "libsvtav1") != 0 || e->pictures.count == 0)
        return;
    int code = movie->encoded > 0 ? 0 : avcodec_send_frame(e->codec, e->pictures.slots[0].picture);
    if (code >= 0)
        avcodec_send_frame(e->codec, NULL); /* fails if it has ended */
    while (code >= 0) {
        code = avcodec_receive_packet(e->codec, e->packet);
        av_packet_unref(e->packet);
    }
}

static void libav_destroy(struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    if (!e)
        return;
    exhaust(movie);
    bead_pictures_close(&e->pictures);
    bead_tracks_free(&e->tracks);
    av_packet_free(&e->cover);
    av_packet_free(&e->held);
    av_packet_free(&e->packet);
    avcodec_free_context(&e->codec);
    /* Muxers that set delays hold a packet, and some free it only with the trailer. */
    if (e->begun && movie->codec->final_delay)
        av_write_trailer(e->format);
    if (e->format)
        bead_av_file_unwrap(&e->format->pb);
    avformat_free_context(e->format);
    if (e->file >= 0)
        close(e->file);
    free(e);
}

const struct bead_movie_way bead_movie_libav = {.open = libav_open,
                                                .add = libav_add,
                                                .reserve = libav_reserve,
                                                .convert = libav_convert,
                                                .add_slot = libav_add_slot,
                                                .cover = libav_cover,
                                                .sound = libav_sound,
                                                .finish = libav_finish,
                                                .destroy = libav_destroy};
