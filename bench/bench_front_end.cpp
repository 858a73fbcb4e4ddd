#include "bench/graphs.h"
#include "bench/rows.h"

namespace rg::bench {

// Text to checked program; a speed that falls with the size of the graph shows a part that is not linear.
Rows bench_front_end(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences) {
    const auto graph = load_graph(graphs, reference);
    if (!graph) continue;
    const double ms = median_ms(5, [&] {
      dsl::Diagnostics diagnostics;
      dsl::load_program(
          graph->path, [&](const std::string&, std::string&) { return std::optional(graph->text); }, diagnostics);
    });
    const double megabytes = static_cast<double>(graph->text.size()) / 1e6;
    rows.push_back({std::string("front_end/") + reference.graph + "/check", ms, "ms", {}, ""});
    rows.push_back({std::string("front_end/") + reference.graph + "/speed", megabytes / (ms / 1000), "MB/s", {}, ""});
  }
  return rows;
}

}  // namespace rg::bench
