// Shader files: where a path leads, and a cache of what was read.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "compiler/shaders/shaders.h"

namespace rg::compiler {

// `path` as written in a file of `folder`, relative to the root folder and without `.` and `..`; nullopt if it leaves the root folder.
std::optional<std::string> resolve_path(const std::string& folder, const std::string& path);
std::string folder_of(const std::string& path);

// Reads each file once. Safe to call from several threads; the reader itself is called by one at a time.
class ShaderSources {
 public:
  explicit ShaderSources(ReadFile read) : read_(std::move(read)) {}
  // Null if unreadable. The text lives as long as this object.
  const std::string* find(const std::string& path);
  // Of a path that was not found: "no such file", "permission denied".
  std::string why_not(const std::string& path) const;
  // A text the compiler wrote itself, findable from now on under `path`, which the reader is not asked for and which does not count as read.
  const std::string& keep(const std::string& path, const std::string& text);
  std::vector<std::string> readable_paths() const;  // sorted

 private:
  ReadFile read_;
  mutable std::mutex mutex_;
  std::map<std::string, std::optional<std::string>> texts_;
  std::map<std::string, std::string> reasons_;  // of those without a text
  std::map<std::string, std::string> own_texts_;
};

}  // namespace rg::compiler
