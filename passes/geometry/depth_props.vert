#include "props.glsl"
invariant gl_Position;

void main() {
  vec3 world = place_prop(per_draw.model, swing_point(position, part, per_draw.swing));
  gl_Position = camera.world_to_clip * vec4(world, 1.0);
}
