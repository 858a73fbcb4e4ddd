void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  vec2 size = vec2(imageSize(target));
  if (any(greaterThanEqual(texel, imageSize(target)))) return;
  imageStore(target, texel, textureLod(source, (vec2(texel) + blur.radius) / size, 0.0));
}
