// Light that every froxel scatters towards the camera, per metre, steadied by what it was in earlier frames.
#include "passes/culling/zbin.glsl"
#include "passes/lighting/brdf.glsl"
#include "passes/lighting/light.glsl"
#include "passes/lighting/shadow.glsl"
#include "froxel.glsl"
#include "scatter.glsl"
#include "history.glsl"
#include "lit_media.glsl"

void element(ivec3 at) {
  memory = lit_media(at, density, cluster_of(at, domain_size()));
  inscatter.rgb = memory.rgb;
  extinction = memory.a;
}
