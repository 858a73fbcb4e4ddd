void main() {
  float seen = texture(shadow, vec4(0.5));
  imageStore(lit, ivec2(0), vec4(seen));
}
