// Walks each column of froxels from near to far; a texel holds what lies in front of the far side of its froxel.
#include "froxel.glsl"
#include "march.glsl"

void main() {
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  ivec3 size = imageSize(scattered);
  if (any(greaterThanEqual(column, size.xy))) return;
  float slant = column_slant(column);
  Stretch sum = Stretch(vec3(0.0), 1.0);
  for (int z = 0; z < size.z; ++z) {
    ivec3 cell = ivec3(column, z);
    sum = join(sum, slice_stretch(vec4(texelFetch(inscatter, cell, 0).rgb, texelFetch(extinction, cell, 0).r), z, slant));
    imageStore(scattered, cell, vec4(sum.light, 1.0));
    imageStore(transmittance, cell, vec4(sum.through));
  }
}
