// The features of lamps, one by one, against their equations in double precision: A6.
#include "examples/demo/lamps.h"

#include <numbers>
#include <random>

#include "examples/demo/mesh_builder.h"
#include "examples/demo/textures.h"
#include "tests/reference/culling.h"
#include "tests/unit/frame/surfaces.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;
namespace lamp = demo::lamp;
using glm::dvec3;

// ---- a stage: a floor and three blocks, one rough, one shiny, one of metal

struct Block {
  glm::vec3 low, high;
  float roughness, metallic;
};
constexpr Block kBlocks[] = {{{-2.2f, 0, -0.8f}, {-1.2f, 1.0f, 0.2f}, 0.9f, 0},
                             {{-0.3f, 0.5f, -0.6f}, {0.7f, 0.7f, 0.4f}, 0.25f, 0},
                             {{1.4f, 0, 0.2f}, {2.4f, 0.8f, 1.2f}, 0.5f, 1}};

Scene make_stage() {
  Scene scene = make_floor();
  scene.textures.push_back(plaza().textures[demo::layer::roses]);
  for (const Block& block : kBlocks) {
    demo::MeshData box;
    demo::add_box(box, block.low, block.high, 10);
    demo::Instance instance;
    instance.mesh = demo::add_mesh(scene, "block", box);
    instance.material = static_cast<uint32_t>(scene.materials.size());
    scene.instances.push_back(instance);
    demo::Material material;
    material.base_color = {0.8f, 0.6f, 0.4f, 1};
    material.roughness = block.roughness;
    material.metallic = block.metallic;
    scene.materials.push_back(material);
  }
  return scene;
}
const Scene& stage() {
  static const Scene scene = make_stage();
  return scene;
}
Lab& stage_lab() {
  static Lab lab(stage(), 160, 96);
  return lab;
}

demo::Light make_lamp(uint32_t features) {
  demo::Light light;
  light.features = features;
  light.position = {0.8f, 3.1f, 0.9f};
  light.direction = {-0.3f, -1, -0.25f};
  light.side = {0.9f, 0.1f, 0.3f};
  light.color = {6, 5, 4};
  light.range = 7;
  light.inner = 0.5f;
  light.outer = 0.62f;
  light.picture = 1;
  return light;
}

FrameData prepare(const std::vector<demo::Light>& lights) {
  FrameData data = stage_lab().prepare();
  keep_lamps_only(data);
  Scene lit;
  lit.lights = lights;
  data.lights = demo::make_lights(lit, demo::world_to_view(stage().cameras[0]), 0);
  data.lamps = demo::make_lamp_views(lit);
  data.view.light_count = static_cast<uint32_t>(data.lights.size());
  return data;
}
Texels shade(const std::vector<demo::Light>& lights) { return stage_lab().image(prepare(lights), deferred_light(), resource::hdr); }

struct Compared {
  uint32_t lit = 0, dark = 0;
};
// Every pixel against the reference but for those where a compare of the shadow map is too close to call.
Compared compare(const std::vector<demo::Light>& lights, double relative = 2e-3, double absolute = 2e-5) {
  Lab& lab = stage_lab();
  const FrameData data = prepare(lights);
  const GBuffer g = read_gbuffer(lab, data);
  const reference::LampTextures lookups = make_lookups(lab, data, stage());
  const Texels hdr = lab.image(data, deferred_light(), resource::hdr);
  Compared count;
  for (int y = 0; y < hdr.height; ++y)
    for (int x = 0; x < hdr.width; ++x) {
      if (g.depth.at(x, y).x <= 0) continue;
      const reference::SurfacePoint s = surface_at(g, data, x, y);
      const dvec3 light = reference::lamps_radiance(s, data.lights, lookups);
      if (std::isnan(light.x) || glm::dot(s.normal, s.eye) < 0.02) continue;
      expect_close(hdr.at(x, y), glm::max(light, 0.0), relative, dvec3(absolute), x, y);
      if (testing::Test::HasFailure()) return count;
      (light.x > 1e-3 ? count.lit : count.dark) += 1;
    }
  return count;
}

void expect_lit(Compared count, uint32_t lit, uint32_t dark) {
  EXPECT_GT(count.lit, lit);
  EXPECT_GT(count.dark, dark);
}

// ---- each feature

TEST(Lamps, PointsAreAsBefore) { expect_lit(compare({make_lamp(0)}), 5000, 0); }
TEST(Lamps, RoundSpots) { expect_lit(compare({make_lamp(lamp::round)}), 1000, 1000); }
TEST(Lamps, SquareSpots) { expect_lit(compare({make_lamp(lamp::square)}), 1000, 1000); }
TEST(Lamps, ShadowsOfSpots) { expect_lit(compare({make_lamp(lamp::square | lamp::shadow)}), 1000, 1500); }
TEST(Lamps, SoftShadows) {
  demo::Light light = make_lamp(lamp::square | lamp::shadow | lamp::soft);
  light.size = {0.3f, 0};
  expect_lit(compare({light}), 1000, 1000);
}
TEST(Lamps, ProjectedPictures) { expect_lit(compare({make_lamp(lamp::square | lamp::projected)}, 0.02), 800, 1500); }
TEST(Lamps, Areas) {
  demo::Light light = make_lamp(lamp::area);
  light.size = {0.7f, 0.4f};
  expect_lit(compare({light}, 0.02), 4000, 100);
}
TEST(Lamps, Tubes) {
  demo::Light light = make_lamp(lamp::tube);
  light.size = {0.9f, 0.05f};
  expect_lit(compare({light}), 5000, 0);
}
TEST(Lamps, DarkTakesFromOthers) {
  demo::Light dark = make_lamp(lamp::dark);
  dark.position = {-1, 1, 0};
  dark.range = 4;
  expect_lit(compare({make_lamp(0), dark}), 3000, 500);
}
TEST(Lamps, ClipPlanes) {
  demo::Light light = make_lamp(lamp::clipped);
  light.clip[0] = {1, 0, 0.2f, 0.4f};
  light.clip[1] = {0, 0, -1, 1.1f};
  expect_lit(compare({light}), 2000, 2000);
}
TEST(Lamps, AllTogether) {
  demo::Light area = make_lamp(lamp::area | lamp::clipped), tube = make_lamp(lamp::tube | lamp::dark),
              soft = make_lamp(lamp::square | lamp::shadow | lamp::soft | lamp::projected);
  area.size = tube.size = {0.5f, 0.2f};
  area.clip[0] = {0.3f, 0, 1, 1};
  tube.color = {1, 1, 1};
  tube.position = {-2, 2, 1};
  soft.size = {0.2f, 0};
  soft.color = {30, 30, 30};
  expect_lit(compare({area, tube, soft, make_lamp(lamp::round)}, 0.02, 1e-3), 4000, 0);
}

// ---- what features have to do with each other

double greatest_difference(const Texels& a, const Texels& b) {
  double greatest = 0;
  for (size_t i = 0; i < a.data.size(); ++i)
    for (int c = 0; c < 3; ++c)
      greatest = std::max(greatest,
                          static_cast<double>(std::abs(a.data[i][c] - b.data[i][c])) / std::max(1e-2, static_cast<double>(std::abs(a.data[i][c]))));
  return greatest;
}

TEST(Lamps, DarkAndLightOfOneStrengthCancel) {
  for (const uint32_t more : {0u, static_cast<uint32_t>(lamp::round), static_cast<uint32_t>(lamp::tube)}) {
    demo::Light light = make_lamp(more), dark = make_lamp(more | lamp::dark);
    light.size = dark.size = {0.5f, 0.05f};
    for (const glm::vec4& texel : shade({light, dark}).data)
      for (int c = 0; c < 3; ++c) ASSERT_LE(texel[c], 1e-6f);
  }
}

TEST(Lamps, ATubeOfNoLengthAndWidthIsAPoint) {
  const Texels tube = shade({make_lamp(lamp::tube)}), point = shade({make_lamp(0)});
  EXPECT_LT(greatest_difference(tube, point), 2e-3);
}

TEST(Lamps, ASoftLampOfNoSizeIsAHardOne) {
  const Texels soft = shade({make_lamp(lamp::square | lamp::shadow | lamp::soft)}), hard = shade({make_lamp(lamp::square | lamp::shadow)});
  EXPECT_LT(greatest_difference(soft, hard), 1e-3) << "half precision rounds to 2^-11";
}

// The penumbra of an edge is as wide as the lamp seen past it: twice the lamp, twice the width.
TEST(Lamps, PenumbraeGrowWithTheLamp) {
  const auto partly_lit = [](float radius) {
    demo::Light light = make_lamp(lamp::square | lamp::shadow | lamp::soft);
    light.size = {radius, 0};
    const Texels soft = shade({light}), full = shade({make_lamp(lamp::square)});
    uint32_t count = 0;
    for (size_t i = 0; i < soft.data.size(); ++i)
      count += full.data[i].x > 0.02f && soft.data[i].x > 0.05f * full.data[i].x && soft.data[i].x < 0.95f * full.data[i].x;
    return count;
  };
  const uint32_t narrow = partly_lit(0.1f), wide = partly_lit(0.2f);
  EXPECT_GT(wide, narrow * 3 / 2);
  EXPECT_GT(narrow, 25u);
}

// ---- shadow maps

// Distance along `direction` (of unit slope forward) at which a ray meets a box; infinite if it does not.
double hit_box(dvec3 from, dvec3 direction, dvec3 low, dvec3 high) {
  double enter = 0, leave = 1e30;
  for (int i = 0; i < 3; ++i) {
    const double a = (low[i] - from[i]) / direction[i], b = (high[i] - from[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : 1e30;
}

TEST(LampShadows, HoldWhatIsNearestToTheLamp) {
  const FrameData data = prepare({make_lamp(lamp::square | lamp::shadow)});
  const auto map = stage_lab().buffer<float>(data, pass::lamp_shadow_world_0, resource::lamp_shadow);
  const frame::LampView& view = data.lamps.view[0];
  const dvec3 from = reference::to_double(view.position), forward = reference::to_double(view.direction), side = reference::to_double(view.side),
              up = glm::cross(forward, side);
  uint32_t wrong = 0, blocks = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / 128.0 - 1.0;
      const dvec3 ray = forward + (side * at.x + up * at.y) / static_cast<double>(view.cot);
      double nearest = ray.y < 0 ? -from.y / ray.y : 1e30;  // the floor reaches beyond the map
      for (const Block& block : kBlocks) {
        const double box = hit_box(from, ray, dvec3(block.low), dvec3(block.high));
        blocks += box < nearest;
        nearest = std::min(nearest, box);
      }
      wrong += std::abs(map[static_cast<size_t>(y * 256 + x)] - 0.05 / nearest) > 1e-4 * 0.05;
    }
  EXPECT_GT(blocks, 2000u);
  EXPECT_LT(wrong, 600u) << "but for texels on edges";
}

TEST(LampShadows, BeyondTheLastMapLampsGoWithout) {
  const FrameData data = prepare(std::vector<demo::Light>(10, make_lamp(lamp::round | lamp::shadow | lamp::soft)));
  uint32_t shadowed = 0;
  for (const frame::Light& light : data.lights) shadowed += (light.features & static_cast<uint32_t>(frame::LAMP_SHADOW)) != 0;
  EXPECT_EQ(shadowed, static_cast<uint32_t>(frame::MAX_LAMP_SHADOWS));
}

// ---- tiles

TEST(TileRecords, HoldTheUnionOfTheirLampsFeatures) {
  Lab& lab = plaza_lab();
  uint32_t all = 0;
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const FrameData data = lab.prepare(camera);
    const std::vector<Dump> dumps = lab.dumps(data, {{pass::tile_cull, resource::tile_records}, {pass::tile_cull, resource::tile_features}});
    const auto records = values_of<Record>(dumps[0]);
    const auto features = values_of<uint32_t>(dumps[1]);
    ASSERT_EQ(features.size(), records.size());
    for (size_t tile = 0; tile < records.size(); ++tile) {
      uint32_t expected = 0;
      for (uint32_t i = 0; i < records[tile].count; ++i) expected |= data.lights[records[tile].light[i]].features;
      ASSERT_EQ(features[tile], expected);
      all |= expected;
    }
  }
  EXPECT_EQ(all, (1u << frame::LAMP_FEATURES) - 1) << "the plaza uses every feature";
}

// ---- energy: representative points against the integral over the lamp, by Monte Carlo

struct Sample {
  dvec3 towards;    // not of unit length
  double strength;  // irradiance for an intensity, or a radiance, of one
};
template <class Draw>
dvec3 integrate(const reference::SurfacePoint& s, Draw draw) {
  dvec3 sum(0);
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Sample sample = draw();
    sum += reference::reflected(s, glm::normalize(sample.towards), dvec3(sample.strength));
  }
  return sum / static_cast<double>(kSamples);
}

struct Case {
  reference::SurfacePoint surface;
  frame::Light light;
};
// A surface below a lamp that lies wholly above its horizon; wide enough a range for the window not to count.
Case random_case(std::mt19937& random, uint32_t features, glm::vec2 size, float roughness) {
  std::uniform_real_distribution<float> unit(-1, 1);
  demo::Light light;
  light.features = features;
  light.position = {unit(random), 2.5f, unit(random)};
  light.direction = {0.3f * unit(random), -1, 0.3f * unit(random)};
  light.side = {1, 0.3f * unit(random), unit(random)};
  light.range = 1000;
  light.size = size;
  Scene scene;
  scene.lights = {light};
  Case c;
  c.light = demo::make_lights(scene, glm::mat4(1), 0)[0];
  c.surface.eye = glm::normalize(dvec3(unit(random), 0.7 + std::abs(unit(random)), unit(random)));
  c.surface.roughness = roughness;
  c.surface.base = dvec3(0.5);
  return c;
}

TEST(LampEnergy, TubesAndSpheresAreTheIntegralOverTheLamp) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i) {
    const glm::vec2 size(i % 3 == 0 ? 0.0f : 0.3f * static_cast<float>(i % 3), i % 2 == 0 ? 0.02f : 0.15f);
    const Case c = random_case(random, lamp::tube, size, 0.8f);
    const dvec3 middle = reference::to_double(c.light.position), side = reference::to_double(c.light.side);
    const dvec3 expected = integrate(c.surface, [&]() -> Sample {  // points of the axis; the width matters to the mirror image only
      dvec3 within;
      do within = {unit(random), unit(random), unit(random)};
      while (glm::dot(within, within) > 1);
      const dvec3 towards = middle + side * (unit(random) * c.light.size.x) + within * static_cast<double>(c.light.size.y);
      return {towards, 1 / (glm::dot(towards, towards) + 0.01)};
    });
    const dvec3 actual = reference::lamp_radiance(c.surface, c.light);
    ASSERT_NEAR(actual.x, expected.x, 0.1 * expected.x) << "case " << i;
  }
}

TEST(LampEnergy, AreasAreTheIntegralOverTheLamp) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i) {
    const Case c = random_case(random, lamp::area, {0.2f + 0.1f * static_cast<float>(i % 4), 0.3f}, 0.8f);
    const dvec3 middle = reference::to_double(c.light.position), forward = reference::to_double(c.light.direction),
                side = reference::to_double(c.light.side);
    const dvec3 expected = integrate(c.surface, [&]() -> Sample {
      const dvec3 towards = middle + side * (unit(random) * c.light.size.x) + glm::cross(forward, side) * (unit(random) * c.light.size.y);
      const double distance2 = glm::dot(towards, towards), cosine = std::max(-glm::dot(glm::normalize(towards), forward), 0.0);
      return {towards, 4.0 * c.light.size.x * c.light.size.y * cosine / distance2};
    });
    const dvec3 actual = reference::lamp_radiance(c.surface, c.light);
    ASSERT_NEAR(actual.x, expected.x, 0.1 * expected.x) << "case " << i;
  }
}

TEST(LampEnergy, TheSolidAngleOfARectangleIsItsIntegral) {
  const dvec3 corners[4] = {{-1, -0.5, 2}, {1, -0.5, 2}, {1, 0.5, 2}, {-1, 0.5, 2}};
  // Closed form for a rectangle straight ahead.
  const double expected = 4 * std::asin(1.0 * 0.5 / std::sqrt((1.0 + 4) * (0.25 + 4)));
  EXPECT_NEAR(reference::rectangle_angle(corners), expected, 1e-12);
  const dvec3 all_round[4] = {{-1e6, -1e6, 1e-3}, {1e6, -1e6, 1e-3}, {1e6, 1e6, 1e-3}, {-1e6, 1e6, 1e-3}};
  EXPECT_NEAR(reference::rectangle_angle(all_round), 2 * std::numbers::pi, 1e-6);
}

}  // namespace
}  // namespace rg::test
