/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FFmpeg's libraries, opened when a movie is made: they pull in a hundred others, which pictures need not wait for. */
#ifndef BEADREEL_RENDER_ENCODE_LIBAV_H
#define BEADREEL_RENDER_ENCODE_LIBAV_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>

#include "beadreel/frame.h"

/* From FFmpeg 6.1 on, encoders may be told what has not changed. */
#if __has_include(<libavutil/video_hint.h>)
#include <libavutil/video_hint.h>
#define BEAD_AV_HINT_FUNCTIONS(X) X(av_video_hint_create_side_data) X(av_frame_remove_side_data)
#define BEAD_AV_HINT_OPTIONS      "mb_info=1" /* of the encoders that are hinted */
#else
#define BEAD_AV_HINT_FUNCTIONS(X)
#define BEAD_AV_HINT_OPTIONS ""
#endif

#define BEAD_AVUTIL_FUNCTIONS(X) \
    X(av_compare_ts)             \
    X(av_d2q)                    \
    X(av_dict_copy)              \
    X(av_dict_count)             \
    X(av_dict_free)              \
    X(av_dict_get)               \
    X(av_dict_parse_string)      \
    X(av_dict_set)               \
    X(av_frame_alloc)            \
    X(av_frame_copy)             \
    X(av_frame_copy_props)       \
    X(av_frame_free)             \
    X(av_frame_get_buffer)       \
    X(av_frame_is_writable)      \
    X(av_frame_move_ref)         \
    X(av_frame_unref)            \
    X(av_free)                   \
    X(av_log_get_level)          \
    X(av_log_set_level)          \
    X(av_malloc)                 \
    X(av_mul_q)                  \
    X(av_opt_set_int)            \
    X(av_opt_set_q)              \
    X(av_rescale_q)              \
    X(av_strerror)               \
    BEAD_AV_HINT_FUNCTIONS(X)

#define BEAD_AVCODEC_FUNCTIONS(X)      \
    X(av_new_packet)                   \
    X(av_packet_alloc)                 \
    X(av_packet_free)                  \
    X(av_packet_move_ref)              \
    X(av_packet_rescale_ts)            \
    X(av_packet_unref)                 \
    X(avcodec_alloc_context3)          \
    X(avcodec_find_decoder)            \
    X(avcodec_find_encoder_by_name)    \
    X(avcodec_free_context)            \
    X(avcodec_open2)                   \
    X(avcodec_parameters_alloc)        \
    X(avcodec_parameters_copy)         \
    X(avcodec_parameters_free)         \
    X(avcodec_parameters_from_context) \
    X(avcodec_parameters_to_context)   \
    X(avcodec_receive_frame)           \
    X(avcodec_receive_packet)          \
    X(avcodec_send_frame)              \
    X(avcodec_send_packet)

#define BEAD_AVFORMAT_FUNCTIONS(X)    \
    X(av_read_frame)                  \
    X(av_write_frame)                 \
    X(av_write_trailer)               \
    X(avformat_alloc_context)         \
    X(avformat_alloc_output_context2) \
    X(avformat_close_input)           \
    X(avformat_free_context)          \
    X(avformat_new_stream)            \
    X(avformat_open_input)            \
    X(avformat_write_header)          \
    X(avio_alloc_context)             \
    X(avio_context_free)              \
    X(avio_flush)                     \
    X(avio_seek)

#define BEAD_AV_FUNCTIONS(X)  \
    BEAD_AVUTIL_FUNCTIONS(X)  \
    BEAD_AVCODEC_FUNCTIONS(X) \
    BEAD_AVFORMAT_FUNCTIONS(X)

/* Each function by its own name. */
struct bead_av {
#define BEAD_AV_MEMBER(name) __typeof__(name) *name;
    BEAD_AV_FUNCTIONS(BEAD_AV_MEMBER)
#undef BEAD_AV_MEMBER
};

/* Errors: UNSUPPORTED (a library, of the version that this program was built with, or a function is missing). */
BEAD_CHECK enum bead_error bead_av_open(struct bead_av *av, struct bead_message *msg);
/* libav's log belongs to the process, not to this library: errors go into messages instead. */
void bead_av_silence(const struct bead_av *av);
/* "key=value key=value ..." Returns libav's number of an error. */
int bead_av_options(const struct bead_av *av, const char *text, AVDictionary **options);
/* Tell the encoder that only `changes` of the picture differ from the one before; NULL: all may. Nothing happens where FFmpeg has
 * no such hints. Returns 0 or libav's negative number of an error. */
int bead_av_hint(const struct bead_av *av, AVFrame *picture, const struct bead_changes *changes);

#endif
