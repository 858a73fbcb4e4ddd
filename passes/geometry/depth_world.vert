#include "pull.glsl"
invariant gl_Position;

void main() {
  vec3 world = place(instances[gl_InstanceIndex].model, pull_vertex(gl_VertexIndex).position);
  gl_Position = camera.world_to_clip * vec4(world, 1.0);
}
