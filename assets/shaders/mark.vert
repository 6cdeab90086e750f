#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
layout(location = 0) in vec4 box; // x0, y0, x1, y1
layout(location = 1) in vec4 form;
layout(location = 2) in float kind;
layout(location = 3) in vec4 colour;
uniform vec2 size;    // of the viewport
uniform float margin; // of the viewport around the canvas

flat out vec4 bounds, shape, paint;
flat out int what;

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 place = mix(box.xy - 1.0, box.zw + 1.0, corner);
    gl_Position = vec4((place + margin) / size * 2.0 - 1.0, 0.0, 1.0);
    bounds = box;
    shape = form;
    paint = colour;
    what = int(kind + 0.5);
}
