#include "tests/unit/frame/surfaces.h"

#include <cmath>
#include <memory>

#include "examples/demo/textures.h"
#include "tests/reference/culling.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;

double to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

struct Mips {
  std::vector<std::vector<glm::dvec3>> levels;  // linear

  explicit Mips(const std::vector<uint8_t>& mip0) {
    const std::vector<uint8_t> bytes = demo::make_mips(mip0, true);
    size_t at = 0;
    for (size_t size = demo::kTextureSize; size > 0; size /= 2) {
      std::vector<glm::dvec3>& level = levels.emplace_back();
      for (size_t i = 0; i < size * size; ++i, at += 4)
        level.push_back({to_linear(bytes[at] / 255.0), to_linear(bytes[at + 1] / 255.0), to_linear(bytes[at + 2] / 255.0)});
    }
  }

  glm::dvec3 texel(size_t level, int x, int y) const {
    const int size = static_cast<int>(demo::kTextureSize >> level);
    return levels[level][static_cast<size_t>(((y % size + size) % size) * size + (x % size + size) % size)];
  }
  glm::dvec3 bilinear(size_t level, glm::dvec2 uv) const {
    const glm::dvec2 at = uv * static_cast<double>(demo::kTextureSize >> level) - 0.5, base = glm::floor(at), f = at - base;
    const int x = static_cast<int>(base.x), y = static_cast<int>(base.y);
    return glm::mix(glm::mix(texel(level, x, y), texel(level, x + 1, y), f.x), glm::mix(texel(level, x, y + 1), texel(level, x + 1, y + 1), f.x),
                    f.y);
  }
  glm::dvec3 trilinear(glm::dvec2 uv, double level) const {
    const auto low = static_cast<size_t>(level), high = std::min(low + 1, levels.size() - 1);
    return glm::mix(bilinear(low, uv), bilinear(high, uv), level - std::floor(level));
  }
};

// Compares against one layer of the lamps' shadow maps.
struct ShadowMap {
  const float* texels;
  int size;
  bool certain = true;

  double at(int x, int y) const { return texels[std::clamp(y, 0, size - 1) * size + std::clamp(x, 0, size - 1)]; }
  double compare(int x, int y, double depth) {
    const double stored = at(x, y);
    if (std::abs(stored - depth) < 2e-6 * std::max(depth, stored) + 1e-9) certain = false;
    return depth >= stored ? 1 : 0;
  }
  double compare_four(glm::dvec2 texel, double depth) {
    const glm::dvec2 at = texel - 0.5, base = glm::floor(at), f = at - base;
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const double weight = (k % 2 == 0 ? 1 - f.x : f.x) * (k / 2 == 0 ? 1 - f.y : f.y);
      if (weight > 1e-4) sum += weight * compare(static_cast<int>(base.x) + k % 2, static_cast<int>(base.y) + k / 2, depth);
    }
    return sum;
  }
};

glm::dvec2 disc(int i) { return glm::dvec2(std::cos(i * 2.39996323), std::sin(i * 2.39996323)) * std::sqrt((i + 0.5) / 16); }

// Mean distance of what is nearer than `depth` says, of 16 places; 0 where nothing is.
double mean_blocker(ShadowMap& map, glm::dvec2 texel, double reach, double depth) {
  double sum = 0;
  int found = 0;
  for (int i = 0; i < 16; ++i) {
    const glm::dvec2 at = texel + disc(i) * reach, to_edge = glm::abs(glm::fract(at + 0.5) - 0.5);
    if (std::min(to_edge.x, to_edge.y) < 2e-3) map.certain = false;
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    if (map.compare(x, y, depth) > 0) continue;
    sum += 0.05 / map.at(x, y);
    ++found;
  }
  return found > 0 ? sum / found : 0;
}

double visibility(ShadowMap map, const frame::Light& light, glm::dvec3 p, glm::dvec3 off) {
  const double distance = std::max(glm::dot(p - reference::to_double(light.position), reference::to_double(light.direction)), 0.0);
  const reference::LampPlace place = reference::lamp_place(light, p + off * (1.5 * 2 * distance / (light.cot * map.size)));
  if (place.along <= 0.05) return 0;
  const glm::dvec2 texel = (place.across * 0.5 + 0.5) * static_cast<double>(map.size);
  const double depth = 0.05 / (place.along * (1 - 0.008)), reach = 0.5 * light.size.x * light.cot / place.along * map.size;
  const bool soft = (light.features & static_cast<uint32_t>(frame::LAMP_SOFT)) != 0;
  const double blocker = soft ? mean_blocker(map, texel, reach, depth) : 0, radius = blocker > 0 ? (place.along - blocker) / blocker * reach : 0;
  double sum = 0;
  const int taps = soft ? 16 : 1;
  for (int i = 0; i < taps; ++i) sum += map.compare_four(texel + disc(i) * radius, depth);
  return map.certain ? sum / taps : std::nan("");
}

}  // namespace

GBuffer read_gbuffer(Lab& lab, const FrameData& data) {
  const Index after = pass::gbuffer_props;
  const std::vector<Dump> all = lab.dumps(
      data,
      {{after, resource::depth}, {after, resource::albedo}, {after, resource::normal}, {after, resource::material}, {after, resource::emissive}});
  return {texels_of(all[0]), texels_of(all[1]), texels_of(all[2]), texels_of(all[3]), texels_of(all[4])};
}

reference::SurfacePoint surface_at(const GBuffer& g, const FrameData& data, int x, int y) {
  reference::SurfacePoint s;
  s.position = reference::world_position(data.view, x, y, g.depth.at(x, y).x);
  s.normal =
      reference::decode_normal(static_cast<uint16_t>(g.normal.at(x, y).x * 65535 + 0.5f), static_cast<uint16_t>(g.normal.at(x, y).y * 65535 + 0.5f));
  s.eye = glm::normalize(reference::to_double(data.view.position) - s.position);
  s.base = glm::dvec3(g.albedo.at(x, y));
  s.roughness = g.material.at(x, y).x;
  s.metallic = g.material.at(x, y).y;
  return s;
}

void clear_fog(FrameData& data) {
  data.fog.density = 0;
  data.fog.volume_count = 0;
}
void keep_lamps_only(FrameData& data) {
  data.view.sun_color = data.view.ambient = {0, 0, 0};
  clear_fog(data);
}

reference::LampTextures make_lookups(Lab& lab, const FrameData& data, const Scene& scene) {
  const auto layers = std::make_shared<std::vector<Mips>>();
  for (const demo::TextureLayer& layer : scene.textures) layers->emplace_back(layer.albedo);
  const auto maps = std::make_shared<std::vector<float>>(lab.buffer<float>(data, pass::lamp_shadow_world_7, resource::lamp_shadow));
  const int size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(maps->size()) / frame::MAX_LAMP_SHADOWS)));
  reference::LampTextures textures;
  textures.picture = [layers](const frame::Light& light, glm::dvec2 at, double metres) {
    const double level = metres > 0 ? std::clamp(std::log2(demo::kTextureSize * metres / (2 * std::min(light.size.x, light.size.y))), 0.0, 8.0) : 0;
    return (*layers)[light.picture].trilinear(at * 0.5 + 0.5, level);
  };
  textures.visibility = [maps, size](const frame::Light& light, glm::dvec3 p, glm::dvec3 off) {
    return visibility({maps->data() + static_cast<size_t>(light.shadow) * static_cast<size_t>(size * size), size}, light, p, off);
  };
  return textures;
}

void expect_close(const glm::vec4& actual, const glm::dvec3& expected, double relative, const glm::dvec3& slack, int x, int y) {
  for (int i = 0; i < 3; ++i)
    ASSERT_NEAR(actual[i], expected[i], relative * std::abs(expected[i]) + slack[i]) << "channel " << i << " of pixel " << x << " " << y;
}

}  // namespace rg::test
