// What the draw of each slot would be, and the sphere it lies in. Glass is drawn elsewhere; unused slots draw no instance.
void element(int at) {
  candidate = Candidate(DrawArguments(0u, 0u, 0u, 0u), vec3(0.0), 0.0, 0u, 0u);
  if (uint(at) >= camera.instance_count) return;
  Instance instance = instances[at];
  bool solid = (instance.flags & INSTANCE_GLASS) == 0u, casts = (instance.flags & INSTANCE_SHADOW) != 0u;
  candidate = Candidate(DrawArguments(instance.index_count, 1u, instance.first_index, uint(at)), instance.center, instance.radius, uint(solid),
                        uint(solid && casts));
}
