// Source files and places in them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dsl/ids.h"

namespace rg::dsl {

using FileId = Id<struct FileTag>;

// Half-open byte range [begin, end) of one file.
struct Span {
  FileId file;
  uint32_t begin = 0, end = 0;
  friend bool operator==(const Span&, const Span&) = default;
};

// One-based line and column; the column counts bytes.
struct Position {
  uint32_t line = 1, column = 1;
  friend bool operator==(const Position&, const Position&) = default;
};

// A file as read. `path` is what the user named, or the import path resolved against the root file's folder.
struct SourceFile {
  std::string path;
  std::string text;
  std::vector<uint32_t> line_starts;  // byte offset of each line, line_starts[0] == 0

  SourceFile() = default;
  SourceFile(std::string path, std::string text);
  Position position(uint32_t offset) const;
  std::string_view line(uint32_t one_based) const;  // without its line break
};

using SourceFiles = Table<FileId, SourceFile>;

}  // namespace rg::dsl
