// One group a 16 x 16 tile: depth bounds in shared memory, lights in parallel, then the list in ascending order,
// whatever order the threads ran in. What exceeds the record is dropped from its end and counted.
#include "passes/view/view.glsl"
#include "cull.glsl"

shared uint least_depth, greatest_depth;
shared uint words[LIGHT_WORDS];
shared uint features;

void gather_depth() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  uint d = floatBitsToUint(texelFetch(depth, pixel, 0).r);
  if (d == 0u) return;  // sky
  atomicMin(least_depth, d);
  atomicMax(greatest_depth, d);
}

void test_lights(TileVolume volume) {
  for (uint index = gl_LocalInvocationIndex; index < camera.light_count; index += SHADE_TILE * SHADE_TILE)
    if (light_reaches(volume, lights[index])) atomicOr(words[index >> 5], 1u << (index & 31u));
}

// Lights in words before `word`.
uint rank(uint word) {
  uint before = 0u;
  for (uint w = 0u; w < word; ++w) before += bitCount(words[w]);
  return before;
}

void write_word(uint tile, uint word) {
  uint at = rank(word);
  uint found = 0u;
  for (uint m = words[word]; m != 0u && at < MAX_TILE_LIGHTS; m &= m - 1u) {
    uint index = word * 32u + uint(findLSB(m));
    tile_records[tile].light[at++] = index;
    found |= lights[index].features;
  }
  atomicOr(features, found);
}

void main() {
  uint lane = gl_LocalInvocationIndex, tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (lane == 0u) {
    least_depth = 0xFFFFFFFFu;
    greatest_depth = 0u;
    features = 0u;
  }
  if (lane < LIGHT_WORDS) words[lane] = 0u;
  barrier();
  gather_depth();
  barrier();
  vec2 first = vec2(gl_WorkGroupID.xy * uint(SHADE_TILE));
  if (greatest_depth != 0u)
    test_lights(tile_volume(first, first + float(SHADE_TILE), view_depth(uintBitsToFloat(greatest_depth)) * 0.9999,
                            view_depth(uintBitsToFloat(least_depth)) * 1.0001));
  barrier();
  if (lane < LIGHT_WORDS) write_word(tile, lane);
  uint count = rank(LIGHT_WORDS);
  if (lane >= min(count, MAX_TILE_LIGHTS) && lane < MAX_TILE_LIGHTS) tile_records[tile].light[lane] = 0u;
  barrier();
  if (lane == 0u) {
    // The other light paths meet lamps that the record does not list.
    tile_features[tile] = features | (camera.light_path == LIGHT_PATH_RECORDS ? camera.forced_features : (1u << LAMP_FEATURES) - 1u);
    tile_records[tile].count = min(count, uint(MAX_TILE_LIGHTS));
    tile_records[tile].overflow = count - min(count, uint(MAX_TILE_LIGHTS));
  }
}
