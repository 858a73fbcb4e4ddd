layout(location = 0) out vec3 weights;
void main() {
  weights = vec3(gl_VertexIndex == 0, gl_VertexIndex == 1, gl_VertexIndex == 2);
  gl_Position = vec4(weights.yz * 4.0 - 1.0, 0.0, 1.0);
}
