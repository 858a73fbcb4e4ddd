// One group a light: its index goes into the range of every bin it overlaps.
#include "zbin.glsl"

void main() {
  uint index = gl_WorkGroupID.x;
  if (index >= camera.light_count) return;
  Light light = lights[index];
  if (light.farthest < 0.0) return;
  uint last = zbin_of(light.farthest);
  for (uint bin = zbin_of(light.nearest) + gl_LocalInvocationID.x; bin <= last; bin += 64u) {
    atomicMin(zbin_min[bin], index);
    atomicMax(zbin_max[bin], index);
  }
}
