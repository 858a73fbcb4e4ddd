// One group a cluster of froxels: which lights and which boxes of fog reach it. Both tests err on the side of keeping.
#include "passes/view/view.glsl"
#include "passes/culling/cone.glsl"
#include "froxel.glsl"

shared uint light_words[LIGHT_WORDS];
shared uint volume_word;

struct ClusterBounds {
  vec3 corner[8];  // world
  vec3 center;     // of a sphere around it
  float radius;
};

// Samples may lie half a froxel outside.
ClusterBounds cluster_bounds(vec3 first) {
  ClusterBounds b;
  b.center = vec3(0.0);
  vec3 low = first - 0.5, high = first + float(FOG_CLUSTER) + 0.5;
  for (int i = 0; i < 8; ++i) {
    vec3 cell = mix(low, high, vec3(i & 1, i >> 1 & 1, i >> 2));
    b.corner[i] = view_to_world(froxel_to_view(cell));
    b.center += 0.125 * b.corner[i];
  }
  b.radius = 0.0;
  for (int i = 0; i < 8; ++i) b.radius = max(b.radius, distance(b.corner[i], b.center));
  b.radius = b.radius * 1.001 + 1e-3;
  return b;
}

bool lamp_reaches(Light light, ClusterBounds b) {
  if (distance(light.position, b.center) > light.range + b.radius) return false;
  if ((light.features & (LAMP_ROUND | LAMP_SQUARE)) == 0u) return true;
  return cone_reaches(light.position, light.direction, light.range, light.cos_outer, light.sin_outer, b.center, b.radius);
}

// Apart if one side of the box has all corners beyond it.
bool box_reaches(FogVolume volume, ClusterBounds b) {
  vec3 low = vec3(1e9), high = vec3(-1e9);
  for (int i = 0; i < 8; ++i) {
    vec3 p = vec4(b.corner[i], 1.0) * volume.to_box;
    low = min(low, p);
    high = max(high, p);
  }
  return all(lessThanEqual(low, vec3(1.001))) && all(greaterThanEqual(high, vec3(-1.001)));
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane < LIGHT_WORDS) light_words[lane] = 0u;
  if (lane == 0u) volume_word = 0u;
  barrier();

  ClusterBounds bounds = cluster_bounds(vec3(gl_WorkGroupID * uint(FOG_CLUSTER)));
  for (uint i = lane; i < camera.light_count; i += 64u)
    if (lamp_reaches(lights[i], bounds)) atomicOr(light_words[i >> 5], 1u << (i & 31u));
  for (uint i = lane; i < fog.volume_count; i += 64u)
    if (box_reaches(volumes[i], bounds)) atomicOr(volume_word, 1u << i);
  barrier();

  uint cluster = cluster_index(gl_WorkGroupID, gl_NumWorkGroups);
  if (lane < LIGHT_WORDS) cluster_lights[cluster * LIGHT_WORDS + lane] = light_words[lane];
  if (lane == 0u) cluster_volumes[cluster] = volume_word;
}
