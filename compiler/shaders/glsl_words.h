// GLSL as words, before the preprocessor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace rg::compiler {

bool is_word(char c);  // part of a name or number, in ASCII

// A word of GLSL: an identifier, a number, or one character of anything else. Comments are none.
struct GlslWord {
  std::string_view text;
  size_t at = 0;           // offset
  uint32_t line = 0;       // as `#line` counts
  std::string_view file;   // as `#line` says
  bool directive = false;  // on a line that begins with `#`
  bool is_name() const;
};
std::vector<GlslWord> glsl_words(std::string_view text);

}  // namespace rg::compiler
