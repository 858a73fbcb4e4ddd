#include "compiler/cull.h"

#include <algorithm>

namespace rg::compiler {
namespace {

bool is_observable(const dsl::Resource& resource) { return resource.is_output || resource.lifetime != dsl::Lifetime::transient; }

class Marker {
 public:
  Marker(const Frame& frame, const Graph& graph, Liveness& result) : frame_(frame), result_(result), needed_(frame.passes.size()) {
    for (const Dependency& d : graph.dependencies)
      if (d.kind == DependencyKind::read_after_write) needed_[d.after].push_back(&d);
  }

  void mark(uint32_t pass, std::string reason) {
    if (result_.live[pass]) return;
    result_.live[pass] = true;
    result_.reasons[pass] = std::move(reason);
    pending_.push_back(pass);
  }

  void drain() {
    while (!pending_.empty()) {
      const uint32_t pass = pending_.back();
      pending_.pop_back();
      for (const Dependency* d : needed_[pass])
        mark(d->before, "`" + frame_.resource_of(d->cell).name + "` is used by `" + frame_.pass(pass).name + "`");
    }
  }

 private:
  const Frame& frame_;
  Liveness& result_;
  std::vector<std::vector<const Dependency*>> needed_;
  std::vector<uint32_t> pending_;
};

std::string why_dead(const Frame& frame, uint32_t pass) {
  for (const Use& use : frame.uses_of(pass))
    if (use.writes()) return "nothing observable depends on `" + frame.resource_of(use.cell).name + "`";
  return "writes nothing";
}

}  // namespace

Liveness cull(const Frame& frame, const Graph& graph) {
  Liveness result{std::vector<bool>(frame.passes.size()), std::vector<std::string>(frame.passes.size())};
  Marker marker(frame, graph, result);
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass)
    if (frame.pass(pass).keep) marker.mark(pass, "marked `keep`");
  for (uint32_t cell = 0; cell < frame.cells.size(); ++cell)
    if (is_observable(frame.resource_of(cell)) && frame.cells[cell].age == 0)
      for (const uint32_t writer : graph.last_writers[cell]) marker.mark(writer, "`" + frame.resource_of(cell).name + "` is observable");
  marker.drain();
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass)
    if (!result.live[pass]) result.reasons[pass] = why_dead(frame, pass);
  return result;
}

}  // namespace rg::compiler
