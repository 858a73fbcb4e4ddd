// Extinction of every froxel.
#include "froxel.glsl"
#include "media.glsl"

void main() {
  ivec3 cell = froxel_of_lane(gl_WorkGroupID, gl_LocalInvocationID.x);
  if (any(greaterThanEqual(cell, imageSize(density)))) return;
  uint bits = cluster_volumes[cluster_index(gl_WorkGroupID, gl_NumWorkGroups)];
  imageStore(density, cell, vec4(media_density(sample_of(cell), bits)));
}
