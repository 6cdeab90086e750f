/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What eyes can distinguish: CIELAB (D65), CIEDE2000 (Sharma, Wu and Dalal 2005, Color Res. Appl. 30, 21), WCAG 2.2's contrast, and
 * colours as seen without one kind of cone (Machado, Oliveira and Fernandes 2009, IEEE Trans. Vis. Comput. Graph. 15, 1291). */
#ifndef BEADREEL_TESTS_EYES_H
#define BEADREEL_TESTS_EYES_H

#include <math.h>

enum eyes { EYES_ALL_CONES, EYES_NO_RED, EYES_NO_GREEN, EYES_NO_BLUE, EYES_KINDS };

static inline double eyes_linear(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static inline double eyes_luminance(const double srgb[3])
{
    return 0.2126 * eyes_linear(srgb[0]) + 0.7152 * eyes_linear(srgb[1]) + 0.0722 * eyes_linear(srgb[2]);
}

static inline double eyes_contrast(const double a[3], const double b[3])
{
    const double x = eyes_luminance(a) + 0.05, y = eyes_luminance(b) + 0.05;
    return x > y ? x / y : y / x;
}

static inline double eyes_root(double t)
{
    return t > 0.008856 ? cbrt(t) : 7.787 * t + 16.0 / 116;
}

/* CIELAB of a colour, 0..1 each, as these eyes see it. */
static inline void eyes_lab(enum eyes eyes, const double srgb[3], double lab[3])
{
    static const double cones[EYES_KINDS][3][3] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}},
        {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}},
        {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};
    double rgb[3];
    for (int i = 0; i < 3; i++) {
        rgb[i] = 0;
        for (int k = 0; k < 3; k++)
            rgb[i] += cones[eyes][i][k] * eyes_linear(srgb[k]);
        rgb[i] = fmin(1, fmax(0, rgb[i]));
    }
    const double x = eyes_root((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.95047),
                 y = eyes_root(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]),
                 z = eyes_root((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.08883);
    lab[0] = 116 * y - 16;
    lab[1] = 500 * (x - y);
    lab[2] = 200 * (y - z);
}

static inline double eyes_angle(double b, double a)
{
    const double angle = atan2(b, a) * 180 / M_PI;
    return angle < 0 ? angle + 360 : angle;
}

static inline double eyes_cosine(double degrees)
{
    return cos(degrees * M_PI / 180);
}

/* CIEDE2000 between two colours in CIELAB. */
static inline double eyes_difference(const double one[3], const double two[3])
{
    const double power = pow(25, 7), mean = 0.5 * (hypot(one[1], one[2]) + hypot(two[1], two[2]));
    const double stretch = 1 + 0.5 * (1 - sqrt(pow(mean, 7) / (pow(mean, 7) + power)));
    const double a[2] = {stretch * one[1], stretch * two[1]}, c[2] = {hypot(a[0], one[2]), hypot(a[1], two[2])};
    const double h[2] = {eyes_angle(one[2], a[0]), eyes_angle(two[2], a[1])}, turn = h[1] - h[0];
    const int far = fabs(turn) > 180, grey = c[0] * c[1] == 0;
    const double hue = grey ? 0 : far ? turn - copysign(360, turn) : turn;
    const double middle = grey ? h[0] + h[1] : far ? 0.5 * (h[0] + h[1] + (h[0] + h[1] < 360 ? 360 : -360)) : 0.5 * (h[0] + h[1]);
    const double light = 0.5 * (one[0] + two[0]) - 50, chroma = 0.5 * (c[0] + c[1]);
    const double t = 1 - 0.17 * eyes_cosine(middle - 30) + 0.24 * eyes_cosine(2 * middle) + 0.32 * eyes_cosine(3 * middle + 6) -
                     0.20 * eyes_cosine(4 * middle - 63);
    const double dl = (two[0] - one[0]) / (1 + 0.015 * light * light / sqrt(20 + light * light));
    const double dc = (c[1] - c[0]) / (1 + 0.045 * chroma);
    const double dh = 2 * sqrt(c[0] * c[1]) * sin(hue * M_PI / 360) / (1 + 0.015 * chroma * t);
    const double rotate =
        -2 * sqrt(pow(chroma, 7) / (pow(chroma, 7) + power)) * sin(60 * exp(-pow((middle - 275) / 25, 2)) * M_PI / 180);
    return sqrt(dl * dl + dc * dc + dh * dh + rotate * dc * dh);
}

#endif
