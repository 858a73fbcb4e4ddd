#include "compiler/compile.h"

#include <filesystem>

#include "compiler/check_queues.h"
#include "compiler/codegen/bind.h"
#include "compiler/configurations.h"
#include "compiler/judge.h"

namespace rg::compiler {
namespace {

std::string in_folder_of(const std::string& root_path, const std::string& path) {
  return (std::filesystem::path(root_path).parent_path() / path).lexically_normal().string();
}

// Shader sources come through the same reader as .rg files, relative to the root file's folder.
ReadFile shader_reader(const std::string& root_path, const dsl::ReadSource& read) {
  return [=](const std::string& path) {
    std::string why;
    return read(in_folder_of(root_path, path), why);
  };
}

void tell(const CompileOptions& options, const std::string& what) {
  if (options.progress) options.progress(what);
}

std::vector<std::string> paths_read(const std::string& root_path, const CompileResult& result) {
  std::vector<std::string> paths;
  for (const dsl::SourceFile& source : result.sources)
    if (source.path.ends_with(".rg")) paths.push_back(source.path);
  for (const CompiledGraph& graph : result.graphs)
    for (const std::string& path : graph.shaders.read_files) paths.push_back(in_folder_of(root_path, path));
  return paths;
}

CompiledGraph compile_graph_shaders(const std::string& root_path, const dsl::ReadSource& read, dsl::GraphId id, const CompileOptions& options,
                                    CompileResult& result, dsl::Diagnostics& diagnostics) {
  tell(options, "shaders of " + result.program.graphs[id].name);
  CompiledGraph graph{id, {}, {}};
  graph.shaders = compile_shaders(result.program, id, shader_reader(root_path, read), result.sources, diagnostics);
  return graph;
}

std::vector<FramePlan> plan_all(const dsl::Program& program, const CompiledGraph& graph, const std::vector<Configuration>& configurations,
                                const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  PlanOptions plan_options = options.plan;
  if (!options.profile.empty()) plan_options.measured_us = measured_times(program, graph.graph, options.profile, options.profile_text, diagnostics);
  std::vector<FramePlan> plans;
  for (const Configuration& configuration : configurations) {
    tell(options, "plan of " + program.graphs[graph.graph].name + " " + configuration_name(program, configuration));
    FramePlan plan = plan_frame(program, graph.graph, configuration, plan_options);
    plan.plan.variant = static_cast<uint32_t>(plans.size());
    plan.plan.variant_count = static_cast<uint32_t>(configurations.size());
    plan.plan.variant_name = intern(configuration_name(program, configuration));
    attach_shaders(plan.plan, program, graph.graph, graph.shaders);
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace

// The whole compiler, top to bottom. Each step consumes only what is above it.
CompileResult compile(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  CompileResult result;

  // Text to program: lex, parse, check, with all imports.
  tell(options, root_path);
  dsl::FrontEndResult front = dsl::load_program(root_path, read, diagnostics);
  result.sources = std::move(front.files);
  if (diagnostics.has_errors()) return result;
  result.program = std::move(front.program);
  if (options.until == Until::program) return result;

  // Shaders behind their generated interfaces; what they really touch completes the declared accesses.
  for (size_t g = 0; g < result.program.graphs.size(); ++g)
    result.graphs.push_back(compile_graph_shaders(root_path, read, dsl::GraphId{g}, options, result, diagnostics));
  result.read_files = paths_read(root_path, result);

  // Which plans have to exist.
  std::vector<std::vector<Configuration>> configurations;
  for (const CompiledGraph& graph : result.graphs)
    configurations.push_back(expand_configurations(result.program, graph.graph, options.fixed_features, options.max_plans, diagnostics));

  // The gate: later phases cannot fail on user input; what they find is judged at the end.
  if (diagnostics.has_errors()) return result;
  for (const CompiledGraph& graph : result.graphs) result.program = resolve_stages(std::move(result.program), graph.graph, graph.shaders);
  if (options.until == Until::shaders) return result;

  // Queues that passes insist on.
  for (size_t g = 0; g < result.graphs.size(); ++g) check_queues(result.program, result.graphs[g].graph, configurations[g], diagnostics);
  if (diagnostics.has_errors()) return result;

  // Program to plans, one a configuration.
  for (size_t g = 0; g < result.graphs.size(); ++g)
    result.graphs[g].plans = plan_all(result.program, result.graphs[g], configurations[g], options, diagnostics);

  // What the program asserts about its plans.
  for (const CompiledGraph& graph : result.graphs) judge(result.program, graph.graph, graph.plans, options.plan, diagnostics);
  if (diagnostics.has_errors() || options.until == Until::plans) return result;

  // Plans and SPIR-V to files.
  tell(options, "generated files");
  std::vector<GraphOutput> outputs;
  for (const CompiledGraph& graph : result.graphs) outputs.push_back({graph.graph, &graph.plans});
  result.files = generate(result.program, outputs, result.sources, options.command);
  return result;
}

}  // namespace rg::compiler
