// Light masks and the cone test, straight from the shaders' source: B5 and B16.
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "tests/reference/culling.h"
#include "tests/reference/glsl.h"

namespace rg::test {
namespace {

namespace shader {
using reference::glsl::uint, reference::glsl::vec3, reference::glsl::dot, reference::glsl::min, reference::glsl::max, reference::glsl::clamp,
    reference::glsl::sqrt;
constexpr int ZBINS = frame::ZBINS;
struct {
  float zbin_scale = 64;
} camera;
#include "passes/culling/cone.glsl"
#include "passes/culling/zbin.glsl"
}  // namespace shader

using Random = std::mt19937;
double between(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

struct Visits {
  uint64_t truth = 0, exact = 0, slide = 0, tile = 0;
};

// Lights with random depth ranges, sorted; a pixel at a random depth in a tile with random bits.
void count_scene(Random& random, Visits& visits) {
  std::vector<frame::Light> lights(1 + random() % 512);
  for (frame::Light& light : lights) {
    const double middle = between(random, -4, 140), range = between(random, 0.1, 12);
    light.nearest = static_cast<float>(middle - range);
    light.farthest = static_cast<float>(middle + range);
  }
  std::sort(lights.begin(), lights.end(), [](const auto& a, const auto& b) { return a.nearest < b.nearest; });
  const std::vector<uint32_t> bins = reference::build_zbins(lights, shader::camera.zbin_scale);
  const float depth = static_cast<float>(between(random, 0.01, 140));
  const uint32_t bin = bins[shader::zbin_of(depth)], lo = bin & 0xFFFF, hi = bin >> 16;
  for (uint32_t word = 0; word < 16; ++word) {
    uint32_t truth = 0;
    const uint32_t tile = word * 32 < lights.size() ? random() | random() : 0;
    for (uint32_t bit = 0; bit < 32 && word * 32 + bit < lights.size(); ++bit) {
      const frame::Light& light = lights[word * 32 + bit];
      if (light.nearest <= depth && depth <= light.farthest) truth |= 1u << bit;
    }
    const uint32_t exact = tile & shader::zbin_mask(word, lo, hi), slide = tile & shader::zbin_mask_slide(word, lo, hi);
    truth &= tile;
    ASSERT_EQ(truth & ~exact, 0u) << "a light that reaches the pixel is masked out, word " << word << " of " << lo << ".." << hi;
    // The slides' mask is only asked for words between the first and the last light.
    const bool visited = lo <= hi && word >= lo / 32 && word <= hi / 32;
    ASSERT_EQ(exact & ~(visited ? slide : 0), 0u) << "exact is wider than the slides', word " << word << " of " << lo << ".." << hi;
    visits.truth += static_cast<uint64_t>(std::popcount(truth));
    visits.exact += static_cast<uint64_t>(std::popcount(exact));
    visits.slide += visited ? static_cast<uint64_t>(std::popcount(slide)) : 0;
    visits.tile += static_cast<uint64_t>(std::popcount(tile));
  }
}

TEST(Masks, TruthIsWithinExactWithinSlidesWithinTile) {
  Random random(5);
  Visits visits;
  for (int scene = 0; scene < 3000 && !HasFatalFailure(); ++scene) count_scene(random, visits);
  EXPECT_LT(visits.truth, visits.exact);
  EXPECT_LT(visits.exact, visits.slide);
  EXPECT_LT(visits.slide, visits.tile);
}

TEST(Masks, ExactMaskHoldsExactlyTheRange) {
  for (uint32_t lo = 0; lo < 96; lo += 5)
    for (uint32_t hi = lo; hi < 96; hi += 3)
      for (uint32_t word = 0; word < 3; ++word) {
        uint32_t expected = 0;
        for (uint32_t bit = 0; bit < 32; ++bit)
          if (word * 32 + bit >= lo && word * 32 + bit <= hi) expected |= 1u << bit;
        ASSERT_EQ(shader::zbin_mask(word, lo, hi), expected) << "word " << word << " of " << lo << ".." << hi;
      }
}

TEST(Masks, EmptyBinVisitsNothing) {
  for (uint32_t word = 0; word < 16; ++word) {
    EXPECT_EQ(shader::zbin_mask(word, 0xFFFF, 0), 0u);
    EXPECT_FALSE(word >= 0xFFFF / 32 && word <= 0) << "the loop over words is empty as well";
  }
}

TEST(ZBins, EveryLightIsInTheBinOfEveryDepthItReaches) {
  Random random(17);
  std::vector<frame::Light> lights(300);
  for (frame::Light& light : lights) {
    const double middle = between(random, 0, 150), range = between(random, 0.01, 20);
    light.nearest = static_cast<float>(middle - range);
    light.farthest = static_cast<float>(middle + range);
  }
  const std::vector<uint32_t> bins = reference::build_zbins(lights, shader::camera.zbin_scale);
  for (uint32_t bin : bins) ASSERT_TRUE((bin & 0xFFFF) <= bin >> 16 || bin == 0xFFFFu);
  for (int i = 0; i < 200000; ++i) {
    const uint32_t index = random() % lights.size();
    const float z = static_cast<float>(between(random, lights[index].nearest, lights[index].farthest));
    if (z < 0 || z < lights[index].nearest || z > lights[index].farthest) continue;
    const uint32_t bin = bins[shader::zbin_of(z)];
    ASSERT_TRUE((bin & 0xFFFF) <= index && index <= bin >> 16) << "light " << index << " at depth " << z;
  }
}

TEST(Cone, NeverRejectsWhatIntersects) {
  Random random(16);
  uint32_t intersecting = 0, rejected = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double angle = between(random, 0.03, 1.5), height = between(random, 0.2, 8), radius = between(random, 0.01, 4);
    const glm::dvec3 center(between(random, -10, 10), between(random, -10, 10), between(random, -6, 12));
    const bool touches = reference::cone_distance(center, angle, height) < radius * (1 - 1e-5);
    const bool kept = shader::cone_reaches(glm::vec3(0), glm::vec3(0, 0, 1), static_cast<float>(height), static_cast<float>(std::cos(angle)),
                                           static_cast<float>(std::sin(angle)), glm::vec3(center), static_cast<float>(radius));
    ASSERT_TRUE(kept || !touches) << "angle " << angle << " height " << height << " radius " << radius << " at " << center.x << " " << center.y << " "
                                  << center.z;
    intersecting += touches;
    rejected += !kept;
  }
  EXPECT_GT(intersecting, 100000u);
  EXPECT_GT(rejected, 100000u);
}

TEST(ConeDistance, OfKnownPoints) {
  const double quarter = 0.785398163397448;
  EXPECT_EQ(reference::cone_distance({0, 0, 1}, quarter, 2), 0);
  EXPECT_NEAR(reference::cone_distance({0, 0, -3}, quarter, 2), 3, 1e-12);
  EXPECT_NEAR(reference::cone_distance({0, 0, 5}, quarter, 2), 3, 1e-12);
  EXPECT_NEAR(reference::cone_distance({2, 0, 0}, quarter, 2), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(reference::cone_distance({3, 0, 2}, quarter, 2), 1, 1e-9);
}

}  // namespace
}  // namespace rg::test
