// Tiled deferred shading: sun, sky, and the lamps of the tile's record; the other light paths exist to be compared with it.
#include "features.glsl"
#include "passes/view/octahedral.glsl"
#include "passes/view/view.glsl"
#include "passes/culling/zbin.glsl"
#include "passes/fog/froxel.glsl"
#include "passes/fog/apply.glsl"
#include "brdf.glsl"
#include "light.glsl"
#include "shadow.glsl"
#include "sky.glsl"

uint lamp_word(uint index) { return tile_lights[index]; }
#include "masked.glsl"

// Lamps of the pixel in ascending order, by whichever path.
struct LampSource { uint path, tile, at; LampWalk walk; };

LampSource lamp_source(uvec2 pixel, float depth) {
  LampSource source;
  source.path = camera.light_path;
  source.at = 0u;
  source.tile = pixel.y / SHADE_TILE * ((uint(camera.size.x) + SHADE_TILE - 1u) / SHADE_TILE) + pixel.x / SHADE_TILE;
  uint bits = pixel.y / TILE * ((uint(camera.size.x) + TILE - 1u) / TILE) + pixel.x / TILE;
  uint bin = source.path == LIGHT_PATH_FLAT ? (MAX_LIGHTS - 1u) << 16 : zbins[zbin_of(depth)];
  source.walk = start_walk(bits * LIGHT_WORDS, bin & 0xFFFFu, bin >> 16, source.path == LIGHT_PATH_SLIDE);
  return source;
}

uint next_lamp(inout LampSource source) {
  if (source.path == LIGHT_PATH_RECORDS)
    return source.at < tile_records[source.tile].count ? tile_records[source.tile].light[source.at++] : NO_LAMP;
  if (source.path == LIGHT_PATH_ALL) return source.at < camera.light_count ? source.at++ : NO_LAMP;
  return next_of_walk(source.walk);
}
uint next_special(inout LampSource source) {
  uint index = next_lamp(source);
  while (index != NO_LAMP && is_plain(index)) index = next_lamp(source);
  return index;
}

// First the plain lamps, then the others: code for features that no lamp of a loop has costs nothing. A kernel has the code of its features only.
void shade_lamps(inout Light2 sum, Surface s, uvec2 pixel, float depth) {
  LampSource start = lamp_source(pixel, depth), source = start;
  for (uint i = next_lamp(source); i != NO_LAMP; i = next_lamp(source))
    if (is_plain(i)) add_lamp(sum, s, lights[i], KERNEL & PLAIN_FEATURES);
  if ((KERNEL & ~PLAIN_FEATURES) == 0u) return;
  source = start;
  for (uint i = next_special(source); i != NO_LAMP; i = next_special(source)) add_lamp(sum, s, lights[i], KERNEL);
}

float smooth_occlusion(vec2 uv) {
  vec2 texel = 1.0 / vec2(textureSize(occlusion, 0));
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += textureLod(occlusion, uv + texel * (vec2(i & 1, i >> 1) * 2.0 - 1.0), 0.0).r;
  return 0.25 * sum;
}

void add_sky(inout Light2 sum, Surface s, float roughness, float sky) {
  sum.diffuse += s.diffuse * sky_diffuse(s.normal) * sky;
  vec3 reflected = reflect(-s.eye, s.normal);
  sum.specular += environment_brdf(s.f0, roughness, s.n_eye) * sky_specular(reflected, roughness) * sky * sky;
}

void main() {
  ivec2 pixel = ivec2(spectrum_pixel());
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  vec2 at = vec2(pixel) + 0.5;
  float d = texelFetch(depth, pixel, 0).r;
  bool shown = camera.debug_view == DEBUG_FINAL || camera.debug_view == DEBUG_KERNELS;
  bool lit = shown || camera.debug_view == DEBUG_DIFFUSE || camera.debug_view == DEBUG_SPECULAR;
  if (d <= 0.0 || !lit) {
    vec3 sky = through_fog(sky_radiance(normalize(world_ray(at)), true), at * camera.inverse_size, FAR);
    imageStore(hdr, pixel, vec4(shown ? sky : vec3(0.0), 1.0));
    return;
  }
  vec4 base = texelFetch(albedo, pixel, 0), m = texelFetch(material, pixel, 0);
  vec3 position = world_position(at, d), n = octahedral_decode(texelFetch(normal, pixel, 0).rg);
  Surface s = make_surface(position, n, normalize(camera.position - position), base.rgb, m.r, m.g);

  Light2 sum = Light2(vec3(0.0), vec3(0.0));
  shade_lamps(sum, s, uvec2(pixel), camera.near / d);
  add_light(sum, s, camera.sun_direction, camera.sun_color * sun_visibility(position, n));
  add_sky(sum, s, m.r, base.a * smooth_occlusion(at * camera.inverse_size));

  vec3 color = max(sum.diffuse + sum.specular, 0.0) + texelFetch(emissive, pixel, 0).rgb;  // dark lamps take no more than there is
  color = through_fog(color, at * camera.inverse_size, camera.near / d);
  if (camera.debug_view == DEBUG_DIFFUSE) color = sum.diffuse;
  if (camera.debug_view == DEBUG_SPECULAR) color = sum.specular;
  imageStore(hdr, pixel, vec4(color, 1.0));
}
