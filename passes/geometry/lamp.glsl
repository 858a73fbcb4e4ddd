// A lamp's view for its shadow map; passes/lighting/lamp_shadow.glsl reads it so.
const float LAMP_VIEW_NEAR = 0.05;

vec4 lamp_clip(LampView view, vec3 p) {
  vec3 from = p - view.position;
  vec2 across = vec2(dot(from, view.side), dot(from, cross(view.direction, view.side)));
  return vec4(across * view.cot, LAMP_VIEW_NEAR, dot(from, view.direction));
}
