// Deferred shading against a double-precision sum over all lights, and its light paths against each other.
#include "tests/reference/shading.h"

#include "examples/demo/mesh_builder.h"
#include "tests/reference/culling.h"
#include "tests/unit/frame/surfaces.h"

namespace rg::test {
namespace {

namespace pass = frame::pass;
namespace resource = frame::resource;

TEST(DeferredLight, IsTheSumOverAllLamps) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    FrameData data = lab.prepare(camera);
    keep_lamps_only(data);
    const GBuffer g = read_gbuffer(lab, data);
    const reference::LampTextures lookups = make_lookups(lab, data, plaza());
    const std::vector<Dump> dumps = lab.dumps(data, {{pass::tile_cull, resource::tile_records}, {deferred_light(), resource::hdr}});
    const std::vector<Record> records = values_of<Record>(dumps[0]);
    const Texels hdr = texels_of(dumps[1]);
    uint32_t compared = 0;
    for (int y = 1; y < hdr.height; y += 5)
      for (int x = 2; x < hdr.width; x += 7) {
        if (g.depth.at(x, y).x <= 0 || records[tile_of(x, y, frame::SHADE_TILE)].overflow > 0) continue;
        const reference::SurfacePoint s = surface_at(g, data, x, y);
        const glm::dvec3 lit = reference::lamps_radiance(s, data.lights, lookups);
        if (glm::dot(s.normal, s.eye) < 0.02 || std::isnan(lit.x)) continue;
        const glm::dvec3 expected = glm::max(lit, 0.0) + glm::dvec3(g.emissive.at(x, y));
        ASSERT_NO_FATAL_FAILURE(expect_close(hdr.at(x, y), expected, 1e-2, glm::dvec3(1e-5), x, y)) << plaza().cameras[camera].name;
        ++compared;
      }
    EXPECT_GT(compared, 300u);
  }
}

uint32_t differing(const Texels& a, const Texels& b) {
  uint32_t count = 0;
  for (size_t i = 0; i < a.data.size(); ++i) count += a.data[i] != b.data[i];
  return count;
}

TEST(LightPaths, MaskedByZBinsOrNotTheImageIsTheSame) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    const auto shade = [&](int32_t path) {
      FrameData data = lab.prepare(camera);
      data.view.light_path = static_cast<uint32_t>(path);
      return lab.image(data, pass::transparent, resource::hdr);
    };
    const Texels flat = shade(frame::LIGHT_PATH_FLAT);
    EXPECT_EQ(differing(flat, shade(frame::LIGHT_PATH_ZBIN)), 0u);
    EXPECT_EQ(differing(flat, shade(frame::LIGHT_PATH_SLIDE)), 0u);
    EXPECT_EQ(differing(flat, shade(frame::LIGHT_PATH_ALL)), 0u);
  }
}

TEST(LightPaths, RecordsGiveTheSameImageWhereNoneOverflows) {
  Lab& lab = plaza_lab();
  for (size_t camera = 0; camera < plaza().cameras.size(); ++camera) {
    FrameData data = lab.prepare(camera);
    const std::vector<Dump> dumps = lab.dumps(data, {{pass::tile_cull, resource::tile_records}, {deferred_light(), resource::hdr}});
    const std::vector<Record> records = values_of<Record>(dumps[0]);
    const Texels by_record = texels_of(dumps[1]);
    data.view.light_path = static_cast<uint32_t>(frame::LIGHT_PATH_ALL);
    const Texels by_all = lab.image(data, deferred_light(), resource::hdr);
    uint32_t different = 0;
    for (int y = 0; y < by_all.height; ++y)
      for (int x = 0; x < by_all.width; ++x)
        different += records[tile_of(x, y, frame::SHADE_TILE)].overflow == 0 && by_record.at(x, y) != by_all.at(x, y);
    EXPECT_EQ(different, 0u) << plaza().cameras[camera].name;
  }
}

// What the shader does with the shadow map, in double. `certain` is false where a compare is too close to call.
double sun_visibility(const Texels& shadow, const FrameData& data, const reference::SurfacePoint& s, bool& certain) {
  const glm::dvec3 sun = reference::to_double(data.view.sun_direction);
  const double slant = 1 - std::clamp(glm::dot(s.normal, sun), 0.0, 1.0);
  const glm::dvec3 at =
      reference::to_double(data.view.world_to_sun) * glm::dvec4(s.position + s.normal * (data.view.sun_texel * (0.6 + 1.8 * slant)), 1);
  if (std::abs(at.x) > 1 || std::abs(at.y) > 1) return 1;
  const glm::dvec2 texel = (glm::dvec2(at) * 0.5 + 0.5) * static_cast<double>(shadow.width) - 0.5, base = glm::floor(texel), f = texel - base;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int u = std::clamp(static_cast<int>(base.x) + k % 2, 0, shadow.width - 1),
              v = std::clamp(static_cast<int>(base.y) + k / 2, 0, shadow.height - 1);
    const double difference = at.z + 0.0004 - shadow.at(u, v).x;
    if (std::abs(difference) < 2e-6) certain = false;
    const double weight = (k % 2 == 0 ? 1 - f.x : f.x) * (k / 2 == 0 ? 1 - f.y : f.y);
    sum += difference >= 0 ? weight : 0;
  }
  return sum;
}

TEST(DeferredLight, SunGoesThroughTheShadowMap) {
  Lab& lab = plaza_lab();
  FrameData data = lab.prepare(2);
  clear_fog(data);
  data.view.ambient = {0, 0, 0};
  data.view.light_count = 0;
  data.lights.clear();
  const GBuffer g = read_gbuffer(lab, data);
  const Texels shadow = lab.image(data, pass::sun_shadow_props, resource::sun_shadow);
  ASSERT_EQ(shadow.width, frame::SUN_SHADOW_SIZE);
  const Texels hdr = lab.image(data, deferred_light(), resource::hdr);
  FrameData night = data;  // everything lies in shadow: what is left is the glow that the sun gives the sky
  for (auto& column : night.view.world_to_sun.column) column.z = 0;
  night.view.world_to_sun.column[3].z = -10;
  const Texels glow = lab.image(night, deferred_light(), resource::hdr);
  uint32_t lit = 0, dark = 0;
  for (int y = 0; y < hdr.height; y += 3)
    for (int x = 0; x < hdr.width; x += 3) {
      if (g.depth.at(x, y).x <= 0) continue;
      const reference::SurfacePoint s = surface_at(g, data, x, y);
      bool certain = glm::dot(s.normal, s.eye) > 0.02;
      const double visible = sun_visibility(shadow, data, s, certain);
      if (!certain) continue;
      const glm::dvec3 full = reference::reflected(s, reference::to_double(data.view.sun_direction), reference::to_double(data.view.sun_color));
      const glm::dvec3 expected = full * visible + glm::dvec3(glow.at(x, y));
      // At thirty metres a float places the point within a hundredth of a texel of the shadow map: so much the weights may differ.
      ASSERT_NO_FATAL_FAILURE(expect_close(hdr.at(x, y), expected, 1e-3, 0.02 * full + 1e-3 * glm::dvec3(glow.at(x, y)) + 2e-6, x, y));
      (visible > 0.5 ? lit : dark) += 1;
    }
  EXPECT_GT(lit, 200u);
  EXPECT_GT(dark, 200u);
}

TEST(SunShadow, HoldsTheCasterNearestToTheSun) {
  Scene scene = make_floor();
  demo::MeshData block;
  demo::add_box(block, {-1, 1, -1}, {1, 2, 1}, 10);
  demo::Instance instance;
  instance.mesh = demo::add_mesh(scene, "block", block);
  scene.instances.push_back(instance);
  scene.sun.center = {0, 0, 0};
  scene.sun.radius = 8;
  Lab lab(scene, 64, 64);
  const Texels shadow = lab.image(lab.prepare(), pass::sun_shadow_props, resource::sun_shadow);
  const float metre = 1 / (2 * 1.6f * 8);  // of reversed depth; the middle of the range lies at the centre
  const int middle = shadow.width / 2;
  EXPECT_NEAR(shadow.at(middle, middle).x, 0.5f + 2 * metre, 1e-5f) << "top of the block";
  EXPECT_NEAR(shadow.at(middle + shadow.width / 4, middle).x, 0.5f, 1e-5f) << "the floor, four metres aside";
  EXPECT_EQ(shadow.at(2, 2).x, 0) << "nothing";
}

}  // namespace
}  // namespace rg::test
