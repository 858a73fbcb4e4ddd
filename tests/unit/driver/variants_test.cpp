// Variants through the whole compiler: which exist, what the cache and shards change (nothing but the time), what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::compiler {
namespace fs = std::filesystem;
namespace {

using test::Files;

struct Compiled {
  CompileResult result;
  dsl::Diagnostics diagnostics;
  std::string codes() const {
    std::string text;
    for (const dsl::Diagnostic& diagnostic : diagnostics.rows()) {
      text += std::string(dsl::row(diagnostic.kind).code) + " " + diagnostic.message() + "\n";
      for (const dsl::Diagnostic& note : diagnostic.notes) text += "  " + note.message() + "\n";
    }
    return text;
  }
};

Compiled compile_files(const Files& files, CompileOptions options = {}) {
  Compiled compiled;
  compiled.result = compile("frame.rg", test::reader_of(files), options, compiled.diagnostics);
  return compiled;
}

// A pass whose shader depends on `features`, and one that exists only with `fog`.
Files frame_with(const std::string& features, const std::string& body) {
  return {{"frame.rg",
           "module frame\nextent view = runtime(64, 64) max(64, 64)\nfeature fog: bool\nfeature sun: bool\nfeature path: { low, high }\n"
           "graph frame(surface back: rgba8 view after copy_src) {\n  image lit : rgba16f view\n"
           "  pass light : compute {\n    shader \"light.comp\" group 8 8 1\n    " +
               features +
               "\n    write lit as storage\n    dispatch over view\n  }\n"
               "  when fog {\n    pass haze : compute {\n      shader \"haze.comp\" group 8 8 1\n      update lit as storage\n      dispatch over "
               "view\n    }\n  }\n"
               "  pass show : raster {\n    fullscreen \"show.frag\"\n    read lit as sampled\n    color back\n  }\n}\n"},
          {"light.comp", "void main() {\n  vec4 c = vec4(0.1);\n" + body + "  imageStore(lit, ivec2(gl_GlobalInvocationID.xy), c);\n}\n"},
          {"haze.comp", "void main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  imageStore(lit, p, imageLoad(lit, p) * 0.5);\n}\n"},
          {"show.frag", "void main() { back = texelFetch(lit, ivec2(gl_FragCoord.xy), 0); }\n"}};
}
const std::string kBody = "  if (sun) c.r = 1.0;\n  if (path == path_high) c.g = sin(c.r);\n  if (fog) c.b = 0.3;\n";

struct Folder {
  fs::path path = fs::temp_directory_path() / ("rgc_variants_test_" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

std::string all_text(const CompileResult& result) {
  std::string text;
  for (const GeneratedFile& file : result.files) text += file.path + "\n" + file.text;
  return text;
}

TEST(VariantsOfAFrame, FeaturesMakeChoicesAndConditionsOfOnePlan) {
  const Compiled compiled = compile_files(frame_with("features sun, path, fog", kBody));
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  const CompiledGraph& graph = compiled.result.graphs[0];
  ASSERT_EQ(graph.plans.size(), 1u);
  const PlanData& plan = graph.plans[0].plan;
  ASSERT_EQ(plan.features.size(), 3u);
  EXPECT_EQ(plan.features[0].name, "sun");
  EXPECT_EQ(plan.features[1].name, "path");
  EXPECT_EQ(plan.features[2].name, "fog");
  EXPECT_EQ(plan.pipeline_choices.size(), 8u);
  ASSERT_EQ(plan.feature_conditions.size(), 1u);
  EXPECT_EQ(plan.feature_conditions[0].feature, 2u);
  EXPECT_EQ(plan.feature_conditions[0].values, 2u) << "haze runs where fog is on";
  ASSERT_EQ(graph.shaders.counts.size(), 1u);
  EXPECT_EQ(graph.shaders.counts[0], (VariantCount{"light", "light.comp", 8, 0, 0, 0, 0, 8, 1}));
}

TEST(VariantsOfAFrame, FixedFeaturesLeaveFewer) {
  CompileOptions options;
  options.fixed_features = {"fog=off", "path=high"};
  const Compiled compiled = compile_files(frame_with("features sun, path, fog", kBody), options);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  EXPECT_EQ(compiled.result.graphs[0].plans.size(), 1u);
  EXPECT_EQ(compiled.result.graphs[0].shaders.counts[0], (VariantCount{"light", "light.comp", 8, 6, 0, 0, 0, 2, 1}));
}

TEST(VariantsOfAFrame, WhatNoFrameRunsIsNotBuilt) {
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n");
  std::string& root = files["frame.rg"];
  root.insert(root.find("\n      update lit as storage"), "\n      features fog, sun");
  root.replace(root.find("feature sun: bool"), 17, "feature sun: bool requires fog");
  files["haze.comp"] =
      "void main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  vec4 c = imageLoad(lit, p);\n  if (fog) c *= 0.5;\n"
      "  if (sun) c.r = 0.1;\n  imageStore(lit, p, c);\n}\n";
  const Compiled compiled = compile_files(files);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  const CompiledGraph& graph = compiled.result.graphs[0];
  ASSERT_EQ(graph.plans.size(), 1u);
  // The pass is skipped without fog: of its four combinations two are left, and every choice has its row.
  EXPECT_EQ(graph.shaders.counts[1], (VariantCount{"haze", "haze.comp", 4, 0, 2, 0, 0, 2, 1}));
  const PlanData& plan = graph.plans[0].plan;
  for (const Pass& pass : plan.passes) {
    if (pass.name != "haze") continue;
    ASSERT_EQ(pass.choice_count, 4u);
    size_t excluded = 0;
    for (Index i = 0; i < 4; ++i) excluded += plan.pipeline_choices[pass.first_choice + i] == kNone;
    EXPECT_EQ(excluded, 2u);
  }
}

TEST(VariantsOfAFrame, WhatOnlySomeDevicesHaveIsAskedFor) {
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n  c.g = float(subgroupAdd(1u));\n");
  files["light.comp"] = "#extension GL_KHR_shader_subgroup_arithmetic : require\n" + files["light.comp"];
  const std::string refused = compile_files(files).codes();
  EXPECT_EQ(refused.substr(0, refused.find(';')),
            "RG0510 shader `light.comp` needs `subgroup_arithmetic`, which profile `vulkan 1.3` does not promise");
  files = frame_with("features sun, sums", "  if (sun) c.r = 1.0;\n#if FEATURE_sums\n  c.g = float(subgroupAdd(1u));\n#endif\n");
  files["frame.rg"].insert(files["frame.rg"].find("feature fog"), "feature sums: device subgroup_arithmetic\n");
  files["light.comp"] = "#if FEATURE_sums\n#extension GL_KHR_shader_subgroup_arithmetic : require\n#endif\n" + files["light.comp"];
  const Compiled asked = compile_files(files);
  ASSERT_FALSE(asked.diagnostics.has_errors()) << asked.codes();
  const PlanData& plan = asked.result.graphs[0].plans[0].plan;
  EXPECT_EQ(plan.features[1].capability, Capability::subgroup_arithmetic);
  EXPECT_EQ(plan.pipeline_choices.size(), 4u);
}

TEST(VariantsOfAFrame, WhatIsCulledIsNotBuilt) {
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n");
  files["frame.rg"].insert(files["frame.rg"].find("  when fog"),
                           "  image unseen : rgba16f view\n  pass idle : compute {\n    shader \"idle.comp\" group 8 8 1\n    features sun\n"
                           "    write unseen as storage\n    dispatch over view\n  }\n");
  files["idle.comp"] = "void main() { imageStore(unseen, ivec2(0), vec4(sun)); }\n";
  const Compiled compiled = compile_files(files);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  EXPECT_EQ(compiled.result.graphs[0].shaders.counts[1], (VariantCount{"idle", "idle.comp", 2, 0, 2, 0, 0, 0, 1}));
}

TEST(VariantsOfAFrame, TooManyAreRefusedByName) {
  std::string features, passes, list;
  for (int i = 0; i < 7; ++i) {
    features += "feature f" + std::to_string(i) + ": bool\n";
    passes += "  when f" + std::to_string(i) + " { pass p" + std::to_string(i) + " : compute { update lit as storage } }\n";
    passes += "  else { pass q" + std::to_string(i) + " : compute { update lit as storage } }\n";
  }
  for (int i = 0; i < 13; ++i) features += "feature g" + std::to_string(i) + ": bool\n", list += (i ? ", g" : "g") + std::to_string(i);
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n");
  std::string& root = files["frame.rg"];
  root.insert(root.find("graph frame"), features);
  Files many = files;
  many["frame.rg"].insert(many["frame.rg"].find("  when fog"), passes);
  EXPECT_NE(compile_files(many).codes().find("RG0505 graph `frame` has 128 feature configurations; the limit is 64\n"
                                             "  feature `f0` multiplies them by up to 2\n"),
            std::string::npos)
      << compile_files(many).codes();
  EXPECT_EQ(compile_files(many).diagnostics.rows()[0].notes.at(0).kind, dsl::DiagnosticKind::FeatureMultiplies);
  root.replace(root.find("features sun"), 12, "features " + list);
  const Compiled wide = compile_files(files);
  ASSERT_FALSE(wide.diagnostics.rows().empty());
  EXPECT_EQ(wide.diagnostics.rows()[0].kind, dsl::DiagnosticKind::TooManyVariants) << wide.codes();
}

TEST(VariantsOfAFrame, APassThatNoPlanHasIsNamed) {
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n");
  std::string& root = files["frame.rg"];
  root.replace(root.find("when fog {"), 10, "when fog { when not fog {");
  root.insert(root.find("  pass show"), "  }\n");
  const Compiled compiled = compile_files(files);
  ASSERT_EQ(compiled.diagnostics.rows().size(), 1u) << compiled.codes();
  EXPECT_EQ(compiled.diagnostics.rows()[0].kind, dsl::DiagnosticKind::NeverPlanned) << compiled.codes();
}

TEST(CacheOfAFrame, ChangesNothingButTheTime) {
  const Folder folder;
  const Files files = frame_with("features sun, path, fog", kBody);
  const std::string plain = all_text(compile_files(files).result);
  CompileOptions options;
  options.cache_folder = folder.path;
  const Compiled first = compile_files(files, options), second = compile_files(files, options);
  EXPECT_EQ(all_text(first.result), plain);
  EXPECT_EQ(all_text(second.result), plain);
  EXPECT_EQ(first.result.cache.hits, 0u);
  EXPECT_GT(first.result.cache.stored, 8u);
  EXPECT_EQ(second.result.cache.stored, 0u);
  EXPECT_EQ(second.result.cache.misses, 0u);
}

TEST(CacheOfAFrame, AnEditOrAnotherOptionIsAnotherEntry) {
  const Folder folder;
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n#include \"more.glsl\"\n");
  files["more.glsl"] = "  c.g = 0.5;\n";
  CompileOptions options;
  options.cache_folder = folder.path;
  compile_files(files, options);
  files["more.glsl"] = "  c.g = 0.6;\n";
  const Compiled edited = compile_files(files, options);
  EXPECT_EQ(edited.result.cache.stored, 6u);  // by sources and by words: the front end's module; by values and by words: two variants
  EXPECT_EQ(all_text(edited.result), all_text(compile_files(files).result));
}

TEST(CacheOfAFrame, AnEditThatChangesNoCodeCostsTheFrontEndAlone) {
  const Folder folder;
  Files files = frame_with("features sun", "  if (sun) c.r = 1.0;\n");
  CompileOptions options;
  options.cache_folder = folder.path;
  const std::string plain = all_text(compile_files(files, options).result);
  files["light.comp"] += "// said once more\n";
  const Compiled edited = compile_files(files, options);
  EXPECT_EQ(edited.result.cache.stored, 1u);  // what the new sources compile to
  EXPECT_EQ(edited.result.cache.misses, 1u);
  EXPECT_EQ(all_text(edited.result), plain);
}

TEST(CacheOfAFrame, DamageIsReportedAndRepaired) {
  const Folder folder;
  const Files files = frame_with("features sun, path, fog", kBody);
  CompileOptions options;
  options.cache_folder = folder.path;
  const std::string plain = all_text(compile_files(files, options).result);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path)) {
    if (!entry.is_regular_file() || entry.path().filename() == "lock") continue;
    std::fstream file(entry.path(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(90);
    file.put('\x5a');
  }
  const Compiled repaired = compile_files(files, options);
  EXPECT_EQ(all_text(repaired.result), plain);
  ASSERT_EQ(repaired.diagnostics.rows().size(), 1u);
  EXPECT_EQ(repaired.diagnostics.rows()[0].kind, dsl::DiagnosticKind::CacheDamaged);
  EXPECT_EQ(compile_files(files, options).codes(), "");
}

TEST(CacheOfAFrame, AFolderThatCannotBeWrittenIsSaidOnce) {
  CompileOptions options;
  options.cache_folder = "/proc/no/such/folder";
  const Compiled compiled = compile_files(frame_with("features sun", "  if (sun) c.r = 1.0;\n"), options);
  EXPECT_FALSE(compiled.diagnostics.has_errors());
  ASSERT_EQ(compiled.diagnostics.rows().size(), 1u);
  EXPECT_EQ(compiled.diagnostics.rows()[0].kind, dsl::DiagnosticKind::CacheNotWritable);
}

TEST(Shards, TogetherGiveTheBytesOfOneMachine) {
  const Folder folder;
  const Files files = frame_with("features sun, path, fog", kBody);
  const std::string plain = all_text(compile_files(files).result);
  CompileOptions options;
  options.cache_folder = folder.path;
  options.shards = 3;
  for (options.shard = 0; options.shard < 3; ++options.shard) {
    const Compiled part = compile_files(files, options);
    EXPECT_FALSE(part.diagnostics.has_errors()) << part.codes();
    EXPECT_TRUE(part.result.files.empty());
  }
  options.shards = 0;
  const Compiled merged = compile_files(files, options);
  EXPECT_EQ(merged.result.cache.stored, 0u);
  EXPECT_EQ(all_text(merged.result), plain);
}

TEST(Shards, EveryVariantIsATask) {
  CompileOptions options;
  options.list_tasks = true;
  const Compiled listed = compile_files(frame_with("features sun, fog", "  if (sun) c.r = 1.0;\n  if (fog) c.b = 0.3;\n"), options);
  std::string text;
  for (const ShaderTask& task : listed.result.tasks) text += task.pass + " " + task.shader + " " + task.features + "\n";
  EXPECT_EQ(text,
            "light light.comp sun=off, fog=off\nlight light.comp sun=off, fog=on\nlight light.comp sun=on, fog=off\nlight light.comp sun=on, fog=on\n"
            "haze haze.comp \nshow rgc/fullscreen.vert \nshow show.frag \n");
}

Files tiles_with(const std::string& settings, const std::string& masks, const std::string& profile) {
  return {
      {"frame.rg",
       "module frame\nextent view = runtime(64, 64) max(64, 64)\nspectrum kinds { a  b requires a  modes 2\n" + settings +
           "}\ngraph frame() {\n  buffer masks : u32[" + masks +
           "]\n  buffer shown : u32[view.area] readback\n  pass mark : compute { write masks as storage }\n  pass start : transfer { fill shown 0 }\n"
           "  pass shade : compute {\n    shader \"shade.comp\" group 8 8 1\n    spectrum kinds by masks\n    update shown as storage disjoint\n"
           "    dispatch over view\n  }\n}\n"},
      {"shade.comp", "void main() { uvec2 p = spectrum_pixel(); shown[p.y * 64u + p.x] += (a ? 1u : 0u) + (b ? 2u : 0u); }\n"},
      {"p.json", profile}};
}
const std::string kGoodProfile =
    R"({"schema": "rgc-spectrum-1", "spectrum": "kinds", "scenes": [{"masks": [{"features": ["a"], "tiles": 3}, {"features": [], "tiles": 9}]}]})";

TEST(SpectrumOfAFrame, IsReplacedByThePassesThatRunIt) {
  const Compiled compiled = compile_files(tiles_with("profile \"p.json\"", "ceil(view / 8).area", kGoodProfile));
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  std::string names;
  for (const Pass& pass : compiled.result.graphs[0].plans[0].plan.passes) names += std::string(pass.name) + " ";
  for (const char* name : {"shade.reset", "shade.classify", "shade[0]", "shade[1]"}) EXPECT_NE(names.find(name), std::string::npos) << names;
  EXPECT_EQ(compiled.result.spectra[0].choice.modes, (std::vector<Mask>{0, 3}));
  EXPECT_NE(std::find(compiled.result.read_files.begin(), compiled.result.read_files.end(), "p.json"), compiled.result.read_files.end());
}

// A kernel that was only measured is not taken for one that was validated, nor a choice for another shader's.
TEST(SpectrumOfAFrame, IsChosenOnceAndAgainWhenItsShaderChanges) {
  const Folder folder;
  CompileOptions options;
  options.cache_folder = folder.path;
  Files files = tiles_with("profile \"p.json\"", "ceil(view / 8).area", kGoodProfile);
  const std::string plain = all_text(compile_files(files).result);
  EXPECT_EQ(all_text(compile_files(files, options).result), plain);
  const Compiled again = compile_files(files, options);
  EXPECT_EQ(again.result.cache.stored, 0u);
  EXPECT_EQ(again.result.cache.misses, 0u);
  EXPECT_EQ(all_text(again.result), plain);
  // Now `a` is what costs, and half the tiles do without.
  files["shade.comp"] =
      "void main() { uvec2 p = spectrum_pixel(); float x = float(p.x); if (a) { for (int i = 0; i < 9; ++i) x += sin(x) * cos(x); }\n"
      "shown[p.y * 64u + p.x] += uint(x) + (b ? 2u : 0u); }\n";
  const Compiled changed = compile_files(files, options);
  EXPECT_GT(changed.result.cache.stored, 0u);
  EXPECT_EQ(all_text(changed.result), all_text(compile_files(files).result));
  EXPECT_NE(changed.result.spectra[0].choice.expected, again.result.spectra[0].choice.expected);
}

TEST(SpectrumOfAFrame, WithoutAProfileThereIsADefaultAndANote) {
  const Compiled compiled = compile_files(tiles_with("", "ceil(view / 8).area", ""));
  EXPECT_FALSE(compiled.diagnostics.has_errors());
  ASSERT_EQ(compiled.diagnostics.rows().size(), 1u);
  EXPECT_EQ(compiled.diagnostics.rows()[0].kind, dsl::DiagnosticKind::NoProfile);
  EXPECT_EQ(compiled.result.spectra[0].choice.modes.size(), 2u);
}

TEST(SpectrumOfAFrame, BadProfilesAreRefused) {
  const auto codes = [](const std::string& profile) {
    const std::string all = compile_files(tiles_with("profile \"p.json\"", "ceil(view / 8).area", profile)).codes();
    return all.substr(0, all.find('\n'));
  };
  EXPECT_EQ(codes("{"), "RG0706 cannot read profile `p.json`: it is no JSON");
  EXPECT_EQ(codes("{\"schema\": \"other\"}"), "RG0706 cannot read profile `p.json`: its `schema` is not `rgc-spectrum-1`");
  EXPECT_EQ(codes("{\"schema\": \"rgc-spectrum-1\", \"scenes\": [{\"masks\": [{\"features\": [], \"tiles\": -1}]}]}"),
            "RG0706 cannot read profile `p.json`: `tiles` is no number, or negative");
  EXPECT_EQ(codes("{\"schema\": \"rgc-spectrum-1\", \"spectrum\": \"others\", \"scenes\": []}"),
            "RG0713 profile `p.json` does not belong to spectrum `kinds`: it was recorded for spectrum `others`");
  EXPECT_EQ(codes("{\"schema\": \"rgc-spectrum-1\", \"scenes\": [{\"masks\": [{\"features\": [\"z\"], \"tiles\": 1}]}]}"),
            "RG0713 profile `p.json` does not belong to spectrum `kinds`: spectrum `kinds` has no feature `z`");
  EXPECT_EQ(codes("{\"schema\": \"rgc-spectrum-1\", \"scenes\": []}"), "RG0714 profile `p.json` counts no tiles");
  EXPECT_EQ(compile_files(tiles_with("profile \"gone.json\"", "ceil(view / 8).area", "")).diagnostics.rows()[0].kind,
            dsl::DiagnosticKind::SpectrumProfileNotReadable);
}

// `image kernels` of that size, and `into kernels`.
Files tiles_into(const std::string& size, const std::string& group = "8 8 1", const std::string& extent = "64, 64") {
  Files files = tiles_with("profile \"p.json\"", group == "8 8 1" ? "ceil(view / 8).area" : "view.area", kGoodProfile);
  std::string& root = files["frame.rg"];
  root.replace(root.find("by masks"), 8, "by masks into kernels");
  root.insert(root.find("  buffer shown"), "  image kernels : r32ui " + size + "\n");
  root.replace(root.find("group 8 8 1"), 11, "group " + group);
  root.replace(root.find("max(64, 64)"), 11, "max(" + extent + ")");
  return files;
}

TEST(SpectrumOfAFrame, TheImageOfKernelsMatchesTheGrid) {
  const Compiled good = compile_files(tiles_into("ceil(view / 8)"));
  EXPECT_FALSE(good.diagnostics.has_errors()) << good.codes();
  EXPECT_EQ(compile_files(tiles_into("ceil(view / 16)")).codes(),
            "RG0720 `kernels` has 4x4 texels and pass `shade` runs 8x8 groups; it takes one texel a group\n");
}

TEST(SpectrumOfAFrame, OneRowOfGroupsHasALimit) {
  EXPECT_EQ(compile_files(tiles_into("view", "1 1 1", "512, 256")).codes(),
            "RG0734 pass `shade` runs 512x256 groups at the greatest extents; each kernel of a spectrum takes at most 65535, in two dimensions\n");
}

// The masks keep their place when a `read` and a `write` before them become one `update`.
TEST(SpectrumOfAFrame, MasksAreFoundBehindMergedAccesses) {
  Files files = tiles_with("profile \"p.json\"", "ceil(view / 8).area", kGoodProfile);
  std::string& root = files["frame.rg"];
  root.replace(root.find("update shown as storage disjoint"), 32, "");
  root.insert(root.find("spectrum kinds by"), "read shown as storage\n    write shown as storage disjoint\n    ");
  const Compiled compiled = compile_files(files);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.codes();
  for (const dsl::Pass& pass : compiled.result.program.graphs.rows[0].passes) {
    if (pass.name != "shade.classify") continue;
    EXPECT_EQ(compiled.result.program.graphs.rows[0].resources[pass.accesses[0].resource].name, "masks");
  }
}

TEST(SpectrumOfAFrame, MasksMatchTheGrid) {
  const Compiled compiled = compile_files(tiles_with("profile \"p.json\"", "ceil(view / 16).area", kGoodProfile));
  EXPECT_EQ(compiled.codes(), "RG0716 `masks` holds 16 masks and pass `shade` runs 64 groups; it takes one mask a group\n");
}

// Made in a hurry, variants are only pruned: nothing of them gets into the cache, and where the cache has them nothing is left to do.
TEST(VariantsOfAFrame, APreviewLeavesWorkUndoneAndNothingBehind) {
  const Folder folder;
  const Files files = frame_with("features sun, path, fog", kBody);
  CompileOptions options, hurried;
  options.cache_folder = hurried.cache_folder = folder.path.string();
  hurried.preview = true;
  const std::string whole = all_text(compile_files(files).result);
  const Compiled preview = compile_files(files, hurried);
  ASSERT_FALSE(preview.diagnostics.has_errors()) << preview.codes();
  EXPECT_FALSE(preview.result.complete);
  EXPECT_EQ(preview.result.graphs[0].plans[0].plan.pipeline_choices.size(), 8u);
  const Compiled complete = compile_files(files, options);
  EXPECT_TRUE(complete.result.complete);
  EXPECT_EQ(all_text(complete.result), whole);
  const Compiled again = compile_files(files, hurried);
  EXPECT_TRUE(again.result.complete);
  EXPECT_EQ(all_text(again.result), whole);
}

}  // namespace
}  // namespace rg::compiler
