// Least and greatest depth of a light tile.
void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy), size = textureSize(depth, 0);
  if (any(greaterThanEqual(tile, imageSize(target)))) return;
  ivec2 first = tile * int(TILE), end = min(first + int(TILE), size);
  vec2 range = vec2(1.0, 0.0);
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      float d = texelFetch(depth, ivec2(x, y), 0).r;
      range = vec2(min(range.x, d), max(range.y, d));
    }
  imageStore(target, tile, range.xyxy);
}
