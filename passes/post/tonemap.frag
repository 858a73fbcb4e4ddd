// Exposure, bloom, a filmic curve (Narkowicz 2015), sRGB, and half a step of noise against banding.
const float BLOOM = 0.09;

vec3 film(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }
vec3 to_srgb(vec3 c) { return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))); }
float grain(uvec2 p) { return camera.noise != 0u ? fract(52.9829189 * fract(dot(vec2(p), vec2(0.06711056, 0.00583715)))) - 0.5 : 0.0; }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (camera.debug_view != DEBUG_FINAL) {
    backbuffer = texelFetch(debug_image, pixel, 0);
    return;
  }
  vec3 glow = textureLod(bloom, gl_FragCoord.xy * camera.inverse_size, 0.0).rgb;
  vec3 light = mix(texelFetch(color, pixel, 0).rgb, glow, BLOOM) * exposure[0].scale;
  backbuffer = vec4(to_srgb(film(light)) + grain(uvec2(pixel)) / 255.0, 1.0);
}
