/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each frame of a film, drawn alone, is what the film has there: in title cards, pauses and films whose speed changes, of several
 * chains, with a camera, with a comparison; as many frames as the film lasts, in their times. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "decode.h"
#include "sessions.h"
#include "tests/pictures.h"

enum { FPS = 10 };

#define STRUCK "striker: {bead: large-steel, velocity: 0.443 m/s}, "
static const struct {
    const char *chains, *output;
    size_t frames;
} films[] = {
    {"chains:\n  - {name: A, " STRUCK "beads: [{bead: large-steel, count: 12}]}\n  - {name: B, " STRUCK
     "beads: [{cell: [large-steel, aluminium], count: 6}], wall: rigid}\n",
     "layout: columns, views: [beads, profile, spacetime], card: 0.2 s, duration: 0.6 s, captions: [{at: 60 us, pause: 0.3 s, "
     "text: "
     "here}]",
     11},
    {"chain: {" STRUCK "beads: [{bead: large-steel, count: 30}]}\n",
     "follow: front, views: [beads, spacetime], trust: true, speed: [{at: 0 ms, factor: 1/8000}, {at: 0.1 ms, factor: 1/4000}]", 8},
    {"chain: {" STRUCK "beads: [{bead: large-steel, count: 6}, {bead: ptfe, sensor: s}]}\n",
     "views: [stage, sensors], duration: 0.7 s, theme: light", 7}};

static void each_frame_alone_is_that_of_the_film(void **)
{
    char scene[512], film[512], frame[512];
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("film.apng", film, sizeof film);
    in_directory("frame.png", frame, sizeof frame);
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        static struct decoded movie;
        char text[2000];
        snprintf(text, sizeof text,
                 "title: A film\n%ssimulate: {until: 0.15 ms}\n"
                 "outputs: [{movie: film.apng, quality: lossless, size: [320, 240], fps: %d, %s}]\n",
                 films[i].chains, FPS, films[i].output);
        write_text(scene, text);
        play_counts((struct bead_job){.input = scene, .output = film, .threads = 2});
        decode(film, &movie);
        if (movie.count != films[i].frames)
            fail_msg("%s: %zu frames", films[i].output, movie.count);
        for (size_t k = 0; k < movie.count; k++) {
            char part[40];
            snprintf(part, sizeof part, "%.9f%%", 100.0 * (double)k / (double)(movie.count - 1));
            play_counts((struct bead_job){.input = scene, .output = frame, .frame = part, .threads = 1});
            struct png_file alone = read_png(frame);
            assert_true(alone.width == movie.width && alone.height == movie.height);
            assert_true(fabs(movie.time[k] - (double)k / FPS) < 1e-3);
            for (int y = 0; y < alone.height; y++) {
                const uint8_t *a = alone.rgb + 3 * (size_t)y * (size_t)alone.width,
                              *b = movie.frame[k]->data[0] + (ptrdiff_t)y * movie.frame[k]->linesize[0];
                if (memcmp(a, b, 3 * (size_t)alone.width) != 0)
                    fail_msg("%s: frame %zu is another one alone, in row %d", films[i].output, k, y);
            }
            free(alone.rgb);
        }
        decoded_free(&movie);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_frame_alone_is_that_of_the_film)};
    return cmocka_run_group_tests_name("frames alone", tests, make_directory, remove_directory);
}
