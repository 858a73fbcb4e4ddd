#include <fmt/format.h>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/commands/plan_json.h"
#include "compiler/commands/plan_text.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "dsl/print.h"

namespace rg::commands {
namespace {

// Tokens or tree of the root file alone: what there is before names mean anything.
int emit_syntax(const std::string& path, bool tree) {
  dsl::Diagnostics diagnostics;
  dsl::SourceFiles sources;
  std::string why;
  const auto text = read_file(path, why);
  if (!text) {
    diagnostics.report(dsl::DiagnosticKind::FileNotReadable, {}, {path, why});
    return finish(diagnostics, sources);
  }
  const dsl::FileId file = sources.add(dsl::SourceFile(path, *text));
  const std::string& source = sources[file].text;
  const dsl::Tokens tokens = dsl::lex(file, source, diagnostics);
  print(tree ? dsl::print_tree(dsl::parse(file, source, tokens, diagnostics)) : dsl::print_tokens(source, tokens));
  return finish(diagnostics, sources);
}

using PlanText = std::string (*)(const PlanData&);

int emit_plans(const compiler::CompileResult& result, PlanText text) {
  for (const compiler::CompiledGraph& graph : result.graphs) {
    for (const compiler::FramePlan& plan : graph.plans) {
      print(fmt::format("graph {}{}{}\n", plan.plan.name, plan.plan.variant_name.empty() ? "" : "  ", plan.plan.variant_name));
      print(text(plan.plan));
    }
  }
  return exit_done;
}

int emit_graphs(const compiler::CompileResult& result) {
  for (const dsl::Graph& graph : result.program.graphs) print(graph_text(result.program, graph));
  return exit_done;
}

int emit_shaders(const compiler::CompileResult& result) {
  for (const compiler::CompiledGraph& graph : result.graphs) {
    const dsl::Graph& row = result.program.graphs[graph.graph];
    for (const compiler::CompiledShader& shader : graph.shaders.shaders) print(fmt::format("{}  {} words\n", shader.name, shader.words.size()));
    for (size_t p = 0; p < graph.shaders.passes.size(); ++p)
      for (const size_t shader : graph.shaders.passes[p].shaders)
        print(fmt::format("  {} uses {}\n", row.passes.rows[p].name, graph.shaders.shaders[shader].name));
  }
  return exit_done;
}

// Generated files one after the other, each behind a line that names it.
int emit_files(const compiler::CompileResult& result, bool shaders) {
  for (const compiler::GeneratedFile& file : result.files)
    if (shaders == file.path.starts_with("shaders/")) print(fmt::format("==> {} <==\n{}", file.path, file.text));
  return exit_done;
}

int emit_json(const compiler::CompileResult& result) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const compiler::CompiledGraph& graph : result.graphs)
    for (const compiler::FramePlan& plan : graph.plans) all.push_back(plan_json(result, graph, plan));
  print(all.dump(2) + "\n");
  return exit_done;
}

struct StageRow {
  const char* name;
  compiler::Until until;
  int (*emit)(const compiler::CompileResult&);
};
using compiler::Until;
constexpr StageRow kStages[] = {
    {"program", Until::program, [](const compiler::CompileResult& result) { return print(dsl::print_program(result.program)), int{exit_done}; }},
    {"graph", Until::program, emit_graphs},
    {"shaders", Until::shaders, emit_shaders},
    {"schedule", Until::plans, [](const compiler::CompileResult& result) { return emit_plans(result, schedule_text); }},
    {"lifetimes", Until::plans, [](const compiler::CompileResult& result) { return emit_plans(result, lifetimes_text); }},
    {"memory", Until::plans, [](const compiler::CompileResult& result) { return emit_plans(result, memory_text); }},
    {"barriers", Until::plans, [](const compiler::CompileResult& result) { return emit_plans(result, barriers_text); }},
    {"plan", Until::plans, emit_json},
    {"cpp", Until::files, [](const compiler::CompileResult& result) { return emit_files(result, false); }},
    {"spirv", Until::files, [](const compiler::CompileResult& result) { return emit_files(result, true); }},
};

}  // namespace

std::vector<std::string> emit_stages() {
  std::vector<std::string> names = {"tokens", "tree"};
  for (const StageRow& row : kStages) names.push_back(row.name);
  return names;
}

int emit(const EmitOptions& options) {
  if (options.stage == "tokens" || options.stage == "tree") return emit_syntax(options.file, options.stage == "tree");
  for (const StageRow& row : kStages) {
    if (options.stage != row.name) continue;
    compiler::CompileOptions compile = options.compile;
    compile.until = row.until;
    if (compile.command.empty()) compile.command = "rgc build " + options.file;
    const auto result = compile_or_report(options.file, compile);
    return result ? row.emit(*result) : exit_input_wrong;
  }
  return exit_call_wrong;
}

}  // namespace rg::commands
