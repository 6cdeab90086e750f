#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// As in render/paint/pixel_kernels_marks.h, which tests compare with it.
flat in vec4 bounds, paint;
out vec4 pixel;

void main()
{
    vec2 p = gl_FragCoord.xy, middle = 0.5 * (bounds.xy + bounds.zw), extent = 0.5 * (bounds.zw - bounds.xy);
    vec2 d = (p - middle) / extent;
    float fall = max(0.0, 1.0 - dot(d, d));
    float cover = fall * fall * paint.a;
    pixel = vec4(paint.rgb * cover, cover * 0.35); // light adds more than it hides
}
