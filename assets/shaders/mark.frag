#version 330 core
flat in vec4 bounds, shape, paint;
flat in int what;
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
    vec2 p = gl_FragCoord.xy, middle = 0.5 * (bounds.xy + bounds.zw), extent = 0.5 * (bounds.zw - bounds.xy);
    float box = within(p.x, bounds.x, bounds.z) * within(p.y, bounds.y, bounds.w);
    float cover = box, weight = 1.0;
    if (what == 1) { // hatched
        float stripe = mod(p.x + p.y, shape.x);
        cover = box * (0.35 + 0.65 * clamp(0.5 * shape.x - abs(stripe - 0.5 * shape.x) - 0.18 * shape.x + 0.5, 0.0, 1.0));
    } else if (what == 2) { // ring
        cover = clamp(0.5 * shape.y + 0.5 - abs(length(p - middle) - shape.x), 0.0, 1.0);
    } else if (what == 3) { // arrow
        float edge = (extent.y * (bounds.z - p.x) / (2.0 * extent.x) - abs(p.y - middle.y)) * 2.0 * extent.x /
                     sqrt(4.0 * extent.x * extent.x + extent.y * extent.y);
        cover = clamp(edge + 0.5, 0.0, 1.0) * within(p.x, bounds.x, bounds.z);
    } else if (what == 4) { // glow
        vec2 d = (p - middle) / extent;
        float fall = max(0.0, 1.0 - dot(d, d));
        cover = fall * fall;
        weight = 0.35; // light adds more than it hides
    } else if (what == 5) { // zoom
        float height = bounds.w - bounds.y, down = clamp((p.y - bounds.y) / height, 0.0, 1.0);
        float part = down * down * (3.0 - 2.0 * down), slope = 6.0 * down * (1.0 - down) / height;
        vec2 at = mix(shape.xy, shape.zw, part), lean = (shape.zw - shape.xy) * slope;
        vec2 lines = clamp(1.1 - abs(p.xx - at) * inversesqrt(1.0 + lean * lean), 0.0, 1.0);
        float edges = max(0.6 * max(lines.x, lines.y), line(p.y, bounds.y + 1.0, 2.0) * within(p.x, shape.x, shape.y));
        cover = within(p.y, bounds.y, bounds.w) * max(0.13 * within(p.x, at.x, at.y), edges);
    }
    cover *= paint.a;
    pixel = vec4(paint.rgb * cover, cover * weight);
}
