/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the times of frames and samples, by which the sinks count frames. */
#include "render/movie/film.h"

#include <math.h>
#include <stdio.h>

#include "render/encode/movie_private.h"
#include "render/view/held.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/view_kinds.h"

static const double most_frames = 1e7, most_samples = 1e9;
/* 1/s: enough to judge a motion; at 60 frames a second this halves the cost of drawing. */
static const double draft_pictures = 30;

/* Plans build no chains longer than this: 64 MB. Nobody follows a wave along them bead by bead. */
static const size_t most_followed = 1000000;

/* The duration, if the scene gives none. A stage shows about 16 beads: a wave that passes no more than half as many in a second
 * stays in sight for two. A little less than that, because the passage of dimers is estimated too long, with the heavier bead.
 * `pace` is empirical: at 7 the demo's waves pass 8.4 contacts in a second; chains of more unlike beads may still be faster.
 * Smaller for stages without axes, and for four chains, where fewer and larger beads are in view. */
static const double usual_duration = 10, longest_duration = 30, pace = 6.5, bare_pace = 9.0 / 16, grid_pace = 11.0 / 16;
/* Time of a solitary wave from contact to contact, in sqrt(m/K): sqrt(3/2) sqrt(5)/2 with K at its largest compression (Nesterenko
 * 1983), where a contact has about 0.3 of the energy and K 0.3^(1/5) of the value that bead_chain_passage uses. */
static const double passage_time = 1.54;

bool bead_film_looks_at_beads(const struct bead_output *output, const struct bead_run_context *context)
{
    bool acts = isnan(output->movie.duration) && bead_views_any(&output->views, BEAD_ACTS);
    for (size_t c = 0; c < context->chain_count; c++)
        acts = acts && bead_chain_contacts(context->chains[c]) <= most_followed;
    return acts || output->shown.theory;
}

static double find_duration(const struct bead_film *film, const double time[2])
{
    double fastest = 0; /* contacts per second of the motion */
    if (!isnan(film->output->movie.duration))
        return film->output->movie.duration;
    const bool looks = bead_film_looks_at_beads(film->output, &film->context);
    for (size_t i = 0; looks && i < film->context.chain_count; i++) {
        const struct bead_chain *chain = film->context.chains[i];
        double passage = passage_time * bead_chain_passage(chain, bead_chain_energy(chain));
        fastest = fmax(fastest, passage > 0 ? (double)bead_chain_contacts(chain) / passage : 0);
    }
    const double part = !film->output->views.axes ? bare_pace : film->context.chain_count == 4 ? grid_pace : 1;
    double wanted = ceil(fastest * (time[1] - time[0]) / (pace * part));
    return fmin(longest_duration, fmax(usual_duration, isfinite(wanted) ? wanted : 0));
}

static enum bead_error choose_frames(struct bead_film *film, struct bead_message *msg)
{
    const struct bead_output *o = film->output;
    const struct bead_run_context *context = &film->context;
    struct bead_movie_times *t = &film->times;
    t->time[0] = isnan(o->shown.time[0]) ? fmax(0, context->native.every > 0 ? context->native.start : 0) : o->shown.time[0];
    t->time[1] = isnan(o->shown.time[1]) ? context->end : fmin(o->shown.time[1], context->end);
    const double duration = find_duration(film, t->time);
    bead_film_clock_make(&o->movie, t->time, duration, &t->film);
    double lasting = t->film.count ? bead_film_length(&t->film) : duration, frames = round(lasting * o->movie.fps);
    if (!(t->time[1] > t->time[0]) || !isfinite(t->time[1]))
        return bead_output_wrong(o, msg, "time: a movie needs some time to show, within the run");
    if (!(frames >= 2 && frames <= most_frames))
        return bead_output_wrong(
            o, msg, "duration: a movie has 2 to 10 million frames (duration, or what `speed` and pauses make of it, times fps)");
    t->card = o->movie.card.lasting > 0 ? (size_t)fmax(1, round(o->movie.card.lasting * o->movie.fps)) : 0;
    t->frames = t->card + (size_t)frames;
    t->step = (t->time[1] - t->time[0]) / (frames - 1);
    if (t->film.count) {
        double factors[2];
        bead_film_factors(&t->film, factors);
        t->step = factors[0] * lasting / (frames - 1);
    }
    const struct bead_codec *codec = bead_codec_find(o->path, false);
    const size_t least = codec ? bead_codec_group(codec, o->movie.fps) : 1; /* other frames are not in the file */
    const double wanted = o->movie.quality == BEAD_QUALITY_DRAFT ? o->movie.fps / draft_pictures : 1;
    t->group = least * (size_t)fmax(1, ceil(wanted / (double)least - 1e-6));
    return BEAD_OK;
}

/* Are frames so far apart that impacts of this chain fall between them? A wave is in some frame, unless it passes the whole chain
 * between two frames, or its beads cross gaps for longer than they push. */
static bool misses_impacts(const struct bead_film *film, const struct bead_chain *chain)
{
    if (!bead_held_is_needed(chain, film->fields, film->times.step, film->context.resolution))
        return false;
    const double flight = bead_chain_flight(chain), pushing = bead_chain_passage(chain, bead_chain_energy(chain)) - flight;
    return fmax(film->times.step, flight) > passage_time * pushing;
}

static bool holds(const struct bead_film *film)
{
    bool any = false;
    for (size_t i = 0; i < film->context.chain_count; i++)
        any = any || misses_impacts(film, film->context.chains[i]);
    return any;
}

/* Samples at the times of the strobe, between which frames blend; else at the frames, or k times as often for views that average
 * over time, for impacts and for sound. Replayed trajectories keep their own times; frames between two samples blend them. */
static enum bead_error times_choose_grid(struct bead_film *film, struct bead_message *msg)
{
    const struct bead_output *o = film->output;
    const struct bead_run_context *context = &film->context;
    struct bead_movie_times *t = &film->times;
    const struct bead_grid *native = &context->native;
    const bool held = holds(film);
    if (native->every > 0) {
        double first = fmax(0, floor((t->time[0] - native->start) / native->every + 1e-6));
        double beyond = ceil((t->time[1] - native->start) / native->every - 1e-6);
        t->grid = (struct bead_grid){.start = native->start + first * native->every,
                                     .every = native->every,
                                     .end = fmin(native->end, native->start + beyond * native->every)};
    } else if (o->movie.strobe > 0) {
        t->grid =
            (struct bead_grid){.start = t->time[0],
                               .every = o->movie.strobe,
                               .end = t->time[0] + ceil((t->time[1] - t->time[0]) / o->movie.strobe - 1e-9) * o->movie.strobe};
        t->grid.end = fmin(t->grid.end, context->end);
    } else {
        const bool all = bead_composer_averages(o) || o->movie.sound.of != BEAD_SOUND_OFF;
        const double spacing = all ? context->resolution : held ? bead_held_spacing(context->resolution) : 0;
        const double finer = spacing > 0 ? ceil(t->step / spacing - 1e-9) : 1;
        t->grid = (struct bead_grid){.start = t->time[0], .every = t->step / fmax(1, finer), .end = t->time[1]};
    }
    t->held = held && t->grid.every < t->step * (1 - 1e-9);
    double samples = (t->grid.end - t->grid.start) / t->grid.every;
    if (!(samples <= most_samples))
        return bead_output_wrong(o, msg, "duration: a movie of so much motion needs too many samples; show less time");
    return bead_grid_count(&t->grid) > 0 ? BEAD_OK : bead_output_wrong(o, msg, "time: there are no samples from then");
}

enum bead_error bead_movie_times_choose(struct bead_film *film, struct bead_message *msg)
{
    BEAD_TRY(choose_frames(film, msg));
    return times_choose_grid(film, msg);
}

double bead_movie_time(const struct bead_movie_times *t, double index)
{
    double within = index - (double)t->card, last = (double)(t->frames - t->card - 1);
    if (within <= 0)
        return t->time[0];
    if (within >= last)
        return t->time[1];
    return t->film.count ? bead_film_motion(&t->film, bead_film_length(&t->film) * within / last) : t->time[0] + within * t->step;
}

double bead_movie_film_time(const struct bead_movie_times *t, double motion, double fps)
{
    double within = fmax(0, motion - t->time[0]), last = (double)(t->frames - t->card - 1);
    double frame =
        t->film.count ? last * bead_film_time(&t->film, t->time[0] + within) / bead_film_length(&t->film) : within / t->step;
    return ((double)t->card + frame) / fps;
}

bool bead_movie_draws(const struct bead_movie_times *t, size_t index)
{
    return index < t->card || index + 1 == t->frames || (index - t->card) % t->group == 0;
}

size_t bead_movie_pictures(const struct bead_movie_times *t)
{
    size_t motion = t->frames - t->card - 1; /* except the last */
    return t->card + (motion + t->group - 1) / t->group + 1;
}

void bead_movie_count_words(const struct bead_film *film, char *text, size_t size)
{
    const struct bead_movie_times *t = &film->times;
    const struct bead_codec *codec = bead_codec_find(film->output->path, false);
    size_t group = bead_codec_group(codec, film->output->movie.fps);
    if (group > 1 && group >= t->group)
        snprintf(text, size, "%zu frames (%zu of them in the file: %s has at most %d a second)", t->frames,
                 (t->frames + group - 1) / group, codec->info.extension, codec->most_fps);
    else if (t->group > 1)
        snprintf(text, size, "%zu frames (%zu of them drawn)", t->frames, bead_movie_pictures(t));
    else
        snprintf(text, size, "%zu frames", t->frames);
}

double bead_movie_stop_time(const struct bead_movie_times *t, double motion, double fps)
{
    double frame = ceil(fps * bead_movie_film_time(t, motion, fps) - 1e-6);
    return fmin(frame, (double)(t->frames - 1)) / fps;
}
