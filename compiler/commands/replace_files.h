// Files that take the place of others together: all of them or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dsl/diagnostics.h"

namespace rg::commands {

std::string reason(int error);  // errno in words: "no such file", "the disk is full"

// The file that `path` leads to, symbolic links followed; nothing need be there. A link that leads back to itself stays as it is.
std::filesystem::path target_of(const std::filesystem::path& path);

// Why what is at `path` cannot be replaced: it is no regular file, or may not be written; empty: it can be, or nothing is there.
std::string why_not_replaced(const std::filesystem::path& path);

// prepare() writes beside each file's place, commit() renames. Until commit() gives true, every file is as it was; what could not be put back is
// named in the report. Folders that were made for files that did not come go again.
class FileReplacements {
 public:
  FileReplacements() = default;
  FileReplacements(const FileReplacements&) = delete;
  FileReplacements& operator=(const FileReplacements&) = delete;
  ~FileReplacements();

  // Each false after reporting. A link at `path` is replaced itself, see target_of().
  bool prepare(const std::filesystem::path& path, const std::string& text, dsl::Diagnostics& diagnostics);
  bool commit(dsl::Diagnostics& diagnostics);

 private:
  struct File {
    std::filesystem::path path, temporary;
    std::filesystem::path old;  // what stood there, under another name; empty: nothing did, or it could not be kept
    enum class Before : uint8_t { nothing, kept, lost } before = Before::nothing;
  };
  int make_folder(const std::filesystem::path& folder);
  std::string undo(size_t done);
  std::vector<File> files_;
  std::vector<std::filesystem::path> folders_;  // made here, parents first
  bool committed_ = false;
};

}  // namespace rg::commands
