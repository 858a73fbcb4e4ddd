// Programs from memory.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "dsl/front_end.h"

namespace rg::test {

using Files = std::map<std::string, std::string>;  // by path

// `files` outlive it.
inline dsl::ReadSource reader_of(const Files& files) {
  return [&files](const std::string& path, std::string& why) -> std::optional<std::string> {
    const auto file = files.find(path);
    if (file != files.end()) return file->second;
    why = "no such file";
    return std::nullopt;
  };
}

}  // namespace rg::test
