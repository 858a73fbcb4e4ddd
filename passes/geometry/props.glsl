// A prop's vertex in the world; parts that swing do so about the prop's origin.
vec3 swing_point(vec3 p, uint part, float angle) {
  if (part == 0u) return p;
  float s = sin(angle), c = cos(angle);
  return vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
}
vec3 place_prop(mat3x4 model, vec3 p) { return vec4(p, 1.0) * model; }
