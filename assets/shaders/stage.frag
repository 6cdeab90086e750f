#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// As in render/paint/pixel_kernels_stage.h, which tests compare with it. What there is in a pixel is chosen by WALL, BALL, MIRROR and
// ALONE, and what beads need by LIT (by contacts) and MOVED (by parts of a pixel, or contacts not level), since software renderers
// run all branches of a shader for each pixel; floor is everywhere.
flat in vec4 ball, pictures, contacts, neighbours;
flat in vec2 level;
flat in vec3 from_left, from_right, everywhere;
uniform sampler2D ground;               // the floor's light, a column for every 8 pixels
uniform sampler2D beside, image, alone; // pictures of the bead with neighbours, in the floor, without: light, and form in alpha
uniform vec3 stage;                     // row of the largest beads' centres, their radius, row of the floor below them
out vec4 pixel;
const float SINE = 0.2079117, COSINE = 0.9781476;

vec3 floor_light(ivec2 at)
{
    int cell = at.x >> 3;
    return mix(texelFetch(ground, ivec2(cell, at.y), 0).rgb, texelFetch(ground, ivec2(cell + 1, at.y), 0).rgb,
               (gl_FragCoord.x - float(cell << 3)) * 0.125);
}

#if defined BALL || defined MIRROR
float cap(float c)
{
    float k = 0.5 + 0.5 * c;
    k *= k;
    k *= k;
    float spot = k * k;
    spot *= spot;
    return 0.74 * k + 0.50 * spot * spot;
}

// There are two columns of nothing at each side of a picture.
vec4 part_of(sampler2D picture, ivec2 at)
{
#ifdef MOVED
    return mix(texelFetch(picture, at + ivec2(2, 0), 0), texelFetch(picture, at + ivec2(1, 0), 0), ball.w);
#else
    return texelFetch(picture, at + ivec2(2, 0), 0);
#endif
}

// Light of both contacts on row `y` of a picture; `up`: -1 in the floor.
vec3 contact_light(float y, float up)
{
    float x = clamp((gl_FragCoord.x - ball.x) / ball.y, -1.0, 1.0);
    vec2 c = vec2(-x, x);
#ifdef MOVED
    vec2 d = vec2(gl_FragCoord.x - ball.x, 0.5 * pictures.w - y - 0.5) / ball.y;
    float distance = dot(d, d), scale = inversesqrt(max(1.0, distance));
    float rise = up * (d.y * scale * COSINE + sqrt(max(0.0, 1.0 - distance)) * SINE);
    c = clamp(c * level + rise * neighbours.zw, -1.0, 1.0);
#endif
    return from_left * cap(c.x) + from_right * cap(c.y) + everywhere;
}
#endif

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 c = floor_light(at);
#ifdef WALL
    float up = (stage.x - gl_FragCoord.y) / stage.y, d = max((gl_FragCoord.x - ball.x) / stage.y, 0.0), fade = 1.0;
    bool mirrored = gl_FragCoord.y > stage.z;
    if (mirrored) {
        up = -2.0 * COSINE - up;
        fade = neighbours.x / (1.0 + (up + COSINE) * (0.85 + 0.5 * (up + COSINE)));
    }
    float fall = clamp(1.0 - 0.8 * d, 0.0, 1.0), close = 0.10 * fall * fall / (0.10 + d * d * 4.0 + up * up);
    vec3 face = (0.5 + 0.5 * smoothstep(-1.0, 1.3, up) + 0.8 * (1.0 - smoothstep(0.0, 0.03, d))) * everywhere + close * from_right;
    c = (mirrored ? c : vec3(0.0)) + fade * face;
#endif
#if defined BALL || defined MIRROR
    float high = abs(stage.z - gl_FragCoord.y);
    if (gl_FragCoord.x < contacts.x + high * contacts.y || gl_FragCoord.x >= contacts.z + high * contacts.w)
        discard; // a neighbour's
    int column = clamp(at.x - int(ball.z), -1, int(pictures.z) + 1);
#endif
#ifdef MIRROR
    int below = at.y - int(pictures.y);
    vec4 mirrored = part_of(image, ivec2(column, below));
    c += mirrored.rgb;
#ifdef LIT
    c += mirrored.a * contact_light(float(below), -1.0);
#endif
#endif
#ifdef BALL
    int y = at.y - int(pictures.x);
    vec4 look = part_of(beside, ivec2(column, y));
#ifdef ALONE
    vec4 other = part_of(alone, ivec2(column, y));
    look.rgb = mix(other.rgb, look.rgb, gl_FragCoord.x < ball.x ? neighbours.x : neighbours.y);
#endif
#ifdef LIT
    look.rgb += look.a * contact_light(float(y), 1.0);
#endif
    vec2 d = vec2(float(column) + 0.5 - 0.5 * pictures.z, 0.5 * pictures.w - float(y) - 0.5);
    float cover = clamp(ball.y + 0.5 - length(d), 0.0, 1.0);
#ifdef MOVED
    cover = mix(cover, clamp(ball.y + 0.5 - length(d - vec2(1.0, 0.0)), 0.0, 1.0), ball.w);
#endif
    c = c * (1.0 - cover) + look.rgb;
#endif
    // Never clips; rounded in an order that spreads the steps over 8 x 8 pixels.
    vec3 t = c * 1.12 + 1e-12;
    t *= inversesqrt(t * t + 1.0);
    int u = at.x ^ at.y, v = at.y;
    int order = (u & 1) << 5 | (v & 1) << 4 | (u & 2) << 2 | (v & 2) << 1 | (u & 4) >> 1 | (v & 4) >> 2;
    pixel = vec4(sqrt(t) + ((float(order) + 0.5) * (0.98 / 64.0) - 0.5) / 255.0, 1.0).bgra; // canvases store blue first
}
