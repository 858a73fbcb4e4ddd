// A9: the lighting as a spectrum. Every tile is in one list, that of a kernel with all its features, and the picture is that of the full kernel.
#include "examples/demo/spectrum.h"

#include <algorithm>
#include <bit>

#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

using Features = frame::spectrum::light_features;
namespace pass = frame::pass;
namespace resource = frame::resource;

constexpr uint32_t kAll = (1u << frame::LAMP_FEATURES) - 1;
constexpr uint32_t kTilesX = (kWidth + frame::SHADE_TILE - 1) / frame::SHADE_TILE, kTilesY = (kHeight + frame::SHADE_TILE - 1) / frame::SHADE_TILE;
constexpr size_t kTiles = size_t{kTilesX} * kTilesY;
constexpr size_t kKernels = std::size(Features::kernels);

struct Lists {
  std::vector<uint32_t> masks, arguments, tiles, shown;  // shown: the image of kernels
  uint32_t count(size_t kernel) const { return arguments[3 * kernel]; }
  // Tile `i` of a kernel's list, row by row.
  size_t tile(size_t kernel, size_t i) const {
    const uint32_t at = tiles[kernel * kTiles + i];
    return (at >> 16) * kTilesX + (at & 0xFFFF);
  }
};

Lists lists_of(Lab& lab, const FrameData& data) {
  Lists lists;
  const Index after = pass::deferred_light_classify;
  const std::vector<Dump> all = lab.dumps(data, {{pass::tile_cull, resource::tile_features},
                                                 {after, resource::deferred_light_arguments},
                                                 {after, resource::deferred_light_tiles},
                                                 {after, resource::tile_kernels}});
  lists.masks = values_of<uint32_t>(all[0]);
  lists.arguments = values_of<uint32_t>(all[1]);
  lists.tiles = values_of<uint32_t>(all[2]);
  lists.shown = values_of<uint32_t>(all[3]);
  return lists;
}

// What the camera sees, and with features forced: some, all.
std::vector<FrameData> situations(Lab& lab, size_t camera) {
  std::vector<FrameData> all;
  for (const uint32_t forced : {0u, static_cast<uint32_t>(frame::LAMP_TUBE | frame::LAMP_CLIPPED), kAll}) {
    all.push_back(lab.prepare(camera));
    all.back().view.forced_features = forced;
  }
  return all;
}

TEST(LightSpectrum, KernelsAscendToTheOneWithEverything) {
  EXPECT_EQ(std::size(Features::features), static_cast<size_t>(frame::LAMP_FEATURES));
  ASSERT_GE(kKernels, 2u);
  EXPECT_EQ(Features::kernels[kKernels - 1], kAll);
  for (const uint32_t set : Features::kernels)
    EXPECT_TRUE((set & frame::LAMP_SOFT) == 0 || (set & frame::LAMP_SHADOW) != 0) << set << ": soft shadows are shadows";
}

TEST(LightSpectrum, EveryTileIsInExactlyOneList) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera)
    for (const FrameData& data : situations(lab, camera)) {
      const Lists lists = lists_of(lab, data);
      ASSERT_EQ(lists.arguments.size(), 3 * kKernels);
      ASSERT_EQ(lists.masks.size(), kTiles);
      std::vector<uint32_t> seen(kTiles, 0);
      size_t sum = 0;
      for (size_t kernel = 0; kernel < kKernels; ++kernel) {
        EXPECT_EQ(lists.arguments[3 * kernel + 1], 1u);
        EXPECT_EQ(lists.arguments[3 * kernel + 2], 1u);
        sum += lists.count(kernel);
        for (size_t i = 0; i < lists.count(kernel); ++i) ++seen[lists.tile(kernel, i)];
      }
      EXPECT_EQ(sum, kTiles);
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1u), static_cast<std::ptrdiff_t>(kTiles)) << plaza().cameras[camera].name;
    }
}

TEST(LightSpectrum, TheKernelOfATileIsTheFirstWithItsFeatures) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera)
    for (const FrameData& data : situations(lab, camera)) {
      const Lists lists = lists_of(lab, data);
      for (size_t kernel = 0; kernel < kKernels; ++kernel)
        for (size_t i = 0; i < lists.count(kernel); ++i) {
          const size_t tile = lists.tile(kernel, i);
          EXPECT_EQ(lists.masks[tile] & ~Features::kernels[kernel], 0u) << "tile " << tile << " lacks a feature";
          for (size_t cheaper = 0; cheaper < kernel; ++cheaper) EXPECT_NE(lists.masks[tile] & ~Features::kernels[cheaper], 0u) << "tile " << tile;
          EXPECT_EQ(lists.shown[tile], kernel);
        }
    }
}

TEST(LightSpectrum, ThePlazaUsesManyKernels) {
  Lab& lab = plaza_lab();
  std::vector<bool> used(kKernels, false);
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const Lists lists = lists_of(lab, lab.prepare(camera));
    for (size_t kernel = 0; kernel < kKernels; ++kernel) used[kernel] = used[kernel] || lists.count(kernel) > 0;
  }
  EXPECT_GE(std::count(used.begin(), used.end(), true), 4);
}

// Bit for bit, in the format of the picture.
TEST(LightSpectrum, ThePictureIsThatOfTheFullKernelOnEveryTile) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    FrameData data = lab.prepare(camera);
    const Dump chosen = lab.dump(data, deferred_light(), resource::hdr);
    data.view.forced_features = kAll;
    const std::vector<Dump> full =
        lab.dumps(data, {{deferred_light(), resource::hdr}, {pass::deferred_light_classify, resource::deferred_light_arguments}});
    ASSERT_EQ(chosen.bytes.size(), full[0].bytes.size());
    EXPECT_TRUE(chosen.bytes == full[0].bytes) << plaza().cameras[camera].name;
    EXPECT_EQ(values_of<uint32_t>(full[1])[3 * (kKernels - 1)], kTiles) << "all tiles were forced";
  }
}

// As `./x demo --record-spectrum FILE --time-kernels` does it. How long they take is the machine's business.
TEST(LightSpectrum, EveryKernelIsTimedOnTheTilesThatItCanServe) {
  auto renderer = demo::Renderer::create(device(), plaza(), {.width = kWidth, .height = kHeight, .submit_per_pass = true});
  ASSERT_TRUE(renderer) << renderer.error().message;
  SpectrumProfile profile(kernels_of<Features>());
  const FrameSettings settings{.width = kWidth, .height = kHeight, .jitter = false, .noise = false, .animate = false};
  const Status timed = demo::time_kernels(*renderer, plaza(), plaza().cameras[0], settings, 1, 1, profile);
  ASSERT_TRUE(timed) << timed.error().message;
  const auto costs = profile.costs();
  ASSERT_GE(costs.size(), 4u);
  EXPECT_EQ(costs.back().first, kAll) << "it can serve every tile";
  for (const auto& [set, ms] : costs) EXPECT_GT(ms, 0) << set;
}

}  // namespace
}  // namespace rg::test
