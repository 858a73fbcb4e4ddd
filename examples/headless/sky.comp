void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(hdr);
  if (any(greaterThanEqual(at, size))) return;
  vec2 uv = (vec2(at) + 0.5) / vec2(size);
  float glare = 0.02 / (0.001 + distance(uv, camera.sun));
  float band = floor(uv.y * float(camera.bands)) / float(camera.bands);
  imageStore(hdr, at, vec4(mix(vec3(0.9, 0.7, 0.5), vec3(0.2, 0.3, 0.6), band) + glare, 1.0));
}
