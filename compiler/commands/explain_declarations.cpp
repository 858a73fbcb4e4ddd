#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/explain.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
namespace {

using dsl::Pass;

bool depends_on(const dsl::Guard& guard, dsl::FeatureId feature) {
  return std::any_of(guard.terms.begin(), guard.terms.end(), [&](const dsl::Guard::Term& term) { return term.feature == feature; });
}

// A line for each pass of each graph that `uses` says something about.
template <class Uses>
std::string users(const dsl::Program& program, const Uses& uses) {
  std::string text;
  for (const dsl::Graph& graph : program.graphs)
    for (const Pass& pass : graph.passes)
      if (const std::string how = uses(pass); !how.empty()) text += fmt::format("  pass {} {}\n", pass.name, how);
  return text.empty() ? "  no pass uses it\n" : text;
}

std::string graph_text(const dsl::Program& program, const dsl::SourceFiles& sources, const dsl::Graph& graph) {
  std::string text = fmt::format("graph {}  {}\n  {}, {}\n", graph.name, place_text(sources, graph.span),
                                 counted(graph.passes.size(), "pass", "passes"), counted(graph.resources.size(), "resource"));
  for (const dsl::Params& params : graph.params)
    if (!params.pass.valid()) text += fmt::format("  params {}: {}\n", params.name, program.structs[params.type].name);
  for (const Pass& pass : graph.passes) text += fmt::format("  pass {}\n", pass.name);
  return text;
}

std::string params_text(const dsl::Program& program, const dsl::SourceFiles& sources, const dsl::Graph& graph, dsl::ParamsId id) {
  const dsl::Params& params = graph.params[id];
  std::string text = fmt::format("params {}: {}  {}\n", params.name, program.structs[params.type].name, place_text(sources, params.span));
  for (const Pass& pass : graph.passes)
    if (std::any_of(pass.params.begin(), pass.params.end(), [&](const dsl::ParamsUse& use) { return use.id == id; }))
      text += fmt::format("  pass {} reads it\n", pass.name);
  return text;
}

std::string feature_text(const dsl::Program& program, const dsl::SourceFiles& sources, dsl::FeatureId id) {
  const dsl::Feature& feature = program.features[id];
  std::string values;
  for (size_t i = 0; i < feature.values.size(); ++i)
    values += fmt::format("{}{}{}", i > 0 ? ", " : "", feature.values[i], i == feature.initial ? " (initial)" : "");
  return fmt::format("feature {}: {}  {}\n", feature.name, values, place_text(sources, feature.span)) + users(program, [&](const Pass& pass) {
           const bool in_shaders = std::any_of(pass.features.begin(), pass.features.end(), [&](const auto& each) { return each.feature == id; });
           const bool by_condition = std::any_of(pass.conditions.begin(), pass.conditions.end(),
                                                 [&](dsl::ConditionId condition) { return program.conditions[condition].feature == id; });
           const bool exists = by_condition || depends_on(pass.guard, id);
           return std::string(exists && in_shaders ? "depends on it, its shaders too"
                              : exists             ? "depends on it"
                              : in_shaders         ? "gives it to its shaders"
                                                   : "");
         });
}

std::string sampler_text(const dsl::Program& program, const dsl::SourceFiles& sources, dsl::SamplerId id) {
  return fmt::format("sampler {}  {}\n", program.samplers[id].name, place_text(sources, program.samplers[id].span)) +
         users(program, [&](const Pass& pass) {
           std::string names;
           for (const dsl::Access& access : pass.accesses)
             if (access.sampler == id) names += (names.empty() ? "samples " : ", ") + access.name;
           return names;
         });
}

std::string condition_text(const dsl::Program& program, const dsl::SourceFiles& sources, dsl::ConditionId id) {
  const dsl::Condition& condition = program.conditions[id];
  return fmt::format("condition {}  {}\n", condition.name, place_text(sources, condition.span)) + users(program, [&](const Pass& pass) {
           return std::string(std::find(pass.conditions.begin(), pass.conditions.end(), id) == pass.conditions.end() ? ""
                                                                                                                     : "runs only while it holds");
         });
}

std::string extent_text(const dsl::SourceFiles& sources, const dsl::Extent& extent) {
  const auto sizes = [&](const int64_t* axes) {
    std::string text;
    for (uint32_t axis = 0; axis < extent.axes; ++axis) text += (axis > 0 ? "x" : "") + std::to_string(axes[axis]);
    return text;
  };
  return fmt::format("extent {}: starts at {}, {} to {}  {}\n", extent.name, sizes(extent.initial), sizes(extent.minimum), sizes(extent.maximum),
                     place_text(sources, extent.span));
}

}  // namespace

std::string explain_declarations(const dsl::Program& program, const dsl::SourceFiles& sources, const std::string& name) {
  std::string text;
  for (const auto& constant : program.constants)
    if (constant.name == name) text += fmt::format("const {} = {}\n", constant.name, constant.value);
  for (const dsl::Extent& extent : program.extents)
    if (extent.name == name) text += extent_text(sources, extent);
  for (size_t i = 0; i < program.features.size(); ++i)
    if (program.features.rows[i].name == name) text += feature_text(program, sources, dsl::FeatureId{i});
  for (size_t i = 0; i < program.samplers.size(); ++i)
    if (program.samplers.rows[i].name == name) text += sampler_text(program, sources, dsl::SamplerId{i});
  for (size_t i = 0; i < program.conditions.size(); ++i) {
    const dsl::Condition& condition = program.conditions.rows[i];
    if (condition.name == name && !condition.feature.valid()) text += condition_text(program, sources, dsl::ConditionId{i});
  }
  for (const dsl::Graph& graph : program.graphs) {
    if (graph.name == name) text += graph_text(program, sources, graph);
    for (size_t i = 0; i < graph.params.size(); ++i)
      if (graph.params.rows[i].name == name) text += params_text(program, sources, graph, dsl::ParamsId{i});
  }
  return text;
}

std::vector<std::string> declaration_names(const dsl::Program& program) {
  std::vector<std::string> names;
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows) names.push_back(row.name);
  };
  add(program.constants), add(program.extents), add(program.features), add(program.samplers), add(program.conditions), add(program.graphs);
  for (const dsl::Graph& graph : program.graphs) add(graph.params);
  return names;
}

}  // namespace rg::commands
