// Warnings that are known, and those that count as errors.
#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::compiler {
namespace {

struct Judged {
  dsl::Diagnostics diagnostics;
  CompileResult result;

  std::string text() const { return dsl::print(diagnostics, result.sources, false); }
  std::string codes(bool allowed) const {
    std::string all;
    for (const dsl::Diagnostic& each : diagnostics.rows())
      if (each.allowed() == allowed) all += std::string(dsl::row(each.kind).code) + " ";
    return all;
  }
};

Judged judge_text(const std::string& text, CompileOptions options = {}) {
  Judged judged;
  options.until = Until::plans;
  const test::Files files = {{"frame.rg", text}};
  judged.result = compile("frame.rg", test::reader_of(files), options, judged.diagnostics);
  return judged;
}

// Two passes that reach nothing; what is given stands in the first, in the graph and in the file.
std::string frame_with(const std::string& in_pass, const std::string& in_graph = "", const std::string& in_file = "") {
  return in_file + "\ngraph frame(surface out: rgba8 4x4 after copy_src)\n{\n" + in_graph +
         "\n  image a : r8 4x4\n  image b : r8 4x4\n  pass first : compute { write a as storage  " + in_pass +
         " }\n  pass second : compute { write b as storage }\n  pass show : raster { color out clear 0 }\n}\n";
}

TEST(Allow, SpeaksForWhatItStandsIn) {
  EXPECT_EQ(judge_text(frame_with("")).codes(false), "RG0516 ");  // one, with a note for the second pass
  const Judged pass = judge_text(frame_with("allow RG0516"));
  EXPECT_EQ(pass.codes(true), "RG0516 ");
  EXPECT_EQ(pass.codes(false), "RG0516 ");
  EXPECT_EQ(pass.text().find("`first`"), std::string::npos);
  EXPECT_NE(pass.text().find("pass `second` reaches no output"), std::string::npos);
  EXPECT_EQ(judge_text(frame_with("", "allow RG0516")).codes(true), "RG0516 RG0516 ");
  EXPECT_EQ(judge_text(frame_with("", "", "allow RG0516")).text(), "");
  EXPECT_EQ(judge_text(frame_with("", "when on { pass third : compute { write b as storage }  allow RG0516 }", "feature on: bool")).codes(true),
            "RG0516 ");
}

// What only a known pass wanted is known with it; what others want as well is not.
TEST(Allow, CoversWhatWasDoneForThePass) {
  const std::string reader = "  image c : r8 4x4\n  pass third : compute { read a as sampled  write c as storage  allow RG0516 }\n";
  const std::string text = frame_with("");
  const std::string with_reader = std::string(text).insert(text.find("  pass show"), reader);
  EXPECT_EQ(judge_text(with_reader).text().find("`first`"), std::string::npos);
  EXPECT_NE(judge_text(with_reader).text().find("pass `second` reaches no output"), std::string::npos);
  const std::string other = "  image d : r8 4x4\n  pass fourth : compute { read a as sampled  write d as storage }\n";
  EXPECT_NE(judge_text(std::string(with_reader).insert(with_reader.find("  pass show"), other)).text().find("`first`"), std::string::npos);
}

// A scope that ends before the warning does not hide one around both that holds it; each of the two is needed by something.
TEST(Allow, OneScopeInAnotherHidesNothing) {
  const Judged both = judge_text(frame_with("", "  image one : r8 4x4 allow RG0388\n  image two : r8 4x4\n", "allow RG0388"));
  EXPECT_EQ(both.codes(true), "RG0388 RG0388 ");
  EXPECT_EQ(both.codes(false), "RG0516 ");
  const Judged apart = judge_text(frame_with("", "  image one : r8 4x4 allow RG0388\n  image two : r8 4x4\n"));
  EXPECT_EQ(apart.codes(true), "RG0388 ");
  EXPECT_EQ(apart.codes(false), "RG0388 RG0516 ");
}

// Every warning against every allowance would take hours.
TEST(Allow, ManyAreNothingSpecial) {
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "  buffer b" + std::to_string(i) + " : u32[4] allow RG0388\n";
  const Judged judged = judge_text(frame_with("", many));
  EXPECT_EQ(judged.codes(true).size(), 20000 * std::string("RG0388 ").size());
  EXPECT_EQ(judged.codes(false), "RG0516 ");
}

TEST(Allow, WhatNothingNeedsIsAWarningWithAFix) {
  const Judged judged = judge_text(frame_with("allow RG0516  allow RG0388"));
  EXPECT_EQ(judged.codes(false), "RG0516 RG0260 ");
  const dsl::Diagnostic& useless = judged.diagnostics.rows().back();
  EXPECT_EQ(useless.message(), "`allow RG0388` silences nothing: nothing here gives this warning");
  ASSERT_EQ(useless.fixes.size(), 1u);
  const dsl::Span span = useless.fixes[0].span;
  EXPECT_EQ(judged.result.sources[span.file].text.substr(span.begin, span.end - span.begin), "allow RG0388");
}

// Half of a compilation, or a part of the plans, has not given every warning.
TEST(Allow, IsNotCalledUselessByHalfABuild) {
  const std::string text = frame_with("allow RG0388  allow RG0516", "", "feature on: bool");
  EXPECT_NE(judge_text(text).codes(false).find("RG0260"), std::string::npos);
  CompileOptions fixed;
  fixed.fixed_features = {"on=off"};
  EXPECT_EQ(judge_text(text, fixed).codes(false).find("RG0260"), std::string::npos);
  CompileOptions hurried;
  hurried.preview = true;
  EXPECT_EQ(judge_text(text, hurried).codes(false).find("RG0260"), std::string::npos);
}

TEST(Allow, TheCommandLineSpeaksForAllAndTheFileGoesBeforeIt) {
  CompileOptions allow, deny;
  allow.warnings.allowed = deny.warnings.denied = {dsl::DiagnosticKind::ReachesNothing};
  const Judged allowed = judge_text(frame_with(""), allow);
  EXPECT_EQ(allowed.text(), "");
  EXPECT_EQ(allowed.diagnostics.rows()[0].standing, dsl::Standing::allowed_outside);
  EXPECT_NE(dsl::print_sarif(allowed.diagnostics, allowed.result.sources).find("\"external\""), std::string::npos);
  const Judged denied = judge_text(frame_with("allow RG0516"), deny);
  EXPECT_TRUE(denied.diagnostics.has_errors());
  EXPECT_EQ(denied.codes(true), "RG0516 ");
  EXPECT_NE(denied.text().find("error[RG0516]: pass `second`"), std::string::npos);
  EXPECT_FALSE(judge_text(frame_with("", "allow RG0516"), deny).diagnostics.has_errors());
}

TEST(Allow, ErrorsStayErrors) {
  CompileOptions options;
  options.warnings.allowed = {dsl::DiagnosticKind::ReadBeforeWrite};
  const std::string text =
      "allow RG0301\ngraph frame(surface out: rgba8 4x4 after copy_src)\n{\n  image a : r8 4x4\n  pass show : raster { read a as sampled in fragment "
      " color out clear 0 }\n}\n";
  const Judged judged = judge_text(text, options);
  EXPECT_TRUE(judged.diagnostics.has_errors());
  EXPECT_EQ(judged.codes(false), "RG0260 RG0301 ");
}

}  // namespace
}  // namespace rg::compiler
