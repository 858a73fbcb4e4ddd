// What the camera sees of something through the fog. Needs froxel.glsl, `scattered` and `transmittance`.
// Texels hold sums up to the far sides of froxels; in front of the first of those they count in part.
vec3 fog_place(vec2 at, float slice) { return vec3(at, (slice - 0.5) / fog.count.z); }
float fog_slice(float depth) { return depth_to_slice(depth, fog.count.z, fog.start, fog.ends); }

vec3 fog_light(vec2 at, float depth) {
  float slice = fog_slice(depth);
  return textureLod(scattered, fog_place(at, slice), 0.0).rgb * min(slice, 1.0);
}
float fog_transmittance(vec2 at, float depth) {
  float slice = fog_slice(depth);
  return mix(1.0, textureLod(transmittance, fog_place(at, slice), 0.0).r, min(slice, 1.0));
}

// `at` in texture coordinates of the picture, `depth` in view space.
vec3 through_fog(vec3 color, vec2 at, float depth) { return color * fog_transmittance(at, depth) + fog_light(at, depth); }
