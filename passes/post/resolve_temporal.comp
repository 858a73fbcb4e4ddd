// Temporal anti-aliasing: last frame's colour where the surface was, held to what its neighbours show now (Karis 2014).
#include "passes/view/view.glsl"

const float BLEND = 0.1;  // of the new frame

vec3 to_ycocg(vec3 c) { return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b), -0.25 * c.r + 0.5 * c.g - 0.25 * c.b); }
vec3 to_rgb(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }
float weight(vec3 ycocg) { return 1.0 / (1.0 + ycocg.x); }  // keeps single bright samples from flickering

struct Neighbours { vec3 least, greatest; ivec2 nearest; };
Neighbours look_around(ivec2 pixel) {
  Neighbours n = Neighbours(vec3(1e9), vec3(-1e9), pixel);
  ivec2 edge = ivec2(camera.size) - 1;
  float closest = -1.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), edge);
      vec3 c = to_ycocg(texelFetch(hdr, at, 0).rgb);
      n.least = min(n.least, c);
      n.greatest = max(n.greatest, c);
      float d = texelFetch(depth, at, 0).r;
      if (d > closest) {
        closest = d;
        n.nearest = at;
      }
    }
  return n;
}

// Where the sky was: it has no surface to carry a velocity.
vec2 sky_velocity(vec2 at) {
  vec4 ray = vec4(normalize(world_ray(at)), 0.0);
  vec4 now = camera.steady_to_clip * ray, before = camera.previous_to_clip * ray;
  return (before.xy / before.w - now.xy / now.w) * 0.5;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  vec2 at = vec2(pixel) + 0.5;
  Neighbours around = look_around(pixel);
  vec2 moved = texelFetch(depth, around.nearest, 0).r > 0.0 ? texelFetch(velocity, around.nearest, 0).rg : sky_velocity(at);
  vec2 uv = at * camera.inverse_size + moved;
  vec4 history = textureLod(color_prev, uv, 0.0);
  vec3 now = to_ycocg(texelFetch(hdr, pixel, 0).rgb);
  bool known = history.a > 0.5 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
  vec3 before = known ? clamp(to_ycocg(history.rgb), around.least, around.greatest) : now;
  float a = BLEND * weight(now), b = (1.0 - BLEND) * weight(before);
  imageStore(color, pixel, vec4(max(to_rgb((now * a + before * b) / (a + b)), 0.0), 1.0));
}
