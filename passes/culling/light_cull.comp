// One group a tile, one bit a light. A word of a tile is tile * LIGHT_WORDS + light / 32.
#include "passes/view/view.glsl"
#include "cull.glsl"

shared uint opaque_words[LIGHT_WORDS];
shared uint forward_words[LIGHT_WORDS];

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane < LIGHT_WORDS) {
    opaque_words[lane] = 0u;
    forward_words[lane] = 0u;
  }
  barrier();

  vec2 range = texelFetch(bounds, ivec2(gl_WorkGroupID.xy), 0).rg;
  float near = view_depth(range.y), far = view_depth(range.x) * 1.0001;
  vec2 first = vec2(gl_WorkGroupID.xy * uint(TILE));
  TileVolume solid = tile_volume(first, first + float(TILE), near * 0.9999, far);
  TileVolume whole = tile_volume(first, first + float(TILE), 0.0, far);
  for (uint index = lane; index < camera.light_count; index += 64u) {
    uint bit = 1u << (index & 31u);
    if ((lights_seen[index >> 5] & bit) == 0u) continue;
    Light light = lights[index];
    if (!light_reaches(whole, light)) continue;
    atomicOr(forward_words[index >> 5], bit);
    if (near < FAR && light_reaches(solid, light)) atomicOr(opaque_words[index >> 5], bit);
  }
  barrier();

  uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (lane < LIGHT_WORDS) {
    tile_lights[tile * LIGHT_WORDS + lane] = opaque_words[lane];
    forward_lights[tile * LIGHT_WORDS + lane] = forward_words[lane];
  }
}
