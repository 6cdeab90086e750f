#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// As in render/paint/pixel_kernels_balls.h, which tests compare with it. Most of the time of painting is spent here.
flat in vec4 disc;
flat in vec2 sides;
flat in vec4 tilt;
flat in vec3 paint;
out vec4 pixel;

const float light = 0.746, halfway = 0.934; // to the eye

void main()
{
    vec2 d = gl_FragCoord.xy - disc.xy;
    float square = dot(d, d);
    float cover = clamp(disc.z - sqrt(square), 0.0, 1.0) * clamp(gl_FragCoord.x + sides.x, 0.0, 1.0) *
                  clamp(sides.y - gl_FragCoord.x, 0.0, 1.0);
    float z = sqrt(max(0.0, 1.0 - square * disc.w));
    float shine = max(0.0, dot(d, tilt.xy) + halfway * z);
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    float facing = max(0.0, dot(d, tilt.zw) + 0.8 * light * z + 0.2);
    vec3 own = min(paint * (0.34 + 0.74 * facing * facing), 1.0);
    pixel = vec4((own + 0.50 * shine * (1.0 - own)) * cover, cover);
}
