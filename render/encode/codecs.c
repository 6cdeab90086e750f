/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of codecs: the container of each movie format, and the encoder and options of each quality. */
#include "render/encode/movie_private.h"

#include "render/draw/picture.h"
#include "render/encode/libav.h"
#include "render/encode/tracks.h"
#include "sim/base/file.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* Hashes instead of pictures: a line of 16 hexadecimal digits for each frame, to compare runs without a codec. */

static enum bead_error hash_open(struct bead_movie *movie, struct bead_message *msg)
{
    return bead_file_create(movie->part, &movie->lines, msg);
}

/* Always of the whole frame, so that a change missing in `changes` is noticed. */
static enum bead_error hash_add(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *,
                                struct bead_message *msg)
{
    if (fprintf(movie->lines, "%016" PRIx64 "\n", bead_frame_hash(frame)) < 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: writing failed", movie->part);
    movie->encoded++;
    return BEAD_OK;
}

static enum bead_error hash_finish(struct bead_movie *movie, bool, struct bead_message *msg)
{
    FILE *file = movie->lines;
    movie->lines = NULL;
    return bead_file_close(file, movie->part, msg);
}

static void hash_destroy(struct bead_movie *movie)
{
    if (movie->lines)
        fclose(movie->lines);
}

static const struct bead_movie_way movie_hashes = {
    .open = hash_open, .add = hash_add, .finish = hash_finish, .destroy = hash_destroy};

/* Most of a bead movie never changes, so most of the encoder's time is spent on its search for a better encoding: constant QP, no
 * lookahead and no B-frames take a third of the time of the presets that they modify. Small intra blocks improve the picture more
 * than a better motion search: with them QP 26 is as close to the original as the usual rate factor 18. Where images fill in, block
 * edges are visible without the deblocking filter: the standard quality uses it, at QP 24, for about a fifth of the size; drafts do
 * not. Parts that do not move keep the quality of the key frames: these are 12 QP better (ipratio=4; high: 9), which makes colour
 * bars exact to two levels and text sharp, for 1 % of the size.
 */
#define H264_LEAN     "x264-params=bframes=0:rc-lookahead=0:sync-lookahead=0:mbtree=0:scenecut=0:weightp=0"
#define H264_DRAFT    "preset=ultrafast qp=28 " H264_LEAN ":ipratio=4:cabac=1"
#define H264_STANDARD "preset=ultrafast qp=24 " H264_LEAN ":ipratio=4:cabac=1:partitions=i4x4:no-deblock=0:deblock=0,0"
#define H264_HIGH     "preset=fast qp=17 " H264_LEAN ":ipratio=2.83"
#define H264_LOSSLESS "preset=ultrafast qp=0 " H264_LEAN ":cabac=1"
#define VP9_LEAN      "lag-in-frames=0 auto-alt-ref=0 row-mt=0 tile-columns=0 frame-parallel=0 aq-mode=0 b=0 "

/* By quality: draft, standard, high, lossless. */
static const struct bead_preset h264[] = {{"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_DRAFT},
                                          {"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_STANDARD},
                                          {"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_HIGH},
                                          {"libx264rgb", AV_PIX_FMT_BGR0, 4, true, H264_LOSSLESS}};
static const struct bead_preset h264_or_ffv1[] = {
    {"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_DRAFT},
    {"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_STANDARD},
    {"libx264", AV_PIX_FMT_YUV420P, 4, true, H264_HIGH},
    {"ffv1", AV_PIX_FMT_BGR0, 1, false, "level=3 coder=rice context=0 slices=4 slicecrc=1"}};
static const struct bead_preset vp9[] = {
    {"libvpx-vp9", AV_PIX_FMT_YUV420P, 1, false, VP9_LEAN "deadline=realtime cpu-used=8 crf=32"},
    {"libvpx-vp9", AV_PIX_FMT_YUV420P, 1, false, VP9_LEAN "deadline=realtime cpu-used=7 crf=24"},
    {"libvpx-vp9", AV_PIX_FMT_YUV420P, 1, false, VP9_LEAN "deadline=good cpu-used=4 crf=15"},
    {"libvpx-vp9", AV_PIX_FMT_GBRP, 1, false, VP9_LEAN "deadline=realtime cpu-used=8 lossless=1"}};
static const struct bead_preset vp9_clear[] = {
    {"libvpx-vp9", AV_PIX_FMT_YUVA420P, 1, false, VP9_LEAN "deadline=realtime cpu-used=8 crf=32"},
    {"libvpx-vp9", AV_PIX_FMT_YUVA420P, 1, false, VP9_LEAN "deadline=realtime cpu-used=7 crf=24"},
    {"libvpx-vp9", AV_PIX_FMT_YUVA420P, 1, false, VP9_LEAN "deadline=good cpu-used=4 crf=15"},
    {.encoder = NULL}};
/* SVT-AV1 gives the same pictures with any number of threads (lp). If it is missing, or a side is too short for it, libaom replaces
 * it. */
#define SVT_AV1(preset, crf) "preset=" preset " crf=" crf " svtav1-params=lp=4"
#define AOM(speed, crf)      "usage=realtime cpu-used=" speed " row-mt=0 tiles=1x1 b=0 crf=" crf
#define AOM_LOSSLESS \
    "usage=good cpu-used=6 row-mt=0 tiles=1x1 lag-in-frames=0 b=0 crf=0 aom-params=lossless=1" /* realtime is not exact */
enum { SVT_LEAST = 64 /* px */ };
static const struct bead_preset aom[] = {{"libaom-av1", AV_PIX_FMT_YUV420P, 1, false, AOM("8", "35")},
                                         {"libaom-av1", AV_PIX_FMT_YUV420P, 1, false, AOM("7", "28")},
                                         {"libaom-av1", AV_PIX_FMT_YUV420P, 1, false, AOM("6", "18")},
                                         {"libaom-av1", AV_PIX_FMT_GBRP, 1, false, AOM_LOSSLESS}};
static const struct bead_preset av1[] = {{"libsvtav1", AV_PIX_FMT_YUV420P, 1, false, SVT_AV1("12", "35")},
                                         {"libsvtav1", AV_PIX_FMT_YUV420P, 1, false, SVT_AV1("10", "30")},
                                         {"libsvtav1", AV_PIX_FMT_YUV420P, 1, false, SVT_AV1("8", "20")},
                                         {"libaom-av1", AV_PIX_FMT_GBRP, 1, false, AOM_LOSSLESS}};
/* The encoder of WebP holds all pictures until the end. Not lossless, which takes three times as long and twice the size. */
static const struct bead_preset webp[] = {{"libwebp_anim", AV_PIX_FMT_BGRA, 1, false, "compression_level=0 quality=75"},
                                          {"libwebp_anim", AV_PIX_FMT_BGRA, 1, false, "compression_level=2 quality=90"},
                                          {"libwebp_anim", AV_PIX_FMT_BGRA, 1, false, "compression_level=4 quality=97"},
                                          {"libwebp_anim", AV_PIX_FMT_BGRA, 1, false, "compression_level=2 lossless=1"}};
/* ProRes 4444 at constant quantisers (12, 6, 2; in units of 118), which encode flat colours in little space. The vendor is the one
 * that editing programs expect. ProRes is never lossless; PNG is. */
#define PRORES(quantiser) "profile=4444 vendor=apl0 flags=+qscale global_quality=" quantiser
/* Frames have 8 bits of transparency; 16, the encoder's default, take a quarter more space for the same levels. */
#define CLEAR " alpha_bits=8"
static const struct bead_preset prores[] = {{"prores_ks", AV_PIX_FMT_YUV444P10, 4, false, PRORES("1416")},
                                            {"prores_ks", AV_PIX_FMT_YUV444P10, 4, false, PRORES("708")},
                                            {"prores_ks", AV_PIX_FMT_YUV444P10, 4, false, PRORES("236")},
                                            {"png", AV_PIX_FMT_RGB24, 4, false, "pred=sub compression_level=3"}};
static const struct bead_preset prores_clear[] = {{"prores_ks", AV_PIX_FMT_YUVA444P10, 4, false, PRORES("1416") CLEAR},
                                                  {"prores_ks", AV_PIX_FMT_YUVA444P10, 4, false, PRORES("708") CLEAR},
                                                  {"prores_ks", AV_PIX_FMT_YUVA444P10, 4, false, PRORES("236") CLEAR},
                                                  {"png", AV_PIX_FMT_RGBA, 4, false, "pred=sub compression_level=3"}};
/* All qualities give the same pixels; they differ in the effort to make the file small. */
static const struct bead_preset apng[] = {{"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=1"},
                                          {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=3"},
                                          {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=6"},
                                          {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=6"}};
static const struct bead_preset apng_clear[] = {{"apng", AV_PIX_FMT_RGBA, 1, false, "pred=sub compression_level=1"},
                                                {"apng", AV_PIX_FMT_RGBA, 1, false, "pred=sub compression_level=3"},
                                                {"apng", AV_PIX_FMT_RGBA, 1, false, "pred=sub compression_level=6"},
                                                {"apng", AV_PIX_FMT_RGBA, 1, false, "pred=sub compression_level=6"}};
/* A GIF is first written as an animated PNG. */
static const struct bead_preset growing_gif[] = {{"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=1"},
                                                 {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=1"},
                                                 {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=1"},
                                                 {"apng", AV_PIX_FMT_RGB24, 1, false, "pred=sub compression_level=1"}};

/* Stills have one quality. TIFF and WebP are exact; JPEG, at its smallest quantisers (2, in units of 118), and AV1 are close (48
 * dB), and store the colour of each pixel, so that thin letters keep theirs. */
static const struct bead_preset jpeg = {"mjpeg", AV_PIX_FMT_YUVJ444P, 1, false, "flags=+qscale global_quality=236"},
                                tiff = {"tiff", AV_PIX_FMT_RGB24, 1, false, "compression_algo=lzw"},
                                tiff_clear = {"tiff", AV_PIX_FMT_RGBA, 1, false, "compression_algo=lzw"},
                                webp_still = {"libwebp", AV_PIX_FMT_BGRA, 1, false, "compression_level=2 lossless=1"},
                                avif_still = {"libaom-av1", AV_PIX_FMT_YUV444P, 1, false,
                                              "usage=allintra cpu-used=8 row-mt=0 tiles=1x1 still-picture=1 crf=8"};

/* The last chunk of a PNG file. */
#define PNG_END   "\0\0\0\0IEND\xae\x42\x60\x82"
#define MP4_PARTS "movflags=+empty_moov+default_base_moof+frag_custom"
#define APNG                                                                                                   \
    .way = &bead_movie_libav, .muxer = "apng", .muxer_options = "plays=0", .ending = PNG_END, .presets = apng, \
    .clear = apng_clear, .final_delay = true

static const struct bead_codec codecs[] = {
    {.info = {"mp4", "H.264, plays everywhere (lossless: RGB, not in all players); AV1"},
     .way = &bead_movie_libav,
     .muxer = "mp4",
     .muxer_options = MP4_PARTS,
     .plain_options = "movflags=+faststart",
     .presets = h264,
     .av1 = av1,
     .chapters = true,
     .subtitles = &bead_subtitles_mp4,
     .sound = &bead_sound_aac,
     .covers = true},
    {.info = {"mov", "ProRes 4444, for editing; lossless: PNG"},
     .way = &bead_movie_libav,
     .muxer = "mov",
     .muxer_options = MP4_PARTS,
     .plain_options = "movflags=+faststart+use_metadata_tags",
     .presets = prores,
     .clear = prores_clear,
     .chapters = true,
     .subtitles = &bead_subtitles_mp4,
     .sound = &bead_sound_aac},
    {.info = {"mkv", "H.264 in Matroska; lossless: FFV1; AV1"},
     .way = &bead_movie_libav,
     .muxer = "matroska",
     .chapters = true,
     .subtitles = &bead_subtitles_mkv,
     .sound = &bead_sound_opus,
     .presets = h264_or_ffv1,
     .av1 = av1},
    {.info = {"webm", "VP9, plays in browsers (lossless: RGB); AV1"},
     .way = &bead_movie_libav,
     .muxer = "webm",
     .chapters = true,
     .subtitles = &bead_subtitles_webm,
     .sound = &bead_sound_opus,
     .presets = vp9,
     .clear = vp9_clear,
     .av1 = av1},
    {.info = {"avif", "a loop in AV1"},
     .way = &bead_movie_libav,
     .muxer = "mp4",
     .muxer_options = MP4_PARTS,
     .plain_muxer = "avif",
     .plain_options = "",
     .presets = av1,
     .av1 = av1},
    {.info = {"webp", "a loop in WebP"},
     .way = &bead_movie_libav,
     .muxer = "webp",
     .muxer_options = "loop=0",
     .presets = webp,
     .clear = webp},
    {.info = {"gif", "animated GIF, 255 colours, at most 50 frames a second"},
     .way = &bead_movie_libav,
     .muxer = "apng",
     .muxer_options = "plays=0",
     .ending = PNG_END,
     .gif = true,
     .presets = growing_gif,
     .final_delay = true,
     .most_fps = 50},
    {.info = {"apng", "animated PNG, lossless"}, APNG},
    {.info = {"png", "animated PNG, lossless"}, APNG},
    {.info = {"hash", "a line per frame with the hash of its pixels, to compare runs"}, .way = &movie_hashes},
};

#define STILL(extension, description, ...)                                      \
    {                                                                           \
        .info = {extension, description}, .way = &bead_movie_libav, __VA_ARGS__ \
    }
#define TIFF .muxer = "image2pipe", .presets = &tiff, .clear = &tiff_clear, .dpi = "dpi"
static const struct bead_codec stills[] = {
    STILL("jpg", "JPEG", .muxer = "image2pipe", .presets = &jpeg),
    STILL("jpeg", "JPEG", .muxer = "image2pipe", .presets = &jpeg),
    STILL("tif", "TIFF, lossless", TIFF),
    STILL("tiff", "TIFF, lossless", TIFF),
    STILL("webp", "WebP, lossless", .muxer = "image2pipe", .presets = &webp_still, .clear = &webp_still),
    STILL("avif", "AV1", .muxer = "avif", .presets = &avif_still),
};

enum { CODECS = sizeof codecs / sizeof *codecs, STILLS = sizeof stills / sizeof *stills };

const struct bead_codec_info *bead_movie_codec(size_t index)
{
    return index < CODECS ? &codecs[index].info : NULL;
}

const struct bead_codec *bead_codec_find(const char *path, bool still)
{
    const char *dot = strrchr(path, '.');
    const struct bead_codec *all = still ? stills : codecs;
    for (int i = 0; dot && i < (still ? STILLS : CODECS); i++) {
        if (strcasecmp(dot + 1, all[i].info.extension) == 0)
            return &all[i];
    }
    return NULL;
}

const struct bead_preset *bead_codec_preset(const struct bead_codec *codec, const struct bead_movie_settings *settings)
{
    const bool asked = settings->codec == BEAD_CODEC_AV1;
    const struct bead_preset *presets = settings->alpha ? (asked ? NULL : codec->clear) : asked ? codec->av1 : codec->presets;
    const size_t row = settings->still ? 0 : settings->quality;
    return presets && presets[row].encoder ? &presets[row] : NULL;
}

const struct bead_preset *bead_codec_encoder(const struct bead_codec *codec, const struct bead_movie_settings *settings)
{
    const struct bead_preset *preset = bead_codec_preset(codec, settings);
    if (preset != &av1[settings->quality])
        return preset;
    const bool small = settings->width < SVT_LEAST || settings->height < SVT_LEAST;
    return small || !avcodec_find_encoder_by_name(preset->encoder) ? &aom[settings->quality] : preset;
}

size_t bead_codec_group(const struct bead_codec *codec, double fps)
{
    return codec->most_fps ? (size_t)fmax(1, ceil(fps / codec->most_fps - 1e-6)) : 1;
}
