void main() {
  uint i = gl_LocalInvocationIndex;
  imageStore(lit, ivec2(0), vec4(lamps[i & 3u].rnage * camera.exposure));
}
