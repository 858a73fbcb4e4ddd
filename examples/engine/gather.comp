void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(glow);
  if (any(greaterThanEqual(at, size))) return;
  vec2 p = (vec2(at) + 0.5) / vec2(size);
  float sum = 0.0;
  for (int i = 0; i < lights.length(); ++i) sum += lights[i].strength * max(1.0 - distance(p, lights[i].position) / lights[i].radius, 0.0);
  imageStore(glow, at, vec4(sum));
}
