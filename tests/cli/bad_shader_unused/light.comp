void main() {
  imageStore(lit, ivec2(gl_GlobalInvocationID.xy), vec4(1));
}
