// Last frame's fog where this froxel was; negative in `a` where it was not in view. Needs froxel.glsl and `memory_prev`.
vec4 remember(vec3 cell) {
  vec4 clip = camera.previous_to_clip * vec4(view_to_world(froxel_to_view(cell)), 1.0);
  vec2 at = clip.xy / clip.w * 0.5 + 0.5;
  bool outside = clip.w <= 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)));
  if (outside || clip.w > fog.previous_ends.w) return vec4(-1.0);
  float slice = depth_to_slice(clip.w, fog.count.z, fog.previous_start, fog.previous_ends);
  return textureLod(memory_prev, vec3(at, slice / fog.count.z), 0.0);
}

// Texels at the border of what is known are mixed with -1, and so are not used.
vec4 settle(vec4 now, vec4 before) { return before.a < 0.0 ? now : mix(before, now, fog.blend); }
