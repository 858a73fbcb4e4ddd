void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(height);
  if (any(greaterThanEqual(at, size))) return;
  vec2 p = (vec2(at) + 0.5) / vec2(size) * vec2(clock.aspect, 1.0);
  float swell = 0.0;
  for (int i = 1; i <= 4; ++i) swell += sin(float(i) * (p.x * 9.0 + p.y * 5.0 * float(i % 2)) + clock.seconds * float(i)) / float(i);
  imageStore(height, at, vec4(swell * 0.25 + 0.5));
}
