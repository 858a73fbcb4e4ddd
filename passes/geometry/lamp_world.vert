#include "pull.glsl"
#include "lamp.glsl"

// The instance's number carries the map's: every map has its own stretch of the draws.
void main() {
  uint slot = gl_InstanceIndex / uint(MAX_INSTANCES), instance = gl_InstanceIndex % uint(MAX_INSTANCES);
  vec3 world = place(instances[instance].model, pull_vertex(gl_VertexIndex).position);
  gl_Position = lamp_clip(lamps.view[slot], world);
}
