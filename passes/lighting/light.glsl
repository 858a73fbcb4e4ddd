// Lamps. Each feature is one plain `if` on `kernel`, a constant: code for features that it leaves out is not there. Needs brdf.glsl, `lights`,
// `albedo_maps`, `lamp_shadow`.
const uint ALL_FEATURES = 0xFFFFFFFFu;
const uint PLAIN_FEATURES = LAMP_ROUND | LAMP_CLIPPED | LAMP_DARK;  // those that look nothing up and are a point

#include "lamp_shadow.glsl"
#include "lamp_shapes.glsl"

bool is_lamp(Light light, uint kernel, uint feature) { return (light.features & (kernel & feature)) != 0u; }
bool is_plain(uint index) { return (lights[index].features & ~PLAIN_FEATURES) == 0u; }

// 1 within the beam, smoothly 0 at its rim.
float round_beam(Light light, vec3 l) {
  float cone = clamp((dot(-l, light.direction) - light.cos_outer) * light.edge, 0.0, 1.0);
  return cone * cone;
}
float square_beam(Light light, LampPoint at) {
  float side = at.along > 0.0 ? clamp((1.0 - max(abs(at.across.x), abs(at.across.y))) * light.edge, 0.0, 1.0) : 0.0;
  return side * side;
}
vec3 projected_picture(Light light, LampPoint at) {
  if (at.along <= 0.0 || max(abs(at.across.x), abs(at.across.y)) >= 1.0) return vec3(0.0);
  return textureLod(albedo_maps, vec3(at.across * 0.5 + 0.5, float(light.picture)), 0.0).rgb;
}

bool is_clipped(Light light, vec3 p) { return min(dot(light.clip[0], vec4(p, 1.0)), dot(light.clip[1], vec4(p, 1.0))) < 0.0; }

// Share of the lamp's light that comes to `p`, which lies in direction `-l` of it, whatever the distance. `off`: unit normal of the surface
// at `p`, by which the point moves before its shadow is looked up; 0 in the open.
vec3 lamp_filter(Light light, uint kernel, vec3 p, vec3 l, vec3 off) {
  vec3 share = vec3(is_lamp(light, kernel, LAMP_DARK) ? -1.0 : 1.0);
  if (is_lamp(light, kernel, LAMP_CLIPPED) && is_clipped(light, p)) share = vec3(0.0);
  if (is_lamp(light, kernel, LAMP_ROUND)) share *= round_beam(light, l);
  if (is_lamp(light, kernel, LAMP_SQUARE | LAMP_PROJECTED)) {
    LampPoint at = lamp_point(light, p);
    if (is_lamp(light, kernel, LAMP_SQUARE)) share *= square_beam(light, at);
    if (is_lamp(light, kernel, LAMP_PROJECTED)) share *= projected_picture(light, at);
  }
  if (is_lamp(light, kernel, LAMP_SHADOW)) share *= lamp_visibility(light, p, off, is_lamp(light, kernel, LAMP_SOFT));
  return share;
}

void add_lamp(inout Light2 sum, Surface s, Light light, uint kernel) {
  vec3 to = light.position - s.position;
  float d2 = dot(to, to);
  if (d2 >= light.range * light.range) return;
  vec3 l = to * inversesqrt(max(d2, 1e-8));
  vec3 color = light.color * lamp_filter(light, kernel, s.position, l, s.normal);
  if (is_lamp(light, kernel, LAMP_AREA)) {
    add_area(sum, s, light, to, color * range_window(d2, light.range));
  } else if (is_lamp(light, kernel, LAMP_TUBE)) {
    add_tube(sum, s, light, to, color * range_window(d2, light.range));
  } else {
    add_light(sum, s, l, color * falloff(d2, light.range));
  }
}

// Irradiance on something small that is lit from all sides, like a drop of fog.
vec3 lamp_irradiance(Light light, uint kernel, vec3 p) {
  vec3 to = light.position - p;
  float d2 = dot(to, to);
  if (d2 >= light.range * light.range) return vec3(0.0);
  vec3 l = to * inversesqrt(max(d2, 1e-8));
  vec3 color = light.color * lamp_filter(light, kernel, p, l, vec3(0.0)) * range_window(d2, light.range);
  if (is_lamp(light, kernel, LAMP_AREA)) return color * area_irradiance(light, to);
  if (is_lamp(light, kernel, LAMP_TUBE)) return color * tube_irradiance(light, to);
  return color / (d2 + LAMP_SIZE2);
}
