#include "passes/view/octahedral.glsl"
#include "props.glsl"
invariant gl_Position;

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_color;
layout(location = 2) out vec3 out_surface;
layout(location = 3) out vec4 out_now;
layout(location = 4) out vec4 out_before;

void main() {
  vec3 world = place_prop(per_draw.model, swing_point(position, part, per_draw.swing));
  vec3 local_normal = octahedral_decode(unpackUnorm2x16(normal));
  gl_Position = camera.world_to_clip * vec4(world, 1.0);
  out_normal = vec4(swing_point(local_normal, part, per_draw.swing), 0.0) * per_draw.model;
  out_color = vec4(unpackUnorm4x8(color).rgb * per_draw.tint, per_draw.sky);
  out_surface = unpackUnorm4x8(surface).rgb;
  out_now = camera.steady_to_clip * vec4(world, 1.0);
  out_before = camera.previous_to_clip * vec4(place_prop(per_draw.previous, swing_point(position, part, per_draw.swing_before)), 1.0);
}
