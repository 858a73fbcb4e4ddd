#include "compiler/fusion/glsl_text.h"

#include <algorithm>
#include <sstream>

#include "compiler/shaders/sources.h"

namespace rg::compiler {
namespace {

constexpr size_t kMaxDepth = 32, kMaxIncludes = 1024;

// `#include "x"`: x; else nothing.
std::string included(const std::string& line) {
  size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  const size_t open = line.find('"', at), close = line.find('"', open + 1);
  return open == std::string::npos || close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

class Flattener {
 public:
  explicit Flattener(const ReadFile& read) : read_(read) {}

  void add(const std::string& path, size_t depth) {
    if (!out.missing.empty()) return;  // nobody reads on
    std::string why;
    const auto text = read_(path, why);
    if (!text) return note_missing(path, why);
    if (depth > kMaxDepth) return note_missing(path, "more than " + std::to_string(kMaxDepth) + " files include one another in a row");
    if (++count_ > kMaxIncludes) return note_missing(path, "more than " + std::to_string(kMaxIncludes) + " files are included");
    if (std::find(out.files.begin(), out.files.end(), path) == out.files.end()) out.files.push_back(path);
    out.text += "#line 1 \"" + path + "\"\n";
    std::istringstream lines(*text);
    size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::string header = included(line);
      if (header.empty()) {
        out.text += line + "\n";
        continue;
      }
      add(find(path, header), depth + 1);
      out.text += "#line " + std::to_string(number + 1) + " \"" + path + "\"\n";
    }
  }
  FlatSource out;

 private:
  void note_missing(const std::string& path, const std::string& why) { out.missing = path, out.why = why; }
  std::string find(const std::string& from, const std::string& header) {
    std::string ignored;
    for (const std::string& folder : {folder_of(from), std::string()})
      if (const auto path = resolve_path(folder, header); path && read_(*path, ignored)) return *path;
    return header;
  }
  const ReadFile& read_;
  size_t count_ = 0;
};

}  // namespace

FlatSource flatten(const std::string& path, const ReadFile& read) {
  Flattener flattener(read);
  flattener.add(path, 0);
  return std::move(flattener.out);
}

std::set<std::string> global_names(const std::vector<GlslWord>& words) {
  std::set<std::string> names;
  int depth = 0;
  for (size_t i = 0; i < words.size(); ++i) {
    const GlslWord& word = words[i];
    const bool macro = word.directive && i >= 2 && words[i - 1].text == "define" && words[i - 2].text == "#";
    if (macro) names.insert(std::string(word.text));
    if (word.directive) continue;
    if (word.text == "{" || word.text == "(" || word.text == "[") ++depth;
    if (word.text == "}" || word.text == ")" || word.text == "]") --depth;
    if (depth != 0 || !word.is_name() || i == 0 || i + 1 >= words.size()) continue;
    const std::string_view before = words[i - 1].text, after = words[i + 1].text;
    const bool typed = words[i - 1].is_name() || before == "]" || before == ",";
    const bool ends = after == "(" || after == "=" || after == ";" || after == "," || after == "[" || after == "{";
    if (typed && ends && !words[i - 1].directive) names.insert(std::string(word.text));
  }
  return names;
}

std::string rename(std::string_view text, const std::map<std::string, std::string>& renamed) {
  std::string out;
  size_t copied = 0;
  int depth = 0, fields_at = -1;  // braces; the depth inside the struct being declared
  bool heading = false;
  const std::vector<GlslWord> words = glsl_words(text);
  for (size_t i = 0; i < words.size(); ++i) {
    const GlslWord& word = words[i];
    if (!word.directive && word.text == "struct") heading = true;
    if (!word.directive && word.text == "{") {
      ++depth;
      if (heading) fields_at = depth, heading = false;
    }
    if (!word.directive && word.text == "}") {
      if (depth == fields_at) fields_at = -1;
      --depth;
    }
    if (!word.is_name() || (i > 0 && words[i - 1].text == ".")) continue;
    const bool field = fields_at == depth && fields_at > 0 && (i + 1 >= words.size() || !words[i + 1].is_name());
    const auto found = renamed.find(std::string(word.text));
    if (field || found == renamed.end()) continue;
    out += std::string(text.substr(copied, word.at - copied)) + found->second;
    copied = word.at + word.text.size();
  }
  return out + std::string(text.substr(copied));
}

}  // namespace rg::compiler
