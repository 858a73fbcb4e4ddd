// Sphere and cone of a light against the part of the frustum that a tile sees.
#include "cone.glsl"

struct TileVolume {  // view space
  vec4 slopes;       // x/z at the left and right side, y/z at the top and bottom
  vec4 lengths;      // of the sides' normals (1, slope), inverted
  float near, far;
  vec3 center;       // of a sphere around it
  float radius;
};

TileVolume tile_volume(vec2 first_pixel, vec2 end_pixel, float near, float far) {
  TileVolume t;
  vec4 clip = vec4(first_pixel, end_pixel) * camera.inverse_size.xyxy * 2.0 - 1.0;
  t.slopes = ((clip - camera.jitter.xyxy) / camera.scale.xyxy).xzyw;
  t.lengths = inversesqrt(1.0 + t.slopes * t.slopes);
  t.near = near;
  t.far = far;
  float back = min(far, 1e4);
  vec2 middle = 0.5 * (t.slopes.xz + t.slopes.yw);
  t.center = vec3(middle, 1.0) * (0.5 * (near + back));
  vec3 corner = vec3(t.slopes.yw, 1.0) * back, front = vec3(t.slopes.xz, 1.0) * near;
  vec3 corner2 = vec3(t.slopes.xz, 1.0) * back, corner3 = vec3(t.slopes.yz, 1.0) * back, corner4 = vec3(t.slopes.xw, 1.0) * back;
  t.radius = max(max(max(distance(corner, t.center), distance(corner2, t.center)), max(distance(corner3, t.center), distance(corner4, t.center))),
                 distance(front, t.center)) * 1.001;
  t.radius = max(t.radius, max(distance(vec3(t.slopes.yw, 1.0) * near, t.center), distance(vec3(t.slopes.yz, 1.0) * near, t.center)) * 1.001);
  t.radius = max(t.radius, distance(vec3(t.slopes.xw, 1.0) * near, t.center) * 1.001);
  return t;
}

bool sphere_reaches(TileVolume t, vec3 c, float r) {
  if (c.z - r > t.far || c.z + r < t.near) return false;
  vec4 outside = vec4(t.slopes.x * c.z - c.x, c.x - t.slopes.y * c.z, t.slopes.z * c.z - c.y, c.y - t.slopes.w * c.z) * t.lengths;
  return max(max(outside.x, outside.y), max(outside.z, outside.w)) <= r;
}

const float CULL_MARGIN = 1.0005;  // rounding; metres for metres

bool light_reaches(TileVolume t, Light light) {
  vec3 c = (camera.world_to_view * vec4(light.position, 1.0)).xyz;
  if (!sphere_reaches(t, c, light.range * CULL_MARGIN + 1e-3)) return false;
  if ((light.features & (LAMP_ROUND | LAMP_SQUARE)) == 0u) return true;
  vec3 axis = (camera.world_to_view * vec4(light.direction, 0.0)).xyz;
  return cone_reaches(c, axis, light.range, light.cos_outer, light.sin_outer, t.center, t.radius * CULL_MARGIN + 1e-3);
}
