// Unit vectors as two numbers in [0, 1] (Cigolle et al. 2014).
vec2 octahedral_fold(vec2 p) { return (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0); }
vec2 octahedral_encode(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  return (n.z >= 0.0 ? n.xy : octahedral_fold(n.xy)) * 0.5 + 0.5;
}
vec3 octahedral_decode(vec2 packed) {
  vec2 p = packed * 2.0 - 1.0;
  float z = 1.0 - abs(p.x) - abs(p.y);
  return normalize(vec3(z >= 0.0 ? p : octahedral_fold(p), z));
}
