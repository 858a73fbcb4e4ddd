// Sizes round down, so that the last texel of an odd side covers three.
void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target), from = textureSize(source, 0);
  if (any(greaterThanEqual(at, size))) return;
  ivec2 first = at * 2, end = min(first + 2, from);
  if (at.x == size.x - 1) end.x = from.x;
  if (at.y == size.y - 1) end.y = from.y;
  vec2 range = vec2(1.0, 0.0);
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      vec2 r = texelFetch(source, ivec2(x, y), 0).rg;
      range = vec2(min(range.x, r.x), max(range.y, r.y));
    }
  imageStore(target, at, range.xyxy);
}
