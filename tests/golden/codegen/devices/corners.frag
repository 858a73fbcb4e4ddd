#if FEATURE_corners
#extension GL_EXT_fragment_shader_barycentric : require
#else
layout(location = 0) in vec3 weights;
#endif
void main() {
#if FEATURE_corners
  out_color = vec4(gl_BaryCoordEXT, 1);
#else
  out_color = vec4(weights, 1);
#endif
}
