#include <algorithm>

#include "compiler/shaders/agreement.h"
#include "compiler/shaders/glsl_words.h"

namespace rg::compiler {
namespace {

// Of `name` as a whole word at or after `from` and before `end`, not behind `//` on its line; npos if there is none.
size_t find_word(const std::string& text, const std::string& name, size_t from, size_t end) {
  for (size_t at = text.find(name, from); at != std::string::npos && at + name.size() <= end; at = text.find(name, at + 1)) {
    const bool alone = (at == 0 || !is_word(text[at - 1])) && (at + name.size() == text.size() || !is_word(text[at + name.size()]));
    const size_t line_start = text.rfind('\n', at) + 1;  // npos + 1 is 0
    if (alone && text.find("//", line_start) >= at) return at;
  }
  return std::string::npos;
}

}  // namespace

ShaderPlaces::ShaderPlaces(dsl::SourceFiles& files, ShaderSources& sources)
    : files_(files), sources_(sources), root_folder_(files.empty() ? "" : folder_of(files.rows[0].path)) {}

dsl::FileId ShaderPlaces::file(const std::string& path) {
  const std::string shown = root_folder_.empty() ? path : root_folder_ + "/" + path;
  for (size_t i = 0; i < files_.size(); ++i)
    if (files_.rows[i].path == shown) return dsl::FileId{i};
  const std::string* text = sources_.find(path);
  return files_.add(dsl::SourceFile(shown, text != nullptr ? *text : ""));
}

dsl::Span ShaderPlaces::line(const std::string& path, uint32_t line) {
  const dsl::FileId id = file(path);
  const dsl::SourceFile& source = files_[id];
  const size_t row = std::clamp<size_t>(line, 1, source.line_starts.size()) - 1;
  uint32_t begin = source.line_starts[row];
  uint32_t end = row + 1 < source.line_starts.size() ? source.line_starts[row + 1] : static_cast<uint32_t>(source.text.size());
  const auto is_space = [&](uint32_t at) { return std::isspace(static_cast<unsigned char>(source.text[at])) != 0; };
  while (end > begin && is_space(end - 1)) --end;
  while (begin < end && is_space(begin)) ++begin;
  return {id, begin, end};
}

dsl::Span ShaderPlaces::word(const std::string& path, const std::string& name) {
  const dsl::FileId id = file(path);
  const size_t at = find_word(files_[id].text, name, 0, files_[id].text.size());
  if (at == std::string::npos) return line(path, 1);
  return {id, static_cast<uint32_t>(at), static_cast<uint32_t>(at + name.size())};
}

dsl::Span ShaderPlaces::word_in_line(const std::string& path, uint32_t one_based, const std::string& name) {
  const dsl::Span whole = line(path, one_based);
  const size_t at = name.empty() ? std::string::npos : find_word(files_[whole.file].text, name, whole.begin, whole.end);
  if (at == std::string::npos) return whole;
  return {whole.file, static_cast<uint32_t>(at), static_cast<uint32_t>(at + name.size())};
}

std::string ShaderPlaces::text_of_line(const std::string& path, uint32_t one_based) {
  const dsl::Span whole = line(path, one_based);
  return files_[whole.file].text.substr(whole.begin, whole.end - whole.begin);
}

}  // namespace rg::compiler
