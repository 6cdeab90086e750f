#version 330 core
// A sphere as a square that just holds it and its soft edge. Nothing is interpolated: every pixel computes
// from its own place, so that a part of a picture is the same whether drawn alone or with the rest.
layout(location = 0) in vec3 ball; // centre and radius, pixels
layout(location = 1) in vec2 cut;  // shown from cut.x to cut.y
layout(location = 2) in vec4 colour;
uniform vec2 size; // of the canvas

flat out vec4 disc; // centre, radius, 1/radius
flat out vec2 sides;
flat out vec3 paint;

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec2 place = ball.xy + corner * (ball.z + 1.0);
    place.x = clamp(place.x, cut.x - 1.0, cut.y + 1.0);
    gl_Position = vec4(place / size * 2.0 - 1.0, 0.0, 1.0);
    disc = vec4(ball, 1.0 / ball.z);
    sides = cut;
    paint = colour.rgb;
}
