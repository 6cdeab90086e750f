/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes frames to a file with libavcodec and libavformat: one video stream, times in frames, pictures kept and changed in place.
 * The sink's encoding thread calls these functions; pictures.c converts the pixels before. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "beadreel/file.h"
#include "render/encode/av_file.h"
#include "render/encode/chapters.h"
#include "render/encode/gif.h"
#include "render/encode/libav.h"
#include "render/encode/movie_private.h"
#include "render/encode/pictures.h"
#include "render/encode/sound.h"
#include "render/encode/subtitles.h"
#include "render/encode/tracks.h"

enum {
    KEY_INTERVAL = 300 /* encoded frames from one that players can jump to, to the next */,
    FLUSH_INTERVAL = 8 /* encoded frames: so many are lost when the run is killed */
};

struct bead_encoder {
    struct bead_av av;
    AVFormatContext *format;
    AVCodecContext *codec;
    struct bead_changes changes;   /* against the picture encoded last */
    struct bead_pictures pictures; /* frames as converted so far; the first is that of movies added at once */
    size_t now;                    /* the one added last */
    AVPacket *packet, *held;       /* a packet waits in `held` until the time of the next tells its duration */
    AVPacket *cover;               /* written at the end; NULL: none */
    struct bead_tracks tracks;     /* likewise */
    int file;                      /* descriptor of the part; -1: none */
    int unflushed;                 /* packets */
    AVRational frame_time;         /* s: unit of all times here */
    int64_t group;                 /* frames shown as one, to stay below the container's rate; usually 1 */
    int64_t last;                  /* time of the picture encoded last */
    bool dirty;                    /* what is shown has changed since */
    bool holding;
    bool begun; /* the header is written, the trailer not */
};

/* One clear line from libav's error number. If the file could not be written, that caused all the rest. */
static enum bead_error fail(const struct bead_movie *movie, const char *what, int code, struct bead_message *msg)
{
    const struct bead_encoder *e = movie->encoder;
    const AVFormatContext *format = e->format;
    int written = format && format->pb ? format->pb->error : 0;
    char text[AV_ERROR_MAX_STRING_SIZE] = "";
    e->av.av_strerror(written < 0 ? written : code, text, sizeof text);
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

static void set_up(struct bead_encoder *e, const struct bead_preset *preset, const struct bead_picture_format *f)
{
    AVCodecContext *c = e->codec;
    c->width = f->width;
    c->height = f->height;
    c->pix_fmt = f->pixels;
    c->color_primaries = f->primaries;
    c->color_trc = f->transfer;
    c->colorspace = f->matrix;
    c->color_range = f->range;
    c->chroma_sample_location = f->chroma;
    c->time_base = e->frame_time;
    c->framerate = av_inv_q(e->frame_time);
    c->sample_aspect_ratio = (AVRational){1, 1};
    c->gop_size = KEY_INTERVAL;
    c->max_b_frames = 0;
    /* Never as many as there are processors: the number is part of the file. */
    c->thread_count = preset->threads;
    c->thread_type = FF_THREAD_FRAME;
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    if (e->format->oformat->flags & AVFMT_GLOBALHEADER)
        c->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
}

static int start_codec(struct bead_encoder *e, const struct bead_preset *preset, const struct bead_picture_format *format)
{
    const AVCodec *type = e->av.avcodec_find_encoder_by_name(preset->encoder);
    e->codec = e->av.avcodec_alloc_context3(type);
    if (!e->codec)
        return AVERROR(ENOMEM);
    set_up(e, preset, format);
    AVDictionary *options = NULL;
    int code = bead_av_options(&e->av, preset->options, &options);
    if (code >= 0 && preset->hinted)
        code = bead_av_options(&e->av, BEAD_AV_HINT_OPTIONS, &options);
    if (code >= 0)
        code = e->av.avcodec_open2(e->codec, type, &options);
    if (code >= 0 && e->av.av_dict_count(options))
        code = AVERROR_OPTION_NOT_FOUND;
    e->av.av_dict_free(&options);
    return code;
}

static enum bead_error open_codec(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    const struct bead_movie_settings *settings = &movie->settings;
    const struct bead_preset *preset = bead_codec_preset(movie->codec, settings);
    const struct bead_picture_format pictures = bead_picture_format(settings->width, settings->height, preset->format);
    int code = start_codec(e, preset, &pictures);
    if (code < 0)
        return fail(movie, "the encoder cannot be opened", code, msg);
    return bead_pictures_open(&e->av, &pictures, movie->path, &e->pictures, msg);
}

static enum bead_error open_packets(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    e->packet = e->av.av_packet_alloc();
    e->held = e->av.av_packet_alloc();
    return e->packet && e->held ? BEAD_OK : no_memory(movie, msg);
}

static int open_stream(struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    AVStream *stream = e->av.avformat_new_stream(e->format, NULL);
    if (!stream)
        return AVERROR(ENOMEM);
    stream->time_base = e->frame_time;
    stream->avg_frame_rate = av_inv_q(e->frame_time);
    stream->sample_aspect_ratio = (AVRational){1, 1};
    int code = e->av.avcodec_parameters_from_context(stream->codecpar, e->codec);
    if (code >= 0 && movie->settings.title)
        code = e->av.av_dict_set(&e->format->metadata, "title", movie->settings.title, 0);
    if (code >= 0 && movie->codec->chapters && !movie->codec->plain_options) /* else the finished file has them */
        code = bead_chapters_add(&e->av, e->format, &movie->settings);
    if (code >= 0 && movie->settings.comment)
        code = e->av.av_dict_set(&e->format->metadata, "comment", movie->settings.comment, 0);
    return code;
}

static enum bead_error libav_cover(struct bead_movie *movie, const uint8_t *png, size_t bytes, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    e->av.av_packet_free(&e->cover);
    e->cover = e->av.av_packet_alloc();
    if (!e->cover || bytes > INT_MAX / 2 || e->av.av_new_packet(e->cover, (int)bytes) < 0)
        return no_memory(movie, msg);
    memcpy(e->cover->data, png, bytes);
    e->cover->flags = AV_PKT_FLAG_KEY;
    e->cover->pts = e->cover->dts = 0;
    return BEAD_OK;
}

static enum bead_error libav_sound(struct bead_movie *movie, const float *samples, size_t count, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = bead_sound_make(&e->av, movie->codec->sound, samples, count, movie->settings.channels, &e->tracks);
    return code < 0 ? fail(movie, "the sound cannot be encoded", code, msg) : BEAD_OK;
}

/* On success e->format writes to the part. */
static enum bead_error open_part(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    enum bead_error err = bead_av_file_create(movie->part, &e->file, msg);
    if (err)
        return err;
    e->format->pb = bead_av_file_wrap(&e->av, e->file, true);
    return e->format->pb ? BEAD_OK : no_memory(movie, msg);
}

static enum bead_error open_file(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = open_stream(movie);
    if (code < 0)
        return fail(movie, "no stream", code, msg);
    enum bead_error err = open_part(movie, msg);
    if (err)
        return err;
    AVDictionary *options = NULL;
    code = bead_av_options(&e->av, movie->codec->muxer_options, &options);
    if (code >= 0)
        code = e->av.avformat_write_header(e->format, &options);
    e->begun = code >= 0;
    if (code >= 0 && e->av.av_dict_count(options))
        code = AVERROR_OPTION_NOT_FOUND;
    e->av.av_dict_free(&options);
    return code < 0 ? fail(movie, "the file cannot be started", code, msg) : BEAD_OK;
}

/* Without a name: the container comes from the table, the file from open_part. */
static int make_format(struct bead_encoder *e, const struct bead_movie *movie, AVFormatContext **format)
{
    int code = e->av.avformat_alloc_output_context2(format, NULL, movie->codec->muxer, NULL);
    if (code < 0)
        return code;
    (*format)->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO; /* no dates, no random identifiers */
    (*format)->flush_packets = 0;                                   /* but by `flush` */
    return code;
}

static enum bead_error open_format(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = make_format(e, movie, &e->format);
    return code < 0 ? fail(movie, "libavformat does not write this container", code, msg) : BEAD_OK;
}

static enum bead_error libav_open(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_av av;
    enum bead_error err = bead_av_open(&av, msg);
    if (err)
        return err;
    struct bead_encoder *e = movie->encoder = calloc(1, sizeof *e);
    if (!e)
        return no_memory(movie, msg);
    e->av = av;
    e->file = -1;
    bead_av_silence(&e->av);
    double fps = movie->settings.fps;
    e->frame_time = av_inv_q(e->av.av_d2q(fps, 100100));
    e->group = (int64_t)bead_codec_group(movie->codec, fps);
    err = open_format(movie, msg);
    if (!err)
        err = open_codec(movie, msg);
    if (!err)
        err = open_packets(movie, msg);
    return err ? err : open_file(movie, msg);
}

/* What has been encoded can be read from the file. */
static int flush(struct bead_encoder *e, const char *ending)
{
    int code = e->format->oformat->flags & AVFMT_ALLOW_FLUSH ? e->av.av_write_frame(e->format, NULL) : 0;
    e->unflushed = 0;
    e->av.avio_flush(e->format->pb);
    /* The next packet overwrites it. */
    if (code >= 0 && ending && pwrite(e->file, ending, BEAD_ENDING_BYTES, e->av.avio_seek(e->format->pb, 0, SEEK_CUR)) < 0)
        code = AVERROR(errno);
    return code;
}

/* Write the packet that waited; the next one, or the end, comes at time `next`. */
static int release(const struct bead_movie *movie, int64_t next)
{
    struct bead_encoder *e = movie->encoder;
    if (!e->holding)
        return 0;
    e->holding = false;
    e->held->duration = next - e->held->pts;
    e->av.av_packet_rescale_ts(e->held, e->frame_time, e->format->streams[0]->time_base);
    e->held->stream_index = 0;
    int code = e->av.av_write_frame(e->format, e->held);
    e->av.av_packet_unref(e->held);
    return code >= 0 && ++e->unflushed == FLUSH_INTERVAL ? flush(e, movie->codec->ending) : code;
}

static enum bead_error drain(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    for (;;) {
        int code = e->av.avcodec_receive_packet(e->codec, e->packet);
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF)
            return BEAD_OK;
        if (code < 0)
            return fail(movie, "encoding failed", code, msg);
        code = release(movie, e->packet->pts);
        if (code >= 0 && e->format->pb->error < 0)
            code = e->format->pb->error;
        if (code < 0)
            return fail(movie, "writing failed", code, msg);
        e->av.av_packet_move_ref(e->held, e->packet);
        e->holding = true;
    }
}

static enum bead_error encode(struct bead_movie *movie, int64_t time, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    const struct bead_preset *preset = bead_codec_preset(movie->codec, &movie->settings);
    AVFrame *picture = e->pictures.slots[e->now].picture;
    picture->pts = e->last = time;
    e->dirty = false;
    int code = bead_av_hint(&e->av, picture, preset->hinted ? &e->changes : NULL);
    if (code >= 0)
        code = e->av.avcodec_send_frame(e->codec, picture);
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

/* Of a group of frames the last is shown, at the time of the first; but the movie begins with its first. A frame that repeats the
 * one before is encoded again, from the picture there is: players seek in such files and editors count their frames. Drafts show
 * the picture before for longer instead. */
static enum bead_error libav_add_slot(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                      struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int64_t time = (int64_t)movie->shown, place = time % e->group;
    const struct bead_changes aligned = bead_pictures_align(&e->pictures, changes);
    e->now = slot;
    e->dirty = e->dirty || aligned.count > 0;
    for (size_t i = 0; i < aligned.count; i++)
        bead_changes_add(&e->changes, aligned.rect[i]);
    if (!e->dirty && movie->settings.quality == BEAD_QUALITY_DRAFT)
        return BEAD_OK;
    if (time == 0)
        return encode(movie, 0, msg);
    return place == e->group - 1 && time >= e->group ? encode(movie, time - place, msg) : BEAD_OK;
}

static enum bead_error libav_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                                 struct bead_message *msg)
{
    enum bead_error err = libav_convert(movie, 0, frame, changes, msg);
    return err ? err : libav_add_slot(movie, 0, changes, msg);
}

/* What is not on the screen yet, and the last frame again where it was only shown for longer: players and tools
 * disagree about the duration of a last picture, unless it is one frame. */
static enum bead_error last_frame(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int64_t time = (int64_t)movie->shown - 1, start = time - time % e->group;
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
    AVRational delay = e->av.av_mul_q((AVRational){(int)((int64_t)movie->shown - e->last), 1}, e->frame_time);
    return e->av.av_opt_set_q(e->format->priv_data, "final_delay", delay, 0);
}

/* Everything encoded is in the file, and the container closed. */
static enum bead_error end_part(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = e->av.avcodec_send_frame(e->codec, NULL);
    if (code < 0)
        return fail(movie, "encoding failed", code, msg);
    enum bead_error err = drain(movie, msg);
    if (err)
        return err;
    code = release(movie, (int64_t)movie->shown);
    if (code >= 0)
        code = set_final_delay(movie);
    if (code >= 0) {
        e->begun = false;
        code = e->av.av_write_trailer(e->format);
    }
    e->av.avio_flush(e->format->pb);
    if (code >= 0)
        code = e->format->pb->error;
    return code < 0 ? fail(movie, "the file cannot be finished", code, msg) : BEAD_OK;
}

static int copy_plain(struct bead_movie *movie, int descriptor)
{
    struct bead_encoder *e = movie->encoder;
    const struct bead_av_beside beside = {e->frame_time, &e->tracks, e->cover};
    AVFormatContext *plain = NULL;
    AVDictionary *options = NULL;
    int code = make_format(e, movie, &plain);
    if (code >= 0)
        code = e->av.av_dict_copy(&plain->metadata, e->format->metadata, 0);
    if (code >= 0 && movie->codec->chapters)
        code = bead_chapters_add(&e->av, plain, &movie->settings);
    if (code >= 0)
        code = bead_av_options(&e->av, movie->codec->plain_options, &options);
    if (code >= 0)
        code = bead_av_copy(&e->av, e->file, plain, descriptor, &options, &beside);
    e->av.av_dict_free(&options);
    e->av.avformat_free_context(plain);
    return code;
}

/* Fragments are for the unfinished file: players seek faster in a plain one. Tracks beside the pictures are only in the finished
 * file. */
static enum bead_error make_plain(struct bead_movie *movie, struct bead_message *msg)
{
    int descriptor;
    enum bead_error err = bead_file_part_name(movie->part, &movie->plain, msg);
    if (!err)
        err = bead_av_file_create(movie->plain, &descriptor, msg);
    if (err) { /* what stands there is not ours */
        free(movie->plain);
        movie->plain = NULL;
        return err;
    }
    const struct bead_encoder *e = movie->encoder;
    int code = movie->codec->gif ? bead_gif_make(&e->av, e->file, descriptor, e->frame_time, (int64_t)movie->shown)
                                 : copy_plain(movie, descriptor);
    if (code >= 0 && movie->codec->gif && movie->comment)
        err = movie->codec->comment(descriptor, movie->comment, msg);
    if (close(descriptor) != 0 && code >= 0)
        code = AVERROR(errno);
    return code < 0 ? fail(movie, "the file cannot be finished", code, msg) : err;
}

static enum bead_error make_tracks(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    int code = bead_subtitles_make(&e->av, movie->codec->subtitles, &movie->settings, &e->tracks);
    return code < 0 ? fail(movie, "no subtitles", code, msg) : BEAD_OK;
}

static enum bead_error close_part(struct bead_movie *movie, struct bead_message *msg)
{
    struct bead_encoder *e = movie->encoder;
    bead_av_file_unwrap(&e->av, &e->format->pb);
    bool own = movie->comment && !movie->codec->gif; /* else the finished file has it */
    enum bead_error err = own ? movie->codec->comment(e->file, movie->comment, msg) : BEAD_OK;
    if (err)
        return err;
    int descriptor = e->file;
    e->file = -1;
    return close(descriptor) == 0 ? BEAD_OK : bead_fail(msg, BEAD_ERROR_IO, "%s: closing failed", movie->path);
}

static enum bead_error libav_finish(struct bead_movie *movie, bool complete, struct bead_message *msg)
{
    enum bead_error err = last_frame(movie, msg);
    if (!err)
        err = end_part(movie, msg);
    if (!err && complete)
        err = make_tracks(movie, msg);
    if (!err && complete && (movie->codec->plain_options || movie->codec->gif || movie->encoder->tracks.count > 0))
        err = make_plain(movie, msg);
    return err ? err : close_part(movie, msg);
}

static void libav_destroy(struct bead_movie *movie)
{
    struct bead_encoder *e = movie->encoder;
    if (!e)
        return;
    bead_pictures_close(&e->pictures);
    bead_tracks_free(&e->av, &e->tracks);
    e->av.av_packet_free(&e->cover);
    e->av.av_packet_free(&e->held);
    e->av.av_packet_free(&e->packet);
    e->av.avcodec_free_context(&e->codec);
    /* Muxers that set delays keep a packet back, and some free it only with the trailer. */
    if (e->begun && movie->codec->final_delay)
        e->av.av_write_trailer(e->format);
    if (e->format)
        bead_av_file_unwrap(&e->av, &e->format->pb);
    e->av.avformat_free_context(e->format);
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
