/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FFmpeg's libraries, opened for the first movie, because they load a hundred others that pictures do not need. */
#pragma once

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/crc.h>
#include <libavutil/opt.h>

#include "beadreel/render.h"
#include "sim/base/library.h"

/* From FFmpeg 6.1, encoders accept hints on unchanged parts. */
#if __has_include(<libavutil/video_hint.h>)
#include <libavutil/video_hint.h>
#define BEAD_AV_HINT_OPTIONS "mb_info=1" /* of encoders that use hints */
#else
#define BEAD_AV_HINT_OPTIONS ""
#endif

/* Calls of these libraries go through this table (late.awk). NULL until bead_av_open has succeeded; checking and opening a movie
 * call that first. */
extern void *bead_libav;
extern const struct bead_library_info bead_av_libraries[];

/* Errors: UNSUPPORTED (a library of the version used in the build, or a function, is missing). */
BEAD_CHECK enum bead_error bead_av_open(struct bead_message *msg);
/* Stop libav's log on stderr, which is the program's: errors are reported in messages. */
void bead_av_silence(void);
/* Parse "key=value key=value ...". Returns libav's error number. */
int bead_av_options(const char *text, AVDictionary **options);
/* Tell the encoder that only `changes` of the picture differ from the previous one; NULL: all may. Does nothing if FFmpeg has no
 * such hints. Returns 0 or libav's error number, which is negative. */
int bead_av_hint(AVFrame *picture, const struct bead_changes *changes);
