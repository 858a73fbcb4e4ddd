// One thread an instance and shadow map: indirect draws of what casts a shadow within the lamp's range.
void main() {
  uint slot = gl_GlobalInvocationID.y, index = gl_GlobalInvocationID.x;
  if (index >= MAX_INSTANCES || slot >= MAX_LAMP_SHADOWS) return;
  LampView view = lamps.view[slot];
  DrawArguments draw = DrawArguments(0u, 0u, 0u, 0u);
  if (index < camera.instance_count && view.used != 0u) {
    Instance instance = instances[index];
    vec3 from = instance.center - view.position;
    bool casts = (instance.flags & (INSTANCE_SHADOW | INSTANCE_GLASS)) == INSTANCE_SHADOW;
    float along = dot(from, view.direction), reach = sqrt(1.0 + view.cot * view.cot);
    vec2 across = abs(vec2(dot(from, view.side), dot(from, cross(view.direction, view.side))));
    bool within = max(across.x, across.y) * view.cot - along <= instance.radius * reach;  // of the four sides
    if (casts && within && length(from) <= view.range + instance.radius && along + instance.radius > 0.0)
      draw = DrawArguments(instance.index_count, 1u, instance.first_index, slot * MAX_INSTANCES + index);
  }
  lamp_draws[slot * MAX_INSTANCES + index] = draw;
}
