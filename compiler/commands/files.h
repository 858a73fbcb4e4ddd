// Files as the command line sees them: untrusted input is read within limits, output is written whole or not at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/codegen/generate.h"
#include "dsl/diagnostics.h"
#include "dsl/front_end.h"

namespace rg::commands {

constexpr size_t kMaxFileBytes = size_t{64} << 20;

// Control characters would break banners, comments and depfiles that a name stands in.
bool has_controls(std::string_view text);

// A regular file of at most kMaxFileBytes, without control characters in its name; nullopt and `why` ("no such file", "it is a folder", ...)
// otherwise. Never blocks on a pipe or device.
std::optional<std::string> read_file(const std::string& path, std::string& why);

// read_file for `root_path` and for what lies in its folder, symbolic links followed; nothing outside is read.
dsl::ReadSource reader_for(const std::string& root_path);

struct Written {
  std::vector<std::string> changed, removed;  // relative to the folder, sorted
  size_t unchanged = 0;
};

// Makes `folder` hold exactly `files`: writes what differs, removes what an earlier run wrote (by its manifest) and this one did not.
// Everything is written beside its place first and then renamed, so a full disk or a missing permission is reported with the old
// contents untouched. Files that rgc did not generate are never overwritten. `others` have paths of their own, are not listed, and are written with
// the folder or, as the folder, not at all. Neither they nor `kept` are removed, whatever an earlier manifest lists.
//
//   generated/manifest.txt    one relative path a line: what the next run may overwrite or remove
std::optional<Written> write_output(const std::string& folder, const std::vector<compiler::GeneratedFile>& files, dsl::Diagnostics& diagnostics,
                                    const std::vector<compiler::GeneratedFile>& others = {}, const std::vector<std::string>& kept = {});

// The list of a folder's files.
constexpr const char* kManifest = "manifest.txt";

// One file, whole or not at all, where `path` leads to; false after reporting.
bool write_file(const std::string& path, const std::string& text, dsl::Diagnostics& diagnostics);

// Creates the file or sets its time to now; false after reporting.
bool touch_file(const std::string& path, dsl::Diagnostics& diagnostics);

// A Makefile rule "target: sources", for CMake and Ninja. Sources that vanish do not break the next build.
std::string depfile(const std::string& target, const std::vector<std::string>& sources);

}  // namespace rg::commands
