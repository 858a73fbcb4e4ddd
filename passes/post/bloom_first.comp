// Half resolution; a very bright pixel counts less, or it would sparkle.
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
  if (any(greaterThanEqual(at, size))) return;
  vec2 texel = 1.0 / vec2(textureSize(color, 0)), uv = (vec2(at) + 0.5) / vec2(size);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 c = textureLod(color, uv + texel * (vec2(i & 1, i >> 1) - 0.5), 0.0).rgb;
    sum += vec4(c, 1.0) / (1.0 + 0.05 * max(c.r, max(c.g, c.b)));
  }
  imageStore(target, at, vec4(sum.rgb / sum.a, 1.0));
}
