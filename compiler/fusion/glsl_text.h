// GLSL from several pieces of source: enough of it to give them names that do not meet in one shader.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/shaders/glsl_words.h"
#include "compiler/shaders/shaders.h"

namespace rg::compiler {

// A shader source with everything it includes in place, `#line N "file"` around each part so that messages name files and lines as written.
struct FlatSource {
  std::string text;
  std::vector<std::string> files;  // in order of first mention
  std::string missing, why;        // the first file that cannot be read; empty: none
};
// `path` is relative to the root folder. An `#include` looks beside the including file, then in the root folder, 32 deep and up to 1,024 in all.
FlatSource flatten(const std::string& path, const ReadFile& read);

// What the text declares outside braces: functions, variables, constants, structs, macros. What a macro declares is not found.
std::set<std::string> global_names(const std::vector<GlslWord>& words);

// The text with every name in `renamed` replaced, but for members (`.name`) and the fields of structs.
std::string rename(std::string_view text, const std::map<std::string, std::string>& renamed);

}  // namespace rg::compiler
