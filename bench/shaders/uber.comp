// Tiled shading with eight features. Each is a constant of the variant, tested by an ordinary `if`.
const float kPi = 3.14159265358979;
const float kInversePi = 1.0 / kPi;

shared uint tile_near, tile_far, tile_count;
shared uint tile_lamps[TILE_LAMPS];
shared vec4 tile_planes[4];

struct Material {
  vec3 position, normal, eye, albedo, f0;
  float roughness, alpha2, metallic, thin, cloth, view_depth;
};

// ---- numbers that look random

uint scramble(uint x) {
  x = (x ^ (x >> 17)) * 0xed5ad4bbu;
  x = (x ^ (x >> 11)) * 0xac4c1b51u;
  x = (x ^ (x >> 15)) * 0x31848babu;
  return x ^ (x >> 14);
}

float noise_of(uvec2 pixel, uint salt) { return float(scramble(pixel.x + scramble(pixel.y + scramble(salt))) >> 8) / 16777216.0; }

float gradient_noise(vec2 at) { return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715)))); }

vec2 spiral(int i, float turn) {
  float radius = sqrt((float(i) + 0.5) / float(SHADOW_TAPS)), angle = float(i) * 2.39996323 + turn;
  return radius * vec2(cos(angle), sin(angle));
}

// ---- places

vec3 unfold(vec2 packed) {
  vec2 e = packed * 2.0 - 1.0;
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  float fold = max(-n.z, 0.0);
  n.x -= n.x >= 0.0 ? fold : -fold;
  n.y -= n.y >= 0.0 ? fold : -fold;
  return normalize(n);
}

vec3 world_from(vec2 uv, float d) {
  vec4 p = scene.clip_to_world * vec4(uv * 2.0 - 1.0, d, 1.0);
  return p.xyz / p.w;
}

float eye_depth(float d) { return scene.projection[3][2] / (d + scene.projection[2][2]); }

// ---- reflection

float ggx(float n_h, float alpha2) {
  float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
  return alpha2 * kInversePi / max(d * d, 1e-6);
}

float visibility(float n_l, float n_v, float roughness) {
  float toward = n_v * (n_l * (1.0 - roughness) + roughness);
  float back = n_l * (n_v * (1.0 - roughness) + roughness);
  return 0.5 / max(toward + back, 1e-5);
}

vec3 fresnel(vec3 f0, float v_h) {
  float grazing = 1.0 - v_h, squared = grazing * grazing;
  return f0 + (1.0 - f0) * squared * squared * grazing;
}

// Charlie's distribution with Neubelt's visibility: cloth.
float cloth_term(float n_h, float n_l, float n_v, float roughness) {
  float inverse = 1.0 / max(roughness, 0.07);
  float sine = sqrt(max(1.0 - n_h * n_h, 0.0078125));
  float distribution = (2.0 + inverse) * pow(sine, inverse) * 0.5 * kInversePi;
  return distribution / (4.0 * max(n_l + n_v - n_l * n_v, 1e-4));
}

vec3 reflectance(Material m, vec3 to_light, out float n_l) {
  n_l = clamp(dot(m.normal, to_light), 0.0, 1.0);
  vec3 middle = normalize(m.eye + to_light);
  float n_h = clamp(dot(m.normal, middle), 0.0, 1.0);
  float n_v = clamp(dot(m.normal, m.eye), 1e-4, 1.0);
  float v_h = clamp(dot(m.eye, middle), 0.0, 1.0);
  vec3 mirror = fresnel(m.f0, v_h);
  vec3 diffuse = (1.0 - mirror) * (1.0 - m.metallic) * m.albedo * kInversePi;
  vec3 sum = diffuse + ggx(n_h, m.alpha2) * visibility(n_l, n_v, m.roughness) * mirror;
  if (sheen) sum = sum * (1.0 - 0.5 * m.cloth) + m.cloth * cloth_term(n_h, n_l, n_v, m.roughness) * sqrt(m.albedo);
  return sum;
}

// ---- shadows

int cascade_of(float z) { return int(z > 8.0) + int(z > 24.0) + int(z > 64.0); }

vec3 shadow_place(Material m, int cascade) {
  vec4 p = scene.shadow_clip[cascade] * vec4(m.position + m.normal * 0.02 * float(cascade + 1), 1.0);
  return vec3(p.xy / p.w * 0.5 + 0.5, p.z / p.w);
}

float hard_shadow(vec3 place, int cascade) { return texture(shadow, vec4(place.xy, float(cascade), place.z - 0.001)); }

float soft_shadow(vec3 place, int cascade, vec2 pixel) {
  float turn = gradient_noise(pixel) * 2.0 * kPi, sum = 0.0;
  for (int i = 0; i < SHADOW_TAPS; ++i) sum += hard_shadow(place + vec3(spiral(i, turn) * 0.0015, 0.0), cascade);
  return sum / float(SHADOW_TAPS);
}

float sun_shadow(Material m, vec2 pixel) {
  int cascade = cascade_of(m.view_depth);
  vec3 place = shadow_place(m, cascade);
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
  if (soft_shadows) return soft_shadow(place, cascade, pixel);
  return hard_shadow(place, cascade);
}

// ---- light from everywhere

vec3 sky_irradiance(vec3 n) {
  vec3 sum = scene.sky[0].rgb * 0.886227;
  sum += 1.023328 * (scene.sky[1].rgb * n.y + scene.sky[2].rgb * n.z + scene.sky[3].rgb * n.x);
  sum += 0.858086 * (scene.sky[4].rgb * n.x * n.y + scene.sky[5].rgb * n.y * n.z + scene.sky[7].rgb * n.x * n.z);
  sum += 0.247708 * scene.sky[6].rgb * (3.0 * n.z * n.z - 1.0);
  sum += 0.429043 * scene.sky[8].rgb * (n.x * n.x - n.y * n.y);
  return max(sum, vec3(0.0));
}

vec3 add_haze(vec3 color, vec2 uv, float z) {
  float slice = log2(max(z, scene.haze.x) / scene.haze.x) / scene.haze.y;
  vec4 medium = textureLod(haze, vec3(uv, slice), 0.0);
  return color * medium.a + medium.rgb;
}

// ---- rain: puddles where the ground is level, ripples in them

vec2 ripple(vec2 at, float time) {
  vec2 cell = floor(at), inside = fract(at) - 0.5;
  float phase = fract(noise_of(uvec2(ivec2(cell)), 7u) + time);
  float distance_to_ring = length(inside) - 0.5 * phase;
  float height = sin(clamp(distance_to_ring * 24.0, -kPi, kPi)) * (1.0 - phase);
  return inside / max(length(inside), 1e-3) * height;
}

void wet(inout Material m) {
  float level = smoothstep(0.6, 0.95, m.normal.y) * scene.rain.x;
  vec2 waves = ripple(m.position.xz * 3.0, scene.time) + 0.5 * ripple(m.position.xz * 7.0 + 3.7, scene.time * 1.3);
  m.albedo *= mix(1.0, 0.45, level);
  m.roughness = mix(m.roughness, 0.06, level);
  m.alpha2 = m.roughness * m.roughness * m.roughness * m.roughness;
  m.normal = normalize(m.normal + vec3(waves.x, 0.0, waves.y) * 0.15 * level);
  m.f0 = mix(m.f0, vec3(0.02), level * (1.0 - m.metallic));
}

// ---- lamps

float fading(float distance2, float radius) {
  float share = distance2 / (radius * radius);
  float window = clamp(1.0 - share * share, 0.0, 1.0);
  return window * window / max(distance2, 1e-4);
}

vec3 lamp_light(Lamp lamp, Material m) {
  vec3 way = lamp.position - m.position;
  float distance2 = dot(way, way);
  if (distance2 > lamp.radius * lamp.radius) return vec3(0.0);
  vec3 to_light = way * inversesqrt(distance2);
  float strength = fading(distance2, lamp.radius);
  if (lamp.kind > 0.5) strength *= smoothstep(lamp.cos_angle, mix(lamp.cos_angle, 1.0, 0.2), dot(-to_light, lamp.direction));
  float n_l;
  vec3 sum = reflectance(m, to_light, n_l) * n_l;
  if (translucency) {
    float behind = clamp(dot(-m.normal, to_light), 0.0, 1.0);
    float through = pow(clamp(dot(m.eye, -normalize(to_light + m.normal * 0.3)), 0.0, 1.0), 4.0);
    sum += m.albedo * m.thin * (behind * kInversePi + through);
  }
  return sum * strength * lamp.color;
}

// ---- the tile

void find_planes(uvec2 tile) {
  vec2 scale = scene.size.xy / (2.0 * vec2(gl_WorkGroupSize.xy)), shift = scale - vec2(tile);
  vec4 column = vec4(-scene.projection[0][0] * scale.x, 0.0, shift.x, 0.0);
  vec4 row = vec4(0.0, -scene.projection[1][1] * scale.y, shift.y, 0.0);
  vec4 ahead = vec4(0.0, 0.0, 1.0, 0.0);
  tile_planes[0] = ahead - column;
  tile_planes[1] = column;
  tile_planes[2] = ahead - row;
  tile_planes[3] = row;
  for (int i = 0; i < 4; ++i) tile_planes[i] /= length(tile_planes[i].xyz);
}

bool reaches_tile(Lamp lamp, float near, float far) {
  vec4 p = scene.view * vec4(lamp.position, 1.0);
  bool inside = p.z + lamp.radius > near && p.z - lamp.radius < far;
  for (int i = 0; i < 4 && inside; ++i) inside = dot(tile_planes[i], p) >= -lamp.radius;
  return inside;
}

void collect_lamps(uvec2 tile, uint lane) {
  if (lane == 0u) find_planes(tile);
  barrier();
  float near = uintBitsToFloat(tile_near), far = uintBitsToFloat(tile_far);
  for (uint i = lane; i < scene.lamp_count; i += gl_WorkGroupSize.x * gl_WorkGroupSize.y) {
    if (!reaches_tile(lamps[i], near, far)) continue;
    uint slot = atomicAdd(tile_count, 1u);
    if (slot < uint(TILE_LAMPS)) tile_lamps[slot] = i;
  }
  barrier();
}

void measure_tile(uint lane, float z) {
  if (lane == 0u) {
    tile_near = 0x7f7fffffu;
    tile_far = 0u;
    tile_count = 0u;
  }
  barrier();
  atomicMin(tile_near, floatBitsToUint(z));
  atomicMax(tile_far, floatBitsToUint(z));
  barrier();
}

// ---- one pixel

Material read_material(ivec2 pixel, vec2 uv, float d, float z) {
  Material m;
  vec4 s = texelFetch(surface, pixel, 0);
  m.view_depth = z;
  m.position = world_from(uv, d);
  m.normal = unfold(texelFetch(normal, pixel, 0).xy);
  m.albedo = texelFetch(albedo, pixel, 0).rgb;
  m.roughness = max(s.x, 0.05);
  m.alpha2 = m.roughness * m.roughness * m.roughness * m.roughness;
  m.metallic = s.y;
  m.thin = s.z;
  m.cloth = s.w;
  m.f0 = mix(vec3(0.04), m.albedo, m.metallic);
  m.eye = normalize(scene.eye.xyz - m.position);
  return m;
}

vec3 film_curve(vec3 c) { return clamp((c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0); }

vec3 shade_pixel(Material m, vec2 uv, ivec2 pixel) {
  float n_l;
  vec3 sun = reflectance(m, scene.sun_direction.xyz, n_l) * scene.sun_color.rgb;
  sun *= n_l;
  if (shadows) sun *= sun_shadow(m, vec2(pixel));
  vec3 color = sun;
  uint count = min(tile_count, uint(TILE_LAMPS));
  for (uint i = 0u; i < count; ++i) color += lamp_light(lamps[tile_lamps[i]], m);
  if (sky_light) color += sky_irradiance(m.normal) * m.albedo * kInversePi * (1.0 - m.metallic);
  if (haze_on) color = add_haze(color, uv, m.view_depth);
  return film_curve(color * scene.exposure);
}

void main() {
  ivec2 limit = ivec2(scene.size.xy), pixel = min(ivec2(gl_GlobalInvocationID.xy), limit - 1);
  float d = texelFetch(depth, pixel, 0).x, z = eye_depth(d);
  measure_tile(gl_LocalInvocationIndex, z);
  collect_lamps(gl_WorkGroupID.xy, gl_LocalInvocationIndex);

  vec2 uv = (vec2(pixel) + 0.5) / scene.size.xy;
  Material m = read_material(pixel, uv, d, z);
  if (rain) wet(m);
  vec3 color = shade_pixel(m, uv, pixel);
  if (dither) color += (noise_of(gl_GlobalInvocationID.xy, scene.frame) - 0.5) / 255.0;

  uint bin = uint(clamp(dot(color, vec3(0.2126, 0.7152, 0.0722)) * 255.0, 0.0, 255.0));
  atomicAdd(bins[bin], 1u);
  if (all(lessThan(gl_GlobalInvocationID.xy, uvec2(limit)))) imageStore(lit, ivec2(gl_GlobalInvocationID.xy), vec4(color, 1.0));
}
