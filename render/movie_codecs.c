#include "render/movie_private.h"

#include <string.h>
#include <strings.h>

enum { MP4, MKV, WEBM, GIF, APNG, PNG, HASH, CODECS };

static const struct bead_codec_info infos[CODECS + 1] = {
    [MP4] = {"mp4", "H.264, plays everywhere (lossless: RGB, few players)"},
    [MKV] = {"mkv", "H.264 in Matroska; lossless: FFV1"},
    [WEBM] = {"webm", "VP9, plays in browsers (lossless: RGB)"},
    [GIF] = {"gif", "animated GIF, 255 colours, at most 50 frames a second"},
    [APNG] = {"apng", "animated PNG, lossless"},
    [PNG] = {"png", "animated PNG, lossless"},
    [HASH] = {"hash", "one line a frame: hash of its pixels, to compare runs"},
};

/* Most of a bead movie never changes, and there the search for a better encoding is the cost, not the picture:
 * constant QP, no lookahead and no B-frames take a third of the time of the presets they start from. */
#define X264_LEAN "bframes=0:rc-lookahead=0:sync-lookahead=0:mbtree=0:scenecut=0:weightp=0"
#define X264_DRAFT                                                                                                                 \
    {                                                                                                                              \
        "libx264", AV_PIX_FMT_YUV420P, "preset=ultrafast qp=26 x264-params=" X264_LEAN ":cabac=1"                                  \
    }
#define X264_STANDARD                                                                                                              \
    {                                                                                                                              \
        "libx264", AV_PIX_FMT_YUV420P, "preset=veryfast qp=24 x264-params=" X264_LEAN ":subme=1:me=dia:ref=1"                      \
    }
#define X264_HIGH                                                                                                                  \
    {                                                                                                                              \
        "libx264", AV_PIX_FMT_YUV420P, "preset=fast qp=17 x264-params=" X264_LEAN                                                  \
    }
#define X264_LOSSLESS                                                                                                              \
    {                                                                                                                              \
        "libx264rgb", AV_PIX_FMT_BGR0, "preset=ultrafast qp=0 x264-params=" X264_LEAN ":cabac=1"                                   \
    }
#define VP9 "lag-in-frames=0 auto-alt-ref=0 row-mt=0 tile-columns=0 frame-parallel=0 aq-mode=0 "
#define FFV1_LOSSLESS                                                                                                              \
    {                                                                                                                              \
        "ffv1", AV_PIX_FMT_BGR0, "level=3 coder=rice context=0 slices=4 slicecrc=1"                                                \
    }
#define APNG_CODEC                                                                                                                 \
    {                                                                                                                              \
        .way = &bead_movie_libav, .muxer = "apng", .muxer_options = "plays=0", .delay_unit = 1, .same_preset = true,               \
        .preset[BEAD_QUALITY_LOSSLESS] = {"apng", AV_PIX_FMT_RGB24, "pred=up compression_level=3"},                                \
    }

static const struct bead_codec codecs[CODECS] = {
    [MP4] = {.way = &bead_movie_libav,
             .muxer = "mp4",
             .muxer_options = "movflags=+faststart",
             .preset = {X264_DRAFT, X264_STANDARD, X264_HIGH, X264_LOSSLESS}},
    [MKV] = {.way = &bead_movie_libav,
             .muxer = "matroska",
             .muxer_options = "",
             .preset = {X264_DRAFT, X264_STANDARD, X264_HIGH, FFV1_LOSSLESS}},
    [WEBM] = {.way = &bead_movie_libav,
              .muxer = "webm",
              .muxer_options = "",
              .preset = {{"libvpx-vp9", AV_PIX_FMT_YUV420P, VP9 "deadline=realtime cpu-used=8 b=0 crf=32"},
                         {"libvpx-vp9", AV_PIX_FMT_YUV420P, VP9 "deadline=realtime cpu-used=7 b=0 crf=24"},
                         {"libvpx-vp9", AV_PIX_FMT_YUV420P, VP9 "deadline=good cpu-used=4 b=0 crf=15"},
                         {"libvpx-vp9", AV_PIX_FMT_GBRP, VP9 "deadline=realtime cpu-used=8 lossless=1"}}},
    [GIF] = {.way = &bead_movie_libav,
             .muxer = "gif",
             .muxer_options = "loop=0",
             .delay_unit = 100,
             .most_fps = 50,
             .same_preset = true,
             .preset[BEAD_QUALITY_LOSSLESS] = {"gif", AV_PIX_FMT_PAL8, ""}},
    [APNG] = APNG_CODEC,
    [PNG] = APNG_CODEC,
    [HASH] = {.way = &bead_movie_hashes, .same_preset = true},
};

const struct bead_codec_info *bead_movie_codecs(void)
{
    return infos;
}

const struct bead_codec *bead_codec_find(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < CODECS; i++) {
        if (strcasecmp(dot + 1, infos[i].extension) == 0)
            return &codecs[i];
    }
    return NULL;
}

const struct bead_preset *bead_codec_preset(const struct bead_codec *codec, enum bead_quality quality)
{
    return &codec->preset[codec->same_preset ? BEAD_QUALITY_LOSSLESS : quality];
}
