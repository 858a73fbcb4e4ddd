// Between froxels, view space and the world. Needs passes/view/view.glsl and `params fog`.
#include "cascades.glsl"

// View space; `at` in texture coordinates of the picture. The camera's jitter moves less than a pixel and is left out.
vec3 froxel_ray(vec2 at) { return vec3((at * 2.0 - 1.0) / camera.scale, 1.0); }
vec3 view_to_world(vec3 v) { return v * mat3(camera.world_to_view) + camera.position; }

// `cell` in froxels, fractions included: the middle of the first one is 0.5.
vec3 froxel_to_view(vec3 cell) { return froxel_ray(cell.xy / fog.count.xy) * slice_to_depth(cell.z, fog.count.z, fog.start, fog.ends); }

// Where a froxel is looked at in this frame, world space.
vec3 sample_of(ivec3 cell) { return view_to_world(froxel_to_view(vec3(cell) + 0.5 + fog.jitter)); }

uint cluster_index(uvec3 cluster, uvec3 clusters) { return (cluster.z * clusters.y + cluster.y) * clusters.x + cluster.x; }
uint cluster_of(ivec3 cell, ivec3 count) {
  return cluster_index(uvec3(cell) / uint(FOG_CLUSTER), uvec3(count + FOG_CLUSTER - 1) / uint(FOG_CLUSTER));
}
