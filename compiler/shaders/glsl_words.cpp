#include "compiler/shaders/glsl_words.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>

namespace rg::compiler {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

namespace {

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct Scanner {
  std::string_view text;
  size_t at = 0;
  uint32_t line = 1;
  std::string_view file = {};
  bool fresh = true, directive = false;  // at the start of a line; on a line of the preprocessor

  void newline() {
    const bool goes_on = directive && at > 0 && text[at - 1] == '\\';
    ++line, fresh = true, directive = goes_on;
  }
  void skip_comment() {
    const bool block = text[at + 1] == '*';
    const size_t end = text.find(block ? "*/" : "\n", at + 2);
    const size_t stop = end == std::string_view::npos ? text.size() : end + (block ? 2 : 0);
    for (; at < stop; ++at)
      if (text[at] == '\n') ++line;
  }
  size_t word_end() const {
    size_t end = at + 1;
    if (is_word(text[at]))
      while (end < text.size() && is_word(text[end])) ++end;
    return end;
  }
};

}  // namespace

bool GlslWord::is_name() const { return !text.empty() && starts_name(text[0]); }

std::vector<GlslWord> glsl_words(std::string_view text) {
  std::vector<GlslWord> words;
  Scanner scan{text};
  while (scan.at < text.size()) {
    const char c = text[scan.at];
    if (c == '\n') {
      scan.newline();
      ++scan.at;
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++scan.at;
    } else if (c == '/' && scan.at + 1 < text.size() && (text[scan.at + 1] == '/' || text[scan.at + 1] == '*')) {
      scan.skip_comment();
    } else if (scan.fresh && c == '#' && text.substr(scan.at, 6) == "#line ") {
      const size_t end = std::min(text.find('\n', scan.at), text.size());
      const std::string_view rest = text.substr(scan.at + 6, end - scan.at - 6);
      scan.line = static_cast<uint32_t>(std::strtoul(std::string(rest).c_str(), nullptr, 10)) - 1;
      const size_t open = rest.find('"'), close = rest.rfind('"');
      if (open != std::string_view::npos && close > open) scan.file = rest.substr(open + 1, close - open - 1);
      scan.at = end;
    } else {
      scan.directive |= scan.fresh && c == '#';
      scan.fresh = false;
      const size_t end = scan.word_end();
      words.push_back({text.substr(scan.at, end - scan.at), scan.at, scan.line, scan.file, scan.directive});
      scan.at = end;
    }
  }
  return words;
}

}  // namespace rg::compiler
