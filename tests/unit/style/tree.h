// The source tree as data: files below a folder and what they include.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace rg::style {

struct File {
  std::string path;  // relative to the root, "dsl/lexer.cpp"
  std::string text;
};

inline std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Files below `folder` with one of the suffixes, sorted by path.
inline std::vector<File> files_below(const std::string& folder, const std::vector<std::string>& suffixes) {
  namespace fs = std::filesystem;
  std::vector<File> files;
  const fs::path root = RGC_SOURCE_DIR;
  if (!fs::exists(root / folder)) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string path = fs::relative(entry.path(), root).generic_string();
    const auto ends = [&](const std::string& suffix) { return path.ends_with(suffix); };
    if (entry.is_regular_file() && std::any_of(suffixes.begin(), suffixes.end(), ends)) files.push_back({path, read(entry.path())});
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.path < b.path; });
  return files;
}

inline std::vector<File> cpp_below(const std::string& folder) { return files_below(folder, {".h", ".cpp", ".def"}); }

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What `#include "..."` names, in order.
inline std::vector<std::string> quoted_includes(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(text)) {
    const std::string start = "#include \"";
    const size_t at = line.find(start), end = line.rfind('"');
    if (at != std::string::npos && line.find_first_not_of(" \t") == at) names.push_back(line.substr(at + start.size(), end - at - start.size()));
  }
  return names;
}

}  // namespace rg::style
