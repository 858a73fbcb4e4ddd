void main() {
  float h = texelFetch(height, ivec2(gl_FragCoord.xy), 0).r;
  window = vec4(mix(vec3(0.02, 0.1, 0.3), vec3(0.7, 0.9, 1.0), h * h), 1.0);
}
