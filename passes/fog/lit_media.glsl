// Needs scatter.glsl and history.glsl.

// Scattered light per metre and extinction, steadied by earlier frames.
vec4 lit_media(ivec3 cell, float thick, uint cluster) {
  vec3 light = thick > 0.0 ? scatter(sample_of(cell), cluster) : vec3(0.0);
  vec4 now = vec4(light * fog.albedo * thick, thick);
  return fog.blend < 1.0 ? settle(now, remember(vec3(cell) + 0.5)) : now;
}
