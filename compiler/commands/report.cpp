#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "compiler/commands/command.h"
#include "compiler/commands/facts.h"
#include "compiler/fusion/fusion_figures.h"

namespace rg::commands {
namespace {

std::string mib(uint64_t bytes) { return fmt::format("{:.2f} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0)); }

double percent(uint64_t part, uint64_t whole) { return whole ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0; }

std::string text_of(const Facts& facts, const PlanData& plan) {
  std::string text = fmt::format("graph {}{}{}\n", facts.graph, facts.variant.empty() ? "" : "  ", facts.variant);
  text += fmt::format("  passes    {} live, {} culled\n", facts.passes_live, facts.passes_culled);
  for (const Culled& culled : plan.culled) text += fmt::format("              {}: {}\n", culled.pass, culled.reason);
  if (facts.passes_raster > 0)
    text +=
        fmt::format("              {} in {}\n", counted(facts.passes_raster, "raster pass", "raster passes"), counted(facts.renderings, "rendering"));
  text += fmt::format("  memory    {} with aliasing, {} without ({:.0f} % saved), lower bound {}\n", mib(facts.heap_bytes),
                      mib(facts.unaliased_bytes), 100 - percent(facts.heap_bytes, facts.unaliased_bytes), mib(facts.lower_bound_bytes));
  if (facts.lazy_bytes > 0)
    text += fmt::format("              {} where the device has lazily allocated memory, for {} that no rendering loads or stores\n",
                        mib(facts.heap_beside_lazy_bytes), mib(facts.lazy_bytes));
  text += fmt::format("  barriers  {} in {}, {} of them blunt\n", facts.barriers, counted(facts.barrier_calls, "call"), facts.all_commands);
  if (facts.events > 0) text += fmt::format("              {} of the calls wait for events that are set earlier\n", facts.events);
  text += fmt::format("  order     {}; {} pairs of passes are ordered, {} have to be\n", facts.order.method, facts.order.ordered_pairs,
                      facts.order.needed_pairs);
  for (const auto& point : facts.order.frontier) text += fmt::format("              {} groups at {}\n", point.groups, mib(point.bytes));
  text += fmt::format("  queues    {}: {}, {}\n", facts.queues, counted(facts.submits, "submit"), counted(facts.waits, "wait"));
  const compiler::Overlap& o = facts.overlap;
  text += fmt::format("  overlap   {} of {} moved; {:.1f} us modelled, {:.1f} on one queue, no less than {:.1f}: {:.0f} % of what can be gained\n",
                      counted(o.moved, "pass", "passes"), o.movable, o.end / 1000, o.serial / 1000, o.bound / 1000,
                      o.serial > o.bound ? 100 * (o.serial - o.end) / (o.serial - o.bound) : 100.0);
  for (size_t queue = 0; queue < o.work.size(); ++queue) text += fmt::format("              queue {} works {:.1f} us\n", queue, o.work[queue] / 1000);
  text += fmt::format("  variants  {}, {}\n", counted(facts.plans, "plan"), counted(facts.shaders, "shader"));
  text += fmt::format("  planned   in {:.2f} ms\n", facts.plan_ms);
  for (const auto& [phase, ms] : facts.phase_ms) text += fmt::format("              {:<12} {:.2f} ms\n", phase, ms);
  return text;
}

// What each `fuse` gave, beside the same program without.
std::string fused_text(const compiler::CompileResult& result, const compiler::CompileResult* unfused, size_t graph) {
  std::string text;
  for (const compiler::FusedKernel& kernel : result.fused) {
    if (kernel.graph.value != graph) continue;
    const compiler::FusionFigures figures = compiler::fusion_figures(result.written, kernel, dsl::initial_extents(result.written));
    text += fmt::format("  fused     {}: {} in one kernel, {} a frame not moved, {} not held\n", kernel.pass, fmt::join(kernel.members, ", "),
                        mib(figures.moved), mib(figures.memory));
  }
  if (text.empty() || unfused == nullptr || graph >= unfused->graphs.size()) return text;
  const compiler::CompiledGraph& other = unfused->graphs[graph];
  for (const compiler::FramePlan& plan : other.plans) {
    const Facts facts = find_facts(unfused->program, other, plan);
    text += fmt::format("            without it: {} passes, {} barriers in {}, {} of memory{}{}\n", facts.passes_live, facts.barriers,
                        counted(facts.barrier_calls, "call"), mib(facts.heap_bytes), facts.variant.empty() ? "" : "  ", facts.variant);
  }
  return text;
}

nlohmann::ordered_json fused_json(const compiler::CompileResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const compiler::FusedKernel& kernel : result.fused) {
    const compiler::FusionFigures figures = compiler::fusion_figures(result.written, kernel, dsl::initial_extents(result.written));
    nlohmann::ordered_json kept = nlohmann::ordered_json::array();
    for (const compiler::FusedKernel::Saved& saved : kernel.saved)
      if (saved.dropped) kept.push_back(result.written.graphs[kernel.graph].resources[saved.resource].name);
    rows.push_back({{"graph", result.written.graphs[kernel.graph].name},
                    {"fuse", kernel.fusion},
                    {"pass", kernel.pass},
                    {"members", kernel.members},
                    {"in_registers", std::move(kept)},
                    {"bytes_not_moved", figures.moved},
                    {"bytes_not_held", figures.memory}});
  }
  return rows;
}

nlohmann::ordered_json not_fused_json(const compiler::CompileResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const compiler::FusionRefusal& refusal : result.not_fused)
    rows.push_back(
        {{"graph", result.written.graphs[refusal.graph].name}, {"fuse", refusal.fusion}, {"pass", refusal.pass}, {"reason", refusal.reason}});
  return rows;
}

// Passes that renderings took in.
std::string folded_text(const compiler::CompileResult& result, size_t graph) {
  std::string text;
  for (const compiler::Fold& fold : result.folded)
    for (const compiler::Fold::Part& part : fold.parts)
      if (fold.graph.value == graph)
        text += fmt::format("  folded    {}: {} {}\n", fold.pass, part.into,
                            part.target.empty() ? "clears " + part.image : "resolves " + part.image + " to " + part.target);
  return text;
}

nlohmann::ordered_json folded_json(const compiler::CompileResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const compiler::Fold& fold : result.folded)
    for (const compiler::Fold::Part& part : fold.parts)
      rows.push_back({{"graph", result.program.graphs[fold.graph].name},
                      {"pass", fold.pass},
                      {"into", part.into},
                      {"as", part.target.empty() ? "clear" : "resolve"},
                      {"image", part.image},
                      {"target", part.target}});
  return rows;
}

nlohmann::ordered_json not_folded_json(const compiler::CompileResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const compiler::FoldRefusal& refusal : result.not_folded)
    rows.push_back({{"graph", result.program.graphs[refusal.graph].name}, {"pass", refusal.pass}, {"reason", refusal.reason}});
  return rows;
}

// Variants that were built, and why the others were not.
std::string variants_text(const compiler::ShaderBundle& bundle) {
  std::string text;
  for (const compiler::VariantCount& count : bundle.counts) {
    text += fmt::format("  shader {} of {}: {} declared, {} built by {}\n", count.shader, count.pass, counted(count.declared, "variant"), count.built,
                        counted(count.front_ends, "front-end run"));
    const auto avoided = [&](uint64_t number, const char* why) {
      if (number > 0) text += fmt::format("    {} avoided: {}\n", number, why);
    };
    avoided(count.infeasible, "no plan has that combination of features");
    avoided(count.unreachable, "the pass is absent or culled there");
    avoided(count.indifferent, "they differ in features the shader does not look at");
    avoided(count.equal, "they are the same SPIR-V as another");
  }
  return text;
}

// Features that took no plans of their own.
std::string merged_text(const dsl::Program& program) {
  std::string text;
  for (const dsl::Condition& condition : program.conditions)
    if (condition.feature.valid())
      text += fmt::format("  feature {} only removes passes: `{}` is a condition of the plan\n", program.features[condition.feature].name,
                          condition.name);
  return text;
}

nlohmann::ordered_json variants_json(const std::vector<compiler::CompiledGraph>& graphs) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const compiler::CompiledGraph& graph : graphs)
    for (const compiler::VariantCount& count : graph.shaders.counts)
      rows.push_back({{"pass", count.pass},
                      {"shader", count.shader},
                      {"declared", count.declared},
                      {"infeasible", count.infeasible},
                      {"unreachable", count.unreachable},
                      {"indifferent", count.indifferent},
                      {"equal", count.equal},
                      {"built", count.built},
                      {"front_ends", count.front_ends}});
  return rows;
}

// The facts of the first plan at the top; `plans` holds those of every graph and configuration.
nlohmann::ordered_json json_of(const std::vector<Facts>& all, const compiler::CompileResult& result) {
  nlohmann::ordered_json json = {{"schema", "rgc-report-1"}};
  json.update(to_json(all.front()));
  json["plans"] = nlohmann::ordered_json::array();
  for (const Facts& facts : all) json["plans"].push_back(to_json(facts));
  json["shader_variants"] = variants_json(result.graphs);
  json["fused"] = fused_json(result);
  json["not_fused"] = not_fused_json(result);
  json["folded"] = folded_json(result);
  json["not_folded"] = not_folded_json(result);
  return json;
}

}  // namespace

int report(const ReportOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans, compile.plan.reasons = true;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  std::optional<compiler::CompileResult> unfused;  // for comparison
  compile.fuse = false;
  if (!result->fused.empty() && !options.json) unfused = compile_or_report(options.file, compile);
  std::vector<Facts> all;
  for (const compiler::CompiledGraph& graph : result->graphs) {
    for (const compiler::FramePlan& plan : graph.plans) {
      all.push_back(find_facts(result->program, graph, plan));
      if (!options.json) print(text_of(all.back(), plan.plan));
    }
    if (!options.json)
      print(fused_text(*result, unfused ? &*unfused : nullptr, graph.graph.value) + folded_text(*result, graph.graph.value) +
            variants_text(graph.shaders));
  }
  if (!options.json) print(merged_text(result->program));
  if (options.json) print(json_of(all, *result).dump(2) + "\n");
  return exit_done;
}

}  // namespace rg::commands
