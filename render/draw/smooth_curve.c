/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splines through the values of a profile, a few points to a gap. */
#include "render/draw/smooth_curve.h"

#include <math.h>

static const double least_pitch = 3, part_length = 2; /* px */

unsigned bead_smooth_parts(double pitch)
{
    double parts = ceil(pitch / part_length);
    return pitch < least_pitch ? 1 : parts > BEAD_SMOOTH_MOST ? BEAD_SMOOTH_MOST : (unsigned)parts;
}

static float value_at(const float *y, size_t count, ptrdiff_t i, bool odd)
{
    const ptrdiff_t last = (ptrdiff_t)count - 1;
    if (odd && i < 0)
        return 2 * y[0] - y[-i < last ? -i : last];
    if (odd && i > last)
        return 2 * y[last] - y[2 * last - i > 0 ? 2 * last - i : 0];
    return y[i < 0 ? 0 : (size_t)i < count ? (size_t)i : count - 1];
}

/* The spline's slopes m solve m[i - 1] + 4 m[i] + m[i + 1] = 3 (y[i + 1] - y[i - 1]); the inverse of that matrix falls off by
 * sqrt(3) - 2 for each bead. */
static float slope_at(const float *y, size_t count, ptrdiff_t i, bool odd)
{
    static const float fall = -0.26794919f, first = 0.8660254f;
    float sum = value_at(y, count, i + 1, odd) - value_at(y, count, i - 1, odd), weight = fall;
    for (ptrdiff_t j = 1; j < BEAD_SMOOTH_REACH - 1; j++) {
        sum += weight * (value_at(y, count, i + j + 1, odd) - value_at(y, count, i + j - 1, odd) +
                         value_at(y, count, i - j + 1, odd) - value_at(y, count, i - j - 1, odd));
        weight *= fall;
    }
    return first * sum;
}

static float within(float y, float top, float bottom)
{
    return y < top ? top : y > bottom ? bottom : y;
}

size_t bead_smooth_fill(const float *x, const float *y, size_t count, size_t from, size_t to, unsigned parts, bool odd, float top,
                        float bottom, float *sx, float *sy)
{
    size_t points = 0;
    float left = parts > 1 ? slope_at(y, count, (ptrdiff_t)from, odd) : 0;
    for (size_t i = from; i + 1 < to; i++) {
        float right = parts > 1 ? slope_at(y, count, (ptrdiff_t)i + 1, odd) : 0;
        for (unsigned k = 0; k < parts; k++) {
            float t = (float)k / (float)parts, u = 1 - t;
            float at = y[i] * (1 + 2 * t) * u * u + y[i + 1] * (3 - 2 * t) * t * t + left * t * u * u - right * t * t * u;
            sx[points] = x[i] + t * (x[i + 1] - x[i]);
            sy[points++] = k == 0 ? y[i] : within(at, top, bottom);
        }
        left = right;
    }
    if (to > from) {
        sx[points] = x[to - 1];
        sy[points++] = y[to - 1];
    }
    return points;
}
