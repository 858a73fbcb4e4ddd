#include <fmt/format.h>

#include <filesystem>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"

namespace rg::commands {
namespace {

bool write_dependencies(const BuildOptions& options, const compiler::CompileResult& result, dsl::Diagnostics& diagnostics) {
  const std::string target = options.stamp.empty() ? options.folder + "/manifest.txt" : options.stamp;
  if (!options.depfile.empty() && !write_file(options.depfile, depfile(target, result.read_files), diagnostics)) return false;
  return options.stamp.empty() || touch_file(options.stamp, diagnostics);
}

// The banner names the file alone, so that the same program gives the same bytes wherever it is compiled from.
compiler::CompileOptions with_banner(const BuildOptions& options) {
  compiler::CompileOptions compile = options.compile;
  if (compile.command.empty()) compile.command = "rgc build " + std::filesystem::path(options.file).filename().string();
  return compile;
}

}  // namespace

int build(const BuildOptions& options) {
  const auto result = compile_or_report(options.file, with_banner(options));
  if (!result) return exit_input_wrong;
  dsl::Diagnostics diagnostics;
  const auto written = write_output(options.folder, result->files, diagnostics);
  if (!written || !write_dependencies(options, *result, diagnostics)) return finish(diagnostics, result->sources);
  if (options.quiet) return exit_done;
  for (const std::string& name : written->changed) print(fmt::format("wrote   {}/{}\n", options.folder, name));
  for (const std::string& name : written->removed) print(fmt::format("removed {}/{}\n", options.folder, name));
  print(fmt::format("{}: {} written, {} removed, {} unchanged\n", options.folder, written->changed.size(), written->removed.size(),
                    written->unchanged));
  return exit_done;
}

}  // namespace rg::commands
