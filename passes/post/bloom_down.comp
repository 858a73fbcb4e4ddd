// Sixteen texels through four filtered taps; the weights add up to one.
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
  if (any(greaterThanEqual(at, size))) return;
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), uv = (vec2(at) + 0.5) / vec2(size);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) sum += textureLod(source, uv + texel * (vec2(i & 1, i >> 1) * 2.0 - 1.0), 0.0).rgb;
  imageStore(target, at, vec4(sum * 0.25, 1.0));
}
