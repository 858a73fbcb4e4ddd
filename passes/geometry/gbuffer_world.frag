#include "passes/view/octahedral.glsl"
#include "velocity.glsl"

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;
layout(location = 2) in vec3 in_uv_sky;
layout(location = 3) in vec4 in_now;
layout(location = 4) in vec4 in_before;
layout(location = 5) flat in uint in_material;

void main() {
  Material m = materials[in_material];
  vec4 base = texture(albedo_maps, vec3(in_uv_sky.xy, float(m.albedo_layer))) * m.base_color;
  vec4 surface = texture(surface_maps, vec3(in_uv_sky.xy, float(m.surface_layer)));

  vec3 n = normalize(in_normal);
  vec3 t = normalize(in_tangent.xyz - n * dot(n, in_tangent.xyz));
  vec3 b = cross(n, t) * in_tangent.w;
  vec2 bump = (surface.rg * 2.0 - 1.0) * m.bump;
  vec3 shaded = normalize(n * sqrt(max(1.0 - dot(bump, bump), 0.05)) + t * bump.x + b * bump.y);

  albedo = vec4(base.rgb, in_uv_sky.z);
  normal = octahedral_encode(shaded).xyxy;
  material = vec4(clamp(m.roughness * surface.b, 0.05, 1.0), clamp(m.metallic * surface.a, 0.0, 1.0), 0.0, 0.0);
  emissive = vec4(m.emissive * base.rgb, 0.0);
  velocity = screen_velocity(in_now, in_before).xyxy;
}
