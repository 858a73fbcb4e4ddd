// One thread a slot: the indirect draws of the camera and of the sun. Culled and unused slots draw no instance.

bool in_camera(vec3 center, float radius) {
  vec3 c = (camera.world_to_view * vec4(center, 1.0)).xyz;
  if (c.z + radius < camera.near) return false;
  vec2 slope = 1.0 / camera.scale;                       // of the frustum's sides
  vec2 reach = (abs(c.xy) - slope * c.z) * inversesqrt(1.0 + slope * slope);
  return max(reach.x, reach.y) <= radius * 1.01;         // the jitter moves the sides by less than a pixel
}

bool in_sun(vec3 center, float radius) {
  vec3 c = (camera.world_to_sun * vec4(center, 1.0)).xyz;
  return max(abs(c.x), abs(c.y)) <= 1.0 + radius * camera.sun_ndc;
}

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= MAX_INSTANCES) return;
  DrawArguments none = DrawArguments(0u, 0u, 0u, 0u);
  if (slot >= camera.instance_count) {
    world_draws[slot] = none;
    sun_draws[slot] = none;
    return;
  }
  Instance instance = instances[slot];
  DrawArguments draw = DrawArguments(instance.index_count, 1u, instance.first_index, slot);
  bool solid = (instance.flags & INSTANCE_GLASS) == 0u;
  bool visible = solid && in_camera(instance.center, instance.radius);
  bool lit = solid && (instance.flags & INSTANCE_SHADOW) != 0u && in_sun(instance.center, instance.radius);
  world_draws[slot] = visible ? draw : none;
  sun_draws[slot] = lit ? draw : none;
  atomicAdd(cull_counts[visible ? COUNT_VISIBLE : COUNT_OUTSIDE], 1u);
  if (lit) atomicAdd(cull_counts[COUNT_SUN], 1u);
  if (visible) atomicAdd(cull_counts[COUNT_TRIANGLES], instance.index_count / 3u);
}
