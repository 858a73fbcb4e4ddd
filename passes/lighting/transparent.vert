#include "passes/geometry/pull.glsl"

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;

void main() {
  Instance instance = instances[per_draw.instance];
  Vertex vertex = pull_vertex(gl_VertexIndex);
  out_position = place(instance.model, vertex.position);
  out_normal = turn(instance.model, vertex.normal);
  out_uv = vec2(vertex.u, vertex.v);
  gl_Position = camera.world_to_clip * vec4(out_position, 1.0);
}
