// The indirect draws of the camera.
bool in_camera(vec3 center, float radius) {
  vec3 c = (camera.world_to_view * vec4(center, 1.0)).xyz;
  if (c.z + radius < camera.near) return false;
  vec2 slope = 1.0 / camera.scale;                       // of the frustum's sides
  vec2 reach = (abs(c.xy) - slope * c.z) * inversesqrt(1.0 + slope * slope);
  return max(reach.x, reach.y) <= radius * 1.01;         // the jitter moves the sides by less than a pixel
}

void element(int at) {
  bool visible = candidate.seen != 0u && in_camera(candidate.center, candidate.radius);
  world_draw = visible ? candidate.draw : DrawArguments(0u, 0u, 0u, 0u);
  if (candidate.draw.instance_count == 0u) return;
  atomicAdd(cull_counts[visible ? COUNT_VISIBLE : COUNT_OUTSIDE], 1u);
  if (visible) atomicAdd(cull_counts[COUNT_TRIANGLES], candidate.draw.vertex_count / 3u);
}
