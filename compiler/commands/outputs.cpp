#include "compiler/commands/outputs.h"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <utility>

#include "compiler/commands/files.h"
#include "compiler/commands/replace_files.h"

namespace rg::commands {
namespace {

namespace fs = std::filesystem;
using dsl::DiagnosticKind;

using Identity = std::pair<uint64_t, uint64_t>;  // device and inode; zeros: there is none

Identity identity_of(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return {};
  return {static_cast<uint64_t>(about.st_dev), static_cast<uint64_t>(about.st_ino)};
}

// One text for all names of a place, whether something is there or not.
std::string place_of(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(target_of(path), error);
  const fs::path place = fs::weakly_canonical(whole, error);
  return (error ? whole.lexically_normal() : place).string();
}

}  // namespace

std::vector<Output> outputs_in(const std::string& folder, const std::vector<compiler::GeneratedFile>& files) {
  std::vector<Output> outputs;
  for (const compiler::GeneratedFile& file : files) outputs.push_back({"a generated file", (fs::path(folder) / file.path).string()});
  outputs.push_back({"the list of generated files", (fs::path(folder) / kManifest).string()});
  return outputs;
}

bool may_write(const std::vector<Output>& named, const std::vector<Output>& generated, const std::vector<std::string>& read,
               dsl::Diagnostics& diagnostics) {
  std::map<Identity, std::string> inputs;
  for (const std::string& path : read) inputs.emplace(identity_of(path), path);
  inputs.erase(Identity());
  std::map<std::string, std::string> taken;
  bool good = true;
  const auto check = [&](const Output& output) {
    if (const auto input = inputs.find(identity_of(output.path)); input != inputs.end()) {
      diagnostics.report(DiagnosticKind::OutputIsInput, {}, {output.what, output.path, input->second});
      return good = false;
    }
    const auto [other, fresh] = taken.emplace(place_of(output.path), output.what);
    if (!fresh) diagnostics.report(DiagnosticKind::OutputTwice, {}, {output.what, output.path, other->second});
    return good &= fresh;
  };
  for (const Output& output : generated) check(output);
  for (const Output& output : named) {
    if (!check(output)) continue;
    const std::string why = why_not_replaced(output.path);
    if (!why.empty()) diagnostics.report(DiagnosticKind::OutputNotWritable, {}, {output.path, why, "nothing was changed"});
    good &= why.empty();
  }
  return good;
}

}  // namespace rg::commands
