void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(waves)))) return;
  imageStore(waves, texel, vec4(vec2(texel % TILE) / TILE, 0.5, 1.0));
}
