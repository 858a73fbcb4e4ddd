// Shadow maps of lamps: one layer each, a perspective view along the lamp's direction, depth LAMP_NEAR / distance along it.
const float LAMP_NEAR = 0.05;
const float LAMP_BIAS = 0.008;  // of the distance
const int SOFT_TAPS = 16;  // loops of a variable length: software devices run every branch

struct LampPoint { float along; vec2 across; };  // distance along the lamp's direction; -1 .. 1 within its sides
LampPoint lamp_point(Light light, vec3 p) {
  vec3 from = p - light.position;
  float along = dot(from, light.direction);
  vec2 across = vec2(dot(from, light.side), dot(from, cross(light.direction, light.side)));
  return LampPoint(along, across * (light.cot / max(along, 1e-3)));
}

float lamp_texel(uint layer, ivec2 at, int size) { return texelFetch(lamp_shadow, ivec3(clamp(at, ivec2(0), ivec2(size - 1)), layer), 0).r; }

// Four compares, weighted bilinearly. `at` in texels.
float lamp_compare(uint layer, vec2 at, float depth, int size) {
  vec2 base = floor(at - 0.5), f = at - 0.5 - base;
  ivec2 t = ivec2(base);
  float top = mix(float(depth >= lamp_texel(layer, t, size)), float(depth >= lamp_texel(layer, t + ivec2(1, 0), size)), f.x);
  float bottom = mix(float(depth >= lamp_texel(layer, t + ivec2(0, 1), size)), float(depth >= lamp_texel(layer, t + ivec2(1, 1), size)), f.x);
  return mix(top, bottom, f.y);
}

// Evenly over a unit disc (Vogel 1979).
vec2 disc(int i) {
  float angle = float(i) * 2.39996323;
  return vec2(cos(angle), sin(angle)) * sqrt((float(i) + 0.5) / float(SOFT_TAPS));
}

// Mean distance of what is nearer to the lamp than `depth` says, out of `taps` places within `reach` texels; 0 where nothing is.
float mean_blocker(uint layer, vec2 texel, float reach, float depth, int size, int taps) {
  float sum = 0.0, found = 0.0;
  for (int i = 0; i < taps; ++i) {
    float blocker = lamp_texel(layer, ivec2(floor(texel + disc(i) * reach)), size);
    if (blocker > depth) {
      sum += LAMP_NEAR / blocker;
      found += 1.0;
    }
  }
  return found > 0.0 ? sum / found : 0.0;
}

// Share of the lamp that is seen. Soft lamps have a penumbra as wide as the lamp seen past the mean blocker (Fernando 2005); hard ones are soft ones
// of no size, with one tap. `off`: unit normal of a surface at `p`, 0 in the open.
float lamp_visibility(Light light, vec3 p, vec3 off, bool soft) {
  int size = textureSize(lamp_shadow, 0).x, taps = soft ? SOFT_TAPS : 1;
  float width = 2.0 * max(dot(p - light.position, light.direction), 0.0) / (light.cot * float(size));  // of a texel at the point
  LampPoint at = lamp_point(light, p + off * (1.5 * width));
  vec2 texel = (at.across * 0.5 + 0.5) * float(size);
  float along = max(at.along, LAMP_NEAR), depth = LAMP_NEAR / (along * (1.0 - LAMP_BIAS)), sum = 0.0;
  float reach = 0.5 * light.size.x * light.cot / along * float(size);  // of the lamp's disc, in texels at the point's distance
  float blocker = mean_blocker(light.shadow, texel, reach, depth, size, soft ? SOFT_TAPS : 0);
  float radius = blocker > 0.0 ? (along - blocker) / blocker * reach : 0.0;
  for (int i = 0; i < taps; ++i) sum += lamp_compare(light.shadow, texel + disc(i) * radius, depth, size);
  return at.along > LAMP_NEAR ? sum / float(taps) : 0.0;
}
