// How long texts become: exact for what a preprocessor would make of plain cases, and quick for what it would not get through.
#include "compiler/shaders/expansion.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

Expansions::Measure measure(const std::string& text) {
  static std::vector<std::string> kept;  // words point into it
  kept.reserve(64);
  kept.push_back(text);
  static std::vector<std::vector<GlslWord>> words;
  words.reserve(64);
  words.push_back(glsl_words(kept.back()));
  Expansions expansions;
  expansions.add_macros(words.back());
  return expansions.measure(words.back());
}
uint64_t count(const std::string& text) { return measure(text).words; }

TEST(Expansion, CountsWhatThePreprocessorWouldMake) {
  EXPECT_EQ(count("a b c"), 3u);
  EXPECT_EQ(count("#define TWO(x) x x\nTWO(TWO(a)) b"), 5u);
  EXPECT_EQ(count("#define A 1 + 2\n#define B A * A\nB;"), 8u);
  EXPECT_EQ(count("#define F(a, b) a + b\nF((1, 2), 3)"), 7u);
  EXPECT_EQ(count("#define F(a) a\nF + 1"), 3u);           // no call
  EXPECT_EQ(count("#define F (a)\nF"), 3u);                // no parameters
  EXPECT_EQ(count("#define A \\\n  1 + \\\n  1\nA"), 3u);  // over several lines
}

TEST(Expansion, NamesThatPassThroughParametersAndPastesAreFollowed) {
  EXPECT_EQ(count("#define LIST(X) X(a) X(b) X(c)\n#define USE(n) n + n;\nLIST(USE)"), 12u);
  EXPECT_EQ(count("#define N1 1 1 1\n#define N(i) N##i\nN(1)"), 3u);
  EXPECT_EQ(count("#define TWO(x) x x\n#define ALIAS TWO\nALIAS(a)"), 3u);  // `TWO` itself counts, as an upper bound
  EXPECT_EQ(count("#define TWO(x) x x\n#define MORE 1 + TWO\nMORE(a)"), 5u);
}

TEST(Expansion, AMacroWithinItselfIsAWord) {
  EXPECT_EQ(count("#define A A + B\n#define B A\nA"), 3u);
  EXPECT_EQ(count("#define F(x) F(x) + x\nF(1)"), 6u);
}

TEST(Expansion, AllBranchesCountAndTheLongestOfSeveralDefinitions) {
  EXPECT_EQ(count("#if 0\n#define A 1 2 3\n#else\n#define A 1\n#endif\nA"), 4u);  // and the condition
  EXPECT_EQ(count("#define A 1 2 3\n#if A\nb\n#endif"), 4u);
}

std::string doubling(int levels, const std::string& before, const std::string& after) {
  std::string text = "#define L0" + before + " 1\n";
  for (int i = 1; i <= levels; ++i) {
    const std::string inner = "L" + std::to_string(i - 1) + after;
    text += "#define L" + std::to_string(i) + before + " " + inner + " " + inner + "\n";
  }
  return text + "x;\nL" + std::to_string(levels) + after;
}

TEST(Expansion, WhatMultipliesIsTooLongAndNamed) {
  for (const auto& [before, after] : {std::pair("", ""), {"(x)", "(x)"}, {"(x)", "(x + x)"}}) {
    const std::string text = doubling(64, before, after);
    const Expansions::Measure found = measure(text);
    EXPECT_GT(found.words, kMostWords) << before;
    ASSERT_NE(found.longest, nullptr);
    EXPECT_EQ(found.longest->text, "L64");
    EXPECT_EQ(found.longest->line, 67u);
    EXPECT_LE(count(doubling(12, before, after)), kMostWords) << before;
  }
}

TEST(Expansion, DepthAndEffortAreBounded) {
  std::string nested = "a";
  for (int i = 0; i < 5000; ++i) nested = "F(" + nested + ")";
  EXPECT_GT(count("#define F(x) x\n" + nested), kMostWords);
  // Each level calls the next with two lengths, so that no two calls are equal.
  std::string text = "#define L0(x) x\n";
  for (int i = 1; i < 60; ++i)
    text += "#define L" + std::to_string(i) + "(x) L" + std::to_string(i - 1) + "(x y) L" + std::to_string(i - 1) + "(x y z)\n";
  EXPECT_GT(count(text + "L59(a)"), kMostWords);
}

}  // namespace
}  // namespace rg::compiler
