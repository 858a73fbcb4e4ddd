// The benchmark graphs, loaded, with the figures of the system they are compared with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dsl/front_end.h"

namespace rg::bench {

// AMD Render Pipeline Shaders 1.1.1 on the same graphs: it plans again every frame. See bench/README.md.
struct Reference {
  const char* graph;
  double plan_ms, barrier_calls, barriers, blunt_barriers;
  double heap_mb;                             // the least of its three settings; persistent images included
  double bound_mb;                            // program order, live bytes by pass
  double record_null_us, record_lavapipe_us;  // CPU time of recording
};
extern const std::vector<Reference> kReferences;

struct BenchGraph {
  const Reference* reference = nullptr;
  std::string path, text;
  dsl::Program program;
};
// `folder`/<graph><suffix>.rg; nullopt if it is not there, or, with a line on stderr, if it has errors.
std::optional<BenchGraph> load_graph(const std::string& folder, const Reference& reference, const std::string& suffix = {});

}  // namespace rg::bench
