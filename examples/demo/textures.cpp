#include "examples/demo/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace rg::demo {
namespace {

using glm::vec2, glm::vec3;

struct Texel {
  vec3 color{1};     // linear
  float height = 0;  // textures' own unit; slopes matter
  float roughness = 1, metallic = 1;
};
using Pattern = Texel (*)(vec2 at);  // at in [0, 1), periodic

uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x8DA6B343u + y * 0xD8163841u + seed * 0xCB1AB31Fu;
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  return h ^ (h >> 15);
}
float random(int x, int y, uint32_t seed) {
  return static_cast<float>(hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), seed) >> 8) / 16777216.0f;
}

float smooth(float t) { return t * t * (3 - 2 * t); }

// Value noise with `cells` cells a side; periodic.
float noise(vec2 at, int cells, uint32_t seed) {
  const vec2 p = at * static_cast<float>(cells);
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  const auto wrap = [&](int i) { return ((i % cells) + cells) % cells; };
  const float fx = smooth(p.x - static_cast<float>(x)), fy = smooth(p.y - static_cast<float>(y));
  const float a = random(wrap(x), wrap(y), seed), b = random(wrap(x + 1), wrap(y), seed);
  const float c = random(wrap(x), wrap(y + 1), seed), d = random(wrap(x + 1), wrap(y + 1), seed);
  return glm::mix(glm::mix(a, b, fx), glm::mix(c, d, fx), fy);
}
float fractal(vec2 at, int cells, uint32_t seed, int octaves = 4) {
  float sum = 0, weight = 0.5f;
  for (int i = 0; i < octaves; ++i, weight *= 0.5f) sum += weight * noise(at, cells << i, seed + static_cast<uint32_t>(i));
  return sum;
}

// Bricks in running bond: which brick, and how far inside it (0 in the joint, 1 beyond the rounded edge).
struct Bond {
  int column = 0, row = 0;
  float inside = 0;
  vec2 within{0};
};
Bond bond(vec2 at, int columns, int rows, float joint, float offset) {
  const float v = at.y * static_cast<float>(rows);
  const int row = static_cast<int>(std::floor(v));
  const float u = at.x * static_cast<float>(columns) + (row % 2 != 0 ? offset : 0.0f);
  const int column = static_cast<int>(std::floor(u));
  const vec2 f(u - static_cast<float>(column), v - static_cast<float>(row));
  const vec2 cell(1.0f / static_cast<float>(columns), 1.0f / static_cast<float>(rows));
  const vec2 edge = glm::min(f, 1.0f - f) * cell;
  const float distance = std::min(edge.x, edge.y);
  return {((column % columns) + columns) % columns, ((row % rows) + rows) % rows, glm::smoothstep(joint * 0.4f, joint, distance), f};
}

Texel granite(vec2 at) {
  const float grains = noise(at, 96, 11), cloud = fractal(at, 4, 12), speck = noise(at, 128, 13);
  const vec3 color = glm::mix(vec3(0.24f, 0.225f, 0.21f), vec3(0.46f, 0.44f, 0.41f), 0.55f * cloud + 0.45f * grains);
  return {color * (speck > 0.86f ? 0.6f : 1.0f), 0.25f * grains + 0.9f * cloud, 0.5f + 0.3f * grains, 0};
}
Texel plaster(vec2 at) {
  const float rough = fractal(at, 16, 21), cloud = fractal(at, 3, 22), stain = glm::smoothstep(0.52f, 0.75f, fractal(at, 5, 23));
  const vec3 color = glm::mix(vec3(0.74f, 0.70f, 0.63f), vec3(0.86f, 0.83f, 0.77f), cloud) * (1.0f - 0.22f * stain);
  return {color, 0.8f * rough + 0.3f * cloud, 0.86f, 0};
}
Texel brick(vec2 at) {
  const Bond b = bond(at, 6, 16, 0.006f, 0.5f);
  const float tone = random(b.column, b.row, 31), grain = fractal(at, 32, 32);
  const vec3 clay = glm::mix(vec3(0.30f, 0.105f, 0.06f), vec3(0.52f, 0.24f, 0.14f), 0.7f * tone + 0.3f * grain);
  const vec3 mortar = vec3(0.42f, 0.39f, 0.35f) * (0.8f + 0.3f * grain);
  return {glm::mix(mortar, clay, b.inside), 1.6f * b.inside + 0.5f * grain, glm::mix(0.95f, 0.75f, b.inside), 0};
}
float vein(vec2 at, uint32_t seed) {
  const vec2 bent = at + 0.16f * vec2(fractal(at, 4, seed), fractal(at, 4, seed + 9));
  const float wave = std::sin(2 * std::numbers::pi_v<float> * (2 * bent.x + 3 * bent.y) + 7.0f * fractal(at, 3, seed + 20));
  return std::pow(1.0f - std::abs(wave), 6.0f);
}
Texel marble(vec2 at) {
  const float v = vein(at, 41);
  return {glm::mix(vec3(0.82f, 0.80f, 0.77f) * (0.92f + 0.1f * fractal(at, 4, 49)), vec3(0.45f, 0.46f, 0.50f), 0.6f * v), 0.06f * v,
          0.32f + 0.15f * v, 0};
}
Texel dark_marble(vec2 at) {
  const float v = vein(at, 51);
  return {glm::mix(vec3(0.035f, 0.05f, 0.055f), vec3(0.62f, 0.55f, 0.38f), 0.7f * v * v), 0.05f * v, 0.2f + 0.2f * v, 0};
}
Texel planks(vec2 at) {
  const Bond b = bond(vec2(at.y, at.x), 2, 8, 0.0035f, 0.37f);
  const float tone = random(b.column, b.row, 61);
  const vec2 along(at.x, at.y);
  const float rings = fractal(vec2(along.x * 4.0f + tone, along.y), 8, 62) + 0.5f * noise(vec2(along.x, along.y), 64, 63);
  const float line = 0.5f + 0.5f * std::sin(40.0f * rings);
  const vec3 wood = glm::mix(vec3(0.16f, 0.075f, 0.03f), vec3(0.38f, 0.20f, 0.09f), 0.35f * line + 0.65f * tone);
  return {wood * (0.25f + 0.75f * b.inside), 1.1f * b.inside + 0.15f * line, 0.42f + 0.2f * line, 0};
}
Texel roof(vec2 at) {
  const Bond b = bond(at, 8, 6, 0.004f, 0.5f);
  const float tone = random(b.column, b.row, 71), arch = std::sin(std::numbers::pi_v<float> * b.within.x);
  const vec3 clay = glm::mix(vec3(0.34f, 0.12f, 0.07f), vec3(0.55f, 0.26f, 0.15f), tone);
  return {clay * (0.45f + 0.55f * arch) * (0.75f + 0.4f * fractal(at, 24, 72)), 3.2f * arch + 2.0f * b.within.y, 0.8f, 0};
}
Texel sandstone(vec2 at) {
  const Bond b = bond(at, 2, 4, 0.007f, 0.5f);
  const float grain = fractal(at, 24, 81), layers = noise(vec2(at.x, at.y), 6, 83), tone = random(b.column, b.row, 82);
  const vec3 stone = glm::mix(vec3(0.50f, 0.39f, 0.26f), vec3(0.68f, 0.56f, 0.40f), 0.5f * tone + 0.35f * grain + 0.15f * layers);
  return {stone * (0.55f + 0.45f * b.inside), 1.8f * b.inside + 0.7f * grain, 0.82f, 0};
}
Texel mosaic(vec2 at) {
  const Bond b = bond(at, 12, 12, 0.0045f, 0.0f);
  const int dx = std::min(b.column, 11 - b.column), dy = std::min(b.row, 11 - b.row), ring = std::min(dx, dy), cross = std::abs(dx - dy);
  const vec3 palette[4] = {{0.05f, 0.20f, 0.30f}, {0.70f, 0.63f, 0.48f}, {0.08f, 0.34f, 0.34f}, {0.62f, 0.30f, 0.10f}};
  const vec3 glaze = palette[(cross <= 1 ? 3 : ring) % 4] * (0.75f + 0.5f * random(b.column, b.row, 91));
  return {glm::mix(vec3(0.36f), glaze, b.inside), 1.2f * b.inside, glm::mix(0.9f, 0.2f, b.inside), 0};
}
Texel hammered(vec2 at) {
  const float dents = noise(at, 18, 101), scratches = noise(vec2(at.x, at.y), 90, 102);
  return {vec3(0.85f + 0.15f * dents), 0.9f * dents, 0.55f + 0.45f * scratches, 1};
}
Texel rug(vec2 at) {
  const vec2 c = glm::abs(at - 0.5f) * 2.0f;
  const float border = std::max(c.x, c.y), diamond = c.x + c.y;
  const float weave = 0.5f + 0.5f * std::sin(at.x * 2 * std::numbers::pi_v<float> * 64) * std::sin(at.y * 2 * std::numbers::pi_v<float> * 64);
  vec3 color(0.30f, 0.028f, 0.03f);
  if (border > 0.86f)
    color = vec3(0.05f, 0.06f, 0.16f);
  else if (border > 0.80f)
    color = vec3(0.55f, 0.40f, 0.14f);
  else if (std::fmod(diamond * 4.0f, 1.0f) < 0.28f)
    color = vec3(0.60f, 0.42f, 0.18f);
  else if (diamond < 0.5f)
    color = vec3(0.05f, 0.09f, 0.20f);
  return {color * (0.7f + 0.45f * weave), 0.6f * weave, 0.95f, 0};
}
Texel leaves(vec2 at) {
  const float a = noise(at, 20, 121), b = noise(at, 40, 122);
  return {glm::mix(vec3(0.018f, 0.06f, 0.012f), vec3(0.13f, 0.26f, 0.05f), a * b * 1.6f), 3.0f * a + 1.5f * b, 0.7f, 0};
}
Texel verdigris(vec2 at) {
  const float patina = glm::smoothstep(0.35f, 0.62f, fractal(at, 6, 131));
  return {glm::mix(vec3(0.80f, 0.45f, 0.28f), vec3(0.20f, 0.46f, 0.38f), patina), 0.5f * patina, 0.45f + 0.5f * patina, 1.0f - 0.85f * patina};
}
Texel mist(vec2 at) {
  const float thick = glm::smoothstep(0.30f, 0.62f, fractal(at, 3, 151, 5));
  return {vec3(thick), 0, 1, 0};
}
// Eight-pointed stars and crosses, as carved screens have them.
Texel lattice(vec2 at) {
  const vec2 p = glm::abs(glm::fract(at * 4.0f) - 0.5f);
  const float square = std::max(p.x, p.y), diamond = (p.x + p.y) * 0.70711f, star = std::min(square, diamond);
  const float corner = glm::length(p - 0.5f);
  const float open = std::max(glm::smoothstep(0.30f, 0.27f, star), glm::smoothstep(0.15f, 0.12f, corner));
  return {vec3(open), 0, 1, 0};
}
// Petals about a middle, in leads.
Texel roses(vec2 at) {
  const vec2 p = (at - 0.5f) * 2.0f;
  const float radius = glm::length(p), angle = std::atan2(p.y, p.x) * 0.1591549f + 0.5f;
  const float petals = radius < 0.42f ? 6.0f : 12.0f, part = glm::fract(angle * petals), lead = std::min(part, 1 - part) / petals * 6.2832f * radius;
  const float ring = std::min({std::abs(radius - 0.16f), std::abs(radius - 0.42f), std::abs(radius - 0.72f), std::abs(radius - 0.96f)});
  const float glass = glm::smoothstep(0.008f, 0.022f, std::min(ring, radius < 0.16f ? 1.0f : lead)) * (radius < 0.96f ? 1.0f : 0.0f);
  const int which = static_cast<int>(angle * petals) + static_cast<int>(radius * 5);
  const vec3 hues[] = {{1.0f, 0.10f, 0.08f}, {0.08f, 0.25f, 1.0f}, {1.0f, 0.62f, 0.06f}, {0.06f, 0.75f, 0.35f}};
  return {hues[which % 4] * glass, 0, 1, 0};
}
Texel embers(vec2 at) {
  const float heat = fractal(at, 6, 171), veins = glm::smoothstep(0.42f, 0.62f, heat);
  return {glm::mix(vec3(0.25f, 0.03f, 0.01f), vec3(1.0f, 0.55f, 0.16f), veins), 0, 1, 0};
}
Texel terracotta(vec2 at) {
  const float f = fractal(at, 10, 141);
  return {glm::mix(vec3(0.42f, 0.17f, 0.09f), vec3(0.62f, 0.30f, 0.18f), f), 0.4f * f, 0.8f, 0};
}

uint8_t to_byte(float x) { return static_cast<uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); }
float to_srgb(float c) { return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }
float from_srgb(uint8_t b) {
  const float c = static_cast<float>(b) / 255.0f;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

std::vector<Texel> evaluate(Pattern pattern) {
  std::vector<Texel> texels(kTextureSize * kTextureSize);
  for (uint32_t i = 0; i < texels.size(); ++i)
    texels[i] = pattern((vec2(i % kTextureSize, i / kTextureSize) + 0.5f) / static_cast<float>(kTextureSize));
  return texels;
}

// Normals from the slopes of the height, which is in hundredths of the texture's side.
TextureLayer encode(const std::vector<Texel>& texels) {
  TextureLayer out{std::vector<uint8_t>(texels.size() * 4), std::vector<uint8_t>(texels.size() * 4)};
  const auto at = [&](uint32_t x, uint32_t y) { return texels[(y % kTextureSize) * kTextureSize + x % kTextureSize].height; };
  const float scale = 0.005f * static_cast<float>(kTextureSize);
  for (uint32_t y = 0; y < kTextureSize; ++y) {
    for (uint32_t x = 0; x < kTextureSize; ++x) {
      const size_t i = y * kTextureSize + x;
      const Texel& t = texels[i];
      const vec3 n =
          glm::normalize(vec3((at(x + kTextureSize - 1, y) - at(x + 1, y)) * scale, (at(x, y + kTextureSize - 1) - at(x, y + 1)) * scale, 1));
      const uint8_t a[4] = {to_byte(to_srgb(t.color.r)), to_byte(to_srgb(t.color.g)), to_byte(to_srgb(t.color.b)), 255};
      const uint8_t s[4] = {to_byte(n.x * 0.5f + 0.5f), to_byte(n.y * 0.5f + 0.5f), to_byte(t.roughness), to_byte(t.metallic)};
      std::copy_n(a, 4, out.albedo.begin() + static_cast<ptrdiff_t>(i * 4));
      std::copy_n(s, 4, out.surface.begin() + static_cast<ptrdiff_t>(i * 4));
    }
  }
  return out;
}

const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (uint32_t i = 0; i < 256; ++i) t[i] = from_srgb(static_cast<uint8_t>(i));
    return t;
  }();
  return table;
}

uint8_t average(const uint8_t* a, const uint8_t* b, const uint8_t* c, const uint8_t* d, bool srgb) {
  if (!srgb) return static_cast<uint8_t>((*a + *b + *c + *d + 2) / 4);
  const auto& light = srgb_table();
  return to_byte(to_srgb(0.25f * (light[*a] + light[*b] + light[*c] + light[*d])));
}

}  // namespace

std::vector<TextureLayer> make_plaza_textures() {
  const Pattern patterns[layer::count] = {[](vec2) { return Texel{}; },
                                          granite,
                                          plaster,
                                          brick,
                                          marble,
                                          dark_marble,
                                          planks,
                                          roof,
                                          sandstone,
                                          mosaic,
                                          hammered,
                                          rug,
                                          leaves,
                                          verdigris,
                                          terracotta,
                                          mist,
                                          lattice,
                                          roses,
                                          embers};
  std::vector<TextureLayer> layers;
  for (const Pattern pattern : patterns) layers.push_back(encode(evaluate(pattern)));
  return layers;
}

std::vector<uint8_t> make_mips(const std::vector<uint8_t>& mip0, bool srgb) {
  std::vector<uint8_t> out = mip0;
  size_t from = 0;
  for (uint32_t size = kTextureSize / 2; size > 0; size /= 2) {
    const size_t to = out.size(), row = size * 2 * 4;
    out.resize(to + size * size * 4);
    for (uint32_t i = 0; i < size * size * 4; ++i) {
      const uint8_t* p = out.data() + from + (i / 4 / size) * 2 * row + (i / 4 % size) * 8 + i % 4;
      out[to + i] = average(p, p + 4, p + row, p + row + 4, srgb && i % 4 != 3);
    }
    from = to;
  }
  return out;
}

}  // namespace rg::demo
