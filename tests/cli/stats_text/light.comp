#if FEATURE_path == 1
float strength() { return 2.0; }
#else
float strength() { return 1.0; }
#endif
void main() {
  float value = strength();
  if (fog) value = value * 0.5 + sin(value);
  imageStore(lit, ivec2(gl_GlobalInvocationID.xy), vec4(value));
}
