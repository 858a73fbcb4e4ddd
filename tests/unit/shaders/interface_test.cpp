#include "compiler/shaders/interface.h"

#include "tests/unit/shaders/fixture.h"

namespace rg::compiler {
namespace {

using dsl::Dimension;
using dsl::Format;
using dsl::Mode;
using dsl::Role;

struct Interface : testing::Test, Fixture {
  // The lines of the prelude behind its fixed header.
  std::string prelude(const dsl::Pass& pass, dsl::Stage stage) {
    const std::string all = text(make_prelude(program, graph(), pass, stage));
    const std::string last = "GL_EXT_nonuniform_qualifier : enable\n";
    return all.substr(all.find(last) + last.size());
  }
  dsl::Resource& resource(dsl::ResourceId id) { return graph().resources[id]; }
  dsl::SamplerId sampler(bool compares) {
    dsl::Sampler sampler;
    sampler.name = "s";
    if (compares) sampler.compare = dsl::Compare::greater_equal;
    return program.samplers.add(sampler);
  }
};

TEST_F(Interface, BindingsFollowAccessesThenParams) {
  dsl::Struct view;
  view.name = "View";
  view.fields.push_back({"scale", {dsl::Scalar::f32, 2, 1, {}, 4}, 0, 0, {}});
  const auto type = program.structs.add(view);
  program.constants.push_back({"frame.TILE", 8});
  program.constants.push_back({"BIG", int64_t{1} << 40});
  const auto depth = image("depth", Format::d32f), hdr = image("hdr", Format::rgba16f), mask = buffer("mask", {dsl::Scalar::u32, 1, 1, {}, 0});
  dsl::Pass& pass =
      compute({access(depth, Mode::read, Role::sampled), access(hdr, Mode::write, Role::storage), access(mask, Mode::atomic, Role::storage),
               access(mask, Mode::read, Role::indirect), access(mask, Mode::read, Role::storage)},
              "");
  pass.params = {{"view", graph().params.add({"view", type, {}, {}}), {}}};
  EXPECT_EQ(prelude(pass, dsl::stage_compute),
            "const int TILE = 8;\n"
            "struct View {\n  vec2 scale[4];\n};\n"
            "layout(set = 1, binding = 0) uniform texture2D depth;\n"
            "layout(set = 1, binding = 1, rgba16f) writeonly uniform image2D hdr;\n"
            "layout(set = 1, binding = 2, std430) buffer rg_block_mask { uint mask[]; };\n"
            "layout(set = 1, binding = 3, std430) readonly buffer rg_block_mask { uint mask[]; };\n"
            "layout(set = 1, binding = 4, std140) uniform rg_block_view { View view; };\n"
            "layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;\n");
}

TEST_F(Interface, ViewsOfImages) {
  const auto volume = image("volume", Format::rgba16f), sky = image("sky", Format::rgba16f), cascades = image("cascades", Format::d16),
             ids = image("ids", Format::r32ui), stencil = image("stencil", Format::d32f_s8), samples = image("samples", Format::r8);
  resource(volume).dimension = Dimension::d3;
  resource(sky).dimension = Dimension::cube;
  resource(sky).layers = 6;
  resource(cascades).layers = 4;
  resource(samples).samples = 4;
  auto shadow = access(cascades, Mode::read, Role::sampled), one = shadow, face = access(sky, Mode::write, Role::storage),
       smooth = access(sky, Mode::read, Role::sampled);
  shadow.sampler = sampler(true);
  one.name = "one_cascade";
  one.range.layer = 2;
  one.range.layers = 1;
  face.name = "face";
  face.range.layers = 1;
  smooth.sampler = sampler(false);
  auto bits = access(stencil, Mode::read, Role::sampled);
  bits.range.aspects = 4;
  const dsl::Pass& pass = compute({access(volume, Mode::write, Role::storage), smooth, face, shadow, one, access(ids, Mode::read, Role::sampled),
                                   bits, access(samples, Mode::read, Role::sampled)},
                                  "");
  const std::string text = prelude(pass, dsl::stage_compute);
  for (const char* line : {"binding = 0, rgba16f) writeonly uniform image3D volume;", "binding = 1) uniform samplerCube sky;",
                           "binding = 2, rgba16f) writeonly uniform image2D face;", "binding = 3) uniform sampler2DArrayShadow cascades;",
                           "binding = 4) uniform texture2D one_cascade;", "binding = 5) uniform utexture2D ids;",
                           "binding = 6) uniform utexture2D stencil;", "binding = 7) uniform texture2DMS samples;"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

TEST_F(Interface, RasterStages) {
  dsl::Struct draw, vertex;
  draw.name = "Draw";
  draw.fields.push_back({"model", {dsl::Scalar::u32, 1, 1, {}, 0}, 0, 0, {}});
  vertex.name = "Vertex";
  vertex.fields.push_back({"place", {dsl::Scalar::f32, 4, 4, {}, 0}, 0, 0, {}});
  vertex.fields.push_back({"tint", {dsl::Scalar::f32, 3, 1, {}, 0}, 0, 64, {}});
  const auto hdr = image("hdr", Format::rgba16f), ids = image("ids", Format::r32ui);
  dsl::Pass& pass = raster({access(hdr, Mode::write, Role::color), access(ids, Mode::write, Role::color)}, "x", "y");
  pass.draw.kind = dsl::DrawKind::host;
  pass.draw.per_draw = program.structs.add(draw);
  pass.draw.vertex = {{program.structs.add(vertex)}};
  const std::string push = "layout(push_constant, std430) uniform rg_block_per_draw { Draw per_draw; };\n";
  const std::string vertex_text = prelude(pass, dsl::stage_vertex), fragment_text = prelude(pass, dsl::stage_fragment);
  EXPECT_NE(vertex_text.find(push + "layout(location = 0) in mat4 place;\nlayout(location = 4) in vec3 tint;\n"), std::string::npos) << vertex_text;
  EXPECT_NE(fragment_text.find(push + "layout(location = 0) out vec4 hdr;\nlayout(location = 1) out uvec4 ids;\n"), std::string::npos)
      << fragment_text;
}

TEST_F(Interface, EngineSetsAreNumbered) {
  program.engine_sets.add({"materials", 2, " uniform sampler2D albedo[16];\n uniform Sun { vec3 direction; float size; } sun; ", {}});
  dsl::Pass& pass = compute({}, "");
  pass.bind = "materials";
  EXPECT_EQ(engine_set_declarations(*engine_set_of(program, pass)),
            (std::vector<std::string>{"layout(set = 2, binding = 0) uniform sampler2D albedo[16];",
                                      "layout(set = 2, binding = 1) uniform Sun { vec3 direction; float size; } sun;"}));
  shaders["work.comp"] = "void main() { vec4 a = textureLod(albedo[0], vec2(0), 0); }\n";
  compile();
  EXPECT_EQ(report(), "");
}

TEST_F(Interface, EveryStorageFormatHasItsWord) {
  for (size_t i = 1; i <= static_cast<size_t>(Format::bc7); ++i) {
    Fixture f;
    const auto format = static_cast<Format>(i);
    const auto target = f.image("target", format);
    f.compute({f.access(target, Mode::write, Role::storage)}, "void main() { imageStore(target, ivec2(0), TYPE(1)); }\n");
    const std::string text = rg::compiler::text(make_prelude(f.program, f.graph(), f.graph().passes.rows[0], dsl::stage_compute));
    const std::string kind = text.find(" uimage2D") != std::string::npos ? "uvec4" : text.find(" iimage2D") != std::string::npos ? "ivec4" : "vec4";
    std::string& shader = f.shaders["work.comp"];
    shader.replace(shader.find("TYPE"), 4, kind);
    f.compile();
    EXPECT_EQ(f.report(), "") << "format " << i;
  }
}

}  // namespace
}  // namespace rg::compiler
