#include "dsl/source.h"

#include <algorithm>

namespace rg::dsl {

SourceFile::SourceFile(std::string path_, std::string text_) : path(std::move(path_)), text(std::move(text_)) {
  line_starts.push_back(0);
  for (uint32_t at = 0; at < text.size(); ++at)
    if (text[at] == '\n') line_starts.push_back(at + 1);
}

Position SourceFile::position(uint32_t offset) const {
  if (line_starts.empty()) return {};
  const auto after = std::upper_bound(line_starts.begin(), line_starts.end(), offset);
  const auto line = static_cast<uint32_t>(after - line_starts.begin());
  return {line, offset - line_starts[line - 1] + 1};
}

std::string_view SourceFile::line(uint32_t one_based) const {
  if (one_based == 0 || one_based > line_starts.size()) return {};
  const uint32_t begin = line_starts[one_based - 1];
  size_t end = text.find('\n', begin);
  if (end == std::string::npos) end = text.size();
  if (end > begin && text[end - 1] == '\r') --end;
  return std::string_view(text).substr(begin, end - begin);
}

}  // namespace rg::dsl
