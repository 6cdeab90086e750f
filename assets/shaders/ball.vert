#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere as a point or a square that just holds it and its soft edge. Nothing is interpolated: every pixel computes
// from its own place, so that a part of a picture is the same whether drawn alone or with the rest. What all pixels
// of a ball have in common is computed here, once.
layout(location = 0) in vec3 ball; // centre and radius, pixels
layout(location = 1) in vec2 cut;  // shown from cut.x to cut.y
layout(location = 2) in vec4 colour;
uniform vec2 size;    // of the viewport
uniform float margin; // of the viewport around the canvas
uniform float spread; // 0: a point; 1: corners of a square

const vec2 light = vec2(-0.36, -0.56); // y points down; ball.frag has their third components
const vec2 halfway = vec2(-0.193, -0.300);

flat out vec4 disc;  // centre, radius with half of the soft edge, 1/radius^2
flat out vec2 sides; // what, added to x and taken from by it, covers the pixel
flat out vec4 tilt;  // shares of the pixel's place, pixels from the centre, in highlight and shade
flat out vec3 paint;

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec2 place = ball.xy + spread * corner * (ball.z + 1.0);
    gl_Position = vec4((place + margin) / size * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = 2.0 * (ball.z + 1.0);
    float curvature = 1.0 / ball.z;
    disc = vec4(ball.xy, ball.z + 0.5, curvature * curvature);
    sides = vec2(0.5 - cut.x, 0.5 + cut.y);
    tilt = vec4(halfway, 0.8 * light) * curvature;
    paint = colour.rgb;
}
