#include "compiler/build_graph.h"

#include <algorithm>
#include <tuple>

namespace rg::compiler {
namespace {

// The version of one cell that the next pass meets.
struct Version {
  std::vector<uint32_t> writers;  // empty: contents from before the frame
  std::vector<uint32_t> readers;  // of the layout in force
  Share share = Share::none;
  Layout read_layout = Layout::undefined;
  std::vector<uint32_t> earlier_readers;             // of the layout before, same version
  std::vector<uint32_t> base_writers, base_readers;  // of the version before, for further sharing writers
};

class Builder {
 public:
  Builder(const Frame& frame, Graph& graph) : frame_(frame), graph_(graph), versions_(frame.cells.size()) {}

  void add(const Use& use) {
    Version& version = versions_[use.cell];
    if (use.writes())
      write(use, version);
    else
      read(use, version);
  }

  void add_order(uint32_t pass, const std::vector<uint32_t>& position) {
    for (const dsl::PassId before : frame_.pass(pass).after)
      if (position[before.value] < pass) graph_.dependencies.push_back({position[before.value], pass, DependencyKind::order, UINT32_MAX});
  }

  void finish() {
    graph_.last_writers.reserve(versions_.size());
    for (Version& version : versions_) graph_.last_writers.push_back(std::move(version.writers));
  }

 private:
  void depend(const std::vector<uint32_t>& passes, const Use& use, DependencyKind kind) {
    for (const uint32_t before : passes) graph_.dependencies.push_back({before, use.pass, kind, use.cell});
  }
  void depend_on_contents(const std::vector<uint32_t>& writers, const Use& use) {
    depend(writers, use, use.needs ? DependencyKind::read_after_write : DependencyKind::write_after_write);
  }

  void read(const Use& use, Version& version) {
    depend_on_contents(version.writers, use);
    if (!version.readers.empty() && version.read_layout != use.effect.layout)
      version.earlier_readers = std::move(version.readers), version.readers.clear();
    depend(version.earlier_readers, use, DependencyKind::layout);
    version.read_layout = use.effect.layout;
    version.readers.push_back(use.pass);
  }

  void write(const Use& use, Version& version) {
    const bool joins = use.share != Share::none && use.share == version.share && version.readers.empty() && !version.writers.empty();
    if (!joins) {
      version.base_writers = std::move(version.writers), version.base_readers = std::move(version.readers);
      version.writers.clear(), version.readers.clear(), version.earlier_readers.clear();
      version.share = use.share;
    }
    // Readers stand between the two writers; without them the writers meet directly.
    if (version.base_readers.empty() || use.needs) depend_on_contents(version.base_writers, use);
    depend(version.base_readers, use, DependencyKind::write_after_read);
    version.writers.push_back(use.pass);
  }

  const Frame& frame_;
  Graph& graph_;
  std::vector<Version> versions_;
};

auto sort_key(const Dependency& d) { return std::tuple(d.after, d.before, d.cell, d.kind); }

}  // namespace

const char* name(DependencyKind kind) {
  switch (kind) {
    case DependencyKind::read_after_write:
      return "read after write";
    case DependencyKind::write_after_read:
      return "write after read";
    case DependencyKind::write_after_write:
      return "write after write";
    case DependencyKind::layout:
      return "layout";
    case DependencyKind::order:
      return "order";
  }
  return "";
}

Graph build_graph(const Frame& frame, const std::vector<bool>& live) {
  Graph graph;
  Builder builder(frame, graph);
  std::vector<uint32_t> position(frame.graph->passes.size(), UINT32_MAX);
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass) {
    if (!live[pass]) continue;
    position[frame.passes[pass]] = pass;
    builder.add_order(pass, position);
    for (const Use& use : frame.uses_of(pass)) builder.add(use);
  }
  builder.finish();
  std::sort(graph.dependencies.begin(), graph.dependencies.end(), [](const Dependency& a, const Dependency& b) { return sort_key(a) < sort_key(b); });
  graph.dependencies.erase(std::unique(graph.dependencies.begin(), graph.dependencies.end()), graph.dependencies.end());
  return graph;
}

}  // namespace rg::compiler
