// Light that a point of the fog scatters towards the camera, for an albedo and a density of one. Needs froxel.glsl, the lamps and the sun's shadow.

// Henyey and Greenstein 1941; `cosine` between the ways before and after.
float phase_function(float cosine, float g) {
  float q = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * PI * q * sqrt(q));
}

vec3 scatter_sun(vec3 p, vec3 ray) {
  return camera.sun_color * (sun_visibility_of(p) * phase_function(dot(ray, camera.sun_direction), fog.phase));
}

// From everywhere alike.
vec3 scatter_sky() { return camera.ambient; }

uint lamp_word(uint index) { return cluster_lights[index]; }
#include "passes/lighting/masked.glsl"

// Penumbrae are too fine for fog.
const uint FOG_FEATURES = ALL_FEATURES & ~LAMP_SOFT;

// Plain lamps first, as on surfaces.
vec3 scatter_lamps(vec3 p, uint cluster) {
  vec3 sum = vec3(0.0);
  LampWalk start = start_walk(cluster * LIGHT_WORDS, 0u, MAX_LIGHTS - 1u, false), walk = start;
  for (uint i = next_of_walk(walk); i != NO_LAMP; i = next_of_walk(walk))
    if (is_plain(i)) sum += lamp_irradiance(lights[i], PLAIN_FEATURES, p);
  walk = start;
  for (uint i = next_special(walk); i != NO_LAMP; i = next_special(walk)) sum += lamp_irradiance(lights[i], FOG_FEATURES, p);
  return max(sum, 0.0) * (1.0 / (4.0 * PI));
}

vec3 scatter(vec3 p, uint cluster) {
  vec3 sum = vec3(0.0);
  if (fog_sun) sum += scatter_sun(p, normalize(p - camera.position));
  if (fog_lights) sum += scatter_lamps(p, cluster);
  if (fog_ambient) sum += scatter_sky();
  return sum;
}
