#include "compiler/contents.h"

#include <algorithm>

namespace rg::compiler {
namespace {

size_t use_index(const Frame& frame, uint32_t pass, uint32_t cell) {
  const auto first = frame.uses.begin() + frame.first_use[pass], last = frame.uses.begin() + frame.first_use[pass + 1];
  return static_cast<size_t>(std::lower_bound(first, last, cell, [](const Use& use, uint32_t c) { return use.cell < c; }) - frame.uses.begin());
}

bool defined_at_entry(const dsl::Resource& resource) {
  if (resource.lifetime == dsl::Lifetime::imported) return resource.before.role != dsl::Role::undefined;
  return resource.lifetime == dsl::Lifetime::history || resource.lifetime == dsl::Lifetime::persistent;
}

// Whether what is there after the last epoch is wanted.
bool needed_at_exit(const dsl::Resource& resource, uint32_t age, uint32_t ages) {
  if (resource.lifetime == dsl::Lifetime::history) return age + 1 < ages;
  return resource.is_output || resource.lifetime != dsl::Lifetime::transient;
}

}  // namespace

ContentsOfUses find_contents(const Frame& frame, const std::vector<Line>& lines) {
  ContentsOfUses result(frame.uses.size());
  for (const Line& line : lines) {
    const dsl::Resource& resource = frame.resource_of(line.cell);
    const uint32_t stride = frame.grids[frame.cells[line.cell].resource].cells_per_age();
    bool defined = defined_at_entry(resource);
    for (size_t i = 0; i < line.epochs.size(); ++i) {
      const Epoch& epoch = line.epochs[i];
      const bool last = i + 1 == line.epochs.size();
      const bool one_by_one = epoch.share == Share::none && epoch.writes;  // passes of one rendering, or one pass
      const bool needed = (epoch.events.size() > 1 && !one_by_one) ||
                          (last ? needed_at_exit(resource, epoch.age, frame.grids[frame.cells[line.cell].resource].ages) : line.epochs[i + 1].needs);
      for (size_t e = 0; e < epoch.events.size(); ++e)
        result[use_index(frame, epoch.events[e].pass, line.cell + epoch.age * stride)] = {defined || (epoch.writes && e > 0),
                                                                                          needed || (one_by_one && e + 1 < epoch.events.size())};
      defined = defined || epoch.writes;
    }
  }
  return result;
}

}  // namespace rg::compiler
