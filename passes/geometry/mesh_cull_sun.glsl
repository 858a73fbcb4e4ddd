// The indirect draws of the sun.
bool in_sun(vec3 center, float radius) {
  vec3 c = (camera.world_to_sun * vec4(center, 1.0)).xyz;
  return max(abs(c.x), abs(c.y)) <= 1.0 + radius * camera.sun_ndc;
}

void element(int at) {
  bool lit = candidate.lit != 0u && in_sun(candidate.center, candidate.radius);
  sun_draw = lit ? candidate.draw : DrawArguments(0u, 0u, 0u, 0u);
  if (lit) atomicAdd(cull_counts[COUNT_SUN], 1u);
}
