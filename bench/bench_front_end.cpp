#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "bench/graphs.h"
#include "bench/rows.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"

namespace rg::bench {
namespace {

void parse_text(const std::string& text) {
  dsl::Diagnostics diagnostics;
  const dsl::FileId file{size_t{0}};
  dsl::parse(file, text, dsl::lex(file, text, diagnostics), diagnostics);
}

void check_text(const std::string& path, const std::string& text) {
  dsl::Diagnostics diagnostics;
  dsl::load_program(
      path, [&](const std::string&, std::string&) { return std::optional(text); }, diagnostics);
}

// Peak memory of `work` above what the process holds, in megabytes: a child process does it and looks at its own peak.
template <class Work>
double peak_mb(Work work) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  ::malloc_trim(0);  // what this process has freed the child would use first, and need nothing more
  const pid_t child = ::fork();
  if (child == 0) {
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    work();
    ::getrusage(RUSAGE_SELF, &after);
    const double mb = static_cast<double>(after.ru_maxrss - before.ru_maxrss) * 1024 / 1e6;
    const ssize_t wrote = ::write(ends[1], &mb, sizeof mb);
    ::_exit(wrote == sizeof mb ? 0 : 1);
  }
  double mb = 0;
  if (child < 0 || ::read(ends[0], &mb, sizeof mb) != sizeof mb) mb = 0;
  ::close(ends[0]), ::close(ends[1]);
  if (child > 0) ::waitpid(child, nullptr, 0);
  return mb;
}

struct Measured {
  double passes = 0, ms = 0, mb = 0;
};

// b of cost = a * passes^b between the first and the last.
double exponent(const std::vector<Measured>& all, double Measured::*cost) {
  if (all.size() < 2 || all.front().*cost <= 0 || all.back().*cost <= 0) return 0;
  return std::log(all.back().*cost / (all.front().*cost)) / std::log(all.back().passes / all.front().passes);
}

// The demo's frame and its modules, read beforehand.
std::optional<double> frame_ms() {
  const std::string root = RGC_SOURCE_DIR "/passes.rg";
  std::map<std::string, std::string> files;
  const auto from_disk = [&](const std::string& path, std::string& why) -> std::optional<std::string> {
    std::ifstream file(path, std::ios::binary);
    if (!file) return why = "no such file", std::nullopt;
    std::ostringstream text;
    text << file.rdbuf();
    return files[path] = text.str();
  };
  dsl::Diagnostics diagnostics;
  dsl::load_program(root, from_disk, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return median_ms(15, [&] {
    dsl::Diagnostics again;
    dsl::load_program(
        root, [&](const std::string& path, std::string&) { return std::optional(files.at(path)); }, again);
  });
}

void measure(const BenchGraph& graph, Rows& rows, std::vector<Measured>& growing) {
  const std::string name = std::string("front_end/") + graph.reference->graph;
  const auto lines = static_cast<double>(std::count(graph.text.begin(), graph.text.end(), '\n'));
  const double parse = median_ms(5, [&] { parse_text(graph.text); });
  const double ms = median_ms(5, [&] { check_text(graph.path, graph.text); });
  const double mb = peak_mb([&] { check_text(graph.path, graph.text); });
  rows.push_back({name + "/lines", lines, "count", {}, ""});
  rows.push_back({name + "/lex_and_parse", lines / parse, "klines/s", 500, "wanted at least"});
  rows.push_back({name + "/check", ms, "ms", {}, ""});
  rows.push_back({name + "/peak", mb, "MB", {}, ""});
  const auto passes = static_cast<double>(graph.program.graphs.rows[0].passes.size());
  if (passes >= 90 && std::string_view(graph.reference->graph).starts_with("g2_")) growing.push_back({passes, ms, mb});
}

}  // namespace

// Text to checked program: speed, and how time and memory grow with the number of passes.
Rows bench_front_end(const std::string& graphs) {
  Rows rows;
  std::vector<Measured> growing;
  for (const Reference& reference : kReferences)
    if (const auto graph = load_graph(graphs, reference)) measure(*graph, rows, growing);
  if (const auto ms = frame_ms()) rows.push_back({"front_end/passes.rg/check", *ms, "ms", 10, "wanted at most"});
  if (!growing.empty()) rows.push_back({"front_end/10000_passes/check", growing.back().ms, "ms", 250, "wanted at most"});
  rows.push_back({"front_end/growth/time", exponent(growing, &Measured::ms), "power", 1, "linear"});
  rows.push_back({"front_end/growth/memory", exponent(growing, &Measured::mb), "power", 1, "linear"});
  return rows;
}

}  // namespace rg::bench
