// The culling passes on the GPU against brute force: depth range, z-bins, bit arrays, records.
#include "tests/reference/culling.h"

#include <bit>

#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;
constexpr uint32_t kWords = frame::LIGHT_WORDS;

bool has(const std::vector<uint32_t>& words, size_t tile, uint32_t light) { return (words[tile * kWords + light / 32] >> (light % 32) & 1) != 0; }

// Least and greatest depth of the block of source texels that a texel of mip `mip` covers: 8 pixels a side, doubling, the last one to the edge.
glm::vec2 brute_range(const Texels& depth, int x, int y, int mip, int columns, int rows) {
  const int side = frame::TILE << mip;
  const int right = x == columns - 1 ? depth.width : (x + 1) * side, bottom = y == rows - 1 ? depth.height : (y + 1) * side;
  glm::vec2 range(1, 0);
  for (int v = y * side; v < bottom; ++v)
    for (int u = x * side; u < right; ++u) range = {std::min(range.x, depth.at(u, v).x), std::max(range.y, depth.at(u, v).x)};
  return range;
}

TEST(DepthRange, EveryMipIsExact) {
  Lab& lab = plaza_lab();
  const FrameData data = lab.prepare();
  std::vector<DumpOf> what{{pass::depth_props, resource::depth}};
  for (uint32_t mip = 0; mip < 5; ++mip) what.push_back({pass::light_occlusion, resource::depth_range, mip});
  const std::vector<Dump> all = lab.dumps(data, what);
  const Texels depth = texels_of(all[0]);
  ASSERT_EQ(depth.width, static_cast<int>(kWidth));
  for (uint32_t mip = 0; mip < 5; ++mip) {  // 27 x 15 texels, down to 1 x 1
    const Texels range = texels_of(all[1 + mip]);
    ASSERT_EQ(range.width, std::max(27 >> mip, 1));
    ASSERT_EQ(range.height, std::max(15 >> mip, 1));
    for (int y = 0; y < range.height; ++y)
      for (int x = 0; x < range.width; ++x) {
        const glm::vec2 expected = brute_range(depth, x, y, static_cast<int>(mip), range.width, range.height);
        ASSERT_EQ(range.at(x, y).x, expected.x) << "mip " << mip << " at " << x << " " << y;
        ASSERT_EQ(range.at(x, y).y, expected.y) << "mip " << mip << " at " << x << " " << y;
      }
  }
}

TEST(ZBins, GpuBuildIsTheCpuBuild) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const FrameData data = lab.prepare(camera);
    const std::vector<uint32_t> bins = lab.buffer<uint32_t>(data, pass::zbin_pack, resource::zbins);
    const std::vector<uint32_t> expected = reference::build_zbins(data.lights, data.view.zbin_scale);
    ASSERT_EQ(bins.size(), expected.size());
    for (size_t i = 0; i < bins.size(); ++i) ASSERT_EQ(bins[i], expected[i]) << "bin " << i << " of camera " << camera;
  }
}

// Calls check(x, y, light) for every pixel of something solid and every light whose volume it lies in. The volume is shrunk by
// a millimetre for rounding.
template <class Check>
uint64_t for_each_contribution(const Texels& depth, const FrameData& data, Check check) {
  uint64_t count = 0;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      if (depth.at(x, y).x <= 0) continue;
      const glm::dvec3 point = reference::world_position(data.view, x, y, depth.at(x, y).x);
      for (uint32_t i = 0; i < data.lights.size(); ++i) {
        frame::Light light = data.lights[i];
        light.range -= 1e-3f;
        if (!reference::contains(light, point)) continue;
        ++count;
        check(x, y, i);
      }
    }
  return count;
}

TEST(TileLights, HoldEveryLightThatReachesAPixel) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const FrameData data = lab.prepare(camera, {.number = 3, .noise = false, .animate = true});
    const std::vector<Dump> all = lab.dumps(
        data, {{pass::depth_props, resource::depth}, {pass::light_cull, resource::tile_lights}, {pass::light_cull, resource::forward_lights}});
    const Texels depth = texels_of(all[0]);
    const std::vector<uint32_t> solid = values_of<uint32_t>(all[1]), forward = values_of<uint32_t>(all[2]);
    uint32_t missing = 0;
    const uint64_t contributions = for_each_contribution(depth, data, [&](int x, int y, uint32_t light) {
      const size_t tile = tile_of(x, y, frame::TILE);
      if (!has(solid, tile, light) || !has(forward, tile, light)) ++missing;
    });
    EXPECT_EQ(missing, 0u) << "camera " << plaza().cameras[camera].name;
    EXPECT_GT(contributions, 50000u);
    uint64_t bits = 0, extra = 0;
    for (size_t i = 0; i < solid.size(); ++i) {
      ASSERT_EQ(solid[i] & ~forward[i], 0u) << "a light that reaches the solid part of a tile reaches the tile";
      bits += static_cast<uint64_t>(std::popcount(solid[i]));
      for (uint32_t bit = 0; bit < 32; ++bit)
        if ((forward[i] >> bit & 1) != 0 && i % kWords * 32 + bit >= data.lights.size()) ++extra;
    }
    EXPECT_EQ(extra, 0u) << "bits of lights that do not exist";
    EXPECT_LT(bits, solid.size() / kWords * data.lights.size() / 4) << "culling leaves less than a quarter of all pairs";
  }
}

TEST(TileRecords, HoldEveryContributingLightInOrder) {
  Lab& lab = plaza_lab();
  const FrameData data = lab.prepare(1);
  const std::vector<Dump> all = lab.dumps(data, {{pass::depth_props, resource::depth}, {pass::tile_cull, resource::tile_records}});
  const Texels depth = texels_of(all[0]);
  const std::vector<Record> records = values_of<Record>(all[1]);
  ASSERT_EQ(records.size(), size_t{14 * 8});
  for (const Record& record : records) {
    ASSERT_LE(record.count, 64u);
    ASSERT_TRUE(record.overflow == 0 || record.count == 64);
    for (uint32_t i = 1; i < record.count; ++i) ASSERT_LT(record.light[i - 1], record.light[i]);
    for (uint32_t i = record.count; i < 64; ++i) ASSERT_EQ(record.light[i], 0u);
  }
  uint32_t missing = 0;
  for_each_contribution(depth, data, [&](int x, int y, uint32_t light) {
    const Record& record = records[tile_of(x, y, frame::SHADE_TILE)];
    if (record.overflow == 0 && std::find(record.light, record.light + record.count, light) == record.light + record.count) ++missing;
  });
  EXPECT_EQ(missing, 0u);
}

// Lights above the middle of the floor that all reach all of it.
Scene make_crowd(uint32_t lights) {
  Scene scene = make_floor();
  for (uint32_t i = 0; i < lights; ++i) {
    demo::Light light;
    light.position = {0.001f * static_cast<float>(i), 1, 0};
    light.range = 40;
    scene.lights.push_back(light);
  }
  return scene;
}

TEST(TileRecords, KeepTheLowestIndicesOnOverflow) {
  for (const uint32_t lights : {64u, 65u, 200u}) {
    const Scene scene = make_crowd(lights);
    Lab lab(scene, 96, 64);
    const FrameData data = lab.prepare();
    const std::vector<Dump> all = lab.dumps(data, {{pass::depth_props, resource::depth}, {pass::tile_cull, resource::tile_records}});
    const Texels depth = texels_of(all[0]);
    const std::vector<Record> records = values_of<Record>(all[1]);
    uint32_t covered = 0;
    for (int y = 0; y < depth.height; y += frame::SHADE_TILE)
      for (int x = 0; x < depth.width; x += frame::SHADE_TILE) {
        if (depth.at(x + 8, y + 8).x <= 0) continue;
        const Record& record = records[tile_of(x, y, frame::SHADE_TILE, 96)];
        ++covered;
        ASSERT_EQ(record.count, 64u);
        ASSERT_EQ(record.overflow, lights - 64);
        for (uint32_t i = 0; i < 64; ++i) ASSERT_EQ(record.light[i], i);
      }
    EXPECT_GT(covered, 8u);
  }
}

TEST(MeshCull, DrawsWhateverHasAVertexInView) {
  struct Arguments {
    uint32_t vertex_count, instance_count, first_vertex, first_instance;
  };
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const FrameData data = lab.prepare(camera);
    const auto draws = lab.buffer<Arguments>(data, pass::mesh_cull, resource::world_draws);
    ASSERT_EQ(draws.size(), static_cast<size_t>(frame::MAX_INSTANCES));
    uint32_t drawn = 0;
    for (size_t i = 0; i < draws.size(); ++i) {
      drawn += draws[i].instance_count;
      ASSERT_TRUE(draws[i].instance_count == 0 || draws[i].first_instance == i);
      if (i >= data.instances.size() || draws[i].instance_count > 0 || plaza().instances[i].glass) continue;
      const demo::Instance& instance = plaza().instances[i];
      const demo::Mesh& mesh = plaza().meshes[instance.mesh];
      const glm::dmat4 to_clip = reference::to_double(data.view.world_to_clip) * glm::dmat4(instance.transform);
      for (uint32_t k = 0; k < mesh.index_count; ++k) {
        const glm::dvec4 clip = to_clip * glm::dvec4(plaza().vertices[plaza().indices[mesh.first_index + k]].position, 1);
        ASSERT_FALSE(clip.w > data.view.near && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w) << mesh.name << " is seen, but culled";
      }
    }
    const auto counts = lab.graph().cull_counts();
    ASSERT_TRUE(counts) << counts.error().message;
    EXPECT_EQ((*counts)[frame::COUNT_VISIBLE], drawn);
    EXPECT_EQ((*counts)[frame::COUNT_VISIBLE] + (*counts)[frame::COUNT_OUTSIDE], data.instances.size());
    EXPECT_GT(drawn, 50u);
    EXPECT_LT(drawn, data.instances.size());
  }
}

}  // namespace
}  // namespace rg::test
