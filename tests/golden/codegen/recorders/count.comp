void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, textureSize(depth, 0)))) return;
  if (texelFetch(depth, texel, 0).x > 0.0) atomicAdd(counted[gl_LocalInvocationIndex & 3u], 1u);
}
