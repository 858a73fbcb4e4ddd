#include "compiler/fusion/glsl_text.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "compiler/shaders/sources.h"

namespace rg::compiler {
namespace {

constexpr size_t kMaxDepth = 32;

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

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
    const auto text = read_(path);
    if (!text || depth > kMaxDepth) return note_missing(path);
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
  void note_missing(const std::string& path) {
    if (out.missing.empty()) out.missing = path;
  }
  std::string find(const std::string& from, const std::string& header) {
    for (const std::string& folder : {folder_of(from), std::string()})
      if (const auto path = resolve_path(folder, header); path && read_(*path)) return *path;
    return header;
  }
  const ReadFile& read_;
};

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

FlatSource flatten(const std::string& path, const ReadFile& read) {
  Flattener flattener(read);
  flattener.add(path, 0);
  return std::move(flattener.out);
}

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
