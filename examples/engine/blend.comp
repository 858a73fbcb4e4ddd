void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(trail);
  if (any(greaterThanEqual(at, size))) return;
  imageStore(trail, at, vec4(mix(texelFetch(trail_prev, at, 0).r, texelFetch(glow, at, 0).r, 0.5)));
}
