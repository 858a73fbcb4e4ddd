// A clear evening: a gradient, a glow about the sun, its disc. Radiance.
vec3 sky_radiance(vec3 direction, bool disc) {
  float up = direction.y;
  vec3 zenith = camera.ambient, horizon = camera.ambient * vec3(1.9, 1.45, 1.1) + camera.sun_color * 0.018;
  vec3 ground = camera.ambient * vec3(0.42, 0.38, 0.34);
  vec3 sky = mix(horizon, zenith, pow(clamp(up, 0.0, 1.0), 0.45));
  sky = mix(sky, ground, smoothstep(0.0, -0.12, up));
  float toward = max(dot(direction, camera.sun_direction), 0.0);
  sky += camera.sun_color * (0.02 * pow(toward, 8.0) + 0.05 * pow(toward, 96.0));
  if (disc && toward > 0.99965) sky += camera.sun_color * 12.0;
  return sky;
}

// Irradiance over pi that a surface gets from sky and ground, and what a mirror of roughness r would show.
vec3 sky_diffuse(vec3 n) {
  vec3 up = camera.ambient * 1.15, side = camera.ambient * vec3(0.9, 0.8, 0.72) + camera.sun_color * 0.012;
  vec3 down = camera.ambient * vec3(0.34, 0.3, 0.26) + camera.sun_color * 0.022;
  return n.y > 0.0 ? mix(side, up, n.y) : mix(side, down, -n.y);
}
vec3 sky_specular(vec3 reflected, float roughness) {
  return mix(sky_radiance(reflected, false), sky_diffuse(reflected), clamp(roughness * 1.6, 0.0, 1.0));
}

// How much of the environment a GGX surface reflects (Karis 2014).
vec3 environment_brdf(vec3 f0, float roughness, float n_eye) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * n_eye)) * r.x + r.y;
  return f0 * (-1.04 * a + r.z) + (1.04 * a + r.w);
}
