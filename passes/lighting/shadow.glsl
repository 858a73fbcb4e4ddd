// The share of the sun that reaches a point: four compares, weighted bilinearly, because depth formats need not filter.
float compare_texel(ivec2 at, float depth) {
  ivec2 size = textureSize(sun_shadow, 0);
  return depth >= texelFetch(sun_shadow, clamp(at, ivec2(0), size - 1), 0).r ? 1.0 : 0.0;
}

float compare_four(vec2 texel, float depth) {
  vec2 base = floor(texel - 0.5), f = texel - 0.5 - base;
  ivec2 at = ivec2(base);
  float top = mix(compare_texel(at, depth), compare_texel(at + ivec2(1, 0), depth), f.x);
  float bottom = mix(compare_texel(at + ivec2(0, 1), depth), compare_texel(at + ivec2(1, 1), depth), f.x);
  return mix(top, bottom, f.y);
}

const float SHADOW_BIAS = 0.0004;

float sun_visibility_of(vec3 position) {
  vec3 at = (camera.world_to_sun * vec4(position, 1.0)).xyz;
  if (any(greaterThan(abs(at.xy), vec2(1.0)))) return 1.0;
  return compare_four((at.xy * 0.5 + 0.5) * vec2(textureSize(sun_shadow, 0)), at.z + SHADOW_BIAS);
}

// Of a surface: the point moves off it, so that it does not shade itself.
float sun_visibility(vec3 position, vec3 normal) {
  float slant = 1.0 - clamp(dot(normal, camera.sun_direction), 0.0, 1.0);
  return sun_visibility_of(position + normal * camera.sun_texel * (0.6 + 1.8 * slant));
}
