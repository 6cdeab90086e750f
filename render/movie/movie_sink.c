/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies as outputs of scenes. Three threads work at the same time: the run delivers samples, a second thread draws frames from
 * copies of them, a third encodes the frames. Frames do not depend on which is faster. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/movie.h"
#include "render/draw/axis.h"
#include "render/encode/movie_internal.h"
#include "render/encode/movie_private.h"
#include "render/movie/film.h"
#include "render/movie/ring_buffer.h"
#include "render/paint/canvas.h"
#include "render/view/tale.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/stop.h"

/* Frames between drawing and encoding; bytes of samples between the run and drawing. */
enum { FRAME_SLOTS = 4, LEAST_SAMPLES = 2, MOST_SAMPLES = 1024 };
static const size_t sample_bytes = 32u << 20;

/* A sample on its way to the drawing thread; its numbers follow in memory, field by field. */
struct snapshot {
    struct bead_sample sample;
    size_t filled; /* values from here on are at rest */
    size_t owner;  /* chain of the numbers in here, + 1; 0: never used */
};

/* A frame on its way to the encoder. */
struct parcel {
    size_t buffer;
    struct bead_changes changes;
};

struct bead_sink {
    struct bead_film film;
    char *path, *poster_path, *slides_path; /* NULL: none */
    struct bead_movie_notes notes;
    struct bead_film_sound *sound; /* NULL: none */
    struct bead_tale *tale;
    uint64_t poster_bytes, slides_bytes;
    char why[192], makers[160];

    struct bead_composer *composer;
    struct bead_movie *movie;
    struct bead_poster poster; /* where there is a path */
    struct bead_ring_buffer *drawing, *encoding;
    bool ahead; /* frames are converted into the encoder's own slots, else copied into buffers */
    struct bead_frame buffer[FRAME_SLOTS];
    struct bead_changes missing[FRAME_SLOTS]; /* what each slot lacks */
    uint64_t bytes;

    /* The drawing thread's. */
    size_t drawn;  /* frames */
    size_t filled; /* number of frames sent that differ from the one before; buffers alternate */
    double seen;   /* s: time that all chains have reached; NaN: none */
};

static struct bead_movie_settings movie_settings_of(const struct bead_sink *s)
{
    return (struct bead_movie_settings){.size = sizeof(struct bead_movie_settings),
                                        .width = s->film.width,
                                        .height = s->film.height,
                                        .fps = s->film.output->movie.fps,
                                        .quality = s->film.output->movie.quality,
                                        .codec = s->film.output->movie.codec,
                                        .channels = bead_film_sound_channels(s->sound),
                                        .alpha = s->film.output->paper.background == BEAD_BACKGROUND_NONE,
                                        .title = s->film.context.scene->title[0] ? s->film.context.scene->title : NULL,
                                        .comment = s->notes.comment,
                                        .chapters = s->notes.chapters,
                                        .chapter_count = s->notes.chapter_count,
                                        .subtitles = s->notes.subtitles,
                                        .subtitle_count = s->notes.subtitle_count,
                                        .length = (double)s->film.times.frames / s->film.output->movie.fps,
                                        .cover = s->film.output->movie.poster && s->film.output->movie.poster[0]};
}

static void movie_describe(struct bead_sink *s)
{
    char every[48], frames[96];
    bead_quantity(s->film.times.step, bead_chain_time_unit(s->film.context.chains[0]), 3, every, sizeof every);
    bead_movie_count_words(&s->film, frames, sizeof frames);
    snprintf(s->why, sizeof s->why, "%s of %d x %d pixels, every %s", frames, s->film.width, s->film.height, every);
}

static void movie_destroy(struct bead_sink *s)
{
    if (!s)
        return;
    bead_ring_buffer_destroy(s->drawing);
    bead_ring_buffer_destroy(s->encoding);
    bead_movie_abort(s->movie);
    bead_frame_free(&s->poster.frame);
    bead_composer_destroy(s->composer);
    bead_film_free(&s->film);
    for (int i = 0; i < FRAME_SLOTS; i++)
        bead_frame_free(&s->buffer[i]);
    free(s->path);
    bead_movie_notes_free(&s->notes);
    bead_film_sound_destroy(s->sound);
    bead_tale_destroy(s->tale);
    free(s->poster_path);
    free(s->slides_path);
    free(s);
}

static enum bead_error movie_prepare(struct bead_sink *s, const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_message *msg)
{
    BEAD_TRY(bead_film_prepare(output, context, &s->film, msg));
    if (output->movie.poster && output->movie.poster[0])
        BEAD_TRY(bead_file_join(context->directory, output->movie.poster, &s->poster_path, msg));
    if (output->movie.slides && output->movie.slides[0])
        BEAD_TRY(bead_file_join(context->directory, output->movie.slides, &s->slides_path, msg));
    BEAD_TRY(bead_file_join(context->directory, output->path, &s->path, msg));
    BEAD_TRY(bead_movie_notes_make(&s->film, &s->notes, msg));
    BEAD_TRY(bead_film_sound_create(&s->film, &s->sound, msg));
    BEAD_TRY(bead_tale_create(context->chains, context->chain_count, output->shown.field, output->shown.beads, &s->tale, msg));
    const struct bead_movie_settings settings = movie_settings_of(s);
    struct bead_message why = {""};
    const enum bead_error err = bead_movie_check(output->path, &settings, &why);
    const size_t named = strlen(output->path) + strlen(": size"); /* "a.mp4: size 641 x 361 is odd" */
    if (err == BEAD_ERROR_SCENE && strlen(why.text) > named && strncmp(why.text + named - 4, "size", 4) == 0)
        return bead_output_wrong(output, msg, "size:%s", why.text + named);
    if (err)
        return bead_fail(msg, err, "%s", why.text);
    movie_describe(s);
    return BEAD_OK;
}

static enum bead_error movie_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **sink, struct bead_message *msg)
{
    BEAD_TRY(bead_new(sink, 1, msg, "a movie"));
    (*sink)->seen = NAN;
    return movie_prepare(*sink, output, context, msg);
}

static void movie_needs(const struct bead_sink *s, struct bead_needs *needs)
{
    bead_film_needs(&s->film, s->why, needs);
    if (s->poster_path)
        needs->fields |= BEAD_FIELD_BIT(s->film.output->shown.field); /* a stage alone shows other fields */
    bead_film_sound_needs(s->sound, needs);
}

/* Numbers of one field in a snapshot. */
static size_t field_room(const struct bead_sink *s)
{
    return s->film.last_bead + 1;
}

/* Encoding thread. */
static enum bead_error movie_encode(void *context, void *slot, int, struct bead_message *msg)
{
    struct bead_sink *s = context;
    struct parcel *parcel = slot;
    if (!parcel)
        return BEAD_OK;
    return s->ahead ? bead_movie_add_slot(s->movie, parcel->buffer, &parcel->changes, msg)
                    : bead_movie_add(s->movie, &s->buffer[parcel->buffer], &parcel->changes, msg);
}

/* Drawing thread: brings a free buffer up to date and sends it. */
static enum bead_error send_frame(struct bead_sink *s, const struct bead_changes *changes, struct bead_message *msg)
{
    struct parcel *parcel = bead_ring_buffer_slot(s->encoding);
    const struct bead_frame *frame = bead_composer_frame(s->composer);
    if (!parcel) /* finish_pipes reports why */
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: encoding has failed", s->film.output->path);
    parcel->changes = *changes;
    if (changes->count == 0 && s->filled > 0) { /* the encoder already has it */
        parcel->buffer = (s->filled - 1) % FRAME_SLOTS;
        bead_ring_buffer_submit(s->encoding);
        return BEAD_OK;
    }
    parcel->buffer = s->filled++ % FRAME_SLOTS;
    for (int b = 0; b < FRAME_SLOTS; b++) {
        for (size_t i = 0; i < changes->count; i++)
            bead_changes_add(&s->missing[b], changes->rect[i]);
    }
    struct bead_changes *missing = &s->missing[parcel->buffer];
    if (s->ahead)
        BEAD_TRY(bead_movie_convert(s->movie, parcel->buffer, frame, missing, msg));
    for (size_t i = 0; !s->ahead && i < missing->count; i++)
        bead_frame_copy(&s->buffer[parcel->buffer], frame, missing->rect[i]);
    missing->count = 0;
    bead_ring_buffer_submit(s->encoding);
    return BEAD_OK;
}

static enum bead_error movie_draw_frame(struct bead_sink *s, struct bead_changes *changes, struct bead_message *msg)
{
    double time = bead_movie_time(&s->film.times, (double)s->drawn);
    if (s->drawn < s->film.times.card)
        return bead_composer_card(s->composer, changes, msg);
    enum bead_error err = bead_composer_draw(s->composer, time, changes, msg);
    return !err && s->poster_path ? bead_poster_offer(&s->poster, s->composer, time, msg) : err;
}

/* Draws frames up to `until`. */
static enum bead_error draw_frames(struct bead_sink *s, double until, struct bead_message *msg)
{
    while (s->drawn < s->film.times.frames && bead_movie_time(&s->film.times, (double)s->drawn) <= until) {
        struct bead_changes changes = {0};
        if (bead_stop_is_asked(s->film.context.stop)) /* pauses and cards are many frames from one sample */
            return bead_fail(msg, BEAD_ERROR_STOPPED, "%s: stopped after %zu frames", s->film.output->path, s->drawn);
        BEAD_TRY(bead_movie_draws(&s->film.times, s->drawn) ? movie_draw_frame(s, &changes, msg) : BEAD_OK);
        BEAD_TRY(send_frame(s, &changes, msg));
        s->drawn++;
    }
    return BEAD_OK;
}

static enum bead_error take_sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    enum bead_error err = bead_composer_feed(s->composer, sample, msg);
    if (err || sample->chain + 1 < s->film.context.chain_count)
        return err;
    s->seen = sample->time;
    return draw_frames(s, sample->time + 1e-6 * s->film.times.grid.every, msg);
}

/* Drawing thread. */
static enum bead_error movie_draw(void *context, void *slot, int last, struct bead_message *msg)
{
    struct bead_sink *s = context;
    if (slot)
        return take_sample(s, &((struct snapshot *)slot)->sample, msg);
    if (last == BEAD_RING_MORE)
        return bead_composer_open(s->composer, msg);
    /* The last sample is shown to the end of its interval; a stopped run ends the movie early. */
    enum bead_error err = BEAD_OK;
    if (last == BEAD_RING_DONE && !isnan(s->seen))
        err = draw_frames(s, s->seen + s->film.times.grid.every, msg);
    bead_composer_close(s->composer);
    return err;
}

static enum bead_error create_pipes(struct bead_sink *s, struct bead_message *msg)
{
    size_t numbers_bytes =
        (size_t)(__builtin_popcount(s->film.fields) + __builtin_popcount(s->film.comparison)) * field_room(s) * sizeof(double);
    size_t bytes = sizeof(struct snapshot) + numbers_bytes, chains = s->film.context.chain_count;
    size_t slots = sample_bytes / bytes;
    slots = slots < LEAST_SAMPLES ? LEAST_SAMPLES : slots > MOST_SAMPLES ? MOST_SAMPLES : slots;
    slots = (slots + chains - 1) / chains * chains; /* a slot always holds the same chain: less to copy */
    enum bead_error err =
        bead_ring_buffer_create(FRAME_SLOTS, sizeof(struct parcel), s->film.context.threads, movie_encode, s, &s->encoding, msg);
    return err ? err : bead_ring_buffer_create(slots, bytes, s->film.context.threads, movie_draw, s, &s->drawing, msg);
}

static enum bead_error movie_begin(struct bead_sink *s, struct bead_range range, struct bead_message *msg)
{
    BEAD_TRY(bead_film_compose(&s->film, range, s->poster_path != NULL, &s->composer, msg));
    struct bead_movie_settings settings = movie_settings_of(s);
    s->poster = bead_poster_choose(s->film.output->movie.poster_at, s->film.times.step);
    BEAD_TRY(bead_movie_open(s->path, &settings, &s->movie, msg));
    BEAD_TRY(bead_movie_reserve(s->movie, FRAME_SLOTS, &s->ahead, msg));
    for (int i = 0; !s->ahead && i < FRAME_SLOTS; i++) {
        BEAD_TRY(bead_frame_create(s->film.width, s->film.height, &s->buffer[i], msg));
        s->buffer[i].alpha = settings.alpha;
    }
    bead_canvas_prepare(s->film.context.canvas); /* before our threads start */
    return create_pipes(s, msg);
}

/* Copies moving beads, and beads at rest only once. */
static void movie_fill(const struct bead_sink *s, const struct bead_sample *sample, struct snapshot *snapshot)
{
    size_t first = s->film.output->shown.beads.first, room = field_room(s);
    size_t last = s->film.comparison && sample->comparison_active > sample->active ? sample->comparison_active : sample->active;
    size_t moving = last + 1, filled = snapshot->owner == sample->chain + 1 ? snapshot->filled : SIZE_MAX;
    double *data = (double *)(snapshot + 1);
    struct bead_sample copy = {.chain = sample->chain,
                               .index = sample->index,
                               .time = sample->time,
                               .active = sample->active,
                               .comparison_active = sample->comparison_active};
    for (unsigned i = 0; i < 2 * BEAD_FIELD_COUNT; i++) {
        unsigned f = i % BEAD_FIELD_COUNT;
        bool own = i < BEAD_FIELD_COUNT;
        const double *values = own ? sample->field[f] : sample->comparison[f];
        if (!((own ? s->film.fields : s->film.comparison) & BEAD_FIELD_BIT(f)))
            continue;
        const struct bead_chain *chain = s->film.context.chains[sample->chain];
        size_t count = bead_field_info((enum bead_field)f)->of_contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain);
        size_t end = moving > filled ? moving : filled;
        end = end < count ? end : count;
        end = end < room ? end : room;
        if (end > first)
            memcpy(data + first, values + first, (end - first) * sizeof *data);
        *(own ? &copy.field[f] : &copy.comparison[f]) = data;
        data += room;
    }
    *snapshot = (struct snapshot){.sample = copy, .filled = moving, .owner = sample->chain + 1};
}

/* Ends both threads and returns their error, if any. */
static enum bead_error finish_pipes(struct bead_sink *s, struct bead_message *msg)
{
    struct bead_message drawing = {""}, encoding = {""};
    enum bead_error drawn = bead_ring_buffer_finish(s->drawing, &drawing),
                    encoded = bead_ring_buffer_finish(s->encoding, &encoding);
    if (encoded)
        return bead_fail(msg, encoded, "%s", encoding.text);
    return drawn ? bead_fail(msg, drawn, "%s", drawing.text) : BEAD_OK;
}

static enum bead_error movie_sample(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    struct snapshot *snapshot = bead_ring_buffer_slot(s->drawing);
    if (!snapshot)
        return finish_pipes(s, msg);
    movie_fill(s, sample, snapshot);
    bead_ring_buffer_submit(s->drawing);
    bead_tale_feed(s->tale, sample);
    return s->sound ? bead_film_sound_feed(s->sound, sample, msg) : BEAD_OK;
}

static void credit(struct bead_sink *s)
{
    const char *painter = bead_composer_painter(s->composer), *encoder = bead_movie_encoder(s->movie);
    snprintf(s->makers, sizeof s->makers, "%s%s%s%s%s", *painter ? "painted by " : "", painter, *painter && *encoder ? ", " : "",
             *encoder ? "encoded by " : "", encoder);
}

/* A stopped film has no sound, and no poster, since that may be a later frame. */
static enum bead_error movie_finish(struct bead_sink *s, bool whole, struct bead_message *msg)
{
    char tale[BEAD_TALE_WORDS];
    enum bead_error err = finish_pipes(s, msg);
    if (err && (whole || err != BEAD_ERROR_STOPPED))
        return err;
    credit(s);
    if (whole && s->poster_path)
        BEAD_TRY(bead_poster_write(&s->poster, s->poster_path, s->film.context.scene, s->movie, &s->poster_bytes, msg));
    if (whole)
        BEAD_TRY(bead_film_sound_write(s->sound, s->movie, msg));
    bead_movie_notes_tell(s->tale, &s->notes);
    bead_tale_words(s->tale, tale, sizeof tale);
    BEAD_TRY(bead_movie_describe(s->movie, tale, msg));
    struct bead_movie *movie = s->movie;
    s->movie = NULL;
    err = (whole ? bead_movie_close : bead_movie_stop)(movie, &s->bytes, msg);
    return !err && whole && s->slides_path ? bead_slides_write(&s->film, s->slides_path, s->path, tale, &s->slides_bytes, msg)
                                           : err;
}

static enum bead_error movie_end(struct bead_sink *s, const struct bead_outcome *, struct bead_message *msg)
{
    return movie_finish(s, true, msg);
}

static enum bead_error movie_stop(struct bead_sink *s, const struct bead_outcome *, struct bead_message *msg)
{
    return movie_finish(s, false, msg);
}

static void movie_result(const struct bead_sink *s, uint64_t *bytes, uint64_t *items)
{
    *bytes = s->bytes;
    *items = s->drawn;
}

static const char *movie_makers(const struct bead_sink *s)
{
    return s->makers;
}

static enum bead_error movie_scout(struct bead_sink *s, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_film_scout(&s->film, sample, msg);
}

static bool movie_looks_at_beads(const struct bead_output *output, const struct bead_run_context *context)
{
    return output->movie.sound.of == BEAD_SOUND_SENSOR || bead_film_looks_at_beads(output, context);
}

static const char *movie_beside(const struct bead_sink *s, uint64_t *bytes)
{
    *bytes = s->slides_path ? s->slides_bytes : s->poster_bytes;
    return s->slides_path ? s->slides_path : s->poster_path;
}

const struct bead_sink_type bead_movie_sink = {
    .name = "movie",
    .help = "beads, profile, space-time image and sensors in motion",
    .kind = BEAD_OUTPUT_MOVIE,
    .background = true,
    .create = movie_create,
    .needs = movie_needs,
    .begin = movie_begin,
    .sample = movie_sample,
    .end = movie_end,
    .stop = movie_stop,
    .destroy = movie_destroy,
    .result = movie_result,
    .makers = movie_makers,
    .beside = movie_beside,
    .looks_at_beads = movie_looks_at_beads,
    .scout = movie_scout,
};
