#version 330 core
// As in render/paint/pixel_kernels_marks.h, which tests compare with it. The widths within which pixels lie are of more than one pixel.
flat in vec4 bounds, shape, paint;
flat in vec3 way; // of the two lines from top to bottom, pixels; 1/height
out vec4 pixel;

void main()
{
    vec2 p = gl_FragCoord.xy;
    float down = clamp((p.y - bounds.y) * way.z, 0.0, 1.0);
    float part = down * down * (3.0 - 2.0 * down), slope = 6.0 * way.z * (down - down * down);
    vec2 aside = shape.xy + way.xy * part - p.xx, lean = way.xy * slope;
    vec2 lines = clamp(1.1 - abs(aside) * inversesqrt(1.0 + lean * lean), 0.0, 1.0);
    vec2 between = clamp(vec2(0.5 - aside.x, aside.y + 0.5), 0.0, 1.0), top = clamp(vec2(p.x - shape.x, shape.y - p.x) + 0.5, 0.0, 1.0);
    float below = p.y - bounds.y + 0.5;
    float edges = max(0.6 * max(lines.x, lines.y), clamp(min(below, 3.0 - below), 0.0, 1.0) * top.x * top.y);
    float inside = clamp(min(below, bounds.w - p.y + 0.5), 0.0, 1.0);
    float cover = inside * max(0.13 * between.x * between.y, edges) * paint.a;
    pixel = vec4(paint.rgb * cover, cover);
}
