// Features as constants: which variants are built, and that they are the ones a plain compilation would give.
#include "compiler/shaders/variants.h"

#include "compiler/shaders/statistics.h"
#include "tests/unit/shaders/fixture.h"

namespace rg::compiler {
namespace {

using dsl::Format;
using dsl::Mode;
using dsl::Role;

struct Variants : testing::Test, Fixture {
  dsl::FeatureId feature(const std::string& name, std::vector<std::string> values = {"off", "on"}) {
    return program.features.add({name, std::move(values), 0, {}, {}});
  }
  dsl::Pass& pass_with(const std::vector<dsl::FeatureId>& features, const std::string& text) {
    const auto hdr = image("hdr", Format::rgba16f);
    dsl::Pass& pass = compute({access(hdr, Mode::write, Role::storage)}, text);
    for (const dsl::FeatureId id : features) {
      const dsl::Feature& row = program.features[id];
      pass.features.push_back(
          {row.name, id, 0, row.values.size() == 2 && row.values[0] == "off" ? std::vector<std::string>{} : row.values, span("work")});
    }
    return pass;
  }
  // One plan, every combination of the features of every pass live.
  VariantSpace all_combinations() {
    VariantSpace space;
    for (const dsl::Pass& pass : graph().passes) {
      std::vector<std::vector<uint32_t>> values = {{}};
      std::vector<size_t> selecting;
      for (size_t f = 0; f < pass.features.size(); ++f) {
        std::vector<std::vector<uint32_t>> next;
        for (const auto& row : values)
          for (uint32_t v = 0; v < program.features[pass.features[f].feature].values.size(); ++v) next.push_back(row), next.back().push_back(v);
        values = std::move(next);
        selecting.push_back(f);
      }
      space.passes.emplace_back();
      for (uint32_t s = 0; s < values.size(); ++s) space.passes.back().push_back({0, s, true, values[s]});
      space.selecting.push_back({selecting});
    }
    return space;
  }
  ShaderBundle compile(const VariantSpace& space, const ShaderOptions& options = {}) {
    const ReadFile read = [this](const std::string& path, std::string& why) -> std::optional<std::string> {
      const auto found = shaders.find(path);
      why = "no such file";
      return found == shaders.end() ? std::nullopt : std::optional(found->second);
    };
    return compile_shaders(program, graph_id, space, read, files, options, diagnostics);
  }
};

const std::string kTwo =
    "void main() {\n  vec4 c = vec4(1.0);\n  if (red) c.r = sin(float(gl_LocalInvocationIndex));\n  if (blue) c.b = cos(c.r);\n"
    "  imageStore(hdr, ivec2(0), c);\n}\n";

TEST_F(Variants, OneFrontEndRunGivesEveryCombination) {
  pass_with({feature("red"), feature("blue")}, kTwo);
  const ShaderBundle bundle = compile(all_combinations());
  EXPECT_EQ(report(), "");
  EXPECT_EQ(bundle.shaders.size(), 4u);
  ASSERT_EQ(bundle.counts.size(), 1u);
  EXPECT_EQ(bundle.counts[0], (VariantCount{"work", "work.comp", 4, 0, 0, 0, 0, 4, 1}));
  for (const CompiledShader& shader : bundle.shaders) {
    EXPECT_EQ(validate_spirv(shader.words), "");
    EXPECT_TRUE(specialisation_ids(shader.words).empty());
    EXPECT_EQ(find_statistics(shader.words).branches, 0u) << shader.name;
  }
}

TEST_F(Variants, AVariantIsWhatAPlainCompilationGives) {
  pass_with({feature("red"), feature("blue")}, kTwo);
  const ShaderBundle bundle = compile(all_combinations());
  const auto& variants = bundle.passes[0].variants[0];
  ASSERT_EQ(variants.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    Fixture plain;
    plain.image("hdr", Format::rgba16f);
    const std::string constants = std::string("const bool red = ") + (i & 2 ? "true" : "false") + ", blue = " + (i & 1 ? "true" : "false") + ";\n";
    plain.compute({plain.access(dsl::ResourceId{size_t{0}}, Mode::write, Role::storage)}, constants + kTwo);
    const ShaderBundle reference = plain.compile();
    EXPECT_EQ(find_statistics(bundle.shaders[variants[i][0]].words), find_statistics(reference.shaders[0].words)) << i;
  }
}

TEST_F(Variants, FeaturesThatAShaderIgnoresCostNothing) {
  const auto red = feature("red"), blue = feature("blue"), unused = feature("unused");
  pass_with({red, blue, unused}, kTwo);
  const ShaderBundle bundle = compile(all_combinations());
  EXPECT_EQ(report(), "RG0707 passes.rg:3:8 feature `unused` is named by pass `work` but none of its shaders depends on it\n");
  EXPECT_EQ(bundle.counts[0], (VariantCount{"work", "work.comp", 8, 0, 0, 4, 0, 4, 1}));
}

TEST_F(Variants, EqualModulesAreStoredOnce) {
  const auto red = feature("red"), blue = feature("blue");
  pass_with({red, blue}, "void main() {\n  vec4 c = vec4(1.0);\n  if (red) { if (blue) c.r = 0.5; }\n  imageStore(hdr, ivec2(0), c);\n}\n");
  const ShaderBundle bundle = compile(all_combinations());
  EXPECT_EQ(bundle.counts[0], (VariantCount{"work", "work.comp", 4, 0, 0, 0, 2, 2, 1}));
}

TEST_F(Variants, OnlyLiveRowsAreBuilt) {
  const auto red = feature("red"), blue = feature("blue");
  pass_with({red, blue}, kTwo);
  VariantSpace space = all_combinations();
  space.passes[0][2].live = false;
  space.passes[0].pop_back();
  const ShaderBundle bundle = compile(space);
  EXPECT_EQ(bundle.counts[0], (VariantCount{"work", "work.comp", 4, 1, 1, 0, 0, 2, 1}));
}

TEST_F(Variants, ThePreprocessorGetsAFrontEndRunAKey) {
  const auto path = feature("path", {"low", "mid", "high"}), red = feature("red");
  pass_with({path, red},
            "#if FEATURE_path == 2\nfloat level() { return 3.0; }\n#else\nfloat level() { return path == path_mid ? 2.0 : 1.0; }\n#endif\n"
            "void main() {\n  float c = level();\n  if (red) c *= 7.0;\n  imageStore(hdr, ivec2(0), vec4(c));\n}\n");
  const ShaderBundle bundle = compile(all_combinations());
  EXPECT_EQ(report(), "");
  EXPECT_EQ(bundle.counts[0], (VariantCount{"work", "work.comp", 6, 0, 0, 0, 0, 6, 3}));
}

TEST_F(Variants, AFailureThatTakesFeaturesNamesTheFewest) {
  const auto red = feature("red"), blue = feature("blue"), green = feature("green");
  pass_with({red, blue, green},
            "void main() {\n  float c = 1.0;\n#if FEATURE_red && FEATURE_green\n  c = nothing;\n#endif\n#if FEATURE_blue\n  c = 2.0;\n#endif\n"
            "  imageStore(hdr, ivec2(0), vec4(c));\n}\n");
  compile(all_combinations());
  EXPECT_EQ(report(),
            "RG0402 work.comp:4:7 `nothing`: undeclared identifier\n"
            "  RG0455 passes.rg:3:8 the pass gives it `hdr`, `red`, `blue`, `green`\n"
            "  RG0450 passes.rg:4:5 shader of pass `work`, named here\n"
            "  RG0708 passes.rg:3:8 it fails with `red=on, green=on` and compiles with `red=off, blue=off, green=off`\n");
}

TEST_F(Variants, DerivedConstantsAndArraySizesFollow) {
  const auto red = feature("red");
  pass_with({red},
            "const int COUNT = red ? 4 : 2;\nshared float values[COUNT];\nvoid main() {\n  values[gl_LocalInvocationIndex % COUNT] = 1.0;\n"
            "  barrier();\n  imageStore(hdr, ivec2(0), vec4(values[0]));\n}\n");
  const ShaderBundle bundle = compile(all_combinations());
  EXPECT_EQ(report(), "");
  ASSERT_EQ(bundle.shaders.size(), 2u);
  EXPECT_EQ(find_statistics(bundle.shaders[0].words).shared_bytes, 8u);
  EXPECT_EQ(find_statistics(bundle.shaders[1].words).shared_bytes, 16u);
}

TEST_F(Variants, WorkersDoNotShowInTheResult) {
  pass_with({feature("red"), feature("blue")}, kTwo);
  const ShaderBundle one = compile(all_combinations(), {nullptr, 1, {}}), four = compile(all_combinations(), {nullptr, 4, {}});
  ASSERT_EQ(one.shaders.size(), four.shaders.size());
  for (size_t i = 0; i < one.shaders.size(); ++i) EXPECT_EQ(one.shaders[i].words, four.shaders[i].words);
}

TEST(IncludeClosure, FollowsIncludesWhateverTheConditions) {
  const std::map<std::string, std::string> files = {{"a/x.comp", "#if 0\n # include \"y.glsl\"\n#endif\n#include \"gone.glsl\"\n"},
                                                    {"a/y.glsl", "#include \"z.glsl\"\n#include \"y.glsl\"\n"},
                                                    {"z.glsl", ""}};
  ShaderSources sources([&](const std::string& path, std::string&) {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  });
  std::string paths;
  for (const SourceText& source : include_closure("a/x.comp", files.at("a/x.comp"), sources)) paths += source.path + (source.text ? " " : "? ");
  EXPECT_EQ(paths, "a/x.comp a/y.glsl a/x.comp -> gone.glsl? z.glsl ");
}

TEST(Statistics, CountsAndLiveScalars) {
  Fixture fixture;
  const auto depth = fixture.image("depth", Format::d32f), hdr = fixture.image("hdr", Format::rgba16f);
  const auto words = fixture.buffer("words", {dsl::Scalar::u32, 1, 1, {}, 0});
  fixture.compute({fixture.access(depth, Mode::read, Role::sampled), fixture.access(hdr, Mode::write, Role::storage),
                   fixture.access(words, Mode::atomic, Role::storage)},
                  "shared float total;\nvoid main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  vec4 a = texelFetch(depth, p, 0);\n"
                  "  vec4 b = texelFetch(depth, p + 1, 0);\n  total = a.x;\n  barrier();\n  atomicAdd(words[0], 1u);\n"
                  "  imageStore(hdr, p, a * b + total);\n}\n");
  const ShaderBundle bundle = fixture.compile();
  EXPECT_EQ(fixture.report(), "");
  const ShaderStatistics s = find_statistics(bundle.shaders[0].words);
  EXPECT_EQ(s.samples, 2u);
  EXPECT_EQ(s.stores, 1u);
  EXPECT_EQ(s.atomics, 1u);
  EXPECT_EQ(s.barriers, 1u);
  EXPECT_EQ(s.shared_bytes, 4u);
  EXPECT_GE(s.live_scalars, 10u);  // both texels and the place
  EXPECT_LE(s.live_scalars, 16u);
}

// Kernels of a spectrum are only put together in a hurry, and are what the validator takes; a whole build leaves out what they do not need.
TEST_F(Variants, KernelsAreValidInAHurry) {
  pass_with({},
            "float shade(bool on) { return on ? sin(float(gl_LocalInvocationIndex)) : 0.5; }\n"
            "void main() { vec4 c = vec4(shade(red)); if (blue) c.b = cos(c.r); imageStore(hdr, ivec2(0), c); }\n")
      .features = {{"red", {}, 0, {}, span("work")}, {"blue", {}, 0, {}, span("work")}};
  ShaderOptions hurried;
  hurried.effort = ShaderEffort::preview;
  const ShaderBundle preview = compile(initial_variants(program, graph_id), hurried), whole = compile(initial_variants(program, graph_id));
  ASSERT_TRUE(diagnostics.rows().empty()) << diagnostics.rows()[0].message();
  EXPECT_FALSE(preview.complete);
  EXPECT_TRUE(whole.complete);
  ASSERT_EQ(preview.shaders.size(), 1u);
  const Words& words = preview.shaders[0].words;
  EXPECT_EQ(validate_spirv(words), "");
  EXPECT_TRUE(specialisation_ids(words).empty());
  EXPECT_EQ(without_names(words), words);
  EXPECT_LT(find_statistics(whole.shaders[0].words).instructions, find_statistics(words).instructions);
}

}  // namespace
}  // namespace rg::compiler
