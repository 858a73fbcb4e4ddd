// How dense the fog is at a point of the world. Needs froxel.glsl, `volumes` and `albedo_maps`.

float global_density(vec3 p) { return fog.density * exp(-max(p.y - fog.ground, 0.0) * fog.thinning); }

float volume_density(FogVolume volume, vec3 p) {
  vec3 q = vec4(p, 1.0) * volume.to_box, a = abs(q);
  float inside = clamp((1.0 - max(a.x, max(a.y, a.z))) / volume.edge, 0.0, 1.0);
  vec2 at = q.xz * 0.5 * volume.repeats + volume.scroll * camera.time;
  return inside * volume.density * textureLod(albedo_maps, vec3(at, float(volume.layer)), 0.0).r;
}

// Boxes add up. `bits`: those that may hold the point.
float media_density(vec3 p, uint bits) {
  float sum = global_density(p);
  for (; bits != 0u; bits &= bits - 1u) sum += volume_density(volumes[findLSB(bits)], p);
  return sum;
}
