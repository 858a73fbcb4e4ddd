// Paths of imports and shaders: relative, with forward slashes, never leaving the root file's folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rg::dsl {

// `folder` + `path` with `.` and `..` resolved; nullopt if the result is absolute, empty or leaves the root folder.
std::optional<std::string> join_inside(std::string_view folder, std::string_view path);
// "passes/culling/" of "passes/culling/culling.rg", "" of "frame.rg"
std::string folder_of(std::string_view path);

}  // namespace rg::dsl
