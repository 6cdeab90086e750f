/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames of movies, to compare encoders.
 *   pictures_frames raw MOVIE OUT.yuv       the frames as raw planes, 4:2:0 BT.709
 *   pictures_frames psnr MOVIE RAW.yuv      dB, of luma: of all pixels; of the blocks of 16 x 16 that differ from the frame before
 *   pictures_frames options QUALITY         this program's options for mp4 files, as those of `ffmpeg` */
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/encode/movie_private.h"
#include "render/encode/pictures.h"

enum { SIDE = 16, LINE_ALIGN = 64 };

/* Squared errors of luma. */
struct errors {
    double sum;
    uint64_t pixels;
};

struct job {
    FILE *raw;
    AVFrame *planes;       /* raw: the frame as converted */
    uint8_t *now, *before; /* psnr: luma of the raw frames */
    struct errors all, changed;
    size_t frames;
    int (*frame)(struct job *job, const AVFrame *frame);
};

static int complain(const char *what)
{
    fprintf(stderr, "pictures_frames: %s\n", what);
    return -1;
}

static int put_plane(FILE *file, const uint8_t *data, int stride, int width, int height)
{
    for (int y = 0; y < height; y++) {
        if (fwrite(data + (ptrdiff_t)y * stride, 1, (size_t)width, file) != (size_t)width)
            return complain("writing failed");
    }
    return 0;
}

static int make_planes(struct job *job, const AVFrame *frame)
{
    job->planes = av_frame_alloc();
    if (!job->planes)
        return complain("out of memory");
    job->planes->width = frame->width;
    job->planes->height = frame->height;
    job->planes->format = AV_PIX_FMT_YUV420P;
    return av_frame_get_buffer(job->planes, LINE_ALIGN) < 0 ? complain("out of memory") : 0;
}

/* As the encoders of this program get it. */
static int write_raw(struct job *job, const AVFrame *frame)
{
    bool known = frame->format == AV_PIX_FMT_GBRP || frame->format == AV_PIX_FMT_BGR0;
    struct bead_frame pixels;
    struct bead_message msg;
    if (!known)
        return complain("raw frames are made of lossless RGB");
    if (!job->planes && make_planes(job, frame) < 0)
        return -1;
    if (bead_frame_create(frame->width, frame->height, &pixels, &msg))
        return complain(msg.text);
    for (int y = 0; y < frame->height; y++) {
        uint8_t *to = pixels.pixels + (size_t)y * pixels.stride;
        const uint8_t *line[3];
        for (int k = 0; k < 3; k++)
            line[k] = frame->data[k] ? frame->data[k] + (ptrdiff_t)y * frame->linesize[k] : NULL;
        if (frame->format == AV_PIX_FMT_BGR0) {
            memcpy(to, line[0], 4 * (size_t)frame->width);
            continue;
        }
        for (int x = 0; x < frame->width; x++, to += 4) {
            to[0] = line[1][x];
            to[1] = line[0][x];
            to[2] = line[2][x];
        }
    }
    struct bead_rect all = bead_convert_align(&pixels, (struct bead_rect){0, 0, frame->width, frame->height});
    bead_convert_find(AV_PIX_FMT_YUV420P)(&pixels, all, job->planes);
    bead_frame_free(&pixels);
    int status = 0;
    for (int k = 0; k < 3 && !status; k++)
        status =
            put_plane(job->raw, job->planes->data[k], job->planes->linesize[k], frame->width >> (k > 0), frame->height >> (k > 0));
    return status;
}

static int read_luma(struct job *job, const AVFrame *frame)
{
    size_t luma = (size_t)frame->width * (size_t)frame->height;
    if (!job->now) {
        job->now = calloc(luma, 1);
        job->before = calloc(luma, 1);
    }
    if (!job->now || !job->before)
        return complain("out of memory");
    uint8_t *was = job->before;
    job->before = job->now;
    job->now = was;
    if (fread(job->now, 1, luma, job->raw) != luma || fseek(job->raw, (long)(luma / 2), SEEK_CUR))
        return complain("the raw file is shorter than the movie");
    return 0;
}

static void compare_block(struct job *job, const AVFrame *frame, int x0, int y0)
{
    struct errors block = {0, 0};
    bool changed = false;
    int right = x0 + SIDE < frame->width ? x0 + SIDE : frame->width, bottom = y0 + SIDE < frame->height ? y0 + SIDE : frame->height;
    for (int y = y0; y < bottom; y++) {
        size_t at = (size_t)y * (size_t)frame->width + (size_t)x0, width = (size_t)(right - x0);
        const uint8_t *line = frame->data[0] + (ptrdiff_t)y * frame->linesize[0] + x0;
        changed = changed || memcmp(job->now + at, job->before + at, width) != 0;
        for (size_t x = 0; x < width; x++) {
            double d = (double)line[x] - job->now[at + x];
            block.sum += d * d;
        }
        block.pixels += width;
    }
    job->all.sum += block.sum;
    job->all.pixels += block.pixels;
    job->changed.sum += changed ? block.sum : 0;
    job->changed.pixels += changed ? block.pixels : 0;
}

static int compare(struct job *job, const AVFrame *frame)
{
    if (frame->format != AV_PIX_FMT_YUV420P)
        return complain("errors are measured of 4:2:0 only");
    if (read_luma(job, frame) < 0)
        return -1;
    for (int y = 0; y < frame->height; y += SIDE) {
        for (int x = 0; x < frame->width; x += SIDE)
            compare_block(job, frame, x, y);
    }
    return 0;
}

static int receive(struct job *job, AVCodecContext *codec, AVFrame *frame)
{
    int code;
    while ((code = avcodec_receive_frame(codec, frame)) >= 0) {
        job->frames++;
        if (job->frame(job, frame) < 0)
            return -1;
        av_frame_unref(frame);
    }
    return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : complain("decoding failed");
}

static int decode(struct job *job, const char *path)
{
    AVFormatContext *format = NULL;
    AVCodecContext *codec = NULL;
    AVPacket *packet = av_packet_alloc();
    AVFrame *frame = av_frame_alloc();
    const AVCodec *type = NULL;
    int stream = -1, status = -1;
    if (packet && frame && avformat_open_input(&format, path, NULL, NULL) >= 0 && avformat_find_stream_info(format, NULL) >= 0)
        stream = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &type, 0);
    if (stream >= 0)
        codec = avcodec_alloc_context3(type);
    if (codec && avcodec_parameters_to_context(codec, format->streams[stream]->codecpar) >= 0 &&
        avcodec_open2(codec, type, NULL) >= 0)
        status = 0;
    else
        complain("the movie cannot be opened");
    while (!status && av_read_frame(format, packet) >= 0) {
        if (packet->stream_index == stream)
            status = avcodec_send_packet(codec, packet) < 0 ? complain("decoding failed") : receive(job, codec, frame);
        av_packet_unref(packet);
    }
    if (!status)
        status = avcodec_send_packet(codec, NULL) < 0 ? complain("decoding failed") : receive(job, codec, frame);
    av_frame_free(&frame);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&format);
    return status;
}

static double decibels(const struct errors *e)
{
    return e->pixels ? 10 * log10(255.0 * 255.0 * (double)e->pixels / fmax(e->sum, 1)) : NAN;
}

/* "key=value key=value" as "-key value -key value"; values may hold further equals signs. */
static int print_options(const char *quality)
{
    static const char *const names[] = {"draft", "standard", "high"};
    const struct bead_preset *preset = NULL;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(quality, names[i]) == 0)
            preset = &bead_codec_find("movie.mp4", false)->presets[i];
    }
    if (!preset)
        return complain("options: of draft, standard or high"), 2;
    printf("-c:v %s -threads %d", preset->encoder, preset->threads);
    bool key = true;
    for (const char *at = preset->options; *at; at++) {
        if (at == preset->options || at[-1] == ' ')
            printf(" -");
        if (*at == ' ') {
            key = true;
            continue;
        }
        putchar(key && *at == '=' ? ' ' : *at);
        key = key && *at != '=';
    }
    putchar('\n');
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "options") == 0)
        return print_options(argv[2]);
    bool raw = argc == 4 && strcmp(argv[1], "raw") == 0;
    if (!raw && !(argc == 4 && strcmp(argv[1], "psnr") == 0))
        return complain("usage: pictures_frames raw|psnr MOVIE RAW, or options QUALITY"), 2;
    struct job job = {.raw = fopen(argv[3], raw ? "wb" : "rb"), .frame = raw ? write_raw : compare};
    if (!job.raw)
        return complain("the raw file cannot be opened"), 1;
    int status = decode(&job, argv[2]);
    if (!status && !raw)
        printf("%.2f %.2f\n", decibels(&job.all), decibels(&job.changed));
    if (!status && raw)
        printf("%zu\n", job.frames);
    status = fclose(job.raw) ? complain("writing failed") : status;
    av_frame_free(&job.planes);
    free(job.now);
    free(job.before);
    return status ? 1 : 0;
}
