// A 3 x 3 tent of the coarser level, mixed into the finer one: a constant stays what it is.
const float SPREAD = 0.55;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
  if (any(greaterThanEqual(at, size))) return;
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), uv = (vec2(at) + 0.5) / vec2(size);
  vec3 sum = vec3(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += textureLod(source, uv + texel * vec2(x, y), 0.0).rgb * (float((2 - abs(x)) * (2 - abs(y))) / 16.0);
  imageStore(target, at, vec4(mix(imageLoad(target, at).rgb, sum, SPREAD), 1.0));
}
