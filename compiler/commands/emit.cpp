#include <fmt/format.h>

#include <memory>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/commands/plan_json.h"
#include "compiler/commands/plan_text.h"
#include "dsl/lexer.h"

namespace rg::commands {
namespace {

struct EmitOptions {
  std::string stage, file;
  compiler::CompileOptions compile;
};

// One token a line: place, kind, text.
int emit_tokens(const std::string& path) {
  dsl::Diagnostics diagnostics;
  dsl::SourceFiles sources;
  std::string why;
  const auto text = read_file(path, why);
  if (!text) {
    diagnostics.report(dsl::DiagnosticKind::InputNotAFile, {}, {path, why});
    return finish(diagnostics, sources);
  }
  const dsl::FileId file = sources.add(dsl::SourceFile(path, *text));
  const std::string& source = sources[file].text;
  for (const dsl::Token& token : dsl::lex(file, source, diagnostics)) {
    const dsl::Position at = sources[file].position(token.begin);
    print(fmt::format("{:>5}:{:<4} {:<16} {}\n", at.line, at.column, dsl::name(token.kind), dsl::text_of(token, source)));
  }
  return finish(diagnostics, sources);
}

std::string struct_text(const dsl::Struct& record) {
  std::string text = fmt::format("struct {}  // std140 {}, std430 {} bytes\n", record.name, record.size140, record.size430);
  for (const dsl::Field& field : record.fields) text += fmt::format("  {:>4} {:>4}  {}\n", field.offset140, field.offset430, field.name);
  return text;
}

std::string program_text(const dsl::Program& program) {
  std::string text = fmt::format("module {}\n", program.module);
  for (const auto& constant : program.constants) text += fmt::format("const {} = {}\n", constant.name, constant.value);
  for (const dsl::Extent& extent : program.extents)
    text += fmt::format("extent {} = {}x{}x{} max {}x{}x{}\n", extent.name, extent.initial[0], extent.initial[1], extent.initial[2], extent.maximum[0],
                        extent.maximum[1], extent.maximum[2]);
  for (const dsl::Feature& feature : program.features) text += fmt::format("feature {}: {}\n", feature.name, fmt::join(feature.values, " "));
  for (const dsl::Condition& condition : program.conditions) text += fmt::format("condition {}\n", condition.name);
  for (const dsl::Struct& record : program.structs) text += struct_text(record);
  for (const dsl::Graph& graph : program.graphs) text += graph_text(program, graph);
  return text;
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
    for (const compiler::FramePlan& plan : graph.plans) all.push_back(plan_json(plan.plan));
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
    {"program", Until::program, [](const compiler::CompileResult& result) { return print(program_text(result.program)), int{exit_done}; }},
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

int emit(const EmitOptions& options) {
  if (options.stage == "tokens") return emit_tokens(options.file);
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

std::vector<std::string> stage_names() {
  std::vector<std::string> names = {"tokens"};
  for (const StageRow& row : kStages) names.push_back(row.name);
  return names;
}

}  // namespace

void add_emit(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("emit", "what a phase gives, as text");
  auto options = std::make_shared<EmitOptions>();
  command->add_option("STAGE", options->stage, "which phase")->required()->check(CLI::IsMember(stage_names()));
  command->add_option("FILE", options->file, "the root .rg file")->required();
  add_plan_options(*command, options->compile);
  command->callback([=, &run] { run = [=] { return emit(*options); }; });
}

}  // namespace rg::commands
