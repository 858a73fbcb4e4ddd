void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  imageStore(base, texel, imageLoad(base, texel) * 2.0);
}
