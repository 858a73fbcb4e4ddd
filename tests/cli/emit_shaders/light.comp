void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  imageStore(lit, at, texelFetch(other, at, 0));
}
