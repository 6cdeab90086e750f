#version 330 core
// As in render/paint/pixel_kernels_marks.h, which tests compare with it.
flat in vec4 bounds, shape, paint;
out vec4 pixel;

// How much of the pixel lies between a and b along one axis.
float within(float x, float a, float b)
{
    return clamp(min(x + 0.5, b) - max(x - 0.5, a), 0.0, 1.0);
}

float line(float x, float at, float width)
{
    return within(x, at - 0.5 * width, at + 0.5 * width);
}

void main()
{
    vec2 p = gl_FragCoord.xy;
    float height = bounds.w - bounds.y, down = clamp((p.y - bounds.y) / height, 0.0, 1.0);
    float part = down * down * (3.0 - 2.0 * down), slope = 6.0 * down * (1.0 - down) / height;
    vec2 at = mix(shape.xy, shape.zw, part), lean = (shape.zw - shape.xy) * slope;
    vec2 lines = clamp(1.1 - abs(p.xx - at) * inversesqrt(1.0 + lean * lean), 0.0, 1.0);
    float edges = max(0.6 * max(lines.x, lines.y), line(p.y, bounds.y + 1.0, 2.0) * within(p.x, shape.x, shape.y));
    float cover = within(p.y, bounds.y, bounds.w) * max(0.13 * within(p.x, at.x, at.y), edges) * paint.a;
    pixel = vec4(paint.rgb * cover, cover);
}
