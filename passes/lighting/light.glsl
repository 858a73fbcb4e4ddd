// Lamps. Needs brdf.glsl.
const float LAMP_SIZE2 = 0.01;  // square of the radius below which a lamp grows no brighter, metres

// Inverse square, drawn smoothly to exactly zero at the range (Karis 2013).
float falloff(float distance2, float range) {
  float x = distance2 / (range * range);
  float window = max(1.0 - x * x, 0.0);
  return window * window / (distance2 + LAMP_SIZE2);
}

void add_lamp(inout Light2 sum, Surface s, Light light) {
  vec3 to = light.position - s.position;
  float d2 = dot(to, to);
  if (d2 >= light.range * light.range) return;
  vec3 l = to * inversesqrt(max(d2, 1e-8));
  float strength = falloff(d2, light.range);
  if (light.kind == LIGHT_SPOT) {
    float cone = clamp((dot(-l, light.direction) - light.cos_outer) * light.cone_scale, 0.0, 1.0);
    strength *= cone * cone;
  }
  add_light(sum, s, l, light.color * strength);
}
