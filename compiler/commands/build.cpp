#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "compiler/codegen/plan_file.h"
#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/commands/outputs.h"

namespace rg::commands {
namespace {

// What is asked for beside the folder.
std::vector<compiler::GeneratedFile> other_files(const BuildOptions& options, const compiler::CompileResult& result) {
  std::vector<compiler::GeneratedFile> files;
  if (!options.plan_file.empty()) files.push_back(plan_file(options.plan_file, result));
  const std::string target = options.stamp.empty() ? options.folder + "/manifest.txt" : options.stamp;
  if (!options.depfile.empty()) files.push_back({options.depfile, depfile(target, result.read_files)});
  return files;
}

// The files that options name.
std::vector<Output> named_outputs(const BuildOptions& options) {
  std::vector<Output> named;
  if (!options.plan_file.empty()) named.push_back({"the plan file", options.plan_file});
  if (!options.depfile.empty()) named.push_back({"the depfile", options.depfile});
  if (!options.stamp.empty()) named.push_back({"the stamp", options.stamp});
  return named;
}

// The banner names the file alone, so that the same program gives the same bytes wherever it is compiled from.
compiler::CompileOptions with_banner(const BuildOptions& options) {
  compiler::CompileOptions compile = options.compile;
  if (compile.command.empty()) compile.command = "rgc build " + std::filesystem::path(options.file).filename().string();
  return compile;
}

// Every job is hermetic: the sources and the flags decide what it stores in the cache.
nlohmann::ordered_json manifest_of(const BuildOptions& options, const compiler::CompileResult& result) {
  nlohmann::ordered_json json = {
      {"schema", "rgc-jobs-1"}, {"file", options.file}, {"sources", nlohmann::ordered_json::array()}, {"jobs", nlohmann::ordered_json::array()}};
  for (const std::string& path : result.read_files) json["sources"].push_back(path);
  for (size_t i = 0; i < result.tasks.size(); ++i) {
    const compiler::ShaderTask& task = result.tasks[i];
    const std::string shard = fmt::format("{}/{}", i, result.tasks.size());
    nlohmann::ordered_json arguments = {"build", options.file, "--shard", shard, "--cache", options.compile.cache_folder};
    for (const std::string& fixed : options.compile.fixed_features) arguments.insert(arguments.end(), {"-D", fixed});
    json["jobs"].push_back({{"shard", shard}, {"pass", task.pass}, {"shader", task.shader}, {"features", task.features}, {"arguments", arguments}});
  }
  return json;
}

int write_manifest(const BuildOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.list_tasks = true;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  dsl::Diagnostics diagnostics;
  if (may_write({{"the manifest", options.manifest}}, {}, result->read_files, diagnostics))
    write_file(options.manifest, manifest_of(options, *result).dump(2) + "\n", diagnostics);
  return finish(diagnostics, result->sources);
}

// A shard without a cache would be work for nothing.
int build_part(const BuildOptions& options) {
  if (options.compile.cache_folder.empty()) {
    fmt::print(stderr, "build: --shard needs a cache that the other parts share; name one with --cache DIR\n");
    return exit_call_wrong;
  }
  const auto result = compile_or_report(options.file, options.compile);
  if (!result) return exit_input_wrong;
  if (!options.quiet)
    print(
        fmt::format("part {} of {}: {} found, {} stored\n", options.compile.shard, options.compile.shards, result->cache.hits, result->cache.stored));
  dsl::Diagnostics diagnostics;
  const bool stamps = !options.stamp.empty() && may_write({{"the stamp", options.stamp}}, {}, result->read_files, diagnostics);
  if (stamps) touch_file(options.stamp, diagnostics);
  return finish(diagnostics, result->sources);
}

}  // namespace

compiler::GeneratedFile plan_file(const std::string& path, const compiler::CompileResult& result) {
  std::vector<Plan> plans;
  for (const compiler::CompiledGraph& graph : result.graphs)
    for (const compiler::FramePlan& frame : graph.plans) plans.push_back(frame.plan.view());
  return {path, compiler::emit_plan_file(plans)};
}

int build(const BuildOptions& options) {
  if (!options.manifest.empty()) return write_manifest(options);
  if (options.compile.shards > 0) return build_part(options);
  const auto result = compile_or_report(options.file, with_banner(options));
  if (!result) return exit_input_wrong;
  dsl::Diagnostics diagnostics;
  if (!may_write(named_outputs(options), outputs_in(options.folder, result->files), result->read_files, diagnostics))
    return finish(diagnostics, result->sources);
  std::vector<std::string> kept = result->read_files;
  if (!options.stamp.empty()) kept.push_back(options.stamp);
  const auto written = write_output(options.folder, result->files, diagnostics, other_files(options, *result), kept);
  if (!written || (!options.stamp.empty() && !touch_file(options.stamp, diagnostics))) return finish(diagnostics, result->sources);
  if (options.quiet) return exit_done;
  for (const std::string& name : written->changed) print(fmt::format("wrote   {}/{}\n", options.folder, name));
  for (const std::string& name : written->removed) print(fmt::format("removed {}/{}\n", options.folder, name));
  print(fmt::format("{}: {} written, {} removed, {} unchanged\n", options.folder, written->changed.size(), written->removed.size(),
                    written->unchanged));
  return exit_done;
}

}  // namespace rg::commands
