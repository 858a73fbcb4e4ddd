#include "compiler/find_lifetimes.h"

#include <algorithm>

namespace rg::compiler {

Lifetimes find_lifetimes(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const PlanOptions& options) {
  Lifetimes lifetimes(frame.graph->resources.size());
  for (const Line& line : lines) {
    const dsl::Resource& resource = frame.resource_of(line.cell);
    if (resource.lifetime != dsl::Lifetime::transient) continue;
    Lifetime& life = lifetimes[frame.cells[line.cell].resource];
    if (!life.used()) life = {schedule.segments, 0};
    for (const Epoch& epoch : line.epochs)
      life.begin = std::min(life.begin, epoch.first_segment), life.end = std::max(life.end, epoch.last_segment + 1);
    if (resource.no_alias || !options.aliasing) life = {0, schedule.segments};
  }
  return lifetimes;
}

}  // namespace rg::compiler
