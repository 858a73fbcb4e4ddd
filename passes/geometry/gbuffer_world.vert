#include "pull.glsl"
invariant gl_Position;

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_tangent;
layout(location = 2) out vec3 out_uv_sky;
layout(location = 3) out vec4 out_now;
layout(location = 4) out vec4 out_before;
layout(location = 5) flat out uint out_material;

void main() {
  Instance instance = instances[gl_InstanceIndex];
  Vertex vertex = pull_vertex(gl_VertexIndex);
  vec3 world = place(instance.model, vertex.position);
  gl_Position = camera.world_to_clip * vec4(world, 1.0);
  out_normal = turn(instance.model, vertex.normal);
  out_tangent = vec4(turn(instance.model, vertex.tangent.xyz), vertex.tangent.w < 0.0 ? -1.0 : 1.0);
  out_uv_sky = vec3(vertex.u, vertex.v, abs(vertex.tangent.w));
  out_now = camera.steady_to_clip * vec4(world, 1.0);
  out_before = camera.previous_to_clip * vec4(place(instance.previous, vertex.position), 1.0);
  out_material = instance.material;
}
