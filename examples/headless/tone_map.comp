#include "exposure.glsl"
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = textureSize(hdr, 0);
  if (any(greaterThanEqual(at, size))) return;
  pixels[at.y * size.x + at.x] = packUnorm4x8(vec4(expose(texelFetch(hdr, at, 0).rgb, camera.exposure), 1.0));
}
