#include "shared/light.glsl"

layout(location = 0) in vec3 world;

void main() {
  vec3 sum = view_constants.sun.direction * view_constants.weights[1];
  for (int i = 0; i < LIGHTS; ++i) sum += reach(lights[i], world) * lights[i].suns[1].intensity;
  color = vec4(sum, 1.0) * per_draw.tint * texture(albedo_map, world.xy);
}
