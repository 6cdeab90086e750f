/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of FFmpeg's libraries that can fail do so one by one, each function's first two and its last, in films of all kinds: the
 * film is refused with the name of the file and the library's reason, or for lack of memory, and nothing is left of it.
 * bead_library_load is this program's (-Wl,--wrap): it puts functions that fail in front of the library's. */
#include "movies.h"

#include <errno.h>

#include "beadreel/movie.h"
#include "render/encode/libav.h"
#include "render/encode/movie_private.h"

enum { CALLS_MOST = 400 };
static const char reason[] = "No space left on device";
static struct {
    int calls, failing; /* so far; the number of the one that fails */
    const char *name;   /* of the function that has failed */
    const char *called[CALLS_MOST];
} now;

static bool fails(const char *name)
{
    assert_true(now.calls < CALLS_MOST);
    now.called[now.calls] = name;
    const bool failed = now.calls++ == now.failing;
    now.name = failed ? name : now.name;
    return failed;
}

#define FAILS(function, given, taken)                                      \
    static int(*next_##function) given;                                    \
    static int failing_##function given                                    \
    {                                                                      \
        return fails(#function) ? AVERROR(ENOSPC) : next_##function taken; \
    }
FAILS(avcodec_open2, (AVCodecContext * c, const AVCodec *type, AVDictionary **options), (c, type, options))
FAILS(avcodec_parameters_copy, (AVCodecParameters * to, const AVCodecParameters *from), (to, from))
FAILS(avcodec_parameters_from_context, (AVCodecParameters * to, const AVCodecContext *from), (to, from))
FAILS(avcodec_parameters_to_context, (AVCodecContext * to, const AVCodecParameters *from), (to, from))
FAILS(avcodec_send_frame, (AVCodecContext * c, const AVFrame *frame), (c, frame))
FAILS(avcodec_receive_frame, (AVCodecContext * c, AVFrame *frame), (c, frame))
FAILS(avcodec_send_packet, (AVCodecContext * c, const AVPacket *packet), (c, packet))
FAILS(avcodec_receive_packet, (AVCodecContext * c, AVPacket *packet), (c, packet))
FAILS(avformat_alloc_output_context2, (AVFormatContext * *format, const AVOutputFormat *type, const char *name, const char *file),
      (format, type, name, file))
FAILS(avformat_write_header, (AVFormatContext * format, AVDictionary **options), (format, options))
FAILS(av_write_frame, (AVFormatContext * format, AVPacket *packet), (format, packet))
FAILS(av_read_frame, (AVFormatContext * format, AVPacket *packet), (format, packet))
FAILS(av_dict_set, (AVDictionary * *options, const char *key, const char *value, int flags), (options, key, value, flags))
FAILS(av_dict_copy, (AVDictionary * *to, const AVDictionary *from, int flags), (to, from, flags))
FAILS(av_dict_parse_string, (AVDictionary * *to, const char *text, const char *is, const char *separates, int flags),
      (to, text, is, separates, flags))
FAILS(av_opt_set_q, (void *object, const char *name, AVRational value, int flags), (object, name, value, flags))
FAILS(av_opt_set_int, (void *object, const char *name, int64_t value, int flags), (object, name, value, flags))
FAILS(av_frame_get_buffer, (AVFrame * frame, int align), (frame, align))

/* The muxer's memory is freed with the trailer only. */
static int (*next_av_write_trailer)(AVFormatContext *format);
static int failing_av_write_trailer(AVFormatContext *format)
{
    const int code = next_av_write_trailer(format);
    return fails("av_write_trailer") ? AVERROR(ENOSPC) : code;
}

/* It frees the format where it fails. */
static int (*next_avformat_open_input)(AVFormatContext **format, const char *file, const AVInputFormat *type,
                                       AVDictionary **options);
static void (*next_avformat_free_context)(AVFormatContext *format);
static int failing_avformat_open_input(AVFormatContext **format, const char *file, const AVInputFormat *type,
                                       AVDictionary **options)
{
    if (!fails("avformat_open_input"))
        return next_avformat_open_input(format, file, type, options);
    next_avformat_free_context(*format);
    *format = NULL;
    return AVERROR(ENOSPC);
}

#define ROW(function)                                                    \
    {                                                                    \
#function, (void *)failing_##function, (void **)&next_##function \
    }
static const struct {
    const char *name;
    void *failing, **next;
} functions[] = {ROW(avcodec_open2),
                 ROW(avcodec_parameters_copy),
                 ROW(avcodec_parameters_from_context),
                 ROW(avcodec_parameters_to_context),
                 ROW(avcodec_send_frame),
                 ROW(avcodec_receive_frame),
                 ROW(avcodec_send_packet),
                 ROW(avcodec_receive_packet),
                 ROW(avformat_alloc_output_context2),
                 ROW(avformat_write_header),
                 ROW(avformat_open_input),
                 ROW(av_write_frame),
                 ROW(av_write_trailer),
                 ROW(av_read_frame),
                 ROW(av_dict_set),
                 ROW(av_dict_copy),
                 ROW(av_dict_parse_string),
                 ROW(av_opt_set_q),
                 ROW(av_opt_set_int),
                 ROW(av_frame_get_buffer)};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

enum bead_error __real_bead_library_load(const struct bead_library_info *libraries, const char *names, void **table,
                                         struct bead_message *msg);
enum bead_error __wrap_bead_library_load(const struct bead_library_info *libraries, const char *names, void **table,
                                         struct bead_message *msg);

enum bead_error __wrap_bead_library_load(const struct bead_library_info *libraries, const char *names, void **table,
                                         struct bead_message *msg)
{
    const bool open = *table != NULL;
    const enum bead_error err = __real_bead_library_load(libraries, names, table, msg);
    size_t found = 0, at = 0;
    for (const char *name = names; !open && !err && *name; name += strlen(name) + 1, at++) {
        void **entry = (void **)*table + at;
        if (strcmp(name, "avformat_free_context") == 0)
            *(void **)&next_avformat_free_context = *entry;
        for (size_t i = 0; i < FUNCTIONS; i++) {
            if (strcmp(name, functions[i].name) != 0)
                continue;
            *functions[i].next = *entry;
            *entry = functions[i].failing;
            found++;
        }
    }
    assert_true(open || err || found == FUNCTIONS);
    return err;
}

/* ---- films with all that their file can hold ---- */

enum { PICTURES = 2, SAMPLES = 1200 };
static const struct kind {
    const char *name;
    enum bead_quality quality;
    bool parts; /* chapters, subtitles, sound; a cover in mp4 */
} kinds[] = {{"a.mp4", BEAD_QUALITY_DRAFT, true},
             {"a.mkv", BEAD_QUALITY_DRAFT, true},
             {"a.gif", BEAD_QUALITY_STANDARD, false},
             {"a.apng", BEAD_QUALITY_STANDARD, false}};

static enum bead_error fill(struct bead_movie *movie, const struct kind *kind, struct bead_message *msg)
{
    static const uint8_t cover[] = "no PNG file";
    static const float silence[SAMPLES];
    struct bead_frame frame;
    enum bead_error err = BEAD_OK;
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    for (int i = 0; !err && i < PICTURES; i++) {
        draw(&frame, i);
        err = bead_movie_add(movie, &frame, NULL, msg);
    }
    bead_frame_free(&frame);
    if (!err && kind->parts)
        err = bead_movie_sound(movie, silence, SAMPLES, msg);
    if (!err && strstr(kind->name, "mp4"))
        err = bead_movie_cover(movie, cover, sizeof cover, msg);
    return err ? err : bead_movie_describe(movie, "A disc moves.", msg);
}

static enum bead_error make(const char *path, const struct kind *kind, struct bead_message *msg)
{
    static const struct bead_movie_chapter chapters[] = {{0, "One"}, {0.02, "Two"}};
    static const struct bead_movie_subtitle subtitles[] = {{0, 0.01, "one"}, {0.02, 0.03, "two"}};
    struct bead_movie_settings wanted = settings(kind->quality);
    struct bead_movie *movie;
    wanted.title = "A film";
    wanted.comment = "a scene";
    wanted.cover = strstr(kind->name, "mp4");
    if (kind->parts) {
        wanted.channels = 1;
        wanted.chapters = chapters, wanted.chapter_count = 2, wanted.length = 0.04;
        wanted.subtitles = subtitles, wanted.subtitle_count = 2;
    }
    BEAD_TRY(bead_movie_open(path, &wanted, &movie, msg));
    enum bead_error err = fill(movie, kind, msg);
    if (!err)
        return bead_movie_close(movie, NULL, msg);
    bead_movie_abort(movie);
    return err;
}

/* Of the calls of one function, is this one of the first two, or the last? */
static bool is_tried(const char *const called[], int calls, int call)
{
    int before = 0, after = 0;
    for (int i = 0; i < calls; i++) {
        before += i < call && called[i] == called[call];
        after += i > call && called[i] == called[call];
    }
    return before < 2 || after == 0;
}

static void fail_once(const struct kind *kind, int call)
{
    const char *path = place(kind->name);
    struct bead_message msg = {""};
    now.calls = 0, now.failing = call, now.name = NULL;
    const enum bead_error err = make(path, kind, &msg);
    const bool memory = now.name && strcmp(now.name, "av_frame_get_buffer") == 0 && err == BEAD_ERROR_MEMORY;
    if (!now.name || !(memory || err == BEAD_ERROR_CODEC) || !strstr(msg.text, memory ? "out of memory" : reason) ||
        !strstr(msg.text, path) || left_behind(path))
        fail_msg("%s, call %d, %s: error %d, '%s'%s", kind->name, call, now.name, (int)err, msg.text,
                 left_behind(path) ? ", and a file is left" : "");
}

static void each_call_fails_once(void **)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const char *called[CALLS_MOST];
        struct bead_message msg = {""};
        now.calls = 0, now.failing = -1;
        if (make(place(kinds[k].name), &kinds[k], &msg))
            fail_msg("%s", msg.text);
        assert_int_equal(unlink(place(kinds[k].name)), 0);
        const int calls = now.calls;
        memcpy(called, now.called, sizeof called);
        assert_true(calls > 20);
        for (int i = 0; i < calls; i++) {
            if (is_tried(called, calls, i))
                fail_once(&kinds[k], i);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_call_fails_once)};
    return cmocka_run_group_tests_name("failing codecs", tests, make_directory, remove_directory);
}
