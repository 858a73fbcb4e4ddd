// A histogram of every fourth pixel. Sums of integers: the same in every order.
#include "exposure.glsl"

shared uint bins[HISTOGRAM_BINS];

void main() {
  uint lane = gl_LocalInvocationIndex;
  if (lane < HISTOGRAM_BINS) bins[lane] = 0u;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * 2;
  if (all(lessThan(pixel, textureSize(hdr, 0)))) atomicAdd(bins[histogram_bin(luminance_of(texelFetch(hdr, pixel, 0).rgb))], 1u);
  barrier();
  if (lane < HISTOGRAM_BINS && bins[lane] != 0u) atomicAdd(histogram[lane], bins[lane]);
}
