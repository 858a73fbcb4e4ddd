// Slices divide four ranges of depth evenly; the ranges may change from frame to frame.

float cascade_begin(int cascade, float start, vec4 ends) { return cascade == 0 ? start : ends[cascade - 1]; }

// View depth of a place among `slices` slices: 0 is the front of the first one, `slices` the back of the last.
float slice_to_depth(float slice, float slices, float start, vec4 ends) {
  float at = clamp(slice / slices, 0.0, 1.0) * float(FOG_CASCADES);
  int cascade = min(int(at), FOG_CASCADES - 1);
  return mix(cascade_begin(cascade, start, ends), ends[cascade], at - float(cascade));
}

// The inverse; in front of the first slice it is 0, behind the last one `slices`.
float depth_to_slice(float depth, float slices, float start, vec4 ends) {
  int cascade = int(depth >= ends[0]) + int(depth >= ends[1]) + int(depth >= ends[2]);
  float begin = cascade_begin(cascade, start, ends);
  float within = clamp((depth - begin) / (ends[cascade] - begin), 0.0, 1.0);
  return (float(cascade) + within) / float(FOG_CASCADES) * slices;
}
