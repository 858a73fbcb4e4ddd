// One channel of the frame, made visible. Nothing in the final view.
#include "passes/view/octahedral.glsl"
#include "passes/view/view.glsl"
#include "passes/culling/zbin.glsl"
#include "passes/fog/froxel.glsl"
#include "passes/fog/apply.glsl"

// Black, blue, green, yellow, red, white.
vec3 heat(float x) {
  x = clamp(x, 0.0, 1.0) * 5.0;
  vec3 c = clamp(vec3(x - 2.0, x < 3.0 ? x - 1.0 : 4.0 - x, x < 2.0 ? x : 3.0 - x), 0.0, 1.0);
  return x > 4.0 ? mix(vec3(1.0, 0.0, 0.0), vec3(1.0), x - 4.0) : c;
}

uint count_lights(uvec2 pixel, bool forward) {
  uint tile = pixel.y / TILE * ((uint(camera.size.x) + TILE - 1u) / TILE) + pixel.x / TILE, count = 0u;
  for (uint w = 0u; w < LIGHT_WORDS; ++w)
    count += bitCount(forward ? forward_lights[tile * LIGHT_WORDS + w] : tile_lights[tile * LIGHT_WORDS + w]);
  return count;
}

uint record_of(uvec2 pixel) {
  uint tiles = (uint(camera.size.x) + SHADE_TILE - 1u) / SHADE_TILE;
  return pixel.y / SHADE_TILE * tiles + pixel.x / SHADE_TILE;
}

vec3 record_view(uvec2 pixel) {
  uint tile = record_of(pixel);
  vec3 fill = vec3(0.0, float(tile_records[tile].count) / float(MAX_TILE_LIGHTS), 0.15);
  return tile_records[tile].overflow > 0u ? vec3(1.0, 0.1, 0.0) : fill;
}

vec3 zbin_view(float d) {
  uint bin = zbins[zbin_of(view_depth(d))], lo = bin & 0xFFFFu, hi = bin >> 16;
  return lo > hi ? vec3(0.0) : heat(float(hi - lo + 1u) / float(max(camera.light_count, 1u)));
}

vec3 lit_view(vec3 light) { return pow(light / (light + 0.6), vec3(1.0 / 2.2)); }

// A colour a kernel, hues a golden angle apart, over the picture.
vec3 kernel_view(ivec2 pixel) {
  uint kernel = imageLoad(tile_kernels, pixel / SHADE_TILE).r;
  vec3 hue = clamp(abs(fract(float(kernel) * 0.618034 + vec3(0.6, 0.93, 0.27)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  float lit = dot(lit_view(texelFetch(hdr, pixel, 0).rgb), vec3(0.2, 0.7, 0.1));
  bool rim = any(equal(pixel % SHADE_TILE, ivec2(0)));
  return hue * (rim ? 0.3 : 0.4) + 0.6 * lit;
}

vec3 channel(ivec2 pixel) {
  float d = texelFetch(depth, pixel, 0).r;
  switch (camera.debug_view) {
    case DEBUG_LIGHTS: return heat(float(count_lights(uvec2(pixel), false)) / 64.0);
    case DEBUG_FORWARD: return heat(float(count_lights(uvec2(pixel), true)) / 64.0);
    case DEBUG_ALBEDO: return pow(texelFetch(albedo, pixel, 0).rgb, vec3(1.0 / 2.2));
    case DEBUG_NORMAL: return d > 0.0 ? octahedral_decode(texelFetch(normal, pixel, 0).rg) * 0.5 + 0.5 : vec3(0.0);
    case DEBUG_DEPTH: return vec3(d > 0.0 ? 1.0 - exp2(-view_depth(d) / 12.0) : 1.0);
    case DEBUG_ROUGHNESS: return texelFetch(material, pixel, 0).rrr;
    case DEBUG_METALLIC: return texelFetch(material, pixel, 0).ggg;
    case DEBUG_DIFFUSE:
    case DEBUG_SPECULAR: return lit_view(texelFetch(hdr, pixel, 0).rgb);
    case DEBUG_EMISSIVE: return lit_view(texelFetch(emissive, pixel, 0).rgb);
    case DEBUG_OVERFLOW: return record_view(uvec2(pixel));
    case DEBUG_ZBIN: return zbin_view(d);
    case DEBUG_OCCLUSION: return textureLod(occlusion, (vec2(pixel) + 0.5) * camera.inverse_size, 0.0).rrr * texelFetch(albedo, pixel, 0).a;
    case DEBUG_VELOCITY: return vec3(texelFetch(velocity, pixel, 0).rg * 20.0 + 0.5, 0.5);
    case DEBUG_FOG: return lit_view(fog_light((vec2(pixel) + 0.5) * camera.inverse_size, view_depth(d)));
    case DEBUG_THROUGH: return vec3(fog_transmittance((vec2(pixel) + 0.5) * camera.inverse_size, view_depth(d)));
    case DEBUG_FEATURES: return heat(float(bitCount(tile_features[record_of(uvec2(pixel))])) / float(LAMP_FEATURES));
    case DEBUG_KERNELS: return kernel_view(pixel);
    default: return vec3(0.0);
  }
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  imageStore(debug_image, pixel, vec4(channel(pixel), 1.0));
}
