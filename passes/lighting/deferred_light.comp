// Tiled deferred shading: sun, sky, and the lamps of the tile's record; the other light paths exist to be compared with it.
#include "passes/view/octahedral.glsl"
#include "passes/view/view.glsl"
#include "passes/culling/zbin.glsl"
#include "brdf.glsl"
#include "light.glsl"
#include "masked.glsl"
#include "shadow.glsl"
#include "sky.glsl"

void shade_record(inout Light2 sum, Surface s, uvec2 pixel) {
  uint tiles = (uint(camera.size.x) + SHADE_TILE - 1u) / SHADE_TILE;
  uint tile = pixel.y / SHADE_TILE * tiles + pixel.x / SHADE_TILE;
  uint count = tile_records[tile].count;
  for (uint i = 0u; i < count; ++i) add_lamp(sum, s, lights[tile_records[tile].light[i]]);
}

#define SHADE(index) add_lamp(sum, s, lights[index])
void shade_masked(inout Light2 sum, Surface s, uvec2 pixel, float depth) {
  uint tile = pixel.y / TILE * ((uint(camera.size.x) + TILE - 1u) / TILE) + pixel.x / TILE;
  uint bin = zbins[zbin_of(depth)], lo = bin & 0xFFFFu, hi = bin >> 16;
  if (camera.light_path == LIGHT_PATH_FLAT) {
    lo = 0u;
    hi = MAX_LIGHTS - 1u;
  }
  if (camera.light_path == LIGHT_PATH_SLIDE) {
    FOR_EACH_LIGHT(tile_lights, tile, lo, hi, zbin_mask_slide, SHADE);
  } else {
    FOR_EACH_LIGHT(tile_lights, tile, lo, hi, zbin_mask, SHADE);
  }
}

void shade_lamps(inout Light2 sum, Surface s, uvec2 pixel, float depth) {
  if (camera.light_path == LIGHT_PATH_RECORDS) {
    shade_record(sum, s, pixel);
  } else if (camera.light_path == LIGHT_PATH_ALL) {
    for (uint i = 0u; i < camera.light_count; ++i) add_lamp(sum, s, lights[i]);
  } else {
    shade_masked(sum, s, pixel, depth);
  }
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
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  vec2 at = vec2(pixel) + 0.5;
  float d = texelFetch(depth, pixel, 0).r;
  if (d <= 0.0) {
    bool shown = camera.debug_view == DEBUG_FINAL;
    imageStore(hdr, pixel, vec4(shown ? sky_radiance(normalize(world_ray(at)), true) : vec3(0.0), 1.0));
    return;
  }
  vec4 base = texelFetch(albedo, pixel, 0), m = texelFetch(material, pixel, 0);
  vec3 position = world_position(at, d), n = octahedral_decode(texelFetch(normal, pixel, 0).rg);
  Surface s = make_surface(position, n, normalize(camera.position - position), base.rgb, m.r, m.g);

  Light2 sum = Light2(vec3(0.0), vec3(0.0));
  shade_lamps(sum, s, uvec2(pixel), camera.near / d);
  add_light(sum, s, camera.sun_direction, camera.sun_color * sun_visibility(position, n));
  add_sky(sum, s, m.r, base.a * smooth_occlusion(at * camera.inverse_size));

  vec3 color = sum.diffuse + sum.specular + texelFetch(emissive, pixel, 0).rgb;
  if (camera.debug_view == DEBUG_DIFFUSE) color = sum.diffuse;
  if (camera.debug_view == DEBUG_SPECULAR) color = sum.specular;
  imageStore(hdr, pixel, vec4(color, 1.0));
}
