// GLSL as words: enough of it to give several pieces of source names that do not meet in one shader.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/shaders/shaders.h"

namespace rg::compiler {

// A shader source with everything it includes in place, `#line N "file"` around each part so that messages name files and lines as written.
struct FlatSource {
  std::string text;
  std::vector<std::string> files;  // in order of first mention
  std::string missing;             // the first file that cannot be read; empty: none
};
// `path` is relative to the root folder. An `#include` looks beside the including file, then in the root folder, 32 deep.
FlatSource flatten(const std::string& path, const ReadFile& read);

// A word of GLSL: an identifier, a number, or one character of anything else. Comments are none.
struct GlslWord {
  std::string_view text;
  size_t at = 0;            // offset
  uint32_t line = 0;        // as `#line` counts
  std::string_view file;    // as `#line` says
  bool directive = false;   // on a line that begins with `#`
  bool is_name() const;
};
std::vector<GlslWord> glsl_words(std::string_view text);

// What the text declares outside braces: functions, variables, constants, structs, macros. What a macro declares is not found.
std::set<std::string> global_names(const std::vector<GlslWord>& words);

// The text with every name in `renamed` replaced, but for members (`.name`) and the fields of structs.
std::string rename(std::string_view text, const std::map<std::string, std::string>& renamed);

}  // namespace rg::compiler
