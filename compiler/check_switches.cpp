#include "compiler/check_switches.h"

#include <algorithm>
#include <set>

#include "dsl/closest.h"

namespace rg::compiler {

void check_switches(const std::string& root_path, const dsl::Program& written, const dsl::Program& planned, const PlanOptions& options,
                    dsl::Diagnostics& diagnostics) {
  const auto check = [&](const char* flag, const std::set<std::string>& names, auto rows_of) {
    for (const std::string& name : names) {
      const auto has = [&](const auto& rows) { return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; }); };
      const auto knows = [&](const dsl::Program& program) {
        return has(program.graphs) ||
               std::any_of(program.graphs.begin(), program.graphs.end(), [&](const dsl::Graph& graph) { return has(rows_of(graph)); });
      };
      if (knows(planned) || knows(written)) continue;
      dsl::Diagnostic& error = diagnostics.report(dsl::DiagnosticKind::UnknownSubject, {}, {std::string(flag) + "=" + name, root_path});
      std::vector<std::string_view> all;
      for (const dsl::Graph& graph : written.graphs)
        for (const auto& row : rows_of(graph)) all.push_back(row.name);
      if (const std::string guess = dsl::closest(name, all).shown(); !guess.empty()) error.note(dsl::DiagnosticKind::DidYouMean, {}, {guess});
    }
  };
  const auto passes = [](const dsl::Graph& graph) -> const auto& { return graph.passes; };
  const auto resources = [](const dsl::Graph& graph) -> const auto& { return graph.resources; };
  check("--no-aliasing", options.no_aliasing, resources);
  check("--no-discard", options.no_discard, resources);
  check("--no-async", options.no_async, passes);
  check("--no-reorder", options.no_reorder, passes);
  check("--no-merge", options.no_merge, passes);
  check("--no-fold", options.no_fold, passes);
  check("--no-split", options.no_split, resources);
}
}  // namespace rg::compiler
