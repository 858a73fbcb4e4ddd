// A histogram of every fourth pixel. Sums of integers: the same in every order.
#if FEATURE_subgroup_sums
#extension GL_KHR_shader_subgroup_arithmetic : require
#endif
#include "exposure.glsl"

shared uint bins[HISTOGRAM_BINS];

#if FEATURE_subgroup_sums
// Neighbours are often alike: those of a subgroup with the same bin are one addition.
void count_pixel(uint bin) {
  for (bool counted = false; !counted;) {
    uint first = subgroupMin(bin);  // of those not counted yet
    counted = bin == first;
    uint same = subgroupAdd(counted ? 1u : 0u);
    if (counted && subgroupElect()) atomicAdd(bins[first], same);
  }
}
#else
void count_pixel(uint bin) { atomicAdd(bins[bin], 1u); }
#endif

void main() {
  uint lane = gl_LocalInvocationIndex;
  if (lane < HISTOGRAM_BINS) bins[lane] = 0u;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * 2;
  if (all(lessThan(pixel, textureSize(hdr, 0)))) count_pixel(histogram_bin(luminance_of(texelFetch(hdr, pixel, 0).rgb)));
  barrier();
  if (lane < HISTOGRAM_BINS && bins[lane] != 0u) atomicAdd(histogram[lane], bins[lane]);
}
