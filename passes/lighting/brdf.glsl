// A dielectric or metal with a GGX lobe (Walter 2007; height-correlated visibility after Heitz 2014; Schlick's Fresnel).
const float PI = 3.14159265358979;

struct Surface {
  vec3 position, normal, eye;  // eye: unit, towards the camera
  vec3 diffuse, f0;
  float alpha;                 // roughness squared
  float n_eye;
};
struct Light2 { vec3 diffuse, specular; };

Surface make_surface(vec3 position, vec3 normal, vec3 eye, vec3 base, float roughness, float metallic) {
  Surface s;
  s.position = position;
  s.normal = normal;
  s.eye = eye;
  s.diffuse = base * (1.0 - metallic);
  s.f0 = mix(vec3(0.04), base, metallic);
  s.alpha = roughness * roughness;
  s.n_eye = max(dot(normal, eye), 1e-3);
  return s;
}

vec3 fresnel(vec3 f0, float cosine) {
  float m = 1.0 - cosine, m2 = m * m;
  return f0 + (1.0 - f0) * (m2 * m2 * m);
}

// GGX lobe times the cosine, towards direction `l` with cosine `n_l` > 0; `alpha` may be wider than the surface's.
vec3 specular_lobe(Surface s, vec3 l, float n_l, float alpha) {
  vec3 h = normalize(l + s.eye);
  float n_h = clamp(dot(s.normal, h), 0.0, 1.0), a2 = alpha * alpha;
  float q = n_h * n_h * (a2 - 1.0) + 1.0;
  float lobe = a2 / (PI * q * q);
  float visibility = 0.5 / (n_l * sqrt(s.n_eye * s.n_eye * (1.0 - a2) + a2) + s.n_eye * sqrt(n_l * n_l * (1.0 - a2) + a2));
  return fresnel(s.f0, clamp(dot(s.eye, h), 0.0, 1.0)) * (lobe * visibility * n_l);
}

// Adds what comes from direction `l` with irradiance `e` on a plane that faces it.
void add_light(inout Light2 sum, Surface s, vec3 l, vec3 e) {
  float n_l = dot(s.normal, l);
  if (n_l <= 0.0) return;
  sum.diffuse += s.diffuse * e * (n_l / PI);
  sum.specular += specular_lobe(s, l, n_l, s.alpha) * e;
}
