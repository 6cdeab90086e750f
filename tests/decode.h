/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies read back with libav, to test the files written. */
#ifndef BEADREEL_TESTS_DECODE_H
#define BEADREEL_TESTS_DECODE_H

#include <libavutil/frame.h>
#include <stddef.h>
#include <stdint.h>

enum { DECODED_MOST = 256 };

struct decoded {
    char format[64], codec[32], title[64], comment[64], description[128];
    int width, height;
    unsigned covers; /* PNG pictures beside the movie; bytes of the last */
    size_t cover_bytes;
    unsigned chapters;
    double chapter_start; /* s, of the last */
    char chapter_title[64];
    size_t subtitles; /* texts; of the first two: from when until when, s, and what */
    double subtitle_span[2][2];
    char subtitle[2][128];
    size_t count;
    AVFrame *frame[DECODED_MOST];
    double time[DECODED_MOST]; /* s */
    double duration;           /* s: until the end of the last frame, as its packet says */
    double said;               /* s: as the container says; 0 where it says nothing */
};

/* Fails the test where the file is damaged. */
void decode(const char *path, struct decoded *movie);
/* Its sound: samples of all channels side by side, to be freed; *count of each channel, from the time of the first picture on. */
float *decode_sound(const char *path, size_t *count, int *channels);
void decoded_free(struct decoded *movie);
/* Red, green, blue of a pixel; for RGB formats and palettes. */
void decoded_rgb(const AVFrame *frame, int x, int y, int rgb[3]);

#endif
