#include "dsl/paths.h"

#include <vector>

namespace rg::dsl {
namespace {

// False once `..` would leave the folder.
bool take_parts(std::string_view path, std::vector<std::string_view>& parts) {
  while (!path.empty()) {
    const size_t slash = path.find('/');
    const std::string_view part = path.substr(0, slash);
    path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
    if (part.empty() || part == ".") continue;
    if (part != "..")
      parts.push_back(part);
    else if (parts.empty())
      return false;
    else
      parts.pop_back();
  }
  return true;
}

}  // namespace

std::optional<std::string> join_inside(std::string_view folder, std::string_view path) {
  const bool absolute = path.empty() || path.front() == '/' || path.find('\\') != std::string_view::npos || path.find(':') != std::string_view::npos;
  std::vector<std::string_view> parts;
  if (absolute || !take_parts(folder, parts) || !take_parts(path, parts) || parts.empty()) return std::nullopt;
  std::string joined;
  for (const std::string_view part : parts) joined += (joined.empty() ? "" : "/") + std::string(part);
  return joined;
}

std::string folder_of(std::string_view path) {
  const size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

}  // namespace rg::dsl
