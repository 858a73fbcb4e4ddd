// Media, light and sums in one kernel. A group walks the clusters of four by four columns from near to far; four neighbouring lanes hold four
// neighbouring slices, and pass on what lies in front of them. Joined in the order of the chain, so that the sums are the same.
#include "passes/culling/zbin.glsl"
#include "passes/lighting/brdf.glsl"
#include "passes/lighting/light.glsl"
#include "passes/lighting/shadow.glsl"
#include "froxel.glsl"
#include "media.glsl"
#include "scatter.glsl"
#include "history.glsl"
#include "lit_media.glsl"
#include "march.glsl"

shared vec4 stretches[64];  // light, share that comes through

void main() {
  uint lane = gl_LocalInvocationID.x, first = lane & ~3u;
  uvec3 clusters = uvec3(gl_NumWorkGroups.xy, (imageSize(scattered).z + FOG_CLUSTER - 1) / FOG_CLUSTER);
  Stretch front = Stretch(vec3(0.0), 1.0);
  for (uint z = 0u; z < clusters.z; ++z) {
    uvec3 place = uvec3(gl_WorkGroupID.xy, z);
    ivec3 cell = froxel_of_lane(place, lane);
    uint cluster = cluster_index(place, clusters);
    vec4 media = lit_media(cell, media_density(sample_of(cell), cluster_volumes[cluster]), cluster);
    imageStore(memory, cell, media);  // beyond the edge of the volume nothing is stored
    Stretch own = slice_stretch(media, cell.z, column_slant(cell.xy));
    stretches[lane] = vec4(own.light, own.through);
    barrier();
    Stretch sum = front;
    for (uint i = 0u; i < 4u; ++i) {
      vec4 next = stretches[first + i];
      front = join(front, Stretch(next.rgb, next.a));
      if (i == (lane & 3u)) sum = front;
    }
    imageStore(scattered, cell, vec4(sum.light, 1.0));
    imageStore(transmittance, cell, vec4(sum.through));
    barrier();
  }
}
