#include "compiler/shaders/sources.h"

#include <filesystem>

namespace rg::compiler {
namespace fs = std::filesystem;

std::optional<std::string> resolve_path(const std::string& folder, const std::string& path) {
  const fs::path joined = (fs::path(folder) / path).lexically_normal();
  if (path.empty() || joined.is_absolute() || joined.empty() || *joined.begin() == "..") return std::nullopt;
  return joined.generic_string();
}

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().generic_string(); }

const std::string* ShaderSources::find(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (const auto own = own_texts_.find(path); own != own_texts_.end()) return &own->second;
  auto [at, is_new] = texts_.try_emplace(path);
  if (std::string why; is_new) {
    at->second = read_(path, why);
    if (!at->second) reasons_[path] = why.empty() ? "it cannot be read" : why;
  }
  return at->second ? &*at->second : nullptr;
}

const std::string& ShaderSources::keep(const std::string& path, const std::string& text) {
  const std::lock_guard lock(mutex_);
  return own_texts_[path] = text;
}

std::string ShaderSources::why_not(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = reasons_.find(path);
  return found == reasons_.end() ? "" : found->second;
}

std::vector<std::string> ShaderSources::readable_paths() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> paths;
  for (const auto& [path, text] : texts_)
    if (text) paths.push_back(path);
  return paths;
}

}  // namespace rg::compiler
