// Light that every froxel scatters towards the camera, per metre, steadied by what it was in earlier frames.
#include "passes/culling/zbin.glsl"
#include "passes/lighting/brdf.glsl"
#include "passes/lighting/light.glsl"
#include "passes/lighting/shadow.glsl"
#include "froxel.glsl"
#include "scatter.glsl"
#include "history.glsl"
#include "lit_media.glsl"

void main() {
  ivec3 cell = froxel_of_lane(gl_WorkGroupID, gl_LocalInvocationID.x);
  if (any(greaterThanEqual(cell, imageSize(inscatter)))) return;
  vec4 media = lit_media(cell, texelFetch(density, cell, 0).r, cluster_index(gl_WorkGroupID, gl_NumWorkGroups));
  imageStore(memory, cell, media);
  imageStore(inscatter, cell, vec4(media.rgb, 1.0));
  imageStore(extinction, cell, vec4(media.a));
}
