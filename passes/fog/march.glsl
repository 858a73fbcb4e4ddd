// Needs froxel.glsl.

// (1 - exp(-x)) / x, which loses its digits near 0.
float absorbed_share(float x) { return x < 1e-3 ? 1.0 - x * (0.5 - x * (1.0 / 6.0)) : (1.0 - exp(-x)) / x; }

Stretch make_stretch(vec3 inscatter, float extinction, float metres) {
  float thickness = extinction * metres;
  return Stretch(inscatter * (metres * absorbed_share(thickness)), exp(-thickness));
}

// `near` in front of `far`; associative.
Stretch join(Stretch near, Stretch far) { return Stretch(near.light + near.through * far.light, near.through * far.through); }

// Of a slice, seen along its column.
Stretch slice_stretch(vec4 media, int slice, float slant) {
  float begin = slice_to_depth(float(slice), fog.count.z, fog.start, fog.ends);
  float end = slice_to_depth(float(slice + 1), fog.count.z, fog.start, fog.ends);
  return make_stretch(media.rgb, media.a, (end - begin) * slant);
}
float column_slant(ivec2 column) { return length(froxel_ray((vec2(column) + 0.5) / fog.count.xy)); }
