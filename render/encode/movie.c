/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies: checks, and the steps from open to close. The functions of the format are in encoder.c and codecs.c. */

#include <stdlib.h>

#include "render/encode/libav.h"
#include "render/encode/movie_private.h"
#include "render/encode/tracks.h"
#include "render/origin/origin.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/settings.h"
#include "sim/base/suggest.h"

enum { MOST_PIXELS = 16384 };

static enum bead_error unknown_extension(const char *path, struct bead_message *msg)
{
    char list[256] = "";
    const struct bead_codec_info *info;
    for (size_t i = 0; (info = bead_movie_codec(i)); i++)
        bead_list_add(list, sizeof list, ", ", info->extension);
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s: is not the name of a movie; it may end in: %s", path, list);
}

/* Formats with one chroma value for 2 x 2 pixels need even sizes. */
static bool needs_even(enum AVPixelFormat format)
{
    return format == AV_PIX_FMT_YUV420P || format == AV_PIX_FMT_YUVA420P;
}

static bool has_av1(const struct bead_codec *codec)
{
    return codec->av1;
}

static bool has_alpha(const struct bead_codec *codec)
{
    return codec->clear;
}

static bool has_sound(const struct bead_codec *codec)
{
    return codec->sound;
}

/* "webm, mov, apng and png" */
static void list_codecs(bool (*has)(const struct bead_codec *), char *list, size_t size)
{
    const struct bead_codec_info *info;
    const char *last = NULL; /* not listed yet */
    list[0] = '\0';
    for (size_t i = 0; (info = bead_movie_codec(i)); i++) {
        char path[16];
        snprintf(path, sizeof path, ".%s", info->extension);
        if (!has(bead_codec_find(path, false)))
            continue;
        if (last)
            bead_list_add(list, size, ", ", last);
        last = info->extension;
    }
    if (last)
        bead_list_add(list, size, " and ", last);
}

/* The messages name the formats that offer what this one lacks. */
static enum bead_error check_kind(const char *path, const struct bead_codec *codec, const struct bead_movie_settings *settings,
                                  struct bead_message *msg)
{
    char list[128];
    if (settings->channels < 0 || settings->channels > 2)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %d channels of sound; must be 0, 1 or 2", path, settings->channels);
    if (settings->codec == BEAD_CODEC_AV1 && codec->presets && !codec->av1) {
        list_codecs(has_av1, list, sizeof list);
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %s files cannot have AV1 (`codec: av1`); %s files can", path,
                         codec->info.extension, list);
    }
    if (settings->codec == BEAD_CODEC_AV1 && settings->alpha)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %s files cannot be transparent (`background: none`) with `codec: av1`", path,
                         codec->info.extension);
    if (settings->alpha && codec->presets && !bead_codec_preset(codec, settings)) {
        list_codecs(has_alpha, list, sizeof list);
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %s%s files cannot be transparent (`background: none`); %s files can", path,
                         codec->clear ? "lossless " : "", codec->info.extension, list);
    }
    if (settings->channels > 0 && codec->presets && !codec->sound) {
        list_codecs(has_sound, list, sizeof list);
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %s files cannot have sound (`sound`); %s files can", path,
                         codec->info.extension, list);
    }
    return BEAD_OK;
}

static enum bead_error check_size(const char *path, const struct bead_codec *codec, const struct bead_movie_settings *settings,
                                  struct bead_message *msg)
{
    int w = settings->width, h = settings->height;
    if (w < 1 || h < 1 || w > MOST_PIXELS || h > MOST_PIXELS)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: size %d x %d; must be between 1 x 1 and %d x %d", path, w, h, MOST_PIXELS,
                         MOST_PIXELS);
    if (codec->presets && needs_even(bead_codec_preset(codec, settings)->format) && (w % 2 || h % 2))
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: size %d x %d is odd, and this codec needs even sizes; the nearest is %d x %d",
                         path, w, h, w + w % 2, h + h % 2);
    return BEAD_OK;
}

static enum bead_error check_encoders(const char *path, const struct bead_codec *codec, const struct bead_movie_settings *settings,
                                      struct bead_message *msg)
{
    struct bead_message why;
    enum bead_error err = bead_av_open(&why);
    if (err)
        return bead_fail(msg, err, "%s: %s", path, why.text);
    const char *const video = bead_codec_encoder(codec, settings)->encoder;
    const char *const names[] = {video, settings->channels > 0 ? codec->sound->encoder : NULL, codec->gif ? "gif" : NULL};
    const char *const muxers[] = {codec->muxer, codec->plain_muxer};
    for (size_t i = 0; i < sizeof muxers / sizeof muxers[0]; i++) {
        if (muxers[i] && !av_guess_format(muxers[i], NULL, NULL))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: libavformat was built without its muxer %s", path, muxers[i]);
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (names[i] && !avcodec_find_encoder_by_name(names[i]))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: libavcodec was built without its encoder %s", path, names[i]);
    }
    /* SVT-AV1 waits for ever for threads that it could not start; libaom crashes. */
    if (strstr(video, "av1") && !bead_memory_ample())
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: AV1 needs 4 GiB of free addresses (ulimit -v); other codecs need less", path);
    return BEAD_OK;
}

static enum bead_error check(const char *path, const struct bead_movie_settings *settings, const struct bead_codec **codec,
                             struct bead_message *msg)
{
    *codec = bead_codec_find(path, settings->still);
    if (!*codec)
        return unknown_extension(path, msg);
    if ((int)settings->quality < 0 || settings->quality > BEAD_QUALITY_LOSSLESS)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: unknown quality %d", path, (int)settings->quality);
    if ((int)settings->codec < 0 || settings->codec > BEAD_CODEC_AV1)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: unknown codec %d", path, (int)settings->codec);
    BEAD_TRY(check_kind(path, *codec, settings, msg));
    BEAD_TRY(check_size(path, *codec, settings, msg));
    if (!(settings->fps >= 0.01 && settings->fps <= 1000))
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: %g frames a second; must be between 0.01 and 1000", path, settings->fps);
    return (*codec)->presets ? check_encoders(path, *codec, settings, msg) : BEAD_OK;
}

static enum bead_error take(struct bead_movie_settings *own, const struct bead_movie_settings *given, struct bead_message *msg)
{
    return bead_settings_take(own, sizeof *own, BEAD_SETTINGS_UP_TO(struct bead_movie_settings, quality), given,
                              "bead_movie_settings", msg);
}

enum bead_error bead_movie_check(const char *path, const struct bead_movie_settings *settings, struct bead_message *msg)
{
    struct bead_movie_settings own;
    const struct bead_codec *codec;
    BEAD_TRY(take(&own, settings, msg));
    return check(path, &own, &codec, msg);
}

static void destroy(struct bead_movie *movie)
{
    movie->codec->way->destroy(movie);
    free(movie->comment);
    free(movie->description);
    free(movie->plain);
    free(movie->part);
    free(movie->path);
    free(movie);
}

enum bead_error bead_movie_open(const char *path, const struct bead_movie_settings *settings, struct bead_movie **movie,
                                struct bead_message *msg)
{
    *movie = NULL;
    struct bead_movie_settings own;
    const struct bead_codec *codec;
    enum bead_error err = BEAD_OK;
    BEAD_TRY(take(&own, settings, msg));
    BEAD_TRY(check(path, &own, &codec, msg));
    struct bead_movie *m;
    BEAD_TRY(bead_new(&m, 1, msg, "%s", path));
    m->codec = codec;
    m->preset = codec->presets ? bead_codec_encoder(codec, &own) : NULL;
    m->group = (int64_t)bead_codec_group(codec, own.fps);
    m->settings = own;
    if (m->preset)
        snprintf(m->encoded_by, sizeof m->encoded_by, "libavcodec (%s)", codec->gif ? "gif" : m->preset->encoder);
    if (own.comment && codec->presets && bead_origin_is_put(path) && !(m->comment = strdup(own.comment)))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
    if (!err)
        err = bead_file_join(NULL, path, &m->path, msg);
    if (!err)
        err = bead_file_part_name(path, &m->part, msg);
    if (!err)
        err = codec->way->open(m, msg);
    m->settings.title = m->settings.comment = NULL;
    if (err) {
        bead_movie_abort(m);
        return err;
    }
    *movie = m;
    return BEAD_OK;
}

static enum bead_error check_frame(const struct bead_movie *movie, const struct bead_frame *frame, struct bead_message *msg)
{
    const struct bead_movie_settings *s = &movie->settings;
    if (frame->alpha != s->alpha)
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: a frame %s alpha in a movie %s", movie->path,
                         frame->alpha ? "with" : "without", s->alpha ? "with" : "without");
    if (frame->width != s->width || frame->height != s->height || !frame->pixels || frame->stride % 64 ||
        frame->stride / 4 < (size_t)frame->width)
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: a frame of %d x %d (stride %zu) in a movie of %d x %d", movie->path,
                         frame->width, frame->height, frame->stride, s->width, s->height);
    return BEAD_OK;
}

enum bead_error bead_movie_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                               struct bead_message *msg)
{
    const struct bead_changes whole = {1, {{0, 0, frame->width, frame->height}}};
    enum bead_error err = check_frame(movie, frame, msg);
    if (!err)
        err = movie->codec->way->add(movie, frame, movie->shown && changes ? changes : &whole, msg);
    movie->shown += !err;
    movie->failed |= err != BEAD_OK;
    return err;
}

enum bead_error bead_movie_reserve(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg)
{
    *reserved = false;
    return movie->codec->way->reserve ? movie->codec->way->reserve(movie, slots, reserved, msg) : BEAD_OK;
}

enum bead_error bead_movie_convert(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                                   const struct bead_changes *missing, struct bead_message *msg)
{
    BEAD_TRY(check_frame(movie, frame, msg));
    return movie->codec->way->convert(movie, slot, frame, missing, msg);
}

enum bead_error bead_movie_add_slot(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                    struct bead_message *msg)
{
    const struct bead_changes whole = {1, {{0, 0, movie->settings.width, movie->settings.height}}};
    enum bead_error err = movie->codec->way->add_slot(movie, slot, movie->shown ? changes : &whole, msg);
    movie->shown += !err;
    movie->failed |= err != BEAD_OK;
    return err;
}

enum bead_error bead_movie_cover(struct bead_movie *movie, const uint8_t *png, size_t bytes, struct bead_message *msg)
{
    if (!movie->codec->covers || !movie->codec->way->cover || !movie->settings.cover)
        return BEAD_OK;
    return movie->codec->way->cover(movie, png, bytes, msg);
}

enum bead_error bead_movie_sound(struct bead_movie *movie, const float *samples, size_t count, struct bead_message *msg)
{
    if (!movie->codec->sound || !movie->codec->way->sound || movie->settings.channels == 0 || count == 0)
        return BEAD_OK;
    return movie->codec->way->sound(movie, samples, count, msg);
}

const char *bead_movie_encoder(const struct bead_movie *movie)
{
    return movie->encoded_by;
}

uint64_t bead_movie_frames(const struct bead_movie *movie)
{
    return movie->shown;
}

uint64_t bead_movie_encoded(const struct bead_movie *movie)
{
    return movie->encoded;
}

enum bead_error bead_movie_describe(struct bead_movie *movie, const char *text, struct bead_message *msg)
{
    BEAD_FREED char *comment = movie->comment;
    movie->comment = NULL;
    bool good = !comment || asprintf(&movie->comment, "%s%s%s", text, *text ? "\n\n" : "", comment) > 0;
    if (!good)
        movie->comment = NULL;
    free(movie->description);
    movie->description = strdup(text);
    return good && movie->description ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the words of a movie");
}

static enum bead_error finish(struct bead_movie *movie, bool complete, struct bead_message *msg)
{
    if (movie->failed)
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: not finished, as a frame could not be written", movie->path);
    if (!movie->shown)
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: a movie without frames", movie->path);
    return movie->codec->way->finish(movie, complete, msg);
}

static enum bead_error commit(struct bead_movie *movie, struct bead_message *msg)
{
    if (!movie->plain)
        return bead_file_commit(movie->part, movie->path, msg);
    BEAD_TRY(bead_file_commit(movie->plain, movie->path, msg));
    bead_file_discard(movie->part);
    return BEAD_OK;
}

/* `whole`: finish the file under its own name; else leave the unfinished file, which can be played up to here. */
static enum bead_error conclude(struct bead_movie *movie, bool whole, uint64_t *bytes, struct bead_message *msg)
{
    enum bead_error err = finish(movie, whole, msg);
    if (!err && whole)
        err = commit(movie, msg);
    if (err) {
        bead_movie_abort(movie);
        return err;
    }
    if (bytes)
        *bytes = bead_file_bytes(whole ? movie->path : movie->part);
    destroy(movie);
    return BEAD_OK;
}

enum bead_error bead_movie_close(struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg)
{
    return conclude(movie, true, bytes, msg);
}

enum bead_error bead_movie_stop(struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg)
{
    return conclude(movie, false, bytes, msg);
}

void bead_movie_abort(struct bead_movie *movie)
{
    if (!movie)
        return;
    bead_file_discard(movie->plain);
    bead_file_discard(movie->part);
    destroy(movie);
}
