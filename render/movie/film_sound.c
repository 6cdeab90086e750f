/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the sound of a film from the samples of a force. The sink feeds it and writes it at the end.
 *
 * The sound at a time of the film is the force, less the static force, at the time of the motion that the picture shows. Between
 * samples the force is interpolated with a windowed sinc; if the film passes several samples in one of the sound, the sinc is wider
 * by that factor, which removes everything above half the rate of the sound. When the motion stops, in title cards, pauses and the
 * last frame, the sound fades to silence. The loudest sample is scaled to just below full. */
#include "render/movie/film.h"
#include "sim/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOBES = 8, STEPS = 256 /* of the kernel's table, a lobe */, FADE = BEAD_SOUND_RATE / 100 };
static const double loudest = 0.89; /* -1 dB, because encoders overshoot */
static const double longest = 3600; /* s */
static const double pi = 3.14159265358979323846;

/* The sound of one chain. */
struct voice {
    bool heard;
    enum bead_field field;
    size_t index;   /* of the bead or contact */
    double rest;    /* N */
    double gain[2]; /* in the left and right channel */
    float *force;   /* N, less the static force, on the grid: [count], with room for all samples */
    size_t count;
};

struct bead_film_sound {
    const struct bead_film *film;
    int channels;
    struct voice *voices;
    size_t voice_count;
    double kernel[LOBES * STEPS + 2];
};

/* ---- what is heard ---- */

static bool find_contact(const struct bead_chain *chain, const struct bead_sound_asked *asked, struct voice *v)
{
    const size_t contacts = bead_chain_contacts(chain);
    const bool wall = bead_chain_spec(chain)->wall != BEAD_WALL_NONE;
    if (asked->of == BEAD_SOUND_WALL ? !wall : asked->contact >= contacts)
        return false;
    v->field = BEAD_FIELD_CONTACT_FORCE;
    v->index = asked->of == BEAD_SOUND_WALL ? contacts - 1 : asked->contact;
    return true;
}

static bool find_sensor(const struct bead_chain *chain, const struct bead_sound_asked *asked, struct voice *v)
{
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(sensors[i].name, asked->sensor) != 0)
            continue;
        v->field = BEAD_FIELD_FORCE;
        v->index = sensors[i].bead;
        return true;
    }
    return false;
}

static enum bead_error nothing_heard(const struct bead_output *output, struct bead_message *msg)
{
    const struct bead_sound_asked *asked = &output->movie.sound;
    char what[160];
    if (asked->of == BEAD_SOUND_WALL)
        snprintf(what, sizeof what, "a wall");
    else if (asked->of == BEAD_SOUND_CONTACT)
        snprintf(what, sizeof what, "a contact %zu", asked->contact);
    else
        snprintf(what, sizeof what, "a sensor `%.64s`", asked->sensor);
    return bead_output_wrong(output, msg, "sound: no chain has %s", what);
}

/* Spreads the chains from left to right, equally loud. */
static void place_voices(struct bead_film_sound *s)
{
    for (size_t c = 0; c < s->voice_count; c++) {
        double turn = s->voice_count > 1 ? 0.5 * pi * (double)c / (double)(s->voice_count - 1) : 0;
        s->voices[c].gain[0] = cos(turn);
        s->voices[c].gain[1] = sin(turn);
    }
}

static enum bead_error find_voices(struct bead_film_sound *s, struct bead_message *msg)
{
    const struct bead_run_context *context = &s->film->context;
    const struct bead_sound_asked *asked = &s->film->output->movie.sound;
    bool any = false;
    s->voice_count = context->chain_count;
    s->channels = s->voice_count > 1 ? 2 : 1;
    BEAD_TRY(bead_new(&s->voices, s->voice_count, msg, "the sound of a movie"));
    for (size_t c = 0; c < s->voice_count; c++) {
        struct voice *v = &s->voices[c];
        v->heard = (asked->of == BEAD_SOUND_SENSOR ? find_sensor : find_contact)(context->chains[c], asked, v);
        any = any || v->heard;
    }
    place_voices(s);
    return any ? BEAD_OK : nothing_heard(s->film->output, msg);
}

/* ---- from samples of the motion to those of the film ---- */

static double sinc(double x)
{
    return fabs(x) < 1e-9 ? 1 : sin(pi * x) / (pi * x);
}

static void make_kernel(struct bead_film_sound *s)
{
    for (int i = 0; i < LOBES * STEPS + 2; i++) {
        double x = (double)i / STEPS;
        s->kernel[i] = x < LOBES ? sinc(x) * sinc(x / LOBES) : 0;
    }
}

static double kernel_at(const struct bead_film_sound *s, double x)
{
    double place = fabs(x) * STEPS;
    if (place >= LOBES * STEPS)
        return 0;
    size_t i = (size_t)place;
    return s->kernel[i] + (place - (double)i) * (s->kernel[i + 1] - s->kernel[i]);
}

/* At `place`, in samples; `wide`: the number of samples that pass in one of the sound. */
static double force_at(const struct bead_film_sound *s, const struct voice *v, double place, double wide)
{
    wide = fmax(1, wide);
    double sum = 0, weights = 0, last = (double)v->count - 1;
    for (double k = ceil(place - LOBES * wide); k <= place + LOBES * wide; k++) {
        double weight = kernel_at(s, (place - k) / wide);
        sum += weight * (double)v->force[(size_t)fmin(last, fmax(0, k))];
        weights += weight;
    }
    return sum / weights;
}

/* Time of the motion at a sample of the sound, s. */
static double moment_at(const struct bead_film_sound *s, size_t n)
{
    return bead_movie_time(&s->film->times, (double)n / BEAD_SOUND_RATE * s->film->output->movie.fps);
}

static void scale(const struct bead_film_sound *s, float *samples, size_t n, double gain)
{
    for (int c = 0; c < s->channels; c++)
        samples[n * (size_t)s->channels + (size_t)c] *= (float)gain;
}

static double fade(size_t n)
{
    return n < FADE ? 0.5 * (1 + cos(pi * (double)n / FADE)) : 0;
}

/* For samples first..end - 1, in which the motion pauses: fades the sound out and, before the motion continues, in again. */
static void quieten(const struct bead_film_sound *s, float *samples, size_t first, size_t end, size_t count)
{
    for (size_t n = first; n < end; n++) {
        double gain = (first > 0 ? fade(n - first) : 0) + (end < count ? fade(end - 1 - n) : 0);
        scale(s, samples, n, fmin(1, gain));
    }
}

static void play(const struct bead_film_sound *s, float *samples, size_t count)
{
    const struct bead_grid *grid = &s->film->times.grid;
    size_t paused = 0; /* samples since the motion paused */
    double now = moment_at(s, 0);
    for (size_t n = 0; n < count; n++) {
        double next = moment_at(s, n + 1);
        for (size_t k = 0; k < s->voice_count; k++) {
            const struct voice *v = &s->voices[k];
            double force = v->count > 0 ? force_at(s, v, (now - grid->start) / grid->every, (next - now) / grid->every) : 0;
            for (int c = 0; c < s->channels; c++)
                samples[n * (size_t)s->channels + (size_t)c] += (float)(v->gain[c] * force);
        }
        if (next > now && paused > 0)
            quieten(s, samples, n - paused, n, count);
        paused = next > now ? 0 : paused + 1;
        now = next;
    }
    quieten(s, samples, count - paused, count, count);
    for (size_t n = 0; n < FADE && n < count; n++) /* a film that begins in the middle of the motion must not click */
        scale(s, samples, n, 1 - fade(n));
}

static void level(float *samples, size_t count)
{
    float most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmaxf(most, fabsf(samples[i]));
    for (size_t i = 0; i < count && most > 0; i++)
        samples[i] *= (float)loudest / most;
}

/* ---- life ---- */

enum bead_error bead_film_sound_create(const struct bead_film *film, struct bead_film_sound **sound, struct bead_message *msg)
{
    *sound = NULL;
    if (film->output->movie.sound.of == BEAD_SOUND_OFF)
        return BEAD_OK;
    if ((double)film->times.frames / film->output->movie.fps > longest)
        return bead_output_wrong(film->output, msg, "sound: a movie with sound lasts at most %g s", longest);
    BEAD_TRY(bead_new(sound, 1, msg, "the sound of a movie"));
    struct bead_film_sound *s = *sound;
    s->film = film;
    make_kernel(s);
    return find_voices(s, msg);
}

void bead_film_sound_destroy(struct bead_film_sound *sound)
{
    if (!sound)
        return;
    for (size_t c = 0; sound->voices && c < sound->voice_count; c++)
        free(sound->voices[c].force);
    free(sound->voices);
    free(sound);
}

int bead_film_sound_channels(const struct bead_film_sound *sound)
{
    return sound ? sound->channels : 0;
}

void bead_film_sound_needs(const struct bead_film_sound *sound, struct bead_needs *needs)
{
    for (size_t c = 0; sound && c < sound->voice_count; c++) {
        const struct voice *v = &sound->voices[c];
        if (!v->heard)
            continue;
        needs->fields |= BEAD_FIELD_BIT(v->field);
        needs->beads.first = v->index < needs->beads.first ? v->index : needs->beads.first;
        needs->beads.last = v->index > needs->beads.last ? v->index : needs->beads.last;
    }
}

enum bead_error bead_film_sound_feed(struct bead_film_sound *sound, const struct bead_sample *sample, struct bead_message *msg)
{
    struct voice *v = &sound->voices[sample->chain];
    if (!v->heard)
        return BEAD_OK;
    size_t room = bead_grid_count(&sound->film->times.grid);
    if (!v->force) { /* earlier, the arrays of the chain may not exist */
        v->rest = bead_force_at_rest(sound->film->context.chains[sample->chain], v->field, v->index);
        v->force = malloc(room * sizeof *v->force);
    }
    if (!v->force)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the sound of a movie");
    if (v->count < room)
        v->force[v->count++] = (float)(sample->field[v->field][v->index] - v->rest);
    return BEAD_OK;
}

enum bead_error bead_film_sound_write(const struct bead_film_sound *sound, struct bead_movie *movie, struct bead_message *msg)
{
    if (!sound)
        return BEAD_OK;
    const struct bead_film *film = sound->film;
    size_t count = (size_t)llround((double)film->times.frames / film->output->movie.fps * BEAD_SOUND_RATE),
           all = count * (size_t)sound->channels;
    BEAD_FREED float *samples;
    BEAD_TRY(bead_new(&samples, all + 1, msg, "the sound of a movie"));
    play(sound, samples, count);
    level(samples, all);
    return bead_movie_sound(movie, samples, count, msg);
}
