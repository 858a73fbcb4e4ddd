// Lamps with an extent: capsules and rectangles.
const float LAMP_SIZE2 = 0.01;  // square of the radius below which a lamp grows no brighter, metres

// Exactly zero from the range on (Karis 2013).
float range_window(float distance2, float range) {
  float x = distance2 / (range * range);
  float window = max(1.0 - x * x, 0.0);
  return window * window;
}
float falloff(float distance2, float range) { return range_window(distance2, range) / (distance2 + LAMP_SIZE2); }

// ---- capsule: every part of its axis shines alike. Diffuse: the integral of cosine / distance squared over the axis. Specular: the point of
// the capsule nearest to the mirrored ray, in a lobe wider by the angle that the lamp fills (Karis 2013).

struct TubeEnds { vec3 a, b; float lengths; };  // seen from the point; product of the distances
TubeEnds tube_ends(Light light, vec3 to) {
  vec3 half_axis = light.side * light.size.x;
  TubeEnds t = TubeEnds(to - half_axis, to + half_axis, 0.0);
  t.lengths = sqrt(dot(t.a, t.a) * dot(t.b, t.b));
  return t;
}
float tube_spread(TubeEnds t) { return 1.0 / (0.5 * (t.lengths + dot(t.a, t.b)) + LAMP_SIZE2); }
float tube_irradiance(Light light, vec3 to) { return tube_spread(tube_ends(light, to)); }

vec3 tube_point(TubeEnds t, vec3 mirrored, float radius) {
  vec3 axis = t.b - t.a;
  float along = dot(mirrored, axis);
  float at = (dot(mirrored, t.a) * along - dot(t.a, axis)) / max(dot(axis, axis) - along * along, 1e-8);
  vec3 p = t.a + axis * clamp(at, 0.0, 1.0), aside = dot(p, mirrored) * mirrored - p;
  return p + aside * clamp(radius * inversesqrt(max(dot(aside, aside), 1e-8)), 0.0, 1.0);
}

void add_tube(inout Light2 sum, Surface s, Light light, vec3 to, vec3 color) {
  TubeEnds t = tube_ends(light, to);
  float cosine = 0.5 * (dot(s.normal, t.a) * inversesqrt(max(dot(t.a, t.a), 1e-8)) + dot(s.normal, t.b) * inversesqrt(max(dot(t.b, t.b), 1e-8)));
  sum.diffuse += s.diffuse * color * (max(cosine, 0.0) * tube_spread(t) / PI);

  vec3 p = tube_point(t, reflect(-s.eye, s.normal), light.size.y);
  float p2 = dot(p, p), n_p = dot(s.normal, p) * inversesqrt(max(p2, 1e-8));
  if (n_p <= 0.0) return;
  vec3 l = p * inversesqrt(max(p2, 1e-8));
  float distance = sqrt(p2 + LAMP_SIZE2);
  float sphere = min(s.alpha + light.size.y / (3.0 * distance), 1.0), line = min(s.alpha + light.size.x / (3.0 * distance), 1.0);
  float spread = s.alpha * s.alpha * s.alpha / (sphere * sphere * line);
  sum.specular += specular_lobe(s, l, n_p, s.alpha) * color * (spread / (p2 + LAMP_SIZE2));
}

// ---- rectangle that shines forwards. Diffuse: its solid angle times the mean cosine of corners and middle (Lagarde and de Rousiers 2014). Specular:
// where the mirrored ray meets it. What it shows is read at a level as blurred as the light is.

struct AreaCorners { vec3 p[4]; float angle; };  // directions from the point, solid angle
float triangle_angle(vec3 a, vec3 b, vec3 c) {  // Van Oosterom and Strackee 1983
  return 2.0 * atan(abs(dot(a, cross(b, c))), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}
AreaCorners area_corners(Light light, vec3 to) {
  vec3 u = light.side * light.size.x, v = cross(light.direction, light.side) * light.size.y;
  AreaCorners r;
  r.p[0] = normalize(to - u - v);
  r.p[1] = normalize(to + u - v);
  r.p[2] = normalize(to + u + v);
  r.p[3] = normalize(to - u + v);
  r.angle = triangle_angle(r.p[0], r.p[1], r.p[2]) + triangle_angle(r.p[0], r.p[2], r.p[3]);
  return r;
}

// `at`: place on the rectangle relative to its middle, metres; `blur`: width of what is looked at, metres.
vec3 area_picture(Light light, vec2 at, float blur) {
  float level = clamp(log2(float(TEXTURE_SIZE) * blur / (2.0 * min(light.size.x, light.size.y))), 0.0, float(TEXTURE_MIPS - 1));
  vec2 uv = clamp(at / light.size, vec2(-1.0), vec2(1.0)) * 0.5 + 0.5;
  return textureLod(albedo_maps, vec3(uv, float(light.picture)), level).rgb;
}
vec2 on_area(Light light, vec3 p) { return vec2(dot(p, light.side), dot(p, cross(light.direction, light.side))); }

void add_area(inout Light2 sum, Surface s, Light light, vec3 to, vec3 color) {
  float behind = dot(to, light.direction);
  if (behind >= 0.0) return;
  AreaCorners r = area_corners(light, to);
  vec3 middle = normalize(to);
  float cosines = max(dot(s.normal, middle), 0.0);
  for (int i = 0; i < 4; ++i) cosines += max(dot(s.normal, r.p[i]), 0.0);
  vec3 shown = area_picture(light, on_area(light, -to), -2.0 * behind);
  sum.diffuse += s.diffuse * color * shown * (r.angle * 0.2 * cosines / PI);

  vec3 mirrored = reflect(-s.eye, s.normal);
  float facing = dot(mirrored, light.direction);
  vec3 hit = facing < -1e-3 ? mirrored * (behind / facing) - to : -to;
  vec2 at = clamp(on_area(light, hit), -light.size, light.size);
  vec3 p = to + light.side * at.x + cross(light.direction, light.side) * at.y;
  vec3 l = normalize(p);
  float n_l = dot(s.normal, l);
  if (n_l <= 0.0) return;
  float wide = min(s.alpha + 0.5 * sqrt(r.angle / PI), 1.0), spread = s.alpha / wide;
  sum.specular += specular_lobe(s, l, n_l, s.alpha) * color * area_picture(light, at, 2.0 * s.alpha * length(p)) * (r.angle * spread * spread);
}

vec3 area_irradiance(Light light, vec3 to) {
  if (dot(to, light.direction) >= 0.0) return vec3(0.0);
  return area_picture(light, vec2(0.0), 1e3) * area_corners(light, to).angle;
}
