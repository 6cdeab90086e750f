/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses when frames and samples are. The sink counts frames by it. */
#include "render/movie/movie_times.h"

#include <math.h>
#include <stdio.h>

#include "render/encode/movie_private.h"
#include "render/movie/composer.h"

static const double most_frames = 1e7, most_samples = 1e9;
/* 1/s: enough to judge a motion. Drawing every second frame of 60 per second halves the cost. */
static const double draft_pictures = 30;

static enum bead_error wrong(const struct bead_output *o, const struct bead_run_context *context, const char *what,
                             struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s", context->scene->file, o->place.line, o->place.column, what);
}

static enum bead_error choose_frames(const struct bead_output *o, const struct bead_run_context *context,
                                     struct bead_movie_times *t, struct bead_message *msg)
{
    t->time[0] = isnan(o->shown.time[0]) ? fmax(0, context->native.every > 0 ? context->native.start : 0) : o->shown.time[0];
    t->time[1] = isnan(o->shown.time[1]) ? context->end : fmin(o->shown.time[1], context->end);
    bead_film_clock_make(&o->movie, t->time, &t->film);
    double lasting = t->film.count ? bead_film_length(&t->film) : o->movie.duration, frames = round(lasting * o->movie.fps);
    if (!(t->time[1] > t->time[0]) || !isfinite(t->time[1]))
        return wrong(o, context, "time: a movie needs some time to show, within the run", msg);
    if (!(frames >= 2 && frames <= most_frames))
        return wrong(o, context,
                     "duration: a movie has 2 to 10 million frames (duration, or what `speed` and pauses make of it, times fps)",
                     msg);
    t->card = o->movie.card.lasting > 0 ? (size_t)fmax(1, round(o->movie.card.lasting * o->movie.fps)) : 0;
    t->frames = t->card + (size_t)frames;
    t->step = (t->time[1] - t->time[0]) / (frames - 1);
    if (t->film.count) {
        double factors[2];
        bead_film_factors(&t->film, factors);
        t->step = factors[0] * lasting / (frames - 1);
    }
    t->group = o->movie.quality == BEAD_QUALITY_DRAFT ? (size_t)fmax(1, ceil(o->movie.fps / draft_pictures - 1e-6)) : 1;
    return BEAD_OK;
}

/* Samples at the frames, or k times as often if views average over time or there is sound. Replayed trajectories keep their own
 * times, and frames between two samples blend them. */
static enum bead_error times_choose_grid(const struct bead_output *o, const struct bead_run_context *context,
                                         struct bead_movie_times *t, struct bead_message *msg)
{
    const struct bead_grid *native = &context->native;
    if (native->every > 0) {
        double first = fmax(0, floor((t->time[0] - native->start) / native->every + 1e-6));
        double beyond = ceil((t->time[1] - native->start) / native->every - 1e-6);
        t->grid = (struct bead_grid){native->start + first * native->every, native->every,
                                     fmin(native->end, native->start + beyond * native->every)};
    } else {
        double finer = (bead_composer_averages(o) || o->movie.sound.of != BEAD_SOUND_OFF) && context->resolution > 0
                           ? ceil(t->step / context->resolution - 1e-9)
                           : 1;
        t->grid = (struct bead_grid){t->time[0], t->step / fmax(1, finer), t->time[1]};
    }
    double samples = (t->grid.end - t->grid.start) / t->grid.every;
    if (!(samples <= most_samples))
        return wrong(o, context, "duration: a movie of so much motion needs too many samples; show less time", msg);
    return bead_grid_count(&t->grid) > 0 ? BEAD_OK : wrong(o, context, "time: there are no samples from then", msg);
}

enum bead_error bead_movie_times_choose(const struct bead_output *output, const struct bead_run_context *context,
                                        struct bead_movie_times *times, struct bead_message *msg)
{
    enum bead_error err = choose_frames(output, context, times, msg);
    return err ? err : times_choose_grid(output, context, times, msg);
}

double bead_movie_moment(const struct bead_movie_times *t, double index)
{
    double within = index - (double)t->card, last = (double)(t->frames - t->card - 1);
    if (within <= 0)
        return t->time[0];
    if (within >= last)
        return t->time[1];
    return t->film.count ? bead_film_motion(&t->film, bead_film_length(&t->film) * within / last) : t->time[0] + within * t->step;
}

double bead_movie_time(const struct bead_movie_times *t, size_t index)
{
    return bead_movie_moment(t, (double)index);
}

double bead_movie_film_time(const struct bead_movie_times *t, double motion, double fps)
{
    double within = fmax(0, motion - t->time[0]);
    double film = t->film.count ? bead_film_time(&t->film, t->time[0] + within) : within / t->step / fps;
    return (double)t->card / fps + film;
}

bool bead_movie_draws(const struct bead_movie_times *t, size_t index)
{
    return index < t->card || index + 1 == t->frames || (index - t->card) % t->group == 0;
}

size_t bead_movie_pictures(const struct bead_movie_times *t)
{
    size_t motion = t->frames - t->card - 1; /* but the last */
    return t->card + (motion + t->group - 1) / t->group + 1;
}

void bead_movie_count_words(const struct bead_movie_times *t, const struct bead_output *output, char *text, size_t size)
{
    const struct bead_codec *codec = bead_codec_find(output->path);
    size_t group = bead_codec_group(codec, output->movie.fps);
    if (group > 1 && group >= t->group)
        snprintf(text, size, "%zu frames (%zu of them in the file: %s has at most %d a second)", t->frames,
                 (t->frames + group - 1) / group, codec->info.extension, codec->most_fps);
    else if (t->group > 1)
        snprintf(text, size, "%zu frames (%zu of them drawn)", t->frames, bead_movie_pictures(t));
    else
        snprintf(text, size, "%zu frames", t->frames);
}
