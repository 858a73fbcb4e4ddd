// Any bytes through the lexer: tokens in order, without overlap, within the text; what lies between them is blank, comment, or nothing.
#include "dsl/check_macro.h"
#include "dsl/lexer.h"
#include "dsl/print.h"

namespace {

bool is_skipped(std::string_view gap) {
  while (!gap.empty()) {
    const bool foreign = gap.starts_with("/*"), comment = foreign || gap.starts_with("//");
    const size_t length = foreign ? std::min(gap.find("*/", 2), gap.size() - 2) + 2 : comment ? std::min(gap.find('\n'), gap.size()) : 1;
    if (!comment && std::string_view(" \t\r\n").find(gap[0]) == std::string_view::npos) return false;
    gap.remove_prefix(length);
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rg::dsl::Diagnostics diagnostics;
  const rg::dsl::Tokens tokens = rg::dsl::lex(rg::dsl::FileId{size_t{0}}, text, diagnostics);
  RG_CHECK(!tokens.empty() && tokens.back().kind == rg::dsl::TokenKind::end_of_file, "the last token is the end");
  size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // a byte order mark is none of the text
  for (const rg::dsl::Token& token : tokens) {
    const size_t end = token.begin + text_of(token, text).size();
    RG_CHECK(token.begin >= at && end <= text.size(), "tokens are in order and within the text");
    RG_CHECK(is_skipped(std::string_view(text).substr(at, token.begin - at)), "nothing but blanks and comments is left out");
    at = end;
  }
  rg::dsl::print_tokens(text, tokens);
  return 0;
}
