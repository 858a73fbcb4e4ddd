#include "bench/graphs.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace rg::bench {

const std::vector<Reference> kReferences = {
    {"g1_deferred", 0.0347, 28, 93, 19, 169.2, 176.0, 1.2, 15.6},  {"g2_10", 0.0124, 6, 37, 4, 41.7, 68.7, 0.5, 8.1},
    {"g2_100", 0.170, 37, 285, 36, 87.6, 68.8, 3.6, 87},           {"g2_1000", 3.93, 346, 2943, 342, 144.6, 117.1, 36, 801},
    {"g2_10000", 232, 3556, 29313, 3492, 161.9, 135.9, 401, 9000},
};

namespace {

std::optional<std::string> read(const std::string& path, std::string& why) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    why = "no such file";
    return std::nullopt;
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

std::optional<BenchGraph> load_graph(const std::string& folder, const Reference& reference, const std::string& suffix) {
  BenchGraph graph{&reference, folder + "/" + reference.graph + suffix + ".rg", {}, {}};
  std::string why;
  graph.text = read(graph.path, why).value_or("");
  if (graph.text.empty()) return std::nullopt;
  dsl::Diagnostics diagnostics;
  dsl::FrontEndResult front = dsl::load_program(graph.path, read, diagnostics);
  if (diagnostics.has_errors()) {
    std::fprintf(stderr, "%s", dsl::print(diagnostics, front.files, false).c_str());
    return std::nullopt;
  }
  graph.program = std::move(front.program);
  return graph;
}

}  // namespace rg::bench
