// The grammar on the reference page and the parser agree.
#include "grammar.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>

#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "golden.h"

namespace rg::dsl {
namespace {

const std::string kSource = RGC_SOURCE_DIR;

const grammar::Rules& rules() {
  static const grammar::Rules all = grammar::read(golden::read_text(kSource + "/docs/language.md"));
  return all;
}

std::string complaints(const std::string& text) {
  constexpr FileId kFile{size_t{0}};
  Diagnostics diagnostics;
  parse(kFile, text, lex(kFile, text, diagnostics), diagnostics);
  SourceFiles files;
  files.add({"sentence.rg", text});
  return diagnostics.has_errors() ? print(diagnostics, files, false) : "";
}

TEST(Grammar, EveryRuleIsReachedAndDefined) {
  std::set<std::string> named = {"file"};
  const std::function<void(const grammar::Node&)> visit = [&](const grammar::Node& node) {
    if (node.kind == grammar::Node::Kind::rule) named.insert(node.text);
    for (const grammar::Node& part : node.parts) visit(part);
  };
  for (const auto& [name, node] : rules()) visit(node);
  for (const std::string& name : named) EXPECT_TRUE(rules().contains(name)) << name << " has no rule";
  for (const auto& [name, node] : rules()) EXPECT_TRUE(named.contains(name)) << name << " is used by no rule";
}

TEST(Grammar, TheParserAcceptsEverySentence) {
  size_t tokens = 0;
  for (uint64_t seed = 1; seed <= 400; ++seed) {
    Random random(seed * 7919);
    const std::string text = grammar::sentence(rules(), "file", random, 14);
    tokens += text.size();
    const std::string found = complaints(text);
    ASSERT_EQ(found, "") << "seed " << seed << "\n" << text;
    EXPECT_TRUE(grammar::recognise(rules(), "file", text).whole) << text;
  }
  EXPECT_GT(tokens, 50000u);
}

std::vector<std::string> accepted_files() {
  std::vector<std::string> all = golden::inputs("check");
  for (const char* folder : {"passes", "examples", "bench/graphs"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource + "/" + folder))
      if (entry.path().extension() == ".rg") all.push_back(entry.path().string());
  all.push_back(kSource + "/passes.rg");
  all.push_back(kSource + "/tests/golden/parse/everything.rg");
  return all;
}

TEST(Grammar, WhatTheParserAcceptsIsASentence) {
  size_t accepted = 0;
  for (const std::string& path : accepted_files()) {
    const std::string text = golden::read_text(path);
    if (!complaints(text).empty()) continue;
    const grammar::Recognised found = grammar::recognise(rules(), "file", text);
    EXPECT_TRUE(found.whole) << path << " goes beyond the grammar near: " << text.substr(found.reached, 60);
    ++accepted;
  }
  EXPECT_GT(accepted, 20u);
}

// A sentence with one token less or more is refused by both or by neither, nearly always: newlines, which the grammar leaves out, may tell them
// apart.
TEST(Grammar, DamagedSentencesAreJudgedAlike) {
  size_t alike = 0, count = 0;
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed * 104729);
    const std::string text = mutate_token(grammar::sentence(rules(), "file", random, 10), random).text;
    alike += complaints(text).empty() == grammar::recognise(rules(), "file", text).whole;
    ++count;
  }
  EXPECT_GT(alike * 10, count * 9) << alike << " of " << count;
}

}  // namespace
}  // namespace rg::dsl
