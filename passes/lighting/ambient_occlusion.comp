// Eight taps on a spiral in the hemisphere above the pixel; half resolution, another turn every frame.
#include "passes/view/octahedral.glsl"
#include "passes/view/view.glsl"

const float RADIUS = 0.7;  // metres
const int TAPS = 8;

float occluder(vec3 position, vec3 n, vec2 pixel) {
  ivec2 at = clamp(ivec2(pixel), ivec2(0), ivec2(camera.size) - 1);
  float d = texelFetch(depth, at, 0).r;
  if (d <= 0.0) return 0.0;
  vec3 to = world_position(vec2(at) + 0.5, d) - position;
  float d2 = dot(to, to), above = dot(to, n) - 0.02;
  return max(above, 0.0) * inversesqrt(d2 + 1e-4) * max(1.0 - d2 / (RADIUS * RADIUS), 0.0);
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(occlusion)))) return;
  ivec2 pixel = at * 2;
  float d = texelFetch(depth, pixel, 0).r;
  if (d <= 0.0) {
    imageStore(occlusion, at, vec4(1.0));
    return;
  }
  vec3 position = world_position(vec2(pixel) + 0.5, d), n = octahedral_decode(texelFetch(normal, pixel, 0).rg);
  float reach = clamp(RADIUS * camera.scale.y * camera.size.y * 0.5 * d / camera.near, 2.0, 0.2 * camera.size.y);
  float angle = pixel_noise(uvec2(at)) * 6.2831853, sum = 0.0;
  for (int i = 0; i < TAPS; ++i) {
    angle += 2.3999632;
    sum += occluder(position, n, vec2(pixel) + 0.5 + reach * sqrt((float(i) + 0.7) / float(TAPS)) * vec2(cos(angle), sin(angle)));
  }
  imageStore(occlusion, at, vec4(clamp(1.0 - 1.7 * sum / float(TAPS), 0.0, 1.0)));
}
