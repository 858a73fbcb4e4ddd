#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
namespace {

using dsl::DiagnosticKind;

// ---- diagnostic codes ------------------------------------------------------------------------------------------------

constexpr const char* kSeverities[] = {"error", "warning", "note"};

std::string code_line(DiagnosticKind kind) {
  const dsl::DiagnosticRow& info = dsl::row(kind);
  return fmt::format("{} {} {}: {}\n", info.code, kSeverities[static_cast<size_t>(info.severity)], info.name, info.message);
}

// What the ranges of codes are about.
std::string_view family(std::string_view code) {
  constexpr std::string_view families[] = {"Files and imports: what was named cannot be read, or files import each other in a circle.",
                                           "Text: characters and grammar.",
                                           "Names and types: something is unknown, declared twice or of the wrong kind.",
                                           "Meaning: what passes do to resources cannot be right in the order written.",
                                           "Shaders: a shader does not compile, or does something else than its pass declares.",
                                           "Judged facts: an assertion or a limit does not hold for the plan.",
                                           "The command line and the world around it.",
                                           "Variants: features that reach shaders, spectra, fused kernels, the cache."};
  const size_t index = static_cast<size_t>(code[3] - '0');
  return code[2] == '0' && index < std::size(families) ? families[index] : std::string_view();
}

int explain_code(const std::string& code) {
  for (const DiagnosticKind kind : dsl::all_diagnostic_kinds()) {
    if (dsl::row(kind).code != code) continue;
    print(code_line(kind) + "\n" + std::string(family(code)) + "\n{0}, {1} stand for what was found. docs/diagnostics.md lists all codes.\n");
    return exit_done;
  }
  dsl::Diagnostics diagnostics;
  diagnostics.report(DiagnosticKind::UnknownCode, {}, {code});
  return finish(diagnostics, {});
}

int list_codes() {
  for (const DiagnosticKind kind : dsl::all_diagnostic_kinds()) print(code_line(kind));
  return exit_done;
}

bool is_code(const std::string& text) {
  return text.size() == 6 && text.starts_with("RG") && std::all_of(text.begin() + 2, text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// ---- things of a program -----------------------------------------------------------------------------------------------

// `bloom_down` also names `bloom_down[2]` and `bloom_down.clear`.
bool names(const std::string& name, std::string_view subject) {
  if (name == "barriers") return subject.starts_with("group ");
  if (name == "waits") return subject.starts_with("wait ");
  if (!subject.starts_with(name)) return false;
  return subject.size() == name.size() || subject[name.size()] == '[' || subject[name.size()] == '.';
}

std::string declared(const compiler::CompileResult& result, const dsl::Graph& graph, const std::string& name) {
  std::string text;
  for (const dsl::Pass& pass : graph.passes)
    if (names(name, pass.name)) text += fmt::format("pass {}  {}\n", pass.name, place_text(result.sources, pass.span));
  for (const dsl::Resource& resource : graph.resources)
    if (names(name, resource.name))
      text += fmt::format("{}  {}  {}\n", resource.name, resource_kind_text(result.program, resource), place_text(result.sources, resource.span));
  return text;
}

std::string decided(const compiler::FramePlan& plan, const std::string& name) {
  std::string text;
  for (const compiler::Decision& decision : plan.decisions)
    if (names(name, decision.subject)) text += fmt::format("  {} {}: {}\n", decision.subject, decision.what, decision.reason);
  return text;
}

// The barriers right before a pass of that name.
std::string waited_for(const PlanData& plan, const std::string& name) {
  std::string text, pending;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::barriers) {
      pending += barrier_group_text(plan, plan.groups[step.index], "    ");
      continue;
    }
    if (names(name, plan.passes[step.index].name) && !pending.empty())
      text += fmt::format("  barriers before {}\n{}", plan.passes[step.index].name, pending);
    pending.clear();
  }
  return text;
}

std::string used_by(const dsl::Graph& graph, const std::string& name) {
  std::string text;
  for (const dsl::Pass& pass : graph.passes)
    for (const dsl::Access& access : pass.accesses)
      if (names(name, graph.resources[access.resource].name))
        text += fmt::format("  {} {} as {}{}\n", pass.name, mode_name(access.mode), role_name(access.role),
                            access.age ? fmt::format(", {} frames ago", access.age) : "");
  return text;
}

std::vector<std::string> all_names(const dsl::Program& program) {
  std::vector<std::string> all;
  for (const dsl::Graph& graph : program.graphs) {
    for (const dsl::Pass& pass : graph.passes) all.push_back(pass.name);
    for (const dsl::Resource& resource : graph.resources) all.push_back(resource.name);
  }
  return all;
}

int unknown(const compiler::CompileResult& result, const ExplainOptions& options) {
  dsl::Diagnostics diagnostics;
  dsl::Diagnostic& error = diagnostics.report(DiagnosticKind::UnknownSubject, {}, {options.name, options.file_or_code});
  if (const auto meant = nearest(options.name, all_names(result.program))) error.note(DiagnosticKind::DidYouMean, {}, {*meant});
  return finish(diagnostics, result.sources);
}

int explain_name(const ExplainOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto result = compile_or_report(options.file_or_code, compile);
  if (!result) return exit_input_wrong;
  std::string text;
  for (const compiler::CompiledGraph& compiled : result->graphs) {
    const dsl::Graph& graph = result->program.graphs[compiled.graph];
    text += declared(*result, graph, options.name) + used_by(graph, options.name);
    std::string before;
    for (const compiler::FramePlan& plan : compiled.plans) {
      const std::string now = decided(plan, options.name) + waited_for(plan.plan, options.name);
      if (now == before) continue;  // most configurations decide alike
      text += plan.plan.variant_name.empty() ? now : fmt::format("  with {}\n{}", plan.plan.variant_name, now);
      before = now;
    }
  }
  if (text.empty()) return unknown(*result, options);
  print(text);
  return exit_done;
}

}  // namespace

int explain(const ExplainOptions& options) {
  if (options.codes) return list_codes();
  if (options.name.empty() && is_code(options.file_or_code)) return explain_code(options.file_or_code);
  if (!options.name.empty()) return explain_name(options);
  fmt::print(stderr, "explain: a file and a name, or a code, or --codes is required\nRun with --help for more information.\n");
  return exit_call_wrong;
}

}  // namespace rg::commands
