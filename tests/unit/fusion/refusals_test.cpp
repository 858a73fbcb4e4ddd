// What cannot be a block, what cannot be fused, and what the checker of kernels finds wrong.
#include "compiler/verify/fusion.h"
#include "tests/unit/fusion/fixture.h"

namespace rg::test {
namespace {

constexpr const char* kHead = R"(module main
extent view = runtime(64, 64) max(128, 128)
feature bright : bool
condition late
sampler linear { filter linear }
)";

// Two blocks in a `fuse`; `a` and `b` are their statements.
Files pair_of(const std::string& a, const std::string& b, const std::string& first_glsl = "void element(ivec2 at) { mid = vec4(at, 0, 1); }",
              const std::string& second_glsl = "void element(ivec2 at) { shown = mid * 2.0; }") {
  return {{"main.rg", std::string(kHead) + R"(graph g() {
  image mid   : rgba16f view
  image other : rgba16f view
  image half  : rgba16f view / 2
  image shown : rgba16f view output
  fuse both {
    pass first : compute {
)" + a + "\n    }\n    pass second : compute {\n" +
                          b + "\n    }\n  }\n}\n"},
          {"first.glsl", first_glsl},
          {"second.glsl", second_glsl}};
}
constexpr const char* kFirst = "block \"first.glsl\"\n write mid as element\n dispatch over view";
constexpr const char* kSecond = "block \"second.glsl\"\n read mid as element\n write shown as element\n dispatch over view";

std::string messages(const Files& files) { return compile_files(files).messages(); }
bool says(const std::string& all, const std::string& part) { return all.find(part) != std::string::npos; }

TEST(Blocks, FuseWhereTheyMeetAtElements) { EXPECT_EQ(messages(pair_of(kFirst, kSecond)), ""); }

TEST(Refusals, NameTheAccess) {
  const std::string all =
      messages(pair_of(kFirst, "block \"second.glsl\"\n read mid as sampled(linear)\n write shown as element\n dispatch over view",
                       "void element(ivec2 at) { mid = vec4(at, 0, 1); }", "void element(ivec2 at) { shown = textureLod(mid, vec2(0.5), 0.0); }"));
  EXPECT_EQ(
      all,
      "RG0729 `fuse both` cannot merge pass `second` with those before it: `second` reads `mid` at any element, and `first` writes `mid` at its own "
      "element\n  `first` writes `mid` at its own element\n  `second` reads `mid` at any element\n");
}

TEST(Refusals, PointAtBothAccesses) {
  const Compiled compiled = compile_files(
      pair_of(kFirst, "block \"second.glsl\"\n read mid as sampled(linear)\n write shown as element\n dispatch over view",
              "void element(ivec2 at) { mid = vec4(at, 0, 1); }", "void element(ivec2 at) { shown = textureLod(mid, vec2(0.5), 0.0); }"));
  const std::string text = compiled.text();
  EXPECT_EQ(compiled.diagnostics.rows().back().notes.front().kind, dsl::DiagnosticKind::FusedWith);
  EXPECT_TRUE(says(text, "write mid as element")) << text;
  EXPECT_TRUE(says(text, "read mid as sampled(linear)")) << text;
}

struct Case {
  const char *what, *second, *expected;
};
TEST(Refusals, SayWhatDiffers) {
  const Case cases[] = {
      {"domain", "block \"second.glsl\"\n write h = half as element\n dispatch over view / 2", "`first` runs over other elements"},
      {"spare", "block \"second.glsl\"\n update mid as storage disjoint\n write shown as element\n dispatch over view",
       "`second` writes `mid` at any element"},
  };
  for (const Case& row : cases) {
    const std::string all =
        messages(pair_of(kFirst, row.second, "void element(ivec2 at) { mid = vec4(at, 0, 1); }",
                         row.what == std::string("domain") ? "void element(ivec2 at) { h = vec4(0); }"
                                                           : "void element(ivec2 at) { imageStore(mid, at, vec4(1)); shown = vec4(0); }"));
    EXPECT_TRUE(says(all, row.expected)) << row.what << ": " << all;
  }
}

TEST(Refusals, QueuesFeaturesAndConditions) {
  const auto with = [](const std::string& from, const std::string& to) {
    Files files = pair_of(kFirst, kSecond);
    std::string& text = files["main.rg"];
    text.replace(text.find(from), from.size(), to);
    return messages(files);
  };
  EXPECT_TRUE(says(with("pass second : compute {", "pass second : compute queue compute may {"), "they ask for different queues"));
  Files files = pair_of(kFirst, kSecond);
  std::string& text = files["main.rg"];
  text.replace(text.find("    pass second"), 15, "    if host late { pass second");
  text.insert(text.rfind("}\n}"), "} ");
  EXPECT_TRUE(says(messages(files), "they run under different conditions of the host")) << messages(files);
}

TEST(Refusals, WhatIsBetweenStaysBetween) {
  Files files = pair_of(kFirst, kSecond);
  std::string& text = files["main.rg"];
  text.replace(text.find("fuse both"), 9, "fuse both may");
  text.insert(
      text.find("    pass second"),
      "    pass look : compute {\n      shader \"look.comp\" group 8 8 1\n      read mid as sampled\n      write other as storage\n      keep\n"
      "      dispatch over view\n    }\n");
  files["look.comp"] = "void main() { imageStore(other, ivec2(gl_GlobalInvocationID.xy), texelFetch(mid, ivec2(0), 0)); }";
  const Compiled compiled = compile_files(files);
  EXPECT_FALSE(compiled.diagnostics.has_errors()) << compiled.text();
  EXPECT_TRUE(compiled.result.fused.empty());
  ASSERT_EQ(compiled.result.not_fused.size(), 1u);
  EXPECT_EQ(compiled.result.not_fused[0].pass, "look");
  prove(compiled.result);
}

TEST(Refusals, WithMayFuseWhatTheyCan) {
  Files files = pair_of(kFirst, "block \"second.glsl\"\n read mid as element\n write other as element\n dispatch over view",
                        "void element(ivec2 at) { mid = vec4(at, 0, 1); }", "void element(ivec2 at) { other = mid; }");
  std::string& text = files["main.rg"];
  text.replace(text.find("fuse both"), 9, "fuse both may");
  text.insert(text.rfind("  }\n}"), R"(    pass third : compute {
      block "third.glsl"
      read other as sampled(linear)
      write shown as element
      dispatch over view
    }
)");
  files["third.glsl"] = "void element(ivec2 at) { shown = textureLod(other, (vec2(at) + 0.5) / vec2(domain_size()), 0.0); }";
  const Compiled compiled = compile_files(files);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.text();
  ASSERT_EQ(compiled.result.fused.size(), 1u);
  EXPECT_EQ(compiled.result.fused[0].members, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(compiled.messages().substr(0, 7), "RG0730 ");
  prove(compiled.result);
}

// ---- what is no block

std::string of_block(const std::string& glsl, const std::string& statements = kFirst) { return messages(pair_of(statements, kSecond, glsl)); }

TEST(Blocks, HaveNoPlaceOfTheirOwn) {
  const std::string all = of_block("void element(ivec2 at) { mid = vec4(gl_GlobalInvocationID, 1); }");
  EXPECT_EQ(all,
            "RG0732 `gl_GlobalInvocationID` has no place in a block: where an element runs is the kernel's affair; `at` is its place\n"
            "  shader of pass `first`, named here\n");
  EXPECT_TRUE(says(of_block("void element(ivec2 at) { barrier(); mid = vec4(0); }"), "elements do not wait for each other"));
  EXPECT_TRUE(says(of_block("shared float x; void element(ivec2 at) { mid = vec4(0); }"), "elements share no memory"));
  EXPECT_TRUE(says(of_block("void element(ivec2 at) { mid = subgroupAdd(vec4(1)); }"), "elements do not see their neighbours"));
}

// The image behind an element has no name that a block could use.
TEST(Blocks, CannotReachAnotherElement) {
  EXPECT_TRUE(says(of_block("void element(ivec2 at) { imageStore(rg_own_mid, at + 1, vec4(0)); mid = vec4(0); }"), "RG0732 `rg_own_mid`"));
  const std::string all = of_block("void element(ivec2 at) { imageStore(mid, at + 1, vec4(0)); }");
  EXPECT_TRUE(says(all, "RG0402")) << all;
}

TEST(Blocks, DoNotSeeEachOther) {
  const std::string all = messages(pair_of(kFirst, kSecond, "void element(ivec2 at) { mid = shown; }"));
  EXPECT_TRUE(says(all, "shown")) << all;
  EXPECT_EQ(all.substr(0, 2), "RG");
}

TEST(Blocks, KeepTheirNamesApart) {
  const std::string helper =
      "const float K = 2.0;\n#define TWICE(x) ((x) * K)\nstruct S { float mid; };\nfloat f(float x) { S s = S(x); return TWICE(s.mid); }\n";
  EXPECT_EQ(messages(pair_of(
                kFirst, kSecond, helper + "void element(ivec2 at) { mid = vec4(f(1.0)); }",
                "const int K = 3;\n#define TWICE(x) (K)\nint f(int x) { return TWICE(x); }\nvoid element(ivec2 at) { shown = mid * float(f(1)); }")),
            "");
}

// Each technique calls its parameters `with`, of which the kernel has two; a third block calls one of them by another name.
TEST(Blocks, KeepParametersOfTheirTechniquesApart) {
  const Files files = {{"main.rg", R"(module main
extent view = runtime(64, 64) max(128, 128)
struct Gain { by: f32 }
technique raise(params with: Gain, image from: r32f, out image to: r32f) {
  pass scale : compute { block "scale.glsl"  params with  read from as element  write to as element  dispatch over view }
}
graph g(params left: Gain, params right: Gain) {
  image a : r32f view
  image b : r32f view
  image c : r32f view
  image d : r32f view output
  fuse all {
    pass make : compute { block "make.glsl"  params left  write a as element  dispatch over view }
    use first = raise(left, a, b)
    use second = raise(right, b, c)
    pass last : compute { block "last.glsl"  params right  read c as element  write d as element  dispatch over view }
  }
}
)"},
                       {"make.glsl", "void element(ivec2 at) { a = float(at.x) * left.by; }"},
                       {"scale.glsl", "void element(ivec2 at) { to = from * with.by; }"},
                       {"last.glsl", "void element(ivec2 at) { d = c + right.by; }"}};
  const Compiled compiled = compile_files(files);
  EXPECT_EQ(compiled.messages(), "");
  ASSERT_EQ(compiled.result.fused.size(), 1u);
  EXPECT_EQ(compiled.result.fused[0].members.size(), 4u);
  const auto& graph = compiled.result.program.graphs.rows.front();
  const auto kernel = std::find_if(graph.passes.rows.begin(), graph.passes.rows.end(), [](const dsl::Pass& pass) { return pass.params.size() == 2; });
  ASSERT_NE(kernel, graph.passes.rows.end());
  EXPECT_EQ(kernel->params[0].name, "left");
  EXPECT_EQ(kernel->params[1].name, "with");
  const std::string& text = kernel->shaders[0].text;
  EXPECT_NE(text.find("rg_a * left.by"), std::string::npos) << text;
  EXPECT_NE(text.find("* with.by"), std::string::npos) << text;
  EXPECT_NE(text.find("+ with.by"), std::string::npos) << text;
  prove(compiled.result);
}

TEST(Blocks, NeedTheirFunctions) {
  EXPECT_EQ(of_block("void main() { mid = vec4(0); }"), "RG0733 block `first.glsl` does not define `element`\n");
  EXPECT_EQ(
      of_block("void element(ivec2 at) { mid = vec4(0); }",
               "block \"first.glsl\" scan x f32 associative\n write mid as element\n dispatch over view"),
      "RG0733 block `first.glsl` does not define `start`\nRG0733 block `first.glsl` does not define `own`\nRG0733 block `first.glsl` does not define "
      "`join`\n");
}

TEST(Blocks, UseWhatTheyDeclare) {
  EXPECT_EQ(of_block("void element(ivec2 at) { }"),
            "RG0403 `mid` is declared by pass `first` but none of its shaders uses it\n  shader of pass `first`, named here\n");
}

TEST(Blocks, ErrorsPointIntoTheirFiles) {
  const Compiled compiled = compile_files(pair_of(kFirst, kSecond, "#include \"inner.glsl\"\nvoid element(ivec2 at) {\n  mid = vec4(0)\n}"));
  EXPECT_TRUE(says(compiled.messages(), "inner.glsl")) << compiled.text();
  Files files = pair_of(kFirst, kSecond, "#include \"inner.glsl\"\nvoid element(ivec2 at) {\n  mid = nonsense;\n}");
  files["inner.glsl"] = "const float A = 1.0;\n";
  const std::string text = compile_files(files).text();
  EXPECT_TRUE(says(text, "first.glsl:3")) << text;
}

// ---- the checker of kernels

struct Checked {
  Compiled compiled = compile_files(pair_of(kFirst, kSecond));
  std::vector<verify::Kernel> kernels = {{"both", {"first", "second"}}};
  dsl::Program program = compiled.result.program;

  std::vector<verify::Finding> run() const {
    return verify::verify_fusion(compiled.result.written, program, dsl::GraphId{0}, std::vector<uint32_t>(program.features.size(), 0), kernels);
  }
  dsl::Pass& kernel() { return program.graphs.rows[0].passes.rows[0]; }
};

TEST(CheckerOfKernels, AcceptsWhatIsRight) { EXPECT_TRUE(Checked().run().empty()); }

TEST(CheckerOfKernels, MissesNoBlock) {
  Checked checked;
  checked.kernels[0].members.pop_back();
  EXPECT_FALSE(checked.run().empty());
  checked.kernels[0].members = {"first", "second", "second"};
  EXPECT_FALSE(checked.run().empty());
  checked.kernels[0].members = {"second", "first"};
  EXPECT_FALSE(checked.run().empty()) << "the wrong order";
}

TEST(CheckerOfKernels, NoticesEveryAccessThatIsLostOrAdded) {
  const Checked good;
  for (size_t i = 0; i < good.program.graphs.rows[0].passes.rows[0].accesses.size(); ++i) {
    Checked lost = good, weak = good;
    lost.kernel().accesses.erase(lost.kernel().accesses.begin() + static_cast<long>(i));
    EXPECT_FALSE(lost.run().empty());
    weak.kernel().accesses[i].mode = dsl::Mode::read;
    EXPECT_FALSE(weak.run().empty());
  }
  Checked more = good;
  dsl::Access access = more.kernel().accesses[0];
  for (size_t r = 0; r < more.program.graphs.rows[0].resources.size(); ++r)
    if (more.program.graphs.rows[0].resources.rows[r].name == "other") access.resource = dsl::ResourceId{r};
  more.kernel().accesses.push_back(access);
  EXPECT_FALSE(more.run().empty());
}

TEST(CheckerOfKernels, KnowsWhoReadsWhatIsKept) {
  Checked checked;
  dsl::Graph& written = checked.compiled.result.written.graphs.rows[0];
  dsl::Pass reader = written.passes.rows[1];
  reader.name = "reader";
  reader.accesses.resize(1);
  written.passes.add(reader);
  checked.program.graphs.rows[0].passes.add(reader);
  const auto findings = checked.run();
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].text, "`reader` reads `mid`, which kernel `both` keeps to itself");
}

TEST(CheckerOfKernels, KnowsThatElementsMayNotMeet) {
  Checked checked;
  for (dsl::Pass& pass : checked.compiled.result.written.graphs.rows[0].passes)
    for (dsl::Access& access : pass.accesses)
      if (access.mode == dsl::Mode::read) access.element = false;
  const auto findings = checked.run();
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].hazard, verify::Hazard::read_after_write);
}

}  // namespace
}  // namespace rg::test
