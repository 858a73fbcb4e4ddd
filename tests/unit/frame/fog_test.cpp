// The fog's passes on the GPU against its equations in double precision, and against itself.
#include "tests/reference/fog.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/reference/culling.h"
#include "tests/reference/glsl.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;

namespace shader {
using frame::FOG_CASCADES;
using glm::mix;
using reference::glsl::clamp, reference::glsl::min, reference::glsl::vec4;
#include "passes/fog/cascades.glsl"
}  // namespace shader

// ---- cascades

TEST(FogCascades, SlicesAndDepthsAreInverse) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int table = 0; table < 200; ++table) {
    const float start = 0.05f + unit(random);
    glm::vec4 ends(start);
    for (int i = 0; i < 4; ++i) ends[i] = (i == 0 ? start : ends[i - 1]) + 0.3f + 40 * unit(random);
    float before = start;
    for (int i = 0; i <= 512; ++i) {
      const float slice = 0.25f * static_cast<float>(i), depth = shader::slice_to_depth(slice, 128, start, ends);
      ASSERT_NEAR(shader::depth_to_slice(depth, 128, start, ends), slice, 2e-3f);
      ASSERT_TRUE(i == 0 || depth > before) << "depth grows with the slice";
      before = depth;
    }
    EXPECT_FLOAT_EQ(shader::slice_to_depth(0, 128, start, ends), start);
    EXPECT_FLOAT_EQ(shader::slice_to_depth(128, 128, start, ends), ends[3]);
  }
}

TEST(FogCascades, MeetAtTheirJoints) {
  const glm::vec4 ends(3, 9, 20, 70);
  for (int joint = 1; joint < 4; ++joint) {
    const float slice = 32.0f * static_cast<float>(joint);
    EXPECT_NEAR(shader::slice_to_depth(slice - 1e-3f, 128, 0.2f, ends), ends[joint - 1], 3e-3f);
    EXPECT_FLOAT_EQ(shader::slice_to_depth(slice, 128, 0.2f, ends), ends[joint - 1]);
    EXPECT_NEAR(shader::slice_to_depth(slice + 1e-3f, 128, 0.2f, ends), ends[joint - 1], 3e-3f);
    EXPECT_NEAR(shader::depth_to_slice(std::nextafter(ends[joint - 1], 0.0f), 128, 0.2f, ends), slice, 1e-3f);
    EXPECT_FLOAT_EQ(shader::depth_to_slice(ends[joint - 1], 128, 0.2f, ends), slice);
  }
}

// ---- a scene with fog

demo::FogBox make_box(glm::vec3 center, glm::vec3 half, float turn, float density) {
  demo::FogBox box;
  box.transform = glm::scale(glm::rotate(glm::translate(glm::mat4(1), center), turn, glm::vec3(0.3f, 1, 0.2f)), half);
  box.density = density;
  return box;
}

Scene make_misty_floor() {
  Scene scene = make_floor();
  scene.cameras[0].fog_reach = 20;
  scene.sun.color = {2, 1.5f, 1};
  scene.sun.ambient = {0.1f, 0.2f, 0.4f};
  scene.sun.direction = glm::normalize(glm::vec3(0.3f, 0.8f, -0.4f));
  scene.fog.density = 0.05f;
  scene.fog.ground = 0.5f;
  scene.fog.thinning = 0.3f;
  scene.fog.phase = 0.4f;
  scene.fog.albedo = {0.9f, 0.8f, 0.7f};
  scene.fog.boxes = {make_box({0, 1, 0}, {2, 0.5f, 1}, 0.4f, 0.3f), make_box({1, 0.5f, 1}, {1.5f, 1, 1}, 1.2f, 0.2f),
                     make_box({-3, 0, -2}, {1, 1, 3}, -0.7f, 0.5f)};
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(-5, 5);
  for (int i = 0; i < 24; ++i) {
    demo::Light light;
    light.position = {place(random), 0.5f + 0.3f * std::abs(place(random)), place(random)};
    light.color = glm::vec3(1.0f, 0.6f, 0.3f) * (0.5f + 0.1f * static_cast<float>(i));
    light.range = 2 + 0.2f * static_cast<float>(i);
    light.direction = {place(random), -3, place(random)};
    if (i % 2 == 0) light.features = demo::lamp::round;
    scene.lights.push_back(light);
  }
  return scene;
}

const Scene& misty_floor() {
  static const Scene scene = make_misty_floor();
  return scene;
}
Lab& misty_lab() {
  static Lab lab(misty_floor(), 160, 90);
  return lab;
}

struct Volume {  // of froxels
  Texels texels;
  glm::ivec3 count;
  const glm::vec4& at(int x, int y, int z) const { return texels.data[static_cast<size_t>((z * count.y + y) * count.x + x)]; }
};
Volume read(Lab& lab, const FrameData& data, Index after, Index what) {
  Volume volume{lab.image(data, after, what), glm::ivec3(data.fog.count.x, data.fog.count.y, data.fog.count.z)};
  EXPECT_EQ(volume.texels.data.size(), static_cast<size_t>(volume.count.x * volume.count.y * volume.count.z));
  return volume;
}

template <class Check>
void for_some_froxels(glm::ivec3 count, Check check) {
  for (int z = 0; z < count.z; z += 3)
    for (int y = 0; y < count.y; ++y)
      for (int x = 0; x < count.x; ++x) check(x, y, z);
}

glm::dvec3 middle_of(const FrameData& data, int x, int y, int z) {
  return reference::froxel_position(data.view, data.fog, glm::dvec3(x, y, z) + 0.5);
}

// ---- clusters

TEST(FogClusters, HoldEveryLampAndBoxThatReachesAFroxel) {
  Lab& lab = misty_lab();
  const FrameData data = lab.prepare();
  const std::vector<Dump> dumps = lab.dumps(data, {{pass::froxel_fog_clusters_cull, resource::froxel_fog_cluster_lights},
                                                   {pass::froxel_fog_clusters_cull, resource::froxel_fog_cluster_volumes}});
  const auto lamps = values_of<uint32_t>(dumps[0]), boxes = values_of<uint32_t>(dumps[1]);
  const std::vector<frame::FogVolume> volumes = demo::make_fog_volumes(misty_floor());
  const glm::ivec3 count(data.fog.count.x, data.fog.count.y, data.fog.count.z), clusters = (count + 3) / 4;
  uint32_t missing = 0, lit = 0, bits = 0;
  for_some_froxels(count, [&](int x, int y, int z) {
    const size_t cluster = static_cast<size_t>((z / 4 * clusters.y + y / 4) * clusters.x + x / 4);
    const glm::dvec3 p = middle_of(data, x, y, z);
    for (uint32_t i = 0; i < data.lights.size(); ++i) {
      frame::Light light = data.lights[i];
      light.range -= 1e-3f;
      if (!reference::contains(light, p)) continue;
      ++lit;
      missing += (lamps[cluster * frame::LIGHT_WORDS + i / 32] >> (i % 32) & 1) == 0;
    }
    for (uint32_t i = 0; i < volumes.size(); ++i) missing += reference::holds(volumes[i], p) && (boxes[cluster] >> i & 1) == 0;
  });
  EXPECT_EQ(missing, 0u);
  EXPECT_GT(lit, 5000u);
  const size_t used = static_cast<size_t>(clusters.x) * clusters.y * clusters.z;  // the buffer has room for more
  for (size_t cluster = 0; cluster < used; ++cluster) bits += static_cast<uint32_t>(std::popcount(boxes[cluster]));
  EXPECT_LT(bits, used) << "boxes are kept out of most clusters";
}

// ---- media

TEST(FogInject, IsTheSumOfHeightFogAndBoxes) {
  Lab& lab = misty_lab();
  const FrameData data = lab.prepare();
  const Volume density = read(lab, data, pass::froxel_fog_merged, resource::froxel_fog_memory);  // in `a`; before history it is the extinction itself
  const std::vector<frame::FogVolume> volumes = demo::make_fog_volumes(misty_floor());
  for_some_froxels(density.count, [&](int x, int y, int z) {
    const double expected = reference::fog_density(data.fog, volumes, middle_of(data, x, y, z));
    ASSERT_NEAR(density.at(x, y, z).a, expected, 1e-3 * expected + 2e-6) << x << " " << y << " " << z;
  });
}

TEST(FogInject, DoesNotDependOnTheOrderOfBoxes) {
  Scene turned = misty_floor();
  std::reverse(turned.fog.boxes.begin(), turned.fog.boxes.end());
  Lab other(turned, 160, 90);
  const FrameData data = misty_lab().prepare();
  const Volume a = read(misty_lab(), data, pass::froxel_fog_merged, resource::froxel_fog_memory);
  const Volume b = read(other, other.prepare(), pass::froxel_fog_merged, resource::froxel_fog_memory);
  for (size_t i = 0; i < a.texels.data.size(); ++i) ASSERT_NEAR(a.texels.data[i].a, b.texels.data[i].a, 1e-3f * a.texels.data[i].a);
}

TEST(FogInject, MasksMoveAndComeBackAfterOnePeriod) {
  Scene scene = make_floor();
  scene.textures[0] = plaza().textures[plaza().fog.boxes[0].layer];
  scene.fog.boxes = {make_box({0, 0.5f, 0}, {5, 1, 5}, 0, 0.5f)};
  scene.fog.boxes[0].scroll = {0.25f, 0.5f};
  Lab lab(scene, 160, 90);
  const auto density_at = [&](float time) {
    FrameData data = lab.prepare();
    data.view.time = time;
    return read(lab, data, pass::froxel_fog_merged, resource::froxel_fog_memory);
  };
  const Volume start = density_at(0), between = density_at(1.3f), period = density_at(4);  // one repeat across, two along
  double moved = 0;
  for (size_t i = 0; i < start.texels.data.size(); ++i) {
    ASSERT_NEAR(start.texels.data[i].a, period.texels.data[i].a, 2e-3f);
    moved += std::abs(start.texels.data[i].a - between.texels.data[i].a);
  }
  EXPECT_GT(moved, 10.0);
}

// ---- light

TEST(FogLight, IsWhatLampsSunAndSkyScatter) {
  Lab& lab = misty_lab();
  FrameData data = lab.prepare();
  for (auto& column : data.view.world_to_sun.column) column.x = 100;  // everything lies beside the shadow map: nothing is in shadow
  const std::vector<frame::FogVolume> volumes = demo::make_fog_volumes(misty_floor());
  const Volume light = read(lab, data, pass::froxel_fog_merged, resource::froxel_fog_memory);
  for_some_froxels(light.count, [&](int x, int y, int z) {
    const glm::dvec3 p = middle_of(data, x, y, z);
    const glm::dvec3 expected = reference::scattered_light(data.view, data.fog, data.lights, p) * reference::to_double(data.fog.albedo) *
                                reference::fog_density(data.fog, volumes, p);
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(light.at(x, y, z)[i], expected[i], 3e-3 * expected[i] + 2e-6) << x << " " << y << " " << z;
  });
}

// A term that is left out gives the same bits as one whose light is dark.
TEST(FogLight, TermsLeftOutAreTermsInTheDark) {
  Lab& lab = misty_lab();
  constexpr uint32_t kSun = 1, kLights = 2, kSky = 4;
  const auto inscatter = [&](uint32_t terms, bool sun, bool lights, bool sky) {
    FrameData data = lab.prepare();
    data.features.fog_sun = (terms & kSun) != 0, data.features.fog_lights = (terms & kLights) != 0, data.features.fog_ambient = (terms & kSky) != 0;
    if (!sun) data.view.sun_color = {0, 0, 0};
    if (!sky) data.view.ambient = {0, 0, 0};
    if (!lights)
      for (frame::Light& light : data.lights) light.color = {0, 0, 0};
    return lab.image(data, pass::froxel_fog_merged, resource::froxel_fog_memory).data;
  };
  const uint32_t all = kSun | kLights | kSky;
  for (uint32_t terms = 0; terms < 8; ++terms) {
    const bool sun = (terms & kSun) != 0, lights = (terms & kLights) != 0, sky = (terms & kSky) != 0;
    const std::vector<glm::vec4> chosen = inscatter(terms, true, true, true);
    EXPECT_EQ(chosen, inscatter(all, sun, lights, sky)) << "terms " << terms;
    EXPECT_EQ(terms != 0, std::any_of(chosen.begin(), chosen.end(), [](const glm::vec4& light) { return light.x > 0; })) << "terms " << terms;
  }
}

// ---- sums

// Positive, of `bits` bits of fraction.
float small_float(float value, int bits) {
  const int lost = 23 - bits;
  return std::bit_cast<float>(std::bit_cast<uint32_t>(value) >> lost << lost);
}

TEST(FogIntegrate, IsTheSumInDoublePrecision) {
  Lab& lab = misty_lab();
  const FrameData data = lab.prepare();
  const Volume media = read(lab, data, pass::froxel_fog_merged, resource::froxel_fog_memory);
  const Volume light = read(lab, data, pass::froxel_fog_merged, resource::scattered);
  const Volume through = read(lab, data, pass::froxel_fog_merged, resource::transmittance);
  for (int y = 0; y < light.count.y; ++y)
    for (int x = 0; x < light.count.x; ++x) {
      std::vector<glm::dvec3> source;
      std::vector<double> density;
      for (int z = 0; z < light.count.z; ++z) {
        const glm::vec4& m = media.at(x, y, z);  // what lies between the kernel's blocks has fewer bits
        source.emplace_back(small_float(m.r, 6), small_float(m.g, 6), small_float(m.b, 5));
        density.push_back(m.a);
      }
      const std::vector<reference::FogSum> sums = reference::march(data.view, data.fog, {x, y}, source, density);
      for (int z = 0; z < light.count.z; ++z) {
        const reference::FogSum& sum = sums[static_cast<size_t>(z)];
        ASSERT_NEAR(through.at(x, y, z).x, sum.through, 6e-4) << x << " " << y << " " << z;
        for (int i = 0; i < 3; ++i)  // 6 bits of mantissa in red and green, 5 in blue
          ASSERT_NEAR(light.at(x, y, z)[i], sum.light[i], (i == 2 ? 1.0 / 32 : 1.0 / 64) * sum.light[i] + 2e-5) << x << " " << y << " " << z;
        if (z == 0) continue;
        ASSERT_LE(through.at(x, y, z).x, through.at(x, y, z - 1).x);
        ASSERT_GE(light.at(x, y, z).x, light.at(x, y, z - 1).x);
      }
    }
}

TEST(FogIntegrate, EvenFogIsExponential) {
  Scene scene = make_floor();
  scene.cameras[0].fog_reach = 40;
  scene.sun.ambient = {0.5f, 0.25f, 1};
  scene.fog.density = 0.125f;
  scene.fog.ground = 1000;
  scene.fog.albedo = {0.5f, 1, 0.75f};
  Lab lab(scene, 96, 64);
  const FrameData data = lab.prepare();
  const Volume light = read(lab, data, pass::froxel_fog_merged, resource::scattered);
  const Volume through = read(lab, data, pass::froxel_fog_merged, resource::transmittance);
  for (int y = 0; y < light.count.y; ++y)
    for (int x = 0; x < light.count.x; ++x)
      for (int z = 0; z < light.count.z; ++z) {
        const double front = glm::distance(reference::froxel_position(data.view, data.fog, {x + 0.5, y + 0.5, 0}),
                                           reference::froxel_position(data.view, data.fog, {x + 0.5, y + 0.5, z + 1}));
        const double passes = std::exp(-0.125 * front);
        ASSERT_NEAR(through.at(x, y, z).x, passes, 1e-3);
        const glm::dvec3 expected = glm::dvec3(0.25, 0.25, 0.75) * (1 - passes);
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(light.at(x, y, z)[i], expected[i], (i == 2 ? 1.0 / 32 : 1.0 / 64) * expected[i] + 1e-4);
      }
}

TEST(FogIntegrate, NoFogIsNothing) {
  Scene scene = make_floor();
  scene.sun.ambient = {0.5f, 0.25f, 1};
  Lab lab(scene, 96, 64);
  const FrameData data = lab.prepare();
  for (const glm::vec4& t : lab.image(data, pass::froxel_fog_merged, resource::transmittance).data) ASSERT_EQ(t.x, 1);
  for (const glm::vec4& s : lab.image(data, pass::froxel_fog_merged, resource::scattered).data) ASSERT_EQ(glm::vec3(s), glm::vec3(0));
}

// ---- time

// One frame's fog with the sample at `jitter`, or what history makes of many.
std::vector<glm::vec4> memory_of(Lab& lab, uint32_t frames, float blend, const std::vector<glm::vec3>& jitters) {
  FrameData data = lab.prepare();
  for (uint32_t i = 0; i < frames; ++i) {
    const glm::vec3 j = jitters[i % jitters.size()];
    data.fog.jitter = {j.x, j.y, j.z};
    data.fog.blend = i == 0 ? 1 : blend;
    if (i + 1 < frames) lab.render(data);
  }
  return lab.image(data, pass::froxel_fog_merged, resource::froxel_fog_memory).data;
}

double distance_between(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i].a - b[i].a);
  return sum / static_cast<double>(a.size());
}

TEST(FogHistory, ComesToTheMeanOverTheJitter) {
  Lab& lab = misty_lab();
  const std::vector<glm::vec3> jitters = {{-0.4f, 0.2f, 0.45f}, {0.3f, -0.3f, -0.25f}, {0.1f, 0.4f, 0.1f}, {-0.1f, -0.2f, -0.4f}};
  std::vector<glm::vec4> mean;
  double single = 0;
  for (const glm::vec3 j : jitters) {
    const std::vector<glm::vec4> one = memory_of(lab, 1, 1, {j});
    if (mean.empty()) mean.resize(one.size(), glm::vec4(0));
    for (size_t i = 0; i < one.size(); ++i) mean[i] += 0.25f * one[i];
  }
  for (const glm::vec3 j : jitters) single += 0.25 * distance_between(memory_of(lab, 1, 1, {j}), mean);
  const double settled = distance_between(memory_of(lab, 96, 0.05f, jitters), mean);
  EXPECT_GT(single, 1e-3);
  EXPECT_LT(settled, 0.15 * single) << "history is " << settled << " from the mean, a frame " << single;
}

TEST(FogHistory, KeepsWhatDoesNotChange) {
  Lab& lab = misty_lab();
  const std::vector<glm::vec4> one = memory_of(lab, 1, 1, {glm::vec3(0)}), many = memory_of(lab, 12, 0.1f, {glm::vec3(0)});
  for (size_t i = 0; i < one.size(); ++i)
    for (int c = 0; c < 4; ++c) ASSERT_NEAR(many[i][c], one[i][c], 2e-3f * std::abs(one[i][c]) + 2e-6f) << "froxel " << i;
}

// An even fog stays even while the cascades move, and nothing leaks in from where nothing is known.
TEST(FogHistory, SurvivesNewCascades) {
  Scene scene = make_floor();
  scene.sun.ambient = {0.5f, 0.5f, 0.5f};
  scene.fog.density = 0.125f;
  scene.fog.ground = 1000;
  scene.fog.albedo = {1, 1, 1};
  Lab lab(scene, 96, 64);
  FrameData data = lab.prepare();
  lab.render(data);
  const rg::vec4 tables[] = {{2, 6, 14, 30}, {5, 20, 60, 200}, {1, 2, 4, 8}};
  for (const rg::vec4& ends : tables) {
    data.fog.previous_ends = data.fog.ends;
    data.fog.ends = ends;
    data.fog.blend = 0.1f;
    for (const glm::vec4& m : lab.image(data, pass::froxel_fog_merged, resource::froxel_fog_memory).data) {
      ASSERT_NEAR(m.a, 0.125f, 2e-4f);
      ASSERT_NEAR(m.r, 0.0625f, 1e-4f);
    }
  }
}

}  // namespace
}  // namespace rg::test
