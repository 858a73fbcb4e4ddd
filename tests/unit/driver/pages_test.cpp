// Every code has a page, and the examples on it are what they say.
#include "compiler/commands/pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "compiler/compile.h"

namespace rg::commands {
namespace {

std::string severity_free(const dsl::Diagnostics& diagnostics, const dsl::SourceFiles& sources) { return dsl::print(diagnostics, sources, false); }

struct Compiled {
  std::set<std::string> codes;
  bool errors = false;
  std::string shown;
};

void collect(const dsl::Diagnostic& diagnostic, std::set<std::string>& codes) {
  codes.insert(std::string(dsl::row(diagnostic.kind).code));
  for (const dsl::Diagnostic& note : diagnostic.notes) collect(note, codes);
}

Compiled compile_example(PageContext context, const std::string& example) {
  const std::vector<ExampleFile> files = example_files(context, example);
  const dsl::ReadSource read = [&](const std::string& path, std::string& why) -> std::optional<std::string> {
    const auto file = std::find_if(files.begin(), files.end(), [&](const ExampleFile& each) { return each.name == path; });
    if (file != files.end()) return file->text;
    why = "no such file";
    return std::nullopt;
  };
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  dsl::Diagnostics diagnostics;
  const compiler::CompileResult result = compiler::compile("example.rg", read, options, diagnostics);
  Compiled compiled;
  for (const dsl::Diagnostic& diagnostic : diagnostics.rows()) collect(diagnostic, compiled.codes);
  compiled.errors = diagnostics.has_errors();
  compiled.shown = severity_free(diagnostics, result.sources);
  return compiled;
}

TEST(Pages, EveryCodeHasOne) {
  std::set<std::string> known;
  for (const dsl::DiagnosticKind kind : dsl::all_diagnostic_kinds()) {
    const std::string code(dsl::row(kind).code);
    known.insert(code);
    EXPECT_NE(find_page(code), nullptr) << code << " " << dsl::row(kind).name;
  }
  EXPECT_EQ(find_page("RG9999"), nullptr);
  for (const Page& page : pages()) EXPECT_TRUE(known.contains(page.code)) << page.code << " has a page and is no code";
}

TEST(Pages, NotesBelongToAnErrorAndOthersHaveExamples) {
  for (const Page& page : pages()) {
    EXPECT_GT(page.why.size(), 10u) << page.code;
    if (!page.of.empty())
      EXPECT_NE(find_page(page.of), nullptr) << page.code;
    else
      EXPECT_TRUE(!page.wrong.empty() && !page.right.empty()) << page.code;
  }
}

TEST(Pages, TheWrongExampleGivesTheCode) {
  size_t compiled = 0;
  for (const Page& page : pages()) {
    if (page.context == PageContext::text || !page.of.empty()) continue;
    const Compiled wrong = compile_example(page.context, page.wrong);
    EXPECT_TRUE(wrong.codes.contains(page.code)) << page.code << " is not among\n" << wrong.shown;
    ++compiled;
  }
  EXPECT_GT(compiled, 150u);
}

TEST(Pages, TheRightExampleIsRight) {
  for (const Page& page : pages()) {
    if (page.context == PageContext::text || !page.of.empty()) continue;
    const Compiled right = compile_example(page.context, page.right);
    EXPECT_FALSE(right.errors) << page.code << "\n" << right.shown;
    EXPECT_FALSE(right.codes.contains(page.code)) << page.code << "\n" << right.shown;
  }
}

}  // namespace
}  // namespace rg::commands
