/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film whose speed changes: pieces of motion between the times of its curve and the captions that make a pause. */
#include "render/movie/film_clock.h"

#include <math.h>
#include <stdlib.h>

static int rising(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The factor at a time of the motion; beyond the ends of the curve, the nearest point's. */
static double factor_at(const struct bead_movie_asked *movie, double even, double motion)
{
    const struct bead_speed *s = movie->speeds;
    size_t i = 0;
    if (movie->speed_count == 0)
        return even;
    while (i < movie->speed_count && s[i].at <= motion)
        i++;
    if (i == 0 || i == movie->speed_count)
        return s[i ? i - 1 : 0].factor;
    double part = (motion - s[i - 1].at) / (s[i].at - s[i - 1].at);
    return s[i - 1].factor * pow(s[i].factor / s[i - 1].factor, part);
}

static double pause_at(const struct bead_movie_asked *movie, double motion)
{
    for (size_t i = 0; i < movie->caption_count; i++) {
        if (movie->captions[i].at == motion && movie->captions[i].pause > 0)
            return movie->captions[i].pause;
    }
    return 0;
}

/* s of the film that a piece of motion takes, without its pause; `motion`: its length. With factors f at the beginning and f r at
 * the end, f r^(x / motion) between, it is the integral of dx over the factor. */
static double film_of(const struct bead_film_piece *p, double motion)
{
    double bend = log(p->factor[1] / p->factor[0]);
    return motion / p->factor[0] * (fabs(bend) < 1e-9 ? 1 : -expm1(-bend) / bend);
}

/* The inverse: the motion that has passed after `film` s of a piece with the length `motion`. */
static double motion_of(const struct bead_film_piece *p, double motion, double film)
{
    double bend = log(p->factor[1] / p->factor[0]);
    if (fabs(bend) < 1e-9)
        return film * p->factor[0];
    return -motion * log1p(-film * p->factor[0] * bend / motion) / bend;
}

/* s of the motion of a piece from its beginning until a time within it. */
static double film_within(const struct bead_film_piece *p, double motion, double until)
{
    struct bead_film_piece part = *p;
    part.factor[1] = p->factor[0] * pow(p->factor[1] / p->factor[0], motion > 0 ? until / motion : 0);
    return film_of(&part, until);
}

static size_t find_times(const struct bead_movie_asked *movie, const double time[2], double *times)
{
    size_t count = 0, kept = 0;
    times[count++] = time[0];
    times[count++] = time[1];
    for (size_t i = 0; i < movie->speed_count && count < BEAD_FILM_PIECES; i++)
        times[count++] = movie->speeds[i].at;
    for (size_t i = 0; i < movie->caption_count && count < BEAD_FILM_PIECES; i++)
        times[count++] = movie->captions[i].pause > 0 ? movie->captions[i].at : time[0];
    qsort(times, count, sizeof *times, rising);
    for (size_t i = 0; i < count; i++) {
        if (times[i] >= time[0] && times[i] <= time[1] && (kept == 0 || times[i] > times[kept - 1]))
            times[kept++] = times[i];
    }
    return kept;
}

void bead_film_clock_make(const struct bead_movie_asked *movie, const double time[2], double duration,
                          struct bead_film_clock *clock)
{
    double times[BEAD_FILM_PIECES + 2], even = (time[1] - time[0]) / duration;
    bool pauses = false;
    *clock = (struct bead_film_clock){.slowed = even > 0 ? 1 / even : 1};
    for (size_t i = 0; i < movie->caption_count; i++)
        pauses = pauses || movie->captions[i].pause > 0;
    if (movie->speed_count == 0 && !pauses)
        return;
    size_t count = find_times(movie, time, times);
    double film = 0;
    for (size_t i = 0; i < count; i++) {
        double next = i + 1 < count ? times[i + 1] : times[i];
        struct bead_film_piece *p = &clock->piece[i];
        *p = (struct bead_film_piece){.motion = times[i], .film = film, .pause = pause_at(movie, times[i])};
        p->factor[0] = factor_at(movie, even, times[i]);
        p->factor[1] = factor_at(movie, even, next);
        film += p->pause + film_of(p, next - times[i]);
    }
    clock->count = count - 1;
    clock->slowed = bead_film_length(clock) / (time[1] - time[0]);
}

double bead_film_length(const struct bead_film_clock *clock)
{
    const struct bead_film_piece *end = &clock->piece[clock->count];
    return end->film + end->pause;
}

double bead_film_motion(const struct bead_film_clock *clock, double film)
{
    size_t i = 0;
    while (i + 1 < clock->count && clock->piece[i + 1].film <= film)
        i++;
    const struct bead_film_piece *p = &clock->piece[i];
    double motion = p[1].motion - p->motion, within = fmin(film, p[1].film) - p->film - p->pause;
    return within <= 0 ? p->motion : fmin(p[1].motion, p->motion + motion_of(p, motion, within));
}

/* The piece that shows a moment of the motion. */
static const struct bead_film_piece *showing(const struct bead_film_clock *clock, double motion)
{
    size_t i = 0;
    while (i + 1 < clock->count && clock->piece[i + 1].motion <= motion)
        i++;
    return &clock->piece[i];
}

double bead_film_time(const struct bead_film_clock *clock, double motion)
{
    const struct bead_film_piece *p = showing(clock, motion);
    if (motion <= p->motion)
        return p->film;
    double length = p[1].motion - p->motion, until = fmin(motion, p[1].motion) - p->motion;
    return p->film + (until < length ? p->pause + film_within(p, length, until) : p[1].film - p->film);
}

double bead_film_after(const struct bead_film_clock *clock, double motion, double lasting)
{
    if (clock->count == 0)
        return motion + lasting / clock->slowed;
    double end = bead_film_time(clock, motion) + lasting;
    return end >= clock->piece[clock->count].film ? INFINITY : bead_film_motion(clock, end);
}

double bead_film_factor(const struct bead_film_clock *clock, double motion)
{
    if (clock->count == 0)
        return 1 / clock->slowed;
    const struct bead_film_piece *p = showing(clock, motion);
    if (motion == p->motion && p->pause > 0)
        return 0;
    double part = fmin(1, fmax(0, (motion - p->motion) / (p[1].motion - p->motion)));
    return p->factor[0] * pow(p->factor[1] / p->factor[0], part);
}

void bead_film_factors(const struct bead_film_clock *clock, double factors[2])
{
    factors[0] = factors[1] = 1 / clock->slowed;
    for (size_t i = 0; i < clock->count; i++) {
        for (int k = 0; k < 2; k++) {
            double factor = clock->piece[i].factor[k];
            factors[0] = i + (size_t)k == 0 ? factor : fmin(factors[0], factor);
            factors[1] = i + (size_t)k == 0 ? factor : fmax(factors[1], factor);
        }
    }
}
