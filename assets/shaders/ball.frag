#version 330 core
// As in render/paint/pixel_kernels_balls.h, which tests compare with it.
flat in vec4 disc;
flat in vec2 sides;
flat in vec3 paint;
out vec4 pixel;

const vec3 light = vec3(-0.36, -0.56, 0.746); // y points down
const vec3 halfway = vec3(-0.193, -0.300, 0.934);

void main()
{
    vec2 d = gl_FragCoord.xy - disc.xy;
    float square = dot(d, d);
    float cover = clamp(disc.z - sqrt(square) + 0.5, 0.0, 1.0) * clamp(gl_FragCoord.x - sides.x + 0.5, 0.0, 1.0) *
                  clamp(sides.y - gl_FragCoord.x + 0.5, 0.0, 1.0);
    vec3 normal = vec3(d * disc.w, sqrt(max(0.0, 1.0 - square * disc.w * disc.w)));
    float shine = max(0.0, dot(normal, halfway));
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    vec3 shaded = paint * (0.34 + 0.74 * max(0.0, dot(normal, light))) + 0.30 * shine;
    pixel = vec4(min(shaded, 1.0) * cover, cover);
}
