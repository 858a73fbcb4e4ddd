// Any bytes through the parser: a tree and diagnostics, the same ones again, and a tree without errors only where nothing was reported.
#include "dsl/check_macro.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "dsl/print.h"

namespace {

struct Parsed {
  rg::dsl::Diagnostics diagnostics;
  std::string tree;
  bool has_error = false;
};

Parsed parse_text(const std::string& text) {
  constexpr rg::dsl::FileId kFile{size_t{0}};
  Parsed parsed;
  const rg::dsl::Tokens tokens = rg::dsl::lex(kFile, text, parsed.diagnostics);
  const rg::dsl::ast::File tree = rg::dsl::parse(kFile, text, tokens, parsed.diagnostics);
  parsed.tree = rg::dsl::print_tree(tree);
  parsed.has_error = tree.has_error;
  return parsed;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Parsed once = parse_text(text), again = parse_text(text);
  RG_CHECK(once.tree == again.tree && once.diagnostics.rows().size() == again.diagnostics.rows().size(), "parsing is a function of the text");
  RG_CHECK(!once.has_error || once.diagnostics.has_errors(), "a broken tree has a message");
  for (const rg::dsl::Diagnostic& row : once.diagnostics.rows())
    RG_CHECK(row.span.begin <= row.span.end && row.span.end <= text.size(), "spans lie within the text");
  return 0;
}
