// A light whose box lies behind the farthest depth of every texel that it covers on the screen reaches nothing visible.
#include "passes/view/view.glsl"

struct ScreenBox { vec2 low, high; };  // clip space

// Of the box around the sphere; `near` > 0.
ScreenBox screen_box(vec3 c, float r, float near, float far) {
  vec2 low = c.xy - r, high = c.xy + r;
  vec2 lo = min(low / near, low / far), hi = max(high / near, high / far);
  return ScreenBox(lo * camera.scale + camera.jitter, hi * camera.scale + camera.jitter);
}

float farthest_depth(ivec2 low, ivec2 high, int level) {
  float farthest = 1.0;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) farthest = min(farthest, texelFetch(depth_range, ivec2(x, y), level).r);
  return farthest;
}

bool is_seen(Light light) {
  vec3 c = (camera.world_to_view * vec4(light.position, 1.0)).xyz;
  float r = light.range * 1.001 + 1e-3, near = c.z - r, far = c.z + r;
  if (far < camera.near) return false;
  if (near <= camera.near) return true;
  ScreenBox box = screen_box(c, r, near, far);
  if (any(greaterThan(box.low, vec2(1.0))) || any(lessThan(box.high, vec2(-1.0)))) return false;
  vec2 tiles = camera.size / float(TILE) * 0.5;
  ivec2 last = textureSize(depth_range, 0) - 1;
  ivec2 low = clamp(ivec2(floor((box.low + 1.0) * tiles)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor((box.high + 1.0) * tiles)), ivec2(0), last);
  int level = 0, levels = textureQueryLevels(depth_range);
  while (level + 1 < levels && max(high.x - low.x, high.y - low.y) >> level > 3) ++level;
  // Not textureSize(depth_range, level): lavapipe answers for the level of one lane only.
  ivec2 edge = max((last + 1) >> level, ivec2(1)) - 1;
  return camera.near / near >= farthest_depth(min(low >> level, edge), min(high >> level, edge), level);
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= camera.light_count || index >= MAX_LIGHTS) return;
  if (is_seen(lights[index])) atomicOr(lights_seen[index >> 5], 1u << (index & 31u));
}
