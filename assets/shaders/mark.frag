#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// As in render/paint/pixel_kernels_marks.h, which tests compare with it.
flat in vec4 bounds, shape, paint;
flat in int what;
out vec4 pixel;

// How much of the pixel lies between a and b along one axis.
float within(float x, float a, float b)
{
    return clamp(min(x + 0.5, b) - max(x - 0.5, a), 0.0, 1.0);
}

void main()
{
    vec2 p = gl_FragCoord.xy, middle = 0.5 * (bounds.xy + bounds.zw), extent = 0.5 * (bounds.zw - bounds.xy);
    float box = within(p.x, bounds.x, bounds.z) * within(p.y, bounds.y, bounds.w);
    float cover = box;
    if (what == 1) { // hatched
        float stripe = mod(p.x + p.y, shape.x);
        cover = box * (0.35 + 0.65 * clamp(0.5 * shape.x - abs(stripe - 0.5 * shape.x) - 0.18 * shape.x + 0.5, 0.0, 1.0));
    } else if (what == 2) { // ring
        cover = clamp(0.5 * shape.y + 0.5 - abs(length(p - middle) - shape.x), 0.0, 1.0);
    } else if (what == 3) { // arrow
        float edge = (extent.y * (bounds.z - p.x) / (2.0 * extent.x) - abs(p.y - middle.y)) * 2.0 * extent.x /
                     sqrt(4.0 * extent.x * extent.x + extent.y * extent.y);
        cover = clamp(edge + 0.5, 0.0, 1.0) * within(p.x, bounds.x, bounds.z);
    }
    cover *= paint.a;
    pixel = vec4(paint.rgb * cover, cover);
}
