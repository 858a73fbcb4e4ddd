// Light that every froxel scatters towards the camera, per metre, steadied by what it was in earlier frames.
#include "passes/culling/zbin.glsl"
#include "passes/lighting/brdf.glsl"
#include "passes/lighting/light.glsl"
#include "passes/lighting/shadow.glsl"
#include "froxel.glsl"
#include "scatter.glsl"
#include "history.glsl"

void main() {
  ivec3 cell = froxel_of_lane(gl_WorkGroupID, gl_LocalInvocationID.x);
  if (any(greaterThanEqual(cell, imageSize(inscatter)))) return;
  vec3 p = view_to_world(froxel_to_view(vec3(cell) + 0.5 + fog.jitter));
  float thick = texelFetch(density, cell, 0).r;
  vec3 light = thick > 0.0 ? scatter(p, cluster_index(gl_WorkGroupID, gl_NumWorkGroups)) : vec3(0.0);
  vec4 now = vec4(light * fog.albedo * thick, thick);
  vec4 steady = fog.blend < 1.0 ? settle(now, remember(vec3(cell) + 0.5)) : now;
  imageStore(memory, cell, steady);
  imageStore(inscatter, cell, vec4(steady.rgb, 1.0));
  imageStore(extinction, cell, vec4(steady.a));
}
