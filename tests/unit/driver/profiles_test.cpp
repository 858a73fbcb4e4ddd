// Target profiles: what their files promise, and what of a frame goes beyond.
#include "compiler/profiles.h"

#include <gtest/gtest.h>

#include <map>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

struct Case {
  std::string frame, profile;
  std::string shader = {};
};

constexpr const char* kNoProfile = "none";

dsl::Diagnostics check(const Case& input) {
  const std::string target = input.profile == kNoProfile ? "" : "target profile \"p.json\"\n";
  const std::map<std::string, std::string> files = {{"frame.rg", target + input.frame}, {"p.json", input.profile}, {"p.comp", input.shader}};
  CompileOptions options;
  options.until = Until::plans;
  dsl::Diagnostics diagnostics;
  compile("frame.rg", test::reader_of(files), options, diagnostics);
  return diagnostics;
}

std::string profile(const std::string& features, const std::string& limits = "", const std::string& version = "1.3.204") {
  return R"({"capabilities": {"base": {"features": {"VkPhysicalDeviceFeatures": {)" + features +
         R"(}}, "properties": {"VkPhysicalDeviceProperties": {"limits": {)" + limits +
         R"(}}}}}, "profiles": {"VP_TEST": {"version": 1, "api-version": ")" + version + R"(", "capabilities": ["base"]}}})";
}

constexpr const char* kPlain = "graph g(surface s: rgba8 64x64) { pass p : raster { color s clear 0 } }";
constexpr const char* kBlocks =
    "graph g(surface s: rgba8 64x64) { image a : bc7 64x64 buffer b : u32[1024] pass m : compute { write b as storage }\n"
    "pass c : transfer { copy b -> a } pass p : raster { read a as sampled in fragment color s clear 0 } }";

std::vector<DiagnosticKind> kinds(const dsl::Diagnostics& diagnostics) {
  std::vector<DiagnosticKind> all;
  for (const dsl::Diagnostic& row : diagnostics.rows()) all.push_back(row.kind);
  return all;
}

TEST(Profiles, WhatIsPromisedIsSilent) {
  EXPECT_TRUE(check({kPlain, profile("")}).rows().empty());
  EXPECT_TRUE(check({kBlocks, profile(R"("textureCompressionBC": true)")}).rows().empty());
}

TEST(Profiles, WhatIsNotIsAnErrorAtItsUseThatNamesTheFallback) {
  const dsl::Diagnostics diagnostics = check({kBlocks, profile(R"("textureCompressionBC": false)")});
  ASSERT_EQ(kinds(diagnostics), std::vector<DiagnosticKind>{DiagnosticKind::BeyondProfile});
  const dsl::Diagnostic& error = diagnostics.rows()[0];
  EXPECT_EQ(
      error.message(),
      "image `a` needs `textureCompressionBC`, which profile `VP_TEST` does not promise; without it, bring the texels uncompressed, as `rgba8` or "
      "`rgba16f`");
  ASSERT_EQ(error.notes.size(), 1u);
  EXPECT_EQ(error.notes[0].kind, DiagnosticKind::ProfileIsHere);
}

TEST(Profiles, LimitsCountAtTheLargestExtents) {
  const std::string frame =
      "extent view = runtime(64, 64) max(8192, 64)\ngraph g(surface s: rgba8 view) { image a : rgba8 view pass m : compute { write a as storage }\n"
      "pass p : raster { read a as sampled in fragment color s clear 0 } }";
  EXPECT_TRUE(check({frame, profile("", R"("maxImageDimension2D": 8192)")}).rows().empty());
  const dsl::Diagnostics diagnostics = check({frame, profile("", R"("maxImageDimension2D": 4096)")});
  ASSERT_EQ(kinds(diagnostics), (std::vector<DiagnosticKind>{DiagnosticKind::OverProfileLimit, DiagnosticKind::OverProfileLimit}));  // s and a
  EXPECT_EQ(diagnostics.rows()[1].message(),
            "the largest side of image `a` is 8192, and profile `VP_TEST` promises only 4096 (`maxImageDimension2D`)");
  // A limit the file does not name is Vulkan's own minimum.
  EXPECT_EQ(check({frame, profile("")}).rows().size(), 2u);
}

// Arrays of a shader are no declaration of the frame: what they take is judged once the shader is compiled.
TEST(Profiles, SharedMemoryHasALimit) {
  const std::string frame =
      "graph g(surface s: rgba8 64x64) { image a : rgba16f 64x64 pass p : compute { shader \"p.comp\" group 64 1 1 write a as storage dispatch over "
      "a }\n"
      "pass q : raster { read a as sampled in fragment color s clear 0 } }";
  const auto of = [&](int vectors, const std::string& promise) {
    const std::string shader =
        "shared vec4 all[" + std::to_string(vectors) +
        "];\nvoid main() { all[gl_LocalInvocationIndex] = vec4(1.0); barrier(); imageStore(a, ivec2(0), all[gl_LocalInvocationIndex ^ 1u]); }";
    return check({frame, promise, shader});
  };
  const std::string most = R"("maxComputeWorkGroupInvocations": 128, "maxComputeSharedMemorySize": 32768)";
  EXPECT_TRUE(of(2048, profile("", most)).rows().empty());
  EXPECT_TRUE(of(1024, profile("")).rows().empty());
  EXPECT_TRUE(of(1024, kNoProfile).rows().empty());
  const dsl::Diagnostics beyond = of(2049, profile("", most)), without = of(1025, kNoProfile);
  ASSERT_EQ(kinds(beyond), std::vector<DiagnosticKind>{DiagnosticKind::SharedMemory});
  EXPECT_EQ(beyond.rows()[0].message(),
            "shader `p.comp` of pass `p` takes 32784 bytes of shared memory and profile `VP_TEST` promises 32768; take less, or target a profile "
            "that promises "
            "more");
  ASSERT_EQ(kinds(without), std::vector<DiagnosticKind>{DiagnosticKind::SharedMemory});
  EXPECT_EQ(without.rows()[0].arguments[3], "vulkan 1.3");
}

TEST(Profiles, EveryProfileOfAFileCounts) {
  const std::string two = R"({"capabilities": {"with": {"features": {"VkPhysicalDeviceFeatures": {"textureCompressionBC": true}}}, "without": {}},
    "profiles": {"VP_A": {"api-version": "1.3.0", "capabilities": ["with"]}, "VP_B": {"api-version": "1.3.0", "capabilities": ["without"]}}})";
  const dsl::Diagnostics diagnostics = check({kBlocks, two});
  ASSERT_EQ(kinds(diagnostics), std::vector<DiagnosticKind>{DiagnosticKind::BeyondProfile});
  EXPECT_EQ(diagnostics.rows()[0].arguments[2], "VP_B");
}

TEST(Profiles, OfAlternativesOnlyWhatTheyShareIsPromised) {
  const auto with = [](const std::string& b) {
    return R"({"capabilities": {"a": {"features": {"VkPhysicalDeviceFeatures": {"textureCompressionBC": true}}},
      "b": {"features": {"VkPhysicalDeviceFeatures": {)" +
           b + R"(}}}}, "profiles": {"VP_A": {"api-version": "1.3.0", "capabilities": [["a", "b"]]}}})";
  };
  EXPECT_TRUE(check({kBlocks, with(R"("textureCompressionBC": true)")}).rows().empty());
  EXPECT_EQ(check({kBlocks, with("")}).rows().size(), 1u);
}

TEST(Profiles, GraphsNeedVulkan13) {
  const dsl::Diagnostics diagnostics = check({kPlain, profile("", "", "1.1.0")});
  ASSERT_EQ(kinds(diagnostics), std::vector<DiagnosticKind>{DiagnosticKind::OverProfileLimit});
}

TEST(Profiles, FilesThatAreNoneAreRefused) {
  for (const char* text : {"", "[", "[]", "{}", "1", R"({"capabilities": {}, "profiles": {}})", R"({"capabilities": [], "profiles": {}})",
                           R"({"capabilities": {}, "profiles": {"A": 1}})", R"({"capabilities": {}, "profiles": {"A": {"capabilities": ["x"]}}})",
                           R"({"capabilities": {"x": 3}, "profiles": {"A": {"capabilities": ["x"]}}})",
                           R"({"capabilities": {}, "profiles": {"A": {"capabilities": [["x", 4]]}}})", "\xff\xfe"})
    EXPECT_EQ(kinds(check({kPlain, text})), std::vector<DiagnosticKind>{DiagnosticKind::ProfileNotReadable}) << text;
}

// One small use of everything that a device may lack, beside the feature that it takes.
TEST(Profiles, EveryOptionalFeatureIsFound) {
  const auto graph = [](const std::string& items, const std::string& before = "") {
    return before + "graph g(surface s: rgba8 64x64) {\n" + items + "\npass show : raster { color s clear 0 } }";
  };
  const std::map<std::string, std::string> uses = {
      {"imageCubeArray", graph("image c : rgba8 64x64 cube layers 2 output pass p : transfer { clear c 0 }")},
      {"samplerAnisotropy", graph("image a : rgba8 64x64 pass p : transfer { clear a 0 } pass q : compute { keep read a as sampled(fine) }",
                                  "sampler fine { filter linear anisotropy 8 }\n")},
      {"independentBlend", graph("image a : rgba8 64x64 pass p : raster { keep color a clear 0 color s clear 0 blend add(one, one) }")},
      {"fragmentStoresAndAtomics", graph("buffer b : u32[4] pass p : raster { keep color s clear 0 atomic b as storage in fragment clear 0 }")},
      {"vertexPipelineStoresAndAtomics", graph("buffer b : u32[4] pass p : raster { keep color s clear 0 atomic b as storage in vertex clear 0 }")},
      {"shaderStorageImageExtendedFormats", graph("image a : r8 64x64 output pass p : compute { write a as storage }")},
      {"shaderStorageImageMultisample", graph("image a : rgba8 64x64 samples 4 output pass p : compute { write a as storage }")},
  };
  for (const auto& [feature, frame] : uses) {
    const dsl::Diagnostics diagnostics = check({frame, profile("")});
    ASSERT_EQ(kinds(diagnostics), std::vector<DiagnosticKind>{DiagnosticKind::BeyondProfile}) << feature;
    EXPECT_EQ(diagnostics.rows()[0].arguments[1], feature);
    EXPECT_TRUE(check({frame, profile("\"" + feature + "\": true")}).rows().empty()) << feature;
  }
}

}  // namespace
}  // namespace rg::compiler
