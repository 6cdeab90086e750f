/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sound of movies: decoded, it is the force at the times shown by the pictures, in every format. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/movie.h"
#include "tests/decode.h"
#include "tests/pictures.h"

extern const struct bead_sink_type bead_movie_sink;

enum { RATE = BEAD_SOUND_RATE };

/* A smooth pulse of 10 N that passes bead, or contact, j from 0.1 j ms to 0.1 (j + 1) ms. */
static double smooth_pulse(size_t bead, double time)
{
    double within = time / 1e-4 - (double)bead;
    return within > 0 && within < 1 ? 10 * pow(sin(3.14159265358979 * within), 2) : 0;
}

/* As Opus does, which keeps nothing below 3 Hz: its dc_reject. */
static void reject_constant(float *samples, size_t count)
{
    const double part = 6.3 * 3 / RATE;
    double mean = 0;
    for (size_t i = 0; i < count; i++) {
        double in = samples[i];
        samples[i] = (float)(in - mean);
        mean += part * (in - mean);
    }
}

struct film {
    const char *name, *keys;
    size_t contact;
    double card;                                 /* s */
    double (*motion)(double film, bool *stands); /* s of the motion at a time of the film, from the card on */
    double length;                               /* s, with the card */
};

static double even_motion(double film, bool *stands)
{
    *stands = film > 0.95; /* the last of 20 frames */
    return fmin(1e-3, film * 1e-3 / 0.95);
}

/* With a pause of .5 s at .35 ms, before which nothing is sped up or down. */
static double motion_with_pause(double film, bool *stands)
{
    const double scale = 1.5 / 1.45, at = film * scale; /* frames show the motion from end to end */
    *stands = (at > 0.35 && at < 0.85) || film > 1.45;
    return fmin(1e-3, at < 0.35 ? at * 1e-3 : at < 0.85 ? 0.35e-3 : (at - 0.5) * 1e-3);
}

/* 1/1000 until .5 ms, then 1/4000. */
static double motion_with_speed(double film, bool *stands)
{
    const double scale = 2.5 / 2.45, at = film * scale;
    *stands = film > 2.45;
    return fmin(1e-3, at < 0.5 ? at * 1e-3 : 0.5e-3 + (at - 0.5) * 0.25e-3);
}

static const struct film films[] = {
    {"a.mp4", "sound: wall, card: 1 s, duration: 1 s", 9, 1, even_motion, 2},
    {"a.mov", "sound: contact 3, duration: 1 s, captions: [{at: 0.35 ms, text: Now, pause: 0.5 s}]", 3, 0, motion_with_pause, 1.5},
    {"a.webm", "sound: contact 7, duration: 1 s", 7, 0, even_motion, 1},
    {"a.mkv", "sound: contact 6, card: 0.5 s, speed: [{at: 0.4999999 ms, factor: 1/1000}, {at: 0.5 ms, factor: 1/4000}]", 6, 0.5,
     motion_with_speed, 3},
};

/* Within a hundredth of a second of the times where the motion stops or continues, it fades. */
static double fade(size_t from_edge)
{
    return from_edge < RATE / 100 ? 0.5 * (1 + cos(3.14159265358979 * (double)from_edge / (RATE / 100.0))) : 0;
}

static float *expect(const struct film *film, size_t count)
{
    float *wanted = calloc(count, sizeof *wanted);
    double *gain = calloc(count, sizeof *gain);
    assert_true(wanted && gain);
    size_t stood = RATE;
    for (size_t i = 0; i < count; i++) {
        double at = (double)i / RATE - film->card;
        bool stands = at < 0;
        double motion = at < 0 ? 0 : film->motion(at, &stands);
        stood = stands ? stood + 1 : 0;
        gain[i] = stands ? fade(stood) : 1;
        wanted[i] = (float)(0.089 * smooth_pulse(film->contact, motion));
    }
    stood = RATE;
    for (size_t i = count; i-- > 0;) {
        bool stands = gain[i] < 1;
        stood = stands ? stood + 1 : 0;
        wanted[i] *= (float)(stands ? fmin(1, gain[i] + fade(stood)) : 1);
    }
    free(gain);
    return wanted;
}

/* Root of the mean square of the difference, in units of that of the expected sound. */
static double difference(const float *got, const float *wanted, size_t count)
{
    double error = 0, all = 0;
    for (size_t i = 0; i < count; i++) {
        error += pow(got[i] - wanted[i], 2);
        all += pow(wanted[i], 2);
    }
    return sqrt(error / all);
}

/* The first sample above a twentieth of the largest, s. */
static double onset(const float *samples, size_t count)
{
    float most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmaxf(most, samples[i]);
    for (size_t i = 0; i < count; i++) {
        if (samples[i] > 0.05f * most)
            return (double)i / RATE;
    }
    return NAN;
}

static void sound_is_the_force(void **state)
{
    (void)state;
    for (size_t f = 0; f < sizeof films / sizeof films[0]; f++) {
        const struct film *film = &films[f];
        char text[400], path[256];
        size_t count;
        int channels;
        snprintf(text, sizeof text, "movie: %s, views: [beads], size: [160, 90], fps: 20, %s", film->name, film->keys);
        struct built built = build_chain(text);
        draw_output(&built, smooth_pulse);
        in_directory(film->name, path, sizeof path);
        struct decoded pictures;
        decode(path, &pictures);
        float *got = decode_sound(path, &count, &channels);
        remove(path);
        assert_int_equal(channels, 1);
        assert_true(pictures.time[0] == 0);
        assert_int_equal(pictures.count, lround(20 * film->length));
        if (!(fabs((double)count / RATE - film->length) < 0.025))
            fail_msg("%s: %g s of sound, %g s of film", film->name, (double)count / RATE, film->length);
        float *wanted = expect(film, count);
        if (strcmp(strrchr(path, '.'), ".mp4") != 0 && strcmp(strrchr(path, '.'), ".mov") != 0)
            reject_constant(wanted, count);
        double late = onset(got, count) - onset(wanted, count), differs = difference(got, wanted, count);
        if (!(fabs(late) < 0.01 && differs < 0.02))
            fail_msg("%s: the sound is %g s late and differs by %g", film->name, late, differs);
        for (size_t i = 1; i < count; i++) /* the steepest slope of the pulses is .003 */
            assert_true(fabsf(got[i] - got[i - 1]) < 0.02f);
        for (size_t i = 0; i < (size_t)(film->card * RATE); i++)
            assert_true(fabsf(got[i]) < 1e-3f);
        free(wanted);
        free(got);
        decoded_free(&pictures);
        release_chain(&built);
    }
}

/* Out of the middle of a pulse into a pause: silence within a hundredth of a second, and nothing of a click. */
static void pauses_are_silent(void **state)
{
    (void)state;
    char path[256];
    size_t count;
    int channels;
    struct built built = build_chain("movie: a.mp4, views: [beads], size: [160, 90], fps: 20, sound: contact 3, duration: 1 s, "
                                     "captions: [{at: 0.35 ms, text: Now, pause: 0.5 s}]");
    draw_output(&built, smooth_pulse);
    in_directory("a.mp4", path, sizeof path);
    float *got = decode_sound(path, &count, &channels);
    remove(path);
    assert_true(got[(size_t)(0.33 * RATE)] > 0.5f && got[(size_t)(0.835 * RATE)] > 0.5f);
    for (size_t i = (size_t)(0.36 * RATE); i < (size_t)(0.80 * RATE); i++)
        assert_true(fabsf(got[i]) < 3e-3f);
    free(got);
    release_chain(&built);
    /* The motion stands for the last of twenty frames a second. */
    built = build_chain("movie: a.mp4, views: [beads], size: [160, 90], fps: 20, sound: contact 3, duration: 1 s, until: 0.35 ms");
    draw_output(&built, smooth_pulse);
    got = decode_sound(path, &count, &channels);
    remove(path);
    assert_true(got[(size_t)(0.93 * RATE)] > 0.5f);
    for (size_t i = (size_t)(0.965 * RATE); i < RATE; i++)
        assert_true(fabsf(got[i]) < 3e-3f);
    free(got);
    release_chain(&built);
}

/* A sound asks for the force of its contact, whatever the views show. */
static void sounds_need_their_contacts(void **state)
{
    (void)state;
    struct built built = build_chain("movie: a.mp4, views: [profile], field: velocity, beads: [0, 3], size: [160, 90], "
                                     "sound: contact 7, duration: 1 s");
    struct bead_run_context context = make_stage(&built);
    struct bead_message msg = {""};
    struct bead_sink *sink;
    struct bead_needs needs;
    if (bead_movie_sink.create(&built.scene->outputs[0], &context, &sink, &msg))
        fail_msg("%s", msg.text);
    bead_movie_sink.needs(sink, &needs);
    assert_int_equal(needs.fields, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE));
    assert_true(needs.beads.first == 0 && needs.beads.last >= 6 && needs.beads.last <= 7);
    bead_movie_sink.destroy(sink);
    release_chain(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_is_the_force),
        cmocka_unit_test(pauses_are_silent),
        cmocka_unit_test(sounds_need_their_contacts),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
