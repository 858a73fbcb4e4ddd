#include "compiler/commands/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
namespace {

using dsl::DiagnosticKind;

// ---- things of a program -----------------------------------------------------------------------------------------------

// `bloom_down` also names `bloom_down[2]` and `bloom_down.clear`.
bool names(const std::string& name, std::string_view subject) {
  if (name == "barriers") return subject.starts_with("group ");
  if (name == "waits") return subject.starts_with("wait ");
  if (!subject.starts_with(name)) return false;
  return subject.size() == name.size() || subject[name.size()] == '[' || subject[name.size()] == '.';
}

std::string text_at(const dsl::SourceFiles& sources, dsl::Span span) { return sources[span.file].text.substr(span.begin, span.end - span.begin); }

// Uses of techniques, by the name of the instance or of the technique.
std::string used_techniques(const compiler::CompileResult& result, const dsl::Graph& graph, const std::string& name) {
  std::string text;
  for (const dsl::Instance& instance : graph.instances)
    if (instance.name == name || instance.technique == name || (instance.name.starts_with(name) && instance.name[name.size()] == '['))
      text += fmt::format("instance {}  {}\n  {}\n  technique {}  {}\n", instance.name, place_text(result.sources, instance.span),
                          text_at(result.sources, instance.span), instance.technique, place_text(result.sources, instance.declared));
  return text;
}

std::string declared(const compiler::CompileResult& result, const dsl::Graph& graph, const std::string& name) {
  std::string text = used_techniques(result, graph, name);
  for (const dsl::Pass& pass : graph.passes)
    if (names(name, pass.name)) text += fmt::format("pass {}  {}\n", pass.name, place_text(result.sources, pass.span));
  for (const compiler::Fold& fold : result.folded)  // no passes any more
    for (const dsl::Pass& pass : result.unfolded.graphs[fold.graph].passes)
      if (fold.pass == pass.name && names(name, pass.name) && graph.name == result.unfolded.graphs[fold.graph].name)
        text += fmt::format("pass {}  {}\n", pass.name, place_text(result.sources, pass.span));
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
    if (step.kind == StepKind::set) continue;
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
                            access.age ? fmt::format(", {} ago", counted(access.age, "frame")) : "");
  return text;
}

std::vector<std::string> all_names(const dsl::Program& program) {
  std::vector<std::string> all = declaration_names(program);
  for (const dsl::Struct& record : program.structs) all.push_back(record.name);
  for (const dsl::Graph& graph : program.graphs) {
    for (const dsl::Pass& pass : graph.passes) all.push_back(pass.name);
    for (const dsl::Resource& resource : graph.resources) all.push_back(resource.name);
    for (const dsl::Instance& instance : graph.instances) all.insert(all.end(), {instance.name, instance.technique});
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
  compile.until = compiler::Until::plans, compile.plan.reasons = true;
  const auto result = compile_or_report(options.file_or_code, compile);
  if (!result) return exit_input_wrong;
  std::string text =
      explain_struct(result->program, result->sources, options.name) + explain_declarations(result->program, result->sources, options.name);
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
  if (const std::string code = code_of(options.file_or_code); options.name.empty() && !code.empty()) return explain_code(code);
  if (!options.name.empty()) return explain_name(options);
  fmt::print(stderr, "explain: a file and a name, or a code, or --list is required\nRun with --help for more information.\n");
  return exit_call_wrong;
}

}  // namespace rg::commands
