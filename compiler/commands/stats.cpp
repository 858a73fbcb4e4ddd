#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compiler/commands/command.h"
#include "compiler/shaders/statistics.h"

namespace rg::commands {
namespace {

// A variant of a pass: its shaders with the feature values that select them.
struct Row {
  std::string graph, pass, shader, features;
  compiler::ShaderStatistics statistics;
};

std::string value_text(const dsl::ShaderFeature& feature, uint32_t value) {
  if (feature.values.empty()) return fmt::format("{}{}", value != 0 ? "+" : "-", feature.name);
  return fmt::format("{}={}", feature.name, value < feature.values.size() ? feature.values[value] : std::to_string(value));
}

std::string features_text(const dsl::Pass& pass, const compiler::VariantRow& row) {
  std::string text;
  for (size_t i = 0; i < pass.features.size(); ++i) text += (text.empty() ? "" : " ") + value_text(pass.features[i], row.values[i]);
  return text;
}

void add_rows(const compiler::CompileResult& result, const compiler::CompiledGraph& compiled,
              const std::vector<compiler::ShaderStatistics>& statistics, std::vector<Row>& rows) {
  const dsl::Graph& graph = result.program.graphs[compiled.graph];
  for (size_t p = 0; p < graph.passes.size(); ++p) {
    std::vector<std::pair<size_t, std::string>> seen;  // the first selection of each shader stands for all
    for (const compiler::VariantRow& row : compiled.space.passes[p]) {
      const auto& variants = compiled.shaders.passes[p].variants[row.configuration];
      if (row.selector >= variants.size()) continue;
      for (const size_t shader : variants[row.selector]) {
        const auto same = [&](const auto& each) { return each.first == shader; };
        if (std::find_if(seen.begin(), seen.end(), same) != seen.end()) continue;
        seen.emplace_back(shader, "");
        rows.push_back({graph.name, graph.passes.rows[p].name, compiled.shaders.shaders[shader].name, features_text(graph.passes.rows[p], row),
                        statistics[shader]});
      }
    }
  }
}

std::vector<Row> find_rows(const compiler::CompileResult& result) {
  std::vector<Row> rows;
  for (const compiler::CompiledGraph& compiled : result.graphs) {
    std::vector<compiler::ShaderStatistics> statistics;
    for (const compiler::CompiledShader& shader : compiled.shaders.shaders) statistics.push_back(compiler::find_statistics(shader.words));
    add_rows(result, compiled, statistics, rows);
  }
  return rows;
}

std::string text_of(const std::vector<Row>& rows) {
  std::string text = fmt::format("{:<44} {:>6} {:>5} {:>4} {:>5} {:>6} {:>7} {:>7} {:>6} {:>5}\n", "pass, shader, features", "instr", "alu", "tex",
                                 "loads", "stores", "atomics", "barrier", "shared", "live");
  for (const Row& row : rows) {
    const compiler::ShaderStatistics& s = row.statistics;
    text += fmt::format("{:<44} {:>6} {:>5} {:>4} {:>5} {:>6} {:>7} {:>7} {:>6} {:>5}\n", row.pass, s.instructions, s.alu, s.samples, s.loads,
                        s.stores, s.atomics, s.barriers, s.shared_bytes, s.live_scalars);
    text += fmt::format("  {}{}{}\n", row.shader, row.features.empty() ? "" : "  ", row.features);
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<Row>& rows) {
  nlohmann::ordered_json json = {{"schema", "rgc-stats-1"}, {"variants", nlohmann::ordered_json::array()}};
  for (const Row& row : rows) {
    const compiler::ShaderStatistics& s = row.statistics;
    json["variants"].push_back({{"graph", row.graph},
                                {"pass", row.pass},
                                {"shader", row.shader},
                                {"features", row.features},
                                {"instructions", s.instructions},
                                {"alu", s.alu},
                                {"samples", s.samples},
                                {"loads", s.loads},
                                {"stores", s.stores},
                                {"atomics", s.atomics},
                                {"barriers", s.barriers},
                                {"branches", s.branches},
                                {"shared_bytes", s.shared_bytes},
                                {"live_scalars", s.live_scalars}});
  }
  return json;
}

}  // namespace

int stats(const StatsOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::shaders;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  const std::vector<Row> rows = find_rows(*result);
  print(options.json ? json_of(rows).dump(2) + "\n" : text_of(rows));
  return exit_done;
}

}  // namespace rg::commands
