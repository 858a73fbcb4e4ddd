// Forward shading of glass and water: the lamps of the tile's bit array, within the pixel's z-bin.
#include "passes/culling/zbin.glsl"
#include "passes/fog/froxel.glsl"
#include "passes/fog/apply.glsl"
#include "brdf.glsl"
#include "light.glsl"
#include "shadow.glsl"
#include "sky.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_uv;

// Three trains of ripples.
vec3 ripple(vec3 n, float strength) {
  vec2 p = in_uv * 6.2831853;
  vec2 slope = vec2(0.0);
  slope += vec2(0.8, 0.6) * cos(dot(p, vec2(0.8, 0.6)) * 3.0 + camera.time * 2.1);
  slope += vec2(-0.5, 0.86) * cos(dot(p, vec2(-0.5, 0.86)) * 4.7 + camera.time * 2.9);
  slope += vec2(0.1, -0.99) * cos(dot(p, vec2(0.1, -0.99)) * 7.3 + camera.time * 3.7);
  return normalize(n + strength * vec3(slope.x, 0.0, slope.y));
}

uint lamp_word(uint index) { return forward_lights[index]; }
#include "masked.glsl"

void shade_lamps(inout Light2 sum, Surface s) {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  uint tile = pixel.y / TILE * ((uint(camera.size.x) + TILE - 1u) / TILE) + pixel.x / TILE;
  uint bin = camera.light_path == LIGHT_PATH_FLAT ? (MAX_LIGHTS - 1u) << 16 : zbins[zbin_of(1.0 / gl_FragCoord.w)];
  LampWalk start = start_walk(tile * LIGHT_WORDS, bin & 0xFFFFu, bin >> 16, camera.light_path == LIGHT_PATH_SLIDE), walk = start;
  for (uint i = next_of_walk(walk); i != NO_LAMP; i = next_of_walk(walk))
    if (is_plain(i)) add_lamp(sum, s, lights[i], PLAIN_FEATURES);
  walk = start;
  for (uint i = next_special(walk); i != NO_LAMP; i = next_special(walk)) add_lamp(sum, s, lights[i], ALL_FEATURES);
}

void main() {
  Material m = materials[instances[per_draw.instance].material];
  vec3 eye = normalize(camera.position - in_position), n = normalize(in_normal);
  n = ripple(dot(n, eye) < 0.0 ? -n : n, m.bump * 0.06);
  Surface s = make_surface(in_position, n, eye, m.base_color.rgb, m.roughness, 0.0);

  Light2 sum = Light2(vec3(0.0), vec3(0.0));
  shade_lamps(sum, s);
  add_light(sum, s, camera.sun_direction, camera.sun_color * sun_visibility(in_position, n));
  sum.diffuse += s.diffuse * sky_diffuse(n);
  float reflects = fresnel(vec3(0.04), s.n_eye).r;
  sum.specular += reflects * sky_specular(reflect(-eye, n), m.roughness) * m.metallic;  // metallic: how open to the sky it lies
  float alpha = clamp(m.base_color.a + reflects, 0.0, 1.0);
  vec3 color = max(sum.diffuse + sum.specular / alpha, 0.0) + m.emissive;
  hdr = vec4(through_fog(color, gl_FragCoord.xy * camera.inverse_size, 1.0 / gl_FragCoord.w), alpha);
}
