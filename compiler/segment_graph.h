// What the searches over segments share: neighbours as flat lists, intervals of items.
#pragma once

#include <span>

#include "compiler/segment_search.h"

namespace rg::compiler {

struct SegmentLinks {
  struct Link {
    uint32_t node = 0, gap = 0;  // gap: 1 for hard edges, 0 for soft
  };
  std::vector<uint32_t> first;  // by node, one more at the end
  std::vector<Link> links;
  std::span<const Link> of(uint32_t node) const { return {links.data() + first[node], first[node + 1] - first[node]}; }
};
SegmentLinks predecessors(const SegmentProblem& problem);
SegmentLinks successors(const SegmentProblem& problem);

struct SegmentInterval {
  uint32_t begin = UINT32_MAX, end = 0;  // inclusive
};
SegmentInterval interval_of(const SegmentProblem::Item& item, const Segments& segments);

}  // namespace rg::compiler
