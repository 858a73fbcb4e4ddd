// Between pixels, depth and the world. Needs `params camera`.
const float FAR = 1e30;

float view_depth(float depth) { return depth > 0.0 ? camera.near / depth : FAR; }

vec2 pixel_to_clip(vec2 pixel) { return pixel * camera.inverse_size * 2.0 - 1.0; }

vec3 world_position(vec2 pixel, float depth) {
  vec4 world = camera.clip_to_world * vec4(pixel_to_clip(pixel), depth, 1.0);
  return world.xyz / world.w;
}

// Towards the pixel, from the camera; not of unit length.
vec3 world_ray(vec2 pixel) {
  vec4 near_point = camera.clip_to_world * vec4(pixel_to_clip(pixel), 1.0, 1.0);
  return near_point.xyz / near_point.w - camera.position;
}

// Interleaved gradient noise (Jimenez 2014), another pattern every frame.
float pixel_noise(uvec2 pixel) {
  vec2 p = vec2(pixel) + 5.588238 * float(camera.noise != 0u ? camera.frame & 63u : 0u);
  return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
}
