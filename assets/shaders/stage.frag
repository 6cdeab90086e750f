#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// As in render/paint/pixel_kernels_stage.h, which tests compare with it. What there is in a pixel is chosen by WALL, BALL, MIRROR and
// ALONE, and what beads need by LIT (by contacts), MOVED (by a part of a pixel) and TILTED (contacts not level), since software
// renderers run all branches of a shader for each pixel. There is floor in all pixels but those that a bead covers (INNER).
noperspective in vec2 place; // from the corner at the top left, pixels; gl_FragCoord's origin is looked up for each pixel
flat in vec4 ball, pictures, contacts, neighbours;
flat in vec2 level;
flat in vec3 from_left, from_right, everywhere;
flat in vec3 stage; // row of the largest beads' centres, their radius, row of the floor below them
// Rectangles, since software renderers take twice as long for texelFetch, which looks for a level of detail in each pixel.
uniform sampler2DRect ground;               // the floor's light, a column for every 8 pixels
uniform sampler2DRect beside, image, alone; // pictures of the bead with neighbours, in the floor, without: light, and form in alpha
out vec4 pixel;
const float SINE = 0.2079117, COSINE = 0.9781476;

vec2 at; // the middle of the pixel

vec3 floor_light()
{
    vec2 cell = vec2(at.x * 0.125, at.y);
    return mix(texture(ground, cell).rgb, texture(ground, cell + vec2(1.0, 0.0)).rgb, fract(cell.x));
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
vec4 part_of(sampler2DRect picture, float column, float row)
{
#ifdef MOVED
    return mix(texture(picture, vec2(column + 2.0, row)), texture(picture, vec2(column + 1.0, row)), ball.w);
#else
    return texture(picture, vec2(column + 2.0, row));
#endif
}

// Light of both contacts on row `y` of a picture; `up`: -1 in the floor.
vec3 contact_light(float y, float up)
{
    float x = clamp((at.x - ball.x) / ball.y, -1.0, 1.0);
    vec2 c = vec2(-x, x);
#ifdef TILTED
    vec2 d = vec2(at.x - ball.x, 0.5 * pictures.w - y) / ball.y;
    float distance = dot(d, d), scale = inversesqrt(max(1.0, distance));
    float rise = up * (d.y * scale * COSINE + sqrt(max(0.0, 1.0 - distance)) * SINE);
    c = clamp(c * level + rise * neighbours.zw, -1.0, 1.0);
#endif
    return from_left * cap(c.x) + from_right * cap(c.y) + everywhere;
}
#endif

// 1 / sqrt(x) within 7e-4, as the plain painter has it: a root and a division take software renderers four times as long.
vec3 inverse_root(vec3 x)
{
    vec3 guess = intBitsToFloat(0x5f1ffff9 - (floatBitsToInt(x) >> 1));
    return 0.703952253 * guess * (2.38924456 - x * guess * guess);
}

void main()
{
    at = floor(place) + 0.5;
#ifdef INNER
    vec3 c = vec3(0.0);
#else
    vec3 c = floor_light();
#endif
#ifdef WALL
    float up = (stage.x - at.y) / stage.y, d = max((at.x - ball.x) / stage.y, 0.0), fade = 1.0;
    bool mirrored = at.y > stage.z;
    if (mirrored) {
        up = -2.0 * COSINE - up;
        fade = neighbours.x / (1.0 + (up + COSINE) * (0.85 + 0.5 * (up + COSINE)));
    }
    float fall = clamp(1.0 - 0.8 * d, 0.0, 1.0), close = 0.10 * fall * fall / (0.10 + d * d * 4.0 + up * up);
    vec3 face = (0.5 + 0.5 * smoothstep(-1.0, 1.3, up) + 0.8 * (1.0 - smoothstep(0.0, 0.03, d))) * everywhere + close * from_right;
    c = (mirrored ? c : vec3(0.0)) + fade * face;
#endif
#if defined BALL || defined MIRROR
#ifdef TILTED
    float high = abs(stage.z - at.y);
    if (at.x < contacts.x + high * contacts.y || at.x >= contacts.z + high * contacts.w)
        discard; // a neighbour's
#endif
    float column = at.x - ball.z;
#endif
#ifdef MIRROR
    float below = at.y - pictures.y;
    vec4 mirrored = part_of(image, column, below);
    c += mirrored.rgb;
#ifdef LIT
    c += mirrored.a * contact_light(below, -1.0);
#endif
#endif
#ifdef BALL
    float y = at.y - pictures.x;
    vec4 look = part_of(beside, column, y);
#ifdef ALONE
    vec4 other = part_of(alone, column, y);
    look.rgb = mix(other.rgb, look.rgb, at.x < ball.x ? neighbours.x : neighbours.y);
#endif
#ifdef LIT
    look.rgb += look.a * contact_light(y, 1.0);
#endif
#ifdef INNER
    c = look.rgb;
#else
    vec2 d = vec2(column - 0.5 * pictures.z, 0.5 * pictures.w - y);
    float cover = clamp(ball.y + 0.5 - length(d), 0.0, 1.0);
#ifdef MOVED
    cover = mix(cover, clamp(ball.y + 0.5 - length(d - vec2(1.0, 0.0)), 0.0, 1.0), ball.w);
#endif
    c = c * (1.0 - cover) + look.rgb;
#endif
#endif
    // Never clips; rounded in an order that spreads the steps over 8 x 8 pixels.
    vec3 t = c * 1.12 + 1e-12;
    t *= inverse_root(t * t + 1.0);
    int v = int(at.y), u = int(at.x) ^ v;
    int order = (u & 1) << 5 | (v & 1) << 4 | (u & 2) << 2 | (v & 2) << 1 | (u & 4) >> 1 | (v & 4) >> 2;
    pixel = vec4(t * inverse_root(t) + ((float(order) + 0.5) * (0.98 / 64.0) - 0.5) / 255.0, 1.0).bgra; // canvases store blue first
}
