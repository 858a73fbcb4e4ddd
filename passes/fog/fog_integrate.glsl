// Sums each column of froxels up from near to far; a texel holds what lies in front of the far side of its froxel.
#include "froxel.glsl"
#include "march.glsl"

Stretch start(ivec3 at) { return Stretch(vec3(0.0), 1.0); }
Stretch own(ivec3 at) { return slice_stretch(vec4(inscatter.rgb, extinction), at.z, column_slant(at.xy)); }

void element(ivec3 at, Stretch sum) {
  scattered.rgb = sum.light;
  transmittance = sum.through;
}
