#include "passes/view/octahedral.glsl"
#include "velocity.glsl"

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_color;
layout(location = 2) in vec3 in_surface;
layout(location = 3) in vec4 in_now;
layout(location = 4) in vec4 in_before;

void main() {
  vec3 n = normalize(in_normal);
  albedo = in_color;
  normal = octahedral_encode(gl_FrontFacing ? n : -n).xyxy;
  material = vec4(clamp(in_surface.r, 0.05, 1.0), in_surface.g, 0.0, 0.0);
  emissive = vec4(in_color.rgb * in_surface.b * 8.0, 0.0);
  velocity = screen_velocity(in_now, in_before).xyxy;
}
