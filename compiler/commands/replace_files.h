// Files that take the place of others together: all of them or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dsl/diagnostics.h"

namespace rg::commands {

std::string reason(int error);  // errno in words: "no such file", "the disk is full"

// prepare() writes beside each file's place, commit() renames. Until commit() gives true, every file is as it was; what could not be put back is
// named in the report. Folders that were made for files that did not come go again.
class FileReplacements {
 public:
  FileReplacements() = default;
  FileReplacements(const FileReplacements&) = delete;
  FileReplacements& operator=(const FileReplacements&) = delete;
  ~FileReplacements();

  // Each false after reporting.
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
