// rgc_bench GRAPHS [NAME] [--json]: measures and prints; never judges. Times are medians of one machine in one run: compare ratios.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/rows.h"

namespace {

using namespace rg::bench;

struct Bench {
  const char* name;
  Rows (*run)(const std::string& graphs);
};
constexpr Bench kBenches[] = {{"planner", bench_planner},   {"front_end", bench_front_end}, {"checker", bench_checker},
                              {"executor", bench_executor}, {"packing", bench_packing},     {"runtime", bench_runtime},
                              {"variants", bench_variants}, {"frame", bench_frame},         {"creation", bench_creation}};

void print_text(const Rows& rows) {
  for (const Row& row : rows) {
    std::printf("%-36s %12.3f %-6s", row.name.c_str(), row.value, row.unit.c_str());
    if (row.reference) std::printf(" %12.3f %8.3f  %s", *row.reference, row.value / *row.reference, row.note.c_str());
    std::printf("\n");
  }
}

void print_json(const Rows& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json entry = {{"name", row.name}, {"value", row.value}, {"unit", row.unit}, {"reference", nullptr}, {"ratio", nullptr}};
    if (row.reference) entry["reference"] = *row.reference, entry["ratio"] = row.value / *row.reference;
    json.push_back(entry);
  }
  std::printf("%s\n", json.dump(2).c_str());
}

int usage() {
  std::fprintf(stderr, "usage: rgc_bench GRAPHS [NAME] [--json]; NAME is one of");
  for (const Bench& bench : kBenches) std::fprintf(stderr, " %s", bench.name);
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string_view name;
  bool json = false, known = false;
  for (int i = 2; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--json")
      json = true;
    else
      name = argv[i];
  }
  if (argc < 2) return usage();
  if (!json) std::printf("%-36s %12s %-6s %12s %8s\n", "name", "value", "unit", "reference", "ratio");
  Rows all;
  for (const Bench& bench : kBenches) {
    if (!name.empty() && name != bench.name) continue;
    known = true;
    const Rows rows = bench.run(argv[1]);
    all.insert(all.end(), rows.begin(), rows.end());
    if (!json) print_text(rows);
  }
  if (!known) return usage();
  if (json) print_json(all);
  return 0;
}
